#include "app/labs/rig/unit_inputs.hpp"

#include <algorithm>
#include <tendril/rig/fields.hpp>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/rig/unit_json.hpp"
#include "app/labs/rig/value_text.hpp"

namespace tendril::app {
namespace {

const char* words_of(rig::Of of) {
    constexpr const char* words[] = {"transform", "translation", "rotation", "scale", "x", "y", "z", "value"};
    return words[static_cast<std::size_t>(of)];
}

const char* words_of(rig::Space space, rig::Pose pose) {
    if (pose == rig::Pose::Initial) return space == rig::Space::Global ? ", initial" : ", initial local";
    return space == rig::Space::Global ? "" : ", local";
}

rig::Value part_of(const rig::Transform& pose, rig::Of of) {
    switch (of) {
        case rig::Of::Translation:
            return pose.translation;
        case rig::Of::Rotation:
            return pose.rotation;
        case rig::Of::Scale:
            return pose.scale;
        case rig::Of::X:
            return pose.translation.x;
        case rig::Of::Y:
            return pose.translation.y;
        case rig::Of::Z:
            return pose.translation.z;
        default:
            return pose;
    }
}

const char* unit_of(std::string_view field) {
    constexpr std::pair<std::string_view, const char*> units[] = {
        {"max_speed", "\xC2\xB0/s"}, {"strength", "Hz"},        {"speed_increasing", "/s"},
        {"speed_decreasing", "/s"},  {"target", "m"},           {"pole_target", "m"},
        {"location", "m"},           {"interpolated_value", ""}};
    for (const auto& [name, unit] : units)
        if (name == field) return unit;
    return "";
}

class Lister {
  public:
    Lister(const RigPart& part, const rig::Hierarchy& now, std::vector<UnitInput>& list)
        : part_(part), now_(now), list_(list) {}

    /// All fields of an operation, or of what is made of fields as one is.
    template <class T>
    void all(const T& of, const std::string& path, const std::string& title) {
        rig::fields(of, [&](const char* name, const auto& field) {
            std::string words = name;
            std::replace(words.begin(), words.end(), '_', ' ');
            unit_ = unit_of(name);
            list(field, path + '/' + name, title.empty() ? words : title + ' ' + words);
        });
    }

    template <class T>
    void list(const rig::Input<T>& input, const std::string& path, const std::string& title) {
        UnitInput& row = add(path, title);
        takes_value(row, input);
        if (const T* literal = input.literal()) {
            if constexpr (std::is_same_v<T, rig::Value>)
                row.value = *literal;
            else
                row.value = rig::Value(*literal);
        } else {
            std::visit([&](const auto& source) { source_of(row, source); }, input.source);
        }
    }

  private:
    UnitInput& add(const std::string& path, const std::string& title) {
        return list_.emplace_back(
            UnitInput{.path = path, .title = title, .unit = unit_, .from = {}, .value = {}});
    }
    template <class T>
    static void takes_value(UnitInput& row, const rig::Input<T>&) {
        row.takes = UnitInput::Takes::Value;
        if constexpr (!std::is_same_v<T, rig::Value>) row.type = rig::type_of(rig::Value(T()));
    }
    template <class T>
    static void takes_value(UnitInput&, const T&) {}

    void list(const rig::Item& item, const std::string& path, const std::string& title) {
        UnitInput& row = add(path, title);
        row.takes = path == "/root" || path == "/tip" ? UnitInput::Takes::Bone : UnitInput::Takes::Element;
        if (const auto* name = std::get_if<std::string>(&item.which))
            row.value = InputNames{{*name}, true};
        else
            row.from = "each element";
    }
    void list(const rig::AimInputs& inputs, const std::string& path, const std::string& title) {
        all(inputs, path, title);
    }
    template <class T>
    void list(const std::optional<T>& field, const std::string& path, const std::string& title) {
        if (field) return list(*field, path, title);
        UnitInput& row = add(path, title);
        row.from = "none";
        takes_value(row, T());
    }
    void list(rig::AimTarget kind, const std::string& path, const std::string& title) {
        add(path, title).value = InputChoice{static_cast<std::size_t>(kind), {"location", "direction"}};
    }
    void list(rig::Space space, const std::string& path, const std::string& title) {
        add(path, title).value = InputChoice{space == rig::Space::Global ? 0u : 1u, {"global", "local"}};
    }
    void list(const std::vector<rig::ParentInputs>& parents, const std::string& path, const std::string&) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            all(parents[i], path + '/' + std::to_string(i),
                parents.size() == 1 ? std::string("parent") : "parent " + std::to_string(i + 1));
    }
    void list(const rig::TransformFilter& filter, const std::string& path, const std::string& title) {
        add(path, title).value = InputFilter{filter};
    }
    void list(const std::vector<std::string>& roots, const std::string& path, const std::string& title) {
        UnitInput& row = add(path, title);
        row.value = InputNames{roots, true};
        row.takes = UnitInput::Takes::Roots;
    }
    void list(const rig::Body&, const std::string&, const std::string&) {}  // rows of their own
    void list(bool flag, const std::string& path, const std::string& title) {
        add(path, title).value = rig::Value(flag);
    }
    void list(const std::string& curve, const std::string& path, const std::string& title) {
        UnitInput& row = add(path, title);
        row.value = InputNames{{curve}, false};
        row.takes = UnitInput::Takes::Curve;
    }
    void list(const std::array<double, 2>& range, const std::string& path, const std::string& title) {
        add(path, title).value = InputRange{range[0], range[1]};
    }
    void list(const signal::Curve& curve, const std::string& path, const std::string& title) {
        add(path, title).value = InputCurve{curve};
    }

