// Assembly modes: identifies the mode of a pose, and finds another.
#include <algorithm>
#include <cmath>

#include "ik/linkage/solve.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik::detail {

/// mode(), with the watched joints held if nothing is driven. Cached for the last solve's final pose.
int LinkageSolve::watched_mode() noexcept {
    if (goals_.drivers.empty())
        for (const std::size_t each : options_.watched) work_.driven[work_.column[each]] = 1;
    if (work_.mode_held != work_.driven || work_.mode_at != work_.joints) {
        work_.mode = mode();
        work_.mode_held = work_.driven;
        work_.mode_at = work_.joints;
    }
    std::ranges::fill(work_.driven, std::uint8_t{0});
    hold_drivers();
    return work_.mode;
}

/// The sign of the determinant of the closures, completed by the directions that they leave free (a coupler
/// between two balls spins about itself). 0 if they cannot be completed.
int LinkageSolve::completed_mode(std::span<double> free, std::size_t& count) noexcept {
    work_.release();
    static_cast<void>(closure_rank());
    count = 0;
    const std::size_t columns = work_.columns, wanted = free_columns();
    for (const double least : {0.3, 1e-9})  // part of an axis that is left; short ones are rounding
        for (std::size_t col = 0; col < columns && work_.basis.rank() < wanted; ++col) {
            if (work_.held[col]) continue;
            const std::span<double> axis = work_.row(0);
            std::ranges::fill(axis, 0.0);
            axis[col] = 1.0;
            if (work_.basis.add(axis, 1e9 * least) == 0.0) continue;
            std::ranges::copy(axis, free.begin() + static_cast<std::ptrdiff_t>(count++ * columns));
        }
    return work_.basis.rank() < wanted ? 0 : work_.basis.orientation(work_.held, work_.square);
}

/// True if the last substep of a drive, which began at `before_step`, jumped to another branch; then undoes
/// it. Branches nearer to each other than `crossing` count as crossing.
bool LinkageSolve::jumped_branch() noexcept {
    // Radians or sizes. The closures' tolerance determines a singular pose only to its square root, 1e-5.
    constexpr double crossing = 1e-4;
    // A substep from 30 degrees off a singular pose cannot end 30 degrees beyond it: no joint turns by more
    // than max_turn_step.
    constexpr double far_from_singular = 0.5;
    if (min_rank_margin_ > far_from_singular || length_of_step_ <= crossing) return false;
    std::size_t before_count = 0, count = 0;
    work_.saved = work_.joints;
    restore(work_.before_step);
    const int before = completed_mode(work_.factor, before_count);
    restore(work_.saved);
    const int after = completed_mode(work_.curvature, count);
    if (count != before_count) return false;
    // The determinant's sign also depends on the free directions, which change by less than a right angle.
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < count; ++k) {
            double dot = 0.0;
            for (std::size_t col = 0; col < work_.columns; ++col)
                dot += work_.factor[i * work_.columns + col] * work_.curvature[k * work_.columns + col];
            work_.square[i * count + k] = dot;
        }
    if (before * after * sign_of_determinant(work_.square, count) >= 0) return false;
    restore(work_.before_step);
    return true;
}

int LinkageSolve::mode() noexcept {
    work_.release();
    const std::size_t rank = closure_rank();
    const std::size_t free = free_columns();
    if (rank != free || rank == 0) return 0;
    // The basis is the closures' rows times a triangular matrix with a positive diagonal: the same sign.
    return work_.basis.orientation(work_.held, work_.square);
}

namespace {

/// Rounds to whole turns, radians.
double whole_turns(double radians) noexcept {
    return 2.0 * math::pi * std::round(radians / (2.0 * math::pi));
}

/// Squared distance between two poses, modulo whole turns; radians and sizes.
double distance_of_modes(const LinkageWork& work, const std::vector<JointPlace>& other) noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < other.size(); ++i) {
        const JointPlace &a = work.joints[i], &b = other[i];
        double by = (a.value - b.value) / work.unit_of(i);
        if (work.linkage.links[i].joint == LinkJoint::Hinge) by -= whole_turns(by);
        if (work.linkage.links[i].joint == LinkJoint::Ball)
            by = 1.0 - std::abs(a.turn.w * b.turn.w + a.turn.x * b.turn.x + a.turn.y * b.turn.y +
                                a.turn.z * b.turn.z);
        sum += by * by;
    }
    return sum;
}

