// One step of a body's solve: the equations of damped least squares, and the limits active in it.
#include <algorithm>
#include <cmath>

#include "humanoid/body_solve.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid::detail {

using namespace rig::detail;

bool RowEquations::factorise() noexcept {
    for (std::size_t j = 0; j < count; ++j) {
        double pivot = a[j][j];
        for (std::size_t k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k];
        if (!(pivot > 0.0)) return false;
        a[j][j] = std::sqrt(pivot);
        const double inverse = 1.0 / a[j][j];
        for (std::size_t i = j + 1; i < count; ++i) {
            double sum = a[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
            a[i][j] = sum * inverse;
        }
    }
    return true;
}

void RowEquations::solve() noexcept {
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = count; i-- > 0;) {
        for (std::size_t k = i + 1; k < count; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
}

glm::dvec3 BodySolve::allowed_torque(std::size_t link, const glm::dvec3& torque) const noexcept {
    const Link& at = work_.links[link];
    if (at.parent < 0 && hips_given_) return glm::dvec3(0.0);
    return steps_[link].freedom.allowed(at, torque);
}

void BodySolve::find_step(double damping, const Relaxation& relaxation) noexcept {
    double share = relaxation.share(damping);
    relaxation_ = length(shift_) / work_.size * share;
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        const Link& link = work_.links[i];
        steps_[i].relaxing = logarithm(math::compose(link.clip_turn, conjugate(link.turn)));
        if (link.effectors != 0 && !(link.parent < 0 && hips_given_))
            relaxation_ = std::max(relaxation_, share * length(steps_[i].relaxing));
    }
    if (relaxation_ > relaxation.budget()) {
        share *= relaxation.budget() / relaxation_;
        relaxation_ = relaxation.budget();
    }
    const double stiff = damping * work_.size * work_.size;
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        const Link& link = work_.links[i];
        Step& step = steps_[i];
        step.rows = 0;
        const glm::dquat before = link.parent < 0
                                      ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                      : work_.links[static_cast<std::size_t>(link.parent)].rotation;
        step.freedom.begin(link, before);
        if (link.effectors == 0) continue;
        double stiffness = stiff / link.mobility;
        for (std::size_t k = 0; k < count_; ++k) {
            const Goal& goal = goals_[k];
            if (!(link.effectors >> goal.effector & 1u)) continue;
            const glm::dvec3 arm = minus(
                work_.links[static_cast<std::size_t>(work_.ends[goal.effector])].position, link.position);
            stiffness += goal.weight * residual_stiffness * std::max(dot(goal.stalled, arm), 0.0);
        }
        step.compliance = 1.0 / stiffness;
        step.relaxing = rotated(before, times(step.relaxing, share * stiff / (link.mobility * stiffness)));
        for (std::size_t k = 0; k < count_; ++k) {
            const Goal& goal = goals_[k];
            if (!(link.effectors >> goal.effector & 1u)) continue;
            const glm::dvec3 arm = minus(
                work_.links[static_cast<std::size_t>(work_.ends[goal.effector])].position, link.position);
            step.rows |= 7u << 3 * k;
            glm::dvec3* column = &columns_[i][3 * k];
            column[0] = {0.0, arm.z, -arm.y};
            column[1] = {-arm.z, 0.0, arm.x};
            column[2] = {arm.y, -arm.x, 0.0};
            if (!goal.limb || static_cast<std::size_t>(goal.limb->lower) != i) continue;
            const double slope = goal.limb->slope(goal.limb->bend);
            for (int axis = 0; axis < 3; ++axis)
                column[axis] = minus(column[axis], times(goal.limb->about, slope * goal.limb->along[axis]));
        }
    }
    shift_relaxation_ = times(shift_, -share);
    add_goal_rows();
    start_balance_step();
    solve_rows(damping);
    for (int i = 0; i < max_active_set_changes && update_active_set(); ++i) solve_rows(damping);
}

