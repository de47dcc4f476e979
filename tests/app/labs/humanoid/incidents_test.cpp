// The Humanoid lab's marks on its strip: flips, with bone and cause, and none for correct motion.
#include <chrono>
#include <glm/trigonometric.hpp>
#include <map>
#include <random>
#include <thread>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "tests/app/labs/humanoid/humanoid_support.hpp"
#include "tests/app/support/full_scenes.hpp"

namespace tendril::app {
namespace {

using Kind = Incident::Kind;

class HumanoidIncidents : public HumanoidTest {
  protected:
    static std::vector<Incident> only(Kind kind, std::vector<Incident> all) {
        std::erase_if(all, [&](const Incident& each) { return each.kind != kind; });
        return all;
    }
    std::vector<Incident> ticked() {
        const auto before = now();
        tick();
        return since(before);
    }
    void target(const char* effector, const glm::dvec3& to) {
        run("humanoid.target", {{"effector", effector}, {"to", {to.x, to.y, to.z}}});
    }
    /// Moves an effector there and returns the new marks.
    std::vector<Incident> moved(const char* effector, const glm::dvec3& to) {
        return incidents_of("humanoid.target", {{"effector", effector}, {"to", {to.x, to.y, to.z}}});
    }
    /// The global rotation of each bone in degrees, computed independently.
    static std::map<std::string, double> turns(const Json& was, const Json& is) {
        std::map<std::string, double> turns;
        for (const auto& [name, bone] : is.items()) {
            const glm::dquat a = quaternion(was.at(name).at("rotation")), b = quaternion(bone.at("rotation"));
            turns[name] = glm::degrees(2.0 * std::acos(std::min(1.0, std::abs(glm::dot(a, b)))));
        }
        return turns;
    }
    /// Moves the left hand in front of the shoulder, so close that a tiny motion puts it behind.
    glm::dvec3 fold_left_arm() {
        const glm::dvec3 shoulder = bone("LeftUpperArm");
        target("left_hand", shoulder + glm::dvec3(0, 0, 0.012));
        run("humanoid.hand_ik", {{"on", true}, {"view_deg", 180}});
        for (int i = 0; i < 60; ++i) tick();
        return shoulder;
    }
};

TEST_F(HumanoidIncidents, AnArmThatFlipsIsMarkedWithItsBoneAndCause) {
    const glm::dvec3 shoulder = fold_left_arm();
    EXPECT_TRUE(only(Kind::Flip, ticked()).empty());
    const Json was = bones();
    const auto flips = only(Kind::Flip, moved("left_hand", shoulder - glm::dvec3(0, 0, 0.012)));
    const auto turned = turns(was, bones());
    EXPECT_NEAR(turned.at("LeftHand"), 180.0, 1.0) << "it goes along with the arm";
    EXPECT_LT(turned.at("RightUpperArm"), 1.0);
    ASSERT_EQ(flips.size(), 1u) << "one of what turned together";
    EXPECT_EQ(flips[0].name, "LeftUpperArm") << "the one nearest to the hips";
    EXPECT_EQ(flips[0].joint, *part().node_of(humanoid::Bone::LeftUpperArm));
    EXPECT_NEAR(static_cast<double>(flips[0].degrees), turned.at("LeftUpperArm"), 0.1);
    EXPECT_TRUE(test::says(flips[0].cause, "target left shoulder"));
}

/// After any change of the body's state: the bone that rotated the furthest is marked, and no other limb.
TEST_F(HumanoidIncidents, PlantedFlipsAreMarkedAtTheBoneThatRotatedFurthest) {
    target("left_hand", {0.35, 1.3, 0.35});
    target("right_foot", {-0.15, 0.25, 0.3});
    for (int i = 0; i < 60; ++i) tick();
    const std::shared_ptr<const Part> calm = now();
    const Json was = bones();
    const humanoid::Body* const body = humanoid_runtime(workspace).solvers.body(part());
    const std::vector<humanoid::Bone> order = body->bones();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> degrees(60.0, 170.0);
    int marked = 0;
    for (int round = 0; round < 150; ++round) {
        HumanoidPart& edited = workspace.document.edit<HumanoidPart>(humanoid_lab);
        edited = dynamic_cast<const HumanoidPart&>(*calm);
        const std::size_t at = random() % order.size();
        edited.ik_state.body.turns[at] = glm::angleAxis(glm::radians(degrees(random)), glm::dvec3(0, 1, 0)) *
                                         edited.ik_state.body.turns[at];
        const auto turned = turns(was, bones());
        const auto furthest = std::ranges::max_element(
            turned, [](const auto& a, const auto& b) { return a.second < b.second; });
        const auto flips = only(Kind::Flip, since(calm));
        const std::string where = std::to_string(round) + ": " + furthest->first;
        if (furthest->second < 29.9) {
            EXPECT_TRUE(flips.empty()) << where;
        } else if (furthest->second > 30.1) {
            ++marked;
            const bool told = std::ranges::any_of(flips, [&](const Incident& each) {
                return std::abs(turned.at(each.name) - furthest->second) < 0.1;
            });
            EXPECT_TRUE(told) << where << " turned " << furthest->second;
        }
        for (const Incident& each : flips) {
            EXPECT_GT(turned.at(each.name), 29.9) << where;
            EXPECT_NEAR(static_cast<double>(each.degrees), turned.at(each.name), 0.1) << where;
            EXPECT_FALSE(each.cause.empty());
        }
    }
    EXPECT_GT(marked, 15);
}

TEST_F(HumanoidIncidents, CorrectMotionHasNoFlips) {
    for (const test::TestScene& scene : test::test_scenes(lab())) {
        workspace = make_blank_workspace(labs);
        for (const CommandCall& call : scene.commands) run(call.name.c_str(), to_json(call.arguments));
        std::size_t others = 0;
        for (int i = 0; i < 300; ++i) {
            const auto marks = ticked();
            EXPECT_TRUE(only(Kind::Flip, marks).empty()) << scene.name << ", tick " << i;
            others += marks.size();
        }
        EXPECT_LE(others, 30u) << scene.name;
    }
}

TEST_F(HumanoidIncidents, FastRotationsOfAClipOrAReleaseAreNoFlips) {
    double fastest = 0.0;
    const auto none = [&](int ticks) {
        for (int i = 0; i < ticks; ++i) {
            const Json was = bones();
            EXPECT_TRUE(only(Kind::Flip, ticked()).empty()) << i;
            for (const auto& [name, degrees] : turns(was, bones())) fastest = std::max(fastest, degrees);
        }
    };
    run("humanoid.clip", {{"name", "punch"}, {"play", true}, {"speed", 10}});
    none(30);
    EXPECT_GT(fastest, 31.0);
    run("humanoid.clip", {{"name", "walk"}, {"play", true}, {"speed", 0.1}, {"in_place", true}});
    target("left_hand", bone("LeftUpperArm") + glm::dvec3(0.1, 0.6, 0.1));
    tick();
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 0}});
    workspace.clock.speed = 4.0f;
    fastest = 0.0;
    none(5);
    EXPECT_GT(fastest, 31.0);
}

