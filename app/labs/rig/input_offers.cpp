#include "app/labs/rig/input_offers.hpp"

#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr const char* of_words[] = {"transform", "translation", "rotation", "scale", "x", "y", "z", "value"};

/// What Rig::make takes: an input of T also takes what it can be made from.
bool converts(rig::Type from, rig::Type to) {
    using enum rig::Type;
    return from == to || (from == Bool && to == Number) ||
           (from == Transform && (to == Vector || to == Rotation));
}

/// Parts of a pose, and those that differ between global and local.
std::vector<rig::Of> parts_of(rig::Type type) {
    using enum rig::Of;
    switch (type) {
        case rig::Type::Number:
            return {X, Y, Z};
        case rig::Type::Vector:
            return {Translation, Scale};
        case rig::Type::Rotation:
            return {Rotation};
        case rig::Type::Transform:
            return {Transform};
        default:
            return {};
    }
}

Json zero_of(rig::Type type) {
    switch (type) {
        case rig::Type::Bool:
            return false;
        case rig::Type::Number:
            return 0.0;
        case rig::Type::Vector:
            return Json::array({0, 0, 0});
        case rig::Type::Rotation:
            return Json::array({0, 0, 0, 1});
        default:
            return Json::object();
    }
}

class Offers {
  public:
    Offers(const RigPart& part, const UnitRow& row, const UnitInput& input)
        : part_(part), row_(row), input_(input) {}

    std::vector<InputOffer> list(std::size_t index) {
        switch (input_.takes) {
            case UnitInput::Takes::Value:
                if (!input_.literal()) literal();
                for (const rig::Type type : types()) values(type);
                break;
            case UnitInput::Takes::Element:
                if (row_.inner) offer("each element", {{"item", "each"}});
                elements(false);
                break;
            case UnitInput::Takes::Bone:
                elements(true);
                break;
            case UnitInput::Takes::Roots:
                roots(index);
                break;
            case UnitInput::Takes::Curve:
                for (const rig::NamedCurve& curve : definition().curves) offer(curve.name, curve.name);
                break;
            default:
                break;
        }
        return std::move(offers_);
    }

  private:
    const rig::Definition& definition() const { return part_.rig.definition(); }

    void offer(std::string title, Json value) {
        const auto* names = std::get_if<InputNames>(&input_.value);
        const bool now = title == input_.from || (names != nullptr && title == names->names.front());
        offers_.push_back({std::move(title), SharedJson(std::move(value)), now});
    }

    /// The only type that it takes, or those that a spring takes: its force goes with its result.
    std::vector<rig::Type> types() const {
        if (input_.type) return {*input_.type};
        if (input_.path == "/force") return {rig::type_of(part_.state.units[row_.at].outputs[1])};
        return {rig::Type::Number, rig::Type::Vector, rig::Type::Rotation};
    }

    /// What it is now, from now on for itself.
    void literal() {
        const rig::Type type = types().front();
        const auto* now = std::get_if<rig::Value>(&input_.value);
        const bool fits = now != nullptr && (rig::type_of(*now) == type || !input_.type);
        offer(type == rig::Type::Bool ? "a switch of its own" : "a value of its own",
              fits ? value_json(within_range(*now)) : zero_of(type));
    }

    /// A literal weight is 0 to 1, one among parents and a speed are not negative.
    rig::Value within_range(rig::Value value) const {
        auto* number = std::get_if<double>(&value);
        if (number == nullptr) return value;
        const bool weight = input_.path.ends_with("weight"), relative = input_.path.starts_with("/parents");
        if (weight || input_.path == "/max_speed") *number = std::max(*number, 0.0);
        if (weight && !relative) *number = std::min(*number, 1.0);
        return value;
    }

    void values(rig::Type type) {
        if (row_.inner) from_each(type);
        from_units(type);
        for (const bool controls : {true, false})
            for (const rig::Element& element : definition().elements)
                if ((element.kind == rig::ElementKind::Control) == controls) from_element(element, type);
    }

    void from_each(rig::Type type) {
        if (type == rig::Type::Number) {
            offer("each ratio, 0 to 1", {{"each", "ratio"}});
            offer("each index", {{"each", "index"}});
            offer("count of elements", {{"each", "count"}});
        }
        from_pose("each element", {{"item", "each"}}, type);
    }

    /// Those that have run by then: not the for-each that it is in, nor what another's body did once an
    /// element.
    void from_units(rig::Type type) {
        for (const UnitRow& each : unit_rows(part_)) {
            if (each.at >= row_.at) break;
            if (each.inner ? !(row_.inner && each.top == row_.top) : row_.inner && each.top == row_.top)
                continue;
            const std::vector<rig::Output> outputs = rig::outputs(each.unit->operation);
            for (std::size_t i = 0; i < outputs.size(); ++i) {
                if (!fits(rig::type_of(part_.state.units[each.at].outputs[i]), type)) continue;
                std::string title = "unit " + each.unit->name;
                if (std::string_view(outputs[i].name) != "result") title.append(", ").append(outputs[i].name);
                offer(std::move(title), {{"unit", each.unit->name}, {"output", outputs[i].name}});
            }
        }
    }

    void from_element(const rig::Element& element, rig::Type type) {
        const Json name{{"element", element.name}};
        if (element.control && fits(rig::type_of(element.control->kind), type)) {
            Json value = name;
            value["of"] = "value";
            offer(element.name + ", value", std::move(value));
        }
        from_pose(element.name, name, type);
    }

    void from_pose(const std::string& title, const Json& name, rig::Type type) {
        for (const rig::Of of : parts_of(type)) {
            for (const char* space : {"global", "local"}) {
                Json value = name;
                value["of"] = of_words[static_cast<std::size_t>(of)];
                value["space"] = space;
                std::string words = title;
                words.append(", ").append(of_words[static_cast<std::size_t>(of)]);
                if (space[0] == 'l') words += ", local";
                offer(std::move(words), std::move(value));
            }
        }
    }

    /// One that takes any type takes it as it is.
    bool fits(rig::Type from, rig::Type to) const { return input_.type ? converts(from, to) : from == to; }

    void elements(bool bones) {
        for (const rig::Element& each : definition().elements)
            if (!bones || each.kind == rig::ElementKind::Bone) offer(each.name, each.name);
    }

    void roots(std::size_t index) {
        const std::vector<std::string>& names = std::get<InputNames>(input_.value).names;
        for (const rig::Element& each : definition().elements) {
            if (std::ranges::count(names, each.name) > 0 &&
                !(index < names.size() && names[index] == each.name))
                continue;
            Json all = names;
            index < names.size() ? all[index] = each.name : all.emplace_back(each.name);
            offers_.push_back(
                {each.name, SharedJson(std::move(all)), index < names.size() && names[index] == each.name});
        }
        if (index >= names.size() || names.size() < 2) return;
        Json fewer = names;
        fewer.erase(index);
        offers_.push_back({"none: no root any more", SharedJson(std::move(fewer)), false});
    }

    const RigPart& part_;
    const UnitRow& row_;
    const UnitInput& input_;
    std::vector<InputOffer> offers_;
};

}  // namespace

std::vector<InputOffer> input_offers(const RigPart& part, const UnitRow& row, const UnitInput& input,
                                     std::size_t index) {
    return Offers(part, row, input).list(index);
}

}  // namespace tendril::app
