// Arguments of an emitted command: names and plain values, so that panels need no JSON to write
// emit("chain.insert", {{"index", 3}, {"position", at}}).
#pragma once

#include <concepts>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/io/json.hpp"

namespace tendril::app {

/// The value of an argument. In JSON, floats become their shortest exact decimals, points [x, y, z],
/// rotations [x, y, z, w].
class ArgumentValue {
  public:
    using Value =
        std::variant<bool, std::int64_t, float, double, std::string, glm::vec3, glm::quat, SharedJson>;

    ArgumentValue(bool value) : value_(value) {}
    template <std::integral Integer>
    requires(!std::same_as<Integer, bool>) ArgumentValue(Integer value)
        : value_(static_cast<std::int64_t>(value)) {}
    ArgumentValue(float value) : value_(value) {}
    ArgumentValue(double value) : value_(value) {}
    ArgumentValue(const char* text) : value_(std::string(text)) {}
    ArgumentValue(std::string text) : value_(std::move(text)) {}
    ArgumentValue(glm::vec3 point) : value_(point) {}
    ArgumentValue(glm::quat rotation) : value_(rotation) {}
    ArgumentValue(SharedJson json) : value_(std::move(json)) {}

    const Value& value() const { return value_; }

  private:
    Value value_;
};

struct NamedArgument {
    std::string name;
    ArgumentValue value;
};

using ArgumentList = std::vector<NamedArgument>;

/// A command to run.
struct CommandCall {
    std::string name;
    ArgumentList arguments{};
};

/// The JSON object that commands take. If a name repeats, its last value wins.
Json to_json(const ArgumentList& arguments);

}  // namespace tendril::app
