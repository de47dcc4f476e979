// Joint limits: drawn as the solver uses them, learned from clips, adopted for all joints or one.
#include <array>
#include <tendril/humanoid/balance.hpp>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

using humanoid::BodyJoints;
using humanoid::Bone;

class HumanoidLimits : public HumanoidTest {
  protected:
    HumanoidLimits() : colours_(palette(Theme::Dark)) {}

    Solvers& solvers() { return humanoid_runtime(workspace).solvers; }
    DrawList drawn() { return HumanoidTest::drawn({.target = {0.0f, 0.9f, 0.0f}, .distance = 3.6f}); }
    /// Directions of the bone along the outlines of that colour, in the world.
    std::vector<glm::dvec3> outline(glm::vec3 colour) {
        const DrawList list = drawn();
        std::vector<glm::dvec3> directions;
        for (std::size_t i = 0; i + 2 < list.veil.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) { return list.veil.vertices[list.veil.indices[i + k]]; };
            if (corner(0).colour != colour) continue;
            for (const std::size_t k : {1u, 2u})
                directions.push_back(glm::normalize(glm::dvec3(corner(k).position - corner(0).position)));
        }
        return directions;
    }
    /// By how much the limits are exceeded if the bone swings from rest to this direction, or `times` as far.
    double excess(const BodyJoints& joints, Bone bone, const glm::dvec3& direction, double times) {
        std::vector<humanoid::Placement> placed = shown_pose(workspace).placed;
        const Bone above = *joints.parent(bone);
        const glm::dquat parent =
            placed[*part().node_of(above)].rotation() * glm::conjugate(joints.rest_rotation(above));
        const glm::dvec3 rest = parent * joints.direction(bone);
        const glm::dvec3 axis = glm::normalize(glm::cross(rest, direction));
        const double angle = std::acos(std::clamp(glm::dot(rest, direction), -1.0, 1.0));
        const glm::dquat turn = glm::angleAxis(times * angle, axis);
        placed[*part().node_of(bone)].axes = glm::mat3_cast(turn * parent * joints.rest_rotation(bone));
        return static_cast<double>(joints.excess(bone, placed));
    }
    void expect_outline(const BodyJoints& joints, Bone bone, glm::vec3 colour, bool swings) {
        const auto points = outline(colour);
        ASSERT_FALSE(points.empty()) << humanoid::name(bone);
        for (const glm::dvec3& direction : points) {
            EXPECT_LT(excess(joints, bone, direction, 1.0), 1e-4) << humanoid::name(bone);
            if (!swings) continue;  // only the ends of a fan are on the bound
            EXPECT_EQ(excess(joints, bone, direction, 0.99), 0.0) << humanoid::name(bone);
            EXPECT_GT(excess(joints, bone, direction, 1.01), 1e-4) << humanoid::name(bone);
        }
    }
    void select(const char* node) { run("humanoid.select", {{"node", node}}); }
    Json joint() { return state().at("body").at("joint"); }

    const Palette& colours_;
};

TEST_F(HumanoidLimits, AreDrawnWhereTheSolverHasThem) {
    run("humanoid.clip", {{"name", "punch"}, {"time", 0.4}});
    const auto defaults = humanoid::default_limits(part().skeleton(), *part().map);
    const auto learned =
        humanoid::learned_limits(part().skeleton(), *part().map, part().loaded->clips(), defaults);
    const auto adult = *BodyJoints::make(part().skeleton(), *part().map, defaults),
               clips = *BodyJoints::make(part().skeleton(), *part().map, learned);
    for (const Bone bone : {Bone::LeftUpperArm, Bone::RightHand, Bone::LeftUpperLeg, Bone::RightFoot,
                            Bone::Spine, Bone::RightLowerArm}) {
        select(humanoid::name(bone));
        ASSERT_FALSE(joint().is_null());
        const bool swings = bone != Bone::RightLowerArm;
        // Beyond the limits in force it is red.
        const bool beyond = joint().at("excess_deg").get<double>() > 0.1;
        expect_outline(adult, bone, beyond ? colours_.limit : adult_colour(colours_), swings);
        if (!joint().at("clips").is_null()) expect_outline(clips, bone, clips_colour(colours_), swings);
    }
}

