// Hands that hold an object, by the lab's commands and --state.
#include <array>
#include <glm/trigonometric.hpp>

#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {
namespace {

class HumanoidHold : public HumanoidTest {
  protected:
    Json hold() const { return state().at("hold"); }
    double number(const char* name) const { return hold().at(name).get<double>(); }
    std::string text() const { return hold().at("text").get<std::string>(); }
};

TEST_F(HumanoidHold, PutsBothHandsOnEachObject) {
    for (const char* kind : {"wheel", "rifle", "box"}) {
        run("humanoid.hold", {{"kind", kind}});
        EXPECT_EQ(hold().at("kind"), kind);
        EXPECT_TRUE(hold().at("closed").get<bool>()) << kind;
        EXPECT_LT(number("moved"), 0.002) << kind;
        EXPECT_LT(number("turned_deg"), 1.0) << kind;
        EXPECT_EQ(state().at("verdict"), std::string("Holds the ") + kind);
    }
}

TEST_F(HumanoidHold, ARifleIsBesideTheWristsAndTheChest) {
    run("humanoid.hold", {{"kind", "rifle"}});
    for (int i = 0; i <= 6; ++i) {
        Solvers& solvers = humanoid_runtime(workspace).solvers;
        const ShownPose& shown = shown_pose(workspace);
        const Wearer wearer = wearer_of(part(), solvers, shown);
        for (const humanoid::BodyCapsule& each : solvers.volume(part())) {
            const bool forearm =
                each.bone == humanoid::Bone::LeftLowerArm || each.bone == humanoid::Bone::RightLowerArm;
            if (!forearm && (each.bone != humanoid::Bone::UpperChest || i > 0)) continue;
            for (const humanoid::PlacedCapsule& bar : wearer.held)
                EXPECT_GT(humanoid::gap(humanoid::place(each, *part().map, shown.placed), bar),
                          forearm ? 0.0 : -0.01)
                    << humanoid::name(each.bone) << ' ' << i;
        }
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        tick(11);
        EXPECT_LT(number("moved"), 0.01);
    }
}

TEST_F(HumanoidHold, ReleasesOutOfReachAndSaysWhy) {
    run("humanoid.hold");
    const glm::dvec3 start = vector(hold().at("position"));
    run("humanoid.hold_move", {{"to", {start.x, start.y, start.z + 2.0}}});
    EXPECT_TRUE(hold().at("closed").get<bool>());
    EXPECT_GT(number("moved"), 0.5);
    EXPECT_NE(text().find("The wheel gives way by"), std::string::npos) << text();
    EXPECT_NE(hold().at("why").get<std::string>().find("straight"), std::string::npos) << hold();
    EXPECT_EQ(state().at("verdict"), text());
    const Json held = hold();
    run("undo");
    EXPECT_LT(number("moved"), 0.002);
    run("redo");
    EXPECT_EQ(hold(), held);
}

TEST_F(HumanoidHold, ReleasesAndRefusesByName) {
    run("humanoid.target", {{"effector", "left_hand"}});
    run("humanoid.hold", {{"hands", "left"}});
    EXPECT_FALSE(part().ik.target(humanoid::Effector::LeftHand)) << "the grip takes its place";
    EXPECT_EQ(hold().at("grips").size(), 1u);
    expect_refused("humanoid.target", {{"effector", "left_hand"}}, {"left_hand holds the wheel"});
    run("humanoid.target", {{"effector", "right_hand"}});
    run("humanoid.hold", {{"hands", "right"}});
    run("humanoid.target", {{"effector", "left_hand"}});
    const glm::dvec3 there = vector(hold().at("position")) + glm::dvec3(0.05, 0, 0);
    run("humanoid.hold", {{"to", {there.x, there.y, there.z}}});
    EXPECT_LT(glm::distance(vector(hold().at("position")), there), 1e-9) << "what is held moves";
    run("humanoid.release");
    EXPECT_TRUE(hold().is_null());
    expect_refused("humanoid.release", Json::object(), {"hold nothing"});
    expect_refused("humanoid.hold_move", {{"to", {0, 1, 1}}}, {"humanoid.hold"});
}

TEST_F(HumanoidHold, FollowsWhileWalking) {
    run("humanoid.hold", {{"kind", "box"}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    const double start = bone("Hips").z, foot = bone("LeftFoot").z, object = vector(hold().at("position")).z;
    for (int i = 0; i < 90; ++i) {
        tick();
        ASSERT_TRUE(hold().at("closed").get<bool>()) << i;
        EXPECT_FALSE(hold().at("jumped").get<bool>()) << i;
    }
    const double way = bone("Hips").z - start;
    EXPECT_GT(way, 0.8);
    EXPECT_NE(bone("LeftFoot").z, foot);
    EXPECT_NEAR(vector(hold().at("position")).z - object, way, 0.25);
}

/// Over a hand's target while the clip plays: no blend from the old pose hides the grips.
TEST_F(HumanoidHold, ReplacesATargetAtOnce) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    tick(20);
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.9, 1.9, 0.1}}});
    tick(5);
    run("humanoid.hold", {{"kind", "box"}});
    for (int i = 0; i < 20; ++i) {
        tick();
        ASSERT_TRUE(hold().at("closed").get<bool>()) << i;
        ASSERT_LT(glm::distance(bone("LeftHand"), bone("RightHand")), 0.7) << i;
    }
}

