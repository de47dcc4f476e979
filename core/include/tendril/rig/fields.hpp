// The fields of every operation, listed once: readers, writers, checks and panels all use this list.
//
//     fields(operation, [&](const char* name, auto& field) { ... });
//
// calls the function with every field, const if the operation is. A field is an Input, an Item, a literal, or
// a compound of these: AimInputs, ParentInputs, the units in the body of a for-each.
#pragma once

#include <type_traits>

#include "tendril/rig/unit.hpp"

namespace tendril::rig {

template <class T, class Visit>
void fields(T& op, Visit&& visit) {
    using Op = std::remove_const_t<T>;
    if constexpr (std::is_same_v<Op, AimInputs>) {
        visit("axis", op.axis);
        visit("target", op.target);
        visit("kind", op.kind);
        visit("weight", op.weight);
    } else if constexpr (std::is_same_v<Op, Aim>) {
        visit("item", op.item);
        visit("primary", op.primary);
        visit("secondary", op.secondary);
        visit("max_speed", op.max_speed);
    } else if constexpr (std::is_same_v<Op, AimMath>) {
        visit("transform", op.transform);
        visit("primary", op.primary);
        visit("secondary", op.secondary);
        visit("max_speed", op.max_speed);
    } else if constexpr (std::is_same_v<Op, ParentInputs>) {
        visit("item", op.item);
        visit("weight", op.weight);
    } else if constexpr (std::is_same_v<Op, ParentConstraint>) {
        visit("item", op.item);
        visit("parents", op.parents);
        visit("maintain_offset", op.maintain_offset);
        visit("filter", op.filter);
    } else if constexpr (std::is_same_v<Op, OffsetTransform>) {
        visit("item", op.item);
        visit("offset", op.offset);
        visit("propagate", op.propagate);
    } else if constexpr (std::is_same_v<Op, SetTransform>) {
        visit("item", op.item);
        visit("transform", op.transform);
        visit("space", op.space);
        visit("propagate", op.propagate);
    } else if constexpr (std::is_same_v<Op, SetRotation>) {
        visit("item", op.item);
        visit("rotation", op.rotation);
        visit("space", op.space);
        visit("propagate", op.propagate);
    } else if constexpr (std::is_same_v<Op, ProjectToParent>) {
        visit("child", op.child);
        visit("old_parent", op.old_parent);
        visit("new_parent", op.new_parent);
    } else if constexpr (std::is_same_v<Op, FromTwoVectors>) {
        visit("from", op.from);
        visit("to", op.to);
    } else if constexpr (std::is_same_v<Op, TransformLocation>) {
        visit("transform", op.transform);
        visit("location", op.location);
    } else if constexpr (std::is_same_v<Op, TransformDirection>) {
        visit("transform", op.transform);
        visit("direction", op.direction);
    } else if constexpr (std::is_same_v<Op, ForEach>) {
        visit("roots", op.roots);
        visit("include_parent", op.include_parent);
        visit("recursive", op.recursive);
        visit("body", op.body);
    } else if constexpr (std::is_same_v<Op, AlphaInterpolate>) {
        visit("value", op.value);
        visit("map_range", op.map_range);
        visit("in_range", op.in_range);
        visit("out_range", op.out_range);
        visit("scale", op.scale);
        visit("bias", op.bias);
        visit("clamp", op.clamp);
        visit("clamp_min", op.clamp_min);
        visit("clamp_max", op.clamp_max);
        visit("interp", op.interp);
        visit("speed_increasing", op.speed_increasing);
        visit("speed_decreasing", op.speed_decreasing);
    } else if constexpr (std::is_same_v<Op, SpringInterpolate>) {
        visit("target", op.target);
        visit("strength", op.strength);
        visit("critical_damping", op.critical_damping);
        visit("force", op.force);
        visit("target_velocity_amount", op.target_velocity_amount);
    } else if constexpr (std::is_same_v<Op, EvaluateCurve>) {
        visit("value", op.value);
        visit("curve", op.curve);
    } else if constexpr (std::is_same_v<Op, SetCurve>) {
        visit("curve", op.curve);
        visit("value", op.value);
    } else if constexpr (std::is_same_v<Op, Spline>) {
        visit("root", op.root);
        visit("tip", op.tip);
        visit("points", op.points);
        visit("b_spline", op.b_spline);
        visit("fit", op.fit);
        visit("max_factor", op.max_factor);
        visit("up", op.up);
        visit("roll_start_deg", op.roll_start_deg);
        visit("roll_end_deg", op.roll_end_deg);
    } else {
        static_assert(std::is_same_v<Op, TwoBone> || std::is_same_v<Op, Fabrik>, "list its fields here");
        visit("root", op.root);
        visit("tip", op.tip);
        visit("target", op.target);
        visit("pole_target", op.pole_target);
    }
}

}  // namespace tendril::rig
