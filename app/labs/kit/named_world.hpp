// A rope world with named bodies, colliders and ties, in memory, in files and in the picture: the library
// uses handles, users and files use names.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <tendril/rope/edit.hpp>
#include <tendril/rope/quasi_static.hpp>
#include <tendril/rope/world.hpp>
#include <type_traits>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/json.hpp"
#include "app/io/names.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/view/camera.hpp"
#include "app/view/draw_list.hpp"
#include "app/view/palette.hpp"

namespace tendril::app {

inline constexpr std::size_t max_lab_particles = 100'000;  ///< more would make scene files too large
inline constexpr std::size_t max_lab_colliders = 1'000, max_lab_ties = 1'000;

inline constexpr EnumNames<rope::Solver, 3> rope_solvers{
    "solver",
    {{"relaxation", "Relaxation",
      "One segment after the other. How far a rope stretches depends on iterations and substep, not on its "
      "material."},
     {"xpbd", "XPBD",
      "As relaxation, but with compliance: enough iterations stretch it as a material stretches."},
     {"direct", "Direct", "All segments of a rope at once: it does not stretch, and keeps its energy."}}};

/// A body's colour: by its kind, or one of the racers' colours (racer_colour()).
enum class BodyColour : std::uint8_t { ByKind, Blue, Pink, Brown, Teal, Violet, Olive };

inline constexpr EnumNames<BodyColour, 7> body_colours{"colour",
                                                       {{"by_kind", "By its kind"},
                                                        {"blue", "Blue"},
                                                        {"pink", "Pink"},
                                                        {"brown", "Brown"},
                                                        {"teal", "Teal"},
                                                        {"violet", "Violet"},
                                                        {"olive", "Olive"}}};

/// The result of cutting, parting or resampling a body.
struct Became {
    std::vector<std::size_t> particles;  ///< as in rope::Edited
    std::vector<std::string> pieces;     ///< the names of the pieces that came off, in the order of particles
};

/// A value type, like the library's world; state that only stepping needs is in a rope::Workspace.
class NamedWorld {
  public:
    NamedWorld() = default;
    /// Names are in the order of the state's bodies, colliders and ties. Throws std::invalid_argument if the
    /// state is invalid, or if a name is empty or used twice.
    NamedWorld(rope::State state, const std::vector<std::string>& bodies,
               const std::vector<std::string>& colliders, const std::vector<std::string>& ties = {});
    /// Replaces the state. Its bodies, colliders and ties must already have names.
    void put(rope::State state);

    const rope::World& world() const { return world_; }
    const rope::State& state() const { return world_.state(); }
    const rope::Settings& settings() const { return world_.settings(); }

    // Null, or a null handle, if nothing has that name.
    const rope::Body* find(std::string_view body) const;
    const rope::Collider* find_collider(std::string_view collider) const;
    const rope::Tie* find_tie(std::string_view tie) const;
    /// The collider that a pin moves with; null if there is none.
    const rope::Collider* holder(const rope::Pin& pin) const { return world_.find(pin.collider); }
    const std::string& name(const rope::Body& body) const { return bodies_[body.id.index]; }
    BodyColour colour(const rope::Body& body) const { return colours_[body.id.index]; }
    const std::string& name(const rope::Collider& collider) const { return colliders_[collider.id.index]; }
    const std::string& name(const rope::Tie& tie) const { return ties_[tie.id.index]; }

    // From here on, throws std::invalid_argument if the library refuses, or a name is taken or unknown.
    void set_settings(const rope::Settings& settings);
    void clear() { world_.clear(); }
    /// Returns the body's name; an empty `name` becomes "rope", "rope 2", ...
    std::string add_rope(const std::string& name, const rope::RopeShape& shape);
    std::string add_cloth(const std::string& name, const rope::ClothShape& shape);
    /// `attach` is a collider's name, or empty.
    std::string add_hair(const std::string& name, rope::HairShape shape, const std::string& attach = {});
    // Pieces that come off a body get its colour, and its name with the next free number.
    Became cut(std::string_view rope, std::size_t segment);
    Became cut_cloth(std::string_view cloth, std::span<const rope::ClothLine> lines);
    Became part_body(std::string_view body);
    Became resample(std::string_view body, const rope::Resolution& to);
    Became reverse(std::string_view rope);
    /// Calls the library's method: change("rope", &rope::World::set_length, 2.0f).
    template <class Id, class... Given>
    void change(std::string_view name, Result (rope::World::*method)(Id, Given...),
                const std::type_identity_t<std::remove_cvref_t<Given>>&... given) {
        const Id found = id_of(name, Id());
        require_ok((world_.*method)(found, given...));
    }
    void rename(std::string_view body, const std::string& name);
    void set_colour(std::string_view body, BodyColour colour);
    std::size_t particle(std::string_view body, std::size_t index) const;
    void pin(std::size_t particle, const glm::dvec3& at, double seconds = 0.0);
    void attach(std::size_t particle, std::string_view collider);
    void unpin(std::size_t particle);
    bool pinned(std::size_t particle) const { return world_.pinned(particle); }
    /// Returns the tie's name; an empty `name` becomes "tie", "tie 2", ...
    std::string tie(const std::string& name, std::size_t a, std::size_t b, const rope::TieShape& shape = {});
    void set_collides(std::string_view a, std::string_view b, bool on);
    bool collides(std::string_view a, std::string_view b) const { return world_.collides(id(a), id(b)); }
    void add_collider(const std::string& name, const rope::Shape& shape);

