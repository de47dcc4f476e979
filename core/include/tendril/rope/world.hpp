// Ropes, cloth and hair among colliders.
//
//     rope::World world;
//     rope::Workspace workspace;
//     const rope::BodyId line = *world.add_rope(
//         {.from = {0, 2, 0}, .to = {1, 2, 0}, .length = 1.5f, .pin_start = true, .pin_end = true});
//     const rope::ColliderId ball = *world.add_collider(rope::Sphere{{0.5f, 1, 0}, 0.3f});
//     std::vector<glm::dvec3> pose(world.size());
//     for (;;) {
//         world.pin(end, hand, world.pending() + frame_seconds);
//         world.advance(frame_seconds, workspace);
//         world.pose(pose);
//         draw(pose);
//     }
//
// Frames are rarely a whole number of substeps long. The state is then up to one substep behind the frame, by
// a different time in each: at 144 Hz up to 28 mm for a body at 10 m/s. Draw pose(), which gives positions at
// the frame's own time, and add pending() to the seconds of each move, so that it arrives just then: a rope
// in a hand then moves as evenly as the hand.
//
// A world is a value: a copy behaves like the original, bit for bit, so rollback is a copy and an assignment.
// Scratch memory is in the workspace, on which no result depends.
//
// Units are metres, kilograms and seconds. Particles are in double precision: a rope a thousand kilometres
// from the origin moves as it does near it. The world has an edge, max_magnitude from the origin in each
// coordinate, where particles stop. The same calls give the same bits with every compiler, every vector unit
// and any number of threads.
//
// A refused editing call names the argument and its value, and leaves the world unchanged, as does one that
// runs out of memory. advance() allocates nothing once the workspace has seen the world in its current shape,
// unless more colliders are near than ever before. If it runs out of memory, the world stays valid, but the
// last substep may be incomplete: State::substeps counts complete ones. At most a substep of the time left
// stays pending; the rest is lost.
//
// Bodies that no link, tie or collision joins do not affect each other, so threads can share them, or a cloth
// of 8 192 particles or more, but not a rope: Workspace::use_threads. Unjoined bodies share two limits in
// proportion to size: max_pass_work, and the one on searches for a way out of colliders.
#pragma once

#include <span>

#include "tendril/result.hpp"
#include "tendril/rope/state.hpp"
#include "tendril/rope/workspace.hpp"

namespace tendril::rope {

/// A link that tore, as it was.
struct TornLink {
    BodyId body;
    Link link;
};

/// The impulse that bodies gave a collider in one call of advance(): by contact and friction, and by the
/// particles attached to it, with their weight. An engine applies it to its own rigid body, whose mass
/// includes those particles, and moves the collider at the body's new velocity. A taut rope that cannot
/// stretch throws the body off: give the rope a compliance, about 1e-4 1/N for a few newtons. The error is
/// under 2 %, but up to 25 % when cloth tied to other bodies hits.
struct ColliderImpulse {
    ColliderId collider;
    glm::dvec3 linear{0.0};   ///< N s
    glm::dvec3 angular{0.0};  ///< N m s, about the collider's centre
    bool operator==(const ColliderImpulse&) const = default;
};

/// Report of one call of advance().
struct Advance {
    int substeps = 0;
    std::uint64_t dropped = 0;  ///< substeps over longest_frame or max_substeps, not simulated
    int passes = 0;  ///< solver passes over the linked bodies that needed most, summed over substeps; Direct
                     ///< may solve a single chain more often
    std::uint64_t work = 0;         ///< links solved and distances to colliders computed: where the time goes
    int shortened = 0;              ///< substeps in which max_pass_work cut passes
    std::uint64_t unresolved = 0;   ///< times a particle was left inside colliders: no way out exists, or the
                                    ///< search for it took too long
    std::uint64_t unconverged = 0;  ///< times lengths and contacts of a rope did not converge to 0.1 % in the
                                    ///< available steps; a rope without a solution is stretched, and
                                    ///< not counted
    std::uint64_t fallbacks = 0;    ///< times a body used the fallback, or a step was taken only in part
    std::uint64_t suspended = 0;    ///< times a body that nothing holds or touches did not fall freely: it is
                                    ///< at the edge of the world
    std::uint64_t held_back = 0;    ///< times two segments, or a particle and a triangle, would have
                                    ///< crossed and were held back
    double contact_loss = 0.0;      ///< joules that bodies near resting colliders lost beyond damping: to
                                    ///< contact, friction and the solver. Its rounding depends on threads
    std::span<const TornLink> torn{};  ///< links over their body's tear strain, by substep, then in the order
                                       ///< of State::links; a rope loses one in a substep, the most strained.
                                       ///< Valid until the workspace's next call
    /// One per collider that bodies pushed or pulled, in the order of State::colliders; empty unless asked
    /// for. Colliders do not feel them: they move as told. Valid until the workspace's next call.
    std::span<const ColliderImpulse> impulses{};
    Result accepted{};  ///< why nothing was done: `seconds` was not 0 to 1e9, or the workspace moved from
};

struct AdvanceOptions {
    std::uint64_t max_substeps = std::uint64_t{1} << 40;  ///< more are dropped and counted
    /// Fills Advance::impulses; up to 9 % more work if everything rests on colliders.
    bool impulses = false;
};

class World {
  public:
    World() = default;
    World(const World&) = default;
    World(World&&) noexcept = default;
    /// Allocates nothing if this world has been as large as the other.
    World& operator=(const World& other);
    World& operator=(World&&) noexcept = default;
    ~World() = default;
    /// Refuses an inconsistent state: lists of different lengths, links to missing particles, numbers out of
    /// range, duplicate handles. O(n).
    static Expected<World> from_state(State state);

