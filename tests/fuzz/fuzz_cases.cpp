// A file of cases is refused with a std::runtime_error, or every solver solves every case in it: lengths are
// kept, results are finite, limits hold, and the start is unchanged if the solver refuses. Linkages go
// through their first rows.
#include <algorithm>
#include <cmath>
#include <tendril/ik/solver.hpp>

#include "app/batch/cases.hpp"
#include "app/io/json_complete.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril;
using tendril::fuzz::check;

namespace {

constexpr std::size_t max_bones = 64, max_cases = 16;

bool finite(const glm::vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

std::vector<glm::vec3> start_of(const app::Case& each) {
    if (!each.start.empty()) return each.start;
    std::vector<glm::vec3> joints{glm::vec3(0.0f)};
    for (const float length : each.lengths) joints.push_back(joints.back() + glm::vec3(length, 0.0f, 0.0f));
    return joints;
}

void solve(const app::Case& each) {
    for (const ik::Method method : ik::all_methods) {
        ik::Solver solver = ik::Solver::make(each.lengths, each.rest_directions).value();
        ik::State state = solver.initial_state();
        ik::Options options{.max_iterations = 20, .limits = each.limits, .pole = each.pole};
        const std::vector<glm::vec3> start = start_of(each);
        std::vector<glm::vec3> joints = start;
        const ik::Report report = solver.solve(method, joints, state, each.target, options);
        if (report.status == ik::Status::InvalidInput) {
            check(joints == start, "what is refused is not moved");
            continue;
        }
        check(std::isfinite(report.residual), "the residual is a number");
        check(std::all_of(joints.begin(), joints.end(), finite), "the joints are numbers");
        check(joints.front() == start.front(), "the root stays");
    }
}

void solve(app::LinkageCase linkage) {
    app::LinkageRuntime runtime;
    for (std::size_t row = 0; row < std::min<std::size_t>(linkage.rows(), 4); ++row) {
        linkage.solve(row, runtime, {.max_iterations = 20});
        const app::LinkagePart& part = linkage.part;
        check(part.result.report.status != ik::LinkageStatus::InvalidInput, "what was read can be solved");
        for (std::size_t i = 0; i < part.linkage().points.size(); ++i) {
            const glm::dvec3 at = part.at(i);
            check(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z), "points are numbers");
        }
        check(!app::linkage_row_json(part).empty(), "it says what it did");
    }
}

}  // namespace

FUZZ_TARGET(cases) {
    try {
        std::size_t cases = 0;
        app::read_cases(text, [&](const app::Case& each, double part) {
            check(part >= 0.0 && part <= 1.0, "how far the reading is lies between none and all");
            if (each.linkage)
                solve(*each.linkage);
            else if (each.lengths.size() <= max_bones)
                solve(each);
            return ++cases < max_cases;
        });
    } catch (const std::runtime_error& error) {
        check(error.what()[0] != '\0', "a refusal says why");
    } catch (const std::invalid_argument&) {
        check(false, "what a solver cannot be made from is refused with its place");
    }
}
