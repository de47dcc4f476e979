// Chains of a character along a curve: positions of the joints, followers, fixed nodes, and any input.
#include <cstring>
#include <tendril/humanoid/bent_chain.hpp>
#include <tendril/rig/transform_units.hpp>

#include "humanoid_figure.hpp"
#include "memory.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using Pose = std::vector<rig::Transform>;
using Points = std::vector<glm::vec3>;

constexpr std::size_t tail_bones = 8;

/// The figure with a tail of nine joints, 0.1 m apart, straight back from the hips. Each joint has axes of
/// its own at rest.
Skeleton with_tail() {
    std::vector<Node> nodes = make_figure({}).nodes();
    std::int32_t parent = 0;
    glm::dquat turned(1.0, 0.0, 0.0, 0.0);  // the parent's rotation
    for (std::size_t i = 0; i <= tail_bones; ++i) {
        const glm::dquat turn =
            glm::angleAxis(0.7 * static_cast<double>(i), glm::normalize(glm::dvec3(1, 2, 3)));
        Node node{"tail " + std::to_string(i), parent, {}};
        node.rest.translation = glm::conjugate(turned) * glm::dvec3(0.0, i == 0 ? 0.05 : 0.0, -0.1);
        node.rest.rotation = rig::normalised(glm::conjugate(turned) * turn);
        turned = turn;
        parent = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(node);
    }
    return *Skeleton::make(std::move(nodes));
}

struct Tail {
    Skeleton skeleton = with_tail();
    BentChain chain = *BentChain::make(skeleton, *skeleton.find("tail 0"), *skeleton.find("tail 8"));
    Pose rest = rest_pose(skeleton);

    std::vector<Placement> placed(const Pose& pose) const {
        std::vector<Placement> at(skeleton.size());
        place(skeleton, pose, at);
        return at;
    }
    /// The rest pose, randomly rotated, bent and moved; bone lengths as at rest.
    template <class Random>
    Pose random_pose(Random& random) const {
        Pose pose = rest;
        std::normal_distribution<double> normal;
        const auto turn = [&](double size) {
            return glm::angleAxis(size * normal(random),
                                  glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
        };
        for (rig::Transform& each : pose) each.rotation = rig::normalised(each.rotation * turn(0.3));
        pose[0].rotation = turn(2.0);
        pose[0].translation = {normal(random), 1.0, normal(random)};
        return pose;
    }
};

template <class Random>
Points random_points(Random& random, std::size_t count, float size) {
    std::normal_distribution<float> normal(0.0f, size);
    Points points(count);
    for (glm::vec3& each : points) each = {normal(random), normal(random), normal(random)};
    return points;
}

double angle_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat turn = glm::inverse(a) * b;
    return 2.0 * std::atan2(glm::length(glm::dvec3(turn.x, turn.y, turn.z)), std::abs(turn.w));
}

bool is_finite(const Pose& pose) {
    for (const rig::Transform& each : pose)
        if (!rig::checked(each, "pose", "node")) return false;
    return true;
}

/// Joints lie where ik::place_along() puts them, wherever the hips are and whatever the pose was.
TEST(BentChain, LiesAlongItsCurve) {
    Tail tail;
    std::mt19937 random(1);
    const std::vector<float> lengths(tail_bones, 0.1f);
    for (int i = 0; i < 300; ++i) {
        Pose pose = tail.random_pose(random);
        const auto before = tail.placed(pose);
        const Points points = random_points(random, 1 + random() % 6, 0.4f);
        const auto kind = i % 2 == 0 ? ik::CurveKind::Hermite : ik::CurveKind::BSpline;
        const ik::CurveReport report = tail.chain.bend(pose, points, {.kind = kind});
        ASSERT_NE(report.status, ik::Status::InvalidInput);
        const auto after = tail.placed(pose);
        const Placement space = tail.chain.space(before);
        const std::size_t first = tail.chain.nodes().front();
        const glm::dvec3 root = glm::conjugate(space.rotation()) * (before[first].position - space.position);

        Points curve{glm::vec3(0.0f)}, joints(tail_bones + 1);
        for (const glm::vec3& each : points) curve.push_back(glm::vec3(glm::dvec3(each) - root));
        ik::State state(tail_bones);
        ik::CurveMemory none;
        const ik::CurveReport expected =
            ik::place_along(curve, {lengths}, joints, state, none, {.kind = kind});
        EXPECT_EQ(report.status, expected.status);
        EXPECT_EQ(report.bones_past_end,
                  expected.status == ik::Status::Stretched ? expected.bones_past_end : 0u);
        EXPECT_NEAR(report.past_end, expected.past_end, 1e-5);
        for (std::size_t k = 0; k <= tail_bones; ++k) {
            const glm::dvec3& at = after[tail.chain.nodes()[k]].position;
            ASSERT_LT(glm::distance(at, space.apply(root + glm::dvec3(joints[k]))), 1e-5) << i << ' ' << k;
            if (k == 0) continue;
            ASSERT_NEAR(glm::distance(at, after[tail.chain.nodes()[k - 1]].position), 0.1, 1e-6);
        }
    }
}

