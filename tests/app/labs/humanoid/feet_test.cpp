// Grounds, and feet on them, by the lab's commands and --state.
#include <fstream>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "humanoid_support.hpp"
#include "tests/app/io/gltf_text.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

constexpr double millimetre = 1e-3;

class HumanoidFeet : public HumanoidTest {
  protected:
    Json foot(std::size_t side) const { return state().at("feet").at(side); }

    /// A walk of four rounds: no planted foot sinks below `height`, floats above it or skates.
    void expect_walks_on(double (*height)(double z)) {
        run("humanoid.foot_ik", {{"on", true}});
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        std::array<std::optional<glm::dvec3>, 2> planted;
        int steps = 0;
        for (int i = 0; i < 264; ++i) {
            tick();
            for (std::size_t side = 0; side < 2; ++side) {
                const Json now = foot(side);
                const glm::dvec3 heel = vector(now.at("heel")), toe = vector(now.at("toe"));
                const double over =
                    std::min(heel.y - height(heel.z), toe.y - height(toe.z));  // the lower of the two
                if (!now.at("planted").get<bool>()) {
                    planted[side].reset();
                    continue;
                }
                EXPECT_GT(over, -5.0 * millimetre) << "tick " << i << ", side " << side;
                EXPECT_LT(over, 5.0 * millimetre) << "tick " << i << ", side " << side;
                if (planted[side]) {
                    const glm::dvec3 moved = toe - *planted[side];
                    EXPECT_LT(std::hypot(moved.x, moved.z), 5.0 * millimetre) << "tick " << i;
                } else {
                    ++steps;
                    planted[side] = toe;
                }
            }
        }
        EXPECT_GE(steps, 7);
    }
};

TEST_F(HumanoidFeet, TouchTheGroundWithHeelAndToe) {
    const Json feet = state().at("feet");
    ASSERT_EQ(feet.size(), 2u);
    EXPECT_EQ(feet[0].at("side"), "left");
    EXPECT_EQ(feet[1].at("side"), "right");
    for (const Json& each : feet) {
        EXPECT_FALSE(each.at("planted").get<bool>());
        EXPECT_NEAR(vector(each.at("heel")).y, 0.0, 1e-3);
        EXPECT_NEAR(vector(each.at("toe")).y, 0.0, 1e-3);
        EXPECT_GT(vector(each.at("toe")).z, vector(each.at("heel")).z);
    }
}

TEST_F(HumanoidFeet, WithoutIkFollowTheClip) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.4}});
    const Json before = state().at("character");
    run("humanoid.ground", {{"kind", "stairs"}});
    run("humanoid.foot_ik", {{"on", false}});
    EXPECT_EQ(state().at("character"), before);
    run("humanoid.ground", {{"kind", "none"}});
    run("humanoid.foot_ik", {{"on", true}});
    EXPECT_EQ(state().at("character"), before) << "without a ground to the bit";
    EXPECT_EQ(foot(0).at("left_alone"), "there is no ground");
    run("humanoid.foot_ik", {{"on", false}});
    EXPECT_EQ(state().at("character"), before);
}

/// Rising ground must not bury a character that has walked far, and the camera follows it.
TEST_F(HumanoidFeet, RestartWhereTheGroundRises) {
    for (const char* kind : {"stairs", "terrain"}) {
        run("humanoid.ground", {{"kind", "flat"}});
        run("humanoid.foot_ik", {{"on", false}});
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        for (int i = 0; i < 1200; ++i) tick();
        const glm::dvec3 far = vector(state().at("character").at("bones").at("Hips").at("position"));
        ASSERT_GT(far.z, 15.0);
        const auto beside = [&] {
            const glm::dvec3 hips = vector(state().at("character").at("bones").at("Hips").at("position"));
            return glm::distance(hips, glm::dvec3(workspace.camera.target));
        };
        const double before = beside();
        run("humanoid.ground", {{"kind", kind}});
        for (int i = 0; i < 240; ++i) {
            EXPECT_LT(beside(), before + 0.5) << kind << ' ' << i;
            tick();
        }
        EXPECT_LT(vector(state().at("character").at("bones").at("Hips").at("position")).z, 6.0) << kind;
        EXPECT_TRUE(state().at("foot_ik").at("on").get<bool>());
    }
}

TEST_F(HumanoidFeet, WalkUpStairs) {
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.15}, {"step_depth", 0.4}});
    EXPECT_EQ(state().at("ground").at("kind"), "stairs");
    EXPECT_EQ(state().at("ground").at("step_depth"), 0.4);
    expect_walks_on([](double z) { return 0.15 * std::floor(std::max(0.0, z) / 0.4); });
}

