// The Jacobian solvers against the explicit 3 x 3n Jacobian and elimination in double, unused by the library.
#include "ik_hostile.hpp"

namespace tendril::test::ik_jacobian_test {
namespace {

using ik::Method;
using ik::Status;

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

/// Gauss-Jordan elimination with pivoting.
Vector solved(Matrix a, Vector b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t best = i;
        for (std::size_t r = i; r < n; ++r) best = std::abs(a[r][i]) > std::abs(a[best][i]) ? r : best;
        std::swap(a[i], a[best]);
        std::swap(b[i], b[best]);
        for (std::size_t r = 0; r < n; ++r) {
            if (r == i) continue;
            const double by = a[r][i] / a[i][i];
            for (std::size_t c = i; c < n; ++c) a[r][c] -= by * a[i][c];
            b[r] -= by * b[i];
        }
    }
    for (std::size_t i = 0; i < n; ++i) b[i] /= a[i][i];
    return b;
}

/// Rows of the Jacobian; column 3 i + k is axis k x (tip - joint i).
Matrix jacobian(const Joints& joints) {
    Matrix j(3);
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        const glm::dvec3 r = glm::dvec3(joints.back()) - glm::dvec3(joints[i]);
        const double columns[3][3] = {{0, -r.z, r.y}, {r.z, 0, -r.x}, {-r.y, r.x, 0}};
        for (const auto& column : columns)
            for (std::size_t row = 0; row < 3; ++row) j[row].push_back(column[row]);
    }
    return j;
}

Vector transposed_times(const Matrix& j, const Vector& e) {
    Vector result(j[0].size(), 0.0);
    for (std::size_t c = 0; c < result.size(); ++c)
        for (std::size_t r = 0; r < 3; ++r) result[c] += j[r][c] * e[r];
    return result;
}

Matrix squared(const Matrix& j, double damping) {
    Matrix result(3, Vector(3, 0.0));
    for (std::size_t r = 0; r < 3; ++r) {
        for (std::size_t s = 0; s < 3; ++s)
            for (std::size_t c = 0; c < j[0].size(); ++c) result[r][s] += j[r][c] * j[s][c];
        result[r][r] += damping;
    }
    return result;
}

/// The tip after rotating the joints, to first order.
glm::dvec3 moved_tip(const Joints& joints, const Matrix& j, const Vector& turns) {
    glm::dvec3 tip(joints.back());
    for (std::size_t c = 0; c < turns.size(); ++c) tip += glm::dvec3(j[0][c], j[1][c], j[2][c]) * turns[c];
    return tip;
}

Vector expected_turns(Method method, const Matrix& j, const Vector& e, double lambda_squared) {
    if (method == Method::JacobianTranspose) {
        const Matrix m = squared(j, 0.0);
        double up = 0.0, down = 0.0;
        for (std::size_t r = 0; r < 3; ++r) {
            const double moved = m[r][0] * e[0] + m[r][1] * e[1] + m[r][2] * e[2];
            up += e[r] * moved;
            down += moved * moved;
        }
        Vector turns = transposed_times(j, e);
        for (double& turn : turns) turn *= up / down;
        return turns;
    }
    return transposed_times(j, solved(squared(j, lambda_squared), e));
}

/// A chain of many bones with every singular value well above the SVD's damping threshold.
Joints open_pose(std::span<const float> lengths, Random& random) {
    for (;;) {
        Joints joints{{0, 0, 0}};
        const glm::vec3 first = some_direction(random), second = some_direction(random);
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            const glm::vec3 towards =
                (2 * i < lengths.size() ? first : second) + some_direction(random) * 0.5f;
            const auto size = static_cast<float>(distance(towards, {0, 0, 0}));
            joints.push_back(joints.back() + towards * (lengths[i] / size));
        }
        const Matrix m = squared(jacobian(joints), 0.0);
        const double least = std::pow(0.45 * reach_of(lengths), 2.0);
        const double det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
        const double trace = m[0][0] + m[1][1] + m[2][2];
        if (det / (0.25 * trace * trace) > least) return joints;  // a lower bound of the minimum eigenvalue
    }
}