TEST(BentChain, KeepsAPoseThatLiesOnItsCurve) {
    Tail tail;
    Pose pose = tail.rest;
    const Points straight = tail.chain.points_through(pose, 4);
    ASSERT_EQ(straight.size(), 4u);
    EXPECT_LT(glm::distance(straight.back(), glm::vec3(0.0f, 0.05f, -0.9f)), 1e-6f);
    EXPECT_EQ(tail.chain.bend(pose, straight).status, ik::Status::Converged);
    for (std::size_t i = 0; i < pose.size(); ++i)
        EXPECT_LT(angle_between(pose[i].rotation, tail.rest[i].rotation), 1e-5) << i;
    // A spine that is bowed at rest keeps its rotations on a curve through its joints.
    std::vector<Node> nodes = tail.skeleton.nodes();
    for (Node& each : nodes)
        if (each.name.starts_with("tail"))
            each.rest.rotation =
                rig::normalised(each.rest.rotation * glm::angleAxis(0.15, glm::dvec3(1, 0, 0)));
    const Skeleton bowed = *Skeleton::make(std::move(nodes));
    BentChain chain = *BentChain::make(bowed, *bowed.find("tail 0"), *bowed.find("tail 8"));
    const Pose rest = rest_pose(bowed);
    pose = rest;
    EXPECT_EQ(chain.bend(pose, chain.points_through(pose, tail_bones)).status, ik::Status::Converged);
    for (std::size_t i = 0; i < pose.size(); ++i)
        EXPECT_LT(angle_between(pose[i].rotation, rest[i].rotation), 5e-3) << i;
}

TEST(BentChain, AtWeightZeroKeepsThePosesBits) {
    Tail tail;
    std::mt19937 random(2);
    for (int i = 0; i < 50; ++i) {
        const Pose given = tail.random_pose(random);
        const Points points = random_points(random, 3, 0.5f);
        Pose pose = given;
        EXPECT_NE(tail.chain.bend(pose, points, {.fit = true, .weight = 0.0f}).status,
                  ik::Status::InvalidInput);
        EXPECT_TRUE(same_bits(pose, given));
        // The first half of the bones follows the pose, as does everything but the tail.
        std::array<float, tail_bones> weights{};
        for (std::size_t k = 4; k < tail_bones; ++k) weights[k] = 1.0f;
        EXPECT_NE(tail.chain.bend(pose, points, {.weights = weights}).status, ik::Status::InvalidInput);
        EXPECT_FALSE(same_bits(pose, given));
        for (std::size_t k = 4; k < tail_bones; ++k)
            pose[tail.chain.nodes()[k]] = given[tail.chain.nodes()[k]];
        EXPECT_TRUE(same_bits(pose, given));
    }
    // At weight one half, a bone is half way.
    Pose half = tail.rest, full = tail.rest;
    const Points aside{{0.3f, 0.05f, -0.4f}, {0.8f, 0.05f, -0.4f}};
    EXPECT_EQ(tail.chain.bend(half, aside, {.weight = 0.5f}).status, ik::Status::Converged);
    EXPECT_EQ(tail.chain.bend(full, aside).status, ik::Status::Converged);
    const auto rest_at = tail.placed(tail.rest), half_at = tail.placed(half), full_at = tail.placed(full);
    for (const std::size_t node : tail.chain.nodes().first(tail_bones)) {
        const double turn = angle_between(rest_at[node].rotation(), full_at[node].rotation());
        EXPECT_NEAR(angle_between(rest_at[node].rotation(), half_at[node].rotation()), 0.5 * turn, 1e-4);
    }
}

