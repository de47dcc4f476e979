// Spring bones follow the analytic solution at any frame rate, keep lengths and cone, and survive any input.
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <tendril/humanoid/spring_chain.hpp>

#include "humanoid_figure.hpp"
#include "memory.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

constexpr double two_pi = 2.0 * glm::pi<double>();

/// The figure with an antenna straight up from its head: nodes "antenna 1" to "antenna N", each 0.1 m.
Skeleton with_antenna(int joints) {
    std::vector<Node> nodes = make_figure({}).nodes();
    auto parent = static_cast<std::int32_t>(*make_figure({}).find("Head"));
    for (int i = 1; i <= joints; ++i) {
        Node node{"antenna " + std::to_string(i), parent, {}};
        node.rest.translation = {0.0, i == 1 ? 0.2 : 0.1, 0.0};
        parent = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(node);
    }
    return *Skeleton::make(std::move(nodes));
}

struct Antenna {
    explicit Antenna(int joints)
        : skeleton(with_antenna(joints)),
          map(match_bones(skeleton)),
          root(*skeleton.find("antenna 1")),
          chain(*SpringChain::make(skeleton, map, root)) {}

    /// The pose after a step with the hips at `at`, rotated by `turn`.
    std::vector<rig::Transform> step(const glm::dvec3& at, const glm::dquat& turn,
                                     const SpringOptions& options, double dt) {
        std::vector<rig::Transform> pose = rest_pose(skeleton);
        pose[0].translation = at;
        pose[0].rotation = turn;
        report = chain.step(pose, options, dt, state);
        return pose;
    }
    glm::dvec3 tip(const std::vector<rig::Transform>& pose) const {
        return positions_of(skeleton, pose).back();
    }
    std::vector<rig::Transform> step(const glm::dvec3& at, const SpringOptions& options, double dt) {
        return step(at, {1.0, 0.0, 0.0, 0.0}, options, dt);
    }

    Skeleton skeleton;
    BoneMap map;
    std::size_t root;
    SpringChain chain;
    SpringChainState state;
    SpringReport report;
};

/// Offset of the tip's mass from its target along X.
double tip_offset(const Antenna& antenna) {
    return antenna.state.masses.back().position.x - antenna.state.masses.back().target.x;
}

TEST(SpringChain, SwingsOutAsTheAnalyticSolution) {
    for (const double damping : {0.1, 0.35, 0.7}) {
        Antenna antenna(3);
        const SpringOptions options{.strength = 3.0, .critical_damping = damping};
        const double dt = 1.0 / 60, v = 0.2, w = two_pi * 3.0;
        double x = 0.0;
        for (int i = 0; i < 100; ++i) antenna.step({x += v * dt, 1.0, 0.0}, options, dt);
        EXPECT_LT(std::abs(tip_offset(antenna)), 1e-9) << "an even motion is followed without lag";
        // The base stops dead: y'' + 2 z w y' + w^2 y = 0 from y = 0 at y' = v.
        const double wd = w * std::sqrt(1.0 - damping * damping);
        for (int i = 1; i <= 200; ++i) {
            antenna.step({x, 1.0, 0.0}, options, dt);
            const double t = i * dt, exact = v / wd * std::exp(-damping * w * t) * std::sin(wd * t);
            ASSERT_NEAR(tip_offset(antenna), exact, 1e-9) << t;
        }
    }
}

TEST(SpringChain, ShakenAtItsBaseMatchesTheAnalyticAmplitude) {
    for (const double shaken : {0.5, 1.0, 2.0, 3.0, 5.0, 8.0}) {
        Antenna antenna(4);
        const double z = 0.3, w0 = two_pi * 3.0, w = two_pi * shaken, a = 0.005, dt = 1.0 / 240;
        const SpringOptions options{.strength = 3.0, .critical_damping = z};
        double largest = 0.0;
        for (int i = 0; i < 2400; ++i) {
            antenna.step({a * std::sin(w * i * dt), 1.0, 0.0}, options, dt);
            if (i > 1200) largest = std::max(largest, std::abs(tip_offset(antenna)));
        }
        const double exact =
            a * w * w / std::sqrt(std::pow(w0 * w0 - w * w, 2.0) + std::pow(2.0 * z * w0 * w, 2.0));
        EXPECT_NEAR(largest, exact, 0.02 * exact) << shaken << " Hz";
    }
}

