// Everything in a panel that can be clicked, dragged or typed into has a tooltip.
#include <gtest/gtest.h>

#include <set>
#include <tendril/signal/filter.hpp>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "app/labs/rig/adding.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/shell/layout.hpp"
#include "app/shell/shell.hpp"
#include "tests/app/support/tooltips.hpp"

namespace tendril::app {
namespace {

/// A scene, and what is selected and switched on in it so that the panels are full.
struct Shown {
    std::string name;
    std::vector<CommandCall> commands;
    int ticks = 3;
};

CommandCall call(const char* name, ArgumentList arguments = {}) {
    return {name, std::move(arguments)};
}

/// The lab's own scenes: its test scenes, and every preset.
std::vector<Shown> scenes_of(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all{{"as it opens", lab.opening()}};
    for (const TestScene& scene : lab.test_scenes()) all.push_back({scene.name, scene.commands});
    if (const Command* preset = table.find(lab.name() + ".preset"))
        for (const Argument& argument : preset->arguments)
            if (argument.name == "name")
                for (const std::string& name : argument.choices)
                    all.push_back({"preset " + name, {call(preset->name.c_str(), {{"name", name}})}});
    return all;
}

std::vector<Shown> full_chains() {
    const CommandCall arm = call("chain.preset", {{"name", "arm"}}),
                      reach = call("chain.mode", {{"mode", "reach"}}),
                      first = call("chain.select", {{"index", 1}});
    std::vector<Shown> all;
    for (const char* mode : {"forward", "backward", "fixed", "with_index"})
        all.push_back({mode, {call("chain.mode", {{"mode", mode}}), first}});
    for (const char* kind : {"hinge", "ball_and_socket"})
        all.push_back({kind,
                       {arm, reach, call("chain.pole", {{"to", glm::vec3(0.5f, 2.0f, 0.5f)}}), first,
                        call("chain.limit", {{"index", 1}, {"kind", kind}})}});
    all.push_back({"a limit about no axis",
                   {arm, reach, first,
                    call("chain.limit", {{"index", 1}, {"kind", "hinge"}, {"axis", glm::vec3(1, 0, 1)}})}});
    all.push_back({"root selected", {arm, reach, call("chain.select", {{"index", 0}})}});
    all.push_back({"two bones",
                   {call("chain.preset", {{"name", "start"}, {"count", 3}}), reach,
                    call("chain.solver", {{"name", "two_bone"}})}});
    all.push_back({"race", {arm, reach, call("race.open"), first}});
    all.push_back({"microscope", {arm, reach, call("microscope.open"), first}});
    all.push_back(
        {"moving target",
         {arm, reach, call("chain.motion", {{"path", "circle"}, {"radius", 5.0f}, {"period", 0.5f}}), first},
         60});
    return all;
}

std::vector<Shown> full_ropes() {
    std::vector<Shown> all;
    const CommandCall drape = call("rope.preset", {{"name", "drape"}});
    for (const char* name : {"rope", "cloth", "hair"}) {
        std::vector<CommandCall> commands{call("rope.clear")};
        if (std::string(name) == "rope")
            commands.push_back(call("rope.add", {{"name", "it"},
                                                 {"from", glm::vec3(0, 1, 0)},
                                                 {"to", glm::vec3(1, 1, 0)},
                                                 {"segments", 5},
                                                 {"pin_start", true}}));
        if (std::string(name) == "cloth")
            commands.push_back(call("rope.cloth.add", {{"name", "it"},
                                                       {"corner", glm::vec3(0, 1, 0)},
                                                       {"along", glm::vec3(1, 0, 0)},
                                                       {"down", glm::vec3(0, -1, 0)},
                                                       {"pins", "corners"}}));
        if (std::string(name) == "hair")
            commands.push_back(
                call("rope.hair.add",
                     {{"name", "it"}, {"strands", 3}, {"length", 0.5f}, {"centre", glm::vec3(0, 1, 0)}}));
        for (const int particle : {0, 1}) {
            std::vector<CommandCall> selected = commands;
            selected.push_back(call("rope.select", {{"rope", "it"}, {"particle", particle}}));
            all.push_back({std::string(name) + ", a particle", selected, 20});
        }
    }
    struct Kind {
        const char* name;
        ArgumentList shape;
    };
    const Kind kinds[] = {{"sphere", {{"centre", glm::vec3(0.0f)}, {"radius", 0.2f}}},
                          {"capsule", {{"a", glm::vec3(0.0f)}, {"b", glm::vec3(0, 0, 1)}, {"radius", 0.2f}}},
                          {"box", {{"centre", glm::vec3(0.0f)}, {"half_extents", glm::vec3(0.25f)}}},
                          {"plane", {{"point", glm::vec3(0.0f)}, {"normal", glm::vec3(0, 1, 0)}}}};
    for (const Kind& kind : kinds) {
        ArgumentList arguments{{"name", "it"}, {"kind", kind.name}};
        arguments.insert(arguments.end(), kind.shape.begin(), kind.shape.end());
        all.push_back(
            {kind.name,
             {call("rope.clear"), call("rope.collider.add", arguments),
              call("rope.collider.swing", {{"name", "it"}, {"by", glm::vec3(0.2f, 0, 0)}, {"period", 2.0f}}),
              call("rope.select", {{"collider", "it"}})}});
    }
    for (const char* solver : {"direct", "xpbd", "relaxation"})
        all.push_back({solver, {drape, call("rope.settings", {{"solver", solver}})}});
    return all;
}

std::vector<Shown> full_signals() {
    std::vector<Shown> all;
    for (const signal::Kind& kind : signal::kinds())
        all.push_back({kind.name,
                       {call("signal.clear"), call("signal.filter.add", {{"kind", kind.name}}),
                        call("signal.select", {{"at", 0}})}});
    for (const char* input : {"hand", "square", "sine", "noise"})
        all.push_back({input, {call("signal.input", {{"kind", input}})}});
    const CommandCall draw =
        call("signal.fit.draw", {{"from", -1.0}, {"from_value", 0.0}, {"to", -1.0}, {"to_value", 0.0}});
    all.push_back({"a response", {call("signal.input", {{"kind", "square"}}), draw}});
    all.push_back({"fitting", {call("signal.input", {{"kind", "square"}}), draw, call("signal.fit")}});
    return all;
}

std::vector<CommandCall> bones_and_a_control() {
    const SharedJson above(Json{{"translation", {0.0, 0.3, 0.0}}});
    return {call("rig.clear"), call("rig.element.add", {{"name", "a"}}),
            call("rig.element.add", {{"name", "b"}, {"parent", "a"}, {"local", above}}),
            call("rig.element.add", {{"name", "c"}, {"parent", "b"}, {"local", above}}),
            call("rig.element.add", {{"name", "look"}, {"kind", "control"}, {"control", "position"}})};
}

std::vector<Shown> full_rigs() {
    std::vector<Shown> all;
    for (const char* kind : {"bool", "float", "vector2d", "position", "rotation", "transform"}) {
        Shown shown{std::string("control ") + kind, bones_and_a_control()};
        shown.commands.push_back(
            call("rig.element.add", {{"name", "it"}, {"kind", "control"}, {"control", kind}}));
        shown.commands.push_back(call("rig.select", {{"element", "it"}}));
        all.push_back(std::move(shown));
    }
    for (const char* element : {"a", "c"}) {
        Shown shown{std::string("bone ") + element, bones_and_a_control()};
        shown.commands.push_back(call("rig.select", {{"element", element}}));
        all.push_back(std::move(shown));
    }
    return all;
}

std::vector<Shown> full_humanoids() {
    const CommandCall walk = call("humanoid.clip", {{"name", "walk"}, {"time", 0.3}});
    std::vector<Shown> all;
    for (const char* node : {"LeftHand", "Head", "Hips", "HeadTop_End", "LeftLowerLeg"})
        all.push_back({node, {walk, call("humanoid.select", {{"node", node}})}});
    all.push_back({"a spring",
                   {walk, call("humanoid.spring", {{"node", "HeadTop_End"}}),
                    call("humanoid.select", {{"node", "HeadTop_End"}})},
                   20});
    const std::string golden = std::string(TENDRIL_SOURCE_DIR) + "/tests/app/golden/";
    all.push_back({"a file with a skin", {call("humanoid.load", {{"path", golden + "body.glb"}})}});
    all.push_back({"a clip with faults",
                   {call("humanoid.load", {{"path", golden + "faulty_walk.bvh"}}),
                    call("humanoid.clip", {{"index", 0}})}});
    for (const char* ground : {"flat", "slope", "stairs", "terrain"})
        all.push_back(
            {ground,
             {walk, call("humanoid.ground", {{"kind", ground}}), call("humanoid.foot_ik", {{"on", true}})}});
    all.push_back(
        {"hands",
         {walk, call("humanoid.target", {{"effector", "left_hand"}, {"to", glm::vec3(0.4f, 1.5f, 0.7f)}}),
          call("humanoid.target", {{"effector", "right_hand"}, {"to", glm::vec3(0, 1.4f, 0.5f)}}),
          call("humanoid.hand_ik", {{"on", true}, {"hand", "left"}, {"curve", true}}),
          call("humanoid.hand_ik", {{"on", true}, {"hand", "right"}, {"curve", true}}),
          call("humanoid.look_at", {{"on", true}, {"to", glm::vec3(0.5f, 1.5f, 1.5f)}})}});
    return all;
}

std::vector<Shown> all_scenes(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all = scenes_of(lab, table);
    const auto add = [&](std::vector<Shown> more) {
        all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    };
    if (lab.name() == "chain") add(full_chains());
    if (lab.name() == "rope") add(full_ropes());
    if (lab.name() == "signal") add(full_signals());
    if (lab.name() == "rig") add(full_rigs());
    if (lab.name() == "humanoid") add(full_humanoids());
    return all;
}

class TooltipTest : public testing::Test {
  protected:
    explicit TooltipTest(const char* lab) : name_(lab) {}

