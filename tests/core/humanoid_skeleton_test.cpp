// Skeletons in any node order, positions of nodes, and clips as glTF defines them.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <limits>
#include <random>
#include <tendril/humanoid/clip.hpp>

#include "tests/says.hpp"

namespace tendril::test {
namespace {

using namespace humanoid;

std::vector<Node> line(std::size_t count) {
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < count; ++i) {
        std::string name(1, 'n');
        name += std::to_string(i);
        nodes.push_back({name, static_cast<std::int32_t>(i) - 1, {}});
    }
    return nodes;
}

TEST(Skeleton, KeepsTheFilesOrderAndEvaluatesRootsFirst) {
    // 2 is the root; 0 is a child of 1, which is a child of 2.
    const auto skeleton =
        Skeleton::make({{"hand", 1, {}}, {"arm", 2, {}}, {"root", -1, {}}, {"other", -1, {}}});
    ASSERT_TRUE(skeleton);
    EXPECT_EQ(skeleton->order(), (std::vector<std::int32_t>{2, 1, 0, 3}));
    EXPECT_EQ(skeleton->children(2).front(), 1);
    EXPECT_TRUE(skeleton->is_below(0, 2));
    EXPECT_FALSE(skeleton->is_below(2, 0));
    EXPECT_EQ(skeleton->find("arm"), 1u);
    EXPECT_FALSE(skeleton->find("leg"));
}

TEST(Skeleton, RefusesInvalidTreesAndSaysWhere) {
    const auto message = [](std::vector<Node> nodes) {
        return std::string(Skeleton::make(std::move(nodes)).message());
    };
    EXPECT_TRUE(says(message({{"a", 1, {}}, {"b", 0, {}}}), "Skeleton nodes[0].parent below 1"));
    EXPECT_TRUE(
        says(message({{"below", 1, {}}, {"a", 2, {}}, {"b", 1, {}}}), "Skeleton nodes[1].parent below 2"));
    EXPECT_TRUE(says(message({{"a", -1, {}}, {"a", 0, {}}}), "Skeleton nodes[1].name nodes[0] a"));
    EXPECT_TRUE(says(message({{"", -1, {}}}), "Skeleton nodes[0].name empty"));
    EXPECT_TRUE(says(message({{"a", 1, {}}}), "Skeleton nodes[0].parent -1 1"));
    std::vector<Node> nodes = line(3);
    nodes[1].rest.scale.y = 0.0;
    EXPECT_TRUE(says(message(nodes), "Skeleton nodes[1].rest.scale.y non-zero 0"));
    nodes[1].rest.scale.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(message(nodes), "");
    EXPECT_NE(message(line(Skeleton::max_nodes + 1)), "");
    EXPECT_EQ(message(line(Skeleton::max_nodes)), "");
}

glm::dmat4 matrix(const rig::Transform& t) {
    return glm::translate(glm::dmat4(1.0), t.translation) * glm::mat4_cast(t.rotation) *
           glm::scale(glm::dmat4(1.0), t.scale);
}

TEST(Skeleton, NodesAreWhereTheMatrixProductPutsThem) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    for (int round = 0; round < 200; ++round) {
        std::vector<Node> nodes = line(8);
        for (Node& node : nodes) {
            for (int i = 0; i < 3; ++i) {
                node.rest.translation[i] = number(random);
                node.rest.scale[i] = 0.3 + std::abs(number(random));
            }
            for (int i = 0; i < 4; ++i) node.rest.rotation[i] = number(random);
        }
        const Skeleton skeleton = *Skeleton::make(nodes);
        std::vector<Placement> placements(skeleton.size());
        place(skeleton, rest_pose(skeleton), placements);
        glm::dmat4 product(1.0);
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            product = product * matrix(skeleton[i].rest);
            EXPECT_LT(glm::distance(placements[i].position, glm::dvec3(product[3])),
                      1e-9 * (1.0 + glm::length(glm::dvec3(product[3]))));
            const glm::dvec3 point(0.3, -0.2, 0.9);
            const glm::dvec3 there(product * glm::dvec4(point, 1.0));
            EXPECT_LT(glm::distance(placements[i].apply(point), there), 1e-9 * (1.0 + glm::length(there)));
            EXPECT_NEAR(glm::length(placements[i].rotation()), 1.0, 1e-12);
        }
    }
}

