// Every widget of every panel has its own id and a tooltip, works when clicked, and stays under the mouse
// that clicks it. The widgets are taken from the frames themselves, so that new ones are included. Not
// clicked: plots, curves and other areas to draw in, which have their own tests.
#include <imgui_internal.h>  // the item under the mouse, open lists, scrolling

#include <glm/common.hpp>

#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "tests/app/support/driven_app.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/app/support/layout_faults.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using namespace app;
using Kind = DrawnItem::Kind;

constexpr glm::ivec2 panel_window{1280, 6000};     ///< every panel fits without scrolling
constexpr glm::vec2 in_the_scene{640.0f, 700.0f};  ///< in the scene
constexpr const char* clicked_labs[] = {"chain", "rope", "signal", "rig", "humanoid", "linkage"};
const auto of_lab = [](const auto& lab) { return std::string(lab.param); };

/// A switch may have different text, of different width, after a click.
bool same_place(const DrawnItem& a, const DrawnItem& b) {
    return std::abs(a.box.min.x - b.box.min.x) < 3.0f && std::abs(a.box.min.y - b.box.min.y) < 3.0f;
}

class Panels : public testing::TestWithParam<const char*>, protected DrivenApp {
  protected:
    Panels() : DrivenApp(panel_window) {}

    void ticks(int count) {
        for (int i = 0; i < count; ++i) tick(nullptr);
    }
    void tick(const Event* event) {
        app_.tick(event);
        for (const std::string& pair : frame().alike())
            if (told_.insert(pair).second)
                ADD_FAILURE() << GetParam() << ", " << scene_ << ": one id: " << pair;
    }
    void move(glm::vec2 to) {
        const Event moved = MouseMove{to};
        tick(&moved);
        ticks(1);
    }
    void press(bool down) {
        const Event pressed = MousePress{MouseButton::Left, down};
        tick(&pressed);
    }
    void click(glm::vec2 at) {
        move(at);
        press(true);
        press(false);
        ticks(3);
    }
    /// The scene, paused.
    void set_up(const std::vector<CommandCall>& commands, int run_for = 0, bool unfolded = false) {
        for (int i = 0; i < 2; ++i) key("escape");  // leaves a field and closes a list
        workspace().settings = settings_;
        workspace().ui.ends_filming = workspace().ui.filming.has_value();
        run("view.close");
        run("scene.new");
        run("lab.open", {{"name", GetParam()}});
        for (const CommandCall& command : commands) run(command.name, to_json(command.arguments));
        if (unfolded) run("view.fold", {{"section", GetParam()}, {"folded", false}});
        run("time.play");
        ticks(run_for);
        run("time.pause");
        workspace().ui.toasts.clear();
        move(in_the_scene);
        ticks(2);
    }
    const FrameRecord& frame() const { return recorder_.frame(); }

    const Settings settings_ = workspace().settings;
    std::string scene_;
    std::set<std::string> told_;
};

/// The check covers all calls of Dear ImGui, not only those of our own rows.
TEST(WidgetIds, DuplicatesAreFound) {
    const auto window = open_offscreen({400, 300});
    App app(*window);
    FrameRecorder recorder;
    app.tick(nullptr);
    EXPECT_TRUE(recorder.frame().alike().empty());
    ImGui::NewFrame();
    ImGui::Begin("two");
    bool on = false;
    ImGui::Checkbox("alike", &on);
    ImGui::SmallButton("other");
    ImGui::SmallButton("alike");
    for (const char* label : {"a", "b"}) {
        ImGui::BeginChild("child", {50.0f, 50.0f});
        ImGui::Button(label);
        ImGui::EndChild();
    }
    ImGui::End();
    ImGui::EndFrame();
    const std::vector<std::string> found = recorder.frame().alike();
    ASSERT_GE(found.size(), 2u);
    EXPECT_EQ(found[0], "\"alike\" in two and \"alike\" in two");
    EXPECT_TRUE(test::has(found.back(), "is begun twice"));
}

class PanelClicks : public Panels {
  protected:
    enum class Outcome { Nothing, Chosen, Greyed, Refused, Changed };  ///< Chosen: it was already

