#include "app/io/json.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <numbers>
#include <system_error>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/system/file.hpp"

namespace tendril::app {
namespace {

constexpr double max_number = 1e9;
constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw std::runtime_error(where.empty() ? what : where + ": " + what);
}

[[noreturn]] void expected(const std::string& what, const Json& found, const std::string& where) {
    fail(where, "expected " + what + ", found " + json_summary(found));
}

double finite(const Json& value, const std::string& where) {
    if (!value.is_number()) expected("a number", value, where);
    const double x = value.get<double>();
    if (!(std::abs(x) <= max_number)) expected("a number of at most 1e9", value, where);
    return x;
}

float from_degrees(double value) {
    return static_cast<float>(value / degrees_per_radian);
}

std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A table row: few values, of any number of digits.
bool is_row(const Json& json) {
    constexpr std::size_t max_row_size = 16;
    return json.is_array() && json.size() <= max_row_size &&
           std::none_of(json.begin(), json.end(), [](const Json& each) { return each.is_structured(); });
}

void write_indented(std::string& out, const Json& json, std::size_t indent) {
    constexpr std::size_t line_width = 100;
    if (json.is_structured() && !json.empty()) {
        std::string one_line = dump(json);
        if (indent + one_line.size() > line_width && !is_row(json)) {
            const std::string margin(indent + 1, ' ');
            out += json.is_object() ? "{\n" : "[\n";
            bool first = true;
            for (const auto& item : json.items()) {
                if (!first) out += ",\n";
                first = false;
                out += margin;
                if (json.is_object()) out += dump(Json(item.key())) + ": ";
                write_indented(out, item.value(), indent + 1);
            }
            out += '\n' + std::string(indent, ' ') + (json.is_object() ? '}' : ']');
            return;
        }
        out += one_line;
        return;
    }
    out += dump(json);
}

/// "a number from 0 to 0.5"
std::string range_text(const Json& low, const Json& high) {
    const auto plain = [](const Json& end) {
        std::string text = end.dump();
        if (text.ends_with(".0")) text.resize(text.size() - 2);
        return text;
    };
    return "a number from " + plain(low) + " to " + plain(high);
}

}  // namespace

SharedJson::SharedJson() : SharedJson(Json::object()) {}
SharedJson::SharedJson(const Json& json) : json_(std::make_shared<const Json>(json)) {}
SharedJson::SharedJson(Json&& json) : json_(std::make_shared<const Json>(std::move(json))) {}

double shortest_decimal(float value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    double shortest = 0.0;
    read_double(digits.data(), end, shortest);
    // Readers round twice, to double and then to float. Keep all digits if that would miss the float.
    return static_cast<float>(shortest) == value ? shortest : static_cast<double>(value);
}

Json number(float value) {
    return shortest_decimal(value);
}

Json point(glm::vec3 p) {
    return Json::array({number(p.x), number(p.y), number(p.z)});
}

Json pixel(glm::vec2 p) {
    return Json::array({number(p.x), number(p.y)});
}

Json dpoint(const glm::dvec3& p) {
    return Json::array({p.x, p.y, p.z});
}

Json quaternion(const glm::quat& q) {
    return Json::array({number(q.x), number(q.y), number(q.z), number(q.w)});
}

Json dquaternion(const glm::dquat& q) {
    return Json::array({q.x, q.y, q.z, q.w});
}

Json degrees(float radians) {
    const double exact = static_cast<double>(radians) * degrees_per_radian;
    const Json rounded = number(static_cast<float>(exact));
    return from_degrees(rounded.get<double>()) == radians ? rounded : Json(exact);
}

std::string json_to_text(const Json& json) {
    std::string out;
    write_indented(out, json, 0);
    return out + '\n';
}

std::string json_summary(const Json& json) {
    constexpr std::size_t longest = 60;
    if (json.is_structured() && json.size() > 8) {
        const char* what = json.is_array() ? "a list of " : "an object of ";
        return what + std::to_string(json.size()) + (json.is_array() ? " values" : " members");
    }
    if (json.is_string() && json.get_ref<const std::string&>().size() > longest) return "a long string";
    const std::string text = dump(json);
    if (text.size() <= longest) return text;
    return json.is_array() ? "a list" : "an object";
}

