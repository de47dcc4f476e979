// The table of Aristidou and Lasenby 2011, measured as in `tendril paper`, with a row for the
// Levenberg-Marquardt solver of Orocos KDL if that is installed.
//
// Claims of the paper: FABRIK solves every target, in and out of reach, in fewer iterations and less time
// than CCD, the Jacobian transpose and damped least squares with and without SVD.
#include "app/batch/paper.hpp"
#include "measure.hpp"

#ifdef TENDRIL_HAS_KDL
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#endif

namespace {

using namespace tendril;
using tendril::bench::claim;

#ifdef TENDRIL_HAS_KDL

/// KDL has no ball joints: each is three revolute ones. Converting poses to its angles takes negligible time.
class Kdl {
  public:
    ik::Report operator()(std::span<glm::vec3> joints, glm::vec3 target) {
        const KDL::Vector goal(target.x, target.y, target.z);
        const int code = solver_.CartToJnt(angles(joints), KDL::Frame(goal), answer_);
        KDL::Frame tip;
        forward_.JntToCart(answer_, tip);
        const double residual = (tip.p - goal).Norm();
        // An unreachable target is solved once the tip is as near as possible.
        const double reach = static_cast<double>(app::paper_bone_length) * app::paper_bones;
        const bool straight = goal.Norm() > reach && residual <= goal.Norm() - reach + tolerance;
        const ik::Status status = straight    ? ik::Status::Stretched
                                  : code == 0 ? ik::Status::Converged
                                              : ik::Status::IterationLimit;
        return {status, solver_.lastNrOfIter, static_cast<float>(residual)};
    }

  private:
    static constexpr double tolerance = static_cast<double>(app::paper_tolerance);

    static KDL::Chain ball_chain() {
        const KDL::Vector bone(static_cast<double>(app::paper_bone_length), 0, 0);
        KDL::Chain chain;
        for (std::size_t i = 0; i < app::paper_bones; ++i) {
            chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotX)));
            chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotY)));
            chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame(bone)));
        }
        return chain;
    }

    static Eigen::Matrix<double, 6, 1> place_only() {
        Eigen::Matrix<double, 6, 1> weights;
        weights << 1, 1, 1, 0, 0, 0;
        return weights;
    }

    /// The rotations about Y, then Z that point each bone from one joint to the next.
    const KDL::JntArray& angles(std::span<const glm::vec3> joints) {
        KDL::Rotation frame;
        for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
            const glm::vec3 bone = (joints[i + 1] - joints[i]) / app::paper_bone_length;
            const KDL::Vector local = frame.Inverse(KDL::Vector(bone.x, bone.y, bone.z));
            const double about_z = std::asin(std::min(1.0, std::max(-1.0, local.y())));
            const double about_y = std::atan2(-local.z(), local.x());
            const auto row = static_cast<unsigned>(3 * i);
            start_(row) = 0.0;
            start_(row + 1) = about_y;
            start_(row + 2) = about_z;
            frame = frame * KDL::Rotation::RotY(about_y) * KDL::Rotation::RotZ(about_z);
        }
        return start_;
    }

    KDL::Chain chain_ = ball_chain();
    KDL::ChainFkSolverPos_recursive forward_{chain_};
    KDL::ChainIkSolverPos_LMA solver_{chain_, place_only(), tolerance, app::paper_iterations};
    KDL::JntArray start_{3 * app::paper_bones}, answer_{3 * app::paper_bones};
};

#endif

struct Row {
    std::string name;
    app::PaperRow measured;
};

Row print_row(const std::string& name, const app::PaperTargets& targets, const app::PaperSolve& solve) {
    const app::PaperRow row = *app::measure(targets, solve, [](double) { return true; });
    std::printf("%-20s %8.1f %% %14.2f %8.0f %12.3f", name.c_str(), 100.0 * row.solved, row.mean_iterations,
                row.median_iterations, row.microseconds);
    if (row.nanoseconds) std::printf(" %14.0f", *row.nanoseconds);
    std::printf("\n");
    return {name, row};
}

/// FABRIK's row first.
std::vector<Row> table(const app::PaperTargets& targets) {
    std::printf("%s targets\n%-20s %10s %14s %8s %12s %14s\n", targets.name, "", "solved", "iterations",
                "median", "us a solve", "ns an iteration");
    std::vector<Row> rows;
    for (const ik::Method method : app::paper_methods())
        rows.push_back(print_row(ik::name(method), targets, app::paper_solver(method)));
#ifdef TENDRIL_HAS_KDL
    Kdl kdl;
    rows.push_back(print_row("KDL LMA", targets, std::ref(kdl)));
#endif
    std::printf("\n");
    return rows;
}

bool is_fabrik(const Row& row) {
    return row.name == ik::name(ik::Method::Fabrik) || row.name == ik::name(ik::Method::FabrikPlain);
}

/// The minimum ratio of the other families to FABRIK.
double least_ratio(const std::vector<Row>& rows, double app::PaperRow::*what) {
    double least = 1e9;
    for (const Row& row : rows) {
        if (is_fabrik(row)) continue;
        least = std::min(least, row.measured.*what / rows.front().measured.*what);
    }
    return least;
}

}  // namespace

int main(int count, char** arguments) {
    const std::vector<Row> reachable = table(app::reachable_targets());
    const std::vector<Row> unreachable = table(app::unreachable_targets());
    bool all = claim("reachable targets that fabrik solves, percent",
                     100.0 * reachable.front().measured.solved, 100.0);
    all &= claim("unreachable targets that fabrik solves, percent",
                 100.0 * unreachable.front().measured.solved, 100.0);
    all &= claim("iterations of the next method over those of fabrik",
                 least_ratio(reachable, &app::PaperRow::mean_iterations), 4.0);
    all &= claim("time of the next method over that of fabrik",
                 least_ratio(reachable, &app::PaperRow::microseconds), 3.0);
#ifdef TENDRIL_HAS_KDL
    all &= claim("time of KDL's LMA over that of fabrik, reachable",
                 reachable.back().measured.microseconds / reachable.front().measured.microseconds, 30.0);
    all &= claim("the same, unreachable",
                 unreachable.back().measured.microseconds / unreachable.front().measured.microseconds, 30.0);
#endif
    return all || !bench::has_flag(count, arguments, "--check") ? 0 : 1;
}
