// Attachments of a character: their initial pose, their distance from the body, and how they come to rest.
#include <fstream>
#include <random>

#include "app/io/character/character.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "attach_support.hpp"
#include "tests/app/io/posed.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

TEST_F(HumanoidAttach, OnAFigureOfAnySizeIsSavedAndOpened) {
    const std::string path = write("figure.bvh", bvh_figure());
    for (const double unit : {1e-6, 0.001, 0.1, 800'000.0}) {
        for (const char* kind : {"rope", "hair", "cloth"}) {
            workspace = make_blank_workspace(labs);
            run("humanoid.load", {{"path", path}});
            run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", kind}});
            run("humanoid.look_at", {{"on", true}});
            run("humanoid.scale", {{"metres", unit}});
            EXPECT_EQ(lab().state(reopened()), state()) << kind << " at " << unit;
            run("humanoid.detach", {{"name", kind}});
            run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", kind}});
            run("humanoid.look_at", {{"on", false}});
            run("humanoid.look_at", {{"on", true}});
            EXPECT_EQ(lab().state(reopened()), state()) << kind << " at " << unit;
        }
    }
}

TEST_F(HumanoidAttach, MakesATailAPonytailAndACape) {
    dress();
    const Json all = state().at("attachments");
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].at("name"), "cape");
    EXPECT_EQ(all[0].at("kind"), "cloth");
    EXPECT_EQ(all[0].at("bone"), "UpperChest");
    EXPECT_EQ(all[2].at("positions").size(), 21u);
    EXPECT_EQ(state().at("order"), Json({"clip", "curves", "IK", "rig", "springs", "ropes"}));
    // The figure faces +Z, with its left at +X.
    EXPECT_EQ(particle("tail", 0), bone("Hips"));
    EXPECT_LT(last("tail").z, -0.4) << "it leaves the body backwards";
    EXPECT_LT(particle("ponytail", 0).z, -0.08);
    const glm::dvec3 root = particle("ponytail", 0);  // in the middle of the strands
    EXPECT_GT(depth(capsules(), root, root), -0.012) << "it grows from the head";
    EXPECT_GT(particle("ponytail", 0).y, 1.6);
    const std::size_t row = body("cape").row;
    EXPECT_GT(particle("cape", 0).x, 0.12) << "from the left shoulder";
    EXPECT_LT(particle("cape", row - 1).x, -0.12) << "to the right one";
    EXPECT_NEAR(particle("cape", 0).y, 1.45, 0.05);
    EXPECT_NEAR(last("cape").y, 0.55, 0.05);
    EXPECT_LT(particle_depth(), 1e-4);
}

/// The file against the same seconds in the lab: each strand and column is a chain of bones.
TEST_F(HumanoidAttach, IsInAnExportWithWhatTheHandsHold) {
    run("humanoid.clip", {{"name", "walk"}, {"time", 0}});
    run("humanoid.hold", {{"kind", "rifle"}});
    dress();
    run("humanoid.wind", {{"wind", {0.0, 0.0, 3.0}}});
    const std::string path = write("dressed.glb", "");
    run("humanoid.export", {{"path", path}, {"fps", 60}});
    EXPECT_TRUE(test::says(workspace.ui.toasts.back().text, "With: cape, ponytail, tail, rifle"));
    const Character read = read_character(path);
    EXPECT_EQ(read.skin.mesh->parts.size(), part().loaded->character.skin.mesh->parts.size() + 4);
    tick(120);
    run("humanoid.clip", {{"play", true}});
    for (const double seconds : {0.25, 0.5, 0.75}) {
        tick(15);
        const auto off = [&](const char* name, const glm::dvec3& wanted) {
            return glm::distance(test_posed::at(read, name, 0, seconds), wanted);
        };
        EXPECT_LT(off("tail_8", particle("tail", 7)), 1e-3) << seconds;
        EXPECT_LT(off("ponytail_2_11", particle("ponytail", 21)), 1e-3) << seconds;
        EXPECT_LT(off("cape_3_6", particle("cape", 5 * body("cape").row + 2)), 0.02) << seconds;
        EXPECT_LT(off("cape_3_19", particle("cape", 18 * body("cape").row + 2)), 0.1)
            << seconds << ": put on anew, its hem folds differently";
        EXPECT_LT(off("rifle", shown_pose(workspace).hold->object.position), 1e-4) << seconds;
    }
}

