// Edits of the lab's part by commands and pointer, with their checks.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

class Arguments;

/// A change to the lab's part.
class RopeEdit {
  public:
    /// `workspace` simulates drags; it is the lab runtime's.
    RopeEdit(RopePart& changed, const Clock& clock, rope::Workspace& workspace);

    RopePart& part;
    std::string said;  ///< a message about the change, if the picture does not show it
    /// The world, read-only. world() copies it on first write.
    const NamedWorld& seen() const { return *part.world; }
    bool running() const { return seconds_ > 0.0; }
    NamedWorld& world();
    /// Moves over one tick, so that obstacles are pushed evenly. While the simulation is paused, moves at
    /// once by a quasi-static drag, in which every body settles.
    void move_pins(const std::vector<rope::PinPlace>& pins);
    void move_collider(const std::string& name, const glm::vec3& to);
    void set_collider(const std::string& name, const rope::Shape& shape);  ///< moves at once

  private:
    void dragged();

    rope::Workspace& workspace_;
    std::shared_ptr<NamedWorld> copy_;
    double seconds_;  ///< from the last substep to the end of the next tick; 0 while paused
};

/// Compares worlds by identity and the rest by value. Ignores quiet_ticks and samples.
bool operator==(const RopePart& a, const RopePart& b);

/// Throws Refused if there would be too many.
void check_particle_count(const NamedWorld& world, std::size_t more);
void check_collider_count(const NamedWorld& world);
/// Throws std::length_error if a substep would take too long.
void check_work(const NamedWorld& world);
/// Throw Refused if nothing has that name.
const rope::Body& body_of(const NamedWorld& world, std::string_view name);
const rope::Collider& collider_of(const NamedWorld& world, std::string_view name);
const rope::Tie& tie_of(const NamedWorld& world, std::string_view name);
/// The index of the body that contains a particle, searched from the body `near`.
std::size_t body_with(const rope::State& state, std::size_t particle, std::size_t near);
/// The particle named by two arguments.
struct NamedParticle {
    std::string body;
    std::size_t index = 0;     ///< in the body
    std::size_t particle = 0;  ///< in the world
};
NamedParticle named_particle(const NamedWorld& world, const Arguments& given, const char* rope = "rope",
                             const char* particle = "particle");
/// The particles given by `particle` or `particles`, of one rope. Throws Refused if neither or both are
/// given, or one does not exist.
std::vector<NamedParticle> named_particles(const NamedWorld& world, const Arguments& given);
/// The particles with their target points, from `one` for a single particle or `each` for several. Also
/// throws Refused if a particle is given twice.
std::vector<rope::PinPlace> pin_places(const Arguments& given, const std::vector<NamedParticle>& named,
                                       const char* one, const char* each);

/// The particles that a drag still holds, as indices in the world, or in a rival's world.
std::vector<std::size_t> held_particles(const RopeRacer& racer);
bool is_held(const RopeRacer& racer, std::size_t particle);
/// Stops holding the particle, because it was pinned or released.
void forget_held(RopePart& part, const NamedParticle& named);
/// True if a drag holds particles, here or in a rival's world.
bool holds(const RopePart& part);
/// Ends the drag, in all worlds.
void let_go(RopePart& part);
/// The rival's world with the drag released.
std::shared_ptr<const NamedWorld> released(const RopeRacer& racer);
/// Updates selection and drag after a body was edited in the world: the selection stays with the active
/// particle, on its piece; a drag ends if its particles are no longer on one piece.
void follow_particles(RopePart& part, NamedWorld& world, const std::string& body, const Became& became);
/// Makes separate bodies of pieces that have torn off since `before`.
void part_torn(RopePart& part, NamedWorld& world, const NamedWorld& before);
/// Changes a body's number of segments; ends a drag that holds it. The selection stays on its particles, or
/// the nearest to them. Throws Refused if there would be too many.
void resample_body(RopeEdit& edit, const std::string& body, const rope::Resolution& to);
void reverse_rope(RopeEdit& edit, const std::string& rope);
void rename_body(RopeEdit& edit, const std::string& body, const std::string& name);
/// Clears references to removed bodies, particles and colliders.
void forget_missing(RopePart& part);

}  // namespace tendril::app
