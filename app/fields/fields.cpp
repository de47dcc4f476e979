#include "app/fields/fields.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <set>

#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

/// An end of a range as files write it: 0.001, not 0.00100000005.
double file_end(const Field& field, double end) {
    if (std::isinf(end)) return end;
    const auto single = static_cast<float>(end);
    if (is_angle(field)) return degrees(single).get<double>();
    return static_cast<double>(single) == end ? shortest_decimal(single) : end;
}

/// Degrees that convert back to exactly this angle, short ones if possible. Some angles in radians have none;
/// angles that were given in degrees do.
Json exact_degrees(double radians) {
    const double degrees = glm::degrees(radians);
    for (const double near : {shortest_decimal(static_cast<float>(degrees)), degrees,
                              std::nextafter(degrees, 0.0), std::nextafter(degrees, 2.0 * degrees)})
        if (glm::radians(near) == radians) return near;
    return degrees;
}

Json saved(const Field& field, const FieldValue& value) {
    if ((field.optional && std::isnan(value[0])) || std::isinf(value[0])) return nullptr;
    if (is_angle(field)) return field.exact ? exact_degrees(value[0]) : degrees(static_cast<float>(value[0]));
    switch (field.type) {
        case FieldType::Flag:
            return value[0] != 0.0;
        case FieldType::Integer:
            return static_cast<std::int64_t>(value[0]);
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
        default:
            break;
    }
    return field.exact ? dpoint({value[0], value[1], value[2]}) : point({value[0], value[1], value[2]});
}

double number_in_range(const JsonPlace& place, const Field& field) {
    if (place.json().is_null())
        for (const double end : {field.range.low, field.range.high})
            if (std::isinf(end)) return end;
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
    for (std::size_t i = 0; i < field.choices.size(); ++i)
        if (name == field.choices[i]) return static_cast<double>(i);
    place.fail("expected one of " + comma_list(field.choices) + ", found " + json_summary(place.json()));
}

