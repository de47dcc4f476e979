// Command arguments: how they are declared and read, and the set that picture and video commands share.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/io/json.hpp"

namespace tendril::app {

/// NumberOrPoint: one number, or three. Rotation: a unit quaternion [x, y, z, w], or degrees about X, then Y,
/// then Z. The command itself checks the elements of a List and a value of type Any.
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
    /// Names or numbers that currently exist, for the palette. Others may be valid too.
    std::function<std::vector<std::string>(const Workspace&)> known{};
    /// For a list: the argument of the same command that takes a single element.
    std::string list_of{};
    /// The argument's current value, as text.
    std::function<std::string(const Workspace&)> present{};
};

Argument choice_argument(const char* name, bool required, const char* help, std::vector<std::string> choices);
// The next three are optional.
Argument integer_argument(const char* name, const char* help, double low, double high);
Argument number_argument(const char* name, const char* help, double low, double high);
Argument switch_argument(const char* name, const char* help);
// Optional unless `required`.
Argument text_argument(const char* name, bool required, std::string help);
Argument point_argument(const char* name, bool required, const char* help);
/// A 0-based index below `count`.
Argument index_argument(const char* name, bool required, const char* help, std::size_t count);
/// The same argument, with the values of `known` offered in the palette.
Argument offering(Argument argument, std::function<std::vector<std::string>(const Workspace&)> known);
/// "0", "1", ... up to `count` - 1.
std::vector<std::string> places(std::size_t count);

/// Arguments that passed their command's check: present if required, of the right type, finite, in range.
class Arguments {
  public:
    explicit Arguments(const Json& json) : json_(json) {}
    bool has(const char* name) const;
    float number(const char* name) const;
    double real(const char* name) const;  ///< a number, exactly as given
    int integer(const char* name) const;
    bool boolean(const char* name) const;
    std::string text(const char* name) const;
    glm::vec3 point(const char* name) const;
    bool is_point(const char* name) const;       ///< whether a NumberOrPoint holds a point
    glm::quat rotation(const char* name) const;  ///< a unit quaternion
    const Json& json(const char* name) const;    ///< a value of any type, as given
    const Json& json() const { return json_; }   ///< all arguments: an object, or null if there are none

  private:
    const Json& json_;
};

// Arguments shared by the commands for pictures and videos of the view.

/// `first`, then the members of PictureLook.
std::vector<Argument> picture_arguments(std::vector<Argument> first = {});
void set_look(const Arguments& given, PictureLook& look);

/// An unused name beside the scene's file, or in the working directory: "arm-1.png", or "arm-race-1.png" with
/// `what` for a picture of something other than the view. Throws Refused outside a window, where a script has
/// to give the path.
std::filesystem::path new_file(const Workspace& workspace, const std::string& what = {},
                               const char* extension = ".png");

}  // namespace tendril::app
