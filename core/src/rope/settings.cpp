#include "tendril/rope/settings.hpp"

#include <cmath>

#include "chain/checks.hpp"

namespace tendril::rope {
namespace {

using tendril::detail::refuse;
using tendril::detail::text;

void in_range(const char* operation, const char* what, float value, float low, float high) {
    if (value >= low && value <= high) return;
    refuse(operation, what, text(low) + " to " + text(high), text(value));
}

void in_box(const char* operation, const char* what, const glm::vec3& value) {
    for (int i = 0; i < 3; ++i) {
        if (std::abs(value[i]) <= max_acceleration) continue;
        refuse(operation, what, "at most " + text(max_acceleration) + " m/s^2 each way", text(value[i]));
    }
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

void require(const char* operation, const Settings& settings) {
    if (!(settings.substep >= min_substep && settings.substep <= max_substep)) {
        refuse(operation, "substep", "1e-5 to 0.1 s", text(static_cast<float>(settings.substep)));
    }
    if (settings.iterations < 1 || settings.iterations > max_iterations) {
        refuse(operation, "iterations", "1 to " + std::to_string(max_iterations),
               std::to_string(settings.iterations));
    }
    if (static_cast<int>(settings.solver) > static_cast<int>(Solver::Direct)) {
        refuse(operation, "solver", "one of the three", std::to_string(static_cast<int>(settings.solver)));
    }
    in_range(operation, "damping", settings.damping, 0.0f, max_rate);
    in_box(operation, "gravity", settings.gravity);
    in_range(operation, "gravity_scale", settings.gravity_scale, -max_scale, max_scale);
    in_box(operation, "external", settings.external);
    in_range(operation, "compliance", settings.compliance, 0.0f, max_compliance);
    in_range(operation, "friction", settings.friction, 0.0f, max_friction);
    if (!(settings.longest_frame > 0.0f && settings.longest_frame <= 10.0f)) {
        refuse(operation, "longest_frame", "over 0, to 10 s", text(settings.longest_frame));
    }
}

}  // namespace tendril::rope
