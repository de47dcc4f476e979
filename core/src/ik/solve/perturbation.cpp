#include "ik/solve/perturbation.hpp"

#include <cfloat>
#include <cstdint>

#include "ik/math.hpp"
#include "ik/pole/pole.hpp"
#include "ik/tunables.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::chain;

bool is_near_line(const glm::vec3& arm, const glm::vec3& line, float near) noexcept {
    const glm::vec3 off = cross(arm, line);
    return dot(off, off) <= near * near;
}

/// Turns each bone towards `by(i)`, scaled to its length, and places the bones from the root on.
template <class Watch, class By>
void bend_bones(Problem& problem, int iteration, Watch watch, By by) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    glm::vec3 old = problem.root();
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const float size = problem.lengths()[i];
        const glm::vec3 bone = plus(minus(joints[i + 1], old), times(by(i), size));
        old = joints[i + 1];
        const float squared = dot(bone, bone);
        const float scale = squared > FLT_MIN ? size / std::sqrt(squared) : 0.0f;
        joints[i + 1] = squared > FLT_MIN ? moved(joints[i], bone, scale)
                                          : moved(joints[i], problem.scratch.rest_directions[i], size);
        watch.moved(iteration, Phase::Prepare, i + 1, i, old, joints[i + 1]);
    }
    watch.next_step();
}

}  // namespace

glm::vec3 line_of(const Problem& problem) noexcept {
    glm::vec3 line = minus(problem.target, problem.root());
    for (const glm::vec3& joint : problem.joints) {
        const glm::vec3 arm = minus(joint, problem.root());
        if (dot(arm, arm) > dot(line, line)) line = arm;
    }
    const float far = length(line);
    return far > FLT_MIN ? times(line, 1.0f / far) : problem.scratch.rest_directions.front();
}

float scattered(std::size_t bone, std::uint32_t salt) noexcept {
    auto bits = static_cast<std::uint32_t>(bone) * 0x9e3779b9u + salt * 0x85ebca6bu;
    bits = (bits ^ (bits >> 16)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
    return static_cast<float>((bits ^ (bits >> 16)) >> 8) * 0x1p-23f - 1.0f;
}

bool is_collinear(const Problem& problem) noexcept {
    const float near = 1e-5f * problem.scratch.reach;
    const glm::vec3 first = minus(problem.target, problem.root());
    // Most chains are bent, and three points usually show it without computing the longest line.
    if (const float far = length(first); far > 0.1f * problem.scratch.reach) {
        const glm::vec3 line = times(first, 1.0f / far);
        for (const glm::vec3& joint : problem.joints) {
            // Measured against a shorter line, the same joints may seem further off it.
            if (!is_near_line(minus(joint, problem.root()), line, 20.0f * near)) return false;
        }
    }
    const glm::vec3 line = line_of(problem);
    if (!is_near_line(first, line, near)) return false;
    for (const glm::vec3& joint : problem.joints) {
        if (!is_near_line(minus(joint, problem.root()), line, near)) return false;
    }
    return true;
}

template <class Watch>
void bend_collinear_chain(Problem& problem, Watch watch) noexcept {
    const glm::vec3 side = side_of(problem, line_of(problem));
    float before = 0.0f;
    bend_bones(problem, problem.iteration, watch, [&](std::size_t i) {
        const float size = problem.lengths()[i];
        const float middle = (before + 0.5f * size) / problem.scratch.reach;
        before += size;
        return times(side, bend_angle * (1.0f - 2.0f * middle));
    });
}

template <class Watch>
void perturb(Problem& problem, int number, Watch watch) noexcept {
    const auto salt = static_cast<std::uint32_t>(number) * 3u;
    bend_bones(problem, problem.iteration, watch, [&](std::size_t i) {
        glm::vec3 by{scattered(i, salt + 1), scattered(i, salt + 2), scattered(i, salt + 3)};
        if (problem.options.plane) by.y = 0.0f;
        return times(by, bend_angle);
    });
}

template void bend_collinear_chain(Problem&, Unwatched) noexcept;
template void bend_collinear_chain(Problem&, Watched) noexcept;
template void perturb(Problem&, int, Unwatched) noexcept;
template void perturb(Problem&, int, Watched) noexcept;

}  // namespace tendril::ik::detail
