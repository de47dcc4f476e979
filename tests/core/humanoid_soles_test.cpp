// Heels and toes from skeleton and map, for any bone axes and origin.
#include <tendril/humanoid/soles.hpp>
#include <tendril/humanoid/t_pose.hpp>

#include "humanoid_walk.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

std::array<SolePoints, 2> at_rest(const Skeleton& skeleton, const Soles& soles) {
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, rest_pose(skeleton), placements);
    return sole_points(soles, placements);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Soles, LieBelowAnkleAndToesOnTheFloor) {
    const Skeleton skeleton = make_figure({});
    const Soles soles = *find_soles(skeleton, match_bones(skeleton));
    EXPECT_EQ(soles.floor, 0.0);
    expect_near(soles.forward, {0, 0, 1});
    EXPECT_NEAR(soles.leg, 0.85, 0.001);
    const auto points = at_rest(skeleton, soles);
    expect_near(points[0].heel, {0.1, 0, -0.05});
    expect_near(points[0].toe, {0.1, 0, 0.15});
    expect_near(points[1].heel, {-0.1, 0, -0.05});
    expect_near(points[1].toe, {-0.1, 0, 0.15});
}

TEST(Soles, TurnWithTheFigure) {
    for (const double turn : {0.7, -2.1, 3.1}) {
        const Skeleton skeleton = make_figure({}, turn);
        const Soles soles = *find_soles(skeleton, match_bones(skeleton));
        const glm::dquat about_y = glm::angleAxis(turn, glm::dvec3(0, 1, 0));
        expect_near(soles.forward, about_y * glm::dvec3(0, 0, 1));
        expect_near(at_rest(skeleton, soles)[0].toe, about_y * glm::dvec3(0.1, 0, 0.15));
    }
}

TEST(Soles, PointWhereTheCharacterFaces) {
    std::map<std::string, std::string> exchanged;
    for (const FigureNode& each : figure_nodes()) {
        const std::string key = each.key;
        if (key.starts_with("Left")) exchanged[key] = "Right" + key.substr(4);
        if (key.starts_with("Right")) exchanged[key] = "Left" + key.substr(5);
    }
    for (const double turn : {0.0, 0.7, -2.1, 3.1})
        for (const auto& names : {std::map<std::string, std::string>(), exchanged}) {
            const Skeleton skeleton = make_figure(names, turn);
            const BoneMap map = match_bones(skeleton);
            const glm::dvec3 feet = glm::angleAxis(turn, glm::dvec3(0, 1, 0)) * glm::dvec3(0, 0, 1);
            expect_near(find_soles(skeleton, map)->forward, feet);
            expect_near(facing(skeleton, map).forward, feet);
            const double side = names.empty() ? 1.0 : -1.0;
            expect_near(facing(skeleton, map).left, side * glm::cross(glm::dvec3(0, 1, 0), feet));
        }
}

TEST(Soles, EstimateTheToesFromTheLegs) {
    const Skeleton skeleton =
        make_figure({{"LeftToes", ""}, {"LeftToes end", ""}, {"RightToes", ""}, {"RightToes end", ""}});
    const Soles soles = *find_soles(skeleton, match_bones(skeleton));
    EXPECT_EQ(soles.feet[0].foot, soles.feet[0].toes);
    expect_near(soles.forward, {0, 0, 1});
    const auto points = at_rest(skeleton, soles);
    expect_near(points[0].toe, {0.1, 0, 0.15}, 0.001);
    expect_near(points[0].heel, {0.1, 0, -0.05}, 0.001);
}

TEST(Soles, FindTheFloorIfTheHipsAreTheOrigin) {
    std::vector<Node> nodes = make_figure({}).nodes();
    nodes[0].rest.translation = glm::dvec3(0.0);
    const Skeleton skeleton = *Skeleton::make(nodes);
    const Soles soles = *find_soles(skeleton, match_bones(skeleton));
    EXPECT_NEAR(soles.floor, -1.0, 0.005);
}

