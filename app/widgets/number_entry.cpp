#include "app/widgets/number_entry.hpp"

#include <imgui.h>
#include <imgui_internal.h>  // the only way to ask whether the next item is disabled
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "app/io/text.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {

NumberEditing& number_editing() {
    return *static_cast<NumberEditing*>(ImGui::GetIO().UserData);
}

namespace {

bool is_disabled() {
    return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
}

void note_range(double low, double high, const char* format) {
    RowAbove& row = number_editing().row;
    row.has_range = true;
    row.low = low;
    row.high = high;
    std::snprintf(row.format.data(), row.format.size(), "%s", format);
}

bool is_edited(ImGuiID id) {
    // A field that was not drawn in the last frame has vanished, with its text.
    return number_editing().id == id && number_editing().frame >= ImGui::GetFrameCount() - 1;
}

void begin_editing(ImGuiID id, double value) {
    NumberEditing& now = number_editing();
    now.id = id;
    now.frame = ImGui::GetFrameCount();
    now.begins = true;
    now.tabbed_in = -1;
    std::snprintf(now.text.data(), now.text.size(), "%.7g", value == 0.0 ? 0.0 : value);
    now.before = now.text;
}

ImVec4 mixed_with_red(const ImVec4& colour) {
    const auto mixed = [](float from, float to) { return from + 0.4f * (to - from); };
    return {mixed(colour.x, 0.9f), mixed(colour.y, 0.15f), mixed(colour.z, 0.1f), 1.0f};
}

TypedNumber read(const char* text, const std::string& unit, bool whole) {
    TypedNumber typed = read_number(text, unit);
    if (whole && typed.value && std::isfinite(*typed.value) && *typed.value != std::round(*typed.value))
        typed = {std::nullopt, '"' + std::string(text) + "\" is not a whole number"};
    return typed;
}

std::optional<double> edited_text(const char* id, const std::string& unit, bool whole) {
    NumberEditing& now = number_editing();
    now.frame = ImGui::GetFrameCount();
    if (std::exchange(now.begins, false)) ImGui::SetKeyboardFocusHere();
    const auto is_empty = [&] { return now.text[0] == '\0'; };
    const bool was_wrong = !is_empty() && !read(now.text.data(), unit, whole).value;
    if (was_wrong)
        ImGui::PushStyleColor(ImGuiCol_FrameBg, mixed_with_red(ImGui::GetStyleColorVec4(ImGuiCol_FrameBg)));
    const std::string text_id = std::string(id) + " text";
    // ImGui's own Tab goes to the next text field, and a number is not one until it is clicked.
    bool tabbed = false;
    const auto take_tab = [](ImGuiInputTextCallbackData* data) {
        *static_cast<bool*>(data->UserData) = true;
        return 0;
    };
    const bool entered =
        ImGui::InputText(text_id.c_str(), now.text.data(), now.text.size(),
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll |
                             ImGuiInputTextFlags_CallbackCompletion,
                         take_tab, &tabbed);
    const bool left = tabbed || ImGui::IsItemDeactivated();
    if (was_wrong) ImGui::PopStyleColor();
    const TypedNumber typed = read(now.text.data(), unit, whole);
    const bool wrong = !is_empty() && !typed.value;
    if (!entered && !left) {
        if (wrong && ImGui::IsItemActive()) tell_below(typed.error);
        return std::nullopt;
    }
    const bool same = now.text == now.before;
    if (wrong && entered) {  // Enter keeps the invalid text in edit
        now.begins = true;
        return std::nullopt;
    }
    now.id = 0;
    if (tabbed) now.tabbed_in = ImGui::GetFrameCount();
    if (escape_pressed() || is_empty() || same) return std::nullopt;
    if (wrong) now.refused = typed.error;
    now.entered = now.entered || typed.value;
    return typed.value;
}

enum class Kind { Length, Angle, Time, Speed, Turning, Frequency, Share };

struct Unit {
    std::string_view name;
    Kind kind;
    double size;  ///< the size of one, in the first unit of its kind
};
constexpr double degrees = 180.0 / std::numbers::pi;
constexpr std::array units{Unit{"m", Kind::Length, 1.0},         Unit{"km", Kind::Length, 1e3},
                           Unit{"cm", Kind::Length, 1e-2},       Unit{"mm", Kind::Length, 1e-3},
                           Unit{"in", Kind::Length, 0.0254},     Unit{"ft", Kind::Length, 0.3048},
                           Unit{"deg", Kind::Angle, 1.0},        Unit{"\u00b0", Kind::Angle, 1.0},
                           Unit{"rad", Kind::Angle, degrees},    Unit{"s", Kind::Time, 1.0},
                           Unit{"ms", Kind::Time, 1e-3},         Unit{"min", Kind::Time, 60.0},
                           Unit{"m/s", Kind::Speed, 1.0},        Unit{"cm/s", Kind::Speed, 1e-2},
                           Unit{"km/h", Kind::Speed, 1.0 / 3.6}, Unit{"deg/s", Kind::Turning, 1.0},
                           Unit{"\u00b0/s", Kind::Turning, 1.0}, Unit{"rad/s", Kind::Turning, degrees},
                           Unit{"Hz", Kind::Frequency, 1.0},     Unit{"kHz", Kind::Frequency, 1e3},
                           Unit{"/s", Kind::Frequency, 1.0},     Unit{"%", Kind::Share, 1.0}};

const Unit* find_unit(std::string_view name) {
    for (const Unit& each : units)
        if (each.name == name) return &each;
    return nullptr;
}

std::string quoted(std::string_view text) {
    return '"' + std::string(text) + '"';
}

/// Reads from left to right; left() is the unread rest.
class Reader {
  public:
    explicit Reader(std::string_view text) : left_(text) { skip(); }