TEST(SpringChain, BendsLikeABeamUnderAcceleration) {
    Antenna antenna(8);
    const double a = 2.0, dt = 1.0 / 240, w = two_pi * 2.0;
    for (int i = 0; i < 2400; ++i)
        antenna.step({0.5 * a * i * i * dt * dt, 1.0, 0.0}, {.critical_damping = 1.0}, dt);
    ASSERT_EQ(antenna.state.masses.size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
        const SpringMass& mass = antenna.state.masses[k];
        const double part = static_cast<double>(k + 1) / 8.0;
        const double beam = part * part * (6.0 - 4.0 * part + part * part) / 3.0;
        EXPECT_NEAR(mass.position.x - mass.target.x, -a / (w * w) * beam, 1e-4);
    }
}

/// Tip positions of an antenna of six joints, every 0.5 s for 4 s of a dance, in steps of about `dt`.
std::vector<glm::dvec3> tip_positions(double dt, std::mt19937* jitter) {
    Antenna antenna(6);
    std::vector<glm::dvec3> tips;
    double t = 0.0;
    for (int mark = 1; mark <= 8; ++mark)
        while (t < 0.5 * mark - 1e-9) {
            double step = dt;
            if (jitter != nullptr) step *= std::uniform_real_distribution<double>(0.5, 1.5)(*jitter);
            step = std::min(step, 0.5 * mark - t);
            t += step;
            const glm::dquat turn = glm::angleAxis(0.6 * std::sin(4.0 * t), glm::dvec3(0, 0, 1));
            const glm::dvec3 at(0.3 * std::sin(3.0 * t), 1.0 + 0.04 * std::sin(12.0 * t), 1.2 * t);
            tips.resize(static_cast<std::size_t>(mark), glm::dvec3(0.0));
            tips.back() = antenna.tip(antenna.step(at, turn, {}, step));
        }
    return tips;
}

TEST(SpringChain, FrameRatesMakeLittleDifference) {
    const std::vector<glm::dvec3> exact = tip_positions(1.0 / 2000, nullptr);
    std::mt19937 random(3);
    const auto worst = [&](double rate, std::mt19937* jitter) {
        const std::vector<glm::dvec3> tips = tip_positions(1.0 / rate, jitter);
        double far = 0.0;
        for (std::size_t i = 0; i < tips.size(); ++i) far = std::max(far, glm::distance(tips[i], exact[i]));
        RecordProperty("mm_at_" + std::to_string(static_cast<int>(rate)), std::to_string(1e3 * far));
        return far;
    };
    // Metres, for an antenna of 0.6 m that swings out by about 0.2 m.
    EXPECT_LT(worst(240.0, nullptr), 0.002);
    EXPECT_LT(worst(144.0, nullptr), 0.003);
    EXPECT_LT(worst(60.0, nullptr), 0.01);
    EXPECT_LT(worst(60.0, &random), 0.02);
    EXPECT_LT(worst(30.0, nullptr), 0.03);
    EXPECT_LT(worst(15.0, nullptr), 0.08);
}

