#include "app/labs/signal/filter_json.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/io/samples.hpp"
#include "app/labs/kit/curve_json.hpp"
#include "app/labs/signal/filter_fields.hpp"

namespace tendril::app {
namespace {

[[noreturn]] void fail(const std::string& where, const std::string& what) {
    throw std::runtime_error(where.empty() ? what : where + ": " + what);
}

std::string place(const std::string& where, std::string_view key) {
    return where.empty() ? std::string(key) : where + "." + std::string(key);
}

}  // namespace

Json parameters_json(const signal::Filter& filter) {
    Json json = save_fields(filter_fields(filter));
    if (const auto* curve = std::get_if<signal::Curve>(&filter)) json["keys"] = curve_keys_json(*curve);
    return json;
}

Json filter_json(const signal::Filter& filter) {
    Json json{{"kind", signal::kind(filter)}};
    json.update(parameters_json(filter));
    return json;
}

namespace {

/// What a parameter that is out of order goes against.
std::string other_end(const signal::Filter& filter) {
    if (const auto* scale = std::get_if<signal::ScaleBiasClamp>(&filter))
        if (scale->clamp_min > scale->clamp_max) return "; clamp_max is " + decimal(scale->clamp_max);
    if (const auto* hysteresis = std::get_if<signal::Hysteresis>(&filter))
        if (hysteresis->low > hysteresis->high) return "; high is " + decimal(hysteresis->high);
    if (const auto* curve = std::get_if<signal::Curve>(&filter))
        for (std::size_t i = 1; i < curve->keys.size(); ++i)
            if (!(curve->keys[i].time > curve->keys[i - 1].time))
                return "; that is " + decimal(curve->keys[i - 1].time);
    return {};
}

}  // namespace

void set_parameters(signal::Filter& filter, const Json& given, const std::string& where) {
    signal::Filter changed = filter;
    if (auto* curve = std::get_if<signal::Curve>(&changed); curve != nullptr && given.contains("keys"))
        curve->keys = read_curve_keys({given["keys"], place(where, "keys")});
    load_fields({given, where}, filter_fields(changed));
    if (const Result result = signal::check(changed); !result)
        fail(where, result.message() + other_end(changed));
    filter = std::move(changed);
}

signal::Filter filter_from_json(const Json& json, const std::string& where) {
    if (!json.is_object())
        fail(where, "expected a filter, an object with its kind, found " + json_summary(json));
    const std::string at = place(where, "kind");
    const std::string name = json_text(json_member(json, "kind", where), at);
    const signal::Kind* kind = signal::find_kind(name);
    if (kind == nullptr)
        fail(at, "expected one of " + kind_names() + ", found " + json_summary(json["kind"]));
    signal::Filter filter = kind->blank();
    set_parameters(filter, json, where);
    return filter;
}

std::vector<signal::Filter> filters_from_json(const Json& json, const std::string& where, std::size_t most) {
    if (!json.is_array()) return {filter_from_json(json, where)};
    if (json.size() > most) {
        fail(where, "has " + std::to_string(json.size()) + " filters; the most is " + std::to_string(most));
    }
    std::vector<signal::Filter> filters;
    for (const Json& each : json)
        filters.push_back(filter_from_json(each, place(where, std::to_string(filters.size()))));
    return filters;
}

std::vector<std::string> parameter_names(const signal::Kind& kind) {
    std::vector<std::string> names;
    if (std::holds_alternative<signal::Curve>(kind.blank())) names.emplace_back("keys");
    for (const Field& field : kind.fields) names.emplace_back(field.name);
    return names;
}

std::string kind_names() {
    std::string names;
    for (const signal::Kind& kind : signal::kinds())
        names += (names.empty() ? "" : ", ") + std::string(kind.name);
    return names;
}

std::string with_line(const std::string& text, const std::string& where, const std::string& error) {
    std::string path = error.substr(0, error.find(": "));
    if (!path.starts_with(where)) return error;
    path.erase(0, std::min(path.size(), where.size() + 1));
    const int line = path.empty() ? 1 : json_line(text, path);
    return "line " + std::to_string(std::max(1, line)) + ": " + error;
}

}  // namespace tendril::app