    static bool in_panels(const DrawnItem& item) {
        const std::string name = item.window->RootWindow->Name;
        return (name == "left" || name == "right" || name == "timeline") &&
               !FrameRecord::is_of_a_window(item);
    }
    static bool is_an_area(const DrawnItem& item) { return item.box.size().y >= 6.0f * ImGui::GetFontSize(); }
    std::vector<DrawnItem> list_rows() const {
        std::vector<DrawnItem> rows;
        std::ranges::copy_if(frame().items, std::back_inserter(rows), [](const DrawnItem& item) {
            return (item.window->RootWindow->Flags & ImGuiWindowFlags_Popup) != 0 && item.kind != Kind::Text;
        });
        return rows;
    }
    static bool list_is_open() { return !ImGui::GetCurrentContext()->OpenPopupStack.empty(); }
    static bool tooltip_is_shown() {
        return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [](const ImGuiWindow* each) {
            return each->Active && (each->Flags & ImGuiWindowFlags_Tooltip) != 0;
        });
    }
    /// Everything that a user sees with the mouse away, and that a script gets.
    std::string seen() {
        move(in_the_scene);
        ticks(2);
        std::size_t hash = 0;
        const auto add = [&](auto value) {
            hash = (hash ^ std::hash<decltype(value)>()(value)) * 1099511628211u;
        };
        const ImDrawData& drawn = *ImGui::GetDrawData();
        for (int i = 0; i < drawn.CmdListsCount; ++i)
            for (const ImDrawVert& each : drawn.CmdLists[i]->VtxBuffer)
                add(each.pos.x), add(each.pos.y), add(each.uv.x), add(each.uv.y), add(each.col);
        return std::to_string(hash) + window_->clipboard() + app_.state().dump();
    }
    bool was_refused() {
        return std::ranges::any_of(app_.workspace().ui.toasts,
                                   [](const Toast& each) { return each.kind == ToastKind::Refusal; });
    }
    /// A position on the item that no later item covers.
    glm::vec2 place_on(const DrawnItem& item) const {
        for (const float share : {0.5f, 0.1f, 0.9f, 0.3f, 0.7f}) {
            const glm::vec2 at{glm::mix(item.box.min.x, item.box.max.x, share), item.box.centre().y};
            const auto later = frame().items.begin() + (frame().find(item.id) - frame().items.data()) + 1;
            if (std::none_of(later, frame().items.end(), [&](const DrawnItem& other) {
                    return other.window == item.window && other.box.contains(at);
                }))
                return at;
        }
        return item.box.centre();
    }
    /// The text on the item, or left of it.
    std::string name_of(const DrawnItem& item) const {
        const glm::vec2 middle = item.box.centre();
        const DrawnText* nearest = nullptr;
        for (const DrawnText& text : frame().texts)
            if (text.window == item.window && text.box.min.y < middle.y && text.box.max.y > middle.y &&
                text.box.min.x < item.box.max.x &&
                (nearest == nullptr || text.box.min.x > nearest->box.min.x))
                nearest = &text;
        return scene_ + ": " + item.window->RootWindow->Name + " \"" + item.label + "\"" +
               (nearest != nullptr ? " (" + nearest->text + ")" : "");
    }
    void drag(glm::vec2 from, float by) {
        move(from);
        press(true);
        for (const float part : {0.5f, 1.0f}) move(from + glm::vec2(part * by, 0.0f));
        press(false);
        ticks(2);
    }
    /// No other button may be under the mouse after a click; false if one is.
    bool expect_steady(const DrawnItem& button, glm::vec2 at, const std::string& name, int clicks) {
        if (app_.workspace().lab != GetParam() || app_.workspace().ui.covered() || list_is_open())
            return false;
        for (const DrawnItem& each : frame().items)
            if (each.kind == Kind::Button && each.box.contains(at) && each.id != button.id &&
                !same_place(each, button)) {
                ADD_FAILURE() << name << ": after click " << clicks << " \"" << each.label
                              << "\" is under the mouse, " << each.box.min.y - button.box.min.y << " lower";
                return false;
            }
        return true;
    }
    /// Nor after two more. The mouse was away, so a row that waited for it to leave may have gone.
    void click_twice_more(const DrawnItem& clicked, const std::string& name) {
        const DrawnItem* const now = frame().find(clicked.id);
        if (now == nullptr) return;
        const DrawnItem button = *now;
        const glm::vec2 at = place_on(button);
        for (int clicks = 2; clicks < 4; ++clicks) {
            if (app_.workspace().lab != GetParam() || app_.workspace().ui.covered() || list_is_open()) return;
            click(at);
            if (!expect_steady(button, at, name, clicks)) return;
        }
    }
    /// An area has tooltips only in places.
    void expect_tooltip(const DrawnItem& item, glm::vec2 at) {
        const std::string name = name_of(item);
        move(at);
        EXPECT_EQ(ImGui::GetCurrentContext()->HoveredId, item.id) << name << " is not under the mouse";
        const glm::vec2 step = (item.box.max - item.box.min) / 20.0f;
        for (int i = 0; i < 400 && is_an_area(item) && !tooltip_is_shown(); ++i)
            move(item.box.min + step * (glm::vec2(i % 20, i / 20) + 0.5f));
        EXPECT_TRUE(tooltip_is_shown()) << name << " has no tooltip";
    }
    /// Items of a frame that were not yet examined.
    template <class Wanted>
    std::size_t expect_tooltips(const Wanted& wanted) {
        std::size_t found = 0;
        for (const DrawnItem& item : std::vector<DrawnItem>(frame().items)) {
            const glm::vec2 middle = item.box.centre();
            if (!wanted(item) || !item.window->InnerClipRect.Contains({middle.x, middle.y})) continue;
            ++found;
            if (looked_at_.insert(item.id).second) expect_tooltip(item, place_on(item));
        }
        return found;
    }
    /// `before` is what was seen before; `item` is in the present frame.
    Outcome try_item(const DrawnItem& item, const std::string& before) {
        const glm::vec2 at = place_on(item);
        const std::string name = name_of(item);
        opened_list_ = false;
        expect_tooltip(item, at);
        if (item.greyed) return Outcome::Greyed;
        if (is_an_area(item)) return Outcome::Changed;
        const std::vector<DrawnItem> options = chosen_options();
        if (item.kind == Kind::Number)
            drag(at, 60.0f);
        else
            click(at);
        if (item.kind == Kind::Text)
            return ImGui::GetIO().WantTextInput ? Outcome::Changed : Outcome::Nothing;
        opened_list_ = list_is_open();
        if (opened_list_) return Outcome::Changed;  // its rows are tried by themselves
        if (item.kind == Kind::Button) expect_steady(item, at, name, 1);
        if (was_refused()) return Outcome::Refused;
        if (const DrawnItem* const now = frame().find(item.id); item.on && now != nullptr) {
            EXPECT_EQ(now->on, item.kind == Kind::Button || !*item.on) << name << " stays as it was";
        }
        bool changed = seen() != before;
        if (item.kind == Kind::Button) try_replaced(options), click_twice_more(item, name);
        if (item.kind == Kind::Button || item.kind == Kind::Check)
            return changed ? Outcome::Changed : is_chosen(item) ? Outcome::Chosen : Outcome::Nothing;
        for (const float share : {-0.497f, 0.497f}) {  // it was at its end, or is a strip or an edge
            if (!changed) drag(at, share * std::max(item.box.size().x, 150.0f));
            changed = changed || seen() != before;
        }
        return changed ? Outcome::Changed : Outcome::Nothing;
    }
    static bool is_chosen(const DrawnItem& item) {
        return item.kind == Kind::Button && item.on.value_or(item.lit);
    }
    std::vector<DrawnItem> chosen_options() const {
        std::vector<DrawnItem> chosen;
        std::ranges::copy_if(frame().items, std::back_inserter(chosen),
                             [](const DrawnItem& item) { return in_panels(item) && is_chosen(item); });
        return chosen;
    }
    /// Chooses a previous choice again, which every scene may have.
    void try_replaced(const std::vector<DrawnItem>& before) {
        for (const DrawnItem& option : before) {
            const DrawnItem* now = frame().find(option.id);
            if (now == nullptr || is_chosen(*now)) continue;
            const std::string name = name_of(*now);
            if (!is_due(option.id, "", name)) continue;
            click(place_on(*now));
            now = frame().find(option.id);
            EXPECT_TRUE(now == nullptr || is_chosen(*now) || was_refused()) << name << " is not chosen again";
            note(option.id, "", Outcome::Changed);
        }
    }
    /// Clicks a row of the list that `opener` opens.
    Outcome try_row(const DrawnItem& opener, std::size_t which, bool chooses, const std::string& before) {
        click(place_on(*frame().find(opener.id)));
        if (list_rows().size() <= which) {
            ADD_FAILURE() << name_of(opener) << " does not open again";
            return Outcome::Nothing;
        }
        ImGuiWindow* const list = ImGui::FindWindowByName(list_rows().at(which).window->Name);
        list->Scroll.y = std::clamp(list_rows().at(which).box.min.y - list->Pos.y + list->Scroll.y, 0.0f,
                                    list->ScrollMax.y);
        ticks(1);
        const DrawnItem row = list_rows().at(which);
        const std::string name = name_of(opener) + ": " + row.label;
        click(row.box.centre());
        EXPECT_FALSE(list_is_open()) << name << " leaves the list open";
        if (was_refused()) return Outcome::Refused;
        const DrawnItem* const now = frame().find(opener.id);
        const bool was_chosen = chooses && opener.shown == row.label;
        if (chooses && now != nullptr && now->kind == Kind::Combo && !now->shown.ends_with("...")) {
            EXPECT_EQ(now->shown, row.label) << name;
        }
        return was_chosen || seen() != before ? Outcome::Changed : Outcome::Nothing;
    }
    /// By day every third widget and row is clicked, others with another TENDRIL_SEED; at night all are.
    bool is_of_this_run(std::size_t id) const { return is_thorough() || (id + seed_) % 3 == 0; }
    /// Whether it has not yet been seen to have an effect.
    bool is_due(unsigned id, const std::string& row, const std::string& name) {
        return tried_.try_emplace({id, row}, Tried{name}).first->second.outcome != Outcome::Changed;
    }
    void note(unsigned id, const std::string& row, Outcome outcome) {
        Outcome& best = tried_.at({id, row}).outcome;
        best = std::max(best, outcome);
    }
    /// Tries rows of the list that has just been opened.
    void try_rows(const Shown& scene, const DrawnItem& opener, const std::string& before) {
        const std::vector<DrawnItem> rows = list_rows();
        const bool chooses =
            std::ranges::any_of(rows, [&](const DrawnItem& row) { return row.label == opener.shown; });
        for (std::size_t i = 0; i < std::min(rows.size(), most_rows_); ++i) {
            const std::string name = name_of(opener) + ": " + rows[i].label;
            if (rows[i].greyed) {
                EXPECT_TRUE(test::has(rows[i].label, ": ")) << name << " is grey and does not say why";
                continue;
            }
            if (!is_of_this_run(rows[i].id) || !is_due(opener.id, rows[i].label, name)) continue;
            set_up(scene.commands, std::max(scene.ticks, 10), true);
            ASSERT_NE(frame().find(opener.id), nullptr) << name;
            note(opener.id, rows[i].label, try_row(opener, i, chooses, before));
        }
    }
    void try_scene(const Shown& scene) {
        scene_ = scene.name;
        set_up(scene.commands, std::max(scene.ticks, 10), true);
        expect_tooltips([](const DrawnItem& item) { return in_panels(item) && !is_an_area(item); });
        std::string before = seen();
        bool fresh = true;
        for (const DrawnItem& first : std::vector<DrawnItem>(frame().items)) {
            if (!in_panels(first) || !is_of_this_run(first.id) || !is_due(first.id, "", name_of(first)))
                continue;
            if (!std::exchange(fresh, true)) {
                set_up(scene.commands, std::max(scene.ticks, 10), true);
                before = seen();
            }
            const DrawnItem* const found = frame().find(first.id);
            if (found == nullptr) {  // belongs to the panel's own state: an earlier click has shown it
                tried_.erase({first.id, ""});
                continue;
            }
            const DrawnItem item = *found;
            const Outcome outcome = try_item(item, before);
            note(item.id, "", outcome);
            if (outcome == Outcome::Changed && opened_list_) try_rows(scene, item, before);
            fresh = outcome == Outcome::Greyed;
        }
    }

    std::vector<std::string> units() {
        std::vector<std::string> names;
        for (const UnitRow& row : unit_rows(rig_part(app_.workspace()))) names.push_back(row.unit->name);
        return names;
    }
    /// Tries one unit of each kind, and examines those of the presets.
    void try_units() {
        most_rows_ = 1;  // every list has the same elements
        for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
            Shown scene{rig::operation_name(i), bones_and_a_control()};
            scene.commands.push_back(call("rig.curve.add", {{"name", "curve"}}));
            scene.commands.push_back(call("rig.select", {{"element", "c"}}));
            set_up(scene.commands);
            const UnitOffer offer = offered_unit(rig_part(app_.workspace()), i);
            ASSERT_TRUE(offer.unit) << scene.name << " needs " << offer.needs;
            ArgumentList unit;
            for (const auto& [name, value] : (**offer.unit).items())
                unit.push_back({name, SharedJson(value)});
            scene.commands.push_back(call("rig.unit.add", unit));
            set_up(scene.commands);
            scene.commands.push_back(call("rig.select", {{"element", ""}, {"unit", units().back()}}));
            try_scene(scene);
        }
        for (const RigPreset& preset : rig_presets()) {
            set_up({call("rig.preset", {{"name", preset.name}})}, 3, true);
            scene_ = preset.name;
            for (const std::string& unit : units()) {
                run("rig.select", {{"element", ""}, {"unit", unit}});
                move(in_the_scene);
                expect_tooltips([](const DrawnItem& item) { return in_panels(item) && !is_an_area(item); });
            }
        }
    }

    struct Tried {
        std::string name;
        Outcome outcome = Outcome::Nothing;
    };
    const std::size_t seed_ = given_seed();
    bool opened_list_ = false;    ///< whether the last click opened one
    std::size_t most_rows_ = 16;  ///< of longer lists, such as a figure's nodes, the first are tried
    std::set<unsigned> looked_at_;
    std::map<std::pair<unsigned, std::string>, Tried> tried_;  ///< widgets, and the rows of their lists
    TempFolder folder_;
    WorkingIn in_folder_{folder_};
};