FieldValue loaded(const JsonPlace& place, const Field& field) {
    switch (field.type) {
        case FieldType::Flag:
            return {place.flag() ? 1.0 : 0.0};
        case FieldType::Integer:
            if (field.range.high > std::numeric_limits<int>::max())
                return {static_cast<double>(place.count(static_cast<std::uint64_t>(field.range.high)))};
            return {static_cast<double>(
                place.integer(static_cast<int>(field.range.low), static_cast<int>(field.range.high)))};
        case FieldType::Choice:
            return {choice_at(place, field)};
        case FieldType::Number:
            return {number_in_range(place, field)};
        case FieldType::Pair:
            place.check_size(2, "numbers, [low, high]");
            return {number_in_range(place.element(0), field), number_in_range(place.element(1), field)};
        case FieldType::Rotation:
            return field.exact ? detail::to_field(place.drotation()) : detail::to_field(place.rotation());
        default:
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
        case FieldType::Text:
        case FieldType::Index:
            result.type = ArgumentType::Text;
            break;
        default:
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

FieldRange file_range(const Field& field) {
    return {file_end(field, field.range.low), file_end(field, field.range.high)};
}

namespace {

std::size_t count_of(const Field& field, const void* object) {
    if (field.count != nullptr) return field.count(object);
    return field.address == nullptr || field.address(object, 0) != nullptr ? 1 : 0;
}
/// The argument of the field's accessors; for a struct, its address.
const void* element_of(const Field& field, const void* object, std::size_t index) {
    return field.address != nullptr ? field.address(object, index) : object;
}

bool same_element(const Field& field, const void* a, const void* b) {
    if (field.type == FieldType::Text) return field.text(a) == field.text(b);
    if (field.access != nullptr) return field.access->same(a, b);
    if (field.type == FieldType::Struct)
        return std::ranges::all_of(field.table(), [&](const Field& row) { return same_field(row, a, b); });
    const FieldValue one = field.get(a), other = field.get(b);
    const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    return std::equal(one.begin(), one.begin() + field.size(), other.begin(), same);
}

}  // namespace

bool same_field(const Field& field, const void* a, const void* b) {
    const std::size_t count = count_of(field, a);
    if (count != count_of(field, b)) return false;
    if (field.type == FieldType::Kind && count > 0)
        return field.number(a) == field.number(b) &&
               std::ranges::all_of(field.kind(a).table(), [&](const Field& row) {
                   return same_field(row, field.address(a, 0), field.address(b, 0));
               });
    for (std::size_t i = 0; i < count; ++i)
        if (!same_element(field, element_of(field, a, i), element_of(field, b, i))) return false;
    return true;
}

namespace {

/// The text field that names the elements of a list; null if they have no names.
const Field* key_of(const Field& list) {
    if (list.type != FieldType::Struct) return nullptr;
    const Field& first = list.table().front();
    return first.type == FieldType::Text && !first.optional ? &first : nullptr;
}

/// The names of a list's elements.
struct NamesOf {
    const Field* list;
    const void* object;

    std::size_t size() const { return list == nullptr ? 0 : list->count(object); }
    std::string_view operator[](std::size_t i) const { return key_of(*list)->text(list->address(object, i)); }
};

/// A struct and the structs around it.
struct Scope {
    const Scope* above;
    std::span<const Field> table;
    const void* object;

    /// The elements' names in the list that an index points into.
    NamesOf names(std::string_view list) const {
        if (above == nullptr) return {};
        const Field* const found = find_field(above->table, list);
        return found == nullptr ? above->names(list) : NamesOf{found, above->object};
    }
};

/// Also true for an element's index: it is a number without a default.
bool is_required(const Field& field) {
    return field.required || (field.type == FieldType::Index && field.count == nullptr && !field.optional);
}

Json text_json(std::string_view text) {
    return text.empty() ? Json(nullptr) : Json(std::string(text));
}

Json save_struct(const Scope& scope, const void* fresh = nullptr);

Json save_element(const Field& field, const void* at, const Scope& scope) {
    if (field.type == FieldType::Struct)
        return save_struct({&scope, field.table(), at}, field.sparse ? field.fresh() : nullptr);
    if (field.type == FieldType::Text) return text_json(field.text(at));
    if (field.type == FieldType::Other) return input_json(rig::access_of(field), at);
    if (field.type != FieldType::Index) return saved(field, field.get(at));
    const NamesOf names = scope.names(field.of);
    const double index = field.get(at)[0];
    return index < static_cast<double>(names.size()) ? text_json(names[static_cast<std::size_t>(index)])
                                                     : Json(nullptr);
}

Json save_list(const Field& field, const Scope& scope) {
    Json list = field.names.empty() ? Json::array() : Json::object();
    for (std::size_t i = 0; i < field.count(scope.object); ++i) {
        const void* const element = field.address(scope.object, i);
        if (field.names.empty())
            list.push_back(save_element(field, element, scope));
        else if (!field.empty(element))
            list[field.names[i]] = save_element(field, element, scope);
    }
    return list;
}

/// True if files omit the field.
bool is_left_out(const Field& field, const void* object) {
    if (field.type == FieldType::Kind) return count_of(field, object) == 0;
    return field.sparse && field.kinds.empty() &&
           (field.type == FieldType::Text ? field.text(object).empty() : field.empty(object));
}

bool is_its_value(std::span<const Field> table) {
    return table.size() == 1 && *table[0].name == '\0';
}

/// Omits members equal to those of `fresh`, if it is given.
Json save_struct(const Scope& scope, const void* fresh) {
    if (is_its_value(scope.table)) return save_list(scope.table[0], scope);
    Json json = Json::object();
    for (const Field& field : scope.table)  // a unit's kind comes first
        if (field.type == FieldType::Kind && !field.optional) json[field.name] = nullptr;
    for (const Field& field : scope.table) {
        if (is_left_out(field, scope.object)) continue;
        if (field.type == FieldType::Kind) {
            json[field.name] = field.choices[static_cast<std::size_t>(field.number(scope.object))];
            json.update(
                save_struct({&scope, field.kind(scope.object).table(), field.address(scope.object, 0)}));
            continue;
        }
        if (fresh != nullptr && !is_required(field) && same_field(field, scope.object, fresh)) continue;
        if (field.in_line)
            json.update(save_list(field, scope));
        else if (field.count != nullptr)
            json[field.name] = save_list(field, scope);
        else
            json[file_name(field)] = count_of(field, scope.object) == 0
                                         ? Json(nullptr)
                                         : save_element(field, element_of(field, scope.object, 0), scope);
    }
    return json;
}

/// Names of the allowed members. Old files name an angle without _deg.
std::vector<std::string> known_names(const JsonPlace& place, std::span<const Field> table,
                                     const void* object) {
    std::vector<std::string> names = field_names(table, object);
    for (const Field& field : table) {
        if (is_angle(field) && place.has(field.name)) names.emplace_back(field.name);
        if (field.in_line) names.insert(names.end(), field.names.begin(), field.names.end());
    }
    return names;
}

using Missing = MissingField;

class Loader {
  public:
    explicit Loader(Missing missing, bool only_known = false, std::span<const std::string_view> newer = {})
        : missing_(missing), only_known_(only_known), newer_(newer) {}

    void fields(const JsonPlace& place, const Scope& scope) const {
        if (is_its_value(scope.table)) return list(place, scope.table[0], scope);
        kinds(place, scope);
        if (only_known_) check_members(place, known_names(place, scope.table, scope.object));
        beside(place, scope);
    }
    /// Sets each variant to the kind in the file.
    void kinds(const JsonPlace& place, const Scope& scope) const {
        if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
        for (const Field& field : scope.table)
            if (field.type == FieldType::Kind) kind(place, field, const_cast<void*>(scope.object));
    }
    void kind(const JsonPlace& place, const Field& field, void* object) const {
        if ((missing_ != Missing::Kept && !field.optional) || place.has(field.name))
            field.set(object, {choice_at(place[field.name], field)});
    }
    /// Like fields(), but neither reads kinds nor checks the members' names.
    void beside(const JsonPlace& place, const Scope& scope) const {
        void* const object = const_cast<void*>(scope.object);
        for (const Field& field : scope.table) {
            if (field.in_line) {
                list(place, field, scope);
                continue;
            }
            if (field.type == FieldType::Kind) {
                if (const void* const held = field.address(object, 0))
                    beside(place, {&scope, field.kind(object).table(), held});
                continue;
            }
            const std::string name = file_name(field);
            if (!place.has(name.c_str())) {
                if (is_angle(field) && place.has(field.name)) {
                    field.set(object, {place[field.name].real(field.range.low, field.range.high)});
                    continue;
                }
                const bool newer = std::ranges::find(newer_, name) != newer_.end();
                if (newer ||
                    !(missing_ == Missing::Refused || (missing_ == Missing::Default && is_required(field))))
                    continue;
            }
            const JsonPlace member = place[name.c_str()];
            if (field.count != nullptr)
                list(member, field, scope);
            else if (field.address != nullptr)
                nested(member, field, scope);
            else
                value(member, field, object, scope);
        }
    }

  private:
    void value(const JsonPlace& place, const Field& field, void* at, const Scope& scope) const {
        const bool nothing = place.json().is_null();
        if (field.type == FieldType::Text)
            field.set_text(at, nothing ? std::string() : place.text());
        else if (field.optional && nothing)
            field.set(at, {std::nan("")});
        else
            field.set(at, field.type == FieldType::Index ? index(place, field, scope) : loaded(place, field));
    }
    static FieldValue index(const JsonPlace& place, const Field& field, const Scope& scope) {
        const NamesOf names = scope.names(field.of);
        const std::string name = place.text();
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i] == name) return {static_cast<double>(i)};
        const std::string_view of = field.of;
        const bool bodies = of == "bodies";
        place.fail("there is no " + std::string(of.substr(0, of.size() - (bodies ? 3 : 1))) +
                   (bodies ? "y \"" : " \"") + name + "\"");
    }
    /// A struct or another value.
    void nested(const JsonPlace& place, const Field& field, const Scope& scope) const {
        void* const object = const_cast<void*>(scope.object);
        const bool nothing = field.optional && place.json().is_null();
        if (field.optional) field.resize(object, nothing ? 0 : 1);
        if (!nothing) element(place, field, field.address_in(object), scope);
    }
    void element(const JsonPlace& place, const Field& field, void* at, const Scope& scope) const {
        if (field.type == FieldType::Struct) {
            const bool given = field.sparse && missing_ == Missing::Refused;
            (given ? Loader(Missing::Default, only_known_) : *this)
                .fields(place, {&scope, field.table(), at});
        } else if (field.type == FieldType::Other) {
            read_input(place, rig::access_of(field), at);
        } else {
            value(place, field, at, scope);
        }
    }
    void list(const JsonPlace& place, const Field& field, const Scope& scope) const {
        void* const object = const_cast<void*>(scope.object);
        if (!field.names.empty() && !place.json().is_object())
            place.fail("expected an object, found " + json_summary(place.json()));
        if (only_known_ && !field.names.empty() && !field.in_line)
            check_members(place, {field.names.begin(), field.names.end()});
        for (std::size_t i = 0; i < field.names.size(); ++i) {
            const char* const name = field.names[i];
            if (place.has(name) || !(field.optional || (field.in_line && missing_ != Missing::Refused)))
                element(place[name], field, field.address_in(object, i), scope);
        }
        if (!field.names.empty()) return;
        std::size_t size = field.most;
        if (field.resize != nullptr) {
            field.resize(object, 0);  // old elements are not defaults
            size = place.list_size(field.name, field.most);
            if (size < field.fewest)
                place.fail("expected at least " + std::to_string(field.fewest) + ' ' + field.name +
                           ", found " + std::to_string(size));
        } else {
            place.check_size(size, "elements");
        }
        std::set<std::string, std::less<>> names;
        for (std::size_t i = 0; i < size; ++i) {
            // Grow one by one, so that a list of millions of invalid elements is refused at the first.
            if (field.resize != nullptr) field.resize(object, i + 1);
            const Loader fresh(missing_ == Missing::Kept ? Missing::Default : missing_, only_known_);
            fresh.element(place.element(i), field, field.address_in(object, i), scope);
            if (const Field* const key = key_of(field))
                check_name(place.element(i), key->name, key->text(field.address(object, i)), names);
        }
    }
    static void check_name(const JsonPlace& place, const char* key, std::string_view name,
                           std::set<std::string, std::less<>>& names) {
        if (name.empty()) (place.has(key) ? place[key] : place).fail("expected a name, found none");
        if (!names.emplace(name).second) place[key].fail("there is another \"" + std::string(name) + "\"");
    }

    Missing missing_;
    bool only_known_;
    std::span<const std::string_view> newer_;
};

}  // namespace