std::string reason_of(const std::exception& error) {
    if (dynamic_cast<const Json::exception*>(&error) != nullptr)
        return "a value is missing, or of another type than expected";
    return error.what();
}

std::string read_text_file(const std::filesystem::path& path) {
    const std::string shown = path.string();
    if (shown.find('\0') != std::string::npos) throw std::runtime_error("not a file name");
    const std::string too_large = "larger than " + std::to_string(max_file_bytes >> 20) + " MB";
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) fail(shown, "is a folder");
    // Refuse a regular file by its size before reading; a pipe or a device has no size.
    if (std::filesystem::is_regular_file(status) &&
        std::filesystem::file_size(path, error) > max_file_bytes && !error)
        fail(shown, too_large);

    auto pipe = await_pipe(path);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_to_read(path), &std::fclose);
    pipe.reset();
    if (!file) fail(shown, std::generic_category().message(errno));
    std::string text;
    std::array<char, 1 << 16> block{};
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        text.append(block.data(), count);
        if (text.size() > max_file_bytes) fail(shown, too_large);
    }
    if (std::ferror(file.get())) fail(shown, std::generic_category().message(errno));
    return text;
}

Json read_json_file(const std::filesystem::path& path) {
    const std::string text = read_text_file(path);
    try {
        return parse_json(text);
    } catch (const ParseError& error) {
        throw std::runtime_error(path.string() + ": " + error.what());
    }
}

const Json& json_member(const Json& object, const char* key, std::string_view where) {
    if (!object.is_object()) expected("an object", object, std::string(where));
    const auto found = object.find(key);
    if (found == object.end()) fail(std::string(where), '"' + std::string(key) + "\" is missing");
    return *found;
}

float json_number(const Json& value, const std::string& where) {
    return static_cast<float>(finite(value, where));
}

float json_number(const Json& value, const std::string& where, float low, float high) {
    const double given = value.is_number() ? value.get<double>() : std::nan("");
    const float x =
        std::abs(given) <= std::numeric_limits<float>::max() ? static_cast<float>(given) : std::nanf("");
    if (!(x >= low && x <= high)) expected(range_text(number(low), number(high)), value, where);
    return x;
}

double json_real(const Json& value, const std::string& where) {
    return finite(value, where);
}

double json_real(const Json& value, const std::string& where, double low, double high) {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (!(x >= low && x <= high)) expected(range_text(low, high), value, where);
    return x;
}

float json_degrees(const Json& value, const std::string& where) {
    return from_degrees(finite(value, where));
}

int json_integer(const Json& value, const std::string& where, int low, int high) {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    // 3.0 is a whole number too: not every JSON writer preserves the distinction.
    if (!(x >= low && x <= high && x == std::floor(x)))
        expected("a whole number from " + std::to_string(low) + " to " + std::to_string(high), value, where);
    return static_cast<int>(x);
}

std::uint64_t json_count(const Json& value, const std::string& where, std::uint64_t high) {
    const double x = value.is_number() ? value.get<double>() : std::nan("");
    if (!(x >= 0.0 && x <= static_cast<double>(high) && x == std::floor(x)))
        expected("a whole number from 0 to " + std::to_string(high), value, where);
    return static_cast<std::uint64_t>(x);
}

bool json_bool(const Json& value, const std::string& where) {
    if (!value.is_boolean()) expected("true or false", value, where);
    return value.get<bool>();
}

std::string json_text(const Json& value, const std::string& where) {
    if (!value.is_string()) expected("text", value, where);
    return value.get<std::string>();
}

glm::dvec3 json_dpoint(const Json& value, const std::string& where) {
    if (!value.is_array() || value.size() != 3) expected("a point [x, y, z]", value, where);
    return {json_real(value[0], where), json_real(value[1], where), json_real(value[2], where)};
}

glm::vec3 json_point(const Json& value, const std::string& where) {
    if (!value.is_array() || value.size() != 3) expected("a point [x, y, z]", value, where);
    return {json_number(value[0], where), json_number(value[1], where), json_number(value[2], where)};
}

}  // namespace tendril::app
