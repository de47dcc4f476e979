// What a command takes: how its arguments are declared, and those it was given.
#pragma once

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

struct Workspace;

/// NumberOrPoint: one number, or three. Rotation: a unit quaternion [x, y, z, w], or degrees about X, then Y,
/// then Z. What is in a List, and Any value
/// whatever, the command checks.
enum class ArgumentType {
    Number,
    Integer,
    Boolean,
    Text,
    Point,
    NumberOrPoint,
    Rotation,
    List,
    ListOrText,
    Any
};

struct Argument {
    std::string name;
    ArgumentType type = ArgumentType::Number;
    bool required = true;
    std::string help{};
    double low = -1e9, high = 1e9;       ///< for numbers and integers
    std::vector<std::string> choices{};  ///< for texts; empty: any
    /// For the palette. Names (or numbers) of the things that are there to be named; others may do as well.
    std::function<std::vector<std::string>(const Workspace&)> known{};
    /// Of a list: the argument of the same command that each of it could be given to.
    std::string list_of{};
    /// What it is set to now.
    std::function<std::string(const Workspace&)> present{};
};

/// Arguments that have been checked against their command: present where required, of the right type, finite
/// and in range.
class Arguments {
  public:
    explicit Arguments(const Json& json) : json_(json) {}
    bool has(const char* name) const;
    float number(const char* name) const;
    double real(const char* name) const;  ///< a number, exactly as it was given
    int integer(const char* name) const;
    bool boolean(const char* name) const;
    std::string text(const char* name) const;
    glm::vec3 point(const char* name) const;
    bool is_point(const char* name) const;       ///< of a NumberOrPoint
    glm::quat rotation(const char* name) const;  ///< of unit length
    const Json& json(const char* name) const;    ///< of any type, as it was given
    const Json& json() const { return json_; }   ///< all of them: an object, or null where there are none

  private:
    const Json& json_;
};

}  // namespace tendril::app
