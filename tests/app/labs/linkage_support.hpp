// Shared by tests of the Linkage lab.
#pragma once

#include "app/labs/linkage/linkage_lab.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

/// None if it does not close as drawn.
inline std::optional<LinkagePart> opened(const ik::FourBar& lengths, LinkageRuntime& runtime) {
    std::optional<LinkagePart> part(std::in_place);
    try {
        open_mechanism(*part, lengths, runtime);
    } catch (const std::invalid_argument&) {
        part.reset();
    }
    return part;
}

class LinkageTest : public LabTest {
  protected:
    LinkageTest() : LabTest(linkage_lab) { workspace.lab = linkage_lab; }
    const LinkagePart& part() const { return linkage_part(workspace); }
    LinkageRuntime& runtime() const { return workspace.runtimes.of<LinkageRuntime>(linkage_lab); }
    glm::dvec3 at(const char* point) const { return vector(state().at("points").at(point)); }
    double driver(const char* name) const { return state().at("drivers").at(name).get<double>(); }
    void four_bar() {
        run("linkage.preset", {{"name", "four_bar"}});
        run("linkage.set", {{"lengths", {{"ground", 3}, {"crank", 1}, {"coupler", 2.5}, {"rocker", 2}}}});
    }
    /// Draws by hand: pins A and D, bars A-B, B-C, C-D, and a motor at A.
    void draw_four_bar() {
        run("linkage.clear");
        run("linkage.bar", {{"from", {0, 0, 0}}, {"to", {0, 1, 0}}});
        run("linkage.bar", {{"from", "B"}, {"to", {2, 2, 0}}});
        run("linkage.bar", {{"from", "C"}, {"to", {3, 0, 0}}});
        run("linkage.pin", {{"point", "A"}});
        run("linkage.pin", {{"point", "D"}});
        run("linkage.motor.add", {{"point", "A"}});
    }
};

}  // namespace tendril::app