TEST(Soles, AreInTheirBonesSpaces) {
    // Rotating and scaling every bone must not move joints or sole points.
    const Skeleton plain = make_figure({});
    std::vector<Placement> placements(plain.size());
    place(plain, rest_pose(plain), placements);
    std::vector<Node> nodes = plain.nodes();
    const auto axes_of = [](std::size_t i) {
        rig::Transform t{
            .rotation = glm::angleAxis(0.9 * static_cast<double>(i), glm::normalize(glm::dvec3(1, 2, 3))),
            .scale = glm::dvec3(0.5 + 0.1 * static_cast<double>(i))};
        return t;
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        rig::Transform global = axes_of(i);
        global.translation = placements[i].position;
        nodes[i].rest = global;
        if (nodes[i].parent < 0) continue;
        const auto parent = static_cast<std::size_t>(nodes[i].parent);
        rig::Transform above = axes_of(parent);
        above.translation = placements[parent].position;
        nodes[i].rest = rig::relative(above, global);
    }
    const Skeleton turned = *Skeleton::make(nodes);
    const Soles soles = *find_soles(turned, match_bones(turned));
    expect_near(at_rest(turned, soles)[1].heel, {-0.1, 0, -0.05});
    expect_near(at_rest(turned, soles)[1].toe, {-0.1, 0, 0.15});
}

TEST(Soles, FindTheFloorOfAClip) {
    const Skeleton skeleton = make_figure({});
    const Soles soles = *find_soles(skeleton, match_bones(skeleton));
    Clip clip = FigureWalk(skeleton).clip();
    EXPECT_NEAR(clip_floor(skeleton, soles, clip), 0.0, 0.001);
    for (glm::dvec3& value : clip.channels[0].translation.values) value.y += 0.31;
    EXPECT_NEAR(clip_floor(skeleton, soles, clip), 0.31, 0.001);
    EXPECT_NEAR(clip_floor(skeleton, soles, {}), 0.0, 1e-9) << "a clip without keys is the rest pose";
}

/// The figure with feet that point straight down at rest, as in captured figures.
Skeleton pointing_figure() {
    std::vector<Node> nodes = make_figure({}).nodes();
    for (Node& node : nodes)
        if (node.name == "LeftFoot" || node.name == "RightFoot")
            node.rest.rotation = glm::angleAxis(1.2, glm::dvec3(1, 0, 0)) * node.rest.rotation;
    return *Skeleton::make(nodes);
}

TEST(Soles, AreLearnedFromAClipIfFeetDoNotRestFlat) {
    const Skeleton plain = make_figure({}), pointing = pointing_figure();
    const Clip walk = FigureWalk(plain).clip();
    const BoneMap map = match_bones(pointing);
    const Soles rest = *find_soles(pointing, map), learned = clip_soles(pointing, map, rest, walk);
    EXPECT_NE(learned, rest);
    const Soles right = *find_soles(plain, match_bones(plain));
    // In stance they match the plain figure's.
    std::vector<rig::Transform> pose(plain.size());
    std::vector<Placement> placements(plain.size());
    for (const double phase : {0.15, 0.25, 0.35}) {
        sample(walk, plain, phase * walk.duration, pose);
        place(plain, pose, placements);
        const SolePoints is = sole_points(learned, placements)[0], wanted = sole_points(right, placements)[0];
        const double worst_of_rest = std::abs(sole_points(rest, placements)[0].toe.y - wanted.toe.y);
        expect_near(is.heel, wanted.heel, 0.03);
        expect_near(is.toe, wanted.toe, 0.03);
        EXPECT_GT(worst_of_rest, 0.05);
    }
    EXPECT_NEAR(clip_floor(pointing, learned, walk), 0.0, 0.02);
    EXPECT_EQ(clip_soles(plain, match_bones(plain), right, walk), right) << "its feet stand as they rest";
    EXPECT_EQ(clip_soles(pointing, map, rest, Clip()), rest) << "nothing to learn from";
}

TEST(Soles, RefuseAnUnusableMap) {
    const Skeleton skeleton = make_figure({});
    BoneMap map = match_bones(skeleton);
    map[Bone::LeftFoot].node = -1;
    review(map, skeleton);
    EXPECT_TRUE(says(find_soles(skeleton, map).message(), "find_soles map LeftFoot"));
    map = match_bones(skeleton);
    map[Bone::Head].node = 1000;
    EXPECT_FALSE(find_soles(skeleton, map));
    map = match_bones(skeleton);
    map[Bone::LeftHand].node = map[Bone::RightUpperArm].node = -1;
    review(map, skeleton);
    EXPECT_TRUE(find_soles(skeleton, map)) << "feet need no hands";
    map.upright = false;
    EXPECT_FALSE(find_soles(skeleton, map));
    EXPECT_FALSE(find_soles(Skeleton(), BoneMap()));
    std::vector<Node> nodes = skeleton.nodes();
    map = match_bones(skeleton);
    nodes[static_cast<std::size_t>(map[Bone::LeftFoot].node)].rest.translation = glm::dvec3(0.0);
    EXPECT_FALSE(find_soles(*Skeleton::make(nodes), map)) << "a shin without a length";
}

}  // namespace
}  // namespace tendril::test