LABEL(slow, "Labs/PanelClicks.*");

TEST_P(PanelClicks, HaveTooltipsInTheBarAtFoldedPanelsAndInSheets) {
    const auto in = [](const std::string& window) {
        return [=](const DrawnItem& item) {
            return item.window->RootWindow->Name == window && !FrameRecord::is_of_a_window(item);
        };
    };
    const auto in_a_sheet = [](const DrawnItem& item) {
        const std::string_view name = item.window->RootWindow->Name;
        return !FrameRecord::is_of_a_window(item) && (name == "Settings" || name == "Record a video");
    };
    set_up(app_.labs().find(GetParam())->opening());
    EXPECT_GT(expect_tooltips(in("top")), 8u);
    for (const char* side : {"left", "right"}) run("view.panels", {{side, false}});
    ticks(3);
    EXPECT_EQ(expect_tooltips(in("left strip")) + expect_tooltips(in("right strip")), 2u);
    run("view.settings", {{"open", true}});
    ticks(3);
    EXPECT_GT(expect_tooltips(in_a_sheet), 4u);
    run("view.settings", {{"open", false}});
    app_.workspace().ui.file_dialog = UiState::FileDialog::Video;
    ticks(3);
    EXPECT_GT(expect_tooltips(in_a_sheet), 4u);
}

