// The size of a lab's panel when the lab is opened; no row is lost under "More".
#include <imgui.h>
#include <imgui_internal.h>  // windows

#include "tests/app/support/driven_app.hpp"
#include "tests/app/support/layout_faults.hpp"

namespace tendril::test {
namespace {

using namespace app;

constexpr glm::ivec2 usual_window{1440, 900};
constexpr glm::ivec2 high_window{1440, 3000};  ///< shows every row without scrolling
constexpr glm::ivec2 unscrolled{1440, 2400};   ///< nothing is out of view when a lab opens
constexpr std::size_t max_rows = 18;

class PanelRows : public testing::TestWithParam<std::string>, protected DrivenApp {
  protected:
    PanelRows() : DrivenApp(unscrolled) {
        take(Resize{usual_window});
        open();
    }
    void open() { run("lab.open", {{"name", GetParam()}}); }
    /// The text of each row, from the top; a wrapped text is one row.
    std::vector<std::string> rows() {
        app_.settle();
        std::vector<std::pair<float, std::string>> found;
        for (const DrawnText& text : recorder_.frame().texts) {
            if (text.window == nullptr || !window_name(text.window).starts_with("left/content")) continue;
            // The mark and the value of a row are a few pixels off its name.
            const auto same = std::ranges::find_if(
                found, [&](const auto& row) { return std::abs(row.first - text.box.min.y) < 6.0f; });
            if (same == found.end())
                found.emplace_back(text.box.min.y, text.text);
            else
                same->second += "  " + text.text;
        }
        std::ranges::sort(found);
        std::vector<std::string> rows;
        for (auto& row : found) rows.push_back(std::move(row.second));
        return rows;
    }
    static std::string joined(const std::vector<std::string>& rows) {
        std::string all;
        for (const std::string& row : rows) all += row + "\n";
        return all;
    }
};

TEST_P(PanelRows, AreFewWhenTheLabOpens) {
    const std::vector<std::string> shown = rows();
    EXPECT_GT(shown.size(), 5u);
    EXPECT_LE(shown.size(), max_rows) << joined(shown);
}

/// A user who looks for the wind finds it without unfolding anything.
TEST(RopePanel, ShowsTheWindAndFitsASmallWindowWhenItOpens) {
    const auto window = open_offscreen({1280, 720});
    App app(*window);
    FrameRecorder recorder;
    app.run({"lab.open", Json{{"name", "rope"}}});
    app.settle();
    bool wind = false, exports = false;
    for (const DrawnText& text : recorder.frame().texts) {
        if (text.window == nullptr || !window_name(text.window).starts_with("left/content")) continue;
        EXPECT_EQ(text.window->ScrollMax.y, 0.0f);
        wind = wind || text.text.starts_with("wind");
        exports = exports || text.text == "Export";
    }
    EXPECT_TRUE(wind);
    EXPECT_TRUE(exports);
}

TEST_P(PanelRows, AreFewInTheSceneOfItsCard) {
    const Labs labs;
    const Cards cards(labs);
    const Card& card = cards.of(GetParam()).front();
    for (const CardLine& line : card.scene) run(line.command, *line.arguments);
    const std::vector<std::string> shown = rows();
    EXPECT_LE(shown.size(), max_rows) << joined(shown);
}

TEST_P(PanelRows, AreAllReachableByOneCommand) {
    take(Resize{high_window});
    const std::size_t before = rows().size();
    run("view.fold", {{"section", GetParam()}, {"folded", false}});
    const std::vector<std::string> all = rows();
    EXPECT_GT(all.size(), before + 8);
    run("view.fold", {{"section", GetParam()}, {"folded", true}});
    EXPECT_LT(rows().size(), before) << "every section is folded";
}

INSTANTIATE_TEST_SUITE_P(Labs, PanelRows, testing::ValuesIn(names_of_labs()),
                         [](const auto& lab) { return lab.param; });

/// One lab at a time, by name.
class RowsUnderMore : public testing::Test, protected DrivenApp {
  protected:
    RowsUnderMore() : DrivenApp(unscrolled) { take(Resize{high_window}); }
    void open(const char* lab) { run("lab.open", {{"name", lab}}); }
    void unfold_all(const char* lab) { run("view.fold", {{"section", lab}, {"folded", false}}); }
    void type(const char* line) {
        run("view.palette", {{"open", true}});
        DrivenApp::type(line);
        key("enter");
        wait(3);
    }
    /// Shows the card with its first steps done.
    void show_card(const char* lab, std::size_t number, std::size_t done) {
        run("view.card", {{"open", true}, {"number", number}});
        CardProgress& progress = workspace().ui.cards[lab];
        progress.done.assign(5, false);
        progress.tried.resize(5);
        for (std::size_t i = 0; i < done; ++i) progress.done[i] = true;
        wait(3);
    }
    bool shows(const std::string& label) {
        app_.settle();
        return std::ranges::any_of(recorder_.frame().texts, [&](const DrawnText& each) {
            return each.window != nullptr && window_name(each.window).starts_with("left/content") &&
                   each.text == label;
        });
    }
};

TEST_F(RowsUnderMore, AreShownByOpeningIt) {
    run("chain.preset", {{"name", "reaching_arm"}});
    EXPECT_FALSE(shows("tolerance"));
    run("view.fold", {{"section", "chain: Mode and solver, more"}, {"folded", false}});
    EXPECT_TRUE(shows("tolerance"));
    open("humanoid");
    unfold_all("humanoid");
    EXPECT_TRUE(shows("mesh file"));
}

TEST_F(RowsUnderMore, ChangedOnesAreCountedInItsTitle) {
    run("chain.preset", {{"name", "reaching_arm"}});
    EXPECT_TRUE(shows("More"));
    run("chain.solver", {{"damping", 0.3}});
    EXPECT_TRUE(shows("More (1 changed)"));
    run("chain.solver", {{"soft_zone", 0.1}});
    EXPECT_TRUE(shows("More (2 changed)"));
    EXPECT_FALSE(shows("soft zone"));
    run("undo");
    run("undo");
    EXPECT_TRUE(shows("More"));
}

/// A preset sets the values that it needs; only later changes by the user count.
TEST_F(RowsUnderMore, AFreshPresetCountsNone) {
    open("rope");
    run("view.fold", {{"section", "rope: Solver"}, {"folded", false}});
    for (const char* preset : {"drape", "well", "flag", "pendulum"}) {
        run("rope.preset", {{"name", preset}});
        EXPECT_TRUE(shows("More")) << preset;
        EXPECT_FALSE(shows("More (1 changed)") || shows("More (2 changed)")) << preset;
    }
    run("rope.settings", {{"damping", 0.25}});
    EXPECT_TRUE(shows("More (1 changed)"));
    run("rope.settings", {{"damping", 0}});
    EXPECT_FALSE(shows("More (1 changed)"));
}

TEST_F(RowsUnderMore, UnfoldForACommandOfThePalette) {
    run("chain.preset", {{"name", "reaching_arm"}});
    run("view.fold", {{"section", "chain: Mode and solver"}, {"folded", true}});
    EXPECT_FALSE(shows("soft zone"));
    type("chain.solver soft_zone=0.1");
    EXPECT_TRUE(shows("soft zone"));
    EXPECT_FALSE(shows("motion")) << "the section Target stays folded";
}

/// Rows of field tables and rows that a panel adds itself, in every lab.
TEST_F(RowsUnderMore, UnfoldForTheirCommandInEveryLab) {
    struct Row {
        const char* lab;
        std::vector<std::pair<const char*, Json>> scene;
        std::string line;
        const char* label;
    };
    const Json walk{{"path", source_path("tests/app/golden/faulty_walk.bvh")}};
    const std::string mesh = source_path("tests/app/golden/body.glb");
    const Row rows[] = {
        {"chain", {{"chain.mode", {{"mode", "fixed"}}}}, "chain.mode mode=fixed tolerance=0.01", "tolerance"},
        {"chain",
         {{"chain.preset", {{"name", "reaching_arm"}}}},
         "chain.solver default_tolerance=true",
         "Default tolerance"},
        {"chain",
         {{"chain.preset", {{"name", "reaching_arm"}}}},
         "chain.solver default_restarts=true",
         "Default restarts"},
        {"chain", {{"chain.preset", {{"name", "reaching_arm"}}}}, "chain.pole to=[1,2,1]", "pole x"},
        {"chain", {{"chain.mode", {{"mode", "reach"}}}}, "chain.flips degrees=40", "flip over"},
        {"rope", {}, "rope.settings substep=0.002", "substeps"},
        {"rope", {}, "rope.jitter dial=0.1", "frame-time jitter"},
        {"rope", {}, "rope.settings longest_frame=0.1", "longest frame"},
        {"rig", {}, "rig.flips degrees=40", "flip over"},
        {"humanoid", {}, "humanoid.flips degrees=40", "flip over"},
        {"humanoid", {}, "humanoid.ground kind=mesh path=" + mesh, "mesh file"},
        {"humanoid", {}, "humanoid.t_pose on=true", "Rest as a T-pose"},
        {"humanoid", {{"humanoid.load", walk}}, "humanoid.scale metres=0.011", "file unit"},
        {"humanoid", {{"humanoid.load", walk}}, "humanoid.up axis=z", "up axis"}};
    for (const Row& row : rows) {
        run("scene.new");
        open(row.lab);
        for (const auto& [command, arguments] : row.scene) run(command, arguments);
        run("view.fold", {{"section", row.lab}, {"folded", true}});
        ASSERT_FALSE(shows(row.label)) << row.line;
        type(row.line.c_str());
        EXPECT_TRUE(shows(row.label)) << row.line;
    }
}

TEST_F(RowsUnderMore, UnfoldForAStepOfACard) {
    open("rope");
    show_card("rope", 2, 1);
    EXPECT_TRUE(shows("friction"));
    EXPECT_FALSE(shows("substeps"));
    show_card("rope", 2, 2);
    EXPECT_TRUE(shows("substeps"));
    run("view.fold", {{"section", "rope: Solver, more"}, {"folded", true}});
    app_.tick(nullptr);
    EXPECT_FALSE(shows("substeps")) << "it can be folded again";
}

/// A character that its file's unit makes a giant.
TEST_F(RowsUnderMore, AButtonCorrectsAGiantsUnit) {
    const auto scale = [&] { return app_.state().at("character").at("scale").get<double>(); };
    open("humanoid");
    run("humanoid.load", {{"path", source_path("tests/app/golden/faulty_walk.bvh")}});
    EXPECT_FALSE(shows("Use metres"));
    run("humanoid.scale", {{"metres", 100.0}});
    EXPECT_EQ(scale(), 100.0);
    click(at("Use metres"));
    EXPECT_EQ(scale(), 1.0);
    EXPECT_FALSE(shows("Use metres"));
    run("undo");
    EXPECT_EQ(scale(), 100.0);
}

/// So that hair does not grow on the hips.
TEST_F(RowsUnderMore, TheKindOfAnAttachmentChoosesItsBone) {
    open("humanoid");
    run("view.fold", {{"section", "humanoid: Attachments and wind"}, {"folded", false}});
    EXPECT_TRUE(shows("Hips"));
    click(at("tail (rope)"));
    click(at("ponytail (hair)"));
    EXPECT_TRUE(shows("Head"));
    EXPECT_FALSE(shows("Hips"));
    const std::size_t before = app_.state().at("attachments").size();
    const glm::vec2 add = at("Add");
    click(add), click(add);
    EXPECT_EQ(app_.state().at("attachments").size(), before + 2) << "the button stays under the pointer";
}

/// Gusts are shown if there is wind.
TEST_F(RowsUnderMore, ShowGustsWhileTheWindBlows) {
    open("rope");
    EXPECT_FALSE(shows("gusts"));
    run("rope.preset", {{"name", "flag"}});
    EXPECT_TRUE(shows("gusts"));
    EXPECT_TRUE(shows("Still air resists"));
}

TEST_F(RowsUnderMore, ButtonsAddAndRemoveACharacterInTheRopeLab) {
    const auto character = [&] { return app_.state().at("character"); };
    open("rope");
    run("view.fold", {{"section", "rope: Add"}, {"folded", false}});
    EXPECT_FALSE(shows("clip"));
    click(at("Stick figure"));
    EXPECT_EQ(character().at("clip"), "walk");
    EXPECT_TRUE(shows("clip"));
    run("rope.character", {{"clip", ""}, {"at", {0.5, 0, 0}}});
    EXPECT_TRUE(shows("none (rest pose)"));
    click(at("Remove"));
    EXPECT_EQ(character(), nullptr);
    run("undo");
    EXPECT_EQ(character().at("at").at(0), 0.5);
}

}  // namespace
}  // namespace tendril::test