/// A turntable's camera passes through steep stairs.
TEST_F(HumanoidFeet, StairsDoNotStandBetweenTheEyeAndTheFigure) {
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.3}, {"step_depth", 0.3}});
    const glm::vec3 hips(bone("Hips"));
    for (const float yaw : {0.0f, 1.5f, 3.0f, 3.3f, 4.5f}) {
        const CameraPose pose{.target = hips, .yaw = yaw, .pitch = 0.2f, .distance = 3.9f};
        const glm::vec3 eye = Camera(pose, {{0.0f, 0.0f}, {1000.0f, 700.0f}}).eye();
        const Mesh mesh = drawn(pose).mesh;
        EXPECT_GT(mesh.indices.size(), 100u) << "most stairs are drawn";
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto at = [&](std::size_t k) { return mesh.vertices[mesh.indices[i + k]].position; };
            const glm::vec3 met =
                glm::inverse(glm::mat3(at(1) - at(0), at(2) - at(0), eye - hips)) * (eye - at(0));
            EXPECT_FALSE(met.x >= 0.0f && met.y >= 0.0f && met.x + met.y <= 1.0f && met.z > 0.0f &&
                         met.z < 1.0f)
                << yaw;
        }
    }
}

/// Two triangles, 40 m wide, rising by 0.2 m from z = -20 to z = 20, as a text glTF.
std::string ramp() {
    test_gltf::GltfText file;
    const std::string corners = file.vectors({-20, 0, -20, 20, 0, -20, -20, 0.2f, 20, 20, 0.2f, 20}),
                      triangles = file.add<unsigned short>("SCALAR", 1, {0, 2, 1, 1, 2, 3});
    file.members = R"("nodes":[{"mesh":0,"translation":[0,0.1,0]}],"meshes":[{"primitives":[{"attributes":)"
                   R"({"POSITION":)" +
                   corners + R"(},"indices":)" + triangles + "}]}]";
    return file.gltf();
}

TEST_F(HumanoidFeet, WalkOnAMeshFromAFile) {
    const std::string path = write("ramp.gltf", ramp());
    run("humanoid.ground", {{"kind", "mesh"}, {"path", path}});
    EXPECT_EQ(state().at("ground").at("path"), path);
    expect_walks_on([](double z) { return 0.1 + 0.2 * (z + 20.0) / 40.0; });
    EXPECT_EQ(lab().state(reopened()), state());
    EXPECT_EQ(opened_with("/ik/ground/file", nullptr), "") << "older scenes have the path alone";
    EXPECT_EQ(part().files(), std::vector<std::filesystem::path>{path});
    std::filesystem::remove(path);
    EXPECT_TRUE(test::says(opened_with("/t_pose", false), "blank: ramp.gltf is missing"));
    run("humanoid.ground", {{"kind", "none"}});
    expect_refused("humanoid.ground", {{"kind", "mesh"}, {"path", "nowhere.glb"}},
                   {"nowhere.glb", "no such"});
    expect_refused("humanoid.ground", {{"path", "a.obj"}}, {"a.obj", ".glb"});
    run("humanoid.load");
    expect_refused("humanoid.ground", {{"kind", "mesh"}}, {"path is missing"});
}

TEST_F(HumanoidFeet, InPlaceMoveBackwardsWithTheGround) {
    run("humanoid.ground", {{"kind", "flat"}});
    run("humanoid.foot_ik", {{"on", true}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}, {"in_place", true}});
    int planted = 0;
    std::optional<double> last;
    for (int i = 0; i < 200; ++i) {
        tick();
        const Json now = foot(0);
        const double z = vector(now.at("toe")).z;
        if (now.at("planted").get<bool>() && last) {
            EXPECT_NEAR(z - *last, -1.0 / 60.0, 2.0 * millimetre) << i;
            ++planted;
        }
        last = now.at("planted").get<bool>() ? std::optional(z) : std::nullopt;
    }
    EXPECT_GT(planted, 30);
}

