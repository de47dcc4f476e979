// Cost of a linkage's frame while its drivers glide.
//
// Claims: a frame of 1 degree takes at most 1.1 loops (measure.hpp) for a four-bar, 5 for Jansen's leg, 18
// for a Stewart platform; closures are closed to 1e-6 of the size.
#include <glm/geometric.hpp>
#include <numbers>

#include "measure.hpp"
#include "tendril/ik/mechanisms.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::ik;

constexpr int frames = 360;

struct Case {
    std::string name;
    Linkage linkage;
    std::vector<std::size_t> drivers;
    std::vector<std::vector<double>> values;  ///< one list per frame, one value per driver
};

template <class Made>
auto need(Made made) {
    require(made.error());
    return std::move(*made);
}

/// Once round, or as far as `range` up and down from where it is drawn.
Case turning(const std::string& name, const LinkageSketch& sketch, const char* driver, double range) {
    Case each{name, need(linkage_from(sketch)), {}, {}};
    const std::size_t link = *each.linkage.find_link(driver);
    each.drivers = {link};
    for (int i = 1; i <= frames; ++i) {
        const double part = 2.0 * std::numbers::pi * i / frames;
        each.values.push_back(
            {each.linkage.links[link].rest + (range > 0.0 ? range * std::sin(part) : part)});
    }
    return each;
}

/// Twelve of Jansen's legs in one linkage, each with its own motor, a twelfth of a turn apart.
Case twelve_legs() {
    LinkageSketch all;
    for (int leg = 0; leg < 12; ++leg) {
        LinkageSketch one = need(jansen());
        const std::size_t points = all.points.size(), bars = all.bars.size();
        for (SketchBar& bar : one.bars) {
            for (std::size_t& each : bar.points) each += points;
            bar.name += "_" + std::to_string(leg);
            all.bars.push_back(bar);
        }
        for (SketchMotor motor : one.motors) {
            motor.point += points;
            motor.bar += bars;
            motor.name += "_" + std::to_string(leg);
            all.motors.push_back(motor);
        }
        for (const SketchPoint& point : one.points) all.points.push_back(point);
    }
    Case each{"twelve legs", need(linkage_from(all)), {}, {}};
    for (std::size_t i = 0; i < each.linkage.links.size(); ++i)
        if (each.linkage.links[i].name.starts_with("motor_")) each.drivers.push_back(i);
    for (int i = 1; i <= frames; ++i) {
        each.values.emplace_back();
        for (int leg = 0; leg < 12; ++leg)
            each.values.back().push_back(2.0 * std::numbers::pi *
                                         (static_cast<double>(i) / frames + leg / 12.0));
    }
    return each;
}

Case circling_stewart() {
    Case each{"Stewart platform", need(stewart()), {}, {}};
    for (int k = 0; k < 6; ++k) each.drivers.push_back(*each.linkage.find_link("leg_" + std::to_string(k)));
    for (int i = 1; i <= frames; ++i) {
        const double part = 2.0 * std::numbers::pi * i / frames;
        const auto legs =
            stewart_legs({}, {0.2 * std::sin(part), 0.2 * std::sin(2.0 * part), 1.0}, {1.0, 0.0, 0.0, 0.0});
        each.values.emplace_back(legs.begin(), legs.end());
    }
    return each;
}

Case circling_delta() {
    Case each{"delta robot", need(delta()), {}, {}};
    for (int k = 0; k < 3; ++k) each.drivers.push_back(*each.linkage.find_link("motor_" + std::to_string(k)));
    for (int i = 1; i <= frames; ++i) {
        const double part = 2.0 * std::numbers::pi * i / frames;
        const auto motors = delta_motors({}, {0.1 * std::sin(part), 0.1 * std::cos(part), -0.45});
        each.values.emplace_back(motors->begin(), motors->end());
    }
    return each;
}

struct Run {
    explicit Run(const Case& each)
        : task(each), solver(need(LinkageSolver::make(each.linkage))), state(solver.initial_state()) {}
    /// Once through all frames.
    void go() {
        std::vector<LinkDriver> drivers;
        for (const std::size_t link : task.drivers) drivers.push_back({link, 0.0});
        for (const std::vector<double>& values : task.values) {
            for (std::size_t k = 0; k < drivers.size(); ++k) {
                drivers[k].value = values[k];
                // The crank goes on turning.
                const double behind = state.joints[drivers[k].link].value - values[k];
                if (task.linkage.links[drivers[k].link].joint == LinkJoint::Hinge)
                    drivers[k].value +=
                        2.0 * std::numbers::pi * std::round(behind / (2.0 * std::numbers::pi));
            }
            const LinkageReport report = solver.solve(state, {drivers, {}});
            gap = std::max(gap, report.closed_to);
            iterations += report.iterations;
            reached = reached && report.status == LinkageStatus::Reached;
        }
    }

    const Case& task;
    LinkageSolver solver;
    LinkageState state;
    double gap = 0.0;
    long iterations = 0;
    bool reached = true;
};

}  // namespace

int main(int count, char** arguments) {
    std::vector<Case> cases;
    cases.push_back(turning("four-bar", need(four_bar()), "crank", 0.0));
    cases.push_back(turning("slider-crank", need(slider_crank()), "crank", 0.0));
    cases.push_back(turning("Peaucellier", need(peaucellier()), "crank", 0.8));
    cases.push_back(turning("Jansen's leg", need(jansen()), "motor", 0.0));
    cases.push_back(twelve_legs());
    cases.push_back(circling_delta());
    cases.push_back(circling_stewart());
    for (const std::size_t stages : {1u, 4u, 16u, 32u})
        cases.push_back(turning("lift of " + std::to_string(stages), need(scissor_lift({stages, 1.0, 0.8})),
                                "lift", 0.4));

    std::printf("%-18s%6s%9s%10s%10s%12s\n", "", "links", "closures", "us", "steps", "gap, sizes");
    bool holds = true, closed = true;
    std::vector<std::pair<std::string, double>> times;
    for (const Case& each : cases) {
        Run run(each);
        run.go();
        const int turns = each.linkage.links.size() > 20 ? 11 : 31;
        const double us = 1e6 / frames * race({[&] { run.go(); }}, turns)[0];
        const double gap = run.gap / run.solver.size();
        std::printf("%-18s%6zu%9zu%10.2f%10.2f%12.1e%s\n", each.name.c_str(), each.linkage.links.size(),
                    each.linkage.closures.size(), us,
                    static_cast<double>(run.iterations) / (frames * (turns + 1.0)), gap,
                    run.reached ? "" : "  not all reached");
        std::fflush(stdout);
        closed = closed && run.reached && gap <= 1e-6;
        times.emplace_back(each.name, us);
    }
    const std::pair<const char*, double> limits[] = {
        {"four-bar", 1.1}, {"Jansen's leg", 5.0}, {"Stewart platform", 18.0}};
    for (const auto& [name, limit] : limits)
        for (const auto& [each, us] : times)
            if (each == name) holds = claim_loops(each.c_str(), 1e-6 * us, limit) && holds;
    holds = claim("every frame reached, and closed to 1e-6 of the size", closed ? 1.0 : 0.0, 1.0) && holds;
    return holds || !has_flag(count, arguments, "--check") ? 0 : 1;
}
