#include "tendril/rope/settings.hpp"

namespace tendril {
namespace {

constexpr const char* solvers[] = {"relaxation", "xpbd", "direct"};

}  // namespace

template <>
std::span<const Field> fields<rope::Settings>() noexcept {
    using namespace rope;
    constexpr FieldRange acceleration{-max_acceleration, max_acceleration};
    static constexpr Field rows[] = {
        field<&Settings::substep>("substep", {min_substep, max_substep}, "s"),
        field<&Settings::iterations>("iterations", {1, max_iterations}),
        field<&Settings::solver>("solver", solvers),
        field<&Settings::damping>("damping", {0.0, max_rate}, "1/s"),
        field<&Settings::gravity>("gravity", acceleration, "m/s^2"),
        field<&Settings::gravity_scale>("gravity_scale", {-max_scale, max_scale}),
        field<&Settings::external>("external", acceleration, "m/s^2"),
        field<&Settings::compliance>("compliance", {0.0, max_compliance}, "1/N"),
        field<&Settings::friction>("friction", {0.0, max_friction}),
        field<&Settings::longest_frame>("longest_frame", {min_longest_frame, max_longest_frame}, "s")};
    return rows;
}

namespace rope {

const char* name(Solver solver) noexcept {
    const auto at = static_cast<std::size_t>(solver);
    return at < std::size(solvers) ? solvers[at] : "";
}

Result check(const char* operation, const Settings& settings) noexcept {
    return check_fields(operation, settings);
}

}  // namespace rope
}  // namespace tendril
