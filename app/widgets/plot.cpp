#include "app/widgets/plot.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "app/io/text.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

/// Divides `range` into at most `most` round steps.
float tick_step(float range, int most) {
    return static_cast<float>(axis_step(static_cast<double>(range) / static_cast<double>(most)));
}

constexpr float clamp_margin = 4000.0f;  ///< pixels beyond the plot at which points are clamped

class Plot {
  public:
    Plot(std::span<const Curve> curves, const PlotAxes& axes, ImVec2 at, ImVec2 size)
        : curves_(curves), axes_(axes), list_(ImGui::GetWindowDrawList()) {
        most_x_ = std::max(axes.min_x, axes.from_x);
        float max_y = axes.level > 0.0f ? axes.level : -1e30f, min_y = 1e30f;
        for (const Curve& curve : curves) {
            for (const glm::vec2 p : curve.points) {
                most_x_ = std::max(most_x_, p.x);
                max_y = std::max(max_y, p.y);
                min_y = std::min(min_y, p.y);
            }
        }
        has_zero_ = min_y <= 0.0f;
        if (logarithmic()) {
            low_ = std::floor(std::log10(axes.min_y));
            high_ = std::max(low_ + 1.0f, std::ceil(std::log10(std::max(max_y, axes.min_y)) - 1e-4f));
        } else if (axes.low_y < axes.high_y) {
            low_ = axes.fixed_y ? axes.low_y : std::min(axes.low_y, min_y);
            high_ = axes.fixed_y ? axes.high_y : std::max(axes.high_y, max_y);
        } else if (min_y <= max_y) {
            // Show a nearly constant curve as such.
            const float room = std::max(0.05f * (max_y - min_y), 1e-3f * std::max(std::abs(max_y), 1e-3f));
            low_ = min_y - room;
            high_ = max_y + room;
        }
        if (axes.named) high_ += 0.1f * (high_ - low_);  // keep names at the top off the title
        const float text = ImGui::GetFontSize();
        from_.y = at.y + 1.2f * text;
        to_ = {at.x + size.x - 0.6f * text, at.y + size.y - 2.4f * text};
        float widest = 0.0f;
        for (const Mark& mark : y_marks())
            widest = std::max(widest, ImGui::CalcTextSize(mark.text.c_str()).x);
        from_.x = at.x + widest + 0.5f * text;
        if (axes.left < axes.right) from_.x = axes.left, to_.x = axes.right;
    }

    void draw() {
        list_->AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
        grid();
        list_->PushClipRect({from_.x, from_.y - 1.0f}, {to_.x + 1.0f, to_.y + 1.0f}, true);
        if (axes_.level > 0.0f) dashed(y(axes_.level));
        if (axes_.at_x >= 0.0f) {
            list_->AddLine({x(axes_.at_x), from_.y}, {x(axes_.at_x), to_.y}, dim(), 1.5f);
        }
        // Curves that stay inside are drawn over those that leave, which may cover everything.
        for (const Curve& curve : curves_)
            if (leaves(curve)) line(curve);
        for (const Curve& curve : curves_)
            if (!leaves(curve)) line(curve);
        for (const Curve& curve : curves_) exits(curve);
        list_->PopClipRect();
        for (const Curve& curve : curves_)
            if (curve.points.size() == 1) line(curve);  // a single point is not clipped at the edge
        if (axes_.named) names();
    }

    /// The tooltip: all curves at the mouse's x, or the nearest point.
    void tell(ImVec2 mouse) const {
        if (axes_.reads_all)
            tell_all(mouse);
        else
            tell_nearest(mouse);
    }

    /// Values of both axes at a pixel, clamped to the plot; on a logarithmic axis not the exponent.
    glm::vec2 values_at(ImVec2 at) const {
        const float share_x = std::clamp((at.x - from_.x) / std::max(to_.x - from_.x, 1.0f), 0.0f, 1.0f);
        const float share_y = std::clamp((to_.y - at.y) / std::max(to_.y - from_.y, 1.0f), 0.0f, 1.0f);
        const float power = low_ + share_y * (high_ - low_);
        return {axes_.from_x + share_x * (most_x_ - axes_.from_x),
                logarithmic() ? std::pow(10.0f, power) : power};
    }