/// One iteration towards a target so near that second-order terms are negligible.
void expect_first_order(Method method, float damping, bool damped) {
    Random random(11);
    for (int k = 0; k < 100; ++k) {
        const Lengths lengths(24, 1.0f / 24.0f);
        const Joints start = open_pose(lengths, random);
        const glm::vec3 target = start.back() + some_direction(random) * 0.002f;
        const Matrix j = jacobian(start);
        const Vector e{static_cast<double>(target.x - start.back().x),
                       static_cast<double>(target.y - start.back().y),
                       static_cast<double>(target.z - start.back().z)};
        const double lambda_squared = damped ? std::pow(static_cast<double>(damping), 2.0) * 0.002 : 0.0;
        const glm::dvec3 expected = moved_tip(start, j, expected_turns(method, j, e, lambda_squared));
        Joints joints = start;
        ik::Options options{.tolerance = 0.0f, .max_iterations = 1, .damping = damping};
        KeptSolver(lengths).solve(method, joints, target, options);
        EXPECT_LT(distance(joints.back(), glm::vec3(expected)), 2e-5) << "a hundredth of the way";
    }
}

TEST(IkJacobian, TransposeTakesTheOptimalStepAlongTheGradient) {
    expect_first_order(Method::JacobianTranspose, 0.1f, false);
}

TEST(IkJacobian, DampedLeastSquaresSolvesItsSystem) {
    expect_first_order(Method::Dls, 0.1f, true);
    expect_first_order(Method::Dls, 5.0f, true);
}

TEST(IkJacobian, TheSvdLeavesLargeSingularValuesUndamped) {
    expect_first_order(Method::SvdDls, 0.1f, false);
    expect_first_order(Method::SvdDls, 5.0f, false);
}

TEST(IkJacobian, TheSvdDampsTheNearlySingularDirection) {
    // Nearly straight along x: y and z are free, x is nearly lost.
    const Lengths lengths(4, 0.25f);
    const Joints start{{0, 0, 0}, {0.25f, 0, 0}, {0.4999f, 0.005f, 0}, {0.7499f, 0.005f, 0}, {0.9999f, 0, 0}};
    ik::Options options{.tolerance = 0.0f, .max_iterations = 1, .damping = 1.0f};
    Joints across = start, along = start;
    KeptSolver solver(lengths);
    const glm::vec3 tip = start.back();
    solver.solve(Method::SvdDls, across, tip + glm::vec3(0.0f, 0.0f, 0.01f), options);
    solver.solve(Method::SvdDls, along, tip - glm::vec3(0.01f, 0.0f, 0.0f), options);
    EXPECT_LT(distance(across.back(), tip + glm::vec3(0.0f, 0.0f, 0.01f)), 0.001);
    EXPECT_GT(distance(along.back(), tip - glm::vec3(0.01f, 0.0f, 0.0f)), 0.008);
}

/// A step that would turn a joint further is scaled down as a whole.
TEST(IkJacobian, AStepTurnsNoJointByMoreThanARadian) {
    Random random(14);
    const Lengths lengths(4, 1.0f);
    for (int k = 0; k < 200; ++k) {
        Joints joints = some_pose(lengths, random);
        const glm::vec3 first = joints[1];
        KeptSolver(lengths).solve(Method::JacobianTranspose, joints, some_direction(random) * 3.9f,
                                  {.tolerance = 0.0f, .max_iterations = 1});
        EXPECT_GE(glm::dot(first, joints[1]), std::cos(1.0f) - 1e-4f);
    }
}

