#include <algorithm>
#include <cmath>

#include "ik/linkage/solve.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "math/ranges.hpp"
#include "tendril/elementary.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik {

using namespace tendril::detail;

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
constexpr const char* within_limit = "finite and at most 1e9 in magnitude";

Result check_state(const char* op, const LinkageState& state, const detail::LinkageWork& work) noexcept {
    if (const Result bad = check_count(op, "state.joints", state.joints.size(), work.linkage.links.size());
        !bad)
        return bad;
    for (std::size_t i = 0; i < state.joints.size(); ++i) {
        const auto& [value, q, last] = state.joints[i];
        if (std::abs(value) <= state_limit && std::abs(last) <= 2.0 * state_limit &&
            std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 2e-3)
            continue;
        return refused(op, {"state.joints", i}, "of values up to 1e9 and a unit rotation", value);
    }
    return {};
}

/// True if there is such a link and its joint has one value, so it is not a ball.
bool has_value(std::size_t link, const detail::LinkageWork& work) noexcept {
    return link < work.linkage.links.size() && work.linkage.links[link].joint != LinkJoint::Ball;
}

Result mark_drivers(const char* op, std::span<const LinkDriver> drivers, detail::LinkageWork& work) noexcept {
    std::ranges::fill(work.driven, std::uint8_t{0});
    for (std::size_t i = 0; i < drivers.size(); ++i) {
        const LinkDriver& each = drivers[i];
        if (!has_value(each.link, work))
            return refused(op, {"drivers", i, "link"}, "a link with a hinge or slider", each.link);
        if (!(std::abs(each.value) <= state_limit))
            return refused(op, {"drivers", i, "value"}, within_limit, each.value);
        std::uint8_t& driven = work.driven[work.column[each.link]];
        if (driven) return refused(op, {"drivers", i, "link"}, "a link of its own", each.link);
        driven = 1;
    }
    return {};
}

Result check_targets(std::span<const LinkTarget> targets, const detail::LinkageWork& work) noexcept {
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const LinkTarget& each = targets[i];
        if (each.point >= work.linkage.points.size())
            return refused("solve", {"targets", i, "point"}, "a point of the linkage", each.point);
        if (!(each.weight > 0.0 && each.weight <= state_limit))
            return refused("solve", {"targets", i, "weight"}, "over 0 to 1e9", each.weight);
        for (int axis = 0; axis < 3; ++axis)
            if (!(std::abs(each.to[axis]) <= state_limit))
                return refused("solve", {"targets", i, "to"}, within_limit, each.to[axis]);
        for (std::size_t k = 0; k < i; ++k)
            if (targets[k].point == each.point)
                return refused("solve", {"targets", i, "point"}, "a point of its own", each.point);
    }
    return {};
}

constexpr Field solver_rows[] = {
    field<&LinkageOptions::max_iterations>("max_iterations", {1, 1'000'000}),
    field<&LinkageOptions::tolerance>("tolerance", {0.0, state_limit}, "m").over(),
    index<&LinkageOptions::watched>("watched", "links")};

Result check_options(const LinkageOptions& options, const detail::LinkageWork& work) noexcept {
    if (!are_in_range<solver_rows>(&options)) return check_fields("solve", options);
    for (std::size_t i = 0; i < options.watched.size(); ++i)
        if (!has_value(options.watched[i], work))
            return refused("solve", {"watched", i}, "a link with a hinge or slider", options.watched[i]);
    return {};
}

/// Loads a state: clamps joints to their ranges and normalises rotations.
void take_state(detail::LinkageWork& work, const LinkageState& state) noexcept {
    work.joints = state.joints;
    work.clamp_to_ranges();
}

}  // namespace

LinkageReport LinkageSolver::solve(LinkageState& state, const LinkageGoals& goals,
                                   const LinkageOptions& options) noexcept {
    const auto no = [](const Result& why) { return detail::refusal<LinkageReport>(why); };
    if (!parts_) return no(moved_from("solve", "solver"));
    detail::LinkageWork& work = *parts_;
    if (const Result bad = check_state("solve", state, work); !bad) return no(bad);
    if (const Result bad = mark_drivers("solve", goals.drivers, work); !bad) return no(bad);
    if (const Result bad = check_targets(goals.targets, work); !bad) return no(bad);
    if (const Result bad = check_options(options, work); !bad) return no(bad);
    take_state(work, state);
    LinkageReport report = detail::LinkageSolve(work, goals, options).run();
    state.joints = work.joints;
    return report;
}

Result LinkageSolver::other_mode(LinkageState& state, std::span<const LinkDriver> drivers,
                                 OtherMode which) noexcept {
    constexpr const char* op = "other_mode";
    if (!parts_) return moved_from(op, "solver");
    if (const Result bad = check_state(op, state, *parts_); !bad) return bad;
    if (const Result bad = mark_drivers(op, drivers, *parts_); !bad) return bad;
    return detail::find_other_mode(*parts_, state, drivers, which);
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

Result LinkageSolver::place(const LinkageState& state) noexcept {
    if (!parts_) return moved_from("place", "solver");
    if (const Result bad = check_state("place", state, *parts_); !bad) return bad;
    take_state(*parts_, state);
    parts_->move_links();
    return {};
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
