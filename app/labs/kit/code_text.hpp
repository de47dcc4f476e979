// Values as C++ source text, for the programs that *copy as C++* writes.
#pragma once

#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/state.hpp>
#include <tendril/rig/input.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/text.hpp"

namespace tendril::app {

/// The shortest decimal that reads back as exactly this number: "0.1", "0.1f". Must be finite.
std::string double_text(double value);
std::string literal(float value);
/// "{1.0f, 2.0f, 3.0f}", "{1.0, 2.0, 3.0}"
std::string braced(const glm::vec3& value);
std::string braced(const glm::dvec3& value);
std::string braced(const glm::dquat& value);  ///< "{w, x, y, z}"
/// A literal with its C++ type: "glm::dquat(w, x, y, z)", "rig::Value(0.5)", "rig::Transform{...}" without
/// members at their default.
std::string literal_code(bool value);
std::string literal_code(double value);
std::string literal_code(const glm::dvec3& value);
std::string literal_code(const glm::dquat& value);
std::string literal_code(const rig::Transform& value);
std::string literal_code(const rig::Value& value);
/// "22.5"
std::string degrees_text(float radians);
/// In quotes, with escapes.
std::string string_text(std::string_view text);
/// "one_euro" as "OneEuro"
std::string pascal_text(std::string_view name);

/// "tendril::ik::Side" as "ik::Side"
std::string library_name(std::string_view type);

/// ".damping = 0.5": each member that is not at its default, with its structs and lists, in table order;
/// without defaults, each that is not empty. Members must have the names of their fields, in the same order.
/// Each struct in a list is on its own line, after `margin`.
std::vector<std::string> member_texts(FieldsOf of, const std::string& margin = {});
/// "{.item = "hand", ...}" with a member per line, indented by `margin` and four blanks.
std::string kind_text(std::span<const Field> table, const void* object, const void* fresh,
                      const std::string& margin);
/// "{.name = "A", .at = {1.0, 0.0}}"
std::string struct_text(FieldsOf of, const std::string& margin = {});

/// ".kind = ik::JointKind::Hinge, ...": the members that are not at their default.
std::vector<std::string> limit_members(const ik::Limit& limit);
/// A statement that sets `name` to a joint's limit. Ends with a newline.
std::string limit_text(const std::string& name, const ik::Limit& limit, const std::string& margin);

/// Statements that restore the limits and pole of `name`, an ik::State, without the pole's joints.
std::vector<std::string> ik_memory_texts(const std::string& name, const ik::State& state);

}  // namespace tendril::app