  private:
    struct Mark {
        float at;  ///< on the screen
        std::string text;
    };

    void tell_all(ImVec2 mouse) const {
        if (mouse.x < from_.x || mouse.x > to_.x || mouse.y < from_.y || mouse.y > to_.y) return;
        const float at = axes_.from_x + (most_x_ - axes_.from_x) * (mouse.x - from_.x) / (to_.x - from_.x);
        list_->AddLine({mouse.x, from_.y}, {mouse.x, to_.y}, dim());
        const Tooltip opened;
        // The axis title "time, s" becomes "time 1.5 s" here.
        const std::string title = axes_.x;
        const std::size_t comma = std::min(title.find(", "), title.size());
        const std::string unit = comma < title.size() ? title.substr(comma + 1) : "";
        ImGui::TextDisabled("%s %s%s", title.substr(0, comma).c_str(),
                            short_text(static_cast<double>(at), axes_.x_unit).c_str(), unit.c_str());
        for (const Curve& curve : curves_) {
            const float value = value_at(curve, at);
            if (std::isnan(value)) continue;
            const float on_screen = y(value);
            if (on_screen >= from_.y && on_screen <= to_.y)
                list_->AddCircleFilled({mouse.x, on_screen}, 0.25f * ImGui::GetFontSize(),
                                       imgui_u32(curve.colour));
            colour_mark(curve.colour);
            ImGui::AlignTextToFramePadding();
            const double number = static_cast<double>(value);
            const std::string text = std::abs(number) < 1e6 ? fixed_text(number, 3) : "over a million";
            ImGui::Text("%s  %s", text.c_str(), curve.name.c_str());
        }
    }

    void tell_nearest(ImVec2 mouse) const {
        const Curve* nearest = nullptr;
        glm::vec2 point{0.0f};
        float nearest_away = 1e9f;
        for (const Curve& curve : curves_) {
            for (const glm::vec2 p : curve.points) {
                const float away = std::hypot(x(p.x) - mouse.x, y(p.y) - mouse.y);
                if (away < nearest_away) nearest_away = away, nearest = &curve, point = p;
            }
        }
        if (nearest == nullptr) return;
        list_->AddCircle({x(point.x), y(point.y)}, 0.3f * ImGui::GetFontSize(), imgui_u32(nearest->colour));
        // Omit a curve's name if it equals the axis title.
        const std::string title = nearest->name == axes_.y ? std::string() : nearest->name + "\n";
        tooltip(title + axes_.x + ' ' + short_text(static_cast<double>(point.x), axes_.x_unit) + '\n' +
                axes_.y + ' ' + short_text(static_cast<double>(point.y), axes_.y_unit) + axes_.note);
    }

    float x(float value) const {
        const float span = std::max(most_x_ - axes_.from_x, 1e-12f);
        return from_.x + (to_.x - from_.x) * (value - axes_.from_x) / span;
    }
    bool logarithmic() const { return axes_.min_y > 0.0f; }
    float y(float value) const {
        const float at = along_y(logarithmic() ? std::max(std::log10(std::max(value, 0.0f)), low_) : value);
        return std::clamp(at, from_.y - clamp_margin, to_.y + clamp_margin);
    }
    /// The y pixel of a value, or of its base-10 logarithm on a logarithmic axis.
    float along_y(float power) const { return to_.y + (from_.y - to_.y) * (power - low_) / (high_ - low_); }
    static ImU32 dim() { return ImGui::GetColorU32(ImGuiCol_TextDisabled); }

