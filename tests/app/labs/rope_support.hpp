// Shared by tests of the Rope lab.
#pragma once

#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
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
    void add_rope(const char* name, const Json& from, const Json& to, Json more = Json::object()) {
        more.update({{"name", name}, {"from", from}, {"to", to}});
        run("rope.add", more);
    }
    void add_cloth(const char* name, const Json& corner, const Json& along, const Json& down, int columns,
                   int rows, const char* pins = "none") {
        const Json size{{"columns", columns}, {"rows", rows}, {"pins", pins}};
        Json cloth{{"name", name}, {"corner", corner}, {"along", along}, {"down", down}};
        cloth.update(size);
        run("rope.cloth.add", cloth);
    }
    /// A race whose second pane shows the scene 2 m along +X.
    void race_aside() {
        run("rope.race");
        RopePart& changed = workspace.document.edit<RopePart>(rope_lab);
        auto elsewhere = std::make_shared<NamedWorld>(*changed.world);
        rope::State state = elsewhere->state();
        for (glm::dvec3& each : state.position) each.x += 2.0;
        elsewhere->put(std::move(state));
        changed.rivals[0].world = elsewhere;
    }
    /// A cloth of 1 m that hangs by two corners, away from the rope.
    void add_cloth() { add_cloth("cloth", {3, 2, 0}, {1, 0, 0}, {0, -1, 0}, 8, 8, "corners"); }
};

}  // namespace tendril::app
