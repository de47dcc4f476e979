// Every lab, at three window sizes and three text sizes: no text is cut off, nothing overlaps, and everything
// that can be clicked can be reached.
#include <imgui_internal.h>  // scrolling windows from outside, and listing them

#include "app/widgets/fonts.hpp"
#include "tests/app/support/driven_app.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/app/support/layout_faults.hpp"

namespace tendril::test {
namespace {

using namespace app;

constexpr glm::ivec2 sizes[] = {{1024, 640}, {1280, 720}, {2560, 1440}};
constexpr float scales[] = {1.0f, 1.5f, 2.0f};

/// Titles that end in "..." because a question follows.
bool means_dots(const std::string& text) {
    return text == "Save..." || text == "Open..." || text == "Save as..." || text == "Open ..." ||
           text.ends_with(" ...");
}

class LayoutTest : public testing::TestWithParam<std::string>, protected DrivenApp {
  protected:
    LayoutTest() : DrivenApp(sizes[0]) {}

    const Lab& lab() const { return *app_.labs().find(GetParam()); }

    void set_up(const Shown& scene) {
        run("scene.new");
        run("lab.open", {{"name", GetParam()}});
        for (const CommandCall& command : scene.commands) run(command.name, to_json(command.arguments));
        run("view.fold", {{"section", GetParam()}, {"folded", false}});  // all of its sections
        run("time.play");
        wait(scene.ticks);
        run("time.pause");
        workspace().ui.toasts.clear();
        scene_ = scene.name;
    }
    void resize(glm::ivec2 size) {
        take(Resize{size});
        size_ = size;
        leave();
    }
    /// Moves the mouse to the corner, where nothing is.
    void leave() { take(MouseMove{{2.0f, static_cast<float>(size_.y) - 2.0f}}); }
    void set_scale(float scale) {
        run("view.text_scale", {{"scale", scale}});
        scale_ = scale;
    }
    Layout layout() {
        return lay_out(size_, scale_, workspace().settings, lab().timeline_height(workspace()),
                       lab().canvas_share(workspace()));
    }

    void note(const std::vector<LayoutFault>& faults) {
        for (const LayoutFault& fault : faults) {
            std::string key = fault.message();
            key.erase(std::remove_if(key.begin(), key.end(), [](unsigned char c) { return std::isdigit(c); }),
                      key.end());
            Found& found = found_[key];
            if (found.first.empty()) found.first = fault.message() + " (" + scene_ + ")";
            found.where.insert({size_.x, scale_});
        }
    }

    /// Scrolls all windows down by `step` steps. False once the last has reached its end.
    static bool scroll_to(int step) {
        bool more = step == 0;
        for (ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
            if (!window->WasActive || window->ScrollMax.y <= 0.0f) continue;
            const float page = 0.7f * window->InnerRect.GetHeight();
            more |= page * static_cast<float>(step - 1) < window->ScrollMax.y;
            window->Scroll.y = std::min(window->ScrollMax.y, page * static_cast<float>(step));
        }
        return more;
    }
    /// Checks everything that the window shows now, and what scrolling reveals.
    void look() {
        for (int step = 0; scroll_to(step); ++step) {
            app_.settle();
            const FrameRecord frame = recorder_.frame();
            note(cut_texts(frame));
            std::vector<const DrawnText*> elided;
            note(elided_texts(frame, means_dots, elided));
            if (step == 0) look_at_places(frame);
            note(overlaps(frame));
            note(tight_buttons(frame));
            for (const DrawnText* text : elided) require_tooltip(*text);
        }
        scroll_to(0);
    }
    void look_at_places(const FrameRecord& frame) {
        note(out_of_reach(frame, size_));
        const Layout parts = layout();
        const float middle = parts.view.max.x - parts.canvas.min.x;
        if (middle < static_cast<float>(size_.x) / 3.0f)
            note({{"is narrower than a third of the window", "window", "the 3D view"}});
        note(covered(shell_parts(frame)));
        note_beneath_panels(frame);
    }
    /// Items on the scene but outside its rectangle are hidden by a panel.
    void note_beneath_panels(const FrameRecord& frame) {
        const Rect view = layout().view;
        for (const DrawnText& text : frame.texts) {
            if (text.window != nullptr) continue;
            if (text.box.min.x < view.min.x || text.box.max.x > view.max.x || text.box.min.y < view.min.y ||
                text.box.max.y > view.max.y)
                note({{"is hidden beneath a panel", "scene", text.text}});
        }
    }
    std::vector<ShellPart> shell_parts(const FrameRecord& frame) {
        std::map<std::string, Rect> boxes;
        const auto add = [&](const std::string& name, const Rect& box) {
            const auto [at, is_new] = boxes.try_emplace(name, box);
            at->second = {glm::min(at->second.min, box.min), glm::max(at->second.max, box.max)};
        };
        for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
            if (!window->Active || window->Hidden || window->IsFallbackWindow) continue;
            const std::string name = window_name(window);
            // These may cover others: sheets, which have a title, popups, and the palette.
            if ((window->Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip)) != 0) continue;
            if ((window->Flags & ImGuiWindowFlags_NoTitleBar) == 0 || name.starts_with("palette")) continue;
            const ImRect rect = window->Rect();
            const Rect box{{rect.Min.x, rect.Min.y}, {rect.Max.x, rect.Max.y}};
            const bool panel = name == "left" || name == "right";  // its card and its content are checked
            const bool child = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0;
            const bool of_panel =
                child && (name == "left/content" || name == "right/content" || name == "right/card");
            if (panel || (child && !of_panel)) continue;
            // A toast covers the panels if the view is too narrow to read it in.
            if (name.starts_with("toast") && view_is_narrower_than_a_toast()) continue;
            add(name.starts_with("axis ") ? "axis gizmo" : name, box);
        }
        const std::vector<LegendRow> legend = lab().legend(workspace());
        for (const DrawnText& text : frame.texts) {
            if (text.window != nullptr) continue;
            const bool row = std::any_of(legend.begin(), legend.end(),
                                         [&](const LegendRow& each) { return each.name == text.text; });
            const std::string invitation = lab().invitation(workspace());
            // A label on the scene may have the same text.
            const bool in_column = std::abs(text.box.min.x - layout().view.min.x - 30.0f * scale_) < 1.0f;
            if (row && in_column) add("legend", {{layout().view.min.x, text.box.min.y}, text.box.max});
            if (!invitation.empty() && text.text.starts_with(invitation)) add("first hint", text.box);
            if (text.text == "Perspective" || text.text == "Orthographic") add("axis gizmo", text.box);
        }
        std::vector<ShellPart> parts;
        for (const auto& [name, box] : boxes) parts.push_back({name, box});
        return parts;
    }
    bool view_is_narrower_than_a_toast() { return layout().view.size().x < 412.0f * scale_; }

