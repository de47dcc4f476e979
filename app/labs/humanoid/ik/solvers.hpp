// The library's solvers for the lab's character, cached until character, bone map or limits change; and foot
// IK's state at each moment of a clip.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/balance.hpp>
#include <tendril/humanoid/feet.hpp>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/springs/springs.hpp"

namespace tendril::app {

class Solvers;

/// The state of foot IK at each moment of a clip.
///
/// Corrected feet depend on earlier frames: hips ease, and feet stay where they were put down. A moment must
/// look the same whether played, scrubbed to or exported, so its past is always the same: the clip from its
/// start, in steps of a tick at the recorded speed. From the second block of `block_ticks` on, the past
/// begins one block earlier, which bounds the work. Only a foot that stood for half a minute differs.
///
/// Cost: a moment after the last one takes one step, some 50 µs; any other in the same blocks at most
/// `ticks_apart`; the first one after a change of settings all since the start, up to 0.2 s after a minute.
class FeetHistory {
  public:
    static constexpr std::int64_t block_ticks = 1800;  ///< 30 s
    static constexpr std::int64_t ticks_apart = 16;    ///< between stored states

    /// The deepest that a foot was in the ground in the last `lately` ticks.
    struct Deepest {
        std::size_t side = 0;  ///< 0 is left
        double depth = 0.0;    ///< metres
        double late = 0.0;     ///< the distance it still had to rise then, metres
        bool operator==(const Deepest&) const = default;
    };
    static constexpr std::int64_t lately = 120;

    struct Before {
        humanoid::FeetState state{};
        Deepest deepest{};
        double dt = 0.0;  ///< seconds from there to the moment; 0: no earlier state
    };
    /// The state before the part's moment, to step from. Needs feet. The rest pose has no past.
    Before before(const HumanoidPart& part, Solvers& solvers);

    /// The deeper of the two feet.
    static Deepest deepest_of(const humanoid::FeetReport& report);

  private:
    struct Of {
        SharedCharacter loaded;
        std::shared_ptr<const humanoid::BoneMap> map;
        std::optional<std::size_t> clip;
        bool in_place = false;
        glm::dvec3 pace{0.0};
        GroundSetting ground;
        FootIkSetting foot_ik;
        bool operator==(const Of&) const = default;
    };
    /// States from a tick on, step by step.
    struct Past {
        std::vector<humanoid::FeetState> kept{};  // every ticks_apart
        std::vector<Deepest> deepest{};           // at each tick
        humanoid::FeetState last{};
        std::int64_t tick = -1;  // of `last`, since this past began
    };
    humanoid::FeetState at(std::int64_t tick, std::int64_t begin, const HumanoidPart& part, Solvers& solvers);

    Of of_{};
    std::map<std::int64_t, Past> pasts_;  // by first tick
};

class LimitRanges;

class Solvers {
  public:
    Solvers();
    ~Solvers();
    Solvers(const Solvers&) = delete;
    Solvers& operator=(const Solvers&) = delete;

    /// Null if the map cannot be solved; why_no_body() then has the reason.
    humanoid::Body* body(const HumanoidPart& part);
    /// "LeftHand and RightHand are missing"; empty if there is a body.
    const std::string& why_no_body(const HumanoidPart& part);
    /// With the chosen clip's soles. Null if the map has no legs that can be solved.
    const humanoid::Feet* feet(const HumanoidPart& part);
    /// Null if there is no body, or no feet.
    const humanoid::Masses* masses(const HumanoidPart& part);
    /// Null if the map does not describe a body; why_no_body() then has the reason.
    const humanoid::Hands* hands(const HumanoidPart& part);
    const humanoid::LookAt* look_at(const HumanoidPart& part);
    /// In the order of the part's springs; null if the bone map leaves no room: see why_no_spring().
    const SpringChains& springs(const HumanoidPart& part);
    /// In the order of the part's curves; null if the character has no such chain.
    const BentChains& curves(const HumanoidPart& part);
    /// Empty if there are feet.
    const std::string& why_no_feet(const HumanoidPart& part);
    /// Height of the clip's own floor, metres; empty for the rest pose.
    std::optional<double> floor(const HumanoidPart& part);
    /// The speed of each foot while it is low over the clip's floor, and of the hips.
    struct Gait {
        std::array<double, 2> slide{};  ///< m/s, median of the toe; left, right. 0 if it is never low
        double travel = 0.0;            ///< m/s
        glm::dvec3 pace{0.0};           ///< see pace_of()
    };
    /// Null for the rest pose, or without feet.
    const Gait* gait(const HumanoidPart& part);
    /// The capsules that self-collision keeps apart; empty if it is off.
    const std::vector<humanoid::BodyCapsule>& capsules(const HumanoidPart& part);
    /// The volume of the mapped bones, which attachments rest on.
    const std::vector<humanoid::BodyCapsule>& volume(const HumanoidPart& part);
    const humanoid::Ground& ground(const HumanoidPart& part);
    FeetHistory& feet_history() { return feet_history_; }
    /// The available ranges of joint limits.
    const LimitRanges& limits(const HumanoidPart& part);

  private:
    struct Made {
        SharedCharacter loaded;
        std::shared_ptr<const humanoid::BoneMap> map;
        LimitsFrom limits = LimitsFrom::Defaults;
        std::map<humanoid::Bone, LimitsFrom> joint_limits{};
        bool self_collision = false;
        bool operator==(const Made&) const = default;
    };
    void make(const HumanoidPart& part);

    Made made_{};
    std::optional<humanoid::Body> body_;
    std::vector<humanoid::BodyCapsule> capsules_;
    std::optional<std::vector<humanoid::BodyCapsule>> volume_;
    std::optional<humanoid::Feet> feet_;                              // of the rest pose
    std::map<std::size_t, std::optional<humanoid::Feet>> clip_feet_;  // by clip; none: as at rest
    std::optional<humanoid::Masses> masses_;
    std::optional<humanoid::Hands> hands_;
    std::optional<humanoid::LookAt> look_at_;
    std::vector<std::string> spring_nodes_;
    SpringChains springs_;
    SharedCharacter curves_of_;
    std::vector<std::pair<std::string, std::string>> curve_ends_;
    BentChains curves_;
    std::string why_not_, why_no_feet_;
    std::map<std::size_t, double> floors_;  // by clip
    std::map<std::size_t, Gait> gaits_;     // by clip
    std::optional<GroundSetting> ground_of_;
    humanoid::Ground ground_;
    FeetHistory feet_history_;
    std::unique_ptr<LimitRanges> ranges_;
};

// A body's chains in the order of solving: layer 0 the hips, 1 legs and spine, 2 arms, neck and head.

struct BodyChain {
    int layer = 0;
    std::vector<humanoid::Bone> bones;  ///< mapped bones, from the hips outwards
    humanoid::Bone end = humanoid::Bone::Hips;
};

/// Empty if the map is not usable.
std::vector<BodyChain> body_chains(const humanoid::BoneMap& map);

}  // namespace tendril::app