TEST(SpringChain, KeepsLengthsConeAndAllOtherNodes) {
    RandomPoses number(5);
    Antenna antenna(5);
    double farthest = 0.0;
    for (int frame = 0; frame < 3000; ++frame) {
        const double x = number(-0.3, 0.3), y = number(0.8, 1.2), z = number(-0.3, 0.3);
        const SpringOptions options{.critical_damping = 0.1, .max_angle = 0.5};
        const std::vector<rig::Transform> pose = antenna.step({x, y, z}, options, 1.0 / 60);
        ASSERT_TRUE(antenna.report.accepted);
        farthest = std::max(farthest, antenna.report.angle);
        for (std::size_t k = 0; k < antenna.state.masses.size(); ++k) {
            const SpringMass& mass = antenna.state.masses[k];
            ASSERT_LE(glm::distance(mass.position, mass.target), 0.1 * static_cast<double>(k + 1) + 1e-9)
                << "no farther than the chain is long up to there";
        }
        const std::vector<rig::Transform> rest = rest_pose(antenna.skeleton);
        const std::vector<glm::dvec3> at = positions_of(antenna.skeleton, pose);
        for (std::size_t i = antenna.root; i + 1 < at.size(); ++i)
            ASSERT_LE(std::acos(std::min(1.0, (at[i + 1].y - at[i].y) / 0.1)), 0.5 + 1e-7);
        for (std::size_t i = 1; i < pose.size(); ++i) {
            ASSERT_EQ(pose[i].translation, rest[i].translation);
            ASSERT_EQ(pose[i].scale, rest[i].scale);
            if (i < antenna.root) {
                ASSERT_EQ(pose[i].rotation, rest[i].rotation);
            }
        }
    }
    EXPECT_NEAR(farthest, 0.5, 1e-9);
    // Released, it returns to rest.
    for (int frame = 0; frame < 1200; ++frame) antenna.step({0.0, 1.0, 0.0}, {}, 1.0 / 60);
    EXPECT_LT(antenna.report.angle, 1e-4);
    EXPECT_LT(antenna.report.speed, 1e-4);
}

TEST(SpringChain, WeightBlendsFromTheExactPose) {
    Antenna still(4), half(4), whole(4);
    for (int frame = 0; frame < 20; ++frame) {
        const glm::dvec3 at(0.002 * frame * frame, 1.0, 0.0);
        const std::vector<rig::Transform> pose = still.step(at, {.weight = 0.0}, 1.0 / 60);
        std::vector<rig::Transform> clip = rest_pose(still.skeleton);
        clip[0].translation = at;
        ASSERT_EQ(pose, clip);
        const auto bent = [&](Antenna& antenna, double weight) {
            const rig::Transform first = antenna.step(at, {.weight = weight}, 1.0 / 60)[antenna.root];
            return 2.0 * std::acos(std::min(1.0, first.rotation.w));
        };
        const double full = bent(whole, 1.0), part = bent(half, 0.5);
        if (frame < 10) continue;
        EXPECT_GT(full, 0.01);
        EXPECT_NEAR(part, 0.5 * full, 1e-6);
    }
}

TEST(SpringChain, WithoutTimeThePoseStaysAtItsMasses) {
    Antenna antenna(4);
    std::vector<rig::Transform> last;
    for (int frame = 0; frame < 10; ++frame) last = antenna.step({0.02 * frame, 1.0, 0.0}, {}, 1.0 / 60);
    const SpringChainState before = antenna.state;
    for (const double dt : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        const std::vector<rig::Transform> again = antenna.step({0.18, 1.0, 0.0}, {}, dt);
        EXPECT_EQ(antenna.state, before);
        for (std::size_t i = 0; i < again.size(); ++i)
            EXPECT_GT(std::abs(glm::dot(again[i].rotation, last[i].rotation)), 1.0 - 1e-12);
    }
}

TEST(SpringChain, TeleportDoesNotSwingAndDraggingDoes) {
    Antenna carried(4), dragged(4), put(4);
    for (Antenna* each : {&carried, &dragged, &put})
        for (int frame = 0; frame < 10; ++frame) each->step({0.0, 1.0, 0.0}, {}, 1.0 / 60);
    std::vector<rig::Transform> pose = rest_pose(carried.skeleton);
    pose[0].translation = {0.5, 1.0, 0.0};
    carried.chain.teleport(pose, {}, carried.state);
    double rest = 0.0, swung = 0.0;
    for (int frame = 0; frame < 60; ++frame) {
        carried.step({0.5, 1.0, 0.0}, {}, 1.0 / 60);
        rest = std::max(rest, carried.report.angle);
        dragged.step({0.5, 1.0, 0.0}, {}, 1.0 / 60);
        swung = std::max(swung, dragged.report.angle);
    }
    EXPECT_LT(rest, 1e-9);
    EXPECT_GT(swung, 0.5);
    put.step({20.0, 1.0, 0.0}, {}, 1.0 / 60);
    EXPECT_EQ(put.report.angle, 0.0) << "1 200 m/s is no motion";
}

