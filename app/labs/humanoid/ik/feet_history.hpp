// What foot IK remembers at each moment of a clip.
//
// The corrected feet depend on what went before: hips ease, and feet stay where they were put down. So that a
// moment looks the same whether it is played, scrubbed to or exported, its past is always the same one: the
// clip from its start, in steps of a tick at the recorded speed. From the second block of `block_ticks` on,
// the past begins a block before the moment's own, which bounds the work. Only a foot that has not left the
// ground for half a minute would notice.
//
// Cost: a moment that follows the last one takes one step, some 50 µs; any other in the same blocks at most
// `ticks_apart`; the first one of other settings all since the start, up to 0.2 s after a minute.
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
    static constexpr std::int64_t ticks_apart = 16;    ///< between the states that are kept

    /// The deepest that a foot has been in the ground lately: in the last `lately` ticks.
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
    /// The state that the step to the part's moment starts from. Needs feet. The rest pose has no past.
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
    /// The states since a tick, in steps.
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
