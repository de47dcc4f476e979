#include "tendril/signal/batch.hpp"

#include <initializer_list>

#include "math/checks.hpp"
#include "signal/batch_vector.hpp"
#include "signal/stepped.hpp"
#include "tendril/signal/spring.hpp"

namespace tendril::signal {
namespace {

using tendril::detail::check_count;

struct List {
    const char* name;
    std::size_t size;
};
/// Checks that every list has `count` entries.
Result check_lists(const char* operation, std::size_t count, std::initializer_list<List> lists) noexcept {
    for (const List& list : lists)
        if (const Result bad = check_count(operation, list.name, list.size, count); !bad) return bad;
    return {};
}

Result check_lists(const char* operation, const SpringArrays& springs) noexcept {
    const std::size_t count = springs.value.size();
    const auto size_or_count = [count](std::span<const float> list) {
        return list.empty() ? count : list.size();
    };
    return check_lists(operation, count,
                       {{"strength", springs.strength.size()},
                        {"critical_damping", springs.critical_damping.size()},
                        {"force", size_or_count(springs.force)},
                        {"target_velocity_amount", size_or_count(springs.target_velocity_amount)},
                        {"target", springs.target.size()},
                        {"velocity", springs.velocity.size()},
                        {"previous_target", springs.previous_target.size()}});
}

const float* data_or_null(std::span<const float> list) noexcept {
    return list.empty() ? nullptr : list.data();
}

Expected<detail::VectorUnit> unit_of(const char* operation, const BatchOptions& options) noexcept {
    const detail::VectorUnit unit = detail::vector_unit(options.vector_unit);
    if (unit.step_springs) return unit;
    return tendril::detail::refused(operation, "vector_unit", "one of ik::vector_units()",
                                    options.vector_unit);
}

using InterpMember = void (*detail::VectorUnit::*)(const detail::InterpRows&, std::size_t, float);

Result interp(const char* operation, InterpMember member, std::span<float> current,
              std::span<const float> target, std::span<const float> speed, double dt,
              const BatchOptions& options) noexcept {
    const Result bad =
        check_lists(operation, current.size(), {{"target", target.size()}, {"speed", speed.size()}});
    if (!bad) return bad;
    const Expected<detail::VectorUnit> unit = unit_of(operation, options);
    if (!unit) return unit.error();
    if (is_step(dt))
        ((*unit).*member)({current.data(), target.data(), speed.data()}, current.size(),
                          static_cast<float>(detail::bounded_dt(dt)));
    return {};
}

}  // namespace

Result start_springs(const SpringArrays& springs) noexcept {
    if (const Result bad = check_lists("start_springs", springs); !bad) return bad;
    for (std::size_t i = 0; i < springs.value.size(); ++i) {
        const Spring<float> spring{.strength = static_cast<double>(springs.strength[i]),
                                   .critical_damping = static_cast<double>(springs.critical_damping[i]),
                                   .force = springs.force.empty() ? 0.0f : springs.force[i]};
        SpringState<float> state;
        springs.value[i] = step(spring, state, springs.target[i], 1.0);
        springs.velocity[i] = 0.0f;
        springs.previous_target[i] = state.previous_target;
    }
    return {};
}

Result step_springs(const SpringArrays& springs, double dt, const BatchOptions& options) noexcept {
    if (const Result bad = check_lists("step_springs", springs); !bad) return bad;
    const Expected<detail::VectorUnit> unit = unit_of("step_springs", options);
    if (!unit) return unit.error();
    if (!is_step(dt)) return {};
    unit->step_springs({springs.strength.data(), springs.critical_damping.data(), data_or_null(springs.force),
                        data_or_null(springs.target_velocity_amount), springs.target.data(),
                        springs.value.data(), springs.velocity.data(), springs.previous_target.data()},
                       springs.value.size(), static_cast<float>(detail::bounded_dt(dt)));
    return {};
}

Result interp_to(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                 double dt, const BatchOptions& options) noexcept {
    return interp("interp_to", &detail::VectorUnit::interp_to, current, target, speed, dt, options);
}
Result interp_to_exact(std::span<float> current, std::span<const float> target, std::span<const float> speed,
                       double dt, const BatchOptions& options) noexcept {
    return interp("interp_to_exact", &detail::VectorUnit::interp_to_exact, current, target, speed, dt,
                  options);
}

}  // namespace tendril::signal