TEST(IkJacobian, AllJointsTurnAtOnce) {
    Random random(12);
    const Lengths lengths(4, 1.0f);
    for (const Method method : {Method::JacobianTranspose, Method::Dls, Method::SvdDls}) {
        Joints joints = some_pose(lengths, random);
        Recorder recorder;
        ik::Options options{.max_iterations = 3, .every_iteration = true};
        KeptSolver(lengths).solve(method, joints, {1, 1, 1}, options, &recorder);
        std::size_t turns = 0;
        for (const ik::Step& step : recorder.steps) turns += step.phase == ik::Phase::Gradient;
        EXPECT_EQ(turns, 12u);
        for (const ik::Step& step : recorder.steps) {
            if (step.phase != ik::Phase::Gradient) continue;
            EXPECT_EQ(step.order, step.iteration - 1);
        }
    }
}

TEST(IkJacobian, DampedMethodsReachUpToTheRimInAHundredIterations) {
    Random random(13);
    for (const Method method : {Method::Dls, Method::SvdDls}) {
        int most = 0;
        for (int k = 0; k < 1500; ++k) {
            const Lengths lengths = some_lengths(3 + random.below(10), random);
            Joints joints = random.chance(3) ? straight_joints(lengths) : some_pose(lengths, random);
            const float span = random.chance(2) ? some_span(lengths, 0.95f, 0.999f, random)
                                                : some_span(lengths, 0.3f, 0.95f, random);
            const glm::vec3 ahead(random.chance(2) ? 1.0f : -1.0f, 0.0f, 0.0f);
            const glm::vec3 target = (random.chance(4) ? ahead : some_direction(random)) * span;
            const ik::Report report = KeptSolver(lengths).solve(method, joints, target);
            EXPECT_EQ(report.status, Status::Converged) << name(method) << ", solve " << k;
            most = std::max(most, report.iterations);
        }
        std::printf("%s: at most %d iterations\n", name(method), most);
    }
}

TEST(IkJacobian, EveryDampingConverges) {
    Random random(14);
    for (const float damping : {1e-6f, 1e-3f, 0.1f, 0.5f})
        for (const Method method : {Method::Dls, Method::SvdDls})
            for (int k = 0; k < 100; ++k) {
                const Lengths lengths = some_lengths(4 + random.below(6), random);
                Joints joints = some_pose(lengths, random);
                const glm::vec3 target = some_direction(random) * some_span(lengths, 0.3f, 0.98f, random);
                ik::Options options{.damping = damping};
                const ik::Report report = KeptSolver(lengths).solve(method, joints, target, options);
                EXPECT_EQ(report.status, Status::Converged) << name(method) << ", damping " << damping;
            }
}

TEST(IkJacobian, SurvivesAnyInput) {
    for (const Method method : {Method::JacobianTranspose, Method::Dls, Method::SvdDls}) {
        SCOPED_TRACE(name(method));
        expect_invariants_always(method, 1000);
    }
}

// Cyclic coordinate descent against the textbook: O(n^2), in double, applying each joint's rotation at once.

using Wide = std::vector<glm::dvec3>;

void textbook_iteration(Wide& joints, glm::dvec3 target) {
    for (std::size_t i = joints.size() - 1; i-- > 0;) {
        const glm::dvec3 a = joints.back() - joints[i], b = target - joints[i], axis = cross(a, b);
        if (glm::length(axis) < 1e-12) continue;
        const double angle = std::atan2(glm::length(axis), dot(a, b));
        for (std::size_t k = i + 1; k < joints.size(); ++k)
            joints[k] = joints[i] + turned(joints[k] - joints[i], axis / glm::length(axis), angle);
    }
}

ik::Options iterations(int count) {
    ik::Options options{.max_iterations = count, .every_iteration = true};
    return options;
}