    template <class T>
    static void source_of(UnitInput&, const T&) {}  // the literal
    void source_of(UnitInput& row, const rig::FromElement& from) const {
        const auto* name = std::get_if<std::string>(&from.element.which);
        row.from = name != nullptr ? *name : "each element";
        row.from += std::string(", ") + words_of(from.of);
        if (from.of != rig::Of::ControlValue) row.from += words_of(from.space, from.pose);
        if (name == nullptr) return;
        const auto element = part_.rig.element(*name);
        if (!element) return;
        if (from.of == rig::Of::ControlValue)
            row.value = part_.state.controls[*element];
        else
            row.value = part_of(*now_.known(part_.rig.id(*element), from.space, from.pose), from.of);
    }
    void source_of(UnitInput& row, const rig::FromUnit& from) const {
        row.from = "unit " + from.unit;
        if (from.output != "result") row.from += ", " + from.output;
        const auto giver = unit_row(part_, from.unit);
        if (!giver) return;
        row.count = std::holds_alternative<rig::ForEach>(giver->unit->operation);
        const std::vector<rig::Output> outputs = rig::outputs(giver->unit->operation);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            if (outputs[i].name == from.output) row.value = part_.state.units[giver->at].outputs[i];
    }
    void source_of(UnitInput& row, rig::Each each) const {
        constexpr const char* words[] = {"each ratio, 0 to 1", "each index", "count of elements"};
        row.from = words[static_cast<std::size_t>(each)];
    }

    const RigPart& part_;
    const rig::Hierarchy& now_;
    std::vector<UnitInput>& list_;
    const char* unit_ = "";
};

}  // namespace

std::vector<UnitInput> unit_inputs(const RigPart& part, const rig::Hierarchy& now, const rig::Unit& unit) {
    std::vector<UnitInput> list;
    Lister lister(part, now, list);
    lister.list(unit.weight, "/weight", "weight");
    lister.list(unit.when, "/when", "when");
    std::visit([&](const auto& operation) { lister.all(operation, "", ""); }, unit.operation);
    return list;
}

bool is_speed_limit(const UnitInput& input) {
    return input.path.ends_with("max_speed");
}

std::string input_text(const UnitInput& input, const rig::Value& value) {
    const auto* number = std::get_if<double>(&value);
    if (number && input.count) return fixed_text(*number, 0);
    if (number && is_speed_limit(input))
        return *number > 0.0 ? fixed_text(*number, 1) + input.unit : std::string("no limit");
    return value_text(value);
}

Json with_input(const rig::Unit& unit, const std::string& path, Json value) {
    Json whole = unit_json(unit);
    whole[Json::json_pointer(path)] = std::move(value);
    const std::string member = path.substr(1, path.find('/', 1) - 1);
    return Json{{"name", unit.name}, {member, whole[member]}};
}

std::vector<UnitRow> unit_rows(const RigPart& part) {
    std::vector<UnitRow> rows;
    const std::vector<rig::Unit>& units = part.rig.definition().units;
    for (std::size_t top = 0; top < units.size(); ++top) {
        rows.push_back({&units[top], rows.size(), top, false});
        if (const auto* loop = std::get_if<rig::ForEach>(&units[top].operation))
            for (const rig::Unit& inner : loop->body.units())
                rows.push_back({&inner, rows.size(), top, true});
    }
    return rows;
}

std::optional<UnitRow> unit_row(const RigPart& part, std::string_view name) {
    for (const UnitRow& row : unit_rows(part))
        if (row.unit->name == name) return row;
    return std::nullopt;
}

}  // namespace tendril::app
