#include "app/batch/cases.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/refused.hpp"
#include "app/fields/fields.hpp"
#include "app/fields/solver_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/json_scan.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"

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
        const double size = std::sqrt(x * x + y * y + z * z);
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

constexpr const char* drive_form = "JOINT=VALUE or JOINT=FROM:TO:STEP";
constexpr const char* target_form = "POINT=X,Y,Z";
constexpr double max_drive_value = 1e6;  ///< degrees or metres, as in linkage.drive

/// The values from "from" to "to"; the last may exceed the end only by rounding.
std::vector<double> range_values(const JsonPlace& place) {
    const double from = place["from"].real(-max_drive_value, max_drive_value),
                 to = place["to"].real(-max_drive_value, max_drive_value),
                 step = place["step"].real(-max_drive_value, max_drive_value);
    if (!((to - from) * step > 0.0)) place["step"].fail("must lead from \"from\" to \"to\"");
    const double count = std::floor((to - from) / step + 1e-9);
    if (count >= static_cast<double>(max_linkage_rows))
        place["step"].fail("must make at most 100000 values, makes " + std::to_string(count + 1.0));
    std::vector<double> values;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(count); ++i)
        values.push_back(from + step * static_cast<double>(i));
    return values;
}

std::vector<double> driver_values(const JsonPlace& place) {
    if (place.json().is_object()) return range_values(place);
    std::vector<double> values;
    if (!place.json().is_array()) return {place.real(-max_drive_value, max_drive_value)};
    place.for_each("values", max_linkage_rows, [&](const JsonPlace& each) {
        values.push_back(each.real(-max_drive_value, max_drive_value));
    });
    return values;
}

std::vector<glm::dvec3> target_positions(const JsonPlace& place) {
    std::vector<glm::dvec3> places;
    if (!place.json().is_array() || place.json().empty() || !place.json()[0].is_array())
        return {place.dpoint()};
    place.for_each("points", max_linkage_rows,
                   [&](const JsonPlace& each) { places.push_back(each.dpoint()); });
    return places;
}

void check_rows(const JsonPlace& place, std::size_t count, std::size_t rows) {
    if (count == 0) place.fail("expected at least one value, found an empty list");
    if (count != 1 && rows != 1 && count != rows)
        place.fail("expected as many values as the other lists have, " + std::to_string(rows) + ", found " +
                   std::to_string(count));
}

template <class Values>
const auto& value_at(const Values& values, std::size_t row) {
    return values[std::min(row, values.size() - 1)];
}

/// Adds the JSON path to a refusal.
void with_path(const JsonPlace& place, auto require) {
    try {
        require();
    } catch (const Refused& refused) {
        place.fail(refused.what());
    }
}