    void run(Workspace& workspace, const std::vector<CommandCall>& commands) {
        for (const CommandCall& each : commands) {
            table_.run(workspace, each.name, to_json(each.arguments));
            if (const auto& finish = table_.find(each.name)->finish) finish(workspace);
        }
    }
    Workspace opened(const Shown& shown) {
        Workspace workspace = make_blank_workspace(labs_);
        workspace.open_lab(name_);
        table_.run(workspace, "view.fold", {{"section", "chain: Joints, in metres"}, {"folded", false}});
        run(workspace, shown.commands);
        workspace.clock.playing = true;
        for (int i = 0; i < shown.ticks; ++i) {
            lab().step(workspace);
            ++workspace.clock.tick;
        }
        return workspace;
    }
    const Lab& lab() const { return *labs_.find(name_); }
    void require(const test::TooltipSearch& found, const std::string& where) {
        items_.insert(found.items.begin(), found.items.end());
        for (const auto& [id, text] : found.lacking)
            if (told_.insert(id).second)
                ADD_FAILURE() << name_ << ", " << where << ": no tooltip at \"" << text << '"';
    }
    /// Where that was not searched yet.
    template <class Draw>
    void search(const std::string& name, const Draw& draw) {
        const auto drawn = [&] {
            Emit emit;
            draw(emit);
        };
        if (seen_.insert(finder_.text_of(drawn)).second) require(finder_.search_panel(drawn), name);
    }
    void search_inspector(const Workspace& workspace, const std::string& scene) {
        search(scene + ", inspector", [&](Emit& emit) { lab().inspector(workspace, emit); });
    }
    void search_panels(const Workspace& workspace, const std::string& scene) {
        search(scene + ", panel", [&](Emit& emit) { lab().panel(workspace, emit); });
        search_inspector(workspace, scene);
    }

