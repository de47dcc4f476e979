#include <algorithm>
#include <cmath>

#include "ik/linkage/solve.hpp"
#include "math/checks.hpp"
#include "math/elementary.hpp"
#include "math/ranges.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik {

using tendril::detail::held_or_empty;

struct LinkageSolver::Parts : detail::LinkageWork {
    using detail::LinkageWork::LinkageWork;
};

Expected<LinkageSolver> LinkageSolver::make(const Linkage& linkage) {
    if (const Result bad = check(linkage); !bad) return bad;
    return LinkageSolver(std::make_unique<Parts>(linkage));
}

LinkageSolver::LinkageSolver(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
LinkageSolver::~LinkageSolver() = default;
LinkageSolver::LinkageSolver(LinkageSolver&&) noexcept = default;
LinkageSolver& LinkageSolver::operator=(LinkageSolver&&) noexcept = default;

const Linkage& LinkageSolver::linkage() const noexcept {
    return held_or_empty(parts_, &Parts::linkage);
}
bool LinkageSolver::planar() const noexcept {
    return !parts_ || parts_->planar;
}
double LinkageSolver::size() const noexcept {
    return parts_ ? parts_->size : 0.0;
}

LinkageState LinkageSolver::initial_state() const {
    LinkageState state;
    for (const Link& link : linkage().links)
        state.joints.push_back({link.joint == LinkJoint::Ball ? 0.0 : link.rest});
    return state;
}

namespace {

constexpr double state_limit = static_cast<double>(max_magnitude);

bool fits(const LinkageState& state, const detail::LinkageWork& work) noexcept {
    return state.joints.size() == work.linkage.links.size() &&
           std::ranges::all_of(state.joints, [](const JointPlace& each) {
               const glm::dquat& q = each.turn;
               return std::abs(each.value) <= state_limit && std::abs(each.last) <= 2.0 * state_limit &&
                      std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-3;
           });
}

bool mark_drivers(std::span<const LinkDriver> drivers, detail::LinkageWork& work) noexcept {
    std::ranges::fill(work.driven, std::uint8_t{0});
    for (const LinkDriver& each : drivers) {
        if (each.link >= work.linkage.links.size() || !(std::abs(each.value) <= state_limit) ||
            work.linkage.links[each.link].joint == LinkJoint::Ball)
            return false;
        std::uint8_t& driven = work.driven[work.column[each.link]];
        if (driven) return false;
        driven = 1;
    }
    return true;
}

bool valid_targets(std::span<const LinkTarget> targets, const detail::LinkageWork& work) noexcept {
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const LinkTarget& each = targets[i];
        if (each.point >= work.linkage.points.size() || !(each.weight > 0.0 && each.weight <= state_limit))
            return false;
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(each.to[axis]) <= state_limit)) return false;
        for (std::size_t k = 0; k < i; ++k)
            if (targets[k].point == each.point) return false;
    }
    return true;
}

constexpr Field solver_rows[] = {
    field<&LinkageOptions::max_iterations>("max_iterations", {1, 1'000'000}),
    field<&LinkageOptions::tolerance>("tolerance", {0.0, state_limit}, "m").over(),
    index<&LinkageOptions::watched>("watched", "links")};

bool valid_options(const LinkageOptions& options, const detail::LinkageWork& work) noexcept {
    return tendril::detail::are_in_range<solver_rows>(&options) &&
           std::ranges::all_of(options.watched, [&](std::size_t each) {
               return each < work.linkage.links.size() && work.linkage.links[each].joint != LinkJoint::Ball;
           });
}

/// Loads a state: clamps joints to their ranges and normalises rotations.
void take_state(detail::LinkageWork& work, const LinkageState& state) noexcept {
    work.joints = state.joints;
    work.clamp_to_ranges();
}

}  // namespace