TEST_F(HumanoidIncidents, OnlyMovesOfATargetCount) {
    const glm::dvec3 shoulder = fold_left_arm();
    target("left_hand", shoulder + glm::dvec3(0.3, 0, 0.3));
    const auto none = [&](const char* command, const Json& arguments) {
        return incidents_of(command, arguments).empty();
    };
    EXPECT_TRUE(none("humanoid.hand_ik", {{"on", false}}));
    EXPECT_TRUE(none("humanoid.t_pose", {{"on", true}}));
    EXPECT_TRUE(none("humanoid.clip", {{"name", "walk"}, {"time", 0.4}}));
    EXPECT_TRUE(none("humanoid.clip", {{"time", 0.9}}));
    EXPECT_TRUE(none("humanoid.load", Json::object()));
}

TEST_F(HumanoidIncidents, AnEffectorThatFallsShortAndALimitAreReported) {
    target("left_hand", bone("LeftHand"));
    const auto all = moved("left_hand", {1.5, 2.2, 0.5});
    const auto falls = only(Kind::Status, all), limits = only(Kind::Limit, all);
    ASSERT_EQ(falls.size(), 1u);
    EXPECT_EQ(falls[0].cause.find("left hand fell short of its target: "), 0u) << falls[0].cause;
    EXPECT_EQ(falls[0].joint, *part().node_of(humanoid::Bone::LeftHand));
    const Json chains = state().at("chains");
    ASSERT_FALSE(limits.empty());
    for (const Incident& each : limits) {
        const bool active = std::ranges::any_of(chains, [&](const Json& chain) {
            const Json& names = chain.at("active_limits");
            return std::ranges::find(names, Json(each.name)) != names.end();
        });
        EXPECT_TRUE(active) << each.name;
    }
    EXPECT_TRUE(only(Kind::Status, moved("left_hand", {1.6, 2.2, 0.5})).empty()) << "it was short before";
}

/// In a file with meaningless node names, mapped nodes are called by their bones' names.
TEST_F(HumanoidIncidents, BonesAreCalledByTheirOwnNames) {
    run("humanoid.load", {{"path", numbered_figure(folder_.path())}});
    run("humanoid.clip", {{"name", ""}});
    ASSERT_EQ(bones().at("LeftUpperArm").at("node").get<std::string>().find("Node_"), 0u);
    const glm::dvec3 shoulder = fold_left_arm();
    const auto flips = only(Kind::Flip, moved("left_hand", shoulder - glm::dvec3(0, 0, 0.012)));
    ASSERT_EQ(flips.size(), 1u);
    EXPECT_EQ(flips[0].name, "LeftUpperArm");
    run("view.humanoid_plot", {{"of", "swing"}});
    EXPECT_EQ(state().at("past").at("plot").at("name"), "swing of LeftLowerArm");
}

TEST_F(HumanoidIncidents, TheRuleIsSettable) {
    const glm::dvec3 shoulder = fold_left_arm();
    EXPECT_EQ(only(Kind::Flip, moved("left_hand", shoulder - glm::dvec3(0, 0, 0.012))).size(), 1u);
    run("humanoid.flips", {{"degrees", 180}});
    EXPECT_EQ(only(Kind::Flip, moved("left_hand", shoulder + glm::dvec3(0, 0, 0.012))).size(), 0u);
}

// Large files load in the background: the old character stays until then; scripts need no ticks.

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
