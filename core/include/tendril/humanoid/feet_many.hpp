// The feet of many characters in one call, spread over threads.
//
//     std::vector<FeetJob> jobs;  // one a character, made once
//     jobs.push_back({.feet = &feet, .pose = pose, .state = &state});
//     ... each frame, with the poses as the clips have them:
//     step_many(jobs, ground, dt, {.threads = 4});
//
// Every character is what Feet::step() makes of it alone, to the bit, on any number of threads.
//
// Cost: that of the steps; 1 000 characters walking on stairs take 4 ms on one core.
#pragma once

#include "tendril/humanoid/feet.hpp"
#include "tendril/tasks.hpp"

namespace tendril::humanoid {

struct FeetJob {
    const Feet* feet = nullptr;
    std::span<rig::Transform> pose{};  ///< of this character alone
    FeetState* state = nullptr;        ///< too
    FeetOptions options{};
    FeetReport report{};  ///< what came of it; invalid where feet or state are missing
};

struct FeetManyOptions {
    /// 1 to 256 of the library's own, the caller's among them; where `tasks` is given it decides instead.
    int threads = 1;
    Tasks tasks{};
};

void step_many(std::span<FeetJob> jobs, const Ground& ground, double dt,
               const FeetManyOptions& options = {}) noexcept;

}  // namespace tendril::humanoid