TEST_F(HumanoidLimits, AreDrawnAsTheViewSettingSays) {
    EXPECT_TRUE(drawn().veil.indices.empty()) << "nothing is selected";
    select("LeftUpperArm");
    const std::size_t one = drawn().strokes.size();
    EXPECT_FALSE(drawn().veil.indices.empty());
    run("humanoid.view", {{"limits", "all"}});
    const std::size_t all = drawn().strokes.size();
    EXPECT_GT(all, one + 500);
    run("humanoid.view", {{"limits", "none"}});
    EXPECT_TRUE(drawn().veil.indices.empty());
    EXPECT_LT(drawn().strokes.size(), one);
    EXPECT_EQ(humanoid_part(reopened()).view.limits, LimitsShown::None);
    select("Hips");
    run("humanoid.view", {{"limits", "selected"}});
    EXPECT_TRUE(drawn().veil.indices.empty()) << "the hips are where the body is";
    EXPECT_TRUE(joint().is_null());
    run("humanoid.map", {{"bone", "LeftHand"}});
    select("LeftUpperArm");
    EXPECT_TRUE(drawn().veil.indices.empty()) << "no body, no limits";
}

TEST_F(HumanoidLimits, ActiveOnesAreHighlighted) {
    const auto lit = [&] {
        std::size_t count = 0;
        const DrawList list = drawn();
        for (const Stroke& each : list.strokes)
            count += each.colour == faded(colours_, colours_.limit, 0.9f * 0.6f);
        return count;
    };
    EXPECT_EQ(lit(), 0u);
    for (const char* effector : {"hips", "head"}) run("humanoid.target", {{"effector", effector}});
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {-0.2, 1.4, -0.5}}});
    EXPECT_GT(lit(), 30u);
    select("LeftUpperArm");
    EXPECT_TRUE(joint().at("held").get<bool>());
    EXPECT_LT(joint().at("excess_deg").get<double>(), 0.1);
    std::size_t rings = 0;
    const DrawList list = drawn();
    for (const Stroke& each : list.strokes)
        rings += each.shade == Shade::Ring && glm::vec3(each.colour) == colours_.limit;
    EXPECT_EQ(rings, 1u);
}

TEST_F(HumanoidLimits, OfOneJointAreLearnedFromTheClips) {
    select("LeftUpperArm");
    const Json adult = joint().at("adult"), clips = joint().at("clips");
    EXPECT_LT(clips.at("up_deg").get<double>(), adult.at("up_deg").get<double>());
    run("humanoid.limits", {{"from", "motion"}, {"bone", "LeftUpperArm"}});
    EXPECT_EQ(joint().at("limits"), "motion");
    EXPECT_EQ(state().at("body").at("limits"), "defaults");
    EXPECT_EQ(state().at("body").at("joint_limits"), Json({{"LeftUpperArm", "motion"}}));
    const auto limit = [&](Bone bone) { return solvers().body(part())->joints().limit(bone); };
    EXPECT_NEAR(glm::degrees(limit(Bone::LeftUpperArm).up), clips.at("up_deg").get<float>(), 1e-3f);
    EXPECT_EQ(limit(Bone::RightUpperArm),
              humanoid::default_limits(part().skeleton(),
                                       *part().map)[static_cast<std::size_t>(Bone::RightUpperArm)]);
    EXPECT_EQ(lab().state(reopened()).at("body"), state().at("body"));
    run("undo");
    EXPECT_FALSE(state().at("body").contains("joint_limits"));
    run("humanoid.limits", {{"from", "motion"}, {"bone", "LeftUpperArm"}});
    run("humanoid.limits", {{"from", "none"}, {"bone", "Head"}});
    EXPECT_EQ(limit(Bone::Head).kind, ik::JointKind::Free);
    run("humanoid.limits", {{"from", "defaults"}, {"bone", "Head"}});
    EXPECT_EQ(part().ik.joint_limits.size(), 1u) << "as all others are";
    run("humanoid.limits", {{"from", "motion"}});
    EXPECT_TRUE(part().ik.joint_limits.empty());
    EXPECT_EQ(joint().at("limits"), "motion");
}

