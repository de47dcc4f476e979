#include "app/document/argument_check.hpp"

#include <algorithm>
#include <cmath>

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"
#include "app/document/text.hpp"

namespace tendril::app {
namespace {

/// "2", "0.05": a limit declared as a float, without its rounding digits.
std::string plain(double value) {
    const auto single = static_cast<float>(value);
    std::string text = Json(static_cast<double>(single) == value ? shortest_decimal(single) : value).dump();
    if (text.ends_with(".0")) text.erase(text.size() - 2);
    return text;
}

/// A finite number of at most 1e9 in magnitude: required of all input.
bool sane(const Json& value) {
    if (!value.is_number()) return false;
    const double number = value.get<double>();
    return std::isfinite(number) && std::abs(number) <= 1e9;
}

void check_point(const Json& value, ArgumentType type, const auto& refuse) {
    if (!value.is_array() || value.size() != 3) refuse(type_text(type));
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) refuse("three finite numbers of at most 1e9 in magnitude");
    }
}

/// Whether the coordinates have unit length, within the rounding of hand-written decimals.
bool is_unit(const Json& value) {
    double squares = 0.0;
    for (const auto& coordinate : value) {
        if (!sane(coordinate)) return false;
        squares += coordinate.get<double>() * coordinate.get<double>();
    }
    return std::abs(std::sqrt(squares) - 1.0) < 1e-3;
}

/// "0 to 1", "at least 3"; empty if any number is allowed.
std::string range_text(const Argument& argument) {
    const auto bound = [&](double limit) {
        const bool whole = argument.type == ArgumentType::Integer;
        return whole ? std::to_string(static_cast<long long>(limit)) : plain(limit);
    };
    const bool any_low = argument.low <= -1e9, any_high = argument.high >= 1e9;
    if (any_low && any_high) return "";
    return any_low    ? "at most " + bound(argument.high)
           : any_high ? "at least " + bound(argument.low)
                      : bound(argument.low) + " to " + bound(argument.high);
}

}  // namespace

std::string type_text(ArgumentType type) {
    switch (type) {
        case ArgumentType::Number:
            return "a number";
        case ArgumentType::Integer:
            return "a whole number";
        case ArgumentType::Boolean:
            return "true or false";
        case ArgumentType::Text:
            return "text";
        case ArgumentType::Point:
            return "a point [x, y, z]";
        case ArgumentType::NumberOrPoint:
            return "a number or a point [x, y, z]";
        case ArgumentType::Rotation:
            return "a unit quaternion [x, y, z, w] or angles in degrees [x, y, z]";
        case ArgumentType::List:
            return "a list";
        case ArgumentType::ListOrText:
            return "a list or text";
        case ArgumentType::Any:
            return "a value";
    }
    return "";
}

void check_value(const Argument& argument, const Json& value, const std::string& where) {
    const auto refuse = [&](const std::string& rule) {
        throw Refused(where + " must be " + rule + ", got " + json_summary(value));
    };
    switch (argument.type) {
        case ArgumentType::Boolean:
            if (!value.is_boolean()) refuse(type_text(argument.type));
            return;
        case ArgumentType::Text:
            if (!value.is_string()) refuse(type_text(argument.type));
            // Paths may hold any bytes.
            if (argument.name != "path" && !is_storable(value.get_ref<const std::string&>()))
                refuse("text in UTF-8, without U+FFFD");
            if (!argument.choices.empty() && std::find(argument.choices.begin(), argument.choices.end(),
                                                       value.get<std::string>()) == argument.choices.end()) {
                refuse("one of " + comma_list(argument.choices));
            }
            return;
        case ArgumentType::NumberOrPoint:
            if (value.is_array()) {
                check_point(value, argument.type, refuse);
                return;
            }
            [[fallthrough]];
        case ArgumentType::Number:
            if (!value.is_number()) refuse(type_text(argument.type));
            if (!sane(value)) refuse("finite and at most 1e9 in magnitude");
            break;
        case ArgumentType::Point:
            check_point(value, argument.type, refuse);
            return;
        case ArgumentType::Rotation:
            if (value.is_array() && value.size() == 4) {
                if (!is_unit(value)) refuse("a quaternion [x, y, z, w] of length 1");
            } else {
                check_point(value, argument.type, refuse);
            }
            return;
        case ArgumentType::List:
        case ArgumentType::ListOrText:
            if (!value.is_array() && !(argument.type == ArgumentType::ListOrText && value.is_string()))
                refuse(type_text(argument.type));
            return;
        case ArgumentType::Any:
            return;
        case ArgumentType::Integer:
            if (!value.is_number()) refuse(type_text(argument.type));
            if (!std::isfinite(value.get<double>()) ||
                std::trunc(value.get<double>()) != value.get<double>()) {
                refuse(type_text(argument.type));
            }
            break;
    }
    const double number = value.get<double>();
    if (number < argument.low || number > argument.high) refuse(range_text(argument));
}

std::string rule_text(const Argument& argument) {
    if (!argument.choices.empty()) return "one of " + comma_list(argument.choices);
    const std::string range = range_text(argument);
    return type_text(argument.type) + (range.empty() ? range : ", " + range);
}

}  // namespace tendril::app