/// A number that orders the modes of one linkage; the same for a whole turn more. Generic, so that no
/// symmetry gives two modes the same number: turned by phases that no two joints share.
double place_in_order(const LinkageWork& work) noexcept {
    double place = 0.0;
    for (std::size_t i = 0; i < work.joints.size(); ++i) {
        const auto phase = static_cast<double>(i + 1);
        const JointPlace& joint = work.joints[i];
        const glm::dquat& q = joint.turn;  // q and -q are one rotation
        switch (work.linkage.links[i].joint) {
            case LinkJoint::Hinge:
                place += math::cosine(joint.value - phase);
                break;
            case LinkJoint::Slider:
                place += joint.value / (phase * work.size);
                break;
            case LinkJoint::Ball:
                place += (q.w * q.x + 2.0 * q.x * q.y + 3.0 * q.y * q.z) / phase;
                break;
        }
    }
    return place;
}

}  // namespace

Result find_other_mode(LinkageWork& work, LinkageState& state, std::span<const LinkDriver> drivers,
                       OtherMode which) noexcept {
    const auto none_found = [](const char* why) { return Result(ErrorCode::NotFound, why); };
    // Measured on the eight modes of Jansen's leg, at 360 angles of its crank: 12 starts per closure miss one
    // at 19 angles, 24 at one.
    constexpr std::size_t starts_per_closure = 48, max_starts = 1000;
    constexpr double same = 1e-6, none = 1e300;
    const std::size_t starts = std::min(max_starts, starts_per_closure * work.linkage.closures.size());
    const LinkageGoals goals{drivers, {}};
    const LinkageOptions options{.max_iterations = 100000};
    const auto load = [&] {
        work.joints = state.joints;
        work.clamp_to_ranges();
        work.move_links();
    };
    load();
    LinkageSolve from(work, goals, options);
    from.hold_drivers();
    if (work.columns == 0 || from.mode() == 0)
        return none_found("other_mode: the drivers leave degrees of freedom, or nothing moves");
    const std::vector<JointPlace>& here = work.nearest = work.joints;
    const double place_here = place_in_order(work);
    double least = none;
    std::uint64_t random = 1;
    for (std::size_t start = 0; start < starts; ++start) {
        // Starts about the drawn pose, so that every mode finds the same others.
        for (std::size_t i = 0; i < here.size(); ++i) {
            const Link& link = work.linkage.links[i];
            work.joints[i] = here[i];
            if (link.joint != LinkJoint::Ball && !work.driven[work.column[i]])
                work.joints[i].value = link.rest;
        }
        work.move_links();
        work.randomize_step(random, math::pi);
        work.take_step(1.0);
        work.move_links();
        LinkageSolve solve(work, goals, options);
        solve.hold_drivers();
        if (!solve.close_from_here()) continue;
        double distance = distance_of_modes(work, here);
        if (distance < same || solve.mode() == 0) continue;
        if (which == OtherMode::Next) {
            distance = place_in_order(work) - place_here;
            if (distance < 0.0) distance += 1e9;  // first those behind it, then those before
        }
        if (distance >= least) continue;
        least = distance;
        for (std::size_t i = 0; i < here.size(); ++i) {
            if (work.linkage.links[i].joint == LinkJoint::Hinge)
                work.joints[i].value -= whole_turns(work.joints[i].value - here[i].value);
            state.joints[i] = work.joints[i];
        }
    }
    work.active.clear();
    work.open.clear();
    load();
    return least < none ? Result() : none_found("other_mode: no other mode was found");
}

}  // namespace tendril::ik::detail
