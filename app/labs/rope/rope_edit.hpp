// What the lab's commands and its pointer change, and what they check.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

class Arguments;

/// A change of the lab's part.
class RopeEdit {
  public:
    /// `workspace` is what drags are simulated with: the lab runtime's.
    RopeEdit(RopePart& changed, const Clock& clock, rope::Workspace& workspace);

    RopePart& part;
    /// The world to look at, and a copy of it to change, put in its place: what does not ask for that leaves
    /// the world as it is.
    const NamedWorld& seen() const { return *part.world; }
    NamedWorld& world();
    /// Each gets there in the length of one tick, so that it pushes evenly what it meets; while the
    /// simulation is paused, at once, by a quasi-static drag.
    void move_pins(const std::vector<rope::PinPlace>& pins);
    void move_collider(const std::string& name, const glm::vec3& to);
    void set_collider(const std::string& name, const rope::Shape& shape);  ///< there at once

  private:
    void dragged();

    rope::Workspace& workspace_;
    std::shared_ptr<NamedWorld> copy_;
    double seconds_;  ///< of the world that the next tick takes; 0 while the simulation is paused
};

/// Whether the two hold the very same; the same world, and not merely an equal one.
bool operator==(const RopePart& a, const RopePart& b);

/// Throws Refused where there would be too many, before there are.
void check_particle_count(const NamedWorld& world, std::size_t more);
void check_collider_count(const NamedWorld& world);
/// Throws std::length_error where a substep of it would take too long.
void check_work(const NamedWorld& world);
/// Throws Refused where there is none of that name.
const rope::Body& body_of(const NamedWorld& world, const std::string& name);
const rope::Collider& collider_of(const NamedWorld& world, const std::string& name);
/// The particle that `rope` and `particle` name.
struct NamedParticle {
    std::string body;
    std::size_t index = 0;     ///< in the body
    std::size_t particle = 0;  ///< in the world
};
NamedParticle named_particle(const NamedWorld& world, const Arguments& given);
/// Those that `particle` or `particles` names, of one rope. Throws Refused where neither or both are given,
/// or one is not there.
std::vector<NamedParticle> named_particles(const NamedWorld& world, const Arguments& given);
/// Those, with the point that `one` gives for the one, or `each` for each of several. Throws Refused, too,
/// where a particle stands among them twice.
std::vector<rope::PinPlace> pin_places(const Arguments& given, const std::vector<NamedParticle>& named,
                                       const char* one, const char* each);

/// What a drag still holds, by their numbers in the world.
std::vector<std::size_t> held_particles(const RopePart& part);
bool is_held(const RopePart& part, std::size_t particle);
/// Of what a drag holds, this is held no more: it is pinned for good, or free again.
void forget_held(RopePart& part, const NamedParticle& named);
/// Lets go of what a drag holds.
void let_go(RopePart& part);
/// The world without what a drag holds.
NamedWorld released_world(const RopePart& part);
/// Whatever is gone is neither chosen nor held nor swings.
void forget_missing(RopePart& part);

}  // namespace tendril::app