TEST_P(PanelClicks, UpdateTheirTextAndNothingMovesUnderTheMouse) {
    std::size_t changed = 0;
    for (const Shown& scene : all_scenes(*app_.labs().find(GetParam()))) try_scene(scene);
    if (GetParam() == std::string(rig_lab)) try_units();
    for (const auto& [key, tried] : tried_) {
        changed += tried.outcome == Outcome::Changed;
        const bool solves_again =  // a rig at rest
            GetParam() == std::string(rig_lab) && tried.name.find("\"Forward##") != tried.name.npos;
        EXPECT_TRUE(solves_again || tried.outcome != Outcome::Nothing) << tried.name << " changes nothing";
    }
    EXPECT_GT(changed, tried_.size() * 4 / 5) << "most are not grey";
    RecordProperty("widgets", static_cast<int>(changed));
}

INSTANTIATE_TEST_SUITE_P(Labs, PanelClicks, testing::ValuesIn(clicked_labs), of_lab);

/// A lab's verdict and notes change while time runs: everything below them stays in place.
class BelowTheVerdict : public Panels {
  protected:
    /// Height of a text in the panel `panel`; 0 if it is not there.
    float height(const std::string& panel, const std::string& text) const {
        for (const DrawnText& each : frame().texts)
            if (each.window != nullptr && window_name(each.window).starts_with(panel + "/content") &&
                each.text == text)
                return each.box.min.y;
        return 0.0f;
    }
    void run_for(int count) {
        run("time.play");
        ticks(count);
        run("time.pause");
        ticks(4);
    }
    std::string verdict() { return app_.state().at("verdict"); }
};

