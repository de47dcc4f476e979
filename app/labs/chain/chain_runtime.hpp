// The Chain lab's solvers, reused between solves as their header asks: one for the chain, and one for each
// section that a drag solves separately. Also caches the result of the open study.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <span>
#include <tendril/chain/chain.hpp>

#include "app/document/workspace.hpp"
#include "app/labs/chain/study.hpp"

namespace tendril::ik {
class Solver;
}

namespace tendril::app {

struct ChainPart;

class ChainRuntime final : public Runtime {
  public:
    ChainRuntime();
    ~ChainRuntime() override;

    /// A cached or new solver for these bones. The reference is valid until the next call. Throws
    /// std::invalid_argument for invalid lengths.
    ik::Solver& solver(std::span<const float> lengths, glm::vec3 rest_direction);
    ik::Solver& solver(const Chain& chain);

    /// The result of the open study; empty if none is open. Recomputed only when its inputs change.
    Studied studied(const ChainPart& part);

    /// Number of solvers created, for tests.
    std::size_t made() const { return made_; }

  private:
    static constexpr std::size_t most =
        4;  ///< a chain, the two sections that a drag splits it into, and a spare
    struct Kept;
    std::list<Kept> kept_;  ///< most recently used first
    std::size_t made_ = 0;
    std::shared_ptr<const ChainPart> studied_part_;  ///< the inputs of `studied_`
    Studied studied_;
};

}  // namespace tendril::app
