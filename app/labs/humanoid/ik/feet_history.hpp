// The state of foot IK at each moment of a clip.
//
// Corrected feet depend on earlier frames: hips ease, and feet stay where they were put down. For a moment to
// look the same whether played, scrubbed to or exported, its past is always the same: the clip from its
// start, in steps of a tick at the recorded speed. From the second block of `block_ticks` on, the past begins
// one block earlier, which bounds the work. Only a foot that has not left the ground for half a minute
// differs.
//
// Cost: a moment after the last one takes one step, some 50 µs; another in the same blocks at most
// `ticks_apart`; the first one with other settings all since the start, up to 0.2 s after a minute.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <tendril/humanoid/feet.hpp>
#include <vector>

#include "app/labs/humanoid/humanoid_part.hpp"

namespace tendril::app {

class Solvers;

class FeetHistory {
  public:
    static constexpr std::int64_t block_ticks = 1800;  ///< 30 s
    static constexpr std::int64_t ticks_apart = 16;    ///< between stored states

    /// The deepest that a foot was in the ground in the last `lately` ticks.
    struct Deepest {
        std::size_t side = 0;  ///< 0 is left
        double depth = 0.0;    ///< metres
        double late = 0.0;     ///< how far it still had to rise then, metres
        bool operator==(const Deepest&) const = default;
    };
    static constexpr std::int64_t lately = 120;

    struct Before {
        humanoid::FeetState state{};
        Deepest deepest{};
        double dt = 0.0;  ///< seconds from there to the moment; 0: nothing came before
    };
    /// The state from which to step to the part's moment. Needs feet. The rest pose has no past.
    Before before(const HumanoidPart& part, Solvers& solvers);

    /// The deeper of both feet.
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
    /// The states since a tick, step by step.
    struct Past {
        std::vector<humanoid::FeetState> kept{};  // every ticks_apart
        std::vector<Deepest> deepest{};           // at each tick
        humanoid::FeetState last{};
        std::int64_t tick = -1;  // of `last`, since the beginning of this past
    };
    humanoid::FeetState at(std::int64_t tick, std::int64_t begin, const HumanoidPart& part, Solvers& solvers);

    Of of_{};
    std::map<std::int64_t, Past> pasts_;  // by their first tick
};

}  // namespace tendril::app