/// A walk in place whose feet slide under still hips: none is ever slow enough to be planted.
TEST_F(HumanoidFeet, ExplainWhyTheyNeverStand) {
    run("humanoid.load", {{"path", treadmill_figure(folder_.path())}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    run("humanoid.ground", {{"kind", "flat"}});
    run("humanoid.foot_ik", {{"on", true}});
    tick(100);
    while (foot(0).at("planted").get<bool>() || foot(1).at("planted").get<bool>()) tick();
    EXPECT_TRUE(test::says(foot(0).at("why_in_air"), "walks in place slide 1.0 m/s Travel"));
    run("view.fold", {{"section", "humanoid: Ground and feet"}, {"folded", false}});
    const std::string text = test::PanelReader().panel(lab(), workspace);
    const std::size_t first = text.find("walks in place");
    EXPECT_NE(first, text.npos) << text;
    EXPECT_EQ(text.find("walks in place", first + 1), text.npos) << "once for both feet";

    // Following the advice works.
    run("humanoid.foot_ik", {{"leave_speed", 4}, {"enter_speed", 3}});
    bool planted = false;
    for (int i = 0; i < 150; ++i) {
        tick();
        planted = planted || foot(0).at("planted").get<bool>();
        EXPECT_EQ(foot(0).at("why_in_air"), "");
    }
    EXPECT_TRUE(planted);
    // A walk that travels has no such fault.
    run("humanoid.load");
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    run("humanoid.foot_ik", {{"on", true}, {"enter_speed", 0.3}, {"leave_speed", 1}});
    for (int i = 0; i < 60; ++i) {
        tick();
        EXPECT_EQ(foot(1).at("why_in_air"), "");
    }
}

/// The marks of planted feet lie on the ground: none bridges two treads or hangs in the air.
TEST_F(HumanoidFeet, AreMarkedWhereTheyTouchTheGround) {
    const auto height = [](double z) { return 0.16 * std::floor(std::max(0.0, z) / 0.36); };
    run("humanoid.ground", {{"kind", "stairs"}, {"step_height", 0.16}, {"step_depth", 0.36}});
    run("humanoid.foot_ik", {{"on", true}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    const glm::vec4 colour(palette(Theme::Dark).tail, 1.0f);
    int marks = 0;
    for (int i = 0; i < 264; ++i) {
        tick();
        const DrawList list = drawn();
        const bool planted = foot(0).at("planted").get<bool>() || foot(1).at("planted").get<bool>();
        int now = 0;
        for (const Stroke& stroke : list.strokes) {
            if (stroke.layer != Layer::Overlay || stroke.colour != colour) continue;
            ++now;
            for (const float t : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
                const glm::dvec3 at(glm::mix(stroke.a, stroke.b, t));
                EXPECT_NEAR(at.y, height(at.z), 0.03) << "tick " << i << " at z " << at.z;
            }
        }
        EXPECT_EQ(now > 0, planted) << "tick " << i;
        marks += now;
    }
    EXPECT_GT(marks, 200);
}

TEST_F(HumanoidFeet, NeedNoTimeAndLetTheWindowIdle) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.3}});
    run("humanoid.ground", {{"kind", "stairs"}});
    run("humanoid.foot_ik", {{"on", true}});
    EXPECT_FALSE(lab().moving(workspace));
    const Json before = state();
    lab().step(workspace);
    EXPECT_EQ(state(), before);
}

TEST_F(HumanoidFeet, RefuseValuesOutOfRange) {
    expect_refused("humanoid.foot_ik", {{"on", true}, {"enter_speed", 2}, {"leave_speed", 1}},
                   {"leave_speed must be at least enter_speed"});
    run("humanoid.foot_ik", {{"enter_speed", 2}});
    EXPECT_EQ(part().ik.foot_ik.options.leave_speed, 2.0) << "the other goes along";
    run("humanoid.foot_ik", {{"leave_speed", 0.25}});
    EXPECT_EQ(part().ik.foot_ik.options.enter_speed, 0.25);
    run("humanoid.map", {{"bone", "LeftFoot"}});
    expect_refused("humanoid.foot_ik", {{"on", true}}, {"LeftFoot is missing"});
    run("humanoid.foot_ik", {{"on", false}});
    EXPECT_TRUE(state().at("feet").empty());
}

TEST_F(HumanoidFeet, OnTheGroundCarryABodyThatReaches) {
    run("humanoid.ground", {{"kind", "slope"}, {"angle_deg", 15}});
    run("humanoid.foot_ik", {{"on", true}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    tick(60);
    run("humanoid.clip", {{"play", false}});
    tick(60);
    const Json before = state().at("feet");
    const glm::dvec3 hand = bone("LeftHand") + glm::dvec3(0.1, 0.3, 0.2);
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {hand.x, hand.y, hand.z}}});
    EXPECT_LT(glm::distance(bone("LeftHand"), hand), 1e-3);
    for (std::size_t side = 0; side < 2; ++side)
        EXPECT_LT(glm::distance(vector(foot(side).at("toe")), vector(before[side].at("toe"))), 1e-3)
            << "feet stay where the ground has them";
}

