// JSON reading and writing: key order is kept, floats are written as their shortest exact decimals, and
// hostile files are refused before they are parsed.
//
// The type is only declared here, so that headers which name it stay cheap to include. A source that
// inspects, creates or returns a value includes json_complete.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/quaternion_float.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tendril::app {

using Json = nlohmann::ordered_json;

/// An immutable value that copies share, for members where the type is only declared.
class SharedJson {
  public:
    SharedJson();  ///< an empty object
    SharedJson(const Json& json);
    SharedJson(Json&& json);
    const Json& operator*() const { return *json_; }
    const Json* operator->() const { return json_.get(); }
    operator const Json&() const { return *json_; }

  private:
    std::shared_ptr<const Json> json_;
};

inline constexpr std::size_t max_file_bytes = 64u << 20;
inline constexpr int max_json_depth = 64;

/// The number with the fewest decimals that reads back as exactly this float: 0.1f gives 0.1. The value must
/// be finite.
double shortest_decimal(float value);
Json number(float value);  ///< the same, as JSON
Json point(glm::vec3 p);
Json pixel(glm::vec2 p);
/// An angle in degrees, for files; json_degrees restores exactly the same radians.
Json degrees(float radians);
Json quaternion(const glm::quat& q);  ///< [x, y, z, w]
Json dquaternion(const glm::dquat& q);
Json dpoint(const glm::dvec3& p);  ///< doubles are exact in JSON

/// Readable, diffable JSON: a value that fits on one line is written on one. Ends with a newline.
std::string json_to_text(const Json& json);
/// A shortened value, for messages.
std::string json_summary(const Json& json);

/// Text that is not JSON, or nested too deeply: what() is "line 3: <reason>".
class ParseError : public std::runtime_error {
  public:
    ParseError(int at_line, const std::string& why)
        : std::runtime_error("line " + std::to_string(at_line) + ": " + why), line(at_line), reason(why) {}
    int line;
    std::string reason;
};

/// Parses one JSON value; if a member's name repeats, its last value wins. Throws ParseError. A scan without
/// allocation checks the depth before the parser sees the text. Takes linear time (n log n in an object's
/// members).
Json parse_json(std::string_view text);

/// The line, from 1, of the value "labs.chain.segments.3" in a valid JSON text, or of the longest prefix of
/// that path that exists; 0 if none does.
int json_line(std::string_view text, std::string_view path);

/// The exception's message. The JSON library's own messages are reworded.
std::string reason_of(const std::exception& error);

/// Reads a whole file, pipe or device of at most max_file_bytes. Throws std::runtime_error naming the path.
std::string read_text_file(const std::filesystem::path& path);
/// read_text_file and parse_json; the message is "<path>: line 3: <reason>".
Json read_json_file(const std::filesystem::path& path);

/// Typed reads for files. Each throws std::runtime_error that begins with `where` (a path such as
/// "labs.chain.target"; empty for the root) and says what was found there. Numbers must be finite and at most
/// 1e9 in magnitude; reads with explicit bounds check only those.
const Json& json_member(const Json& object, const char* key, std::string_view where);
float json_number(const Json& value, const std::string& where);
float json_number(const Json& value, const std::string& where, float low, float high);
double json_real(const Json& value, const std::string& where);
double json_real(const Json& value, const std::string& where, double low, double high);
float json_degrees(const Json& value, const std::string& where);  ///< in radians
/// A whole number; 3.0 is one.
int json_integer(const Json& value, const std::string& where, int low, int high);
/// A count that may outgrow an int: a whole number from 0 to `high`, which is at most 2^53.
std::uint64_t json_count(const Json& value, const std::string& where, std::uint64_t high);
bool json_bool(const Json& value, const std::string& where);
std::string json_text(const Json& value, const std::string& where);
glm::vec3 json_point(const Json& value, const std::string& where);
glm::dvec3 json_dpoint(const Json& value, const std::string& where);

}  // namespace tendril::app
