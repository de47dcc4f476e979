// Shared by tests of the Linkage lab.
#pragma once

#include "app/labs/linkage/linkage_lab.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

class LinkageTest : public LabTest {
  protected:
    LinkageTest() : LabTest(linkage_lab) { workspace.lab = linkage_lab; }
    const LinkagePart& part() const { return linkage_part(workspace); }
    LinkageRuntime& runtime() const { return workspace.runtimes.of<LinkageRuntime>(linkage_lab); }
    glm::dvec3 at(const char* point) const { return vector(state().at("points").at(point)); }
    double driver(const char* name) const { return state().at("drivers").at(name).get<double>(); }
    /// False if lengths do not close.
    static bool open_four_bar(LinkagePart& part, double ground, double crank, double coupler, double rocker,
                              LinkageRuntime& runtime) {
        try {
            open_mechanism(
                part, ik::FourBar{.ground = ground, .crank = crank, .coupler = coupler, .rocker = rocker},
                runtime);
        } catch (const std::invalid_argument&) {
            return false;
        }
        return true;
    }
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
