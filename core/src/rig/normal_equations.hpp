// The damped step of a least squares descent, from the derivatives of what is left. Not installed.
//
// What most numbers of a large rig leave as it is, is a zero in the matrices, and zeros are passed over: of
// controls that move bones of their own the cost grows with their number, not with its cube. Sums are taken
// four at a time, since each of them has to wait for itself; every one has its terms in their order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tendril::rig {

class NormalEquations {
  public:
    /// `columns`: by how much each number lessens what is left, for one more of it, as many entries each.
    /// Nothing is done yet: it can be too much. They are to stay until assemble.
    void plan(const std::vector<std::vector<double>>& columns);
    /// Multiplications, or what takes as long, that assemble and a solve take at most.
    std::uint64_t assembling() const noexcept { return assembling_; }
    std::uint64_t solving() const noexcept { return solving_; }

    void assemble(const std::vector<std::vector<double>>& columns, const std::vector<double>& left);

    /// Half the gradient, by number: positive where more of it leaves less.
    const std::vector<double>& gradient() const noexcept { return gradient_; }

    /// The step for a damping, in parts of the largest entry of the matrix: the more, the shorter, and the
    /// nearer to steepest descent. What is `still` does not move, and the others are solved for without it.
    /// False where there is no such step.
    bool solve(double damping, const std::vector<bool>& still, std::vector<double>& step);

  private:
    bool factor();

    std::size_t count_ = 0;
    std::vector<double> normal_, matrix_, gradient_;  ///< of symmetric ones the lower half
    std::vector<std::size_t> first_;                  ///< of a row of the matrix: where its zeros end
    std::vector<std::uint32_t> rows_;                 ///< of a column: where it is not 0
    std::uint64_t assembling_ = 0, solving_ = 0;
};

}  // namespace tendril::rig