// A moment of a clip with foot IK looks the same whether it is played, scrubbed to or exported.

constexpr double tenth_of_a_millimetre = 1e-4;

class HumanoidFeetHistory : public HumanoidTest {
  protected:
    std::vector<humanoid::Placement> shown() const { return shown_pose(workspace).placed; }
    double seconds() const {
        const Playback& playback = part().playback;
        return static_cast<double>(playback.rounds) * part().clip()->duration + playback.time;
    }
    static double apart(const std::vector<humanoid::Placement>& a,
                        const std::vector<humanoid::Placement>& b) {
        double most = a.size() == b.size() ? 0.0 : 1e9;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            most = std::max(most, glm::distance(a[i].position, b[i].position));
        return most;
    }
    /// The poses drawn at moments of the clip while it plays.
    std::vector<std::pair<double, std::vector<humanoid::Placement>>> played(int ticks) {
        std::vector<std::pair<double, std::vector<humanoid::Placement>>> moments;
        for (int i = 0; i < ticks; ++i) {
            tick();
            moments.emplace_back(seconds(), shown());
        }
        return moments;
    }
    void put_on(const Json& ground, const char* clip, double speed, bool in_place = false) {
        run("humanoid.load");
        run("humanoid.ground", ground);
        run("humanoid.foot_ik", {{"on", true}});
        run("humanoid.clip",
            {{"name", clip}, {"time", 0}, {"speed", speed}, {"in_place", in_place}, {"play", true}});
    }
    const std::vector<Json> grounds{{{"kind", "stairs"}, {"step_height", 0.16}, {"step_depth", 0.36}},
                                    {{"kind", "slope"}, {"angle_deg", 18}},
                                    {{"kind", "slope"}, {"angle_deg", -15}},
                                    {{"kind", "terrain"}}};
};

LABEL(slow, "HumanoidFeetHistory.IsTheSameAfterMinutes");

TEST_F(HumanoidFeetHistory, LooksScrubbedAsItWasPlayed) {
    for (const Json& ground : grounds)
        for (const char* clip : {"walk", "punch"})
            for (const double speed : {0.37, 1.7}) {
                put_on(ground, clip, speed);
                const auto moments = played(200);
                for (std::size_t i = 0; i < moments.size(); i += 7) {
                    // Out of order, as when scrubbing by hand.
                    const auto& [time, pose] = moments[(i * 61) % moments.size()];
                    run("humanoid.clip", {{"time", time}, {"play", false}});
                    EXPECT_LT(apart(shown(), pose), tenth_of_a_millimetre)
                        << ground << ' ' << clip << " at " << time << " s, speed " << speed;
                }
            }
}

TEST_F(HumanoidFeetHistory, LooksTheSameInPlace) {
    put_on({{"kind", "flat"}}, "walk", 0.8, true);
    const auto moments = played(300);
    for (std::size_t i = 0; i < moments.size(); i += 11) {
        run("humanoid.clip", {{"time", moments[i].first}, {"play", false}});
        EXPECT_LT(apart(shown(), moments[i].second), tenth_of_a_millimetre) << moments[i].first;
    }
}

TEST_F(HumanoidFeetHistory, IsExportedAsItIsShown) {
    const std::string file = path("out.glb");
    for (const Json& ground : grounds)
        for (const char* clip : {"walk", "punch"})
            for (const double fps : {60.0, 24.0}) {
                put_on(ground, clip, 1.0);
                run("humanoid.export", {{"path", file}, {"fps", fps}});
                const SharedCharacter read = load_character(file);
                const humanoid::Clip& written = read->clips().front();
                for (int i = 0; i / fps <= written.duration; i += 3) {
                    const double time = i / fps;
                    run("humanoid.clip", {{"time", time}, {"play", false}});
                    const auto placed = test_posed::placed(read->character, 0, time);
                    for (std::size_t node = 0; node < part().skeleton().size(); ++node) {
                        const std::string& name = part().skeleton()[node].name;
                        EXPECT_LT(glm::distance(placed[*read->skeleton().find(name)].position,
                                                shown()[node].position),
                                  tenth_of_a_millimetre)
                            << ground << ' ' << clip << ' ' << name << " at " << time << " s, " << fps;
                    }
                }
            }
}

