// Cost of a linkage's frame while its drivers glide, and of targets out of reach; against closed-chain-ik-js.
//
// The other solver is run by node, if both are there: set TENDRIL_CLOSED_CHAIN_IK to the folder of the
// package (npm install closed-chain-ik; node_modules/closed-chain-ik). It gets the same trees, closures and
// drivers, scaled to a size of 1,
// with its default settings and with tight ones. Its columns have the largest gap of a closure
// beside the time.
//
// Then targets out of reach: a point is dragged round a circle that it cannot reach, in 300 frames.
//
// Claims: a frame of 1 degree takes at most 1.1 loops (measure.hpp) for a four-bar, 5 for Jansen's leg, 18
// for a Stewart platform; closures are closed to 1e-6 of the size. Of targets out of reach, 19 frames in 20
// take at most 15 iterations.
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

struct Circle {
    std::string name;
    Linkage linkage;
    const char* point;
    glm::dvec3 centre;
    double radius;
};

Linkage open_chain(std::size_t bars) {
    LinkageSketch chain{.points = {{"P0", {0.0, 0.0}, SketchHold::Pinned}}};
    for (std::size_t i = 1; i <= bars; ++i) {
        const std::string name = i == bars ? "tip" : "P" + std::to_string(i);
        chain.points.push_back({name, {static_cast<double>(i), i % 2 == 1 ? 0.3 : 0.0}});
        chain.bars.push_back({"bar_" + std::to_string(i), {i - 1, i}});
    }
    return need(linkage_from(chain));
}

std::vector<Circle> circles() {
    LinkageSketch limited = need(four_bar());
    limited.motors.push_back({"rocker", 3, 2, ground_link, 0.0, 2.0});
    return {{"four-bar", need(linkage_from(need(four_bar()))), "P", {1, 1, 0}, 5.0},
            {"four-bar, inside", need(linkage_from(need(four_bar()))), "P", {0.9, 1.4, 0}, 0.3},
            {"four-bar, limited", need(linkage_from(limited)), "P", {1, 1, 0}, 3.0},
            {"slider-crank", need(linkage_from(need(slider_crank()))), "B", {0, 0, 0}, 4.0},
            {"Jansen's leg", need(linkage_from(need(jansen()))), "foot", {-20, -80, 0}, 60.0},
            {"delta robot", need(delta()), "platform", {0, 0, -0.6}, 0.5},
            {"chain of 3", open_chain(3), "tip", {0, 0, 0}, 4.5},
            {"chain of 10", open_chain(10), "tip", {0, 0, 0}, 15.0},
            {"chain of 40", open_chain(40), "tip", {0, 0, 0}, 60.0}};
}

/// Frames in a hundred that take at most 15 iterations, once round.
double quick_frames(const Circle& each, LinkageSolver& solver, int& most, double& mean) {
    constexpr int count = 300, few = 15;
    LinkageState state = solver.initial_state();
    const std::size_t point = *each.linkage.find_point(each.point);
    int quick = 0;
    most = 0;
    mean = 0.0;
    for (int i = -10; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / count;
        const LinkTarget target{
            point, each.centre + each.radius * glm::dvec3(std::cos(angle), std::sin(angle), 0.0)};
        const LinkageReport report = solver.solve(state, {{}, {&target, 1}});
        if (i < 0) continue;  // until it follows
        quick += report.iterations <= few;
        most = std::max(most, report.iterations);
        mean += static_cast<double>(report.iterations) / count;
    }
    return 100.0 * quick / count;
}

bool out_of_reach() {
    std::printf("\n%-18s%10s%12s%10s%10s\n", "out of reach", "us", "iterations", "most", "to 15, %");
    double fewest = 100.0;
    for (const Circle& each : circles()) {
        LinkageSolver solver = need(LinkageSolver::make(each.linkage));
        int most = 0;
        double mean = 0.0, quick = 0.0;
        const double us = 1e6 / 310 * race({[&] { quick = quick_frames(each, solver, most, mean); }}, 11)[0];
        std::printf("%-18s%10.1f%12.1f%10d%10.1f\n", each.name.c_str(), us, mean, most, quick);
        fewest = std::min(fewest, quick);
    }
    return claim("frames out of reach within 15 iterations, of 95 %", fewest / 95.0, 1.0);
}

