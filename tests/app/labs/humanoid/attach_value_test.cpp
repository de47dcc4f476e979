// Attachments are values in the document: undone, saved, replayed; a jumping character takes them along.
#include <fstream>
#include <random>

#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "attach_support.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

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

/// A clip that jumps by a kilometre and back, in its middle.
TEST_F(HumanoidAttach, SurvivesAClipThatJumps) {
    test::TempFolder folder;
    std::string text = bvh_figure();
    const std::string head = text.substr(0, text.find("MOTION"));
    std::string motion = "MOTION\nFrames: 12\nFrame Time: 0.1\n";
    const std::size_t channels = 3 + 3 * 17;
    for (int frame = 0; frame < 12; ++frame) {
        motion += frame % 4 < 2 ? "0 0 0" : frame < 6 ? "100000 0 0" : "0 5000 -300";
        for (std::size_t i = 3; i < channels; ++i)
            motion += i < 6 && frame % 3 == 1 ? " 170" : frame % 2 == 1 ? " 40" : " 0";
        motion += "\n";
    }
    std::ofstream(folder.path() / "jump.bvh") << head << motion;
    run("humanoid.load", {{"path", (folder.path() / "jump.bvh").string()}});
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
