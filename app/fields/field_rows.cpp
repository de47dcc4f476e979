#include "app/fields/field_rows.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/row_search.hpp"

namespace tendril::app {
namespace {

/// "1/s" as "/s", "m/s^2" as "m/s²", "deg" as a degree sign, each with a space before it if needed.
std::string shown_unit(std::string unit) {
    if (unit.empty()) return "";
    if (unit == "deg" || unit == "rad") return "\u00b0";
    if (unit == "rad/s") return "\u00b0/s";
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

/// An angle is shown as its command takes it, in degrees.
double scale_of(const Field& field, const FieldText& text) {
    return is_angle(field) ? glm::degrees(1.0) : text.scale;
}

/// Drags within the usual range, if the field has one; values beyond it can be typed. `value` is the shown
/// one.
bool shown_number(const char* label, float& value, const Field& field, const FieldText& text,
                  const std::optional<FieldRange>& within = {}) {
    const bool usual = !within && field.usual.low < field.usual.high;
    const FieldRange range = within.value_or(field.slider());
    const auto low = static_cast<float>(scale_of(field, text) * range.low),
               high = static_cast<float>(scale_of(field, text) * range.high);
    const std::string format = format_of(field, text);
    if (!usual) return number_field(label, value, text.step, low, high, format.c_str(), text.at_zero);
    const float step = field.scale == FieldScale::Logarithmic ? std::max(0.01f * std::abs(value), 1e-4f)
                                                              : 0.005f * (high - low);
    return number_field(label, value, step, std::min(low, value), std::max(high, value), format.c_str(),
                        text.at_zero);
}

}  // namespace

const FieldText& FieldRows::text_of(const Field& field) const {
    const std::string_view name = field.name;
    const auto text = std::ranges::find(texts_, name, [](const FieldText& each) { return each.name; });
    if (text == texts_.end()) throw std::logic_error(command_ + " says nothing of " + field.name);
    return *text;
}

void FieldRows::row(std::string_view name, const RowOptions& options) const {
    const Field* const field = find_field(of_.table, name);
    if (field == nullptr) throw std::logic_error(command_ + " has no field " + std::string(name));
    const FieldText& text = text_of(*field);
    if (more_ == nullptr || !text.more) {
        note_row_of(command_, file_name(*field));
        return draw(*field, text, options);
    }
    more_->add(text.label, {command_, {file_name(*field)}}, changed(*field),
               [rows = *this, field, &text, options] { rows.draw(*field, text, options); });
}

bool FieldRows::changed(const Field& field) const {
    return of_.fresh != nullptr && !same_field(field, of_.object, of_.fresh);
}

void FieldRows::draw(const Field& field, const FieldText& text, const RowOptions& options) const {
    note_text(&text, text.label);
    if (field.type == FieldType::Choice && !text.listed) return button_rows(field, text);
    ImGui::BeginDisabled(!options.why_not.empty());
    if (field.type == FieldType::Flag)
        flag_row(field, text);
    else if (field.type == FieldType::Pair)
        pair_row(field, text);
    else if (field.type == FieldType::Point)
        point_row(field, text);
    else if (field.type == FieldType::Rotation)
        rotation_row(field, text);
    else if (field.type == FieldType::Choice)
        list_row(field, text, options);
    else
        number_row(field, text, options);
    ImGui::EndDisabled();
    std::string help = text.help;
    if (!options.why_not.empty()) help += ' ' + options.why_not;
    if (field.type == FieldType::Choice) {  // help of the chosen one only; the list shows the others
        const EnumRow& now = text.choices[static_cast<std::size_t>(chosen(field, text))];
        if (now.help != nullptr && *now.help != '\0') help += std::string("\n") + now.title + ": " + now.help;
    }
    explain(help.c_str());
}

ArgumentList FieldRows::arguments(const Field& field, ArgumentValue value) const {
    ArgumentList all = with_;
    all.push_back({file_name(field), std::move(value)});
    return all;
}

void FieldRows::flag_row(const Field& field, const FieldText& text) const {
    bool on = field.get(of_.object)[0] != 0.0;
    if (ImGui::Checkbox(text.label, &on)) emit_(command_, arguments(field, on));
}

void FieldRows::number_row(const Field& field, const FieldText& text, const RowOptions& options) const {
    FieldRange range = options.within.value_or(field.range);
    if (field.over_low) range.low += static_cast<double>(text.step) / text.scale;
    double now = field.get(of_.object)[0];
    if (std::isnan(now)) now = options.otherwise.value_or(range.low);
    if (field.type == FieldType::Integer) {
        int value = static_cast<int>(now);
        if (integer_field(text.label, value, static_cast<int>(range.low), static_cast<int>(range.high)))
            emit_.continuously(command_, arguments(field, value));
        return;
    }
    auto value = static_cast<float>(scale_of(field, text) * now);
    if (shown_number(text.label, value, field, text, options.within))
        emit_.continuously(
            command_, arguments(field, is_angle(field) ? value : value / static_cast<float>(text.scale)));
}

void FieldRows::pair_row(const Field& field, const FieldText& text) const {
    const FieldValue now = field.get(of_.object);
    for (std::size_t i = 0; i < 2; ++i) {
        if (i > 0) explain(text.help);  // the caller explains the last one
        const std::string label = std::string(text.label) + ' ' + text.ends[i];
        auto value = static_cast<float>(text.scale * now[i]);
        if (!shown_number(label.c_str(), value, field, text)) continue;
        FieldValue changed = now;
        changed[i] = shortest_decimal(value / static_cast<float>(text.scale));
        emit_.continuously(command_, arguments(field, SharedJson(Json{changed[0], changed[1]})));
    }
}

void FieldRows::point_row(const Field& field, const FieldText& text) const {
    const FieldValue now = field.get(of_.object);
    glm::vec3 value(now[0], now[1], now[2]);
    const auto most = static_cast<float>(field.slider().high);
    std::string label = text.label, format = format_of(field, text);
    if (const std::size_t unit = format.find(' '); text.in_line && unit != format.npos) {
        label += ',' + format.substr(unit);  // too wide to repeat in all three fields
        format.resize(unit);
    }
    if (text.in_line
            ? vector_field(label.c_str(), value, text.step, glm::vec3(-most), glm::vec3(most), format.c_str())
            : point_field(label.c_str(), value, text.step, most, format.c_str()))
        emit_.continuously(command_, arguments(field, glm::max(value, static_cast<float>(field.range.low))));
}

/// Euler angles, in degrees. A change rotates about the rotation's own axes: setting angles directly would
/// lock at a pole.
void FieldRows::rotation_row(const Field& field, const FieldText& text) const {
    const glm::quat rotation = rotation_of(field.get(of_.object));
    const glm::vec3 was = glm::degrees(glm::eulerAngles(rotation)) + 0.0f;  // no -0
    glm::vec3 turned = was;
    const std::string format = "%." + std::to_string(text.decimals) + "f\u00b0";
    if (point_field(text.label, turned, text.step, 360.0f, format.c_str()))
        emit_.continuously(command_, arguments(field, rotation * glm::quat(glm::radians(turned - was))));
}

/// The index of the field's value in the text's choices.
int FieldRows::chosen(const Field& field, const FieldText& text) const {
    const std::string_view name = field.choices[static_cast<std::size_t>(field.get(of_.object)[0])];
    const auto row = std::ranges::find(text.choices, name, &EnumRow::name);
    if (row == text.choices.end())
        throw std::logic_error(command_ + " has no title for " + std::string(name));
    return static_cast<int>(row - text.choices.begin());
}

void FieldRows::list_row(const Field& field, const FieldText& text, const RowOptions& options) const {
    std::vector<const char*> titles;
    for (const EnumRow& each : text.choices) titles.push_back(each.title);
    int at = chosen(field, text);
    const auto& why_not = options.why_not_choices;
    if (choice_field(text.label, at, titles.data(), static_cast<int>(titles.size()),
                     why_not.empty() ? nullptr : why_not.data(), options.swatches))
        emit_(command_, arguments(field, text.choices[static_cast<std::size_t>(at)].name));
}

void FieldRows::button_rows(const Field& field, const FieldText& text) const {
    const int now = chosen(field, text);
    for (int i = 0; const EnumRow& each : text.choices)
        if (option_button(each.title, i++ == now, each.help)) emit_(command_, arguments(field, each.name));
}

}  // namespace tendril::app
