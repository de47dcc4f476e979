// Shared by tests of the Rope lab.
#pragma once

#include "app/labs/rope/rope_lab.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

class RopeTest : public LabTest {
  protected:
    RopeTest() : LabTest(rope_lab) {}

    const RopePart& part() const { return rope_part(workspace); }
    const NamedWorld& world() const { return *part().world; }
    /// A single rope of 1 m at a height of 2 m, along +X.
    void single_rope(int segments = 8) {
        run("rope.clear");
        run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", segments}});
    }
    /// A cloth of 1 m that hangs by two corners, away from the rope.
    void add_cloth() {
        run("rope.cloth.add", {{"corner", {3, 2, 0}},
                               {"along", {1, 0, 0}},
                               {"down", {0, -1, 0}},
                               {"columns", 8},
                               {"rows", 8},
                               {"pins", "corners"}});
    }
};

}  // namespace tendril::app