TEST_P(BelowTheVerdict, NothingMovesWhateverTheVerdictSays) {
    const std::map<std::string, std::vector<std::vector<CommandCall>>> all{
        {"chain",
         {{call("chain.preset", {{"name", "reaching_arm"}})},
          {call("chain.target", {{"to", glm::vec3(0.0f, 9.0f, 0.0f)}})},
          {call("chain.target", {{"to", glm::vec3(0.1f, 0.2f, 0.0f)}})},
          {call("chain.solver", {{"name", "fabrik"}, {"iterations", 1}})}}},
        {"rope",
         {{call("rope.preset", {{"name", "drape"}})},
          {call("rope.preset", {{"name", "flag"}})},
          {call("rope.settings", {{"solver", "relaxation"}, {"iterations", 1}})},
          {call("rope.clear")}}},
        {"signal",
         {{call("signal.preset", {{"name", "spring"}})},
          {call("signal.filter.enable", {{"at", 0}, {"on", false}})},
          {call("signal.clear")}}},
        {"rig", {{call("rig.preset", {{"name", "fk"}})}, {call("rig.clear")}}},
        {"humanoid",
         {{call("humanoid.load")},
          {call("humanoid.map", {{"bone", "LeftHand"}, {"node", ""}}),
           call("humanoid.map", {{"bone", "RightFoot"}, {"node", ""}}),
           call("humanoid.map", {{"bone", "Head"}, {"node", ""}})}}},
        {"linkage",
         {{call("linkage.preset", {{"name", "four_bar"}})},
          {call("linkage.drive", {{"joint", "rocker"}, {"angle_deg", 0}})},
          {call("linkage.target", {{"point", "P"}, {"to", glm::vec3(9.0f, 9.0f, 0.0f)}})},
          {call("linkage.clear")}}}};
    const std::map<std::string, std::string> below{
        {"chain", "Selection"}, {"rope", "Selection"},     {"signal", "Now"},
        {"rig", "Element"},     {"humanoid", "Character"}, {"linkage", "Degrees of freedom"}};
    set_up({});
    std::set<std::string> said;
    float first = 0.0f;
    for (const std::vector<CommandCall>& each : all.at(GetParam())) {
        for (const CommandCall& command : each) run(command.name, to_json(command.arguments));
        run_for(60);
        said.insert(verdict());
        const float now = height("right", below.at(GetParam()));
        ASSERT_GT(now, 0.0f);
        if (first == 0.0f) first = now;
        EXPECT_NEAR(now, first, 1.0f) << "below \"" << verdict() << "\"";
    }
    EXPECT_GE(said.size(), 2u);
}

