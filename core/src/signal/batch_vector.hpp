// Operations of a vector unit on arrays of springs and values. Not installed.
#pragma once

#include <cstddef>
#include <string_view>

namespace tendril::signal::detail {

/// Like SpringArrays; force and target_velocity_amount may be null.
struct SpringRows {
    const float *strength, *critical_damping, *force, *target_velocity_amount, *target;
    float *value, *velocity, *previous_target;
};
struct InterpRows {
    float* current;
    const float *target, *speed;
};

/// `dt` must be within its bounds.
struct VectorUnit {
    void (*step_springs)(const SpringRows& rows, std::size_t count, float dt) = nullptr;
    void (*interp_to)(const InterpRows& rows, std::size_t count, float dt) = nullptr;
    void (*interp_to_exact)(const InterpRows& rows, std::size_t count, float dt) = nullptr;
};
/// The unit of that name as in ik::vector_units(), or the widest if the name is empty; null functions for an
/// unknown name.
VectorUnit vector_unit(std::string_view name) noexcept;

}  // namespace tendril::signal::detail
