// Frames of a trace as they are written, in the file's own space and unit: JSON Lines, tables, or vectors in
// any text, as a log has them.
#pragma once

#include <cstddef>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tendril/ik/incident.hpp>
#include <vector>

namespace tendril::app {

inline constexpr std::size_t max_trace_joints = 4096;

/// Values may be NaN or infinite: that is what people look for.
struct RawFrame {
    std::string chain{};  ///< empty if it has no name
    std::optional<double> time{}, dt{};
    std::vector<glm::dvec3> joints{};
    std::optional<glm::dvec3> target{}, pole{};
    std::vector<glm::dvec4> rotations{};  ///< as written; empty, or one a bone or a joint
    std::size_t line = 0;                 ///< from 1, where the frame begins
};

/// What the first line says. Texts are checked by whoever uses them.
struct TraceHeader {
    std::string up, handed, unit, rotations, engine;
    std::optional<double> fps;
    std::optional<std::size_t> target_joint;  ///< the one that reaches for the target
    std::vector<std::string> bones;
    std::vector<ik::BendLimit> limits;
};

/// How a program writes vectors.
enum class Engine { Unknown, Unreal, Unity, Godot, Blender, Xna, Babylon, Houdini, Ros };

class RawTrace {
  public:
    virtual ~RawTrace() = default;
    /// False after the last frame. Throws std::runtime_error: "line 3: ...".
    virtual bool next(RawFrame& frame) = 0;

    TraceHeader header;
    Engine engine = Engine::Unknown;  ///< as far as it can be told from what was read
    std::vector<std::string> notes;   ///< for display: what was left out
    std::size_t line = 0;             ///< of what was read
};

/// Finds out the format. Throws std::runtime_error if there is nothing in it.
std::unique_ptr<RawTrace> open_raw_trace(std::istream& in);

// For the formats.

/// "line 3: <what>"
[[noreturn]] void fail_line(std::size_t line, const std::string& what);
/// A number, from the start of `text`, as any language prints it: 1.5, 1.5f, nan, -nan(ind), inf, 1.#QNAN.
/// Removes it from `text`.
std::optional<double> take_number(std::string_view& text);
enum class Meaning { Joint, Target, Pole };
/// The meaning of a name in lower case: "ik_target", "pole vector".
Meaning meaning_of(std::string_view name);
/// Seconds that one of a column or word counts: 1e-3 of "time_ms" and "time [ms]"; 0 if it is no time.
double time_unit(std::string_view name);
/// Whether a column's name says that the numbers are not a position: "elbow_rotation", "hand.rpy".
bool names_no_position(std::string_view name);
/// "left_elbow", "elbow.r" and "RightElbow" are the elbow of the left (0) or right (1) side. In lower case.
struct Sided {
    std::size_t side = 0;
    std::string part{};
};
std::optional<Sided> sided(std::string_view name);
/// Reads a line without its end; false at the end. Refuses one of over 16 MiB.
bool read_line(std::istream& in, std::string& text, std::size_t& line);

std::unique_ptr<RawTrace> open_json_trace(std::istream& in, std::string first, std::size_t line);
std::unique_ptr<RawTrace> open_table_trace(std::istream& in, std::string first, std::size_t line);
std::unique_ptr<RawTrace> open_log_trace(std::istream& in, std::string first, std::size_t line);
/// Whether a line can be the first of a table: names of columns, or numbers only.
bool begins_table(std::string_view line);

}  // namespace tendril::app
