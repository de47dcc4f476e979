// A button stays under the mouse that clicks it: what is clicked three times at one place is one button.
#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/app.hpp"
#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/app/support/layout_faults.hpp"
#include "tests/places.hpp"

namespace tendril::test {
namespace {

using namespace app;

constexpr glm::ivec2 window{1280, 1400};  ///< high enough for the panels

bool is_at(const DrawnItem& item, glm::vec2 at) {
    return at.x >= item.box.min.x && at.x < item.box.max.x && at.y >= item.box.min.y && at.y < item.box.max.y;
}

/// A switch may say something else after a click, in another width.
bool same_place(const DrawnItem& a, const DrawnItem& b) {
    return std::abs(a.box.min.x - b.box.min.x) < 3.0f && std::abs(a.box.min.y - b.box.min.y) < 3.0f;
}

class SteadyButtons : public testing::TestWithParam<const char*> {
  protected:
    void run(const std::string& command, Json arguments = Json::object()) {
        app_.run({command, std::move(arguments)});
    }
    void set_up(const std::vector<CommandCall>& commands) {
        run("scene.new");
        run("lab.open", {{"name", GetParam()}});
        for (const CommandCall& command : commands) run(command.name, to_json(command.arguments));
        run("time.pause");
        const Event away = MouseMove{{640.0f, 700.0f}};
        for (int i = 0; i < 4; ++i) app_.tick(i == 0 ? &away : nullptr);
    }
    std::vector<DrawnItem> buttons() const {
        std::vector<DrawnItem> all;
        for (const DrawnItem& item : recorder_.frame().items)
            if (item.kind == DrawnItem::Kind::Button) all.push_back(item);
        return all;
    }
    void click(glm::vec2 at) {
        const Event events[] = {MouseMove{at}, MousePress{MouseButton::Left, true},
                                MousePress{MouseButton::Left, false}};
        for (const Event& event : events) app_.tick(&event);
        for (int i = 0; i < 4; ++i) app_.tick(nullptr);
    }
    std::string text_of(const DrawnItem& button) const {
        for (const DrawnText& text : recorder_.frame().texts)
            if (is_at(button, 0.5f * (text.box.min + text.box.max))) return text.text;
        return "?";
    }
    /// Clicks every button of a scene three times.
    void check(const std::string& scene, const std::vector<CommandCall>& commands) {
        set_up(commands);
        std::set<unsigned> tried;
        for (const DrawnItem& button : buttons()) {
            if (!tried.insert(button.id).second) continue;
            set_up(commands);
            const std::string name = text_of(button);
            const glm::vec2 at = 0.5f * (button.box.min + button.box.max);
            for (int i = 0; i < 3 && app_.workspace().lab == GetParam() && !app_.workspace().ui.covered();
                 ++i) {
                click(at);
                const auto now = buttons();
                const auto other = std::ranges::find_if(now, [&](const DrawnItem& each) {
                    return is_at(each, at) && each.id != button.id && !same_place(each, button);
                });
                if (other != now.end()) {
                    ADD_FAILURE() << scene << ": after click " << i + 1 << " on \"" << name << "\", \""
                                  << text_of(*other) << "\" is under the mouse, "
                                  << other->box.min.y - button.box.min.y << " lower, "
                                  << other->box.min.x - button.box.min.x << " to the right";
                    break;
                }
            }
        }
    }

