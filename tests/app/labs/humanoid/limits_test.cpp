// Joint limits: drawn as the solver uses them, learned from clips, adopted for all joints or one.
#include <glm/gtc/quaternion.hpp>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "humanoid_support.hpp"
#include "tests/app/support/temp_folder.hpp"

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

TEST_F(HumanoidLimits, LearningIsRefusedWithoutData) {
    expect_refused("humanoid.limits", {{"from", "motion"}, {"bone", "Tail"}},
                   {"bone must be one of Hips, Spine"});
    expect_refused("humanoid.limits", {{"from", "motion"}, {"bone", "Hips"}},
                   {"the Hips joint has no limits"});
    run("humanoid.map", {{"bone", "LeftToes"}});
    expect_refused("humanoid.limits", {{"from", "none"}, {"bone", "LeftToes"}}, {"has no LeftToes"});
    const test::TempFolder folder;
    test::write(folder / "figure.bvh", bvh_figure());
    run("humanoid.load", {{"path", (folder / "figure.bvh").string()}});
    expect_refused("humanoid.limits", {{"from", "motion"}, {"bone", "Head"}},
                   {"no clip turns the Head joint"});
}

}  // namespace
}  // namespace tendril::app
