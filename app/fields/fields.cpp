#include "app/fields/fields.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// A bound of a range as written in files: 0.001, not 0.00100000005.
double file_end(const Field& field, double end) {
    const auto single = static_cast<float>(end);
    if (is_angle(field)) return degrees(single).get<double>();
    return static_cast<double>(single) == end ? shortest_decimal(single) : end;
}

/// Degrees that give an angle of double precision again, short ones if they do. Some radians have none; those
/// that were given in degrees have.
Json exact_degrees(double radians) {
    const double degrees = glm::degrees(radians);
    for (const double near : {shortest_decimal(static_cast<float>(degrees)), degrees,
                              std::nextafter(degrees, 0.0), std::nextafter(degrees, 2.0 * degrees)})
        if (glm::radians(near) == radians) return near;
    return degrees;
}

Json saved(const Field& field, const FieldValue& value) {
    if (field.optional && std::isnan(value[0])) return nullptr;
    if (is_angle(field)) return field.exact ? exact_degrees(value[0]) : degrees(static_cast<float>(value[0]));
    switch (field.type) {
        case FieldType::Flag:
            return value[0] != 0.0;
        case FieldType::Integer:
            return static_cast<int>(value[0]);
        case FieldType::Choice:
            return field.choices[static_cast<std::size_t>(value[0])];
        case FieldType::Number:
            return field.exact ? Json(value[0]) : number(static_cast<float>(value[0]));
        case FieldType::Pair:
            return field.exact
                       ? Json{value[0], value[1]}
                       : Json{number(static_cast<float>(value[0])), number(static_cast<float>(value[1]))};
        case FieldType::Rotation:
            return field.exact ? dquaternion({value[3], value[0], value[1], value[2]})
                               : quaternion(rotation_of(value));
        case FieldType::Point:
        case FieldType::Struct:
            break;
    }
    return field.exact ? dpoint({value[0], value[1], value[2]}) : point({value[0], value[1], value[2]});
}

double number_in_range(const JsonPlace& place, const Field& field) {
    if (field.over_low && place.real() <= file_range(field).low)
        place.fail("expected a number over " + json_summary(file_range(field).low));
    if (is_angle(field)) {
        const auto [low, high] = file_range(field);
        const double given = place.real(low, high);
        return field.exact ? glm::radians(given) : static_cast<double>(place.degrees());
    }
    const auto [low, high] = field.range;
    if (field.exact) return place.real(low, high);
    return static_cast<double>(place.number(static_cast<float>(low), static_cast<float>(high)));
}

double choice_at(const JsonPlace& place, const Field& field) {
    const std::string name = place.text();
    std::string all;
    for (std::size_t i = 0; i < field.choices.size(); ++i) {
        if (name == field.choices[i]) return static_cast<double>(i);
        all += (i > 0 ? ", " : "") + std::string(field.choices[i]);
    }
    place.fail("expected one of " + all + ", found " + json_summary(place.json()));
}

FieldValue loaded(const JsonPlace& place, const Field& field) {
    switch (field.type) {
        case FieldType::Flag:
            return {place.flag() ? 1.0 : 0.0};
        case FieldType::Integer:
            return {static_cast<double>(
                place.integer(static_cast<int>(field.range.low), static_cast<int>(field.range.high)))};
        case FieldType::Choice:
            return {choice_at(place, field)};
        case FieldType::Number:
            return {number_in_range(place, field)};
        case FieldType::Pair:
            place.check_size(2, "numbers");
            return {number_in_range(place.element(0), field), number_in_range(place.element(1), field)};
        case FieldType::Rotation:
            return field.exact ? detail::to_field(place.drotation()) : detail::to_field(place.rotation());
        case FieldType::Point:
        case FieldType::Struct:
            break;
    }
    place.check_size(3, "coordinates");
    return {number_in_range(place.element(0), field), number_in_range(place.element(1), field),
            number_in_range(place.element(2), field)};
}

std::string unit_sentence(std::string_view unit) {
    if (unit.empty()) return {};
    const std::string_view word = unit == "deg" || unit == "rad" ? "degrees"
                                  : unit == "rad/s"              ? "degrees per second"
                                  : unit == "m"                  ? "metres"
                                  : unit == "s"                  ? "seconds"
                                                                 : unit;
    return " Unit: " + std::string(word) + ".";
}

Argument argument(const Field& field, const FieldText& text) {
    const auto [low, high] = file_range(field);
    Argument result{.name = file_name(field),
                    .required = false,
                    .help = text.help + unit_sentence(field.unit) +
                            (field.type == FieldType::Pair ? " A list [low, high]." : ""),
                    .low = low,
                    .high = high};
    switch (field.type) {
        case FieldType::Flag:
            result.type = ArgumentType::Boolean;
            break;
        case FieldType::Integer:
            result.type = ArgumentType::Integer;
            break;
        case FieldType::Number:
            result.type = ArgumentType::Number;
            break;
        case FieldType::Pair:
            result.type = ArgumentType::List;
            break;
        case FieldType::Point:
            result.type = ArgumentType::Point;
            break;
        case FieldType::Rotation:
            result.type = ArgumentType::Rotation;
            break;
        case FieldType::Choice:
            result.type = ArgumentType::Text;
            result.choices.assign(field.choices.begin(), field.choices.end());
            break;
        case FieldType::Struct:
            break;
    }
    return result;
}

}  // namespace