/// Everything attached to a spine follows it; nothing else turns.
TEST(BentChain, CarriesItsChildren) {
    const Skeleton skeleton = make_figure({});
    BentChain spine = *BentChain::make(skeleton, *skeleton.find("Spine"), *skeleton.find("Neck"));
    ASSERT_EQ(spine.bones(), 3u);
    const Pose rest = rest_pose(skeleton);
    Pose pose = rest;
    EXPECT_NE(spine.bend(pose, Points{{0.1f, 0.3f, 0.1f}, {0.4f, 0.5f, 0.1f}}).status,
              ik::Status::InvalidInput);
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const bool turns =
            i != spine.nodes().back() && std::ranges::find(spine.nodes(), i) != spine.nodes().end();
        EXPECT_EQ(pose[i].rotation == rest[i].rotation, !turns) << skeleton[i].name;
        EXPECT_EQ(pose[i].translation, rest[i].translation);
    }
    const auto was = positions_of(skeleton, rest), is = positions_of(skeleton, pose);
    const auto apart = [&](const auto& at, const char* a, const char* b) {
        return glm::distance(at[*skeleton.find(a)], at[*skeleton.find(b)]);
    };
    EXPECT_GT(glm::distance(was[*skeleton.find("Head")], is[*skeleton.find("Head")]), 0.1);
    EXPECT_NEAR(apart(is, "Neck", "Head"), apart(was, "Neck", "Head"), 1e-12);
    EXPECT_NEAR(apart(is, "UpperChest", "LeftHand"), apart(was, "UpperChest", "LeftHand"), 1e-12);
    EXPECT_EQ(is[*skeleton.find("LeftFoot")], was[*skeleton.find("LeftFoot")]);
}

/// The points are in the parent's space: bone rotations are the same wherever the hips move.
TEST(BentChain, FollowsItsParent) {
    Tail tail;
    std::mt19937 random(3);
    const Points points = random_points(random, 4, 0.3f);
    Pose here = tail.rest;
    tail.chain.bend(here, points);
    ik::CurveMemory memory(tail_bones);
    for (int i = 0; i < 100; ++i) {
        Pose there = tail.random_pose(random);
        there[0].scale = glm::dvec3(1.0);
        const ik::CurveReport report = tail.chain.bend(there, points, {}, memory);
        EXPECT_FALSE(report.jumped) << "the hips moved, not the curve";
        for (const std::size_t node : tail.chain.nodes().first(tail_bones).subspan(1))
            EXPECT_LT(angle_between(here[node].rotation, there[node].rotation), 1e-5);
    }
}

TEST(BentChain, ScalesItsBonesToFit) {
    Tail tail;
    for (const float way : {0.5f, 0.8f, 1.2f}) {
        Pose pose = tail.rest;
        const ik::CurveReport report =
            tail.chain.bend(pose, Points{{0.0f, 0.05f, -0.1f - way}}, {.fit = true});
        EXPECT_EQ(report.status, ik::Status::Converged);
        EXPECT_NEAR(report.factor, way / 0.8f, 1e-5);
        const auto at = tail.placed(pose);
        EXPECT_LT(glm::distance(at[tail.chain.nodes().back()].position - at[0].position,
                                glm::dvec3(0.0, 0.05, -0.1 - static_cast<double>(way))),
                  1e-5);
    }
    Pose pose = tail.rest;
    EXPECT_NEAR(tail.chain.bend(pose, Points{{0.0f, 0.05f, -9.0f}}, {.fit = true, .max_factor = 1.5f}).factor,
                1.5f, 1e-6f);
}

TEST(BentChain, RollsFromItsStartToItsEnd) {
    Tail tail;
    const Points straight = tail.chain.points_through(tail.rest, 3);
    Pose pose = tail.rest;
    tail.chain.bend(pose, straight, {.roll_start = 0.5f, .roll_end = -1.5f});
    const auto was = tail.placed(tail.rest), is = tail.placed(pose);
    for (std::size_t i = 0; i < tail_bones; ++i) {
        const std::size_t node = tail.chain.nodes()[i];
        const double roll = 0.5 - 2.0 * static_cast<double>(i) / (tail_bones - 1);
        const glm::dquat wanted = glm::angleAxis(roll, glm::dvec3(0, 0, -1)) * was[node].rotation();
        EXPECT_LT(angle_between(is[node].rotation(), wanted), 1e-3) << i;
    }
}

/// On a straight curve every bone turns by the same shortest arc, in any direction.
TEST(BentChain, TurnsByTheShortestArc) {
    Tail tail;
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto was = tail.placed(tail.rest);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 way =
            i == 0 ? glm::dvec3(0, 1, 0)
                   : glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
        Pose pose = tail.rest;
        tail.chain.bend(pose, Points{glm::vec3(glm::dvec3(0.0, 0.05, -0.1) + way)});
        const auto is = tail.placed(pose);
        const glm::dquat turn = rig::from_two_vectors(glm::dvec3(0, 0, -1), way);
        for (const std::size_t node : tail.chain.nodes().first(tail_bones))
            ASSERT_LT(angle_between(is[node].rotation(), turn * was[node].rotation()), 1e-3) << i;
    }
}

