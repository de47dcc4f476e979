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

/// Requires a list of `count` values, or of 1 to max_bones if `count` is 0.
void check_list(const JsonPlace& list, std::size_t count, const char* what) {
    const Json& json = list.json();
    const bool fits = count == 0 ? !json.empty() && json.size() <= max_bones : json.size() == count;
    if (json.is_array() && fits) return;
    const std::string number = count == 0 ? "1 to " + std::to_string(max_bones) : std::to_string(count);
    const std::string found =
        json.is_array() ? "a list of " + std::to_string(json.size()) : json_summary(json);
    list.fail("expected a list of " + number + " " + what + ", found " + found);
}

std::vector<float> read_lengths(const JsonPlace& list) {
    check_list(list, 0, "lengths");
    std::vector<float> lengths;
    lengths.reserve(list.json().size());
    for (std::size_t i = 0; i < list.json().size(); ++i) {
        const JsonPlace each = list.element(i);
        lengths.push_back(each.number());
        if (lengths.back() < 0.0f) each.fail("expected at least 0, found " + json_summary(each.json()));
    }
    return lengths;
}

std::vector<glm::vec3> read_points(const JsonPlace& list) {
    std::vector<glm::vec3> points;
    points.reserve(list.json().size());
    for (std::size_t i = 0; i < list.json().size(); ++i) points.push_back(list.element(i).point());
    return points;
}

std::vector<glm::vec3> read_joints(const JsonPlace& list, std::size_t bones) {
    check_list(list, bones + 1, "points, one more than lengths");
    return read_points(list);
}

std::vector<glm::vec3> read_control_points(const JsonPlace& list) {
    const Json& json = list.json();
    if (!json.is_array() || json.size() < 2 || json.size() > 4096)
        list.fail("expected a list of 2 to 4096 control points, found " + json_summary(json));
    return read_points(list);
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

/// One for each bone, or none at all; null: no limit.
template <class Limit, class Read>
std::vector<Limit> read_limits(const JsonPlace& list, std::size_t bones, const Read& read) {
    std::vector<Limit> limits;
    if (list.json().is_array() && list.json().empty()) return limits;
    check_list(list, bones, "limits, one for each length");
    limits.reserve(bones);
    for (std::size_t i = 0; i < bones; ++i) {
        const JsonPlace each = list.element(i);
        limits.push_back(each.json().is_null() ? Limit{} : read(each));
    }
    return limits;
}

ik::AngleLimit read_angle_limit(const JsonPlace& place) {
    ik::AngleLimit limit;
    load_fields(place, limit);
    if (const char* const why = ik::fault(limit)) place.fail(why);
    return limit;
}

/// Reads the plane, and the members that only a plane case may have.
void read_plane(const JsonPlace& place, Case& read) {
    const auto normal = place.optional("plane");
    for (const char* const key : {"bend", "angle_limits"})
        if (!normal && place.has(key)) place[key].fail("is for a case with a plane");
    if (!normal) return;
    if (!read.limits.empty()) place["limits"].fail("in a plane there are angle_limits instead");
    read.normal = normal->point();
    if (!(glm::length(*read.normal) > 1e-6f)) normal->fail("must be longer than 1e-6");
    if (const auto bend = place.optional("bend")) read.bend = bend->choice(bend_sides);
    if (const auto limits = place.optional("angle_limits"))
        read.angle_limits = read_limits<ik::AngleLimit>(*limits, read.lengths.size(), read_angle_limit);
}

}  // namespace

Case case_from_json(const Json& json, const std::string& where, std::size_t index) {
    const JsonPlace place(json, where);
    Case read;
    if (place.has("linkage")) {
        const auto name = place.optional("name");
        read.name = name ? name->text() : std::to_string(index);
        read.linkage = linkage_case_from_json(place);
        return read;
    }
    read.lengths = read_lengths(place["lengths"]);
    const std::size_t bones = read.lengths.size();
    if (place.has("curve"))
        read.curve = read_control_points(place["curve"]);
    else
        read.target = place["target"].point();
    read.name = place.has("name") ? place["name"].text() : std::to_string(index);
    read.start = place.has("start") ? read_joints(place["start"], bones) : along_x(read.lengths);
    if (place.has("rest")) read.rest_directions = directions(read_joints(place["rest"], bones));
    if (place.has("pole")) read.pole = place["pole"].point();
    if (place.has("limits"))
        read.limits = read_limits<ik::Limit>(place["limits"], bones, [](const JsonPlace& each) {
            return limit_from_json(each.json(), each.where());
        });
    read_plane(place, read);
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