    std::vector<Mark> y_marks() const {
        std::vector<Mark> marks;
        const int rows = std::max(1, static_cast<int>((to_.y - from_.y) / (1.6f * ImGui::GetFontSize())));
        const float step_y = logarithmic()
                                 ? std::max(1.0f, std::round(tick_step(high_ - low_, std::min(6, rows))))
                                 : tick_step(high_ - low_, std::min(4, rows));
        const float first = logarithmic() ? low_ : std::ceil(low_ / step_y) * step_y;
        for (int i = 0; first + static_cast<float>(i) * step_y <= high_ + 1e-3f * step_y; ++i) {
            const float power = first + static_cast<float>(i) * step_y;
            // Enough digits to distinguish the marks.
            const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step_y) - 1e-4f)), 0, 6);
            std::string text = logarithmic()
                                   ? short_text(std::pow(10.0, static_cast<double>(power)), axes_.y_unit)
                                   : fixed_text(static_cast<double>(power), digits);
            if (logarithmic() && i == 0 && has_zero_) text = "0";  // the logarithmic axis has none of its own
            marks.push_back({along_y(power), std::move(text)});
        }
        return marks;
    }

    void grid() {
        const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border, 0.7f);
        float lowest = from_.y;  // bottom of the texts beside the y axis
        for (const auto& [at, text] : y_marks()) {
            list_->AddLine({from_.x, at}, {to_.x, at}, line);
            const ImVec2 size = ImGui::CalcTextSize(text.c_str());
            lowest = std::max(lowest, at + 0.5f * size.y);
            list_->AddText({from_.x - size.x - 4.0f, at - 0.5f * size.y}, dim(), text.c_str());
        }
        const int room = std::max(1, static_cast<int>((to_.x - from_.x) / (3.5f * ImGui::GetFontSize())));
        const float min_step = axes_.whole_x ? 1.0f : 0.0f;
        const float step = std::max(min_step, tick_step(most_x_ - axes_.from_x, room));
        const float first = std::ceil(axes_.from_x / step - 1e-4f) * step;
        const float last = most_x_ + 1e-4f * (most_x_ - axes_.from_x);
        for (int i = 0; first + static_cast<float>(i) * step <= last; ++i) {
            const float value = first + static_cast<float>(i) * step;
            list_->AddLine({x(value), from_.y}, {x(value), to_.y}, line);
            const double largest = static_cast<double>(std::max(std::abs(most_x_), std::abs(axes_.from_x)));
            const std::string text =
                axis_text(static_cast<double>(value), static_cast<double>(step), largest, axes_.x_unit);
            const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
            const float most = to_.x - 2.0f * half + 0.5f * ImGui::GetFontSize();
            const float leftmost = lowest > to_.y + 2.0f ? from_.x - 3.0f : from_.x - half;
            list_->AddText({std::max(leftmost, std::min(x(value) - half, most)), to_.y + 2.0f}, dim(),
                           text.c_str());
        }
        const float text_height = ImGui::GetFontSize();
        list_->AddText({from_.x, from_.y - 1.15f * text_height}, dim(), y_title().c_str());
        const float width = ImGui::CalcTextSize(axes_.x).x;
        list_->AddText({to_.x - width, to_.y + 2.0f + 1.1f * text_height}, dim(), axes_.x);
    }

    /// Includes the unit if the marks do not show it.
    std::string y_title() const {
        return logarithmic() || *axes_.y_unit == '\0' ? axes_.y : std::string(axes_.y) + ", " + axes_.y_unit;
    }

    void dashed(float at) {
        const float dash = 0.3f * ImGui::GetFontSize();
        for (float from = from_.x; from < to_.x; from += 2.0f * dash) {
            list_->AddLine({from, at}, {std::min(from + dash, to_.x), at}, dim());
        }
    }

    bool outside(float value) const { return axes_.fixed_y && (value < low_ || value > high_); }
    bool leaves(const Curve& curve) const {
        return std::any_of(curve.points.begin(), curve.points.end(),
                           [&](glm::vec2 p) { return outside(p.y); });
    }

    /// Marks where the curve leaves the axis range, without overlapping marks.
    void exits(const Curve& curve) {
        const float size = 0.45f * ImGui::GetFontSize();
        float last[2] = {-1e9f, -1e9f};  // below and above
        for (const glm::vec2 p : curve.points) {
            const bool above = p.y > high_;
            const float at = x(p.x);
            if (!outside(p.y) || at - last[above] < 9.0f * size) continue;
            last[above] = at;
            const float edge = above ? from_.y : to_.y, inwards = above ? 1.0f : -1.0f;
            const ImVec2 tip{at, edge + inwards * 0.2f * size};
            const ImVec2 left{at - size, edge + inwards * 1.6f * size},
                right{at + size, edge + inwards * 1.6f * size};
            list_->AddTriangleFilled(tip, left, right, imgui_u32(curve.colour));
            list_->AddTriangle(tip, left, right, ImGui::GetColorU32(ImGuiCol_WindowBg), 0.25f * size);
        }
    }

    void line(const Curve& curve) {
        const ImU32 colour = imgui_u32(curve.colour, curve.strength);
        std::vector<ImVec2> points;
        for (const glm::vec2 p : curve.points) points.push_back({x(p.x), y(p.y)});
        polyline(points, colour, 0.13f * curve.width * ImGui::GetFontSize());
        if (points.empty()) return;
        // Marks closer than this would merge into one thick line.
        const float size = 0.17f * curve.width * ImGui::GetFontSize();
        const float apart = (points.back().x - points.front().x) / static_cast<float>(points.size());
        if (!curve.marks || apart < 3.0f * size) points = {points.back()};
        for (const ImVec2 p : points) list_->AddCircleFilled(p, size, colour);
    }

    /// Draws separate pieces where the line reverses: Dear ImGui's joints would have no width there, and a
    /// fast swing would look like a cloud of dots.
    void polyline(const std::vector<ImVec2>& points, ImU32 colour, float width) {
        std::size_t begin = 0;
        for (std::size_t i = 1; i < points.size(); ++i) {
            const bool last = i + 1 == points.size();
            const ImVec2 p = points[i - 1], q = points[i], r = points[last ? i : i + 1];
            const bool back = (q.x - p.x) * (r.x - q.x) + (q.y - p.y) * (r.y - q.y) < 0.0f;
            if (!last && !back) continue;
            list_->AddPolyline(points.data() + begin, static_cast<int>(i - begin) + 1, colour,
                               ImDrawFlags_None, width);
            begin = i;
        }
    }

    struct Box {
        ImVec2 low, high;
        bool meets(const Box& other) const {
            return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
                   other.low.y < high.y;
        }
    };

    /// Writes names beside single points where there is room, in order, overlapping neither names nor points.
    void names() {
        std::vector<Box> taken;
        const float unit = ImGui::GetFontSize();
        for (const Curve& curve : curves_) {
            if (curve.points.size() != 1) continue;
            const ImVec2 at{x(curve.points[0].x), y(curve.points[0].y)};
            const float radius = 0.17f * curve.width * unit;
            taken.push_back({{at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}});
        }
        for (const Curve& curve : curves_) {
            if (curve.points.size() != 1) continue;
            const ImVec2 at{x(curve.points[0].x), y(curve.points[0].y)};
            const ImVec2 size = ImGui::CalcTextSize(curve.name.c_str());
            const float gap = 0.17f * curve.width * unit + 0.3f * unit;
            const ImVec2 places[] = {{at.x + gap, at.y - 0.5f * size.y},
                                     {at.x - gap - size.x, at.y - 0.5f * size.y},
                                     {at.x - 0.5f * size.x, at.y - gap - 0.8f * size.y},
                                     {at.x - 0.5f * size.x, at.y + gap - 0.2f * size.y}};
            for (const ImVec2& low : places) {
                const Box box{low, {low.x + size.x, low.y + size.y}};
                const bool inside = box.low.x >= from_.x && box.high.x <= to_.x && box.low.y >= from_.y &&
                                    box.high.y <= to_.y;
                const bool free = std::none_of(taken.begin(), taken.end(),
                                               [&](const Box& other) { return box.meets(other); });
                if (!inside || !free) continue;
                list_->AddText(box.low, ImGui::GetColorU32(ImGuiCol_Text, curve.strength),
                               curve.name.c_str());
                taken.push_back(box);
                break;
            }
        }
    }

    std::span<const Curve> curves_;
    const PlotAxes& axes_;
    ImDrawList* list_;
    ImVec2 from_{}, to_{};
    float most_x_ = 0.0f, low_ = 0.0f, high_ = 1.0f;
    bool has_zero_ = false;  ///< a value is 0, on a logarithmic axis
};

}  // namespace