/// A clip may translate a node within its parent: its bone then has the clip's length, and lies on the curve.
TEST(BentChain, FollowsTheCurveWithThePosesLengths) {
    Tail tail;
    std::mt19937 random(8);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 100; ++i) {
        Pose pose = tail.rest;
        for (const std::size_t node : tail.chain.nodes().subspan(1))
            pose[node].translation += 0.03 * glm::dvec3(normal(random), normal(random), normal(random));
        const auto before = tail.placed(pose);
        const glm::vec3 start(0.0f, 0.05f, -0.1f), way(0.6f, 0.0f, -0.8f);
        tail.chain.bend(pose, Points{start + way, start + 3.0f * way});
        const auto after = tail.placed(pose);
        double along = 0.0;
        for (std::size_t k = 1; k <= tail_bones; ++k) {
            const std::size_t node = tail.chain.nodes()[k], above = tail.chain.nodes()[k - 1];
            along += glm::distance(before[node].position, before[above].position);
            const glm::dvec3 on_curve =
                before[tail.chain.nodes()[0]].position + along * glm::dvec3(glm::normalize(way));
            ASSERT_LT(glm::distance(after[node].position, on_curve), 1e-5) << i << ' ' << k;
        }
    }
}

/// On a curve that swings, rises and closes to a loop, no bone turns much more per frame than the curve does.
TEST(BentChain, RollDoesNotJumpOnALoopingCurve) {
    Tail tail;
    Pose before;
    for (int frame = 0; frame <= 720; ++frame) {
        const float angle = glm::radians(0.5f * static_cast<float>(frame));
        Points points;
        for (int i = 1; i <= 12; ++i) {  // a helix about the tail whose radius grows and shrinks again
            const float along = static_cast<float>(i) / 12.0f, radius = 0.2f * std::sin(0.5f * angle);
            const float turn = 6.3f * along + angle;
            points.push_back({radius * (std::cos(turn) - std::cos(angle)),
                              0.05f + radius * (std::sin(turn) - std::sin(angle)), -0.1f - 0.6f * along});
        }
        Pose pose = tail.rest;
        ASSERT_NE(tail.chain.bend(pose, points).status, ik::Status::InvalidInput);
        const auto is = tail.placed(pose);
        if (!before.empty()) {
            const auto was = tail.placed(before);
            for (const std::size_t node : tail.chain.nodes().first(tail_bones))
                ASSERT_LT(angle_between(was[node].rotation(), is[node].rotation()), 0.1) << frame;
        }
        before = pose;
    }
}

/// A mirrored or scaled parent does not change the joints' positions.
TEST(BentChain, LiesAlongItsCurveUnderAScale) {
    std::mt19937 random(4);
    for (const glm::dvec3 scale : {glm::dvec3(2.0), glm::dvec3(0.01), glm::dvec3(-1.0, 1.0, 1.0)}) {
        std::vector<Node> nodes = with_tail().nodes();
        nodes[0].rest.scale = scale;
        const Skeleton skeleton = *Skeleton::make(std::move(nodes));
        BentChain chain = *BentChain::make(skeleton, *skeleton.find("tail 0"), *skeleton.find("tail 8"));
        const auto size = static_cast<float>(std::abs(scale.x));
        const std::vector<float> lengths(tail_bones, 0.1f * size);
        for (int i = 0; i < 50; ++i) {
            Pose pose = rest_pose(skeleton);
            std::vector<Placement> placed(skeleton.size());
            place(skeleton, pose, placed);
            const Placement space = chain.space(placed);
            const glm::dvec3 root = placed[chain.nodes().front()].position;
            const glm::dvec3 seen = glm::conjugate(space.rotation()) * (root - space.position);
            const Points points = random_points(random, 3, 0.4f * size);
            Points curve{glm::vec3(0.0f)}, joints(tail_bones + 1);
            for (const glm::vec3& each : points) curve.push_back(glm::vec3(glm::dvec3(each) - seen));
            ik::State state(tail_bones);
            ik::CurveMemory none;
            ik::place_along(curve, {lengths}, joints, state, none);
            ASSERT_NE(chain.bend(pose, points).status, ik::Status::InvalidInput);
            place(skeleton, pose, placed);
            for (std::size_t k = 0; k <= tail_bones; ++k)
                ASSERT_LT(glm::distance(placed[chain.nodes()[k]].position,
                                        space.apply(seen + glm::dvec3(joints[k]))),
                          2e-5 * static_cast<double>(size))
                    << scale.x << ' ' << k;
        }
    }
}