    // Quasi-static drags, for while the simulation is paused.
    void drag_pins(rope::Workspace& workspace, std::span<const rope::PinPlace> pins);
    void drag_collider(rope::Workspace& workspace, std::string_view name, const glm::vec3& to);
    void drag_collider(rope::Workspace& workspace, std::string_view name, const rope::Shape& shape);

    rope::Advance advance(double seconds, rope::Workspace& workspace, std::uint64_t max_substeps);

    std::size_t size() const { return world_.size(); }
    // In single precision, for drawing: positions at the frame's own time (rope::World::pose).
    glm::vec3 position(std::size_t particle) const;
    std::vector<glm::vec3> positions() const;  ///< of all particles
    rope::Shape shape(const rope::Collider& collider) const { return world_.pose(collider); }
    glm::vec3 velocity(std::size_t particle) const { return glm::vec3(world_.velocity(particle)); }
    double length_error(const rope::Body& body) const { return world_.length_error(body); }
    double length_error() const { return world_.length_error(); }
    double energy(const rope::Body& body) const { return world_.energy(body); }
    double energy() const { return world_.energy(); }
    double length(const rope::Body& body) const { return world_.length(body); }

  private:
    void check_free(const char* operation, std::string_view body) const;
    std::string name_body(rope::BodyId body, const std::string& wanted, const std::string& stem);
    std::vector<std::string> name_pieces(std::string_view of, std::span<const rope::BodyId> pieces);
    rope::BodyId id(std::string_view body) const;
    rope::ColliderId collider_id(std::string_view collider) const;
    rope::TieId tie_id(std::string_view tie) const;
    rope::BodyId id_of(std::string_view name, rope::BodyId) const { return id(name); }
    rope::ColliderId id_of(std::string_view name, rope::ColliderId) const { return collider_id(name); }
    rope::TieId id_of(std::string_view name, rope::TieId) const { return tie_id(name); }
    Became take(std::string_view body, Expected<rope::Edited> edited);

    rope::World world_;
    std::vector<std::string> bodies_, colliders_, ties_;  ///< by slot
    std::vector<BodyColour> colours_;                     ///< bodies' colours, by slot
};

template <>
std::span<const FieldText> field_texts<rope::Settings>();
/// The fields "wind", "gusts" and "still_air".
std::span<const Field> wind_fields();
std::span<const FieldText> wind_texts();

// A rope world in a scene file and in --state.

class JsonPlace;

/// The complete state of the world, bit for bit.
Json save_world(const NamedWorld& world);
/// Throws std::runtime_error with the JSON path and the fault, or std::invalid_argument if the parts do not
/// fit together. `besides`: other members, which the caller reads.
NamedWorld load_world(const JsonPlace& place, std::span<const std::string_view> besides = {});

/// The fields of the kind of shape that a collider has.
FieldsOf shape_fields(const rope::Collider& collider);

// Draws the bodies of a rope world: ropes and hair as tubes, cloth as a surface.

/// The colour of a relative strain (negative: compressed): neutral up to 0.01 %, full from 10 % on.
glm::vec3 strain_colour(float strain, const Palette& palette);

/// The colour of a cloth's front, unless the body has its own.
glm::vec3 cloth_front(const Palette& palette);
/// Colours of bodies without one of their own, by kind. ByKind: the palette's.
struct KindColours {
    BodyColour rope = BodyColour::ByKind, hair = BodyColour::ByKind, cloth = BodyColour::ByKind;
};
BodyColour colour_of(const NamedWorld& world, const rope::Body& body, const KindColours& kinds);
/// The body's colour; for a cloth, its front's.
glm::vec3 body_colour(BodyColour colour, rope::Body::Kind kind, const Palette& palette);
glm::vec3 body_colour(const NamedWorld& world, const rope::Body& body, const Palette& palette,
                      const KindColours& kinds = {});
/// One for each particle: its body's colour, or the colour of the worst strain of its links.
std::vector<glm::vec3> particle_colours(const NamedWorld& world, const Palette& palette, bool by_strain,
                                        const KindColours& kinds = {});

/// Whether each cell of a cloth's grid still has its link to the next in its row (`along`) and column
/// (`down`).
struct GridLinks {
    std::vector<std::uint8_t> along, down;
};
GridLinks grid_links(const NamedWorld& world, const rope::Body& cloth);
/// The remaining triangles of each cell, as in ClothGrid: a triangle needs both of its links.
std::vector<std::uint8_t> whole_cells(const NamedWorld& world, const rope::Body& cloth);

// `positions` and `colours` cover all particles of the world.

/// Tubes with `sides` sides (3 to 64); hair always has six.
void draw_strands(DrawList& list, const Camera& camera, const rope::Body& body,
                  std::span<const glm::vec3> positions, std::span<const glm::vec3> colours, int sides);
/// Without `colours`, uses the body's colour; the back is paler than the front.
void draw_cloth(DrawList& list, const Camera& camera, const NamedWorld& world, const rope::Body& body,
                std::span<const glm::vec3> positions, std::span<const glm::vec3> colours,
                const Palette& palette, const KindColours& kinds = {});

}  // namespace tendril::app
