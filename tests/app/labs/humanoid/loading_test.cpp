// Large files load in the background: the old character stays until then; scripts need no ticks.
#include <chrono>
#include <thread>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "tests/app/labs/humanoid/humanoid_support.hpp"

namespace tendril::app {
namespace {

/// A BVH of `joints` joints in a row, over 1 MB.
std::string large_bvh(int joints, const std::string& last_number = "0") {
    std::string text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
    for (int i = 1; i < joints; ++i)
        text +=
            "JOINT a" + std::to_string(i) + "\n{\nOFFSET 0 0.1 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
    for (int i = 0; i < joints; ++i) text += "}\n";
    std::string row;
    for (int i = 0; i < 3 * joints - 1; ++i) row += "0.25 ";
    constexpr int frames = 6000;
    text += "MOTION\nFrames: " + std::to_string(frames) + "\nFrame Time: 0.01\n";
    for (int i = 0; i + 1 < frames; ++i) text += row + "0\n";
    return text + row + last_number + "\n";
}

class HumanoidLoading : public testing::Test {
  protected:
    HumanoidLoading() {
        lab_.add_commands(table_);
        workspace_.document.set(humanoid_lab, lab_.blank());
        workspace_.lab = humanoid_lab;
        workspace_.clock.measured = true;  // as in a window
    }
    void load(const std::string& bytes) {
        test::write(folder_ / "large.bvh", bytes);
        table_.run(workspace_, "humanoid.load", {{"path", (folder_ / "large.bvh").string()}});
    }
    bool is_stick_figure() const { return humanoid_part(workspace_).loaded->file.empty(); }
    /// Runs ticks until nothing is being read.
    void wait() {
        for (int i = 0; i < 2000 && lab_.working(workspace_); ++i) {
            lab_.work(workspace_);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        EXPECT_FALSE(lab_.working(workspace_));
    }

    test::TempFolder folder_;
    HumanoidLab lab_;
    CommandTable table_;
    Workspace workspace_;
};

TEST_F(HumanoidLoading, TheCharacterArrivesAtALaterTickAndUndoRestoresTheOldOne) {
    load(large_bvh(20));
    EXPECT_TRUE(lab_.working(workspace_));
    EXPECT_TRUE(is_stick_figure()) << "the command does not wait";
    EXPECT_FALSE(workspace_.history.can_undo());
    wait();
    EXPECT_EQ(humanoid_part(workspace_).skeleton().size(), 20u);
    EXPECT_EQ(workspace_.history.undo_label(), "humanoid.load");
    const auto before = workspace_.history.undo(workspace_.document);
    ASSERT_TRUE(before);
    EXPECT_TRUE(before->get<HumanoidPart>(humanoid_lab).loaded->file.empty());
}

TEST_F(HumanoidLoading, UndoGoesBackToTheLabThatWasOpen) {
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    workspace_ = make_blank_workspace(labs);
    workspace_.open_lab("chain");
    workspace_.clock.measured = true;
    const CameraPose camera = workspace_.camera;
    test::write(folder_ / "large.bvh", large_bvh(20));
    table.run(workspace_, "file.open", {{"path", (folder_ / "large.bvh").string()}});
    EXPECT_EQ(workspace_.lab, humanoid_lab);
    wait();
    ASSERT_FALSE(is_stick_figure());
    table.run(workspace_, "undo", Json::object());
    EXPECT_TRUE(is_stick_figure());
    EXPECT_EQ(workspace_.lab, "chain");
    EXPECT_EQ(workspace_.camera, camera);
    table.run(workspace_, "redo", Json::object());
    EXPECT_EQ(workspace_.lab, humanoid_lab);
}

TEST_F(HumanoidLoading, AScriptFindsItLoaded) {
    load(large_bvh(20));
    table_.find("humanoid.load")->finish(workspace_);
    EXPECT_FALSE(lab_.working(workspace_));
    EXPECT_EQ(humanoid_part(workspace_).skeleton().size(), 20u);
    workspace_.clock.measured = false;  // without a window it loads at once
    load(large_bvh(12));
    EXPECT_EQ(humanoid_part(workspace_).skeleton().size(), 12u);
}

TEST_F(HumanoidLoading, CancelledOrRefusedLoadsKeepTheCharacter) {
    load(large_bvh(20));
    table_.run(workspace_, "humanoid.load.cancel", Json::object());
    EXPECT_FALSE(lab_.working(workspace_));
    load(large_bvh(20, "nan"));
    wait();
    EXPECT_TRUE(is_stick_figure());
    ASSERT_FALSE(workspace_.ui.toasts.empty());
    EXPECT_NE(workspace_.ui.toasts.back().text.find("large.bvh, line"), std::string::npos);
    load(large_bvh(20, "nan"));
    EXPECT_THROW(table_.find("humanoid.load")->finish(workspace_), Refused);
    EXPECT_FALSE(workspace_.history.can_undo());
}

/// 120 000 joints to judge: more than a frame has time for.
TEST_F(HumanoidLoading, ALongClipIsFixedInTheBackground) {
    std::string text = large_bvh(20);
    std::size_t row = text.find("MOTION");
    for (int i = 0; i < 3000; ++i) row = text.find('\n', row) + 1;
    text.replace(text.find(" 0\n", row), 3, " 60\n");
    load(text);
    wait();
    const SharedCharacter before = humanoid_part(workspace_).loaded;
    table_.run(workspace_, "humanoid.cure", Json::object());
    EXPECT_TRUE(lab_.working(workspace_)) << "the command does not wait";
    EXPECT_EQ(humanoid_part(workspace_).loaded, before);
    table_.run(workspace_, "humanoid.load.cancel", Json::object());
    EXPECT_FALSE(lab_.working(workspace_));
    table_.run(workspace_, "humanoid.cure", Json::object());
    wait();
    EXPECT_EQ(humanoid_part(workspace_).loaded->edits.size(), 1u);
    EXPECT_EQ(workspace_.history.undo_label(), "humanoid.cure");
    ASSERT_FALSE(workspace_.ui.toasts.empty());
    EXPECT_TRUE(test::says(workspace_.ui.toasts.back().text, "1 fault fixed none left"));
    // A character that arrives in the meantime stays.
    const auto other = std::make_shared<const LoadedCharacter>(*before);
    workspace_.document.edit<HumanoidPart>(humanoid_lab).loaded = before;
    table_.run(workspace_, "humanoid.cure", Json::object());
    workspace_.document.edit<HumanoidPart>(humanoid_lab).loaded = other;
    wait();
    EXPECT_EQ(humanoid_part(workspace_).loaded, other);
    EXPECT_TRUE(test::says(workspace_.ui.toasts.back().text, "character has changed"));
}

TEST_F(HumanoidLoading, TheLastOfSeveralLoadsWins) {
    load(large_bvh(20));
    load(large_bvh(14));
    wait();
    EXPECT_EQ(humanoid_part(workspace_).skeleton().size(), 14u);
    load(large_bvh(20));
    table_.run(workspace_, "humanoid.load", Json::object());  // the stick figure: at once, and it stays
    wait();
    EXPECT_TRUE(is_stick_figure());
}

}  // namespace
}  // namespace tendril::app