/// The past is bounded: a moment after minutes costs at most two blocks, and looks as it did when played.
TEST_F(HumanoidFeetHistory, IsTheSameAfterMinutes) {
    put_on({{"kind", "flat"}}, "walk", 10.0);
    const auto moments = played(900);  // two and a half minutes of the clip
    ASSERT_GT(moments.back().first, 4.0 * FeetHistory::block_ticks * tick_seconds);
    for (std::size_t i = 0; i < moments.size(); i += 97) {
        run("humanoid.clip", {{"time", moments[i].first}, {"play", false}});
        EXPECT_LT(apart(shown(), moments[i].second), tenth_of_a_millimetre) << moments[i].first;
        EXPECT_LT(apart(shown_pose(reopened()).placed, moments[i].second), tenth_of_a_millimetre);
    }
}

// Feet that pass through the ground: planted soles stand on treads, and steps that are too fast are reported.

class FootDepth : public HumanoidTest {
  protected:
    const ShownPose& shown() const { return shown_pose(workspace); }
    /// The depth of points along the line from heel to toe.
    double depth(std::size_t side, int points) {
        const humanoid::SolePoints& sole = shown().soles[side];
        const humanoid::Ground& ground = humanoid_runtime(workspace).solvers.ground(part());
        double deepest = 0.0;
        for (int i = 0; i <= points; ++i) {
            const glm::dvec3 at = glm::mix(sole.heel, sole.toe, static_cast<double>(i) / points);
            if (const auto hit = ground.below(at + glm::dvec3(0.0, 0.5, 0.0)))
                deepest = std::max(deepest, hit->height - at.y);
        }
        return deepest;
    }
    void stairs(double height, double deep) {
        run("humanoid.ground", {{"kind", "stairs"}, {"step_height", height}, {"step_depth", deep}});
        run("humanoid.foot_ik", {{"on", true}});
    }
};

TEST_F(FootDepth, IsReportedWithItsCause) {
    stairs(0.2, 0.25);
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    bool told = false;
    for (int i = 0; i < 400 && !told; ++i) {
        tick();
        const Verdict verdict = humanoid_verdict(workspace);
        told = test::says(verdict.text, "foot mm in the ground") &&
               test::says(verdict.why, "too fast for the stairs");
    }
    EXPECT_TRUE(told);
    run("humanoid.ground", {{"kind", "flat"}});
    tick(100);
    EXPECT_EQ(humanoid_verdict(workspace).text, "Complete body");
}

TEST_F(FootDepth, IsZeroInTheOpening) {
    for (const CommandCall& each : lab().opening()) run(each.name.c_str(), to_json(each.arguments));
    for (int i = 0; i < 600; ++i) {
        tick();
        if (i % 10 == 0) {
            ASSERT_EQ(humanoid_verdict(workspace).text, "Complete body") << "tick " << i;
        }
    }
}

/// Ten third-party clips, if present: no foot is deeper in the ground than the verdict says.
TEST_F(FootDepth, OfThirdPartyClipsIsAlwaysReported) {
    const auto folder = test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    const std::vector<std::pair<std::string, std::size_t>> clips{
        {"cmu_01_01.bvh", 0},    {"cmu_12_01_walk.bvh", 0}, {"human_clip.glb", 0}, {"robot.glb", 6},
        {"robot.glb", 10},       {"robot.glb", 11},         {"pab_walk.fbx", 0},   {"cesium_man.gltf", 0},
        {"mixed_orders.bvh", 0}, {"rigify_names.glb", 0}};
    for (const auto& [file, clip] : clips) {
        if (!std::filesystem::exists(folder / file)) continue;
        SCOPED_TRACE(file);
        run("humanoid.load", {{"path", (folder / file).string()}});
        if (humanoid_runtime(workspace).solvers.feet(part()) == nullptr ||
            part().loaded->clips().size() <= clip)
            continue;
        for (const char* kind : {"slope", "stairs"}) {
            run("humanoid.ground", {{"kind", kind}});
            run("humanoid.foot_ik", {{"on", true}});
            run("humanoid.clip", {{"index", clip}, {"time", 0.0}, {"play", true}});
            for (int i = 0; i < 240; ++i) {
                tick();
                if (!shown().feet) continue;
                for (std::size_t side = 0; side < 2; ++side)
                    if (shown().feet->feet[side].alone == humanoid::FootAlone::No &&
                        depth(side, 1) > max_depth + 1e-6) {
                        EXPECT_TRUE(test::says(humanoid_verdict(workspace).text, "foot mm in the ground"))
                            << kind << " tick " << i << ": " << humanoid_verdict(workspace).text;
                    }
            }
        }
    }
}

}  // namespace
}  // namespace tendril::app
