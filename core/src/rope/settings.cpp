#include "tendril/rope/settings.hpp"

#include <cmath>

#include "math/checks.hpp"

namespace tendril::rope {
namespace {

using tendril::detail::refused;

struct Range {
    const char* name;
    float value, low, high;
    const char* words;
};

bool within(const glm::vec3& value) {
    return std::abs(value.x) <= max_acceleration && std::abs(value.y) <= max_acceleration &&
           std::abs(value.z) <= max_acceleration;
}

Result check_acceleration(const char* operation, const char* what, const glm::vec3& value) {
    if (within(value)) return {};
    int axis = 0;
    while (std::abs(value[axis]) <= max_acceleration) ++axis;
    return refused(operation, what, "at most 10000 m/s^2 each way", value[axis]);
}

}  // namespace

const char* name(Solver solver) noexcept {
    switch (solver) {
        case Solver::Relaxation:
            return "relaxation";
        case Solver::Xpbd:
            return "xpbd";
        case Solver::Direct:
            return "direct";
    }
    return "";
}

Result check(const char* operation, const Settings& settings) noexcept {
    if (!(settings.substep >= min_substep && settings.substep <= max_substep))
        return refused(operation, "substep", "1e-5 to 0.1 s", settings.substep);
    if (settings.iterations < 1 || settings.iterations > max_iterations)
        return refused(operation, "iterations", "1 to 10000", settings.iterations);
    if (static_cast<int>(settings.solver) > static_cast<int>(Solver::Direct))
        return refused(operation, "solver", "one of the three", static_cast<int>(settings.solver));
    const Range ranges[] = {{"damping", settings.damping, 0.0f, max_rate, "0 to 1000 1/s"},
                            {"gravity_scale", settings.gravity_scale, -max_scale, max_scale, "-1000 to 1000"},
                            {"compliance", settings.compliance, 0.0f, max_compliance, "0 to 1000 1/N"},
                            {"friction", settings.friction, 0.0f, max_friction, "0 to 100"},
                            {"longest_frame", settings.longest_frame, 1e-30f, 10.0f, "over 0, to 10 s"}};
    for (const Range& range : ranges) {
        if (!(range.value >= range.low && range.value <= range.high))
            return refused(operation, range.name, range.words, range.value);
    }
    const Result gravity = check_acceleration(operation, "gravity", settings.gravity);
    return gravity ? check_acceleration(operation, "external", settings.external) : gravity;
}

}  // namespace tendril::rope
