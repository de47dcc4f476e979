// Linkages driven and inspected by name, and random ones.
#pragma once

#include <glm/geometric.hpp>
#include <numbers>

#include "memory.hpp"
#include "random.hpp"
#include "tendril/ik/mechanisms.hpp"
#include "tests/says.hpp"

namespace tendril::test::linkage {

using namespace ik;

/// Radians of an angle in degrees.
inline double deg(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

/// A linkage driven and inspected by name.
struct Machine {
    explicit Machine(const Expected<Linkage>& linkage)
        : solver(std::move(*LinkageSolver::make(*linkage))), state(solver.initial_state()) {}
    explicit Machine(const Expected<LinkageSketch>& sketch) : Machine(linkage_from(*sketch)) {}

    std::size_t link(const std::string& name) const { return solver.linkage().find_link(name).value(); }
    std::size_t point_index(const std::string& name) const {
        return solver.linkage().find_point(name).value();
    }
    glm::dvec3 point(const std::string& name) const { return solver.point(point_index(name)); }
    double value(const std::string& name) const { return state.joints[link(name)].value; }
    LinkageReport drive(const std::string& name, double value) {
        const LinkDriver driver{link(name), value};
        return solver.solve(state, {{&driver, 1}, {}});
    }
    LinkageReport reach(const std::string& name, const glm::dvec3& to, bool exact = false) {
        const LinkTarget target{point_index(name), to, 1.0, exact};
        return solver.solve(state, {{}, {&target, 1}});
    }

    LinkageSolver solver;
    LinkageState state;
};

/// A point in the plane; each coordinate from -range to range.
inline glm::dvec3 random_place(Random& random, float range) {
    const double x = random.around(range), y = random.around(range);
    return {x, y, 0.0};
}

/// Two cranks of 1 m, joined by an elbow.
inline LinkageSketch five_bar() {
    LinkageSketch sketch{.points = {{"A", {0, 0}, SketchHold::Pinned},
                                    {"B", {0, 1}},
                                    {"C", {1, 1.8}},
                                    {"D", {2, 1}},
                                    {"E", {2, 0}, SketchHold::Pinned}},
                         .bars = {{"left", {0, 1}}, {"BC", {1, 2}}, {"CD", {2, 3}}, {"right", {4, 3}}},
                         .motors = {{"left", 0, 0}, {"right", 4, 3}}};
    return sketch;
}

/// A crank with dyads: each new point is joined by two bars to two earlier points.
inline LinkageSketch random_sketch(Random& random) {
    LinkageSketch sketch;
    const auto place = [&] { return glm::dvec2(random_place(random, 2.0f)); };
    const auto bar = [&](std::size_t a, std::size_t b) {
        sketch.bars.push_back({"bar_" + std::to_string(sketch.bars.size()), {a, b}});
    };
    sketch.points = {{"O", place(), SketchHold::Pinned}, {"A", place()}};
    bar(0, 1);
    sketch.motors = {{"motor", 0, 0}};
    for (std::size_t i = random.below(5) + 1; i-- > 0;) {
        const std::size_t count = sketch.points.size();
        if (random.chance(2)) sketch.points.push_back({"pin", place(), SketchHold::Pinned});
        const std::size_t one = random.chance(2) ? 1 + random.below(count - 1) : count - 1;
        std::size_t other = sketch.points.size() - 1;
        if (other == one) other = 0;
        if (random.chance(4)) {
            // A single bar, to a sliding point.
            sketch.points.push_back({"S" + std::to_string(count), place(), SketchHold::Guided,
                                     3.0 * static_cast<double>(random.part())});
            bar(one, sketch.points.size() - 1);
            continue;
        }
        sketch.points.push_back({"P", place()});
        bar(one, sketch.points.size() - 1);
        bar(other, sketch.points.size() - 1);
    }
    return sketch;
}

}  // namespace tendril::test::linkage