TEST(SpringChain, ATeleportInPlaceKeepsTheVelocity) {
    Antenna antenna(4), other(4);
    for (int frame = 0; frame < 60; ++frame) {
        const glm::dvec3 at(0.1 * std::sin(0.2 * frame), 1.0, 0.0);
        antenna.step(at, {}, 1.0 / 60);
        other.step(at, {}, 1.0 / 60);
        std::vector<rig::Transform> pose = rest_pose(antenna.skeleton);
        pose[0].translation = at;
        antenna.chain.teleport(pose, {}, antenna.state);
        ASSERT_EQ(antenna.state, other.state);
    }
    EXPECT_GT(other.report.angle, 0.01);
}

/// A character a hundred times as large swings by equal angles.
TEST(SpringChain, SizeMakesNoDifference) {
    Antenna small(4), large(4);
    for (int frame = 0; frame < 60; ++frame) {
        const glm::dvec3 at(0.2 * std::sin(0.2 * frame), 1.0, 0.0);
        small.step(at, {}, 1.0 / 60);
        SpringOptions options;
        options.root.scale = glm::dvec3(100.0);
        large.step(at, options, 1.0 / 60);
        ASSERT_NEAR(small.report.angle, large.report.angle, 1e-9);
    }
    EXPECT_GT(small.report.angle, 0.01);
}

/// Tips stay outside of one sphere or capsule that passes through the antenna, and bones keep their lengths.
TEST(SpringChain, StaysOutsideAColliderWithLengthsKept) {
    RandomPoses number(7);
    int held = 0;
    for (int run = 0; run < 200; ++run) {
        Antenna antenna(5);
        const SpringOptions options{.strength = number(0.5, 8.0), .hit_radius = number(0.0, 0.03)};
        const bool is_sphere = run % 2 == 0;
        const double radius = number(0.01, 0.3);
        const glm::dvec3 middle(number(-0.2, 0.2), number(2.0, 2.4), number(-0.2, 0.2));
        const glm::dvec3 along(number(-0.3, 0.3), number(-0.3, 0.3), number(-0.3, 0.3));
        const glm::dvec3 pace(number(-1.0, 1.0), number(-1.0, 1.0), number(-1.0, 1.0));
        for (int frame = 0; frame < 60; ++frame) {
            const glm::dvec3 at = middle + pace * (frame / 60.0 - 0.5);
            const PlacedCapsule collider{at, is_sphere ? at : at + along, radius};
            std::vector<rig::Transform> pose = rest_pose(antenna.skeleton);
            pose[0].translation = {0.1 * std::sin(0.3 * frame), 1.0, 0.0};
            antenna.report = antenna.chain.step(pose, options, 1.0 / 60, antenna.state, {&collider, 1});
            ASSERT_TRUE(antenna.report.accepted);
            const std::vector<glm::dvec3> points = positions_of(antenna.skeleton, pose);
            for (std::size_t i = antenna.root; i + 1 < points.size(); ++i) {
                ASSERT_NEAR(glm::distance(points[i], points[i + 1]), 0.1, 1e-12);
                const auto apart = [&](const glm::dvec3& point) {
                    return gap({point, point, options.hit_radius}, collider);
                };
                // A bone that starts too deep inside cannot reach the surface.
                const double reachable = std::min(0.0, apart(points[i]) + 0.1);
                if (!is_sphere && reachable < 0.0) continue;
                ASSERT_GE(apart(points[i + 1]), reachable - 1e-6)
                    << run << " frame " << frame << " tip " << i;
            }
            for (const SpringMass& mass : antenna.state.masses) held += mass.held ? 1 : 0;
        }
    }
    EXPECT_GT(held, 1000);
}

