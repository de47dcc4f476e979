#include "app/widgets/timeline.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

#include "app/widgets/plot.hpp"

namespace tendril::app {
namespace {

/// The smallest of 1, 2, 5, 10, 20, ... that is at least `min`.
std::size_t round_stride(float min) {
    for (std::size_t decade = 1;; decade *= 10) {
        for (const std::size_t factor : {1u, 2u, 5u})
            if (!(static_cast<float>(decade * factor) < min)) return decade * factor;
    }
}

/// The strip: its line, its head, and its mouse handling.
class Strip {
  public:
    explicit Strip(const char* id) : list_(ImGui::GetWindowDrawList()) {
        height_ = 1.9f * ImGui::GetTextLineHeight();
        at_ = ImGui::GetCursorScreenPos();
        width_ = std::max(40.0f, ImGui::GetContentRegionAvail().x);
        ImGui::InvisibleButton(id, {width_, height_});
        const float margin = 0.5f * ImGui::GetTextLineHeight();
        from_ = at_.x + margin;
        span_ = width_ - 2.0f * margin;
        base_ = at_.y + height_ - 3.0f * unit();
        list_->AddLine({from_, base_}, {from_ + span_, base_}, ImGui::GetColorU32(ImGuiCol_Border),
                       2.0f * unit());
    }

    float left() const { return from_; }
    float span() const { return span_; }
    static float unit() { return ImGui::GetFontSize() / 15.0f; }  ///< a pixel at the current text size

    /// The position, 0 to 1, that the head is dragged to; negative if it is not dragged.
    float dragged() const {
        if (!ImGui::IsItemActive()) return -1.0f;
        return std::clamp((ImGui::GetIO().MousePos.x - from_) / span_, 0.0f, 1.0f);
    }
    /// Omits the text if it would overlap the previous one.
    void mark(float share, const char* text) {
        const float x = from_ + span_ * share;
        const ImU32 dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
        list_->AddLine({x, base_ - 5.0f * unit()}, {x, base_}, dim);
        if (text == nullptr) return;
        const float wide = ImGui::CalcTextSize(text).x;
        const float left = std::max(at_.x, std::min(x - 0.5f * wide, at_.x + width_ - wide));
        if (left < free_from_) return;
        list_->AddText({left, at_.y}, dim, text);
        free_from_ = left + wide + 6.0f * unit();
    }
    void head(float share) { played(0.0f, share, share); }
    /// Draws the line from `begin` to the head at `share`, then faintly up to `known`.
    void played(float begin, float share, float known) {
        const float x = from_ + span_ * share;
        const ImU32 accent = ImGui::GetColorU32(ImGuiCol_CheckMark);
        if (known > share)
            list_->AddLine({x, base_}, {from_ + span_ * known, base_},
                           ImGui::GetColorU32(ImGuiCol_CheckMark, 0.45f), 2.0f * unit());
        list_->AddLine({from_ + span_ * begin, base_}, {x, base_}, accent, 2.0f * unit());
        const float radius = ImGui::IsItemHovered() || ImGui::IsItemActive() ? 6.0f : 5.0f;
        list_->AddCircleFilled({x, base_ - unit()}, radius * unit(), accent, 20);
    }

    /// The mouse's position on the strip, 0 to 1; negative if it is elsewhere.
    float hovered() const {
        if (!ImGui::IsItemHovered()) return -1.0f;
        return std::clamp((ImGui::GetIO().MousePos.x - from_) / span_, 0.0f, 1.0f);
    }
    void diamond(float share, const TimeMark& mark, bool hot) {
        const float x = from_ + span_ * share, y = base_ - 7.0f * unit();
        const float radius = ((mark.large ? 4.8f : 2.8f) + (hot ? 1.2f : 0.0f)) * unit();
        const ImU32 colour = ImGui::GetColorU32({mark.colour.r, mark.colour.g, mark.colour.b, 1.0f});
        list_->AddLine({x, y}, {x, base_}, colour, unit());
        list_->AddQuadFilled({x, y - radius}, {x + radius, y}, {x, y + radius}, {x - radius, y}, colour);
    }
    /// Pixels from a position to the mouse.
    float from_mouse(float share) const {
        return std::abs(ImGui::GetIO().MousePos.x - (from_ + span_ * share));
    }
    void bar(float from, float to, const TimeBar& bar) {
        const float left = from_ + span_ * from, high = (2.0f + 8.0f * bar.height) * unit();
        const float right = std::max(left + 1.0f, from_ + span_ * to);
        list_->AddRectFilled({left, base_ - high}, {right, base_},
                             ImGui::GetColorU32({bar.colour.r, bar.colour.g, bar.colour.b, 1.0f}));
    }
    /// A flag at the earliest time that the head can reach.
    void flag(float share) {
        const float x = from_ + span_ * share, top = base_ - 11.0f * unit();
        const ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text);
        list_->AddLine({x, top}, {x, base_ + 2.0f * unit()}, colour, unit());
        list_->AddTriangleFilled({x, top}, {x + 6.0f * unit(), top + 3.0f * unit()}, {x, top + 6.0f * unit()},
                                 colour);
    }