    std::string name_;
    Labs labs_;
    CommandTable table_ = make_command_table(labs_);
    test::TooltipFinder finder_;
    std::set<std::string> seen_;  ///< texts of panels that were searched
    std::set<unsigned> items_, told_;
};

class Tooltips : public TooltipTest, public testing::WithParamInterface<const char*> {
  protected:
    Tooltips() : TooltipTest(GetParam()) {}
};

TEST_P(Tooltips, StandAtEverythingInThePanels) {
    for (const Shown& shown : all_scenes(lab(), table_)) {
        SCOPED_TRACE(shown.name);
        search_panels(opened(shown), shown.name);
    }
    RecordProperty("items", static_cast<int>(items_.size()));
    EXPECT_GT(items_.size(), 40u) << "the search finds what there is";
}

INSTANTIATE_TEST_SUITE_P(Labs, Tooltips, testing::Values("chain", "rope", "signal", "rig", "humanoid"),
                         [](const auto& lab) { return std::string(lab.param); });

/// The window around the panels, as it is with a lab open.
class ShellTooltips : public TooltipTest, public testing::WithParamInterface<const char*> {
  protected:
    ShellTooltips() : TooltipTest(GetParam()) {}
    /// Of the part of the window that `of` picks from its layout.
    template <class Of>
    void search_part(const Workspace& workspace, const std::string& name, Of of) {
        const glm::vec2 size = finder_.window_size();
        const Layout layout = lay_out(size, 1.0f, workspace.settings, lab().timeline_height(workspace),
                                      lab().canvas_share(workspace));
        Shell shell;
        const auto draw = [&] {
            Emit emit;
            shell.frame({workspace, labs_, lab(), table_, shortcuts_, layout, "", nullptr}, emit);
        };
        const auto found = finder_.search_window(of(layout, size), draw);
        EXPECT_FALSE(found.items.empty()) << name;
        require(found, name);
    }