bool is_angle(const Field& field) {
    const std::string_view unit = field.unit;
    return field.type == FieldType::Number && (unit == "rad" || unit == "rad/s");
}

std::string file_name(const Field& field) {
    return is_angle(field) ? std::string(field.name) + "_deg" : field.name;
}

bool same_value(const Field& field, const void* a, const void* b) {
    const FieldValue was = field.get(a), is = field.get(b);
    return std::ranges::equal(was, is,
                              [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

FieldRange file_range(const Field& field) {
    return {file_end(field, field.range.low), file_end(field, field.range.high)};
}

namespace {

/// `at`: what the field's accessors take; of a struct, its address.
Json saved_at(const Field& field, const void* at) {
    return field.type == FieldType::Struct ? save_fields({field.table(), at}) : saved(field, field.get(at));
}

void save_list(Json& json, const Field& field, const void* object) {
    Json list = field.names.empty() ? Json::array() : Json::object();
    for (std::size_t i = 0; i < field.count(object); ++i) {
        const void* const element = field.address(object, i);
        if (field.names.empty())
            list.push_back(saved_at(field, element));
        else if (field.empty == nullptr || !field.empty(element))
            list[field.names[i]] = saved_at(field, element);
    }
    if (field.in_line)
        json.update(list);
    else
        json[field.name] = std::move(list);
}

class Loader {
  public:
    explicit Loader(bool all, std::span<const std::string_view> newer = {}) : all_(all), newer_(newer) {}

    void fields(const JsonPlace& place, FieldsIn in) const {
        if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
        for (const Field& field : in.table) {
            if (field.in_line) {
                list(place, field, in.object);
                continue;
            }
            const std::string name = file_name(field);
            if (!place.has(name.c_str()) && (!all_ || std::ranges::find(newer_, name) != newer_.end()))
                continue;
            const JsonPlace member = place[name.c_str()];
            if (field.count != nullptr)
                list(member, field, in.object);
            else if (field.type == FieldType::Struct)
                nested(member, field, in.object);
            else
                value(member, field, in.object);
        }
    }

  private:
    void value(const JsonPlace& place, const Field& field, void* at) const {
        const bool nothing = field.optional && place.json().is_null();
        field.set(at, nothing ? FieldValue{std::nan("")} : loaded(place, field));
    }
    void nested(const JsonPlace& place, const Field& field, void* object) const {
        const bool nothing = field.optional && place.json().is_null();
        if (field.optional) field.resize(object, nothing ? 0 : 1);
        if (!nothing) fields(place, {field.table(), field.address_in(object)});
    }
    void element(const JsonPlace& place, const Field& field, void* at) const {
        if (field.type == FieldType::Struct)
            fields(place, {field.table(), at});
        else
            value(place, field, at);
    }
    void list(const JsonPlace& place, const Field& field, void* object) const {
        if (!field.names.empty() && !place.json().is_object())
            place.fail("expected an object, found " + json_summary(place.json()));
        for (std::size_t i = 0; i < field.names.size(); ++i) {
            const char* const name = field.names[i];
            if (place.has(name) || !(field.optional || (field.in_line && !all_)))
                element(place[name], field, field.address_in(object, i));
        }
        if (!field.names.empty()) return;
        if (field.resize != nullptr)
            field.resize(object, place.list_size(field.name, field.most));
        else
            place.check_size(field.most, "elements");
        for (std::size_t i = 0; i < field.count(object); ++i)
            element(place.element(i), field, field.address_in(object, i));
    }

    bool all_;
    std::span<const std::string_view> newer_;
};

}  // namespace

Json save_fields(FieldsOf of) {
    Json json = Json::object();
    for (const Field& field : of.table) {
        if (field.count != nullptr)
            save_list(json, field, of.object);
        else if (field.type == FieldType::Struct)
            json[field.name] = field.address(of.object, 0) == nullptr
                                   ? Json(nullptr)
                                   : saved_at(field, field.address(of.object, 0));
        else
            json[file_name(field)] = saved(field, field.get(of.object));
    }
    return json;
}

void load_all_fields(const JsonPlace& place, FieldsIn in, std::span<const std::string_view> newer) {
    Loader(true, newer).fields(place, in);
}

void load_fields(const JsonPlace& place, FieldsIn in) {
    Loader(false).fields(place, in);
}

std::vector<Argument> field_arguments(std::span<const Field> table, std::span<const FieldText> texts) {
    std::vector<Argument> arguments;
    for (const FieldText& text : texts)
        if (const Field* const field = find_field(table, text.name))
            arguments.push_back(argument(*field, text));
    return arguments;
}

void set_fields(const Arguments& given, FieldsIn in, std::string_view except) {
    for (const Field& field : in.table) {
        const std::string name = file_name(field);
        if (!given.has(name.c_str()) || field.name == except) continue;
        field.set(in.object, field.type == FieldType::Rotation
                                 ? detail::to_field(given.rotation(name.c_str()))  // or in degrees
                                 : loaded({given.json(name.c_str()), name}, field));
    }
}

}  // namespace tendril::app