float value_at(const Curve& curve, float x) {
    const auto& points = curve.points;
    const auto after = std::lower_bound(points.begin(), points.end(), x,
                                        [](const glm::vec2& p, float at) { return p.x < at; });
    if (after == points.end()) return std::numeric_limits<float>::quiet_NaN();
    if (after->x == x) return after->y;
    if (after == points.begin()) return std::numeric_limits<float>::quiet_NaN();
    const glm::vec2 a = *(after - 1), b = *after;
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

namespace {

/// The axes; while the mouse button is held on the last item, the axes when it went down.
PlotAxes axes_of_stroke(const char* id, PlotAxes axes) {
    const bool held = ImGui::IsItemActive() && !ImGui::IsItemActivated();
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    ImGui::PushID(id);
    const auto keep = [&](const char* name, float& value) {
        float& before = *kept.GetFloatRef(ImGui::GetID(name), value);
        if (held)
            value = before;
        else
            before = value;
    };
    keep("low_y", axes.low_y);
    keep("high_y", axes.high_y);
    keep("from_x", axes.from_x);
    keep("min_x", axes.min_x);
    ImGui::PopID();
    return axes;
}

}  // namespace

PlotStroke plot(const char* id, std::span<const Curve> curves, const PlotAxes& axes, float height) {
    ImGui::PushFont(small_font());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(80.0f, ImGui::GetContentRegionAvail().x), height * ImGui::GetFontSize()};
    ImGui::InvisibleButton(id, size);
    const bool hovered = ImGui::IsItemHovered();
    const PlotAxes shown = axes.keeps_axes ? axes_of_stroke(id, axes) : axes;
    Plot drawing(curves, shown, at, size);
    drawing.draw();
    const ImVec2 mouse = ImGui::GetIO().MousePos, moved = ImGui::GetIO().MouseDelta;
    if (hovered) drawing.tell(mouse);
    ImGui::PopFont();
    if (!ImGui::IsItemActive()) return {};
    return {true, drawing.values_at({mouse.x - moved.x, mouse.y - moved.y}), drawing.values_at(mouse)};
}