/// In sizes of the linkage: the other solver's tolerances are for machines of about a metre.
void write_case(const Case& each, const LinkageSolver& solver, std::FILE* file) {
    const double scale = 1.0 / solver.size();
    const auto value_of = [&](std::size_t link, double value) {
        return each.linkage.links[link].joint == LinkJoint::Slider ? scale * value : value;
    };
    const auto point = [&](const char* key, const glm::dvec3& at) {
        std::fprintf(file, "\"%s\": [%.17g, %.17g, %.17g]", key, scale * at.x, scale * at.y, scale * at.z);
    };
    const auto index = [](std::size_t link) { return link == ground_link ? -1 : static_cast<int>(link); };
    std::fprintf(file, "{\"planar\": %s, \"links\": [", solver.planar() ? "true" : "false");
    for (std::size_t i = 0; i < each.linkage.links.size(); ++i) {
        const Link& link = each.linkage.links[i];
        std::fprintf(file, "%s{\"parent\": %d, \"joint\": \"%s\", \"rest\": %.17g, ", i ? ", " : "",
                     index(link.parent), name(link.joint), value_of(i, link.rest));
        point("at", link.at);
        std::fprintf(file, ", ");
        point("axis", solver.size() * glm::normalize(link.axis));
        std::fprintf(file, "}");
    }
    std::fprintf(file, "], \"closures\": [");
    for (std::size_t i = 0; i < each.linkage.closures.size(); ++i) {
        const Closure& closure = each.linkage.closures[i];
        std::fprintf(file, "%s{\"first\": %d, \"second\": %d, ", i ? ", " : "", index(closure.first),
                     index(closure.second));
        point("at", closure.first_at);
        std::fprintf(file, "}");
    }
    std::fprintf(file, "], \"drivers\": [");
    for (std::size_t i = 0; i < each.drivers.size(); ++i)
        std::fprintf(file, "%s%zu", i ? ", " : "", each.drivers[i]);
    std::fprintf(file, "], \"frames\": [");
    for (std::size_t i = 0; i < each.values.size(); ++i) {
        std::fprintf(file, "%s[", i ? ", " : "");
        for (std::size_t k = 0; k < each.values[i].size(); ++k)
            std::fprintf(file, "%s%.17g", k ? ", " : "", value_of(each.drivers[k], each.values[i][k]));
        std::fprintf(file, "]");
    }
    std::fprintf(file, "]}\n");
}

/// Microseconds a frame and the largest gap in sizes, by default and tight; nothing without node and the
/// package.
using Times = std::vector<std::pair<double, double>>;
Times rival(const Case& each, const LinkageSolver& solver) {
    const char* folder = std::getenv("TENDRIL_CLOSED_CHAIN_IK");
    Times found;
    if (!folder) return found;
    char path[] = "/tmp/tendril_linkage_XXXXXX";
    const int descriptor = mkstemp(path);
    std::FILE* file = descriptor < 0 ? nullptr : fdopen(descriptor, "w");
    if (!file) return found;
    write_case(each, solver, file);
    std::fclose(file);
    const std::string command =
        std::string("node '") + TENDRIL_BENCH_DIR + "/linkage_rival.mjs' '" + folder + "' " + path;
    if (std::FILE* answer = popen(command.c_str(), "r")) {
        double us = 0.0, gap = 0.0;
        while (std::fscanf(answer, "%lf %lf", &us, &gap) == 2) found.emplace_back(us, gap);
        pclose(answer);
    }
    std::remove(path);
    return found;
}

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

    std::printf("%-18s%6s%9s%10s%10s%12s%24s%24s\n", "", "links", "closures", "us", "steps", "gap, sizes ",
                "closed-chain-ik: us, gap", "tight: us, gap");
    bool holds = true, closed = true;
    std::vector<std::pair<std::string, double>> times;
    for (const Case& each : cases) {
        Run run(each);
        run.go();
        const int turns = each.linkage.links.size() > 20 ? 11 : 31;
        const double us = 1e6 / frames * race({[&] { run.go(); }}, turns)[0];
        const double gap = run.gap / run.solver.size();
        std::printf("%-18s%6zu%9zu%10.2f%10.2f%12.1e", each.name.c_str(), each.linkage.links.size(),
                    each.linkage.closures.size(), us,
                    static_cast<double>(run.iterations) / (frames * (turns + 1.0)), gap);
        // It needs minutes for the tall ones.
        const bool tall = each.linkage.closures.size() > 5;
        for (const auto& [other, apart] : tall ? Times{} : rival(each, run.solver))
            std::printf("%14.1f%10.1e", other, apart);
        std::printf("%s\n", run.reached ? "" : "  not all reached");
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
    holds = out_of_reach() && holds;
    return holds || !has_flag(count, arguments, "--check") ? 0 : 1;
}
