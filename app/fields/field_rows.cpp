#include "app/fields/field_rows.hpp"

#include <imgui.h>

#include <algorithm>
#include <stdexcept>

#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// "1/s" as "/s", "m/s^2" as "m/s²", "deg" as a degree sign; with the space before it.
std::string shown_unit(std::string unit) {
    if (unit.empty()) return "";
    if (unit == "deg") return "\u00b0";
    if (unit == "%") return " %%";
    if (unit.starts_with("1/")) unit.erase(0, 1);
    if (const std::size_t square = unit.find("^2"); square != std::string::npos)
        unit.replace(square, 2, "\u00b2");
    return " " + unit;
}

std::string format_of(const Field& field, const FieldText& text) {
    const char* const unit = text.unit != nullptr ? text.unit : field.unit;
    return "%." + std::to_string(text.decimals) + "f" + shown_unit(unit);
}

}  // namespace

const Field& FieldRows::field_named(std::string_view name) const {
    const Field* const field = find_field(of_.table, name);
    if (field == nullptr) throw std::logic_error(command_ + " has no field " + std::string(name));
    return *field;
}

const FieldText& FieldRows::text_of(const Field& field) const {
    const std::string_view name = field.name;
    const auto text = std::ranges::find(texts_, name, [](const FieldText& each) { return each.name; });
    if (text == texts_.end()) throw std::logic_error(command_ + " says nothing of " + field.name);
    return *text;
}

void FieldRows::row(std::string_view name) const {
    const Field& field = field_named(name);
    const FieldText& text = text_of(field);
    switch (field.type) {
        case FieldType::Flag: {
            bool on = field.get(of_.object)[0] != 0.0;
            if (ImGui::Checkbox(text.label, &on)) emit_(command_, arguments(field, on));
            return explain(text.help);
        }
        case FieldType::Integer: {
            int value = static_cast<int>(field.get(of_.object)[0]);
            if (integer_field(text.label, value, static_cast<int>(field.range.low),
                              static_cast<int>(field.range.high)))
                emit_.continuously(command_, arguments(field, value));
            return explain(text.help);
        }
        case FieldType::Number:
            return number_row(field, field.range);
        case FieldType::Point:
            return point_row(field, text);
        case FieldType::Choice:
            return choice_rows(field, text);
    }
}

void FieldRows::row(std::string_view name, FieldRange within) const {
    number_row(field_named(name), within);
}

ArgumentList FieldRows::arguments(const Field& field, ArgumentValue value) const {
    ArgumentList all = with_;
    all.push_back({field.name, std::move(value)});
    return all;
}

void FieldRows::number_row(const Field& field, FieldRange range) const {
    const FieldText& text = text_of(field);
    const auto shown = [&](double value) { return static_cast<float>(text.scale * value); };
    float value = shown(field.get(of_.object)[0]);
    if (number_field(text.label, value, text.step, shown(range.low), shown(range.high),
                     format_of(field, text).c_str()))
        emit_.continuously(command_, arguments(field, value / static_cast<float>(text.scale)));
    explain(text.help);
}

void FieldRows::point_row(const Field& field, const FieldText& text) const {
    const FieldValue now = field.get(of_.object);
    glm::vec3 value(now[0], now[1], now[2]);
    if (point_field(text.label, value, text.step, static_cast<float>(field.range.high),
                    format_of(field, text).c_str()))
        emit_.continuously(command_, arguments(field, value));
    explain(text.help);
}

/// A button for each.
void FieldRows::choice_rows(const Field& field, const FieldText& text) const {
    const auto chosen = static_cast<std::size_t>(field.get(of_.object)[0]);
    for (std::size_t i = 0; i < field.choices.size(); ++i)
        if (option_button(text.choices[i].title, i == chosen, text.choices[i].help))
            emit_(command_, arguments(field, field.choices[i]));
}

}  // namespace tendril::app