    /// The tooltip must show the whole text.
    void require_tooltip(const DrawnText& text) {
        const std::string kept = text.text.substr(0, text.text.size() - 3);
        if (!asked_.insert(window_name(text.window) + kept).second) return;
        const Rect seen{glm::max(text.box.min, text.clip.min), glm::min(text.box.max, text.clip.max)};
        take(MouseMove{seen.centre()});
        app_.settle();
        bool told = false;
        for (const DrawnText& each : recorder_.frame().texts)
            told |= each.window != nullptr && (each.window->Flags & ImGuiWindowFlags_Tooltip) != 0 &&
                    each.text.find(kept) != each.text.npos;
        if (!told)
            note({{"is cut short, and no tooltip has all of it", window_name(text.window), text.text}});
        leave();
    }

    void look_at_panels() {
        look_at_shown_panels();
        if (!layout().one_panel) return;
        run("view.panels", {{"left", false}, {"right", true}});
        look_at_shown_panels();
        run("view.panels", {{"left", true}, {"right", true}});
    }
    void look_at_shown_panels() {
        look();
        if (size_ == sizes[0]) look_at_lists();
    }
    /// Opens the list of each field, once for each text size: lists do not depend on the window's size.
    void look_at_lists() {
        for (int step = 0; scroll_to(step); ++step) {
            app_.settle();
            std::vector<DrawnItem> lists;
            for (const DrawnItem& item : recorder_.frame().items)
                if (item.kind == DrawnItem::Kind::Combo && visible(item) &&
                    opened_.insert({item.id, scale_}).second)
                    lists.push_back(item);
            for (const DrawnItem& item : lists) {
                scroll_to(step);
                app_.settle();
                look_behind(item.box.centre());
            }
        }
        scroll_to(0);
    }
    static bool visible(const DrawnItem& item) {
        const ImRect& room = item.window->InnerClipRect;
        return room.Contains({item.box.min.x, item.box.min.y}) &&
               room.Contains({item.box.max.x, item.box.max.y});
    }
    /// Opens each sheet in turn.
    void look_at_sheets() {
        for (const char* command : {"view.settings", "view.help", "view.palette"}) {
            run(command, {{"open", true}});
            look();
            run(command, {{"open", false}});
        }
        run("view.palette", {{"open", true}});
        type("chain.add length=nothing");
        key("enter");
        look();
        run("view.palette", {{"open", false}});
        for (const char* command : {"scene.open_dialog", "scene.save_dialog"}) {
            run(command);
            look();
            run("view.close");
        }
        workspace().ui.asks_to_quit = true;
        look();
        workspace().ui.asks_to_quit = false;
        workspace().ui.recoverable = {
            {"a scene with a name that is not short.json, 23 November, 13:45", "x.json"}};
        look();
        workspace().ui.recoverable.clear();
        workspace().toast("Written");
        EXPECT_THROW(run("time.speed", {{"factor", 1e9}}), Refused);
        workspace().toast(
            "A sentence that is as long as what is said about a file that cannot be read: at line 12, "
            "the joint \"LeftHandIndexFinger\" has no parent");
        look();
        workspace().ui.toasts.clear();
    }
    /// Opens the menu, and the list of labs if there is one.
    void look_at_bar() {
        app_.settle();
        const FrameRecord frame = recorder_.frame();
        const auto menu = std::find_if(frame.items.begin(), frame.items.end(), [](const DrawnItem& item) {
            return window_name(item.window) == "top";
        });
        ASSERT_NE(menu, frame.items.end());
        look_behind(menu->box.centre());
        for (const DrawnText& text : frame.texts)
            if (window_name(text.window) == "top" && text.text.ends_with(" ..."))
                look_behind(text.box.centre());
    }
    /// Checks what a click there opens.
    void look_behind(glm::vec2 at) {
        click(at);
        app_.settle();
        ++popups_;
        look();
        key("escape");
        leave();
    }

