// The Chain lab's solvers, kept from solve to solve as their header asks: one per chain, and one for each
// part of it that a drag solves by itself. And what is studied: the trace or the race that the picture shows.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <span>
#include <tendril/chain/chain.hpp>
#include <vector>

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

    /// A solver for these bones: one that was made for the same before, or a new one. The reference holds
    /// until the next call. Throws std::invalid_argument for lengths that no chain has.
    ik::Solver& solver(std::span<const float> lengths, glm::vec3 rest_direction);
    ik::Solver& solver(const Chain& chain);

    /// What is studied; nothing while the part has no study open. Worked out anew only where something has
    /// changed that it follows from.
    Studied studied(const ChainPart& part);

    /// How many solvers it has made, for tests.
    std::size_t made() const { return made_; }

  private:
    static constexpr std::size_t most =
        4;  ///< a chain, and the two parts that a drag makes of it, and one more
    struct Kept;
    std::list<Kept> kept_;  ///< the one that was asked for last is first
    std::size_t made_ = 0;
    std::shared_ptr<const ChainPart> studied_part_;  ///< what `studied_` was worked out from
    Studied studied_;
};

}  // namespace tendril::app
