// The feet of many characters in one call, spread over threads.
//
//     std::vector<FeetJob> jobs;  // one per character, made once
//     jobs.push_back({.feet = &feet, .pose = pose, .state = &state});
//     ... each frame, after sampling the clips into the poses:
//     step_many(jobs, ground, dt, {.threads = 4});
//
// The results are bit-identical to separate calls of Feet::step(), on any number of threads.
//
// Cost: the sum of the steps; 1 000 characters walking on stairs take 4 ms on one core.
#pragma once

#include "tendril/humanoid/feet.hpp"
#include "tendril/tasks.hpp"

namespace tendril::humanoid {

struct FeetJob {
    const Feet* feet = nullptr;
    std::span<rig::Transform> pose{};  ///< not shared with another job
    FeetState* state = nullptr;        ///< not shared with another job
    FeetOptions options{};
    FeetReport report{};  ///< the result; refused if `feet` or `state` is null
};

struct FeetManyOptions {
    /// 1 to 256, including the calling thread. Ignored if `tasks` is set.
    int threads = 1;
    Tasks tasks{};
};

void step_many(std::span<FeetJob> jobs, const Ground& ground, double dt,
               const FeetManyOptions& options = {}) noexcept;

}  // namespace tendril::humanoid
