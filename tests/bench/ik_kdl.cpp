// The default solver against the Levenberg-Marquardt solver of Orocos KDL (ChainIkSolverPos_LMA): ten links
// with ball joints, the same initial poses, targets and tolerance, in one run. KDL has no ball joints: each
// is three revolute ones. Only the tip's position counts; KDL's weights of its rotation are 0.
//
// Claim: KDL takes at least 30 times as long as Method::Fabrik, which reaches at least as many targets.
//
// Both are called as users call them, with everything that they compute: for KDL the Jacobian's singular
// values in double, for Tendril the input checks. Whether a target was reached is measured here, from the
// joints that each solver left.
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <random>

#include "../core/kept_solver.hpp"
#include "measure.hpp"

namespace {

using namespace tendril::bench;
using tendril::ik::Method;
using Solver = tendril::test::KeptSolver;

constexpr int links = 10;
constexpr double tolerance = 1e-3 * links;  // metres; each link is 1 m
constexpr std::size_t cases = 500;
constexpr int repetitions = 5;

KDL::Chain ball_chain() {
    KDL::Chain chain;
    for (int i = 0; i < links; ++i) {
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotX)));
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotY)));
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame(KDL::Vector(1, 0, 0))));
    }
    return chain;
}

glm::vec3 to_glm(const KDL::Vector& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

struct Case {
    KDL::JntArray start{3 * links};
    std::vector<glm::vec3> joints;  ///< of the same pose
    KDL::Vector target;
};

class Cases {
  public:
    explicit Cases(const KDL::Chain& chain) : forward_(chain) {}

    KDL::JntArray pose() {
        KDL::JntArray angles(3 * links);
        for (unsigned i = 0; i < angles.rows(); ++i) angles(i) = angle_(random_);
        return angles;
    }
    /// The end of a link: every third KDL segment.
    KDL::Vector end(const KDL::JntArray& angles, int link) {
        KDL::Frame frame;
        forward_.JntToCart(angles, frame, 3 * link);
        return frame.p;
    }
    Case with_target(const KDL::Vector& target) {
        Case each;
        each.start = pose();
        for (int i = 0; i <= links; ++i) each.joints.push_back(to_glm(end(each.start, i)));
        each.target = target;
        return each;
    }
    /// Uniformly distributed in the ball that the tip can reach: half are beyond 0.79 of the reach.
    KDL::Vector in_ball() {
        const KDL::Vector p(normal_(random_), normal_(random_), normal_(random_));
        return p * (0.999 * links * std::cbrt(part_(random_)) / p.Norm());
    }

  private:
    KDL::ChainFkSolverPos_recursive forward_;
    std::mt19937 random_{1};
    std::uniform_real_distribution<double> angle_{-3.14159265, 3.14159265}, part_{0.0, 1.0};
    std::normal_distribution<double> normal_;
};

struct Contestant {
    const char* name;
    double seconds = 0.0;  ///< for all cases
    std::size_t reached = 0;
    double iterations = 0.0;  ///< mean; KDL counts its own
};

Contestant run_kdl(KDL::ChainIkSolverPos_LMA& solver, Cases& cases_of, const std::vector<Case>& all,
                   bool count) {
    Contestant result{"KDL LMA"};
    KDL::JntArray answer(3 * links);
    for (const Case& each : all) {
        solver.CartToJnt(each.start, KDL::Frame(each.target), answer);
        if (!count) continue;
        result.iterations += static_cast<double>(solver.lastNrOfIter) / static_cast<double>(all.size());
        if ((cases_of.end(answer, links) - each.target).Norm() <= tolerance) ++result.reached;
    }
    return result;
}

Contestant run_ours(Method method, Solver& solver, const std::vector<Case>& all, bool count) {
    Contestant result{name(method)};
    std::vector<glm::vec3> joints(links + 1);
    for (const Case& each : all) {
        std::copy(each.joints.begin(), each.joints.end(), joints.begin());
        const auto report = solver.solve(method, joints, to_glm(each.target),
                                         {.tolerance = static_cast<float>(tolerance), .max_iterations = 500});
        if (!count) continue;
        result.iterations += static_cast<double>(report.iterations) / static_cast<double>(all.size());
        const glm::vec3 tip = joints.back();
        if ((KDL::Vector(tip.x, tip.y, tip.z) - each.target).Norm() <= tolerance * 1.0001) ++result.reached;
    }
    return result;
}

bool contest(const char* title, Cases& cases_of, const KDL::Chain& chain, const std::vector<Case>& all) {
    Eigen::Matrix<double, 6, 1> weights;
    weights << 1, 1, 1, 0, 0, 0;
    KDL::ChainIkSolverPos_LMA kdl(chain, weights, tolerance, 500);
    Solver solver(std::vector<float>(links, 1.0f));
    std::vector<Contestant> results{run_kdl(kdl, cases_of, all, true),
                                    run_ours(Method::Fabrik, solver, all, true),
                                    run_ours(Method::FabrikPlain, solver, all, true)};
    const std::vector<double> seconds = race(
        {[&] { run_kdl(kdl, cases_of, all, false); }, [&] { run_ours(Method::Fabrik, solver, all, false); },
         [&] { run_ours(Method::FabrikPlain, solver, all, false); }},
        repetitions);
    std::printf("\n%s\n%-14s%12s%14s%10s%24s\n", title, "", "us a solve", "iterations", "reached",
                "time, over fabrik's");
    for (std::size_t i = 0; i < results.size(); ++i)
        std::printf("%-14s%12.3f%14.1f%9.1f%%%23.1fx\n", results[i].name,
                    seconds[i] * 1e6 / static_cast<double>(all.size()), results[i].iterations,
                    100.0 * static_cast<double>(results[i].reached) / static_cast<double>(all.size()),
                    seconds[i] / seconds[1]);
    return claim("time of KDL's LMA over that of fabrik", seconds[0] / seconds[1], 30.0) &
           claim("targets that fabrik reaches over those of KDL",
                 static_cast<double>(results[1].reached) / static_cast<double>(results[0].reached), 1.0);
}

}  // namespace

int main(int count, char** arguments) {
    const KDL::Chain chain = ball_chain();
    Cases cases_of(chain);
    std::vector<Case> poses, ball;
    for (std::size_t i = 0; i < cases; ++i) {
        poses.push_back(cases_of.with_target(cases_of.end(cases_of.pose(), links)));
        ball.push_back(cases_of.with_target(cases_of.in_ball()));
    }
    std::printf("%d links on ball joints, %zu targets, tolerance %g m; medians of %d\n", links, cases,
                tolerance, repetitions);
    bool all = contest("targets: the tips of random poses", cases_of, chain, poses);
    all &= contest("targets: anywhere in reach", cases_of, chain, ball);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
