// A tooltip hides nothing that the mouse goes to next: it is beside the panel, bar or sheet that it is about.
#include <gtest/gtest.h>
#include <imgui_internal.h>  // the item under the mouse, and the windows

#include <algorithm>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "tests/app/support/frame_record.hpp"

namespace tendril::test {
namespace {

using namespace app;

Rect rect_of(const ImGuiWindow& window) {
    return {{window.Pos.x, window.Pos.y}, {window.Pos.x + window.Size.x, window.Pos.y + window.Size.y}};
}

bool meet(const Rect& a, const Rect& b) {
    constexpr float slack = 1.5f;
    return std::min(a.max.x, b.max.x) - std::max(a.min.x, b.min.x) > slack &&
           std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y) > slack;
}

const ImGuiWindow* shown_tooltip() {
    const ImGuiWindow* found = nullptr;
    for (const ImGuiWindow* const each : ImGui::GetCurrentContext()->Windows)
        if (each->Active && !each->Hidden && (each->Flags & ImGuiWindowFlags_Tooltip) != 0) found = each;
    return found;
}

class TooltipPlaces : public testing::TestWithParam<const char*> {
  protected:
    void open(glm::ivec2 size, double text_scale) {
        window_ = open_offscreen(size);
        app_ = std::make_unique<App>(*window_);
        size_ = size;
        app_->run({"lab.open", Json{{"name", GetParam()}}});
        app_->run({"view.text_scale", Json{{"scale", text_scale}}});
        app_->run({"view.fold", Json{{"section", GetParam()}, {"folded", false}}});  // all of its sections
        for (int i = 0; i < 60; ++i) app_->tick(nullptr);
        app_->run({"time.pause", Json::object()});
        app_->settle();
    }
    /// Moves the mouse to each item that is shown.
    void look() {
        std::vector<glm::vec2> places;
        for (const DrawnItem& item : recorder_.frame().items) {
            const ImRect& seen = item.window->InnerClipRect;
            const Rect part{{std::max(item.box.min.x, seen.Min.x), std::max(item.box.min.y, seen.Min.y)},
                            {std::min(item.box.max.x, seen.Max.x), std::min(item.box.max.y, seen.Max.y)}};
            if (part.size().x < 1.0f || part.size().y < 1.0f) continue;
            for (const float share : {0.3f, 0.7f})  // the halves of a plot
                places.push_back({part.min.x + share * part.size().x, part.centre().y});
        }
        for (const glm::vec2 place : places) {
            const Event move = MouseMove{place};
            app_->tick(&move);
            for (int i = 0; i < 2; ++i) app_->tick(nullptr);
            if (const ImGuiWindow* const told = shown_tooltip()) check(rect_of(*told), place);
        }
    }
    void check(const Rect& tooltip, glm::vec2 mouse) {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        ASSERT_NE(context.HoveredWindow, nullptr);
        const ImGuiWindow& root = *context.HoveredWindow->RootWindow;
        const std::string where = std::string(GetParam()) + ", " + root.Name + " at " +
                                  std::to_string(mouse.x) + ", " + std::to_string(mouse.y) + " of " +
                                  std::to_string(size_.x);
        ++seen_;
        const glm::vec2 size(size_);
        EXPECT_TRUE(tooltip.min.x >= 0.0f && tooltip.min.y >= 0.0f && tooltip.max.x <= size.x &&
                    tooltip.max.y <= size.y)
            << "is beyond the window: " << where;
        const std::string name = root.Name;
        if (name != "canvas" && !name.starts_with("axis ")) {
            EXPECT_FALSE(meet(tooltip, rect_of(root))) << "lies on its panel: " << where;
            return;
        }
        EXPECT_FALSE(tooltip.contains(mouse)) << "lies under the mouse: " << where;
        const float plot = 6.0f * ImGui::GetFontSize();  // its tooltip is in its corner
        for (const DrawnItem& item : recorder_.frame().items)
            if (item.id == context.HoveredId && item.box.size().y < plot) {
                EXPECT_FALSE(meet(tooltip, item.box)) << "lies on its item: " << where;
            }
    }

    FrameRecorder recorder_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<App> app_;
    glm::ivec2 size_{0};
    int seen_ = 0;
};

TEST_P(TooltipPlaces, HideNothingOfWhatTheyAreAbout) {
    open({1280, 720}, 1.0);
    look();
    app_->run({"view.settings", Json{{"open", true}}});
    app_->settle();
    look();
    EXPECT_GT(seen_, 60);
}

TEST_P(TooltipPlaces, HideNothingBesideLargeText) {
    open({1024, 640}, 1.5);
    look();
    EXPECT_GT(seen_, 20);
}

INSTANTIATE_TEST_SUITE_P(Labs, TooltipPlaces,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return std::string(lab.param); });

}  // namespace
}  // namespace tendril::test
