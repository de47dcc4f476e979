// Names used in commands, files and messages.
#include <cstddef>

#include "tendril/ik/active_limit.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik {

const char* name(Method method) noexcept {
    constexpr const char* names[] = {"fabrik", "fabrik_plain", "ccd",     "jacobian_transpose",
                                     "dls",    "svd_dls",      "two_bone"};
    return names[static_cast<std::size_t>(method)];
}

std::optional<Method> method_named(std::string_view text) noexcept {
    for (const Method method : all_methods) {
        if (text == name(method)) return method;
    }
    return std::nullopt;
}

const char* name(Status status) noexcept {
    constexpr const char* names[] = {"Converged", "Stretched",      "TooClose",    "Limited",
                                     "Stalled",   "IterationLimit", "InvalidInput"};
    return names[static_cast<std::size_t>(status)];
}

const char* name(Bound bound) noexcept {
    constexpr const char* names[] = {"min", "max", "up", "down", "left", "right", "twist_min", "twist_max"};
    return names[static_cast<std::size_t>(bound)];
}

const char* name(AngleFrom from) noexcept {
    return from == AngleFrom::Base ? "base" : "bone";
}

const char* name(Phase phase) noexcept {
    constexpr const char* names[] = {
        "prepare", "forward_reaching", "backward_reaching", "accelerate", "rotate", "gradient", "pole",
        "limit",   "analytic",         "restore_best",      "blend"};
    return names[static_cast<std::size_t>(phase)];
}

}  // namespace tendril::ik