TEST(SpringChain, LeansOnAColliderAndLeavesItWithoutABounce) {
    Antenna antenna(3);
    const PlacedCapsule wall{{0.6, 2.0, 0.0}, {0.6, 2.0, 0.0}, 0.65};  // 5 cm into its upright pose
    std::vector<rig::Transform> pose;
    for (int frame = 0; frame < 300; ++frame) {
        pose = rest_pose(antenna.skeleton);
        antenna.report = antenna.chain.step(pose, {}, 1.0 / 60, antenna.state, {&wall, 1});
    }
    EXPECT_LT(antenna.report.speed, 1e-9) << "it comes to rest";
    EXPECT_TRUE(antenna.state.masses[1].held);
    EXPECT_NEAR(glm::distance(antenna.tip(pose), wall.from), wall.radius, 1e-6);
    const std::vector<rig::Transform> leaning = pose;
    pose = rest_pose(antenna.skeleton);
    const SpringChainState before = antenna.state;
    antenna.chain.step(pose, {}, 0.0, antenna.state, {&wall, 1});
    EXPECT_EQ(antenna.state, before) << "no time passes";
    EXPECT_LT(glm::distance(antenna.tip(pose), antenna.tip(leaning)), 1e-9);
    // The collider is removed: the chain returns to its pose and overshoots no more than by its spring.
    double other_side = 0.0;
    const double start = -antenna.tip(leaning).x;
    ASSERT_GT(start, 0.02);
    for (int frame = 0; frame < 300; ++frame)
        other_side = std::max(other_side, antenna.tip(antenna.step({0.0, 1.0, 0.0}, {}, 1.0 / 60)).x);
    EXPECT_LT(other_side, 0.6 * start);
    EXPECT_LT(antenna.report.angle, 1e-4);
}

TEST(SpringChain, AcceptsBranchesAndASingleNode) {
    std::vector<Node> nodes = make_figure({}).nodes();
    const auto head = static_cast<std::int32_t>(*make_figure({}).find("Head"));
    const auto add = [&](const char* name, std::int32_t parent, glm::dvec3 at) {
        nodes.push_back({name, parent, {}});
        nodes.back().rest.translation = at;
        return static_cast<std::int32_t>(nodes.size()) - 1;
    };
    const std::int32_t horn = add("horn", head, {0, 0.2, 0});
    const std::int32_t fork = add("fork", horn, {0, 0.1, 0});
    add("left prong", fork, {0.05, 0.1, 0});
    add("right prong", fork, {-0.05, 0.1, 0});
    add("ear", head, {0.1, 0.1, 0});
    add("mark", head, {0.0, 0.0, 0.0});
    const Skeleton skeleton = *Skeleton::make(std::move(nodes));
    const BoneMap map = match_bones(skeleton);
    SpringChain antler = *SpringChain::make(skeleton, map, *skeleton.find("horn"));
    EXPECT_EQ(antler.bones().size(), 4u);
    SpringChain ear = *SpringChain::make(skeleton, map, *skeleton.find("ear"));
    EXPECT_EQ(ear.bones().size(), 1u);
    SpringChainState antler_state, ear_state;
    double bent = 0.0;
    for (int frame = 0; frame < 20; ++frame) {
        std::vector<rig::Transform> pose = rest_pose(skeleton);
        pose[0].translation.z += frame < 10 ? 0.02 * frame : 0.2;
        EXPECT_TRUE(antler.step(pose, {}, 1.0 / 60, antler_state).accepted);
        const SpringReport report = ear.step(pose, {}, 1.0 / 60, ear_state);
        bent = std::max(bent, report.angle);
    }
    EXPECT_GT(bent, 0.05);
    const auto refusal = [&](const char* name) {
        return std::string(SpringChain::make(skeleton, map, *skeleton.find(name)).error().message());
    };
    EXPECT_TRUE(says(refusal("mark"), "SpringChain root length mark"));
    EXPECT_TRUE(says(refusal("Neck"), "SpringChain root bone body Neck"));
    EXPECT_TRUE(says(refusal("Hips"), "SpringChain root parent Hips"));
    EXPECT_FALSE(SpringChain::make(skeleton, map, skeleton.size()));
}

