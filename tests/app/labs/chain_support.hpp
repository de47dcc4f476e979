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
    /// Limits for the joints from `first` to before `end`: cones about the bone before.
    void cones(int first, int end, double degrees, Json more = Json::object()) {
        more["kind"] = "ball_and_socket";
        for (int i = first; i < end; ++i) more["joints"].push_back(i);
        for (const char* const side : {"up_deg", "down_deg", "left_deg", "right_deg"}) more[side] = degrees;
        run("chain.limit", more);
    }
    float tip_distance() const { return glm::distance(positions(part().chain).back(), part().target); }
};

}  // namespace tendril::app