/// A reader takes whole trees of it, and joints alone once what hangs there has brought a skin.
TEST_F(HumanoidAttach, IsInAnExportOfAFileWithoutSkins) {
    const std::filesystem::path file = test::found_path("glb_no_skin.glb");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
    run("humanoid.load", {{"path", file.string()}});
    run("humanoid.attach", {{"bone", "Head"}, {"kind", "hair"}, {"name", "tail"}});
    const std::string path = write("dressed.glb", "");
    const std::size_t bare = part().skeleton().size();
    run("humanoid.export", {{"path", path}});
    EXPECT_EQ(read_character(path).skeleton.size(), bare + body("tail").count);
    EXPECT_TRUE(test::says(workspace.ui.toasts.back().text, "With: tail"));
}

/// One wind for everything that hangs. It is of the scene: attachments and characters come and go in it.
TEST_F(HumanoidAttach, HangsInOneWind) {
    const Json wind{{"wind", {4.0, 0.0, -2.0}}, {"gusts", 0.3}};
    run("humanoid.wind", wind);
    EXPECT_FALSE(lab().moving(workspace)) << "nothing hangs";
    dress();
    const auto middle = [&](const char* name) {
        double sum = 0.0;
        for (std::size_t i = 0; i < body(name).count; ++i) sum += particle(name, i).x;
        return sum / static_cast<double>(body(name).count);
    };
    for (const char* name : {"cape", "ponytail", "tail"}) EXPECT_NEAR(middle(name), 0.0, 0.01) << name;
    wait(90);
    for (const char* name : {"cape", "ponytail", "tail"}) EXPECT_GT(middle(name), 0.02) << name;
    run("view.fold", {{"section", "humanoid"}, {"folded", false}});
    const auto blows = [&](const Json& way, const char* text) {
        run("humanoid.wind", {{"wind", way}});
        const std::string panel = test::PanelReader().panel(lab(), workspace);
        EXPECT_NE(panel.find(text), panel.npos) << way;
    };
    blows({0.0, 0.0, 3.0}, "Blows from behind.");
    blows({0.0, -3.0, 0.5}, "Blows downwards.");
    blows(wind.at("wind"), "Blows from the front, to its left.");
    EXPECT_LT(particle_depth(), 0.005);
    expect_goes_on_the_same();
    wait(600);
    EXPECT_TRUE(lab().moving(workspace)) << "gusts go on";
    run("humanoid.clip", {{"name", "walk"}, {"time", 0.6}});
    EXPECT_TRUE(all_finite());
    run("humanoid.load");
    EXPECT_TRUE(state().at("attachments").empty());
    EXPECT_EQ(state().at("wind"), Json({{"wind", {4.0, 0.0, -2.0}}, {"gusts", 0.3}, {"still_air", false}}));
    EXPECT_EQ(lab().state(reopened()), state());
    refuses("humanoid.wind", {{"wind", {2000.0, 0.0, 0.0}}}, "wind.0 number");
    run("humanoid.wind", {{"wind", {0.0, 0.0, 0.0}}});
    dress();
    int ticks = 0;
    for (; ticks < 3000 && lab().moving(workspace); ++ticks) tick();
    EXPECT_LT(ticks, 3000) << "it comes to rest in still air";
}

TEST_F(HumanoidAttach, HangsBehindTheBodyAndComesToRest) {
    dress();
    EXPECT_TRUE(lab().moving(workspace));
    int ticks = 0;
    for (; ticks < 3000 && lab().moving(workspace); ++ticks) tick();
    EXPECT_LT(ticks, 3000) << "it never comes to rest";
    EXPECT_GT(ticks, 30);
    EXPECT_LT(last("tail").y, 0.45) << "it hangs";
    EXPECT_LT(last("tail").z, -0.05) << "behind the legs";
    EXPECT_LT(last("ponytail").y, 1.5);
    EXPECT_LT(last("cape").z, 0.0);
    EXPECT_LT(particle_depth(), 1e-4);
    run("humanoid.target", {{"effector", "head"}, {"to", {0.1, 1.5, 0.1}}});
    EXPECT_TRUE(lab().moving(workspace)) << "what moves the body lets time pass again";
}

