#include "app/batch/cases.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

constexpr const char* drive_form = "JOINT=VALUE or JOINT=FROM:TO:STEP";
constexpr const char* target_form = "POINT=X,Y,Z";
constexpr double furthest = 1e6;  ///< degrees or metres, as in linkage.drive

/// The values from "from" to "to"; the last may exceed the end only by rounding.
std::vector<double> range_values(const JsonPlace& place) {
    const double from = place["from"].real(-furthest, furthest), to = place["to"].real(-furthest, furthest),
                 step = place["step"].real(-furthest, furthest);
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
    if (!place.json().is_array()) return {place.real(-furthest, furthest)};
    place.for_each("values", max_linkage_rows,
                   [&](const JsonPlace& each) { values.push_back(each.real(-furthest, furthest)); });
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
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        throw std::runtime_error(option + ": expected a number, found \"" + std::string(text) + "\"");
    return value;
}

/// A name, and the numbers after it between separators. `form` is for messages: "JOINT=VALUE".
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
    // Erase replaced ones first, since their number of values may differ.
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
