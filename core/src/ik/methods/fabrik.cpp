// FABRIK: A. Aristidou, J. Lasenby, "FABRIK: A fast, iterative solver for the inverse kinematics problem",
// Graphical Models 73(5), 2011.
#include "ik/methods/methods.hpp"

#include "ik/math.hpp"
#include "ik/tunables.hpp"

namespace tendril::ik::detail {
namespace {

using namespace tune::chain;

constexpr glm::vec3 fallback{1.0f, 0.0f, 0.0f};  ///< direction if two joints coincide

template <class Watch>
void forward_reaching(Problem& problem, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    const std::span<const float> lengths = problem.lengths();
    glm::vec3 at = problem.target;
    watch.moved(problem.iteration, Phase::ForwardReaching, problem.bones(), no_joint, joints.back(), at);
    watch.next_step();
    joints.back() = at;
    for (std::size_t i = problem.bones(); i-- > 0;) {
        at = step(at, joints[i], lengths[i], fallback);
        watch.moved(problem.iteration, Phase::ForwardReaching, i, i + 1, joints[i], at);
        watch.next_step();
        joints[i] = at;
    }
}

template <class Watch>
void backward_reaching(Problem& problem, const glm::vec3& root, Watch watch) noexcept {
    const std::span<glm::vec3> joints = problem.joints;
    const std::span<const float> lengths = problem.lengths();
    glm::vec3 at = root;
    watch.moved(problem.iteration, Phase::BackwardReaching, 0, no_joint, joints.front(), at);
    watch.next_step();
    joints.front() = at;
    for (std::size_t i = 1; i < joints.size(); ++i) {
        at = step(at, joints[i], lengths[i - 1], fallback);
        watch.moved(problem.iteration, Phase::BackwardReaching, i, i - 1, joints[i], at);
        watch.next_step();
        joints[i] = at;
    }
}

}  // namespace

template <class Watch>
void fabrik_iteration(Problem& problem, Watch watch) noexcept {
    const glm::vec3 root = problem.root();
    forward_reaching(problem, watch);
    backward_reaching(problem, root, watch);
}

template <class Watch>
void accelerated_fabrik_iteration(Problem& problem, Watch watch) noexcept {
    fabrik_iteration(problem, watch);
    const bool its_turn = problem.bones() >= few_bones || problem.iteration % 2 == 0;
    const float residual = distance(problem.joints.back(), problem.target);
    if (its_turn && !(residual <= problem.tolerance)) accelerate(problem, residual, watch);
}

template void fabrik_iteration(Problem&, Unwatched) noexcept;
template void fabrik_iteration(Problem&, Watched) noexcept;
template void accelerated_fabrik_iteration(Problem&, Unwatched) noexcept;
template void accelerated_fabrik_iteration(Problem&, Watched) noexcept;

}  // namespace tendril::ik::detail
