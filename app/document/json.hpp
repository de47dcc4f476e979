// JSON as the program reads and writes it: key order kept, floats by their shortest exact decimals, and
// hostile files refused before they are taken in.
#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace tendril::app {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t max_file_bytes = 64u << 20;
inline constexpr int max_json_depth = 64;

/// The number whose decimals are the fewest that read back as this very float: 0.1f gives 0.1.
Json number(float value);
Json point(glm::vec3 p);
Json pixel(glm::vec2 p);

/// Parses one JSON value. Throws std::runtime_error: "line 3: <reason>". Depth is checked by a scan that
/// allocates nothing, before the parser sees the text.
Json parse_json(std::string_view text);

/// Reads a whole file, at most max_file_bytes of it. Throws std::runtime_error naming the path.
std::string read_text_file(const std::filesystem::path& path);
/// read_text_file and parse_json; the message is "<path>: line 3: <reason>".
Json read_json_file(const std::filesystem::path& path);

/// Typed reads for files. Each throws std::runtime_error naming `where` (a path such as "labs.chain.target")
/// and what was found there; numbers must be finite and at most 1e9 in magnitude.
const Json& json_member(const Json& object, const char* key, const std::string& where);
float json_number(const Json& value, const std::string& where);
int json_integer(const Json& value, const std::string& where, int low, int high);
bool json_bool(const Json& value, const std::string& where);
std::string json_text(const Json& value, const std::string& where);
glm::vec3 json_point(const Json& value, const std::string& where);

}  // namespace tendril::app