TEST_F(HumanoidLimits, RowsAreNamedAsTheLimbTurns) {
    test::PanelReader reader;
    for (const auto& [bone, rows] : {std::pair("LeftUpperArm", "adult clips up back twist"),
                                     {"RightUpperArm", "adult clips up forward twist"},
                                     {"LeftUpperLeg", "adult clips forward left twist"},
                                     {"LeftFoot", "adult clips up left twist"},
                                     {"Spine", "adult clips forward right twist"}}) {
        select(bone);
        EXPECT_TRUE(test::says(reader.inspector(lab(), workspace), rows)) << bone;
    }
}

TEST_F(HumanoidLimits, LearningIsRefusedWithoutData) {
    expect_refused("humanoid.limits", {{"from", "motion"}, {"bone", "Hips"}},
                   {"the Hips joint has no limits"});
    run("humanoid.map", {{"bone", "LeftToes"}});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bone", "LeftToes"}}, {"has no LeftToes"});
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    expect_refused("humanoid.limits", {{"from", "motion"}, {"bone", "Head"}},
                   {"no clip turns the Head joint"});
}

// Balance in the Humanoid lab: its switch, the panel's message, its file, its code and its picture.

class HumanoidBalanceLab : public HumanoidTest {
  protected:
    Json balance() { return state().at("body").at("balance"); }
    std::string text() { return balance().at("text").get<std::string>(); }
    double margin_now() {
        const ShownPose& shown = shown_pose(workspace);
        Solvers& solvers = humanoid_runtime(workspace).solvers;
        return humanoid::find_support(solvers.feet(part())->soles(), shown.soles)
            .margin(solvers.masses(part())->centre(shown.placed));
    }
    /// Drags a hand from its position, 2 cm at a time for a figure of 1.8 m.
    void drag(const char* effector, glm::dvec3 to) {
        const glm::dvec3 from =
            shown_pose(workspace)
                .placed[*part().node_of(humanoid::bone_of(*humanoid::effector_named(effector)))]
                .position;
        const double stride = 0.011 * part().loaded->height();
        const int steps = static_cast<int>(std::ceil(glm::distance(from, to) / stride)) + 1;
        for (int i = 1; i <= steps; ++i) {
            const glm::dvec3 at = glm::mix(from, to, static_cast<double>(i) / steps);
            run("humanoid.target", {{"effector", effector}, {"to", {at.x, at.y, at.z}}});
        }
    }
};

LABEL(slow, "HumanoidBalanceLab.CharactersThatOthersMadeStandNoWorseWithIt");

TEST_F(HumanoidBalanceLab, ThePanelSaysWhereTheCentreOfMassIs) {
    EXPECT_FALSE(balance().contains("text"));
    run("humanoid.balance", {{"on", true}});
    EXPECT_TRUE(test::says(text(), "cm inside the feet"));
    EXPECT_GT(balance().at("margin").get<double>(), 0.03);
    EXPECT_GE(balance().at("support").size(), 6u);
    const auto where = [&](glm::dvec3 by) {  // the margin of a body that is pulled along by its hips
        run("humanoid.target", {{"effector", "left_foot"}});
        run("humanoid.target", {{"effector", "right_foot"}});
        ShownPose shown = shown_pose(workspace);
        shown.balance->centre += by;
        shown.balance->margin = shown.balance->support.margin(shown.balance->centre);
        return balance_text(part(), shown, humanoid_runtime(workspace).solvers);
    };
    EXPECT_TRUE(test::says(where({0.0, 0.0, 0.3}), "cm ahead of the feet"));
    EXPECT_TRUE(test::says(where({0.0, 0.0, -0.3}), "cm behind the feet"));
    EXPECT_TRUE(test::says(where({0.4, 0.0, 0.0}), "cm left of the feet"));
    EXPECT_TRUE(test::says(where({-4.0, 0.0, 0.0}), "m right of the feet"));
}