TEST(IkCcd, MatchesTheTextbook) {
    Random random(1);
    double worst = 0.0;
    for (int k = 0; k < 300; ++k) {
        const Lengths lengths = some_lengths(2 + random.below(9), random);
        Joints joints = some_pose(lengths, random);
        const auto reach = static_cast<float>(reach_of(lengths));
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.4f, 0.9f, random);
        Wide wide(joints.begin(), joints.end());
        const double before = distance(joints.back(), target);
        textbook_iteration(wide, target);
        // A solve returns its best pose; here that must be the one after the iteration.
        if (glm::length(wide.back() - glm::dvec3(target)) > 0.99 * before) continue;
        KeptSolver(lengths).solve(Method::Ccd, joints, target, iterations(1));
        for (std::size_t i = 0; i < joints.size(); ++i)
            worst =
                std::max(worst, glm::length(glm::dvec3(joints[i]) - wide[i]) / static_cast<double>(reach));
    }
    std::printf("worst deviation %.2g of the reach\n", worst);
    EXPECT_LT(worst, 2e-5);
}

TEST(IkCcd, TurnsEveryJointOnceFromTheTip) {
    Random random(2);
    const Lengths lengths{1.0f, 0.7f, 0.9f, 0.4f};
    Joints joints = some_pose(lengths, random);
    Recorder recorder;
    KeptSolver(lengths).solve(Method::Ccd, joints, {1.0f, 1.0f, 0.5f}, iterations(1), &recorder);
    std::vector<std::pair<std::size_t, std::size_t>> seen;  // the pivot joint, and the joint that moved
    int order = -1;
    for (const ik::Step& step : recorder.steps) {
        if (step.phase != ik::Phase::Rotate) continue;
        seen.emplace_back(step.neighbour, step.joint);
        order = std::max(order, step.order);
    }
    const std::vector<std::pair<std::size_t, std::size_t>> expected{{3, 4}, {2, 3}, {2, 4}, {1, 2}, {1, 3},
                                                                    {1, 4}, {0, 1}, {0, 2}, {0, 3}, {0, 4}};
    EXPECT_EQ(seen, expected);
    EXPECT_EQ(order, recorder.steps.front().order + 3) << "what moves at once shares its number";
}

TEST(IkCcd, HandlesATipOrTargetOnAJointAndHalfATurn) {
    const Lengths three(3, 1.0f);
    const Joints folded{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}};
    const Joints ring{{0, 0, 0}, {1, 0, 0}, {0.5f, 0.8660254f, 0}, {0, 0, 0}};
    for (const Joints& start : {folded, ring})
        for (const glm::vec3 target : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 0, 0),
                                       glm::vec3(0.5f, 0.8660254f, 0), glm::vec3(-0.3f, -0.4f, 0)})
            for (const int count : {1, 2, 50})
                expect_invariants(Method::Ccd, three, start, target, iterations(count));
}

TEST(IkCcd, ReachesTargetsInTheMiddleOfItsRange) {
    Random random(3);
    int reached = 0;
    for (int k = 0; k < 500; ++k) {
        const Lengths lengths = some_lengths(3 + random.below(8), random);
        Joints joints = some_pose(lengths, random);
        const glm::vec3 target = some_direction(random) * some_span(lengths, 0.3f, 0.8f, random);
        const ik::Report report = KeptSolver(lengths).solve(Method::Ccd, joints, target);
        reached += report.status == ik::Status::Converged;
    }
    EXPECT_GE(reached, 475);
}

TEST(IkCcd, LengthsDoNotDriftInAThousandIterations) {
    Random random(4);
    const Lengths lengths = some_lengths(20, random);
    Joints joints = some_pose(lengths, random);
    KeptSolver(lengths).solve(Method::Ccd, joints, {3.0f, 1.0f, 2.0f}, iterations(1000));
    EXPECT_TRUE(Holds(joints, lengths));
}

TEST(IkCcd, SurvivesAnyInput) {
    expect_invariants_always(Method::Ccd, 2000);
}

}  // namespace
}  // namespace tendril::test::ik_jacobian_test
