// Names used in commands, files and messages.
#include <cstddef>

#include "ik/limits/joint.hpp"
#include "tendril/ik/active_limit.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/report.hpp"

namespace tendril::ik {
namespace {

constexpr const char* statuses[] = {"Converged", "Stretched",      "TooClose",    "Limited",
                                    "Stalled",   "IterationLimit", "InvalidInput"};
constexpr const char* bounds[] = {"min", "max", "up", "down", "left", "right", "twist_min", "twist_max"};

/// Ranges in a saved report: steps; metres, infinite if it was refused.
constexpr FieldRange steps{0.0, 1e9}, distances{0.0, std::numeric_limits<double>::infinity()},
    angles{-10.0, 10.0};

constexpr Field report_rows[] = {field<&Report::status>("status", statuses),
                                 field<&Report::iterations>("iterations", steps),
                                 field<&Report::residual>("residual", distances, "m"),
                                 field<&Report::closed_form>("closed_form"),
                                 field<&Report::perturbations>("perturbations", steps),
                                 field<&Report::least_squares_steps>("least_squares_steps", steps),
                                 field<&Report::restarts>("restarts", steps),
                                 field<&Report::off_plane>("off_plane", distances, "m")};

}  // namespace

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
    return statuses[static_cast<std::size_t>(status)];
}

const char* name(Bound bound) noexcept {
    return bounds[static_cast<std::size_t>(bound)];
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

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Report>() noexcept {
    return ik::report_rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ActiveLimit>() noexcept {
    using ik::ActiveLimit;
    static constexpr Field rows[] = {field<&ActiveLimit::joint>("joint", {0.0, 1e6}),
                                     field<&ActiveLimit::kind>("kind", ik::detail::kind_names),
                                     field<&ActiveLimit::bound>("bound", ik::bounds),
                                     field<&ActiveLimit::limit>("limit", ik::angles, "rad"),
                                     field<&ActiveLimit::needed>("needed", ik::angles, "rad"),
                                     field<&ActiveLimit::enough>("enough")};
    return rows;
}