    const State& state() const noexcept { return state_; }
    const Settings& settings() const noexcept { return state_.settings; }
    Result set_settings(const Settings& settings) noexcept;

    void clear() noexcept;  ///< removes all bodies, ties and colliders; keeps the settings
    Expected<BodyId> add_rope(const RopeShape& shape);
    Expected<BodyId> add_cloth(const ClothShape& shape);
    Expected<BodyId> add_hair(const HairShape& shape);
    Result remove(BodyId body) noexcept;
    /// Translates a body with its pins; velocities and tensions stay. Ties draw it back to other bodies, and
    /// a collider that it is moved into pushes it out. Refuses a body that is attached to a collider.
    Result move(BodyId body, const glm::dvec3& by) noexcept;

    /// Null if there is none. The pointer is valid until a body is added or removed.
    const Body* find(BodyId body) const noexcept;
    /// The index of a body's particle in the world, valid until an earlier body is removed.
    Expected<std::size_t> particle(BodyId body, std::size_t index) const noexcept;

    /// Pins a particle and moves it evenly to `at` in the next `seconds` of simulated time; 0: within the
    /// next substep.
    Result pin(std::size_t particle, const glm::dvec3& at, double seconds = 0.0);
    /// Pins a particle where it is; it then moves with the collider.
    Result attach(std::size_t particle, ColliderId collider);
    Result unpin(std::size_t particle) noexcept;
    bool pinned(std::size_t particle) const noexcept;

    /// Cuts a rope in two: removes segment `segment`. The part behind it becomes a new rope, which is
    /// returned.
    Expected<BodyId> cut(BodyId rope, std::size_t segment);

    // A body's material can change at any time; the body continues from its current state. For its resolution
    // see tendril/rope/edit.hpp.
    Result set_radius(BodyId body, float metres) noexcept;
    /// Scales the particles' masses so that their sum is `kilograms`, over 0 to 1e18.
    Result set_mass(BodyId body, double kilograms) noexcept;
    double mass(const Body& body) const noexcept;
    /// Density of its material, min_density to 1e9: kg/m of a rope or strand, kg/m^2 of a cloth.
    Result set_density(BodyId body, double density);
    /// 0 for a body of length 0. Pieces of a cut rope keep the mass of their particles and read denser.
    double density(const Body& body) const;
    Result set_friction(BodyId body, std::optional<float> friction) noexcept;  ///< empty: the settings'
    /// Bending stiffness of a rope, N m^2, 0 to max_magnitude.
    Result set_bending(BodyId rope, float stiffness) noexcept;
    /// Strain at which the body's links tear; 0: never.
    Result set_tear(BodyId body, float tear) noexcept;
    /// Compliance of its links of one kind, 0 to 1e9. Stretch: the material's, in addition to the settings':
    /// strain per newton, 1/N, of a rope, a strand, or a strip of cloth a metre wide. Shear and bend: m/N of
    /// each link.
    Result set_compliance(BodyId body, Link::Kind kind, double compliance);
    double compliance(const Body& body, Link::Kind kind) const;  ///< from the first such link
    /// Length of a rope, a row of a cloth, or a strand of hair, metres: all its links and its mass change in
    /// proportion; a weight on a particle of a rope stays. Refused for a body of length 0.
    Result set_length(BodyId body, float metres);
    /// The same across the rows of a cloth.
    Result set_width(BodyId cloth, float metres);
    double width(const Body& body) const;  ///< metres; 0 unless a cloth