TEST_F(HumanoidAttach, StaysOffTheBody) {
    dress();
    for (const auto& [clip, speed] :
         {std::pair("walk", 1.0), {"punch", 1.0}, {"walk", 2.0}, {"punch", 2.0}}) {
        run("humanoid.clip", {{"name", clip}, {"play", true}, {"loop", true}, {"speed", speed}, {"time", 0}});
        double deepest = 0.0, deepest_link = 0.0, stretch = 0.0, error = 0.0;
        for (int i = 0; i < 300; ++i) {
            tick();
            deepest = std::max(deepest, particle_depth());
            deepest_link = std::max(deepest_link, link_depth());
            for (const rope::Body& each : world().state().bodies)
                stretch = std::max(stretch, static_cast<double>(each.stretch));
            error = std::max(error, world().length_error());
        }
        const std::string which = std::string(clip) + " at " + std::to_string(speed);
        RecordProperty(which, std::to_string(1e3 * deepest_link) + " mm, " + std::to_string(error));
        EXPECT_LT(deepest, 5e-4) << which << ": a limb near the trunk yields";
        EXPECT_LT(deepest_link, 0.005) << which;
        EXPECT_LT(stretch, speed > 1.0 ? 0.05 : 0.02) << which << ": as the solver left it";
        EXPECT_LT(error, 0.08) << which << ": with what the body pushed aside";
        // Nothing has passed through the body: the cape is still behind the trunk.
        const std::size_t row = body("cape").row, middle = row / 2;
        for (std::size_t r = 0; r < 8; ++r)
            EXPECT_LT(particle("cape", r * row + middle).z, bone("UpperChest").z) << which << ", row " << r;
    }
}

/// Hands that grip a rifle bring the arms close to the trunk, and the rifle close to the cape.
TEST_F(HumanoidAttach, IsNotTornByArmsThatCloseOnTheTrunk) {
    for (const auto& [file, size, before] :
         {std::tuple("robot.glb", 1.0, 16), {"mixed_orders.bvh", 1.0, 34}, {"robot.glb", 2.0, 7}}) {
        const auto path = test::characters_folder() / file;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
        workspace = make_blank_workspace(labs);
        run("humanoid.load", {{"path", path.string()}});
        run("humanoid.attach", {{"bone", "Chest"}, {"kind", "cloth"}, {"name", "cape"}});
        run("humanoid.clip", {{"index", 0}, {"play", true}, {"loop", true}});
        tick(before);
        run("humanoid.hold", {{"kind", "rifle"}, {"size", size}});
        EXPECT_NE(world().find_collider("held 0"), nullptr);
        double error = 0.0;
        for (int i = 0; i < 120; ++i) tick(), error = std::max(error, world().length_error());
        EXPECT_LT(error, 0.05) << file << ", " << size;
    }
}

/// The arms of this one hold the edges of its cape against the trunk.
TEST_F(HumanoidAttach, ACapeDoesNotClimb) {
    const auto path = test::characters_folder() / "mixed_orders.bvh";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    for (const auto& [start, loop] : {std::pair(0.17, false), {0.66, true}, {0.41, false}}) {
        if (start == 0.41 && !test::is_thorough()) continue;
        workspace = make_blank_workspace(labs);
        run("humanoid.load", {{"path", path.string()}});
        run("humanoid.clip", {{"time", start}, {"play", true}, {"loop", loop}});
        run("humanoid.attach", {{"bone", "Chest"}, {"kind", "cloth"}, {"name", "cape"}});
        tick(180);
        const double hem = last("cape").y;
        for (int i = 0; i < (test::is_thorough() ? 600 : 300); ++i) {
            tick();
            ASSERT_LT(last("cape").y, hem + 0.05) << start << ", tick " << i;
        }
        if (!loop) {
            EXPECT_LT(fastest(), 0.1) << start << ": the figure stands still";
        }
    }
}

