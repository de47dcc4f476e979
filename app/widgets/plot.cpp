#include "app/widgets/plot.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/document/units.hpp"
#include "app/widgets/fonts.hpp"

namespace tendril::app {
namespace {

ImU32 colour_of(glm::vec3 c, float alpha = 1.0f) {
    return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, alpha});
}

/// The smallest of 1, 2, 5, 10, ... that makes at most `most` steps of `range`.
float tick_step(float range, int most) {
    float step = std::pow(10.0f, std::floor(std::log10(std::max(range / static_cast<float>(most), 1e-12f))));
    for (const float factor : {1.0f, 2.0f, 5.0f, 10.0f}) {
        if (range / (step * factor) <= static_cast<float>(most)) return step * factor;
    }
    return step * 10.0f;
}

class Plot {
  public:
    Plot(std::span<const Curve> curves, const PlotAxes& axes, ImVec2 at, ImVec2 size)
        : curves_(curves), axes_(axes), list_(ImGui::GetWindowDrawList()) {
        most_x_ = axes.min_x;
        float max_y = axes.level > 0.0f ? axes.level : -1e30f, min_y = 1e30f;
        for (const Curve& curve : curves) {
            for (const glm::vec2 p : curve.points) {
                most_x_ = std::max(most_x_, p.x);
                max_y = std::max(max_y, p.y);
                min_y = std::min(min_y, p.y);
            }
        }
        if (logarithmic()) {
            low_ = std::floor(std::log10(axes.min_y));
            high_ = std::max(low_ + 1.0f, std::ceil(std::log10(std::max(max_y, axes.min_y)) - 1e-4f));
        } else if (min_y <= max_y) {
            // A curve that is all but level is shown so.
            const float room = std::max(0.05f * (max_y - min_y), 1e-3f * std::max(std::abs(max_y), 1e-3f));
            low_ = min_y - room;
            high_ = max_y + room;
        }
        const float text = ImGui::GetFontSize();
        from_.y = at.y + 1.2f * text;
        to_ = {at.x + size.x - 0.6f * text, at.y + size.y - 2.4f * text};
        float widest = 0.0f;
        for (const Mark& mark : y_marks())
            widest = std::max(widest, ImGui::CalcTextSize(mark.text.c_str()).x);
        from_.x = at.x + widest + 0.5f * text;
    }

