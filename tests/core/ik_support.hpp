// Shared by solver tests: poses, a solver with its state, and an observer that can replay.
#pragma once

#include "ik_poses.hpp"
#include "kept_solver.hpp"
#include "memory.hpp"

namespace tendril::test {

/// The methods that iterate on any chain.
inline constexpr std::array iterating_methods{ik::Method::Fabrik, ik::Method::FabrikPlain,
                                              ik::Method::Ccd,    ik::Method::JacobianTranspose,
                                              ik::Method::Dls,    ik::Method::SvdDls};

/// Records every step, and can replay them.
class Recorder : public ik::Observer {
  public:
    void step(const ik::Step& step) noexcept override { steps.push_back(step); }
    void iteration_done(int iteration, float residual) noexcept override {
        iterations.push_back(iteration);
        residuals.push_back(residual);
    }

    /// The joints after replaying from `joints`; fails if a step does not start where its joint is.
    Joints replay(Joints joints) const {
        for (const ik::Step& step : steps) {
            EXPECT_LT(step.joint, joints.size());
            if (step.joint >= joints.size()) return joints;
            EXPECT_TRUE(test::same_bits(joints[step.joint], step.from)) << "step " << step.order;
            joints[step.joint] = step.to;
        }
        return joints;
    }

    std::vector<ik::Step> steps;
    std::vector<int> iterations;
    std::vector<float> residuals;
};

}  // namespace tendril::test