double argument_number(std::string_view text, const std::string& option) {
    double value = 0.0;
    const auto [end, error] = read_double(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw std::runtime_error(option + ": expected a number, found \"" + std::string(text) + "\"");
    return value;
}

/// Splits off a name and the numbers after it. `form` is for messages: "JOINT=VALUE".
std::pair<std::string, std::vector<double>> named_numbers(const std::string& argument,
                                                          const std::string& option, const char* form,
                                                          char separator) {
    const std::size_t equals = argument.rfind('=');
    if (equals == argument.npos || equals == 0)
        throw std::runtime_error(option + ": expected " + form + ", found \"" + argument + "\"");
    std::vector<double> numbers;
    for (std::size_t begin = equals + 1;;) {
        const std::size_t end = std::min(argument.find(separator, begin), argument.size());
        numbers.push_back(argument_number(std::string_view(argument).substr(begin, end - begin), option));
        if (end == argument.size()) break;
        begin = end + 1;
    }
    return {argument.substr(0, equals), std::move(numbers)};
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

std::size_t LinkageCase::rows() const {
    std::size_t rows = 1;
    for (const auto& each : drivers) rows = std::max(rows, each.second.size());
    for (const auto& each : targets) rows = std::max(rows, each.second.size());
    return rows;
}

void LinkageCase::solve(std::size_t row, LinkageRuntime& runtime, const ik::LinkageOptions& options) {
    for (const auto& each : drivers) {
        auto drive = std::ranges::find(part.drives, each.first, &LinkageDrive::joint);
        if (drive == part.drives.end()) drive = part.drives.insert(drive, {.joint = each.first});
        drive->value = value_at(each.second, row);
        drive->held = true;
        drive->rate = 0.0;
    }
    for (const auto& each : targets) {
        auto target = std::ranges::find(part.targets, each.first, &LinkageTarget::point);
        if (target == part.targets.end()) target = part.targets.insert(target, {.point = each.first});
        target->to = value_at(each.second, row);
    }
    solve_linkage(part, runtime, options);
}

std::vector<std::string> LinkageCase::columns() const {
    std::vector<std::string> names;
    for (const auto& each : drivers) names.push_back(each.first);
    for (const auto& each : part.linkage().points)
        for (const char* const axis : {"_x", "_y", "_z"}) names.push_back(each.name + axis);
    return names;
}

std::vector<double> LinkageCase::column_values() const {
    std::vector<double> values;
    for (const auto& each : drivers)
        values.push_back(in_degrees(part, each.first, part.value_of(each.first)));
    for (std::size_t i = 0; i < part.linkage().points.size(); ++i) {
        const glm::dvec3 at = part.at(i);
        values.insert(values.end(), {at.x, at.y, at.z});
    }
    return values;
}

namespace {

/// Paths in messages are `before` followed by the driver's name.
void read_drivers(const Json& drivers, const std::string& before, LinkageCase& to) {
    for (const auto& each : drivers.items()) {
        const std::string& joint = each.key();
        const JsonPlace at(each.value(), before + joint);
        with_path(at, [&] { require_linkage_joint(to.part, joint); });
        std::vector<double> values = driver_values(at);
        check_rows(at, values.size(), to.rows());
        for (double& value : values) value = from_degrees(to.part, joint, value);
        to.drivers.emplace_back(joint, std::move(values));
    }
}

void read_targets(const Json& targets, const std::string& before, LinkageCase& to) {
    for (const auto& each : targets.items()) {
        const std::string& point = each.key();
        const JsonPlace at(each.value(), before + point);
        with_path(at, [&] { static_cast<void>(require_linkage_point(to.part, point)); });
        std::vector<glm::dvec3> places = target_positions(at);
        check_rows(at, places.size(), to.rows());
        to.targets.emplace_back(point, std::move(places));
    }
}

void read_linkage_goals(const JsonPlace& place, LinkageCase& to) {
    const auto read = [&](const char* kind, auto take) {
        const auto object = place.optional(kind);
        if (!object) return;
        if (!object->json().is_object())
            object->fail("expected an object of values by name, found " + json_summary(object->json()));
        take(object->json(), object->where() + ".", to);
    };
    read("drivers", read_drivers);
    read("targets", read_targets);
}

}  // namespace

void override_linkage_goals(const Json& goals, LinkageCase& to) {
    const Json none = Json::object();
    const Json &drivers = goals.contains("drivers") ? goals["drivers"] : none,
               &targets = goals.contains("targets") ? goals["targets"] : none;
    // Erase replaced drivers first: they may have another number of values.
    std::erase_if(to.drivers, [&](const auto& each) { return drivers.contains(each.first); });
    std::erase_if(to.targets, [&](const auto& each) { return targets.contains(each.first); });
    read_drivers(drivers, "--drive ", to);
    read_targets(targets, "--target ", to);
}

LinkageCase linkage_case_from_json(const JsonPlace& place) {
    LinkageCase read;
    const JsonPlace linkage = place["linkage"];
    if (linkage.json().is_object()) {
        if (place.has("lengths")) place["lengths"].fail("is for a preset by its name");
        const std::shared_ptr<Part> part = LinkagePart{}.load(linkage.json(), linkage.where());
        read.part = dynamic_cast<const LinkagePart&>(*part);
    } else {
        const std::string name = linkage.text();
        LinkageRuntime runtime;
        try {
            Mechanism mechanism = mechanism_kind(name).blank();
            if (const auto lengths = place.optional("lengths")) read_lengths(*lengths, mechanism);
            open_mechanism(read.part, mechanism, runtime);
        } catch (const std::invalid_argument& error) {
            linkage.fail(error.what());
        }
    }
    read_linkage_goals(place, read);
    return read;
}

Json linkage_goals_from_arguments(const std::vector<std::string>& drivers,
                                  const std::vector<std::string>& targets) {
    Json goals = Json::object();
    for (const std::string& each : drivers) {
        auto [joint, numbers] = named_numbers(each, "--drive", drive_form, ':');
        if (numbers.size() != 1 && numbers.size() != 3)
            throw std::runtime_error(std::string("--drive: expected ") + drive_form + ", found \"" + each +
                                     "\"");
        if (goals.contains("drivers") && goals["drivers"].contains(joint))
            throw std::runtime_error("--drive " + joint + ": given twice");
        if (numbers.size() == 1)
            goals["drivers"][joint] = numbers[0];
        else
            goals["drivers"][joint] = {{"from", numbers[0]}, {"to", numbers[1]}, {"step", numbers[2]}};
    }
    for (const std::string& each : targets) {
        auto [point, numbers] = named_numbers(each, "--target", target_form, ',');
        if (numbers.size() != 3)
            throw std::runtime_error(std::string("--target: expected ") + target_form + ", found \"" + each +
                                     "\"");
        if (goals.contains("targets") && goals["targets"].contains(point))
            throw std::runtime_error("--target " + point + ": given twice");
        goals["targets"][point] = numbers;
    }
    return goals;
}

Json linkage_row_json(const LinkagePart& part) {
    Json row = linkage_state(part);
    const ik::LinkageReport& report = part.result.report;
    row["iterations"] = report.iterations;
    row["residual"] = report.residual;
    return row;
}

}  // namespace tendril::app