void colour_mark(glm::vec3 colour) {
    const float side = 0.6f * ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5f * (ImGui::GetFrameHeight() - side);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side}, imgui_u32(colour),
                                              0.2f * side);
    ImGui::Dummy({side, ImGui::GetFrameHeight()});
    ImGui::SameLine();
}

double axis_step(double smallest) {
    smallest = std::max(smallest, 1e-12) * (1.0 - 1e-6);  // 0.1 may come as a rounded 0.3 / 3
    const double decade = std::pow(10.0, std::floor(std::log10(smallest)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (decade * factor >= smallest) return decade * factor;
    return 10.0 * decade;
}

std::string axis_text(double value, double step, double largest, const char* unit) {
    const std::string longest = short_text(largest, unit);  // "500 ms"
    const std::size_t space = longest.find(' ');
    const double shown = std::strtod(longest.c_str(), nullptr);
    const double thousands = shown != 0.0 ? std::round(std::log10(largest / shown) / 3.0) : 0.0;
    const double factor = std::pow(1000.0, thousands);
    const int decimals = static_cast<int>(std::ceil(-std::log10(std::max(step / factor, 1e-9)) - 1e-4));
    std::string text = fixed_text(value / factor, std::clamp(decimals, 0, 9));
    if (text.find('.') != text.npos) text.erase(text.find_last_not_of("0") + 1);
    if (text.back() == '.') text.pop_back();
    return space == longest.npos ? text : text + longest.substr(space);
}

}  // namespace tendril::app