    void report() const {
        for (const auto& [key, found] : found_) {
            std::string where;
            for (const auto& [width, scale] : found.where) {
                char text[32];
                std::snprintf(text, sizeof text, " %d@%.1f", width, static_cast<double>(scale));
                where += text;
            }
            ADD_FAILURE() << GetParam() << ", window width@text scale" << where << "; " << found.first;
        }
    }

    struct Found {
        std::string first;
        std::set<std::pair<int, float>> where;
    };
    glm::ivec2 size_{0};
    int popups_ = 0;  ///< popups that were checked
    float scale_ = 1.0f;
    std::string scene_;
    std::map<std::string, Found> found_;
    std::set<std::string> asked_;
    std::set<std::pair<unsigned, float>> opened_;
};

/// The first scene at every size; each other one in the smallest window with the largest text, and at one of
/// the other sizes in turn. At night every scene at every size.
bool is_looked_at(std::size_t scene, glm::ivec2 size, float scale) {
    const auto window = std::ranges::find(sizes, size) - std::begin(sizes);
    const auto text = std::ranges::find(scales, scale) - std::begin(scales);
    if (test::is_thorough() || scene == 0 || (window == 0 && text == 2)) return true;
    const std::size_t other = static_cast<std::size_t>(window == 0 ? 0 : 1 + 3 * (window - 1) + text);
    return other == scene % 7;
}

LABEL(slow, "Labs/LayoutTest.CutsNothingAndOverlapsNothing/*");

TEST_P(LayoutTest, CutsNothingAndOverlapsNothing) {
    std::size_t texts = 0;
    const std::vector<Shown> scenes = all_scenes(lab());
    for (const float scale : scales) {
        set_scale(scale);
        for (std::size_t number = 0; number < scenes.size(); ++number) {
            const Shown& scene = scenes[number];
            if (std::ranges::none_of(sizes,
                                     [&](glm::ivec2 size) { return is_looked_at(number, size, scale); }))
                continue;
            set_up(scene);
            run("view.card", {{"open", false}});
            for (const glm::ivec2 size : sizes) {
                if (!is_looked_at(number, size, scale)) continue;
                resize(size);
                look_at_panels();
                texts += recorder_.frame().texts.size();
                if (scene.name != "as it opens") continue;
                run("view.card", {{"open", true}});
                look_at_panels();
                look_at_sheets();
                look_at_bar();
                run("view.card", {{"open", false}});
            }
        }
    }
    EXPECT_GT(texts, 1000u) << "what is drawn is recorded";
    EXPECT_GT(popups_, 0) << "lists were opened";
    RecordProperty("popups", popups_);
    report();
}

/// Makes letters wider by `factor`, as a translation makes words longer. Numbers keep their width.
void stretch_letters(float factor) {
    const auto is_letter = [](unsigned c) { return c < 128 && std::isalpha(static_cast<int>(c)) != 0; };
    for (ImFont* font : ImGui::GetIO().Fonts->Fonts) {
        for (ImFontGlyph& glyph : font->Glyphs)
            if (is_letter(glyph.Codepoint)) glyph.AdvanceX *= factor;
        for (int c = 0; c < font->IndexAdvanceX.Size; ++c)
            if (is_letter(static_cast<unsigned>(c))) font->IndexAdvanceX[c] *= factor;
    }
}

TEST_P(LayoutTest, FitsTextsThatAreAThirdLonger) {
    set_scale(1.0f);
    for (const Shown& scene : all_scenes(lab())) {
        set_up(scene);
        run("view.card", {{"open", scene.name == "as it opens"}});
        resize({1280, 720});
        if (scene.name == "as it opens") stretch_letters(4.0f / 3.0f);
        look_at_panels();
    }
    // Proper names and units, which no translation makes longer.
    std::erase_if(found_, [](const auto& found) {
        return found.first.find("SVD damped least squares") != found.first.npos ||
               found.first.find("content/joints") != found.first.npos;
    });
    report();
}

INSTANTIATE_TEST_SUITE_P(Labs, LayoutTest, testing::ValuesIn(names_of_labs()),
                         [](const auto& lab) { return lab.param; });

}  // namespace
}  // namespace tendril::test