TEST_F(HumanoidBalanceLab, TheGroundShowsTheSupportArea) {
    const std::size_t before = drawn().strokes.size();
    run("humanoid.balance", {{"on", true}});
    const std::size_t corners = balance().at("support").size();
    EXPECT_EQ(drawn().strokes.size(), before + corners + 3);  // the outline, a line and its two ends
}

TEST_F(HumanoidBalanceLab, AFootStepsWhileTheSimulationRuns) {
    run("humanoid.balance", {{"on", true}});
    const double ahead = node("LeftFoot").z;
    drag("right_hand", {-0.2, 1.0, 1.6});
    EXPECT_NEAR(std::max(node("LeftFoot").z, node("RightFoot").z), ahead, 0.03);  // no time has passed
    EXPECT_GT(shown_pose(workspace).residual(humanoid::Effector::RightHand).value(), 0.3);
    tick();
    tick();
    EXPECT_TRUE(balance().at("stepping").get<bool>());
    tick(8);
    const Workspace other = reopened();  // in the middle of a step
    EXPECT_EQ(humanoid_part(other).ik_state, part().ik_state);
    EXPECT_TRUE(test::says(lab().code(workspace),
                           "BodyOptions body_options .balance = true .feet = humanoid::FootShift"));
    tick(400);
    EXPECT_FALSE(balance().at("stepping").get<bool>());
    EXPECT_FALSE(lab().moving(workspace));
    EXPECT_LT(shown_pose(workspace).residual(humanoid::Effector::RightHand).value(), 0.03);
    EXPECT_TRUE(test::says(text(), "cm inside the feet"));
    EXPECT_GT(std::max(node("LeftFoot").z, node("RightFoot").z), ahead + 0.3);
    // Released, the feet step back.
    run("humanoid.target", {{"effector", "right_hand"}, {"weight", 0}});
    tick(400);
    EXPECT_FALSE(part().ik_state.steps.away());
    EXPECT_NEAR(node("RightFoot").z, ahead, 1e-6);
}

TEST_F(HumanoidBalanceLab, AStepIsNotAnIncident) {
    run("humanoid.balance", {{"on", true}});
    drag("right_hand", {-0.2, 1.0, 1.6});
    for (int i = 0; i < 400; ++i) {
        tick();
        const ShownPose& shown = shown_pose(workspace);
        if (part().ik_state.steps.stepping()) {
            EXPECT_EQ(text(), "stepping");
            EXPECT_EQ(balance_colour(part(), shown, palette(Theme::Dark)), palette(Theme::Dark).tail);
        } else {
            EXPECT_TRUE(test::says(text(), "inside the feet")) << i << ": " << text();
        }
    }
}

TEST_F(HumanoidBalanceLab, ItExplainsWhyItDoesNotAct) {
    const auto why = [&] { return balance().value("note", std::string()); };
    run("humanoid.balance", {{"on", true}});
    EXPECT_TRUE(test::says(why(), "acts once something has a target"));
    run("humanoid.target", {{"effector", "right_hand"}, {"to", {-0.2, 1.0, 0.5}}});
    EXPECT_EQ(why(), "");
    run("humanoid.hand_ik", {{"on", true}});
    EXPECT_TRUE(test::says(why(), "has no effect hand IK moves only the arms"));
    run("humanoid.target", {{"effector", "head"}});
    EXPECT_EQ(why(), "");
}

