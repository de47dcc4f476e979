#include "app/document/expectation.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

const Json* child(const Json& json, std::string_view name) {
    if (json.is_object()) {
        const auto found = json.find(std::string(name));
        return found == json.end() ? nullptr : &*found;
    }
    if (!json.is_array()) return nullptr;
    std::size_t index = 0;
    const auto [rest, error] = std::from_chars(name.data(), name.data() + name.size(), index);
    const bool whole = error == std::errc() && rest == name.data() + name.size();
    return whole && index < json.size() ? &json[index] : nullptr;
}

/// The program computes with floats: 0.1 in a script means the nearest float.
bool equal_numbers(const Json& a, const Json& b) {
    constexpr double largest = std::numeric_limits<float>::max();
    const bool floats = std::abs(a.get<double>()) <= largest && std::abs(b.get<double>()) <= largest;
    if (!floats || (a.is_number_integer() && b.is_number_integer())) return a == b;
    return a.get<float>() == b.get<float>();
}

bool equal(const Json& a, const Json& b) {
    if (a.is_number() && b.is_number()) return equal_numbers(a, b);
    if (a.type() != b.type() || a.size() != b.size()) return false;
    if (!a.is_structured()) return a == b;
    if (a.is_object()) {
        for (const auto& [key, value] : a.items())
            if (const Json* other = child(b, key); !other || !equal(value, *other)) return false;
        return true;
    }
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!equal(a[i], b[i])) return false;
    return true;
}

/// Distance between two numbers, or two points of the same size; NaN if they cannot be compared.
double distance(const Json& a, const Json& b) {
    if (a.is_number() && b.is_number()) return std::abs(a.get<double>() - b.get<double>());
    if (!a.is_array() || !b.is_array() || a.size() != b.size()) return std::nan("");
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!a[i].is_number() || !b[i].is_number()) return std::nan("");
        const double apart = a[i].get<double>() - b[i].get<double>();
        sum += apart * apart;
    }
    return std::sqrt(sum);
}

bool holds(const Expect& expect, const Json& found) {
    using Measure = Expect::Measure;
    switch (expect.measure) {
        case Measure::Equals:
            return equal(found, expect.value);
        case Measure::Near:
            return distance(found, expect.value) <= expect.within;
        case Measure::Below:
            return found.is_number() && found.get<double>() < expect.value->get<double>();
        case Measure::Above:
            return found.is_number() && found.get<double>() > expect.value->get<double>();
    }
    return false;
}

std::string measure_text(const Expect& expect) {
    using Measure = Expect::Measure;
    const std::string value = json_summary(expect.value);
    switch (expect.measure) {
        case Measure::Equals:
            return value;
        case Measure::Near:
            return value + " within " + Json(expect.within).dump();
        case Measure::Below:
            return "below " + value;
        case Measure::Above:
            return "above " + value;
    }
    return value;
}

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error(reason);
}

void check_comparable(const Json& value, bool points_too, const char* key) {
    const bool list = points_too && value.is_array() && !value.empty();
    if (!list) return void(json_number(value, key));
    for (const Json& coordinate : value) json_number(coordinate, key);
}

}  // namespace

void check_members(const Json& line, std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : line.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            fail("unknown member " + json_summary(Json(key)));
}

Expect read_expectation(const Json& line) {
    check_members(line, {"expect", "equals", "near", "within", "below", "above"});
    using Measure = Expect::Measure;
    constexpr std::array<std::pair<const char*, Measure>, 4> measures{{{"equals", Measure::Equals},
                                                                       {"near", Measure::Near},
                                                                       {"below", Measure::Below},
                                                                       {"above", Measure::Above}}};
    Expect expect;
    expect.path = json_text(json_member(line, "expect", ""), "expect");
    if (expect.path.empty()) fail("expect: expected text, found \"\"");
    int given = 0;
    for (const auto& [key, measure] : measures) {
        if (!line.contains(key)) continue;
        ++given;
        expect.measure = measure;
        expect.value = line[key];
        if (measure != Measure::Equals) check_comparable(expect.value, measure == Measure::Near, key);
    }
    if (given != 1) fail("expected exactly one of \"equals\", \"near\", \"below\", \"above\"");
    if (line.contains("within")) {
        if (expect.measure != Measure::Near) fail("within: goes with \"near\" only");
        json_number(line["within"], "within", 0.0f, 1e9f);
        expect.within = line["within"].get<double>();
    }
    return expect;
}

const Json* find_in_state(const Json& state, std::string_view path) {
    if (path.empty()) return &state;
    for (const Json* found = &state;;) {
        const auto dot = path.find('.');
        found = child(*found, path.substr(0, dot));
        if (!found || dot == path.npos) return found;
        path.remove_prefix(dot + 1);
    }
}

std::string check_expectation(const Expect& expect, const Json& state) {
    const Json* found = find_in_state(state, expect.path);
    if (!found)
        return "expected " + expect.path + " to be " + measure_text(expect) +
               ", but the state has no such value";
    if (holds(expect, *found)) return {};
    std::string message =
        "expected " + expect.path + " to be " + measure_text(expect) + ", found " + json_summary(*found);
    const double off = distance(*found, expect.value);
    if (expect.measure == Expect::Measure::Near && !std::isnan(off))
        message += ", off by " + Json(off).dump();
    return message;
}

}  // namespace tendril::app