    /// Ties two particles, of one body or of two. A tie is gone once it tears or one of its bodies is
    /// removed; after a cut it stays on its particles. Refuses a particle tied to itself.
    Expected<TieId> tie(std::size_t a, std::size_t b, const TieShape& shape = {});
    Result set_tie(TieId tie, const TieShape& shape) noexcept;
    Result untie(TieId tie) noexcept;
    const Tie* find(TieId tie) const noexcept;

    /// Sets whether two bodies, ropes or cloth, collide, or one with itself. By default they do not. See
    /// collision.hpp.
    Result set_collides(BodyId a, BodyId b, bool on);
    bool collides(BodyId a, BodyId b) const noexcept;

    Expected<ColliderId> add_collider(const Shape& shape);
    /// Moves a collider evenly to `to` in the next `seconds` of simulated time, 0: within the next substep.
    /// It pushes bodies in its way.
    Result move_collider(ColliderId collider, const glm::vec3& to, double seconds = 0.0) noexcept;
    /// The same for both ends of a capsule, each along a straight line, so that it turns. The radius of `to`
    /// applies at once.
    Result move_capsule(ColliderId capsule, const Capsule& to, double seconds = 0.0) noexcept;
    /// Moves and turns a collider steadily, in addition to the above, until the next call. A plane stays in
    /// place and its surface moves along itself: a conveyor belt, a ground that passes by.
    Result drive_collider(ColliderId collider, const Drive& drive) noexcept;
    Result set_collider(ColliderId collider, const Shape& shape) noexcept;  ///< takes effect at once
    /// Also unpins the particles attached to it.
    Result remove_collider(ColliderId collider) noexcept;
    const Collider* find(ColliderId collider) const noexcept;

    /// Lets `seconds` pass, 0 to 1e9; time over settings().longest_frame is dropped and counted.
    Advance advance(double seconds, Workspace& workspace, const AdvanceOptions& options = {});

    /// Seconds that have passed since the last substep: at least 0, less than a substep.
    double pending() const noexcept;
    /// Positions of the particles from `first` on at the end of the frame, pending() after the last substep.
    /// Elements past the last particle stay unwritten. Pins are exactly where their moves put them then; free
    /// particles continue as in the last substep, but no deeper into colliders. Without pending time these
    /// are the state's positions. O(particles x colliders).
    void pose(std::span<glm::dvec3> particles, std::size_t first = 0) const noexcept;
    /// The same for a collider.
    Shape pose(const Collider& collider) const noexcept;

    std::size_t size() const noexcept { return state_.position.size(); }
    const glm::dvec3& position(std::size_t particle) const noexcept { return state_.position[particle]; }
    glm::dvec3 velocity(std::size_t particle) const noexcept;  ///< m/s
    /// Maximum relative length error of a body's stretch links as they are now. Includes the effect of
    /// depenetration, which Body::stretch does not.
    double length_error(const Body& body) const noexcept;
    double length_error() const noexcept;  ///< maximum over all bodies
    /// Kinetic, potential and elastic energy, joules, halfway through the last substep, where a leapfrog step
    /// conserves it. Potential energy is 0 at the origin.
    double energy(const Body& body) const noexcept;
    double energy() const noexcept;  ///< sum over all bodies
    /// The sum of a body's rest lengths, metres; for cloth and hair, of one row or strand.
    double length(const Body& body) const;

  private:
    Body* found(BodyId body) noexcept;
    Collider* found(ColliderId collider) noexcept;
    void take_stretch(Body& body) noexcept;
    void scale_mass(const Body& body, double factor) noexcept;
    void lengthen_mass(const Body& rope, std::span<const double> along, double ratio) noexcept;
    Result scale(BodyId body, const char* operation, float metres, bool rows);

    State state_;
};

}  // namespace tendril::rope