/// The space for long verdicts must not leave a gap below the usual short ones.
class ChainVerdict : public BelowTheVerdict {};

TEST_P(ChainVerdict, LeavesAtMostOneLineEmpty) {
    set_up({});
    float first = 0.0f;
    const auto check_verdict = [&](const std::vector<CommandCall>& commands) {
        for (const CommandCall& command : commands) run(command.name, to_json(command.arguments));
        ticks(4);
        const bool solved = height("right", "iterations") > 0.0f;
        const float below = height("right", solved ? "iterations" : "Selection");
        ASSERT_GT(below, 0.0f);
        constexpr float line = 15.0f;  // of the panel's text
        float end = 0.0f;
        for (const DrawnText& each : frame().texts) {
            if (each.window == nullptr || !window_name(each.window).starts_with("right/content")) continue;
            if (each.box.min.y >= below - 1.0f) continue;
            end = std::max(end, each.box.max.y);
        }
        // A reading has its own line around its text, a heading a little more.
        EXPECT_LT(below - end, (solved ? 2.5f : 3.0f) * line) << "below \"" << verdict() << "\"";
        if (!solved) return;
        if (first == 0.0f) first = below;
        EXPECT_NEAR(below, first, 1.0f) << "below \"" << verdict() << "\"";
    };
    check_verdict({});
    check_verdict({call("chain.preset", {{"name", "reaching_arm"}})});
    check_verdict({call("chain.target", {{"to", glm::vec3(0.0f, 9.0f, 0.0f)}})});
    check_verdict({call("chain.target", {{"to", glm::vec3(0.1f, 0.6f, 0.0f)}})});
    check_verdict({call("chain.preset", {{"name", "straight"}})});
    check_verdict({call("chain.solver", {{"name", "fabrik"}}),
                   call("chain.target", {{"to", glm::vec3(3.25f, 0.0f, 0.0f)}})});
    check_verdict({call("chain.solver", {{"name", "svd_dls"}, {"iterations", 1}}),
                   call("chain.target", {{"to", glm::vec3(-1.0f, 2.0f, 0.0f)}})});
}