    std::unique_ptr<Window> window_ = open_offscreen(window);
    App app_{*window_};
    FrameRecorder recorder_;
};

TEST_P(SteadyButtons, StayUnderTheMouseThatClicksThem) {
    const Lab& lab = *app_.labs().find(GetParam());
    check("the opening", lab.opening());
    const CommandTable table = make_command_table(app_.labs());
    int scenes = 0;
    for (const Shown& shown : all_scenes(lab, table))
        if (scenes++ % 4 == 1) check(shown.name, shown.commands);
    if (GetParam() == std::string("chain"))
        check("the microscope", {call("chain.preset", {{"name", "reaching_arm"}}), call("microscope.open")});
}

/// What a lab's verdict and its notes say changes by itself while time runs: what is below stays in place.
class BelowTheVerdict : public SteadyButtons {
  protected:
    /// Of a text in the panel `panel`; 0 if it is not there.
    float height(const std::string& panel, const std::string& text) const {
        for (const DrawnText& each : recorder_.frame().texts)
            if (each.window != nullptr && window_name(each.window).starts_with(panel + "/content") &&
                each.text == text)
                return each.box.min.y;
        return 0.0f;
    }
    void run_for(int ticks) {
        run("time.play");
        for (int i = 0; i < ticks; ++i) app_.tick(nullptr);
        run("time.pause");
        for (int i = 0; i < 4; ++i) app_.tick(nullptr);
    }
    std::string verdict() { return app_.state().at("verdict"); }
};

TEST_P(BelowTheVerdict, NothingMovesWhateverItSays) {
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

/// The room for long verdicts is not a gap below the usual, short ones.
class ChainVerdict : public BelowTheVerdict {};

TEST_P(ChainVerdict, LeavesAtMostOneLineEmpty) {
    set_up({});
    float first = 0.0f;
    const auto check_verdict = [&](const std::vector<CommandCall>& commands) {
        for (const CommandCall& command : commands) run(command.name, to_json(command.arguments));
        for (int i = 0; i < 4; ++i) app_.tick(nullptr);
        const bool solved = height("right", "iterations") > 0.0f;
        const float below = height("right", solved ? "iterations" : "Selection");
        ASSERT_GT(below, 0.0f);
        constexpr float line = 15.0f;  // of the panel's text
        float end = 0.0f;
        for (const DrawnText& each : recorder_.frame().texts) {
            if (each.window == nullptr || !window_name(each.window).starts_with("right/content")) continue;
            if (each.box.min.y >= below - 1.0f) continue;
            end = std::max(end, each.box.max.y);
        }
        // A reading has a line of its own around its text, a heading a little more.
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

INSTANTIATE_TEST_SUITE_P(Labs, BelowTheVerdict,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return std::string(lab.param); });

class BoneMapRows : public BelowTheVerdict {};

/// Also those that make the body incomplete, or complete again.
TEST_P(BoneMapRows, StayUnderTheMouseThatMapsThem) {
    set_up({call("view.fold", {{"section", "humanoid: Bones"}, {"folded", false}})});
    const float before = height("left", "LeftHand");
    ASSERT_GT(before, 0.0f);
    const Event there = MouseMove{{60.0f, before + 8.0f}};
    app_.tick(&there);
    for (const char* node : {"", "LeftHand"}) {
        run("humanoid.map", {{"bone", "LeftHand"}, {"node", node}});
        run_for(2);
        EXPECT_NEAR(height("left", "LeftHand"), before, 1.0f) << "mapped to \"" << node << "\"";
    }
    run("humanoid.map", {{"bone", "LeftHand"}, {"node", ""}});
    const Event away = MouseMove{{640.0f, 700.0f}};
    app_.tick(&away);
    run_for(2);
    EXPECT_LT(height("left", "LeftHand"), before) << "the map of an incomplete body comes first";
}

INSTANTIATE_TEST_SUITE_P(Map, BoneMapRows, testing::Values("humanoid"));

class KeptRoom : public SteadyButtons {};

TEST_P(KeptRoom, HoldsWhatIsBelowAListUntilTheMouseLeavesIt) {
    set_up({call("humanoid.load", {{"path", source_path("tests/app/golden/faulty_walk.bvh")}}),
            call("humanoid.clip", {{"name", "motion"}}),
            call("view.fold", {{"section", "humanoid: Motion lint"}, {"folded", false}})});
    const auto place = [&](const std::string& text) {
        glm::vec2 last{0.0f};
        for (const DrawnText& each : recorder_.frame().texts)
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
    const Event away = MouseMove{{640.0f, 700.0f}};
    for (int i = 0; i < 4; ++i) app_.tick(i == 0 ? &away : nullptr);
    EXPECT_LT(place("Targets").y, below.y);
}

INSTANTIATE_TEST_SUITE_P(Lint, KeptRoom, testing::Values("humanoid"));

INSTANTIATE_TEST_SUITE_P(Labs, SteadyButtons,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return std::string(lab.param); });

}  // namespace
}  // namespace tendril::test