TEST_F(HumanoidAttach, ATornOneIsReportedInTheVerdict) {
    run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}});
    run("humanoid.hold", {{"kind", "rifle"}});
    EXPECT_EQ(humanoid_verdict(workspace).text, "Holds the rifle");
    rope::State pulled = world().state();
    for (const std::size_t i : {15, 16}) pulled.position[i].y -= 0.2;
    auto torn = std::make_shared<NamedWorld>(world());
    torn->put(pulled);
    workspace.document.edit<HumanoidPart>(humanoid_lab).attachments.world = torn;
    EXPECT_EQ(humanoid_verdict(workspace).text, "\"tail\" is torn at 2 edges");
}

TEST_F(HumanoidAttach, MovesWithItsBone) {
    dress();
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    const glm::dvec3 before = particle("ponytail", 0) - bone("Head");
    tick(100);
    const glm::dquat turn = quaternion(bones().at("Head").at("rotation"));
    EXPECT_LT(glm::distance(particle("ponytail", 0), bone("Head") + turn * before), 1e-6);
    EXPECT_GT(bone("Hips").z, 1.0);
    EXPECT_GT(last("tail").z, bone("Hips").z - 0.8) << "the tail is no longer than it was";
}

TEST_F(HumanoidAttach, IsNotCarriedByADragOfTheHeldObjectWhileTimeRuns) {
    run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", "rope"}, {"name", "cord"}});
    run("humanoid.hold", {{"kind", "box"}});
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    tick(20);
    const glm::dvec3 before = last("cord"), object = vector(state().at("hold").at("position"));
    run("humanoid.hold_move", {{"to", {object.x, object.y + 0.1, object.z}}});
    EXPECT_EQ(last("cord"), before);
}

TEST_F(HumanoidAttach, LiesOnTheGroundIfThatIsFlat) {
    for (const auto& [kind, angle] : {std::pair("flat", 0.0), {"slope", 20.0}}) {
        run("humanoid.load");
        run("humanoid.ground", {{"kind", kind}, {"angle_deg", angle}});
        run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}, {"length", 1.6}});
        run("humanoid.foot_ik", {{"on", true}});
        run("humanoid.clip", {{"name", "walk"}, {"play", true}});
        double lowest = 1.0;
        for (int i = 0; i < 240; ++i) {
            tick();
            for (std::size_t k = 2; k < body("tail").count; ++k) {
                const glm::dvec3 at = particle("tail", k);
                const double ground = std::max(0.0, at.z) * std::tan(angle * 3.14159265358979 / 180.0);
                lowest = std::min(lowest, at.y - ground);
            }
        }
        EXPECT_GT(lowest, 0.010) << kind;
        EXPECT_LT(lowest, 0.017) << kind << ": it touches the ground";
    }
}

TEST_F(HumanoidAttach, SwingsWithAHandThatIsDraggedWhileTheClipIsPaused) {
    run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", "rope"}, {"name", "rope"}});
    for (int i = 0; i < 400; ++i) tick();
    const glm::dvec3 hung = last("rope");
    for (int i = 1; i <= 20; ++i) {
        run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.6, 1.45, 0.02 * i}}}, 7);
        tick();
        EXPECT_LT(glm::distance(particle("rope", 0), bone("LeftHand")), 0.1);
    }
    EXPECT_GT(last("rope").z, hung.z + 0.02);
    EXPECT_LT(last("rope").z, particle("rope", 0).z - 0.02) << "its end trails";
    for (int i = 0; i < 1500; ++i) tick();
    EXPECT_NEAR(last("rope").z, particle("rope", 0).z, 0.03) << "and hangs straight in the end";
    EXPECT_FALSE(lab().moving(workspace));
}

