// The table of Aristidou and Lasenby 2011, measured as `tendril paper` does, and where Orocos KDL is
// installed a row for its Levenberg-Marquardt solver: the time is that of one solve.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "app/batch/paper.hpp"

#ifdef TENDRIL_HAS_KDL
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#endif

namespace {

using namespace tendril;

void show(benchmark::State& state, const std::string& name, const app::PaperTargets& targets,
          const app::PaperSolve& solve) {
    for ([[maybe_unused]] auto once : state) {
        const auto row = app::measure(targets, solve, [](double) { return true; });
        state.SetIterationTime(row->microseconds * 1e-6);
        state.counters["solved"] = row->solved;
        state.counters["mean_its"] = row->mean_iterations;
        state.counters["median_its"] = row->median_iterations;
        state.counters["ns_per_it"] = row->nanoseconds.value_or(0.0);
    }
    state.SetLabel(std::string(targets.name) + ", " + name);
}

app::PaperTargets targets_of(const benchmark::State& state) {
    return state.range(0) == 0 ? app::reachable_targets() : app::unreachable_targets();
}

void paper(benchmark::State& state) {
    const auto method = app::paper_methods()[static_cast<std::size_t>(state.range(1))];
    show(state, ik::name(method), targets_of(state), app::paper_solver(method));
}
BENCHMARK(paper)
    ->ArgsProduct({{0, 1}, benchmark::CreateDenseRange(0, 5, 1)})
    ->ArgNames({"unreachable", "solver"})
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

#ifdef TENDRIL_HAS_KDL

/// KDL knows no ball joints: each is three revolute ones. Turning poses into its angles is timed with it, and
/// is nothing beside a solve.
class Kdl {
  public:
    ik::Report operator()(std::span<glm::vec3> joints, glm::vec3 target) {
        const KDL::Vector goal(target.x, target.y, target.z);
        const int code = solver_.CartToJnt(angles(joints), KDL::Frame(goal), answer_);
        KDL::Frame tip;
        forward_.JntToCart(answer_, tip);
        const double residual = (tip.p - goal).Norm();
        // Out of reach it is solved where the tip came as near as it can.
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

    /// The turns about Y, then Z that point each bone from one joint to the next.
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

void paper_kdl(benchmark::State& state) {
    Kdl kdl;
    show(state, "KDL LMA", targets_of(state), std::ref(kdl));
}
BENCHMARK(paper_kdl)
    ->DenseRange(0, 1)
    ->ArgName("unreachable")
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

#endif

}  // namespace
