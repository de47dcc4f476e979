// Everything in a panel that can be clicked, dragged or typed into has a tooltip.
#include <gtest/gtest.h>

#include <set>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/unit_inputs.hpp"
#include "app/shell/layout.hpp"
#include "app/shell/shell.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/app/support/tooltips.hpp"

namespace tendril::app {
namespace {

using test::all_scenes;
using test::bones_and_a_control;
using test::call;
using test::Shown;

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
    /// Searches it unless it was searched before.
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
        Workspace workspace = opened(shown);
        set_folded(workspace.settings, GetParam(), false);
        search_panels(workspace, shown.name);
    }
    RecordProperty("items", static_cast<int>(items_.size()));
    EXPECT_GT(items_.size(), 40u) << "the search finds what there is";
}

INSTANTIATE_TEST_SUITE_P(Labs, Tooltips,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
                         [](const auto& lab) { return std::string(lab.param); });

/// The window around the panels, with a lab open.
class ShellTooltips : public TooltipTest, public testing::WithParamInterface<const char*> {
  protected:
    ShellTooltips() : TooltipTest(GetParam()) {}
    /// Searches the part of the window that `of` selects from its layout.
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

INSTANTIATE_TEST_SUITE_P(Labs, ShellTooltips,
                         testing::Values("chain", "rope", "signal", "rig", "humanoid", "linkage"),
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