TEST_F(HumanoidAttach, UsesTheGivenShape) {
    run("humanoid.attach", {{"bone", "Head"},
                            {"kind", "rope"},
                            {"length", 0.5},
                            {"segments", 5},
                            {"thickness", 0.01},
                            {"offset", {0, 0.3, 0}},
                            {"direction", {2, 0, 0}}});
    EXPECT_EQ(part().attachments.list[0].name, "rope");
    EXPECT_EQ(body("rope").count, 6u);
    EXPECT_FLOAT_EQ(body("rope").radius, 0.005f);
    EXPECT_LT(glm::distance(particle("rope", 0), glm::dvec3(0, 1.9, 0)), 1e-6);
    EXPECT_LT(glm::distance(last("rope"), glm::dvec3(0.5, 1.9, 0)), 1e-5);
    run("humanoid.attach", {{"bone", "HeadTop_End"}, {"kind", "hair"}, {"strands", 3}, {"segments", 4}});
    EXPECT_TRUE(state().at("attachments")[1].at("bone").is_null());
    EXPECT_EQ(state().at("attachments")[1].at("node"), "HeadTop_End");
    run("humanoid.attach", {{"bone", "Head"}, {"kind", "rope"}});
    EXPECT_EQ(part().attachments.list[2].name, "rope 2");
}

TEST_F(HumanoidAttach, RefusesInvalidValues) {
    expect_refused("humanoid.attach", {{"bone", "Wing"}, {"kind", "rope"}}, {"no bone and no node \"Wing\""});
    expect_refused("humanoid.attach", {{"bone", "Head"}, {"kind", "rope"}, {"direction", {0, 0, 0}}},
                   {"direction must be longer than 0"});
    expect_refused("humanoid.attach",
                   {{"bone", "Head"}, {"kind", "hair"}, {"strands", 200}, {"segments", 200}},
                   {"40200 particles", "more than 4000"});
    expect_refused("humanoid.detach", {{"name", "tail"}}, {"no attachment \"tail\""});
    run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}});
    expect_refused("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}},
                   {"name \"tail\" is already used by another attachment"});
    for (std::size_t i = 1; i < max_attachments; ++i)
        run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"segments", 2}});
    expect_refused("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}}, {"there are 16 attachments"});
    run("humanoid.map", {{"bone", "UpperChest"}});
    run("humanoid.detach", {{"name", "tail"}});
    run("humanoid.attach", {{"bone", "UpperChest"}, {"kind", "rope"}});  // the node of that name
}

// Attachments are values in the document: undone, saved, replayed; a jumping character takes them along.

/// After scrubbing, or choosing another clip, everything is where it was relative to its bone.
TEST_F(HumanoidAttach, IsCarriedAlongWhenTheCharacterJumps) {
    dress();
    run("humanoid.clip", {{"name", "walk"}, {"play", true}});
    tick(90);
    const auto seen = [&](std::size_t i) {
        const glm::dquat turn = quaternion(bones().at("Hips").at("rotation"));
        return glm::conjugate(turn) * (particle("tail", i) - bone("Hips"));
    };
    std::vector<glm::dvec3> before;
    for (std::size_t i = 0; i < 21; ++i) before.push_back(seen(i));
    for (const Json& jump : {Json{{"time", 60.3}}, Json{{"time", 0.2}}, Json{{"name", "punch"}},
                             Json{{"name", ""}}, Json{{"name", "walk"}, {"time", 1000.0}}}) {
        run("humanoid.clip", jump);
        // The legs take their new pose and may push the tail aside.
        for (std::size_t i = 0; i < 21; ++i)
            EXPECT_LT(glm::distance(seen(i), before[i]), i < 6 ? 0.02 : 0.25) << jump << ", particle " << i;
        EXPECT_LT(particle_depth(), 1e-3) << jump;
        EXPECT_LT(fastest(), 8.0) << jump;
        double error = 0.0;
        for (int i = 0; i < 10; ++i) {
            tick();
            EXPECT_LT(fastest(), 12.0) << jump << ", tick " << i;
            error = std::max(error, world().length_error());
        }
        EXPECT_LT(error, 0.06) << jump;
        before.clear();
        for (std::size_t i = 0; i < 21; ++i) before.push_back(seen(i));
    }
}

TEST_F(HumanoidAttach, IsCarriedAlongWhileTheSimulationIsPaused) {
    run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", "rope"}, {"name", "rope"}});
    run("time.pause");
    const glm::dvec3 before = particle("rope", 0) - bone("LeftHand");
    run("humanoid.target", {{"effector", "left_hand"}, {"to", {0.5, 1.3, 0.3}}}, 3);
    EXPECT_NEAR(glm::distance(particle("rope", 0), bone("LeftHand")), glm::length(before), 1e-6);
    EXPECT_GT(particle("rope", 0).z, 0.2);
}

