// The Rope lab's part of the document: a rope world with its simulation, view, selection and character; and
// its fields as users see them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/capsules.hpp>
#include <tendril/rope/collider.hpp>
#include <tendril/rope/hair_roots.hpp>
#include <vector>

#include "app/document/document.hpp"
#include "app/document/outside_file.hpp"
#include "app/document/workspace.hpp"
#include "app/fields/fields.hpp"
#include "app/io/character/character.hpp"
#include "app/io/names.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

class CommandTable;
class NamedWorld;

// A character in the Rope lab: the capsules of its body are colliders that follow one of its clips.

/// A character from a file, or the stick figure; copies of the document share it.
struct WalkerFigure : OutsideFile {
    Character character;
    humanoid::BoneMap map;
    std::vector<humanoid::BodyCapsule> capsules;
};
/// An empty path gives the stick figure; `file`: the user's name for the file, if different. Throws
/// std::runtime_error if the file cannot be read, or has no body.
std::shared_ptr<const WalkerFigure> read_walker(const std::string& path, const std::string& file = {});

struct Walker {
    std::shared_ptr<const WalkerFigure> figure;  ///< null: no character
    std::string clip;                            ///< plays in a loop; empty: stands in the rest pose
    glm::vec3 at{0.0f};                          ///< position of its file's origin, metres
    double began = 0.0;                          ///< simulated time at which the clip began
    bool operator==(const Walker&) const = default;
};

/// A capsule's placement; its collider has the name of its bone.
struct WalkerCapsule {
    std::string name;
    rope::Capsule shape;
};
std::vector<WalkerCapsule> walker_capsules(const Walker& walker, double time);
/// Starts moving its colliders to their placement at `next`, in seconds like `now`. When the clip restarts
/// they are placed there at once. Removed colliders stay removed.
void aim_walker(const Walker& walker, NamedWorld& world, double now, double next);

Json save_walker(const Walker& walker);
/// Reads the character's file again.
Walker load_walker(const JsonPlace& place);

void add_walker_commands(CommandTable& table);

inline constexpr const char* rope_lab = "rope";
/// Work per tick, mainly links times iterations. Substeps beyond it are dropped; a world whose single substep
/// exceeds it is refused.
inline constexpr std::uint64_t max_lab_work = 50'000'000;
/// Likewise while a drag moves particles: a substep of 10 000 particles of cloth, 34 ms on one core.
inline constexpr std::uint64_t max_dragged_work = 1'000'000;

/// The effect of a click on an object in the scene.
enum class RopeTool : std::uint8_t { Move, Pin, Cut, Tie };

/// A collider that swings to and fro. Its centre is middle + sin(2 pi t / period) * swing.
struct Swing {
    std::string collider;
    glm::vec3 middle{0.0f};
    glm::vec3 swing{0.0f};  ///< metres
    float period = 2.0f;    ///< seconds
    bool operator==(const Swing&) const = default;
};

/// The first tear of a body.
struct RopeTear {
    std::string body;
    std::size_t particle = 0;  ///< in the body before the tear
    float tension = 0.0f;      ///< newtons, in the link that tore
};

/// The mean force of bodies on a collider during a tick.
struct ColliderForce {
    rope::ColliderId collider;
    glm::dvec3 newtons{0.0};
};

/// The particles of a body that a drag holds. They were not pinned before.
struct Hold {
    std::string body;
    std::vector<std::size_t> particles;  ///< ascending; at least one
    bool operator==(const Hold&) const = default;
};

/// The selection: particles of a body, a collider or a tie.
struct RopeSelection {
    std::string body;
    Selection particles;   ///< selected particles of the body; at least one
    std::string collider;  ///< if not empty, the collider is selected instead of particles
    std::string tie;       ///< the same for a tie
    bool of_particles() const { return collider.empty() && tie.empty(); }
    std::size_t particle() const { return particles.active().value_or(0); }
    bool operator==(const RopeSelection&) const = default;
};

/// A program's frames: `rate` of them per second, with lengths from 1 ms to 250 ms at dial 1.
struct Jitter {
    float rate = 60.0f;  ///< Hz; at 60 and dial 0 each frame is a tick
    float dial = 0.0f;
    std::uint32_t frames = 0;  ///< frames so far; determines the length of the next frame
    double pending = 0.0;         ///< seconds since the last frame
    double frame = 0.0;        ///< length of the next frame, seconds; 0: not known yet, or a tick
    bool operator==(const Jitter&) const = default;
};

struct RopeView {
    bool particles = false;  ///< show particles as balls
    bool strain = false;     ///< colour links by their strain
    int sides = 16;          ///< sides of the tube, 3 to 64
    float thickness = 1.0f;  ///< factor on the drawn thickness of ropes and hair
    /// Colours of bodies without one of their own.
    BodyColour ropes = BodyColour::ByKind, hair = BodyColour::ByKind, cloths = BodyColour::ByKind;
    KindColours colours() const { return {ropes, hair, cloths}; }
    bool operator==(const RopeView&) const = default;
};

/// The solver's report about a tick.
struct RopeReport {
    std::uint64_t inside = 0;       ///< particles left inside colliders
    std::uint64_t unconverged = 0;  ///< solves that did not converge or were only applied in part
    std::uint64_t suspended = 0;    ///< unsupported bodies that do not fall
    std::uint64_t substeps = 0;     ///< simulated
    std::uint64_t dropped = 0;      ///< substeps omitted because the frame was too long
    std::uint64_t torn = 0;         ///< stretch links and ties
    float contact_loss = 0.0f;      ///< energy lost to contact, joules
    bool operator==(const RopeReport&) const = default;
};