    void draw() {
        list_->AddRectFilled(from_, to_, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
        grid();
        list_->PushClipRect({from_.x, from_.y - 1.0f}, {to_.x + 1.0f, to_.y + 1.0f}, true);
        if (axes_.level > 0.0f) dashed(y(axes_.level));
        if (axes_.at_x >= 0.0f) {
            list_->AddLine({x(axes_.at_x), from_.y}, {x(axes_.at_x), to_.y}, dim(), 1.5f);
        }
        for (const Curve& curve : curves_) line(curve);
        list_->PopClipRect();
    }

    /// What the nearest point to the mouse says.
    void tell(ImVec2 mouse) const {
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
        list_->AddCircle({x(point.x), y(point.y)}, 0.3f * ImGui::GetFontSize(), colour_of(nearest->colour));
        ImGui::SetTooltip("%s\n%s %s\n%s %s", nearest->name.c_str(), axes_.x,
                          short_text(static_cast<double>(point.x), axes_.x_unit).c_str(), axes_.y,
                          short_text(static_cast<double>(point.y), axes_.y_unit).c_str());
    }

  private:
    struct Mark {
        float at;  ///< on the screen
        std::string text;
    };

    float x(float value) const { return from_.x + (to_.x - from_.x) * value / std::max(most_x_, 1e-12f); }
    bool logarithmic() const { return axes_.min_y > 0.0f; }
    float y(float value) const {
        return along_y(logarithmic() ? std::log10(std::max(value, axes_.min_y)) : value);
    }
    /// Of a value, or on a logarithmic axis of its power of ten.
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
            // As many digits as tell one mark from the next.
            const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step_y) - 1e-4f)), 0, 6);
            marks.push_back(
                {along_y(power), logarithmic()
                                     ? short_text(std::pow(10.0, static_cast<double>(power)), axes_.y_unit)
                                     : fixed_text(static_cast<double>(power), digits)});
        }
        return marks;
    }

    void grid() {
        const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border, 0.7f);
        for (const auto& [at, text] : y_marks()) {
            list_->AddLine({from_.x, at}, {to_.x, at}, line);
            const ImVec2 size = ImGui::CalcTextSize(text.c_str());
            list_->AddText({from_.x - size.x - 4.0f, at - 0.5f * size.y}, dim(), text.c_str());
        }
        const int room = std::max(1, static_cast<int>((to_.x - from_.x) / (3.5f * ImGui::GetFontSize())));
        const float min_step = axes_.whole_x ? 1.0f : 0.0f;
        const float step = std::max(min_step, tick_step(most_x_, room));
        for (float value = 0.0f; value <= most_x_ * 1.0001f; value += step) {
            list_->AddLine({x(value), from_.y}, {x(value), to_.y}, line);
            const std::string text = short_text(static_cast<double>(value), axes_.x_unit);
            const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
            list_->AddText(
                {std::min(x(value) - half, to_.x - 2.0f * half + 0.5f * ImGui::GetFontSize()), to_.y + 2.0f},
                dim(), text.c_str());
        }
        const float text_height = ImGui::GetFontSize();
        list_->AddText({from_.x, from_.y - 1.15f * text_height}, dim(), y_title().c_str());
        const float width = ImGui::CalcTextSize(axes_.x).x;
        list_->AddText({to_.x - width, to_.y + 2.0f + 1.1f * text_height}, dim(), axes_.x);
    }

    /// With the unit, where the marks do not have it.
    std::string y_title() const {
        return logarithmic() || *axes_.y_unit == '\0' ? axes_.y : std::string(axes_.y) + ", " + axes_.y_unit;
    }

    void dashed(float at) {
        const float dash = 0.3f * ImGui::GetFontSize();
        for (float from = from_.x; from < to_.x; from += 2.0f * dash) {
            list_->AddLine({from, at}, {std::min(from + dash, to_.x), at}, dim());
        }
    }

    void line(const Curve& curve) {
        const ImU32 colour = colour_of(curve.colour);
        std::vector<ImVec2> points;
        for (const glm::vec2 p : curve.points) points.push_back({x(p.x), y(p.y)});
        if (points.size() > 1) {
            list_->AddPolyline(points.data(), static_cast<int>(points.size()), colour, ImDrawFlags_None,
                               0.13f * ImGui::GetFontSize());
        }
        if (points.size() > 60) points = {points.back()};  // so many marks would make one thick line
        for (const ImVec2 p : points) list_->AddCircleFilled(p, 0.17f * ImGui::GetFontSize(), colour);
    }

    std::span<const Curve> curves_;
    const PlotAxes& axes_;
    ImDrawList* list_;
    ImVec2 from_{}, to_{};
    float most_x_ = 0.0f, low_ = 0.0f, high_ = 1.0f;
};

}  // namespace

void plot(const char* id, std::span<const Curve> curves, const PlotAxes& axes, float height) {
    ImGui::PushFont(small_font());
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(80.0f, ImGui::GetContentRegionAvail().x), height * ImGui::GetFontSize()};
    ImGui::InvisibleButton(id, size);
    const bool hovered = ImGui::IsItemHovered();
    Plot drawing(curves, axes, at, size);
    drawing.draw();
    if (hovered) drawing.tell(ImGui::GetIO().MousePos);
    ImGui::PopFont();
}

void colour_mark(glm::vec3 colour) {
    const float side = 0.6f * ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5f * (ImGui::GetFrameHeight() - side);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side}, colour_of(colour),
                                              0.2f * side);
    ImGui::Dummy({side, ImGui::GetFrameHeight()});
    ImGui::SameLine();
}

}  // namespace tendril::app