/// Both hands, then one; and from one hand to the other, which is on its grip at once.
TEST_F(HumanoidHold, ReleasesOneHandGently) {
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    run("humanoid.hold", {{"kind", "box"}});
    tick(20);
    const auto apart = [&](const char* hand) {
        const glm::dvec3 before = bone(hand);
        tick();
        return glm::distance(before, bone(hand));
    };
    run("humanoid.hold", {{"hands", "left"}});
    EXPECT_LT(apart("RightHand"), 0.12);
    tick(70);
    const glm::dvec3 left = bone("LeftHand");
    run("humanoid.hold", {{"hands", "right"}});
    EXPECT_LT(glm::distance(left, bone("LeftHand")), 0.05) << "it eases back";
    const glm::dquat turn = quaternion(hold().at("held_at").at("rotation"));
    run("humanoid.clip", {{"play", false}});
    const auto grips = held_grips(*part().ik.hold, *humanoid_runtime(workspace).solvers.body(part()),
                                  part().loaded->height());
    ASSERT_EQ(grips.size(), 1u);
    EXPECT_LT(glm::distance(vector(hold().at("held_at").at("position")) + turn * grips[0].position,
                            bone("RightHand")),
              1e-3);
}

TEST_F(HumanoidHold, LetsTheBodySettleAfterATargetWasReleased) {
    run("humanoid.hold", {{"kind", "box"}, {"with_body", false}});
    const glm::dvec3 start = bone("Hips");
    run("humanoid.target", {{"effector", "hips"}, {"to", {start.x + 0.1, start.y - 0.25, start.z}}});
    const glm::dvec3 low = bone("Hips");
    ASSERT_GT(glm::distance(low, start), 0.1);
    run("humanoid.target", {{"effector", "hips"}, {"weight", 0}});
    tick(60);
    EXPECT_GT(glm::distance(bone("Hips"), low), 0.1);
}