TEST(SpringChain, SurvivesAnyInputWithoutAllocating) {
    RandomPoses number(11);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Antenna antenna(5);
    antenna.step({0, 1, 0}, {}, 0.1);
    for (int round = 0; round < 20000; ++round) {
        std::vector<rig::Transform> pose = rest_pose(antenna.skeleton);
        for (rig::Transform& each : pose) {
            for (int i = 0; i < 4; ++i) each.rotation[i] = number(-1.0, 1.0);
            each.rotation = rig::normalised(each.rotation);
            const double size = std::pow(10.0, number(-12.0, round % 2 == 0 ? 0.0 : 8.0));
            for (int i = 0; i < 3; ++i) each.translation[i] = size * number(-1.0, 1.0);
            if (round % 5 == 0) each.scale.y = number(-1.0, 1.0) * std::pow(10.0, number(-6.0, 3.0));
            if (round % 11 == 0) each.scale.x = 0.0;
        }
        if (round % 13 == 0) pose[3].translation.y = nan;
        if (round % 17 == 0) {
            for (auto& mass : antenna.state.masses) {
                mass.velocity.x = std::pow(10.0, number(-300.0, 300.0));
                mass.position.y = std::pow(10.0, number(-300.0, 300.0));
            }
        }
        const SpringOptions options{.strength = std::pow(10.0, number(-2.0, 2.0)),
                                    .critical_damping = number(0.0, 10.0),
                                    .weight = number(0.0, 1.0),
                                    .max_angle = number(0.0, 3.12),
                                    .hit_radius = round % 2 == 0 ? 0.0 : number(0.0, 1000.0)};
        std::vector<PlacedCapsule> colliders(static_cast<std::size_t>(round % 4));
        for (PlacedCapsule& each : colliders) {
            const double size = std::pow(10.0, number(-12.0, 6.0));
            for (int i = 0; i < 3; ++i) each.from[i] = size * number(-1.0, 1.0);
            for (int i = 0; i < 3; ++i) each.to[i] = size * number(-1.0, 1.0);
            if (round % 5 == 0) each.to = each.from;
            if (round % 9 == 0) each.from = each.to = pose[antenna.root].translation;
            each.radius = round % 19 == 0 ? nan : std::pow(10.0, number(-12.0, 9.0));
        }
        const double dt = std::pow(10.0, number(-12.0, 12.0));
        const std::vector<rig::Transform> before = pose;
        const SpringChainState state = antenna.state;
        SpringReport report;
        without_memory([&] {
            report = round % 3 == 0 ? antenna.chain.teleport(pose, options, antenna.state)
                                    : antenna.chain.step(pose, options, dt, antenna.state, colliders);
        });
        if (round % 19 == 0 && round % 3 != 0 && !colliders.empty()) {
            ASSERT_FALSE(report.accepted);
        }
        if (!report.accepted) {
            ASSERT_EQ(0, std::memcmp(pose.data(), before.data(), pose.size() * sizeof(rig::Transform)));
            ASSERT_EQ(0, std::memcmp(antenna.state.masses.data(), state.masses.data(),
                                     state.masses.size() * sizeof(SpringMass)));
            continue;
        }
        ASSERT_TRUE(std::isfinite(report.angle) && std::isfinite(report.speed)) << round;
        for (const rig::Transform& each : pose) ASSERT_NEAR(glm::length(each.rotation), 1.0, 1e-9) << round;
        if (round % 3 == 0) continue;
        for (const auto& mass : antenna.state.masses) {
            ASSERT_TRUE(std::isfinite(glm::dot(mass.position, mass.position))) << round;
            ASSERT_TRUE(std::isfinite(glm::dot(mass.velocity, mass.velocity))) << round;
        }
    }
}

}  // namespace
}  // namespace tendril::test
