#include "app/labs/rig/unit_json.hpp"

#include <algorithm>
#include <tendril/rig/fields.hpp>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/curve_json.hpp"
#include "app/labs/rig/input_json.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_parents = 1'000, max_roots = 1'000;

/// Fields that an operation cannot do without, whatever it is.
template <class T>
constexpr bool is_required = false;
template <>
constexpr bool is_required<rig::Item> = true;
template <>
constexpr bool is_required<std::vector<rig::ParentInputs>> = true;
template <>
constexpr bool is_required<std::vector<std::string>> = true;
template <>
constexpr bool is_required<std::string> = true;

class Reader {
  public:
    /// Of an operation, or of what is made of fields as one is. `beside`: members that are read elsewhere.
    template <class T>
    static void all(const JsonPlace& place, T& of, std::vector<std::string> beside = {}) {
        std::vector<std::string> known = std::move(beside);
        rig::fields(of, [&](const char* name, auto&) { known.push_back(name); });
        if constexpr (std::is_same_v<T, rig::EvaluateCurve>) add_curve_members(known);
        check_members(place, known);
        rig::fields(of, [&](const char* name, auto& field) {
            using Field = std::remove_reference_t<decltype(field)>;
            if (place.has(name) || is_required<Field>) read(place[name], field);
        });
        if constexpr (std::is_same_v<T, rig::EvaluateCurve>) read_curve_members(place, of.curve);
    }

  private:
    static void read(const JsonPlace& place, rig::Item& item) { item = read_item(place); }
    template <class T>
    static void read(const JsonPlace& place, rig::Input<T>& input) {
        input = read_input<T>(place);
    }
    static void read(const JsonPlace& place, rig::AimInputs& inputs) { all(place, inputs); }
    template <class T>
    static void read(const JsonPlace& place, std::optional<T>& field) {
        if (place.json().is_null()) return field.reset();
        read(place, field.emplace());
    }
    static void read(const JsonPlace& place, rig::AimTarget& kind) {
        kind = static_cast<rig::AimTarget>(read_name(place, {"location", "direction"}));
    }
    static void read(const JsonPlace& place, rig::Space& space) {
        space = read_name(place, {"global", "local"}) == 0 ? rig::Space::Global : rig::Space::Local;
    }
    static void read(const JsonPlace& place, std::vector<rig::ParentInputs>& parents) {
        parents.clear();
        place.for_each("parents", max_parents,
                       [&](const JsonPlace& each) { all(each, parents.emplace_back()); });
    }
    static void read(const JsonPlace& place, rig::TransformFilter& filter) {
        check_members(place, {"translation", "rotation", "scale"});
        const auto axes = [&](const char* name, std::array<bool, 3>& passes) {
            if (!place.has(name)) return;
            const JsonPlace list = place[name];
            list.check_size(3, "bools, of x, y and z");
            for (std::size_t i = 0; i < 3; ++i) passes[i] = list.element(i).flag();
        };
        axes("translation", filter.translation);
        axes("rotation", filter.rotation);
        axes("scale", filter.scale);
    }
    static void read(const JsonPlace& place, std::vector<std::string>& roots) {
        place.for_each("roots", max_roots, [&](const JsonPlace& each) { roots.push_back(each.text()); });
    }
    static void read(const JsonPlace& place, rig::Body& body) { body.units() = read_units(place); }
    static void read(const JsonPlace& place, bool& flag) { flag = place.flag(); }
    static void read(const JsonPlace& place, std::string& text) { text = place.text(); }
    static void read(const JsonPlace& place, std::array<double, 2>& range) {
        place.check_size(2, "numbers, [low, high]");
        for (std::size_t i = 0; i < 2; ++i) range[i] = place.element(i).real();
    }
    static void read(const JsonPlace& place, signal::Curve& curve) {
        std::vector<std::string> known;
        add_curve_members(known);
        check_members(place, known);
        read_curve_members(place, curve);
    }
};

struct Writer {
    template <class T>
    static Json all(const T& of) {
        Json json = Json::object();
        rig::fields(of, [&](const char* name, const auto& field) { json[name] = write(field); });
        return json;
    }