INSTANTIATE_TEST_SUITE_P(Chain, ChainVerdict, testing::Values("chain"));

INSTANTIATE_TEST_SUITE_P(Labs, BelowTheVerdict, testing::ValuesIn(clicked_labs), of_lab);

class BoneMapRows : public BelowTheVerdict {};

/// Also for bones that make the body incomplete, or complete again.
TEST_P(BoneMapRows, StayUnderTheMouseThatMapsThem) {
    set_up({call("view.fold", {{"section", "humanoid: Bones"}, {"folded", false}})});
    const float before = height("left", "LeftHand");
    ASSERT_GT(before, 0.0f);
    move({60.0f, before + 8.0f});
    for (const char* node : {"", "LeftHand"}) {
        run("humanoid.map", {{"bone", "LeftHand"}, {"node", node}});
        run_for(2);
        EXPECT_NEAR(height("left", "LeftHand"), before, 1.0f) << "mapped to \"" << node << "\"";
    }
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", ""}});
    move(in_the_scene);
    run_for(2);
    EXPECT_LT(height("left", "LeftHand"), before) << "the map of an incomplete body comes first";
}

INSTANTIATE_TEST_SUITE_P(Map, BoneMapRows, testing::Values("humanoid"));

class KeptRoom : public Panels {};

TEST_P(KeptRoom, KeepsRowsBelowAListInPlaceUntilTheMouseLeaves) {
    set_up({call("humanoid.load", {{"path", source_path("tests/app/golden/faulty_walk.bvh")}}),
            call("humanoid.clip", {{"name", "motion"}}),
            call("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}})});
    const auto place = [&](const std::string& text) {
        glm::vec2 last{0.0f};
        for (const DrawnText& each : frame().texts)
            if (each.text == text) last = 0.5f * (each.box.min + each.box.max);
        return last;
    };
    const glm::vec2 fix = place("Fix"), below = place("Targets");
    ASSERT_TRUE(fix.y > 0.0f && below.y > fix.y);
    for (int i = 0; i < 3; ++i) {
        click(fix);
        EXPECT_FLOAT_EQ(place("Targets").y, below.y) << "click " << i + 1;
    }
    EXPECT_LT(place("Fix").y, fix.y) << "the last finding was not fixed";
    move(in_the_scene);
    ticks(2);
    EXPECT_LT(place("Targets").y, below.y);
}

INSTANTIATE_TEST_SUITE_P(Lint, KeptRoom, testing::Values("humanoid"));

}  // namespace
}  // namespace tendril::test
