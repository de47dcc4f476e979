// Spring bones: ears, antennae or a tail that trail behind their parent bone.
//
//     Expected<SpringChain> ear = SpringChain::make(skeleton, map, *skeleton.find("ear_l"));
//     SpringChainState state;                                 // a value: save it, put it back
//     ... each frame, after everything else that changes the pose:
//     const SpringReport report = ear->step(pose, {.strength = 4.0}, dt, state);
//
// Method: the tip of each bone, where its child begins, is a mass on a damped spring attached to its position
// in the pose, and the bone turns by the shortest arc towards the masses at its ends (as VRM's spring bones
// do: VRM Consortium, "VRMC_springBone-1.0", 2022, which integrates bone after bone by Verlet's method). Here
// the masses are independent of each other, so the swing of a long chain does not grow from bone to bone. The
// springs are stiffer towards the base, so that a chain whose base accelerates bends like a beam under its
// own weight (Euler and Bernoulli). Each step is the spring's closed form (signal/spring.hpp) for a target
// that moves at constant velocity during the step, with damping relative to that motion: any dt is stable,
// the frame rate makes little difference, and a chain follows uniform motion without lag and swings only when
// its base accelerates or turns.
//
// Colliders keep the tips out: a bone whose tip would be inside one turns about its base by the smallest
// angle that brings the tip to the surface, and its mass stays there without speed into the collider. VRM
// moves the tip straight out instead and then restores the length, which may take it back in.
//
// Only rotations change, not lengths. With a weight of 0 the pose stays bit-identical.
//
// Cost: about 0.5 µs per bone, and 20 ns per bone and collider. Allocates only the state, in its first step.
#pragma once

#include <memory>

#include "tendril/humanoid/capsules.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

struct SpringOptions {
    /// Hz: the undamped frequency of the tip; 0.01 to 100. A joint at a fraction s of the chain has
    /// strength / sqrt(s^2 (6 - 4 s + s^2) / 3).
    double strength = 2.0;
    double critical_damping = 0.3;  ///< 0 swings for ever, 1 is the fastest without overshoot; 0 to 10
    double weight = 1.0;            ///< fraction of the swing that the chain shows: 0 to 1
    /// Maximum turn of a bone from its pose, by default 60 degrees; 0 to 179. Only colliders turn it farther.
    double max_angle = 1.0471975511965976;
    double hit_radius = 0.0;  ///< metres between tips and colliders, in the character's space; 0 to 1000
    rig::Transform root{};    ///< where the character stands, as FeetOptions::root
    bool operator==(const SpringOptions&) const = default;
};
/// Names the member that is out of range.
Result check(const SpringOptions& options) noexcept;

/// Metres and m/s, in the space to which `root` maps the character.
struct SpringMass {
    glm::dvec3 position{0.0}, velocity{0.0};
    glm::dvec3 target{0.0};     ///< its position in the pose of the last step
    bool started = false;       ///< false: the next step moves it to its target
    bool has_velocity = false;  ///< false: the next step gives it its target's velocity
    bool held = false;          ///< kept out by a collider in the last step
    bool operator==(const SpringMass&) const = default;
};
struct SpringChainState {
    std::vector<SpringMass> masses{};  ///< one at the tip of each of bones()
    bool operator==(const SpringChainState&) const = default;
};

struct SpringReport {
    double angle = 0.0;  ///< maximum angle between a bone and its pose, at weight 1, radians
    double speed = 0.0;  ///< maximum speed of a mass relative to its target, m/s; 0 if no time passes
    Result accepted{};   ///< why nothing has changed: a pose, options or colliders out of range
};

/// Made once per character. step() uses internal scratch: do not share an object between threads.
class SpringChain {
  public:
    /// m/s. A faster mass counts as teleported: it restarts at rest relative to the pose.
    static constexpr double max_speed = 1e3;

    /// The node and all its descendants; `root` turns too, about its own joint. Refuses a map that fails
    /// check(), a node out of range or without a parent, one that is a bone of the body or above one, and a
    /// chain without any length.
    static Expected<SpringChain> make(const Skeleton& skeleton, const BoneMap& map, std::size_t root);
    ~SpringChain();
    SpringChain(SpringChain&&) noexcept;
    SpringChain& operator=(SpringChain&&) noexcept;

    /// The nodes that turn, each after its parent; one mass each.
    std::span<const std::size_t> bones() const noexcept;

    /// `pose` holds the local transforms of all nodes and is corrected in place. If dt is not over 0, no time
    /// passes and the masses stay where they are. The first step starts at rest, as does one with a state of
    /// another size. `colliders`: capsules, or spheres if both ends are one point, in the space of the
    /// masses. At weight 1 no tip is inside one, unless the bone is too short to reach the surface or
    /// colliders overlap; the bones between the tips may be inside.
    SpringReport step(std::span<rig::Transform> pose, const SpringOptions& options, double dt,
                      SpringChainState& state, std::span<const PlacedCapsule> colliders = {}) noexcept;
    /// Call it instead of step() when the pose or the position of the character jumps. Masses keep their
    /// offsets from their targets and swing on from there; a mass whose target has not moved keeps its
    /// velocity.
    SpringReport teleport(std::span<rig::Transform> pose, const SpringOptions& options,
                          SpringChainState& state) noexcept;

  private:
    struct Plan;
    explicit SpringChain(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid

template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::SpringOptions>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::SpringMass>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::humanoid::SpringChainState>() noexcept;