TEST_F(HumanoidBalanceLab, CharactersThatOthersMadeStandNoWorseWithIt) {
    const std::filesystem::path folder = test::characters_folder();
    if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
    int read = 0, righted = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string ending = entry.path().extension().string();
        if (ending != ".glb" && ending != ".gltf" && ending != ".fbx" && ending != ".bvh") continue;
        run("humanoid.load", {{"path", entry.path().string()}});
        run("humanoid.clip", {{"name", ""}});
        if (humanoid_runtime(workspace).solvers.masses(part()) == nullptr) continue;
        ++read;
        const humanoid::Facing facing = humanoid::facing(part().skeleton(), *part().map);
        const double height = part().loaded->height();
        const glm::dvec3 hand =
            shown_pose(workspace).placed[*part().node_of(humanoid::Bone::RightHand)].position;
        for (const auto& [ahead, left, up] :
             {std::array{0.5, 0.1, -0.1}, std::array{0.3, 0.0, -0.5}, std::array{0.1, -0.4, 0.0}}) {
            const glm::dvec3 to =
                hand + height * (ahead * facing.forward + left * facing.left + glm::dvec3(0.0, up, 0.0));
            std::array<double, 2> margins{};
            for (const bool on : {false, true}) {
                run("humanoid.balance", {{"on", on}, {"steps", false}});
                drag("right_hand", to);
                margins[on ? 1 : 0] = margin_now() / height;
                run("humanoid.target", {{"effector", "right_hand"}, {"weight", 0}});
            }
            EXPECT_GT(margins[1], std::min(margins[0], 0.0) - 0.005)
                << entry.path() << ": " << ahead << ' ' << left << ' ' << up;
            if (margins[0] < 0.0 && margins[1] > 0.0) ++righted;
        }
    }
    EXPECT_GT(read, 5);
    EXPECT_GT(righted, 5);
}

// Targets and limits: the body reaches for its targets, by the lab's commands and --state.

class HumanoidTargets : public HumanoidTest {
  protected:
    void target(const char* effector, double x, double y, double z) {
        run("humanoid.target", {{"effector", effector}, {"to", {x, y, z}}});
    }
    Json chain(const std::string& end) const {
        const Json chains = state().at("chains");
        for (const Json& each : chains)
            if (each.at("end") == end) return each;
        ADD_FAILURE() << "no chain ends at " << end;
        return {};
    }
    double residual(const std::string& end) const { return chain(end).at("residual").get<double>(); }
};

TEST_F(HumanoidTargets, AreReachedWithoutATick) {
    run("humanoid.clip", {{"name", "punch"}, {"time", 0.4}});
    target("left_hand", 0.35, 1.5, 0.45);
    target("right_hand", -0.4, 1.0, 0.3);
    target("left_foot", 0.2, 0.3, 0.2);
    target("head", 0.05, 1.48, 0.1);
    target("hips", 0.02, 0.9, 0.0);
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::dvec3(0.35, 1.5, 0.45)), 1e-3);
    EXPECT_LT(glm::distance(bone("RightHand"), glm::dvec3(-0.4, 1.0, 0.3)), 1e-3);
    EXPECT_LT(glm::distance(bone("LeftFoot"), glm::dvec3(0.2, 0.3, 0.2)), 1e-3);
    EXPECT_LT(glm::distance(bone("Head"), glm::dvec3(0.05, 1.48, 0.1)), 1e-3);
    EXPECT_LT(glm::distance(bone("Hips"), glm::dvec3(0.02, 0.9, 0.0)), 1e-3);
    for (const char* end : {"LeftHand", "RightHand", "LeftFoot", "Head", "Hips"})
        EXPECT_LT(residual(end), 1e-3) << end;
    EXPECT_EQ(residual("RightFoot"), 0.0);
}

TEST_F(HumanoidTargets, WithoutAPositionKeepTheEffectorInPlace) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.3}});
    const glm::dvec3 hand = bone("LeftHand");
    run("humanoid.target", {{"effector", "left_hand"}});
    EXPECT_LT(glm::distance(bone("LeftHand"), hand), 1e-5);
    run("humanoid.clip", {{"time", 0.5}});
    const glm::dvec3 along = hand + glm::dvec3(0.0, 0.0, 0.2);  // the walk advances at 1 m/s
    EXPECT_LT(glm::distance(bone("LeftHand"), along), 1e-3) << "the walk goes on, and the target with it";
    run("humanoid.clip", {{"time", 0.6}, {"targets_travel", false}});
    EXPECT_LT(glm::distance(bone("LeftHand"), along), 1e-3) << "or the target stays";
}

