#include "app/widgets/timeline.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tendril::app {
namespace {

/// The smallest of 0.1, 0.2, 0.5, 1, 2, 5, ... seconds whose marks lie at least `apart` pixels from each
/// other.
double mark_seconds(double seconds_per_pixel, double apart) {
    const double least = seconds_per_pixel * apart;
    double step = std::pow(10.0, std::floor(std::log10(std::max(least, 1e-3))));
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        if (step * factor >= least) return step * factor;
    }
    return step * 10.0;
}

}  // namespace

bool timeline(const char* id, int& tick, int ticks, double seconds) {
    const float height = 1.9f * ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(40.0f, ImGui::GetContentRegionAvail().x);
    ImGui::InvisibleButton(id, {width, height});
    const float margin = 0.5f * ImGui::GetTextLineHeight();
    const float from = at.x + margin, span = width - 2.0f * margin;

    bool moved = false;
    if (ImGui::IsItemActive()) {
        const float share = std::clamp((ImGui::GetIO().MousePos.x - from) / span, 0.0f, 1.0f);
        const int wanted =
            std::min(static_cast<int>(std::lround(share * static_cast<float>(ticks))), ticks - 1);
        moved = wanted != tick;
        tick = wanted;
    }

    ImDrawList* list = ImGui::GetWindowDrawList();
    const float unit = ImGui::GetFontSize() / 15.0f;  // pixels, at the size that the text has
    const float base = at.y + height - 3.0f * unit;
    const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    list->AddLine({from, base}, {from + span, base}, ImGui::GetColorU32(ImGuiCol_Border), 2.0f * unit);
    const double whole = ticks * seconds;
    const double step = mark_seconds(whole / static_cast<double>(span), 60.0 * static_cast<double>(unit));
    for (double t = 0.0; t <= whole + 1e-9; t += step) {
        const float x = from + span * static_cast<float>(t / whole);
        list->AddLine({x, base - 5.0f * unit}, {x, base}, dim);
        char text[16];
        std::snprintf(text, sizeof text, "%.3g s", t);
        const float half = 0.5f * ImGui::CalcTextSize(text).x;
        list->AddText({std::clamp(x - half, at.x, at.x + width - 2.0f * half), at.y}, dim, text);
    }
    const float head = from + span * static_cast<float>(tick) / static_cast<float>(ticks);
    const ImU32 accent = ImGui::GetColorU32(ImGuiCol_CheckMark);
    list->AddLine({from, base}, {head, base}, accent, 2.0f * unit);
    const float radius = ImGui::IsItemHovered() || ImGui::IsItemActive() ? 6.0f : 5.0f;
    list->AddCircleFilled({head, base - unit}, radius * unit, accent, 20);
    return moved;
}

}  // namespace tendril::app