    Shortcuts shortcuts_{labs_, table_};
};

TEST_P(ShellTooltips, StandAtTheTopBarAndAtTheEdgesOfThePanels) {
    Workspace workspace = opened({"as it opens", lab().opening()});
    search_part(workspace, "top bar", [](const Layout& layout, glm::vec2) { return layout.top; });
    const auto left = [](const Layout& layout, glm::vec2) {
        const Rect& all = layout.left;
        return Rect{{all.max.x - 6.0f, all.min.y}, all.max};
    };
    const auto right = [](const Layout& layout, glm::vec2) {
        const Rect& all = layout.right;
        return Rect{{all.min.x - 2.0f, all.min.y}, {all.min.x + 5.0f, all.max.y}};
    };
    for (const bool open : {true, false}) {
        table_.run(workspace, "view.panels", {{"left", open}, {"right", open}});
        search_part(workspace, "left edge", left);
        search_part(workspace, "right edge", right);
    }
}

TEST_P(ShellTooltips, StandAtTheStripOfTime) {
    for (const Shown& shown : all_scenes(lab(), table_)) {
        const Workspace workspace = opened(shown);
        if (lab().timeline_height(workspace) <= 0.0f) continue;
        const std::string text = finder_.text_of([&] {
            Emit emit;
            lab().timeline(workspace, emit);
        });
        if (!seen_.insert(text).second) continue;
        search_part(workspace, shown.name + ", strip of time",
                    [](const Layout& layout, glm::vec2) { return layout.timeline; });
    }
}

TEST_P(ShellTooltips, StandAtTheSettings) {
    Workspace workspace = opened({"as it opens", lab().opening()});
    table_.run(workspace, "view.settings", {{"open", true}});
    search_part(workspace, "settings", [](const Layout&, glm::vec2 size) {
        const glm::vec2 half{200.0f};
        return Rect{0.5f * size - half, 0.5f * size + half};
    });
}

TEST_P(ShellTooltips, StandAtTheVideoDialogAndAtItsProgress) {
    Workspace workspace = opened({"as it opens", lab().opening()});
    workspace.ui.file_dialog = UiState::FileDialog::Video;
    workspace.ui.filming = VideoProgress{"arm-1.png", 20, 301};
    search_part(workspace, "video", [](const Layout&, glm::vec2 size) {
        return Rect{{0.25f * size.x, 0.0f}, {0.75f * size.x, size.y}};
    });
}

INSTANTIATE_TEST_SUITE_P(Labs, ShellTooltips, testing::Values("chain", "rope", "signal", "rig", "humanoid"),
                         [](const auto& lab) { return std::string(lab.param); });

class RigTooltips : public TooltipTest {
  protected:
    RigTooltips() : TooltipTest(rig_lab) {}
    void select_each_unit(Workspace& workspace, const std::string& scene) {
        std::vector<std::string> units;
        for (const UnitRow& row : unit_rows(rig_part(workspace))) units.push_back(row.unit->name);
        for (const std::string& unit : units) {
            table_.run(workspace, "rig.select", {{"element", ""}, {"unit", unit}});
            search_inspector(workspace, scene + ", unit " + unit);
        }
    }
};

TEST_F(RigTooltips, StandAtEveryInputOfTheUnitsOfThePresets) {
    for (const RigPreset& preset : rig_presets()) {
        Workspace workspace = opened({preset.name, {call("rig.preset", {{"name", preset.name}})}});
        select_each_unit(workspace, preset.name);
    }
}

TEST_F(RigTooltips, StandAtEveryInputOfEachKindOfUnit) {
    Workspace workspace = opened({"bones", bones_and_a_control()});
    table_.run(workspace, "rig.curve.add", {{"name", "curve"}});
    table_.run(workspace, "rig.select", {{"element", "c"}});
    for (std::size_t i = 0; i < std::variant_size_v<rig::Operation::Variant>; ++i) {
        const UnitOffer offer = offered_unit(rig_part(workspace), i);
        ASSERT_TRUE(offer.unit) << rig::operation_name(i) << " needs " << offer.needs;
        table_.run(workspace, "rig.unit.add", **offer.unit);
    }
    select_each_unit(workspace, "every kind");
}

}  // namespace
}  // namespace tendril::app