TEST_F(HumanoidAttach, SurvivesAClipThatJumps) {
    const std::string text = bvh_figure(), head = text.substr(0, text.find("MOTION"));
    std::string motion = "MOTION\nFrames: 12\nFrame Time: 0.1\n";
    const std::size_t channels = 3 + 3 * 17;
    for (int frame = 0; frame < 12; ++frame) {
        motion += frame % 4 < 2 ? "0 0 0" : frame < 6 ? "100000 0 0" : "0 5000 -300";
        for (std::size_t i = 3; i < channels; ++i)
            motion += i < 6 && frame % 3 == 1 ? " 170" : frame % 2 == 1 ? " 40" : " 0";
        motion += "\n";
    }
    run("humanoid.load", {{"path", write("jump.bvh", head + motion)}});
    run("humanoid.attach", {{"bone", "Chest"}, {"kind", "cloth"}, {"name", "cape"}});
    run("humanoid.attach", {{"bone", "Head"}, {"kind", "hair"}});
    run("humanoid.attach", {{"bone", "LeftHand"}, {"kind", "rope"}});
    run("humanoid.clip", {{"index", 0}, {"play", true}, {"loop", true}});
    for (const double speed : {1.0, 10.0, 0.1}) {
        run("humanoid.clip", {{"speed", speed}});
        for (int i = 0; i < 60; ++i) {
            tick();
            ASSERT_TRUE(all_finite()) << speed << ", tick " << i;
            ASSERT_LT(fastest(), 200.0) << speed << ", tick " << i;
        }
    }
    run("humanoid.clip", {{"play", false}});
    tick(300);
    EXPECT_LT(fastest(), 0.5);
    EXPECT_LT(world().length_error(), 0.05);
    EXPECT_LT(glm::distance(particle("cape", 0), bone("Chest")), 1.0);
}

/// Nodes anywhere, with scale 0, mirrored, a thousand kilometres away.
TEST(HumanoidAttachments, AlwaysStayFinite) {
    const HumanoidPart part;
    const std::vector<humanoid::BodyCapsule> capsules =
        humanoid::default_capsules(part.skeleton(), *part.map);
    GroundSetting ground{.kind = humanoid::GroundKind::Slope};
    std::vector<humanoid::Placement> placed = part.loaded->rest;
    const Wearer wearer{*part.loaded, *part.map, capsules, placed, ground};
    Attachments attachments;
    for (const auto& [node, kind] : {std::pair("UpperChest", AttachmentKind::Cloth),
                                     {"Head", AttachmentKind::Hair},
                                     {"LeftHand", AttachmentKind::Rope}}) {
        Attachment wanted;
        wanted.node = node;
        wanted.kind = kind;
        wanted.shape = default_shape(wearer, kind, *part.skeleton().find(node));
        add_attachment(attachments, wearer, wanted);
    }
    rope::Workspace workspace;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int i = 0; i < 80; ++i) {
        const double far = std::pow(10.0, 3.0 + 6.0 * number(random));
        for (humanoid::Placement& each : placed) {
            if (number(random) < 0.5) continue;
            for (int axis = 0; axis < 3; ++axis) {
                const bool none = number(random) > 0.7;
                for (int k = 0; k < 3; ++k) each.axes[axis][k] = none ? 0.0 : number(random);
            }
            each.position = {far * number(random), number(random), number(random)};
        }
        if (i % 20 == 19) placed[0].position.x = std::numeric_limits<double>::quiet_NaN();
        if (i % 3 == 0)
            carry(attachments, wearer, workspace);
        else
            advance(attachments, wearer, workspace, i % 2 == 0 ? 1.0 / 60.0 : 1.0 / 1200.0);
        for (const glm::dvec3& at : attachments.world->state().position)
            for (int k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(at[k])) << i;
        placed[0].position.x = 0.0;
    }
    placed = part.loaded->rest;
    for (int i = 0; i < 300; ++i) advance(attachments, wearer, workspace, 1.0 / 60.0);
    EXPECT_LT(attachments.world->length_error(), 0.1) << "they find back";
}

}  // namespace
}  // namespace tendril::app
