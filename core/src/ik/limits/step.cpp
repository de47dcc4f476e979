#include "ik/limits/step.hpp"

#include <algorithm>

#include "ik/limits/jacobian.hpp"
#include "ik/limits/pose.hpp"
#include "ik/math.hpp"
#include "math/matrix3.hpp"
#include "math/symmetric3.hpp"

namespace tendril::ik::detail {
namespace {

constexpr float least_damping = 1e-8f, most_damping = 1.0f;

Wanted damped(const Problem& problem, const Wanted& wanted, float damping) noexcept {
    const LimitedRoom& room = problem.room.limited;
    Matrix3 moves = diagonal(damping), turns = diagonal(damping), both = diagonal(0.0f);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            add_product(moves, room.columns[i][k], room.columns[i][k]);
            if (wanted.scale == 0.0f) continue;
            const glm::vec3 turn = times(room.axes[i][k], wanted.scale);
            add_product(turns, turn, turn);
            add_product(both, room.columns[i][k], turn);
        }
    }
    Wanted by = wanted;
    if (wanted.scale == 0.0f) {
        by.move = times(inverse(moves), wanted.move);
        return by;
    }
    // [moves both; both' turns] [by.move; by.turn] = [wanted.move; wanted.turn], the first eliminated.
    const Matrix3 inverted = inverse(moves);
    const Matrix3 carried_over = product(transposed(both), inverted);
    by.turn = times(inverse(difference(turns, product(carried_over, both))),
                    minus(wanted.turn, times(carried_over, wanted.move)));
    by.move = times(inverted, minus(wanted.move, times(both, by.turn)));
    return by;
}

/// Damped only along eigenvectors of J J' whose singular value is small, as the solver without limits has it;
/// with an orientation there are six rows, and all are damped.
Wanted filtered(const Problem& problem, const Wanted& wanted, float damping) noexcept {
    if (wanted.scale != 0.0f) return damped(problem, wanted, damping);
    constexpr double small_singular = 0.4;
    Symmetric3 jj;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        for (const glm::vec3& column : problem.room.limited.columns[i]) {
            const double x = column.x, y = column.y, z = column.z;
            jj.xx += x * x, jj.yy += y * y, jj.zz += z * z;
            jj.xy += x * y, jj.xz += x * z, jj.yz += y * z;
        }
    }
    const Eigen3 e = eigen(jj);
    const glm::dvec3 move{wanted.move.x, wanted.move.y, wanted.move.z};
    glm::dvec3 by{0.0};
    for (std::size_t k = 0; k < 3; ++k) {
        const double squared = std::max(e.values[k], 0.0);
        const double small = std::max(1.0 - squared / (small_singular * small_singular), 0.0);
        const double divisor = squared + std::max(static_cast<double>(damping) * small, 1e-9);
        by = plus(by, times(e.vectors[k], dot(e.vectors[k], move) / divisor));
    }
    return {narrow(by), glm::vec3(0.0f), 0.0f};
}

/// The step along the gradient after which the error, were it linear, would be least.
Wanted steepest(const Problem& problem, const Wanted& wanted) noexcept {
    const LimitedRoom& room = problem.room.limited;
    glm::vec3 move{0.0f}, turn{0.0f};
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(room, i, wanted);
        const float parts[] = {change.up, change.left, change.twist};
        for (std::size_t k = 0; k < 3; ++k) {
            move = plus(move, times(room.columns[i][k], parts[k]));
            turn = plus(turn, times(room.axes[i][k], parts[k] * wanted.scale));
        }
    }
    const float size = dot(move, move) + dot(turn, turn);
    const float best = size > 0.0f ? (dot(move, wanted.move) + dot(turn, wanted.turn)) / size : 0.0f;
    return {times(wanted.move, best), times(wanted.turn, best), wanted.scale};
}

/// No angle changes by more than this at once; further the columns say nothing.
float bounded(const Problem& problem, const Wanted& by) noexcept {
    float most = 1.0f;
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(problem.room.limited, i, by);
        most = std::max({most, std::abs(change.up), std::abs(change.left), std::abs(change.twist)});
    }
    return 1.0f / most;
}

void take(Problem& problem, const Wanted& by) noexcept {
    LimitedRoom& room = problem.room.limited;
    const float scale = bounded(problem, by);
    for (std::size_t i = 0; i < problem.bones(); ++i) {
        const JointAngles change = change_of(room, i, by);
        const glm::quat parent = parent_of(room.trial.rotations, i);
        const glm::quat old =
            compose(conjugate(parent_of(problem.room.rotations, i)), problem.room.rotations[i]);
        JointAngles angles = room.angles[i];
        angles.up += scale * change.up;
        angles.left += scale * change.left;
        angles.twist += scale * change.twist;
        glm::quat turn = old;
        if (room.limits[i].free()) {
            const glm::vec3 about = times(glm::vec3{change.up, change.left, change.twist}, 0.5f * scale);
            const glm::vec3 own = rotated(conjugate(parent_of(problem.room.rotations, i)), about);
            turn = compose(unit_quaternion(1.0f, own.x, own.y, own.z), old);
        } else {
            turn = turn_of(room.limits[i], within(room.limits[i], angles));
        }
        room.trial.rotations[i] = unit(compose(parent, turn));
    }
    lay(problem, room.trial);
}

}  // namespace

void limited_step(Problem& problem, Descent descent, float damping) noexcept {
    linearize(problem);
    const Wanted wanted = wanted_of(problem);
    Wanted by = wanted;
    for (int pass = 0; pass < 4; ++pass) {
        by = descent == Descent::Transpose  ? steepest(problem, wanted)
             : descent == Descent::Filtered ? filtered(problem, wanted, damping)
                                            : damped(problem, wanted, damping);
        if (!hold_back(problem, by)) break;
    }
    take(problem, by);
}

template <class Watch>
bool descend(Problem& problem, float& damping, float& error, Watch watch) noexcept {
    for (int attempt = 0; attempt < 2; ++attempt) {
        limited_step(problem, Descent::Damped, damping);
        const float then = error_of(problem, problem.room.limited.trial);
        if (then < error) {
            assume(problem, problem.room.limited.trial, Phase::Gradient, watch);
            error = then;
            damping = std::max(0.3f * damping, least_damping);
            return true;
        }
        damping = std::min(5.0f * damping, most_damping);
    }
    return false;
}

template bool descend(Problem&, float&, float&, Unwatched) noexcept;
template bool descend(Problem&, float&, float&, Watched) noexcept;

}  // namespace tendril::ik::detail
