// Values as C++ has them; what the programs of *copy as C++* are built of.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <tendril/ik/state.hpp>
#include <tendril/signal/curve.hpp>
#include <vector>

#include "app/fields/fields.hpp"

namespace tendril::app {

/// The fewest decimals that a compiler reads as this very number: "0.1", "0.1f". Must be finite.
std::string double_text(double value);
std::string literal(float value);
/// "{1.0f, 2.0f, 3.0f}", "{1.0, 2.0, 3.0}"
std::string braced(const glm::vec3& value);
std::string braced(const glm::dvec3& value);
/// In quotes, with what has to be escaped.
std::string string_text(std::string_view text);
/// "one_euro" as "OneEuro"
std::string pascal_text(std::string_view name);

/// ".damping = 0.5" for each field, in table order. Members must have the names of their fields.
/// Choices are enumerators of `scope`: "rope::Solver::".
std::vector<std::string> member_texts(FieldsOf of, const std::string& scope = {});
/// ", " between them.
std::string joined(const std::vector<std::string>& texts);

/// Statements that restore the limits and pole of `name`, an ik::State, without the pole's joints.
std::vector<std::string> ik_memory_texts(const std::string& name, const ik::State& state);

/// "{{.time = 0.0, .value = 0.0, ...}, ...}", each key on a line of its own that begins with `margin`.
std::string keys_text(const signal::Curve& curve, const std::string& margin);

}  // namespace tendril::app