    std::optional<double> sum() {
        std::optional<double> value = product();
        while (value) {
            if (take('+')) {
                value = with(value, product(), [](double a, double b) { return a + b; });
            } else if (take('-')) {
                value = with(value, product(), [](double a, double b) { return a - b; });
            } else {
                break;
            }
        }
        return value;
    }
    std::string_view left() const { return left_; }

  private:
    static constexpr int deepest = 50;

    template <class Do>
    static std::optional<double> with(std::optional<double> a, std::optional<double> b, Do combine) {
        return a && b ? std::optional(combine(*a, *b)) : std::nullopt;
    }
    std::optional<double> product() {
        std::optional<double> value = power();
        while (value) {
            if (take('*')) {
                value = with(value, power(), [](double a, double b) { return a * b; });
            } else if (!left_.starts_with("/s") && take('/')) {
                value = with(value, power(), [](double a, double b) { return a / b; });
            } else {
                break;
            }
        }
        return value;
    }
    std::optional<double> power() {
        if (depth_ > deepest) return std::nullopt;
        if (take('+')) return deeper(&Reader::power);
        if (take('-')) {
            const std::optional<double> value = deeper(&Reader::power);
            return value ? std::optional(-*value) : value;
        }
        const std::optional<double> base = single();
        if (!base || !take('^')) return base;
        return with(base, deeper(&Reader::power), [](double a, double b) { return std::pow(a, b); });
    }
    std::optional<double> single() {
        if (take('(')) {
            const std::optional<double> value = deeper(&Reader::sum);
            return value && take(')') ? value : std::nullopt;
        }
        if (left_.starts_with("pi")) {
            left_.remove_prefix(2);
            skip();
            return std::numbers::pi;
        }
        double value = 0.0;
        const auto [end, error] = read_double(left_.data(), left_.data() + left_.size(), value);
        if (end == left_.data() || left_.starts_with("inf") || left_.starts_with("nan")) return std::nullopt;
        const std::string_view digits(left_.data(), static_cast<std::size_t>(end - left_.data()));
        const bool tiny =
            digits.find("e-") != std::string_view::npos || digits.find("E-") != std::string_view::npos;
        if (error == std::errc::result_out_of_range) value = tiny ? 0.0 : HUGE_VAL;
        left_.remove_prefix(static_cast<std::size_t>(end - left_.data()));
        skip();
        return value;
    }
    std::optional<double> deeper(std::optional<double> (Reader::*read)()) {
        ++depth_;
        const std::optional<double> value = (this->*read)();
        --depth_;
        return value;
    }
    bool take(char symbol) {
        if (!left_.starts_with(symbol)) return false;
        left_.remove_prefix(1);
        skip();
        return true;
    }
    void skip() {
        while (left_.starts_with(' ') || left_.starts_with('\t')) left_.remove_prefix(1);
    }

    std::string_view left_;
    int depth_ = 0;
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

}  // namespace

std::optional<double> number_entry(const char* id, double value, double speed, double low, double high,
                                   const char* format, bool whole, const char* at_zero) {
    const ImGuiID own = ImGui::GetID(id);
    note_range(low, high, format);
    if (number_editing().tabbed_in == ImGui::GetFrameCount() && !is_disabled()) begin_editing(own, value);
    if (is_edited(own)) return edited_text(id, unit_of(format), whole);

    char text[64];
    std::snprintf(text, sizeof text, format, value);
    double shown = without_signed_zero(text) == text ? value : 0.0;
    const char* const seen = at_zero != nullptr && value == 0.0 ? at_zero : format;
    const ImGuiIO& io = ImGui::GetIO();
    // ImGui makes a drag ten times coarser with Shift; this makes it ten times finer.
    const auto pace = static_cast<float>(io.KeyShift ? 0.01 * speed : speed);
    const bool changed = ImGui::DragScalar(id, ImGuiDataType_Double, &shown, pace, &low, &high, seen,
                                           ImGuiSliderFlags_NoInput);
    const bool clicked = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
                         io.MouseDragMaxDistanceSqr[0] < io.MouseDragThreshold * io.MouseDragThreshold;
    if (clicked && !changed) begin_editing(own, value);
    return changed ? std::optional(shown) : std::nullopt;
}

TypedNumber read_number(std::string_view text, std::string_view unit) {
    Reader reader(text);
    std::optional<double> value = reader.sum();
    if (!value) return {std::nullopt, quoted(trimmed(text)) + " is not a number"};
    if (std::isnan(*value)) return {std::nullopt, quoted(trimmed(text)) + " has no value"};
    const std::string_view name = trimmed(reader.left());
    if (name.empty() || name == unit) return {value, {}};
    const Unit* const given = find_unit(name);
    const Unit* const wanted = find_unit(unit);
    if (given == nullptr) return {std::nullopt, quoted(trimmed(text)) + " is not a number"};
    if (wanted == nullptr) return {std::nullopt, quoted(trimmed(text)) + ": this number has no unit"};
    if (wanted->kind != given->kind)
        return {std::nullopt, quoted(trimmed(text)) + ": this number is in " + std::string(unit)};
    return {*value * given->size / wanted->size, {}};
}

std::string unit_of(std::string_view format) {
    const std::size_t number = format.find('%');
    const std::size_t end = format.find_first_of("fgdeu", number);
    if (number == std::string_view::npos || end == std::string_view::npos) return {};
    std::string_view behind = format.substr(end + 1);
    while (behind.starts_with(' ')) behind.remove_prefix(1);
    if (behind.starts_with("%%")) behind.remove_prefix(1);
    return std::string(trimmed(behind));
}

}  // namespace tendril::app