TEST(Placement, RotationEqualsATransformsAtAnyScale) {
    std::mt19937 random(4);
    std::normal_distribution<double> number;
    for (int round = 0; round < 1000; ++round) {
        rig::Transform t;
        for (int i = 0; i < 4; ++i) t.rotation[i] = number(random);
        t.rotation = rig::normalised(t.rotation);
        for (int i = 0; i < 3; ++i) t.scale[i] = std::exp(number(random));
        EXPECT_NEAR(std::abs(glm::dot(placement(t).rotation(), t.rotation)), 1.0, 1e-12);
    }
    for (const glm::dvec3 flat :
         {glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 1), glm::dvec3(1, 1, 0), glm::dvec3(0, 0, 0)}) {
        rig::Transform t{.scale = flat};
        const glm::dquat rotation = placement(t).rotation();
        EXPECT_NEAR(glm::length(rotation), 1.0, 1e-12) << "a scale of 0 leaves a rotation";
    }
}

Clip one_channel(Channel channel, double duration) {
    return {.name = "c", .duration = duration, .channels = {std::move(channel)}};
}
rig::Transform at(const Clip& clip, double time) {
    const Skeleton skeleton = *Skeleton::make(line(1));
    EXPECT_TRUE(check(clip, skeleton)) << check(clip, skeleton).message();
    std::vector<rig::Transform> pose(1);
    sample(clip, skeleton, time, pose);
    return pose[0];
}

TEST(Clip, InterpolationIsAsGltfDefinesIt) {
    Channel channel{.translation = {Interpolation::Step, {1.0, 2.0}, {{1, 0, 0}, {5, 0, 0}}}};
    EXPECT_EQ(at(one_channel(channel, 2.0), 0.0).translation.x, 1.0) << "before the first key its value";
    EXPECT_EQ(at(one_channel(channel, 2.0), 1.999).translation.x, 1.0);
    EXPECT_EQ(at(one_channel(channel, 2.0), 2.0).translation.x, 5.0);
    EXPECT_EQ(at(one_channel(channel, 2.0), 9.0).translation.x, 5.0);
    channel.translation.interpolation = Interpolation::Linear;
    EXPECT_DOUBLE_EQ(at(one_channel(channel, 2.0), 1.25).translation.x, 2.0);
    // A cubic through x = t^3 from 1 to 3 with tangents 3 t^2: exact everywhere.
    const auto cube = [](double t) { return glm::dvec3(t * t * t, 0, 0); };
    const auto slope = [](double t) { return glm::dvec3(3 * t * t, 0, 0); };
    channel.translation = {
        Interpolation::Cubic, {1.0, 3.0}, {slope(1), cube(1), slope(1), slope(3), cube(3), slope(3)}};
    for (double t = 1.0; t <= 3.0; t += 0.125)
        EXPECT_NEAR(at(one_channel(channel, 3.0), t).translation.x, t * t * t, 1e-12);
}

TEST(Clip, RotationsTakeTheShortWayAndStayUnit) {
    const glm::dquat none(1, 0, 0, 0), turned = glm::angleAxis(1.2, glm::dvec3(0, 1, 0));
    for (const glm::dquat& to : {turned, -turned}) {
        const Channel channel{.rotation = {Interpolation::Linear, {0.0, 1.0}, {none, to}}};
        const glm::dquat quarter = at(one_channel(channel, 1.0), 0.25).rotation;
        EXPECT_NEAR(std::abs(glm::dot(quarter, glm::angleAxis(0.3, glm::dvec3(0, 1, 0)))), 1.0, 1e-12);
    }
    const glm::dquat zero(0, 0, 0, 0);
    const Channel cubic{
        .rotation = {Interpolation::Cubic, {0.0, 1.0}, {zero, none, zero, zero, turned, zero}}};
    EXPECT_NEAR(glm::length(at(one_channel(cubic, 1.0), 0.4).rotation), 1.0, 1e-12);
    EXPECT_NEAR(std::abs(glm::dot(at(one_channel(cubic, 1.0), 0.5).rotation,
                                  glm::angleAxis(0.6, glm::dvec3(0, 1, 0)))),
                1.0, 1e-12);
}