  private:
    ImDrawList* list_;
    ImVec2 at_{};
    float height_, width_, from_, span_, base_;
    float free_from_ = -1e9f;  ///< the next text may begin here
};

/// The mark under the mouse: a large one before others, then the nearest; -1 if there is none.
int mark_under(const Strip& strip, const std::vector<TimeMark>& marks, float whole) {
    const float close = 7.0f * Strip::unit();
    int found = -1;
    float best = 0.0f;
    for (std::size_t i = 0; i < marks.size(); ++i) {
        const float away = strip.from_mouse(static_cast<float>(marks[i].at) / whole);
        if (away > close) continue;
        const float counts = away + (marks[i].large ? 0.0f : close);
        if (found >= 0 && counts >= best) continue;
        best = counts;
        found = static_cast<int>(i);
    }
    return found;
}

}  // namespace

bool step_timeline(const char* id, int& step, const std::vector<int>& ends) {
    Strip strip(id);
    const int last = std::max(1, ends.empty() ? 0 : ends.back());
    const int before = step;
    if (const float share = strip.dragged(); share >= 0.0f) {
        step = static_cast<int>(std::lround(share * static_cast<float>(last)));
        if (ends.empty() || ends.back() == 0) step = 0;
    }
    // A mark at each iteration's end, numbered where there is room. Among many iterations only every second,
    // fifth, tenth, ... is marked or numbered, so that marks and numbers do not run together.
    const float apart = strip.span() / std::max(1.0f, static_cast<float>(ends.size()) - 1.0f);
    const std::size_t marked = round_stride(4.0f * Strip::unit() / apart),
                      numbered = round_stride(60.0f * Strip::unit() / apart);
    for (std::size_t i = 0; i < ends.size(); i += marked) {
        const float share = static_cast<float>(ends[i]) / static_cast<float>(last);
        char text[32];
        std::snprintf(text, sizeof text, i == 0 ? "start" : "iteration %zu", i);
        const bool empty = i > 0 && ends[i] == ends[i - 1];
        strip.mark(share, empty || i % numbered != 0 ? nullptr : text);
    }
    strip.head(static_cast<float>(step) / static_cast<float>(last));
    return step != before;
}

TimeStripUse time_strip(const char* id, int& tick, const TimeStrip& content) {
    Strip strip(id);
    const float whole = static_cast<float>(std::max(1, content.ticks));
    const auto share = [&](int at) { return static_cast<float>(at) / whole; };
    const auto tick_at = [&](float part) { return static_cast<int>(std::lround(part * whole)); };
    const int before = tick;
    TimeStripUse use{.left = strip.left(), .right = strip.left() + strip.span()};
    // A click on a mark does not move the head.
    const ImGuiID held = ImGui::GetID((std::string(id) + " mark").c_str());
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    if (strip.hovered() >= 0.0f) use.on_mark = mark_under(strip, content.marks, whole);
    use.mark_clicked = ImGui::IsItemActivated() && use.on_mark >= 0;
    if (use.mark_clicked || !ImGui::IsItemActive()) kept.SetBool(held, use.mark_clicked);
    if (const float part = strip.dragged(); part >= 0.0f && !kept.GetBool(held))
        tick = std::max(tick_at(part), content.start);
    for (std::size_t i = 0; i < content.bars.size(); ++i) {
        const int at = content.bars_from + static_cast<int>(i);
        if (at >= 0 && at <= content.ticks)
            strip.bar(share(at) - 0.5f / whole, share(at) + 0.5f / whole, content.bars[i]);
    }
    // The captions are at least 60 pixels apart. In a tiny window the strip has no width.
    const double pixels = std::max(static_cast<double>(strip.span()), 1.0);
    const double step =
        axis_step(60.0 * static_cast<double>(Strip::unit()) * content.ticks * content.seconds / pixels);
    const double last = content.first_seconds + content.ticks * content.seconds;
    for (double t = step * std::ceil(content.first_seconds / step - 1e-9); t <= last + 1e-9; t += step) {
        const std::string text = axis_text(t, step, std::max(last, 1.0), "s");
        strip.mark(static_cast<float>((t - content.first_seconds) / content.seconds) / whole, text.c_str());
    }
    strip.played(share(content.start), share(tick), share(std::max(tick, content.known)));
    if (content.start > 0) strip.flag(share(content.start));
    for (std::size_t i = 0; i < content.marks.size(); ++i)
        strip.diamond(share(content.marks[i].at), content.marks[i], use.on_mark == static_cast<int>(i));
    const float over = strip.hovered();
    use.moved = tick != before;
    use.hovered = over < 0.0f ? -1 : tick_at(over);
    return use;
}

}  // namespace tendril::app
