// The damped step of a least squares descent, from the derivatives of the residuals. Not installed.
//
// In a large rig most parameters leave most bones unmoved. These zeros are skipped: if each control moves its
// own bones, the cost grows with the square of the number of controls, not with its cube. Four sums are
// accumulated at a time to hide the latency of the additions; the order of terms within a sum is unchanged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tendril::rig {

class NormalEquations {
  public:
    /// `columns`: per parameter, how much each residual falls per unit of the parameter; all of the same
    /// size. Only computes an upper bound of the cost; `columns` must not change until assemble().
    void plan(const std::vector<std::vector<double>>& columns);
    /// Upper bounds of the cost of assemble() and of one solve(), in multiplications.
    std::uint64_t assembly_cost() const noexcept { return assembly_cost_; }
    std::uint64_t solve_cost() const noexcept { return solve_cost_; }

    void assemble(const std::vector<std::vector<double>>& columns, const std::vector<double>& residuals);

    /// Minus half the gradient of the squared residuals: positive if increasing the parameter lowers them.
    const std::vector<double>& gradient() const noexcept { return gradient_; }

    /// The step for a damping, given as a fraction of the largest diagonal entry: more damping gives a
    /// shorter step, closer to steepest descent. Parameters in `fixed` do not move; the others are solved for
    /// without them. False if there is no such step.
    bool solve(double damping, const std::vector<bool>& fixed, std::vector<double>& step);

  private:
    bool factor();

    std::size_t count_ = 0;
    std::vector<double> normal_, matrix_, gradient_;  ///< matrices: lower triangle only
    std::vector<std::size_t> first_;                  ///< per matrix row: first column that can be nonzero
    std::vector<std::uint32_t> rows_;                 ///< nonzero rows of the current column
    std::uint64_t assembly_cost_ = 0, solve_cost_ = 0;
};

}  // namespace tendril::rig
