// Ropes, cloth and hair among colliders.
//
//     rope::World world;
//     rope::Workspace workspace;
//     const rope::BodyId line = *world.add_rope(
//         {.from = {0, 2, 0}, .to = {1, 2, 0}, .length = 1.5f, .pin_start = true, .pin_end = true});
//     const rope::ColliderId ball = *world.add_collider(rope::Sphere{{0.5f, 1, 0}, 0.3f});
//     for (;;) {
//         world.advance(frame_seconds, workspace);
//         draw(world.state().position);
//     }
//
// A world is a value: a copy of it goes on as the original does, bit for bit, so rollback is a copy and an
// assignment. Scratch memory is in the workspace, on which no result depends.
//
// Units are metres, kilograms and seconds. Particles are kept in double precision: a rope a thousand
// kilometres from the origin moves as it does near it. The world has an edge, max_magnitude from the origin
// each way, where what flies further stops. The same calls give the same bits with every compiler, every
// vector unit and any number of threads.
//
// Editing calls answer with the argument and its value where they refuse, and leave the world as it was.
// advance() allocates nothing once the workspace has seen the world in its shape, unless more colliders are
// near than ever before.
//
// Bodies that no link joins do not notice each other, and threads can share them, and a cloth of 8 192
// particles or more: Workspace::use_threads. A rope is solved on one thread. Two bounds they share:
// max_pass_work and that on the search for a way out of colliders, of which each has its part by size.
#pragma once

#include "tendril/result.hpp"
#include "tendril/rope/state.hpp"
#include "tendril/rope/workspace.hpp"

namespace tendril::rope {

/// What one call of advance() did.
struct Advance {
    int substeps = 0;
    std::uint64_t dropped = 0;  ///< substeps that there was no time for
    int passes = 0;  ///< of the solver over the linked bodies that took most, summed over substeps; Direct
                     ///< may solve one chain more often
    std::uint64_t work = 0;        ///< links solved and distances to colliders taken: what the time goes into
    int shortened = 0;             ///< substeps in which max_pass_work cut passes
    std::uint64_t unresolved = 0;  ///< times a particle was left inside colliders: there was no way out, or
                                   ///< the search for one took too long
    std::uint64_t unconverged = 0;  ///< times lengths and contacts of a rope were not brought together to
                                    ///< 0.1 % in the steps there are; what has no solution is stretched,
                                    ///< and is none of these
    std::uint64_t fallbacks = 0;    ///< times a body was solved by the fallback, or only part of a step taken
    std::uint64_t suspended = 0;    ///< times a body that nothing holds or touches did not fall freely: it is
                                    ///< at the edge of the world, or the solver held it
    double contact_loss = 0.0;      ///< joules that bodies near colliders at rest lost beyond damping: to
                                    ///< contact, friction and the solver. Its rounding depends on threads
    bool refused = false;           ///< `seconds` was no number from 0 to 1e9: nothing was done
};

struct AdvanceOptions {
    std::uint64_t max_substeps = std::uint64_t{1} << 40;  ///< what is over is dropped and counted
};

class World {
  public:
    World() = default;
    /// Refuses an inconsistent state: lists of different lengths, links to particles that there
    /// are not, numbers out of range, a handle twice. O(n).
    static Expected<World> from_state(State state);

    const State& state() const noexcept { return state_; }
    const Settings& settings() const noexcept { return state_.settings; }
    Result set_settings(const Settings& settings) noexcept;

    void clear() noexcept;  ///< no body, no collider; the settings stay
    Expected<BodyId> add_rope(const RopeShape& shape);
    Expected<BodyId> add_cloth(const ClothShape& shape);
    Expected<BodyId> add_hair(const HairShape& shape);
    Result remove(BodyId body) noexcept;

    /// Null where there is none. The pointer is valid until the next body comes or goes.
    const Body* find(BodyId body) const noexcept;
    /// The number of a body's particle in the world, valid until a body before it goes.
    Expected<std::size_t> particle(BodyId body, std::size_t index) const noexcept;

    /// Pins a particle and moves it to `at` evenly in the next `seconds` of simulated time; 0: within the
    /// next substep.
    Result pin(std::size_t particle, const glm::dvec3& at, double seconds = 0.0);
    /// Pins a particle where it is to a collider, with which it moves.
    Result attach(std::size_t particle, ColliderId collider);
    Result unpin(std::size_t particle) noexcept;
    bool pinned(std::size_t particle) const noexcept;

    /// Cuts a rope in two: segment `segment` goes, and what is behind it becomes a rope of its own, which is
    /// returned.
    Expected<BodyId> cut(BodyId rope, std::size_t segment);

    // What a body is made of can change while it hangs; it goes on from where it is.
    Result set_radius(BodyId body, float metres) noexcept;
    /// The sum of its particles' masses, each of which changes in proportion. Kilograms, over 0 to 1e18.
    Result set_mass(BodyId body, double kilograms) noexcept;
    double mass(const Body& body) const noexcept;
    /// Strain at which its links tear; 0: never.
    Result set_tear(BodyId body, float tear) noexcept;
    /// Of its links of that kind, m/N. Stretch links have it in addition to the settings'.
    Result set_compliance(BodyId body, Link::Kind kind, float compliance) noexcept;
    /// Of a rope, a row of a cloth, a strand of hair: all of its links change in proportion. Metres; a body
    /// of length 0 cannot be made longer.
    Result set_length(BodyId body, float metres) noexcept;

    Expected<ColliderId> add_collider(const Shape& shape);
    /// Moves a collider to `to` evenly in the next `seconds` of simulated time, 0: within the next substep;
    /// it pushes what it meets.
    Result move_collider(ColliderId collider, const glm::vec3& to, double seconds = 0.0) noexcept;
    /// The same for both ends of a capsule, each along its own line, so that it turns. Its radius is that of
    /// `to` at once.
    Result move_capsule(ColliderId capsule, const Capsule& to, double seconds = 0.0) noexcept;
    Result set_collider(ColliderId collider, const Shape& shape) noexcept;  ///< there at once
    /// What is attached to it is unpinned.
    Result remove_collider(ColliderId collider) noexcept;
    const Collider* find(ColliderId collider) const noexcept;

    /// Lets `seconds` pass, 0 to 1e9; what is over settings().longest_frame is dropped and counted.
    Advance advance(double seconds, Workspace& workspace, const AdvanceOptions& options = {});

    std::size_t size() const noexcept { return state_.position.size(); }
    const glm::dvec3& position(std::size_t particle) const noexcept { return state_.position[particle]; }
    glm::dvec3 velocity(std::size_t particle) const noexcept;  ///< m/s
    /// The largest relative length error of a body's stretch links as they are now. It includes what
    /// depenetration added, which Body::stretch does not.
    double length_error(const Body& body) const noexcept;
    double length_error() const noexcept;  ///< of all bodies
    /// Kinetic, potential and elastic energy, joules, halfway through the last substep, where a leapfrog
    /// step conserves it. Potential is 0 where the coordinates are.
    double energy(const Body& body) const noexcept;
    double energy() const noexcept;  ///< of all bodies
    /// The sum of a body's rest lengths, metres; of cloth and hair that of one row or strand.
    double length(const Body& body) const noexcept;

  private:
    Body* found(BodyId body) noexcept;
    Collider* found(ColliderId collider) noexcept;
    void take_stretch(Body& body) noexcept;

    State state_;
};

}  // namespace tendril::rope