    static Json write(const rig::Item& item) { return item_json(item); }
    template <class T>
    static Json write(const rig::Input<T>& input) {
        return input_json(input);
    }
    static Json write(const rig::AimInputs& inputs) { return all(inputs); }
    template <class T>
    static Json write(const std::optional<T>& field) {
        return field ? write(*field) : Json(nullptr);
    }
    static Json write(rig::AimTarget kind) {
        return kind == rig::AimTarget::Location ? "location" : "direction";
    }
    static Json write(rig::Space space) { return space == rig::Space::Global ? "global" : "local"; }
    static Json write(const std::vector<rig::ParentInputs>& parents) {
        Json list = Json::array();
        for (const rig::ParentInputs& each : parents) list.push_back(all(each));
        return list;
    }
    static Json write(const rig::TransformFilter& filter) {
        return Json{
            {"translation", filter.translation}, {"rotation", filter.rotation}, {"scale", filter.scale}};
    }
    static Json write(const std::vector<std::string>& roots) { return roots; }
    static Json write(const rig::Body& body) { return units_json(body.units()); }
    static Json write(bool flag) { return flag; }
    static Json write(const std::string& text) { return text; }
    static Json write(const std::array<double, 2>& range) { return range; }
    static Json write(const signal::Curve& curve) { return curve_json(curve); }
};

/// Makes `operation` the one of that place in the variant, as it is by default.
template <std::size_t... index>
void make_operation(rig::Operation& operation, std::size_t wanted, std::index_sequence<index...>) {
    ((index == wanted ? static_cast<void>(operation.emplace<index>()) : void()), ...);
}
constexpr auto all_operations = std::make_index_sequence<std::variant_size_v<rig::Operation::Variant>>();

void make_operation(rig::Operation& operation, std::size_t wanted) {
    make_operation(operation, wanted, all_operations);
}

}  // namespace

std::vector<std::string> operation_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i)
        names.emplace_back(rig::operation_name(i));
    return names;
}

std::vector<std::string> unit_members() {
    std::vector<std::string> members{"weight", "when", "enabled"};
    const auto add = [&](const std::string& name) {
        if (std::find(members.begin(), members.end(), name) == members.end()) members.push_back(name);
    };
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        rig::Operation operation;
        make_operation(operation, i);
        std::visit([&](auto& each) { rig::fields(each, [&](const char* name, auto&) { add(name); }); },
                   operation);
    }
    std::vector<std::string> of_curves;
    add_curve_members(of_curves);
    for (const std::string& name : of_curves) add(name);
    return members;
}

Json unit_json(const rig::Unit& unit) {
    Json json{{"unit", rig::operation_name(unit.operation.index())}, {"name", unit.name}};
    json.update(std::visit([](const auto& operation) { return Writer::all(operation); }, unit.operation));
    json["weight"] = input_json(unit.weight);
    json["when"] = input_json(unit.when);
    json["enabled"] = unit.enabled;
    return json;
}

Json units_json(const std::vector<rig::Unit>& units) {
    Json list = Json::array();
    for (const rig::Unit& unit : units) list.push_back(unit_json(unit));
    return list;
}

rig::Unit read_unit(const JsonPlace& place) {
    const JsonPlace kind = place["unit"];
    const std::string name = kind.text();
    const std::vector<std::string> names = operation_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) kind.fail("unknown unit " + json_summary(kind.json()));
    rig::Unit unit;
    make_operation(unit.operation, static_cast<std::size_t>(found - names.begin()));
    std::visit(
        [&](auto& operation) {
            Reader::all(place, operation, {"unit", "name", "weight", "when", "enabled"});
        },
        unit.operation);
    if (place.has("name")) unit.name = place["name"].text();
    if (place.has("weight")) unit.weight = read_input<double>(place["weight"]);
    if (place.has("when")) unit.when = read_input<bool>(place["when"]);
    if (place.has("enabled")) unit.enabled = place["enabled"].flag();
    return unit;
}

std::vector<rig::Unit> read_units(const JsonPlace& place) {
    std::vector<rig::Unit> units;
    place.for_each("units", max_lab_units, [&](const JsonPlace& each) { units.push_back(read_unit(each)); });
    return units;
}

void collect_names(const std::vector<rig::Unit>& units, std::set<std::string>& names) {
    for (const rig::Unit& unit : units) {
        if (!unit.name.empty()) names.insert(unit.name);
        if (const auto* for_each = std::get_if<rig::ForEach>(&unit.operation))
            collect_names(for_each->body.units(), names);
    }
}

void name_units(std::vector<rig::Unit>& units, std::set<std::string>& taken) {
    for (rig::Unit& unit : units) {
        if (unit.name.empty()) {
            const std::string base = rig::operation_name(unit.operation.index());
            unit.name = base;
            for (int i = 2; !taken.insert(unit.name).second; ++i) unit.name = base + " " + std::to_string(i);
        }
        if (auto* for_each = std::get_if<rig::ForEach>(&unit.operation))
            name_units(for_each->body.units(), taken);
    }
}

}  // namespace tendril::app
