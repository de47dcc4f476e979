// Shared by tests of the Chain lab's commands.
#pragma once

#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

class ChainTest : public LabTest {
  protected:
    ChainTest() : LabTest(chain_lab) {}

    const ChainPart& part() const { return chain_part(workspace); }
    /// A chain of bones of 1 m along +X, in mode Reach.
    void reach_with(int bones) {
        run("chain.preset", {{"name", "start"}, {"count", bones + 1}});
        run("chain.mode", {{"mode", "reach"}});
    }
    float tip_distance() const {
        return glm::distance(part().chain.position(part().chain.size() - 1), part().target);
    }
};

}  // namespace tendril::app