TEST(Clip, HasAsManyFramesAsKeysDespiteRoundedTimes) {
    Clip clip{.name = "walk", .duration = 0.0, .channels = {{.node = 0}}};
    for (int i = 0; i < 4511; ++i) {
        clip.channels[0].translation.times.push_back(i * 0.0333333);
        clip.channels[0].translation.values.emplace_back(0.0);
    }
    clip.duration = 4510 * 0.0333333;
    EXPECT_EQ(frames_at(clip, 30.0).count, 4511u);
    EXPECT_DOUBLE_EQ(frames_at(clip, 30.0).time(4510), clip.duration);
    EXPECT_EQ(frames_at(clip, 60.0).count, 9021u) << "and those between them";
    EXPECT_DOUBLE_EQ(frames_at(clip, 60.0).step, 1.0 / 60.0);
    EXPECT_EQ(frames_at(Clip{.name = "still", .duration = 0.0, .channels = {}}, 30.0).count, 1u);
}

TEST(Clip, StepsHappenAtTheirKeysFrameDespiteRoundedTimes) {
    for (const double rate : {1001.0 / 30.0, 15.0, 24.0, 30.0, 60.0, 120.0, 452.0}) {
        Clip clip{.name = "steps", .channels = {{.node = 0}}};
        auto& [interpolation, times, values] = clip.channels[0].translation;
        interpolation = Interpolation::Step;
        for (int i = 0; i < 2'000; ++i) {
            times.push_back(static_cast<float>(i / rate));
            values.emplace_back(i, 0.0, 0.0);
        }
        clip.duration = times.back();
        for (const Frames& frames : {frames_at(clip, rate), Frames{times.size(), 1.0 / rate}})
            for (std::size_t i = 0; i < times.size(); ++i) {
                rig::Transform local;
                sample(clip.channels[0], frames.time(i), local);
                ASSERT_EQ(local.translation.x, static_cast<double>(i)) << rate;
            }
    }
}

TEST(Clip, RefusesInvalidClipsAndSaysWhere) {
    const Skeleton skeleton = *Skeleton::make(line(2));
    const auto message = [&](const Channel& channel, double duration = 5.0) {
        return std::string(check(one_channel(channel, duration), skeleton).message());
    };
    const Track<glm::dvec3> good{Interpolation::Linear, {0.0, 1.0}, {{0, 0, 0}, {1, 0, 0}}};
    EXPECT_EQ(message({.translation = good}), "");
    EXPECT_TRUE(says(message({.node = 2, .translation = good}), "Clip c channels[0].node 2"));
    Track<glm::dvec3> bad = good;
    bad.times[1] = 0.0;
    EXPECT_TRUE(says(message({.translation = bad}), "Clip c channels[0].translation.times[1] before 0"));
    bad.times[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(says(message({.translation = bad}), "Clip c channels[0].translation.times[1] duration nan"));
    bad = good;
    bad.values[0].y = std::numeric_limits<double>::infinity();
    EXPECT_NE(message({.scale = bad}).find("channels[0].scale.values[0]"), std::string::npos);
    bad = good;
    bad.values.pop_back();
    EXPECT_NE(message({.translation = bad}).find("values"), std::string::npos);
    EXPECT_NE(message({.rotation = {Interpolation::Linear, {0.0}, {{2, 0, 0, 0}}}}).find("unit quaternion"),
              std::string::npos);
    EXPECT_NE(message({.translation = good}, 0.5).find("duration"), std::string::npos);
    Clip twice = one_channel({.translation = good}, 1.0);
    twice.channels.push_back(twice.channels[0]);
    EXPECT_EQ(check(twice, skeleton).code(), ErrorCode::InvalidArgument);
}

}  // namespace
}  // namespace tendril::test