LinkageReport LinkageSolver::solve(LinkageState& state, const LinkageGoals& goals,
                                   const LinkageOptions& options) noexcept {
    LinkageReport report;
    if (!parts_ || !fits(state, *parts_) || !mark_drivers(goals.drivers, *parts_) ||
        !valid_targets(goals.targets, *parts_) || !valid_options(options, *parts_)) {
        report.status = LinkageStatus::InvalidInput;
        return report;
    }
    detail::LinkageWork& work = *parts_;
    take_state(work, state);
    report = detail::LinkageSolve(work, goals, options).run();
    state.joints = work.joints;
    return report;
}

bool LinkageSolver::other_mode(LinkageState& state, std::span<const LinkDriver> drivers,
                               OtherMode which) noexcept {
    if (!parts_ || !fits(state, *parts_) || !mark_drivers(drivers, *parts_)) return false;
    return parts_->columns > 0 && detail::find_other_mode(*parts_, state, drivers, which);
}

LinkageFreedom LinkageSolver::freedom(const LinkageState& state) noexcept {
    LinkageFreedom freedom;
    if (!place(state)) return freedom;
    detail::LinkageWork& work = *parts_;
    const LinkageGoals none;
    const LinkageOptions options;
    freedom.actual =
        static_cast<int>(work.columns - detail::LinkageSolve(work, none, options).closure_rank());
    freedom.counted = static_cast<int>(work.columns);
    for (const Closure& each : work.linkage.closures)
        freedom.counted -= static_cast<int>(work.equations_of(each));
    return freedom;
}

double LinkageSolver::balance(const LinkageState& state, std::size_t link, std::span<const std::size_t> held,
                              std::span<glm::dvec3> forces) noexcept {
    if (link >= linkage().links.size() || linkage().links[link].joint == LinkJoint::Ball ||
        forces.size() != linkage().closures.size() || !place(state))
        return 1.0;
    detail::LinkageWork& work = *parts_;
    const LinkageGoals none;
    const LinkageOptions options;
    detail::LinkageSolve solve(work, none, options);
    for (const std::size_t each : held)
        if (each < linkage().links.size() && each != link)
            std::fill_n(&work.driven[work.column[each]],
                        linkage().links[each].joint == LinkJoint::Ball ? 3 : 1, std::uint8_t{1});
    work.release();
    static_cast<void>(solve.closure_rank());
    std::ranges::fill(work.force, 0.0);
    work.force[work.column[link]] = 1.0;
    work.basis.multipliers(work.force, work.multiplier);
    std::ranges::fill(forces, glm::dvec3(0.0));
    for (std::size_t k = 0; k < work.basis.rank(); ++k)
        if (const std::size_t row = work.row_origin[k] % 6; row < 3)
            forces[work.row_origin[k] / 6][static_cast<int>(row)] += work.multiplier[k];
    work.basis.remove_from(work.force);
    return detail::norm_of(work.force);
}

bool LinkageSolver::place(const LinkageState& state) noexcept {
    if (!parts_ || !fits(state, *parts_)) return false;
    take_state(*parts_, state);
    parts_->move_links();
    return true;
}

std::span<const LinkPlace> LinkageSolver::links() const noexcept {
    return held_or_empty(parts_, &Parts::places);
}
glm::dvec3 LinkageSolver::point(std::size_t index) const noexcept {
    if (index >= linkage().points.size()) return glm::dvec3(0.0);
    const LinkPoint& point = parts_->linkage.points[index];
    return parts_->point_of(point.link, point.at);
}
glm::dvec3 LinkageSolver::joint(std::size_t link) const noexcept {
    return link < linkage().links.size() ? parts_->origins[link] : glm::dvec3(0.0);
}
glm::dvec3 LinkageSolver::axis(std::size_t link) const noexcept {
    return link < linkage().links.size() ? parts_->axes[link] : glm::dvec3(0.0);
}
std::span<const double> LinkageSolver::residuals() const noexcept {
    return held_or_empty(parts_, &Parts::residuals);
}
std::span<const std::size_t> LinkageSolver::active() const noexcept {
    return held_or_empty(parts_, &Parts::active);
}
std::span<const std::size_t> LinkageSolver::open_closures() const noexcept {
    return held_or_empty(parts_, &Parts::open);
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LinkageOptions>() noexcept {
    return ik::solver_rows;
}
