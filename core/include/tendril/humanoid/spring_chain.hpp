// Spring bones: what no bone of the body moves, ears, antennae, a tail, trails behind what it hangs on.
//
//     Expected<SpringChain> ear = SpringChain::make(skeleton, map, *skeleton.find("ear_l"));
//     SpringChainState state;                                 // a value: save it, put it back
//     ... each frame, last of all that changes the pose:
//     const SpringReport report = ear->step(pose, {.strength = 4.0}, dt, state);
//
// Method: the tip of each bone, where its child begins, is a mass on a damped spring towards the place where
// the pose has it, and the bone turns by the shortest arc to where the masses at its ends lead (the idea of
// VRM's spring bones: VRM Consortium, "VRMC_springBone-1.0", 2022, which steps bone after bone by Verlet's
// rule). Here no mass depends on another one, so the swing of a long chain does not grow from bone to bone;
// the springs are stiffer towards the base, so that a chain whose base speeds up bends as a beam does under
// its own weight (by Euler's and Bernoulli's formula). Each step is the spring's closed form
// (signal/spring.hpp) for a place that moves evenly within it, with the damping against that motion: any dt
// is stable, frame rates make little difference, an even motion is followed without lag, and what swings a
// chain is that its base speeds up, slows down or turns.
//
// Only rotations change: lengths stay as they are. A weight of 0 gives the pose back to the bit.
//
// Cost: some 0.5 µs a bone. Nothing is allocated but the state, in its first step.
#pragma once

#include <memory>

#include "tendril/humanoid/bone_map.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::humanoid {

struct SpringOptions {
    /// Hz: the frequency of the tip without damping; 0.01 to 100. A joint a fraction s along the chain has
    /// strength / sqrt(s^2 (6 - 4 s + s^2) / 3).
    double strength = 2.0;
    double critical_damping = 0.3;  ///< 0 swings for ever, 1 is the fastest that never overshoots; 0 to 10
    double weight = 1.0;            ///< 0 to 1: how much of its swing the chain shows
    double max_angle =
        1.0471975511965976;  ///< radians, by which a bone turns against the pose at most; 0 to 3.14
    rig::Transform root{};   ///< where the character stands, as FeetOptions::root
    bool operator==(const SpringOptions&) const = default;
};
/// Names the member that is out of its range.
Result check(const SpringOptions& options) noexcept;

/// Metres and m/s, in the space that `root` stands in.
struct SpringMass {
    glm::dvec3 position{0.0}, velocity{0.0};
    glm::dvec3 target{0.0};     ///< where the pose had it
    bool started = false;       ///< false: the next step puts it to its target
    bool has_velocity = false;  ///< false: the next step gives it its target's
    bool operator==(const SpringMass&) const = default;
};
struct SpringChainState {
    std::vector<SpringMass> masses{};  ///< of the tips of bones()
    bool operator==(const SpringChainState&) const = default;
};

struct SpringReport {
    /// False: a pose or options that are not finite or out of their ranges; nothing has changed.
    bool valid = true;
    double angle = 0.0;  ///< radians, between the pose and the bone that swings farthest, at weight 1
    double speed = 0.0;  ///< m/s, of the fastest mass against its target; 0 where no time passes
};

/// Made once for a character. step() works in memory of its own: one object a thread.
class SpringChain {
  public:
    /// m/s. What is faster was put elsewhere: it starts anew, at rest against the pose.
    static constexpr double max_speed = 1e3;

    /// The node and all that hangs on it; `root` moves too, about its own joint. Refuses a node that is not
    /// there or hangs on nothing, one that is a bone of the body or above one, and one without any length.
    static Expected<SpringChain> make(const Skeleton& skeleton, const BoneMap& map, std::size_t root);
    ~SpringChain();
    SpringChain(SpringChain&&) noexcept;
    SpringChain& operator=(SpringChain&&) noexcept;

    /// The nodes that turn, each after its parent; one mass each.
    std::span<const std::size_t> bones() const noexcept;

    /// `pose` is corrected in place: local transforms of all nodes. A dt that is not over 0 lets no time
    /// pass: the masses stay where they are. The first step starts at rest, as does one with a state
    /// of another size.
    SpringReport step(std::span<rig::Transform> pose, const SpringOptions& options, double dt,
                      SpringChainState& state) noexcept;
    /// The character was put into another pose or place, in no time: the masses go along,
    /// as far off their targets as they were, and swing on from there; one whose target has not moved
    /// keeps its velocity. Else as step().
    SpringReport teleport(std::span<rig::Transform> pose, const SpringOptions& options,
                          SpringChainState& state) noexcept;

  private:
    struct Plan;
    explicit SpringChain(std::unique_ptr<Plan> plan) noexcept;
    std::unique_ptr<Plan> plan_;
};

}  // namespace tendril::humanoid
