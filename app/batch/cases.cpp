#include "app/batch/cases.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/document/json_scan.hpp"
#include "app/fields/fields.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/kit/library_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_bones = 500'000;

std::string element(const std::string& where, std::size_t index) {
    return where + "." + std::to_string(index);
}

/// Requires a list of `count` values, or of 1 to max_bones if `count` is 0.
const Json& check_list(const Json& json, std::size_t count, const char* what, const std::string& where) {
    const bool fits = count == 0 ? !json.empty() && json.size() <= max_bones : json.size() == count;
    if (json.is_array() && fits) return json;
    const std::string number = count == 0 ? "1 to " + std::to_string(max_bones) : std::to_string(count);
    const std::string found =
        json.is_array() ? "a list of " + std::to_string(json.size()) : json_summary(json);
    throw std::runtime_error(where + ": expected a list of " + number + " " + what + ", found " + found);
}

std::vector<float> read_lengths(const Json& json, const std::string& where) {
    std::vector<float> lengths;
    check_list(json, 0, "lengths", where);
    lengths.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const std::string here = element(where, i);
        lengths.push_back(json_number(json[i], here));
        if (lengths.back() < 0.0f)
            throw std::runtime_error(here + ": expected at least 0, found " + json_summary(json[i]));
    }
    return lengths;
}

std::vector<glm::vec3> read_joints(const Json& json, std::size_t bones, const std::string& where) {
    std::vector<glm::vec3> joints;
    check_list(json, bones + 1, "points, one more than lengths", where);
    joints.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) joints.push_back(json_point(json[i], element(where, i)));
    return joints;
}

std::vector<glm::vec3> read_control_points(const Json& json, const std::string& where) {
    constexpr std::size_t most = 4096;
    if (!json.is_array() || json.size() < 2 || json.size() > most)
        throw std::runtime_error(where + ": expected a list of 2 to 4096 control points, found " +
                                 json_summary(json));
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i < json.size(); ++i) points.push_back(json_point(json[i], element(where, i)));
    return points;
}

std::vector<glm::vec3> along_x(const std::vector<float>& lengths) {
    std::vector<glm::vec3> joints{glm::vec3(0.0f)};
    joints.reserve(lengths.size() + 1);
    for (const float length : lengths) joints.emplace_back(joints.back().x + length, 0.0f, 0.0f);
    return joints;
}

/// The direction of each bone in a pose; +X if its joints coincide.
std::vector<glm::vec3> directions(const std::vector<glm::vec3>& joints) {
    std::vector<glm::vec3> found;
    found.reserve(joints.size() - 1);
    for (std::size_t i = 1; i < joints.size(); ++i) {
        const double x = static_cast<double>(joints[i].x) - static_cast<double>(joints[i - 1].x);
        const double y = static_cast<double>(joints[i].y) - static_cast<double>(joints[i - 1].y);
        const double z = static_cast<double>(joints[i].z) - static_cast<double>(joints[i - 1].z);
        const double size = std::hypot(x, y, z);
        found.push_back(size > 0.0 ? glm::vec3(x / size, y / size, z / size) : glm::vec3(1.0f, 0.0f, 0.0f));
    }
    return found;
}

std::vector<ik::Limit> read_limits(const Json& json, std::size_t bones, const std::string& where) {
    std::vector<ik::Limit> limits;
    if (json.is_array() && json.empty()) return limits;
    check_list(json, bones, "limits, one for each length", where);
    limits.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i)
        limits.push_back(json[i].is_null() ? ik::Limit{} : limit_from_json(json[i], element(where, i)));
    return limits;
}

std::vector<ik::AngleLimit> read_angle_limits(const Json& json, std::size_t bones, const std::string& where) {
    std::vector<ik::AngleLimit> limits;
    if (json.is_array() && json.empty()) return limits;
    check_list(json, bones, "limits, one for each length", where);
    for (std::size_t i = 0; i < json.size(); ++i) {
        const JsonPlace place(json[i], element(where, i));
        limits.emplace_back();
        if (json[i].is_null()) continue;
        load_fields(place, limits.back());
        if (const char* const why = ik::fault(limits.back())) place.fail(why);
    }
    return limits;
}

/// Reads the plane, and the members that only a plane case may have.
void read_plane(const Json& json, const std::string& where, Case& read) {
    const JsonPlace place(json, where);
    const auto normal = place.optional("plane");
    for (const char* const key : {"bend", "angle_limits"})
        if (!normal && place.has(key)) place[key].fail("is for a case with a plane");
    if (!normal) return;
    if (!read.limits.empty()) place["limits"].fail("in a plane there are angle_limits instead");
    read.normal = normal->point();
    if (!(glm::length(*read.normal) > 1e-6f)) normal->fail("must be longer than 1e-6");
    if (const auto bend = place.optional("bend")) read.bend = bend->choice(bend_sides);
    if (const auto limits = place.optional("angle_limits"))
        read.angle_limits = read_angle_limits(limits->json(), read.lengths.size(), limits->where());
}

}  // namespace

Case case_from_json(const Json& json, const std::string& where, std::size_t index) {
    Case read;
    if (json.is_object() && json.contains("linkage")) {
        const JsonPlace place(json, where);
        const auto name = place.optional("name");
        read.name = name ? name->text() : std::to_string(index);
        read.linkage = linkage_case_from_json(place);
        return read;
    }
    read.lengths = read_lengths(json_member(json, "lengths", where), where + ".lengths");
    const std::size_t bones = read.lengths.size();
    if (const auto curve = json.find("curve"); curve != json.end())
        read.curve = read_control_points(*curve, where + ".curve");
    else
        read.target = json_point(json_member(json, "target", where), where + ".target");
    const auto given = [&](const char* key, const auto& take) {
        const auto found = json.find(key);
        if (found != json.end()) take(*found, where + "." + key);
        return found != json.end();
    };
    if (!given("name", [&](const Json& j, const std::string& at) { read.name = json_text(j, at); }))
        read.name = std::to_string(index);
    if (!given("start",
               [&](const Json& j, const std::string& at) { read.start = read_joints(j, bones, at); }))
        read.start = along_x(read.lengths);
    given("rest", [&](const Json& j, const std::string& at) {
        read.rest_directions = directions(read_joints(j, bones, at));
    });
    given("pole", [&](const Json& j, const std::string& at) { read.pole = json_point(j, at); });
    given("limits", [&](const Json& j, const std::string& at) { read.limits = read_limits(j, bones, at); });
    read_plane(json, where, read);
    return read;
}

void read_cases(std::string_view text, const std::function<bool(const Case&, double)>& take) {
    ListReader list(text, "cases");
    Json json;
    while (list.next(json)) {
        Case read;
        try {
            read = case_from_json(json, list.place(), list.index());
        } catch (const std::runtime_error& error) {
            const std::string what = error.what();
            const int line = list.line_of(what.substr(0, what.find(": ")));
            throw std::runtime_error("line " + std::to_string(line) + ": " + what);
        }
        if (!take(read, list.progress())) return;
    }
}

}  // namespace tendril::app