/// The results of a tick, for the curves.
struct RopeSample {
    float stretch = 0.0f;  ///< the largest relative length error of all ropes, after the solver
    float error = 0.0f;    ///< the same after contact, including depenetration
    float energy = 0.0f;   ///< joules, of all bodies
    float frame = 0.0f;    ///< length of the frame that the tick ends in, milliseconds
    float cost = 0.0f;  ///< time to simulate it, microseconds; only measured in a live window and in a race
    RopeReport report;
    bool operator==(const RopeSample&) const = default;
};
inline constexpr std::size_t max_rope_samples = 600;  ///< ten seconds

/// A world with its curves and the particles held by a drag: the part's own or, in a race, another solver's.
struct RopeRacer {
    std::shared_ptr<const NamedWorld> world = std::make_shared<const NamedWorld>();
    std::vector<RopeSample> samples{};  ///< of the last ticks
    std::optional<Hold> hold{};         ///< in this world: a body may have torn in only one of them
    rope::Solver solver() const { return world->settings().solver; }
};

struct RopePart final : Part, RopeRacer {
    /// The settings that the scene was opened with: only differences from them count as changes. Not saved.
    rope::Settings usual;
    std::vector<Swing> swings;
    Walker walker;
    double time = 0.0;  ///< simulated time, seconds
    RopeTool tool = RopeTool::Move;
    std::optional<RopeSelection> selection;
    Jitter jitter;
    RopeView view;
    int quiet_ticks = 0;                ///< consecutive ticks without noticeable motion
    std::vector<RopeRacer> rivals;      ///< in a race (rope_time.hpp)
    std::shared_ptr<const Part> start;  ///< after the last change; none before the next tick. Not saved
    /// Forces on touched colliders in the last tick; none before it. Not saved.
    std::optional<std::vector<ColliderForce>> forces{};
    std::vector<RopeTear> tears;  ///< of existing bodies, in order of time. Not saved

    std::shared_ptr<Part> clone() const override { return std::make_shared<RopePart>(*this); }
    Json save() const override;
    void upgrade(Json& json, int version) const override;
    std::shared_ptr<Part> load(const Json& json, const std::string& where) const override;
    std::shared_ptr<const Part> after_undo() const override;
    std::shared_ptr<const Part> at_moment(std::shared_ptr<const Part> then) const override;
    std::size_t bytes() const override;
    std::vector<std::filesystem::path> files() const override;
};

/// The lab's part of a workspace.
inline const RopePart& rope_part(const Workspace& workspace) {
    return workspace.document.get<RopePart>(rope_lab);
}

}  // namespace tendril::app

// Names and ranges shared by the files, commands and panels of this lab.

namespace tendril::app {

inline constexpr int min_sides = 3, max_sides = 64;
inline constexpr double min_jitter_frame = 0.001, max_jitter_frame = 0.25;  ///< seconds

inline constexpr EnumNames<RopeTool, 4> rope_tools{
    "tool",
    {{"move", "Select", "A click selects: the inspector then shows the settings."},
     {"pin", "Pin", "A click on a particle pins or unpins it."},
     {"cut", "Cut",
      "Drag across ropes and cloths to cut them. Or click a rope's segment, or two particles of a cloth."},
     {"tie", "Tie", "A click on one particle and then on another ties the two."}}};

// The fields of ropes, cloth, hair and colliders as users see them, and the settings of a hanging body.

class Arguments;

/// The settings of rope.set: the library's body, and quantities computed from its particles and links; empty
/// if the body has no such particles or links.
struct BodySettings {
    rope::Body body;                       ///< its radius, friction, bending and tear
    float length = 1.0f;                   ///< metres; of a cloth's row or a hair's strand
    std::optional<float> width{};          ///< metres, across the rows of a cloth
    std::optional<int> segments{};         ///< segments of a rope or of each strand
    std::optional<int> columns{}, rows{};  ///< particles of a cloth
    double mass = 1.0;                     ///< kilograms, of the whole body
    std::optional<double> density{};       ///< kg/m, for cloth kg/m^2; none for a body without length
    std::optional<float> stretch{};        ///< 1/N, for a rope, a strand, or a metre's width of cloth
    std::optional<float> shear{}, bend{};  ///< compliance of its links, m/N
    BodyColour colour = BodyColour::ByKind;
};

BodySettings settings_of(const NamedWorld& world, const rope::Body& body);
/// The fields that the body has: a cloth has no bending.
std::vector<Field> body_fields(const BodySettings& of);

class RopeEdit;

/// Applies the given fields to the body. Throws Refused for a field that the body lacks,
/// std::invalid_argument if the library refuses.
void set_body(RopeEdit& edit, const std::string& body, const Arguments& given);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept;

namespace tendril::app {

/// Also for shapes that create bodies, and for patches of hair.
template <>
std::span<const FieldText> field_texts<BodySettings>();
template <>
std::span<const FieldText> field_texts<rope::TieShape>();
/// For all kinds of collider.
template <>
std::span<const FieldText> field_texts<rope::Shape>();
template <>
std::span<const FieldText> field_texts<rope::Drive>();
template <>
std::span<const FieldText> field_texts<Swing>();
template <>
std::span<const FieldText> field_texts<Jitter>();

}  // namespace tendril::app

/// For files.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Swing>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Jitter>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::RopeView>();