TEST_F(HumanoidHold, KeepsItsPositionInAnotherUnitLikeTargets) {
    run("humanoid.load", {{"path", write("figure.bvh", bvh_figure())}});
    run("humanoid.hold", {{"kind", "box"}, {"hands", "left"}, {"with_body", false}});
    const glm::dvec3 hand = bone("RightHand");
    run("humanoid.target", {{"effector", "right_hand"}, {"to", {hand.x, hand.y + 0.1, hand.z}}});
    const double height = part().loaded->height();
    const glm::dvec3 object = vector(hold().at("position")), right = bone("RightHand"),
                     left = bone("LeftHand");
    run("humanoid.scale", {{"metres", 0.005}});
    const double scale = part().loaded->height() / height;
    ASSERT_LT(scale, 0.9);
    EXPECT_LT(glm::distance(vector(hold().at("position")), scale * object), 1e-6);
    EXPECT_LT(glm::distance(bone("LeftHand"), scale * left), 5e-3);
    EXPECT_LT(glm::distance(bone("RightHand"), scale * right), 5e-3);
}

TEST_F(HumanoidHold, RefusesAFileWithATargetOfAHandThatHolds) {
    run("humanoid.target", {{"effector", "right_hand"}});
    run("humanoid.hold", {{"hands", "left"}});
    Json scene = save_scene(workspace);
    Json& ik = scene["labs"]["humanoid"]["ik"];
    expect_scene_refused("/ik/hold/hands", "both", "targets.right_hand: this hand holds the object");
    Workspace bad = make_blank_workspace(labs);
    ik.erase("hold");
    load_scene(bad, scene);
    EXPECT_FALSE(save_scene(bad)["labs"]["humanoid"]["ik"].contains("held")) << "there is no object";
}

TEST_F(HumanoidHold, IsReviewedWhileItIsDragged) {
    run("humanoid.hold", {{"kind", "box"}});
    const glm::dvec3 start = vector(hold().at("position"));
    bool marked = false;
    for (int i = 1; i <= 25 && !marked; ++i) {
        const Json to{start.x + 0.03 * i, start.y + 0.05 * i, start.z - 0.05 * i};
        marked = !incidents_of("humanoid.hold_move", {{"to", to}}).empty();
    }
    EXPECT_TRUE(marked) << "no joint reached its limit, nothing flipped";
}

TEST_F(HumanoidHold, IsNotAFlipIfTheObjectTurnsTheArms) {
    run("humanoid.hold", {{"kind", "box"}, {"size", 1.2}});
    const Json turned{{"to", {0.2, 1.1, 0.7}}, {"rotation", {0, 0, 0.3826834, 0.9238795}}};
    for (const Incident& each : incidents_of("humanoid.hold_move", turned))
        EXPECT_NE(each.kind, Incident::Kind::Flip) << each.name;
}

TEST_F(HumanoidHold, SaysWhichPartCannotFollow) {
    humanoid::HoldReport report;
    report.grips[0].holds = true;
    const auto text = [&] { return hold_verdict({}, report).text; };
    EXPECT_EQ(text(), "Holds the wheel");
    report.grips[0].gap = 1e-4;
    EXPECT_EQ(text(), "Holds the wheel") << "too little to tell";
    report.turned = glm::radians(1.2);
    EXPECT_EQ(text(), "The wheel gives way by 1 degree");
    report.grips[0].gap = 0.12;
    report.body.at_limit[static_cast<std::size_t>(humanoid::Bone::LeftShoulder)] = true;
    report.body.at_limit[static_cast<std::size_t>(humanoid::Bone::RightHand)] = true;
    EXPECT_EQ(text(), "The left hand is 12 cm short of the wheel");
    EXPECT_EQ(hold_verdict({}, report).why, "The left shoulder is at its limit.") << "of the hand that holds";
    report.grips[1] = {.holds = true, .gap = 0.02, .straight = true};
    EXPECT_EQ(text(), "Hands 12 cm short of the wheel");
    EXPECT_EQ(hold_verdict({}, report).why,
              "The right arm is straight; the left shoulder and right hand are at their limits.");
    report.grips[0] = {.holds = true}, report.grips[1] = {.holds = true, .off = 0.1};
    EXPECT_EQ(text(), "The right hand is turned off its grip");
}