Json save_fields(FieldsOf of) {
    return save_struct({nullptr, of.table, of.object});
}

Json save_sparse_fields(FieldsOf of) {
    return save_struct({nullptr, of.table, of.object}, of.fresh);
}

void load_all_fields(const JsonPlace& place, FieldsIn in, std::span<const std::string_view> newer) {
    Loader(Missing::Refused, false, newer).fields(place, {nullptr, in.table, in.object});
}

void load_fields(const JsonPlace& place, FieldsIn in) {
    Loader(Missing::Default).fields(place, {nullptr, in.table, in.object});
}

void load_known_fields(const JsonPlace& place, const std::vector<KnownFields>& structs,
                       const std::vector<std::string_view>& besides) {
    std::vector<std::string> names;
    for (const KnownFields& each : structs) {
        Loader(each.missing).kinds(place, {nullptr, each.in.table, each.in.object});
        for (std::string& name : known_names(place, each.in.table, each.in.object))
            names.push_back(std::move(name));
    }
    names.insert(names.end(), besides.begin(), besides.end());
    check_members(place, names);
    for (const KnownFields& each : structs)
        Loader(each.missing, true, each.newer).beside(place, {nullptr, each.in.table, each.in.object});
}

std::vector<std::string> field_names(std::span<const Field> table, const void* object) {
    std::vector<std::string> names;
    for (const Field& field : table) {
        names.push_back(file_name(field));
        if (field.type != FieldType::Kind || field.address(object, 0) == nullptr) continue;
        for (const Field& each : field.kind(object).table()) names.push_back(file_name(each));
    }
    return names;
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