TEST(BentChain, AnyInputGivesFinitePoses) {
    Tail tail;
    std::mt19937 random(5);
    const glm::vec3 root(0.0f, 0.05f, -0.1f);
    Pose pose = tail.rest;
    ik::CurveReport report = tail.chain.bend(pose, Points(5, root));
    EXPECT_TRUE(report.collapsed);
    for (std::size_t i = 0; i < pose.size(); ++i)
        EXPECT_LT(angle_between(pose[i].rotation, tail.rest[i].rotation), 1e-5) << "straight on, as at rest";
    for (const Points& points :
         {Points{root + glm::vec3(0, 0, 1)}, Points{glm::vec3(1e9f)},
          Points{glm::vec3(1e-30f), glm::vec3(1e9f)}, Points(BentChain::max_points, glm::vec3(1.0f)),
          random_points(random, 256, 1e4f),
          Points{{0, 0.05f, -0.2f}, {0, 0.05f, -0.3f}, {0, 0.05f, -0.2f}, {0, 0.05f, -0.1f}}})
        for (const bool fit : {false, true}) {
            pose = tail.random_pose(random);
            report = tail.chain.bend(pose, points, {.fit = fit, .roll_end = 1e6f, .weight = 0.7f});
            EXPECT_NE(report.status, ik::Status::InvalidInput);
            EXPECT_TRUE(is_finite(pose));
        }
    // These are refused and change nothing.
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Points good{{0.1f, 0.0f, -0.5f}};
    const std::array<float, 3> three{1.0f, 1.0f, 1.0f};
    const auto refuses = [&](const Points& points, const ik::CurveOptions& options = {}) {
        const Pose given = pose = tail.random_pose(random);
        ik::CurveMemory memory(tail_bones);
        const ik::CurveMemory before = memory;
        return tail.chain.bend(pose, points, options, memory).status == ik::Status::InvalidInput &&
               same_bits(pose, given) && memory == before;
    };
    EXPECT_TRUE(refuses({}));
    EXPECT_TRUE(refuses({{nan, 0.0f, 0.0f}}));
    EXPECT_TRUE(refuses({{0.0f, std::numeric_limits<float>::infinity(), 0.0f}}));
    EXPECT_TRUE(refuses(Points(BentChain::max_points + 1, root)));
    EXPECT_TRUE(refuses(good, {.fit = true, .max_factor = 1.0f}));
    EXPECT_TRUE(refuses(good, {.weights = three}));
    EXPECT_FALSE(refuses(good));
    Pose bad = tail.rest;
    bad[3].translation.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(tail.chain.bend(bad, good).status, ik::Status::InvalidInput);
    bad.pop_back();
    EXPECT_EQ(tail.chain.bend(bad, good).status, ik::Status::InvalidInput);
    EXPECT_TRUE(tail.chain.points_through(bad, 3).empty());
}

TEST(BentChain, RefusesBadChainsByName) {
    const Skeleton skeleton = with_tail();
    const std::size_t first = *skeleton.find("tail 0"), last = *skeleton.find("tail 8");
    const auto refusal = [&](std::size_t from, std::size_t to) {
        return std::string(BentChain::make(skeleton, from, to).message());
    };
    EXPECT_TRUE(says(refusal(first, skeleton.size()), "BentChain skeleton"));
    EXPECT_TRUE(says(refusal(last, first), "BentChain last below first tail 0"));
    EXPECT_TRUE(says(refusal(first, first), "last below first"));
    EXPECT_TRUE(says(refusal(*skeleton.find("LeftHand"), last), "last below first tail 8"));
    const Skeleton point = *Skeleton::make({{"a", -1, {}}, {"b", 0, {}}, {"c", 1, {}}});
    EXPECT_TRUE(says(BentChain::make(point, 0, 2).message(), "first length a"));
}

TEST(BentChain, GivesTheSameBitsWithoutAllocating) {
    Tail tail, again;
    std::mt19937 random(6);
    ik::CurveMemory memory(tail_bones);
    for (int i = 0; i < 20; ++i) {
        const Pose given = tail.random_pose(random);
        const Points points = random_points(random, 5, 0.4f);
        Pose a = given, b = given;
        without_memory([&] { tail.chain.bend(a, points, {.fit = i % 2 == 0, .weight = 0.8f}, memory); });
        again.chain.bend(b, points, {.fit = i % 2 == 0, .weight = 0.8f});
        EXPECT_TRUE(same_bits(a, b)) << "it remembers nothing";
    }
}

}  // namespace
}  // namespace tendril::test