TEST_F(HumanoidHold, IsDraggedByItsHandle) {
    run("humanoid.hold");
    const auto handles = lab().handles(workspace);
    const auto found =
        std::ranges::find_if(handles, [](const Handle& each) { return each.pick == hold_pick; });
    ASSERT_NE(found, handles.end());
    EXPECT_EQ(lab().gizmo(workspace)->pick, hold_pick);
    EXPECT_EQ(std::ranges::count_if(handles, [](const Handle& each) { return each.name == "left_hand"; }), 0);
}

// Hand IK, look-at and self-collision, by the lab's commands and --state.

using HumanoidHands = HumanoidTest;

TEST_F(HumanoidHands, BlendByTheTargetsWeight) {
    run("humanoid.clip", {{"name", "punch"}, {"time", 0.1}});
    const glm::dvec3 clip = bone("LeftHand"), wanted = clip + glm::dvec3(0.1, 0.1, 0.05);
    run("humanoid.target",
        {{"effector", "left_hand"}, {"to", {wanted.x, wanted.y, wanted.z}}, {"weight", 0.5}});
    run("humanoid.hand_ik", {{"on", true}});
    EXPECT_LT(glm::distance(bone("LeftHand"), glm::mix(clip, wanted, 0.5)), 5e-3);
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 1}});
    EXPECT_LT(glm::distance(bone("LeftHand"), wanted), 1e-3);
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 0.005}});
    EXPECT_EQ(bone("LeftHand"), clip) << "under 0.01 it is off";
    run("humanoid.hand_ik", {{"on", false}});
    EXPECT_LT(glm::distance(bone("LeftHand"), wanted), 1e-3) << "the body reaches for it again";
}

TEST_F(HumanoidHands, TimesMayBeTypedInAnyOrder) {
    run("humanoid.target", {{"effector", "left_hand"}});
    run("humanoid.hand_ik", {{"on", true}, {"hand", "left"}, {"curve", true}});
    const auto times = [&] {
        const HandCurve& curve = *part().ik.hand_ik.curves[0];
        return std::array{curve.begin, curve.full, curve.until, curve.end};
    };
    run("humanoid.hand_ik", {{"hand", "left"}, {"begin", 1.0}});  // beyond all the others
    EXPECT_EQ(times(), (std::array{1.0, 1.0, 1.0, 1.0}));
    run("humanoid.hand_ik", {{"hand", "left"}, {"full", 1.2}});
    run("humanoid.hand_ik", {{"hand", "left"}, {"until", 1.5}});
    run("humanoid.hand_ik", {{"hand", "left"}, {"end", 1.75}});
    EXPECT_EQ(times(), (std::array{1.0, 1.2, 1.5, 1.75}));
    run("humanoid.hand_ik", {{"hand", "left"}, {"end", 0.5}});
    EXPECT_EQ(times(), (std::array{0.5, 0.5, 0.5, 0.5}));
    expect_refused("humanoid.hand_ik", {{"begin", 0.6}, {"full", 0.5}},
                   {"from", "full from", "full to", "must be in ascending order"});
}

TEST_F(HumanoidHands, NeedABody) {
    run("humanoid.map", {{"bone", "LeftHand"}});
    for (const char* command :
         {"humanoid.hand_ik", "humanoid.look_at", "humanoid.self_collision", "humanoid.balance"}) {
        expect_refused(command, {{"on", true}}, {"full-body IK is off: LeftHand is missing"});
        run(command, {{"on", false}});
    }
}

using HumanoidLook = HumanoidTest;