TEST_F(HumanoidTargets, GoToSeveralEffectorsAtOnce) {
    const Json hands{"right_hand", "left_hand"};
    run("humanoid.target", {{"effectors", hands}, {"points", {{-0.5, 1.2, 0.3}, {0.5, 1.1, 0.3}}}});
    const auto targets = [&] { return state().at("body").at("targets"); };
    EXPECT_EQ(targets().at("right_hand").at("position"), (Json{-0.5, 1.2, 0.3}));
    EXPECT_EQ(targets().at("left_hand").at("position"), (Json{0.5, 1.1, 0.3}));
    run("humanoid.target",
        {{"effectors", hands}, {"rotations", {{0, 0, 0, 1}, {0, 1, 0, 0}}}, {"weight", 2.5}});
    EXPECT_EQ(quaternion(targets().at("left_hand").at("rotation")), glm::dquat(0, 0, 1, 0));
    EXPECT_EQ(targets().at("right_hand").at("weight"), 2.5);
    run("humanoid.target", {{"effectors", hands}, {"weight", 0}});
    EXPECT_TRUE(targets().empty());
    run("undo");
    EXPECT_EQ(targets().size(), 2u) << "one step for all";
    const Json points{{0, 1, 0}, {0, 1, 0}};
    const auto refuses = [&](Json arguments, const char* what) {
        expect_refused("humanoid.target", arguments, {what});
    };
    refuses({{"weight", 1}}, "needs either effector or effectors");
    refuses({{"effectors", {"head", "tail"}}, {"points", points}},
            "effectors: there is no effector \"tail\"");
    refuses({{"effectors", {"head", "head"}}, {"points", points}}, "\"head\" is listed twice");
    refuses({{"effectors", {"head", 3}}, {"points", points}}, "3 is not a name");
    refuses({{"effectors", Json::array()}}, "effectors: []");
    refuses({{"effectors", Json::array({"head"})}, {"points", points}},
            "1 points, one for each of effectors");
    refuses({{"effectors", hands}, {"points", {{0, 1, 0}, {0, "x", 0}}}}, "points.1");
    refuses({{"effectors", hands}, {"rotations", {{0, 0, 0, 1}, {0, 0, 0, 9}}}}, "rotations.1");
    refuses({{"effectors", hands}, {"to", {0, 1, 0}}}, "to is for one effector");
    refuses({{"effector", "head"}, {"points", points}}, "points is for effectors");
}

TEST_F(HumanoidTargets, StopAtLimitsWhichSaySo) {
    target("hips", 0.0, 1.0, 0.0);
    target("head", 0.0, 1.6, 0.0);
    target("left_hand", -0.2, 1.4, -0.5);  // behind the back, where no arm can go
    const double limited = residual("LeftHand");
    const Json active = chain("LeftHand").at("active_limits");
    EXPECT_NE(std::ranges::find(active, Json("LeftUpperArm")), active.end()) << active;
    EXPECT_GT(limited, 0.01);
    run("humanoid.limits", {{"from", "none"}});
    EXPECT_EQ(state().at("body").at("limits"), "none");
    const Json free = state().at("chains");
    for (const Json& each : free) EXPECT_TRUE(each.at("active_limits").empty());
    EXPECT_LT(residual("LeftHand"), limited);
    run("humanoid.limits", {{"from", "motion"}});
    EXPECT_EQ(state().at("body").at("limits"), "motion");
    EXPECT_GT(residual("LeftHand"), 0.01) << "the clips never go there";
}

TEST_F(HumanoidTargets, AreIgnoredWhileABoneIsMissing) {
    target("left_hand", 0.4, 1.5, 0.4);
    const Json reached = state();
    run("humanoid.map", {{"bone", "RightFoot"}});
    EXPECT_NEAR(bone("LeftHand").x, 0.72, 1e-12);
    EXPECT_TRUE(state().at("chains").empty());
    run("humanoid.map", {{"bone", "RightFoot"}, {"node", "RightFoot"}});
    EXPECT_LT(residual("LeftHand"), 1e-3);
}

TEST_F(HumanoidTargets, StateOfAnotherBodyIsIgnored) {
    target("left_hand", 0.4, 1.5, 0.7);
    Json scene = save_scene(workspace);
    scene["labs"][humanoid_lab]["ik"]["body"]["turns"].erase(0);
    load_scene(workspace, scene);
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::dvec3(0.4, 1.5, 0.7)), 1e-3);
}

}  // namespace
}  // namespace tendril::app
