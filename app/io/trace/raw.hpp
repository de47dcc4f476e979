// Frames of a trace in the file's own space and unit: JSON Lines, tables, or vectors in any text, such as a
// log.
#pragma once

#include <cstddef>
#include <deque>
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

/// Values may be NaN or infinite: users look for those.
struct RawFrame {
    std::string chain{};  ///< empty if unnamed
    std::optional<double> time{}, dt{};
    std::vector<glm::dvec3> joints{};
    std::optional<glm::dvec3> target{}, pole{};
    std::vector<glm::dvec4> rotations{};  ///< as written; empty, or one per bone or per joint
    std::size_t line = 0;                 ///< where the frame begins, from 1
};

/// The first line. Callers check its texts.
struct TraceHeader {
    std::string up, handed, unit, rotations, engine;
    std::optional<double> fps;
    std::optional<std::size_t> target_joint;  ///< the joint that reaches for the target
    std::vector<std::string> bones;
    std::vector<ik::BendLimit> limits;
};

/// How a program writes vectors.
enum class Engine { Unknown, Unreal, Unity, Godot, Blender, Xna, Babylon, Houdini, Ros };

/// The lines of a stream, without their ends. If the first ones have decimal commas, as in
/// "0,5; 1,25; 0,0", commas become points. Refuses lines of over 16 MiB.
class Lines {
  public:
    explicit Lines(std::istream& in);
    /// A line not yet taken: 0 is the next one. Null past the last.
    const std::string* ahead(std::size_t index);
    bool next(std::string& text);  ///< takes one line; false at the end
    void drop(std::size_t count);  ///< takes `count` lines
    std::size_t taken() const { return taken_; }
    std::size_t bytes() const { return bytes_; }  ///< read so far

  private:
    bool read(std::string& text);

    std::istream& in_;
    std::deque<std::string> ahead_;
    std::size_t taken_ = 0, bytes_ = 0;
    bool decimal_commas_ = false;
};

class RawTrace {
  public:
    explicit RawTrace(Lines lines) : lines_(std::move(lines)) {}
    virtual ~RawTrace() = default;
    /// False after the last frame. Throws std::runtime_error: "line 3: ...".
    virtual bool next(RawFrame& frame) = 0;
    std::size_t line() const { return lines_.taken(); }  ///< lines taken so far

    TraceHeader header;
    Engine engine = Engine::Unknown;  ///< as far as the text shows it
    std::vector<std::string> notes;   ///< for display: what was omitted

  protected:
    Lines lines_;
};

/// Detects the format. Throws std::runtime_error if the stream is empty.
std::unique_ptr<RawTrace> open_raw_trace(std::istream& in);

// Helpers of the formats.

inline bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
/// "line 3: <what>"
[[noreturn]] void fail_line(std::size_t line, const std::string& what);
/// Parses a number at the start of `text` in any language's notation: 1.5, 1.5f, 1.5D+00, 0x1.8p+0, nan,
/// -nan(ind), null, inf, 1.#QNAN. Removes it from `text`.
std::optional<double> take_number(std::string_view& text);
enum class Meaning { Joint, Target, Pole };
/// Seconds per unit of a column or word: 1e-3 for "time_ms" and "time [ms]"; 0 if it is not a time.
double time_unit(std::string_view name);
/// True if a column's name shows that its numbers are not a position: "elbow_rotation", "hand.rpy".
bool names_no_position(std::string_view name);
/// "left_elbow", "elbow.r" and "RightElbow" are the elbow of the left (0) or right (1) side. In lower case.
struct Sided {
    std::size_t side = 0;
    std::string part{};
};
std::optional<Sided> sided(std::string_view name);

std::unique_ptr<RawTrace> open_json_trace(Lines lines);
/// Also reads tables.
std::unique_ptr<RawTrace> open_log_trace(Lines lines);

}  // namespace tendril::app
