#include "ik/solve/plane.hpp"

#include <algorithm>
#include <cmath>

#include "ik/limits/pose.hpp"
#include "ik/math.hpp"
#include "ik/pole/pole.hpp"
#include "ik/solve/loop.hpp"
#include "ik/solve/prepare.hpp"

namespace tendril::ik {

namespace detail {
namespace {

glm::dvec3 base_of(const glm::dvec3& normal, const glm::dvec3& rest) noexcept {
    return direction_of(math::across(rest, normal), 1e-4).value_or(perpendicular(normal));
}

/// Reports in world space the steps of a solve in the plane's coordinates.
class PlaneObserver final : public Observer {
  public:
    PlaneObserver(const PlaneFrame& frame, Observer& to) noexcept : frame_(frame), to_(to) {}
    void step(const Step& step) noexcept override {
        Step shown = step;
        shown.from = frame_.world(step.from);
        shown.to = frame_.world(step.to);
        to_.step(shown);
    }
    void iteration_done(int iteration, float residual) noexcept override {
        to_.iteration_done(iteration, residual);
    }

  private:
    const PlaneFrame& frame_;
    Observer& to_;
};

}  // namespace

PlaneFrame::PlaneFrame(const glm::vec3& root, const glm::vec3& normal, const glm::vec3& rest) noexcept
    : root_(wide(root)) {
    normal_ = times(wide(normal), 1.0 / length(wide(normal)));
    along_ = base_of(normal_, wide(rest));
    across_ = cross(along_, normal_);
}

PlaneFrame PlaneFrame::at(const glm::vec3& root) const noexcept {
    PlaneFrame other = *this;
    other.root_ = wide(root);
    return other;
}

glm::vec3 PlaneFrame::local(const glm::vec3& point) const noexcept {
    const glm::dvec3 arm = minus(wide(point), root_);
    return {static_cast<float>(dot(arm, along_)), 0.0f, static_cast<float>(dot(arm, across_))};
}

glm::dvec3 PlaneFrame::in_world(const glm::vec3& vector) const noexcept {
    const glm::dvec3 v = wide(vector);
    return plus(times(along_, v.x), times(across_, v.z));
}

glm::vec3 PlaneFrame::world(const glm::vec3& point) const noexcept {
    return narrow(plus(root_, in_world(point)));
}

glm::vec3 PlaneFrame::local_vector(const glm::vec3& vector) const noexcept {
    const glm::dvec3 v = wide(vector);
    return {static_cast<float>(dot(v, along_)), 0.0f, static_cast<float>(dot(v, across_))};
}

glm::vec3 PlaneFrame::world_vector(const glm::vec3& vector) const noexcept {
    return narrow(in_world(vector));
}

double PlaneFrame::off(const glm::vec3& point) const noexcept {
    return dot(minus(wide(point), root_), normal_);
}

glm::vec3 PlaneFrame::returned(const glm::vec3& local_joint, const glm::vec3& was,
                               float reach) const noexcept {
    const glm::vec3 to{local_joint.x, 0.0f, local_joint.z};
    const double size =
        std::max({static_cast<double>(reach), std::abs(root_.x), std::abs(root_.y), std::abs(root_.z)});
    return to == local(was) && std::abs(off(was)) <= 2e-7 * size ? was : world(to);
}

PlaneProblem::PlaneProblem(Workspace& scratch, std::span<glm::vec3> joints, State& state,
                           const glm::vec3& target, const Options& options) noexcept
    : scratch_(scratch),
      joints_(joints),
      state_(state),
      target_(target),
      given_(options),
      frame_(joints.front(), options.plane->normal, scratch.rest_directions.front()),
      options_(local_options()),
      problem_{scratch.plane.joints,
               frame_.local(target),
               options.tolerance.value_or(1e-3f * scratch.reach),
               options_,
               scratch,
               scratch.plane.state} {
    std::swap(scratch_.rest_directions, scratch_.plane.rest_directions);
    std::transform(joints.begin(), joints.end(), problem_.joints.begin(),
                   [this](const glm::vec3& joint) { return frame_.local(joint); });
    choose_side();
    State& local = problem_.state;
    local.reset();
    if (options_.limits.empty()) return;
    static_cast<void>(load_limits(scratch_, options_.limits, true));
    LimitedScratch& limited = scratch_.limited;
    for (std::size_t i = 0; i < problem_.bones(); ++i) {
        limited.limits[i].from_base = given_.plane->limits[i].from == AngleFrom::Base;
        // Angles follow from the joints, so no rotations need to be remembered.
        const glm::vec3 along{1.0f, 0.0f, 0.0f};
        const glm::vec3 bone = math::direction(problem_.joints[i], problem_.joints[i + 1],
                                               i > 0 ? rotated(local.rotations[i - 1], along) : along);
        local.rotations[i] = minimal_rotation(along, bone);
    }
    local.limits = state.limits;
    local.limits.target = frame_.local_vector(state.limits.target);
}

PlaneProblem::~PlaneProblem() {
    std::swap(scratch_.rest_directions, scratch_.plane.rest_directions);
}

/// The options in the plane's coordinates, except the side.
Options PlaneProblem::local_options() noexcept {
    Options options = given_;
    options.plane->normal = {0.0f, 1.0f, 0.0f};
    options.pole.reset();
    options.pole_turn = PoleTurn::WholeChain;
    options.twist = 0.0f;
    const std::span<const AngleLimit> limits = given_.plane->limits;
    if (!limits.empty()) {
        std::transform(limits.begin(), limits.end(), scratch_.plane.limits.begin(),
                       [](const AngleLimit& each) {
                           return Limit::hinge({0.0f, 1.0f, 0.0f}, each.min, each.max);
                       });
        options.limits = scratch_.plane.limits;
    }
    if (given_.tip_orientation) {
        const glm::vec3 bone =
            frame_.local_vector(rotated(*given_.tip_orientation, scratch_.rest_directions.back()));
        const float size = length(bone);
        const glm::vec3 along{1.0f, 0.0f, 0.0f};
        options.tip_orientation = minimal_rotation(along, size > 1e-4f ? times(bone, 1.0f / size) : along);
    }
    return options;
}

/// Chooses the pole's side of the line from root to target; without a pole, the requested side; without
/// either, the side that the chain is on, or was on.
void PlaneProblem::choose_side() noexcept {
    Side& side = options_.plane->bend;
    if (given_.pole) {
        const glm::vec3 pole = frame_.local(*given_.pole), target = problem_.target;
        const float left = pole.x * target.z - pole.z * target.x;
        if (std::abs(left) > 1e-6f * length(pole) * length(target))
            side = left > 0.0f ? Side::Left : Side::Right;
    }
    if (side == Side::Free) side = planar_side(problem_);
    if (side == Side::Free) side = state_.side;
    if (side == Side::Free) side = Side::Left;
}

Report PlaneProblem::solve(Method method, Observer* observer) noexcept {
    int order = 0;
    Report report;
    if (observer) {
        PlaneObserver shown(frame_, *observer);
        report = run_weighted(method, problem_, Watched(shown, order));
    } else {
        report = run_weighted(method, problem_, Unwatched());
    }
    report.off_plane = static_cast<float>(std::abs(frame_.off(target_)));
    const Side now = planar_side(problem_);
    state_.side = now == Side::Free ? options_.plane->bend : now;
    state_.pole.valid = false;
    state_.limits = problem_.state.limits;
    state_.limits.target = frame_.world_vector(problem_.state.limits.target);
    return_joints();
    return report;
}

void PlaneProblem::return_joints() noexcept {
    for (std::size_t i = 1; i < joints_.size(); ++i)
        joints_[i] = frame_.returned(problem_.joints[i], joints_[i], scratch_.reach);
    if (!given_.rotations && given_.weight == 1.0f && !given_.tip_orientation) return;
    std::swap(scratch_.rest_directions, scratch_.plane.rest_directions);
    Problem whole{joints_, target_, problem_.tolerance, given_, scratch_, state_};
    transport_rotations(whole);
    std::swap(scratch_.rest_directions, scratch_.plane.rest_directions);
}

}  // namespace detail

glm::vec3 base_direction(glm::vec3 normal, glm::vec3 rest_direction) noexcept {
    using namespace detail;
    const glm::dvec3 n = wide(normal), rest = wide(rest_direction);
    return narrow(base_of(times(n, 1.0 / length(n)), times(rest, 1.0 / length(rest))));
}

}  // namespace tendril::ik