void BodySolve::add_goal_rows() noexcept {
    row_count_ = 3 * count_;
    for (std::size_t k = 0; k < count_; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            Row& row = rows_[3 * k + static_cast<std::size_t>(axis)];
            row = {glm::dvec3(0.0), goals_[k].error[axis], goals_[k].weight};
            row.shift[axis] = 1.0;
        }
    }
}

void BodySolve::solve_rows(double damping) noexcept {
    RowEquations& e = equations_;
    e.count = row_count_;
    for (std::size_t r = 0; r < row_count_; ++r) {
        e.b[r] = rows_[r].error - dot(rows_[r].shift, shift_relaxation_);
        for (std::size_t q = 0; q <= r; ++q)
            e.a[r][q] = hips_mobility / damping * dot(rows_[r].shift, rows_[q].shift);
        e.a[r][r] += 1.0 / rows_[r].weight;
    }
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        const Step& step = steps_[i];
        if (step.rows == 0) continue;
        const glm::dvec3 back = allowed_torque(i, step.relaxing);
        for (std::size_t r = 0; r < row_count_; ++r) {
            if (!(step.rows >> r & 1u)) continue;
            e.b[r] -= dot(columns_[i][r], back);
            const glm::dvec3 moved = times(allowed_torque(i, columns_[i][r]), step.compliance);
            for (std::size_t q = 0; q <= r; ++q)
                if (step.rows >> q & 1u) e.a[r][q] += dot(columns_[i][q], moved);
        }
    }
    if (!e.factorise())
        e.b.fill(0.0);
    else
        e.solve();
    forces_ = e.b;
    shift_step_ = shift_relaxation_;
    for (std::size_t r = 0; r < row_count_; ++r)
        shift_step_ = plus(shift_step_, times(rows_[r].shift, hips_mobility / damping * forces_[r]));
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        glm::dvec3 torque{0.0};
        if (work_.links[i].effectors == 0) continue;
        for (std::size_t r = 0; r < row_count_; ++r)
            if (steps_[i].rows >> r & 1u) torque = plus(torque, times(columns_[i][r], forces_[r]));
        steps_[i].turn = allowed_torque(i, plus(steps_[i].relaxing, times(torque, steps_[i].compliance)));
    }
}

bool BodySolve::update_active_set() noexcept {
    const bool limits = block_limits(), balance = update_balance(), contacts = update_contacts();
    return limits || balance || contacts;
}

bool BodySolve::block_limits() noexcept {
    bool changed = false;
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        const Link& link = work_.links[i];
        if (link.effectors == 0) continue;
        const glm::dquat before = link.parent < 0
                                      ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                      : work_.links[static_cast<std::size_t>(link.parent)].rotation;
        changed |= steps_[i].freedom.block_limit(link, link.turn, before, steps_[i].turn);
    }
    return changed;
}

double BodySolve::step_size() const noexcept {
    double size = length(shift_step_) / work_.size;
    for (std::size_t i = 0; i < work_.links.size(); ++i)
        if (work_.links[i].effectors != 0) size = std::max(size, length(steps_[i].turn));
    return size;
}

void BodySolve::save_turns() noexcept {
    for (std::size_t i = 0; i < work_.links.size(); ++i) work_.saved_turns[i] = work_.links[i].turn;
    work_.saved_shift = shift_;
}

void BodySolve::restore_turns() noexcept {
    for (std::size_t i = 0; i < work_.links.size(); ++i) work_.links[i].turn = work_.saved_turns[i];
    shift_ = work_.saved_shift;
    work_.place_links(shift_);
}

void BodySolve::apply(double part) noexcept {
    shift_ = plus(shift_, times(shift_step_, part));
    for (std::size_t i = 0; i < work_.links.size(); ++i) {
        Link& link = work_.links[i];
        if (link.effectors == 0) continue;
        const glm::dquat before = link.parent < 0
                                      ? glm::dquat(1.0, 0.0, 0.0, 0.0)
                                      : work_.links[static_cast<std::size_t>(link.parent)].rotation;
        const glm::dvec3 turn = rotated(conjugate(before), times(steps_[i].turn, part));
        link.turn = math::compose(exponential(turn), link.turn);
        clamp_turn(link);
    }
}

}  // namespace tendril::humanoid::detail