TEST_F(HumanoidLook, TurnsTheHeadToATarget) {
    run("humanoid.look_at", {{"on", true}});
    const glm::dvec3 ahead = vector(state().at("look_at").at("target"));
    EXPECT_GT(ahead.z, 1.0) << "ahead of the head where nothing was given";
    const glm::dvec3 target(1.2, 1.9, 1.2);
    run("humanoid.look_at", {{"to", {target.x, target.y, target.z}}});
    tick(120);
    const glm::dvec3 forward = quaternion(bones().at("Head").at("rotation")) * glm::dvec3(0, 0, 1);
    EXPECT_GT(glm::dot(forward, glm::normalize(target - bone("Head"))), std::cos(glm::radians(3.0)));
    EXPECT_LT(state().at("look_at").at("left_deg").get<double>(), 3.0);
    run("humanoid.look_at", {{"weight", 0}});
    EXPECT_EQ(bone("Neck"), glm::dvec3(0, 1.5, 0));
    run("humanoid.look_at", {{"on", false}});
    EXPECT_EQ(quaternion(bones().at("Head").at("rotation")), glm::dquat(1, 0, 0, 0));
}

// Self-collision in the Humanoid lab: hands that a clip or target would move into the body stay outside.

class HumanoidContacts : public HumanoidTest {
  protected:
    /// The depth of hands and lower arms in trunk and head as drawn, metres.
    double penetration() { return penetration(capsules()); }
    std::vector<humanoid::BodyCapsule> capsules() const {
        return humanoid::fitted_capsules(part().skeleton(), *part().map,
                                         skin_points(part().loaded->character.skin, part().loaded->rest));
    }
    double penetration(const std::vector<humanoid::BodyCapsule>& capsules) {
        const auto& placed = shown_pose(workspace).placed;
        double deepest = 0.0;
        for (const auto& arm : capsules) {
            using humanoid::Bone;
            if (arm.bone != Bone::LeftHand && arm.bone != Bone::RightHand && arm.bone != Bone::LeftLowerArm &&
                arm.bone != Bone::RightLowerArm)
                continue;
            for (const auto& other : capsules)
                if (other.bone <= Bone::Head)
                    deepest = std::max(
                        deepest, -gap(place(arm, *part().map, placed), place(other, *part().map, placed)));
        }
        return deepest;
    }
};

TEST_F(HumanoidContacts, WornObjectsAreKeptApart) {
    run("humanoid.load", {{"path", tendril::test::source_path("tests/app/golden/body.glb")}});
    run("humanoid.self_collision", {{"on", true}});
    const std::vector<humanoid::BodyCapsule> capsules = humanoid_runtime(workspace).solvers.capsules(part());
    const auto usual = humanoid::default_capsules(part().skeleton(), *part().map);
    ASSERT_EQ(capsules.size(), usual.size());
    EXPECT_NE(capsules, usual);
    const Json before = state().at("character").at("nodes");
    run("humanoid.self_collision", {{"on", false}});
    EXPECT_EQ(state().at("character").at("nodes"), before) << "nothing is pushed at rest";
    run("humanoid.self_collision", {{"on", true}});
    for (int i = 0; i <= 60; ++i) {
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.1, 1.15, 0.5 - 0.01 * i}}});
        ASSERT_LT(penetration(capsules), 5e-3) << i;
    }
    // A fist through the waist and back, by hand IK.
    run("humanoid.target", {{"effector", "left_hand"}, {"weight", 0}});
    run("humanoid.hand_ik", {{"on", true}});
    for (int i = 0; i <= 120; ++i) {
        const double part_of_way = 0.5 - 0.5 * std::cos(2.0 * 3.14159265 * i / 120.0);
        run("humanoid.target", {{"effector", "right_hand"}, {"to", {-0.05, 1.12, 0.5 - 0.5 * part_of_way}}});
        tick();
        ASSERT_LT(penetration(capsules), 5e-3) << i;
    }
}

TEST_F(HumanoidContacts, SwitchedOffItLeavesNoTrace) {
    for (const char* command : {"humanoid.self_collision", "humanoid.balance"}) {
        workspace = make_blank_workspace(labs);
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.3, 1.3, 0.4}}});
        const Json before = state();
        run(command, {{"on", true}});
        run(command, {{"on", false}});
        EXPECT_EQ(state(), before) << command;
    }
}

}  // namespace
}  // namespace tendril::app
