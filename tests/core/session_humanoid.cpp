#include "fnv.hpp"
#include "humanoid_figure.hpp"
#include "random.hpp"
#include "session.hpp"
#include "tendril/humanoid/bent_chain.hpp"
#include "tendril/humanoid/body.hpp"
#include "tendril/humanoid/feet.hpp"
#include "tendril/humanoid/hold.hpp"
#include "tendril/humanoid/spring_chain.hpp"

namespace tendril::test {
namespace {

/// A vector with multiples of 2^-16 from -1 to 1, exact.
glm::dvec3 some_vector(Random& random) {
    const auto part = [&] { return (static_cast<double>(random.below(1u << 17)) - 65536.0) / 65536.0; };
    const double x = part(), y = part(), z = part();
    return {x, y, z};
}

void add(Fnv& hash, const std::vector<rig::Transform>& pose) {
    for (const rig::Transform& each : pose) {
        for (int axis = 0; axis < 3; ++axis) hash.add(each.translation[axis]);
        for (const double part : {each.rotation.x, each.rotation.y, each.rotation.z, each.rotation.w})
            hash.add(part);
    }
}

/// A bar held in both hands; only the left grip sets a rotation.
void add_hold(Fnv& hash, Body& body, const std::vector<rig::Transform>& rest, Random& random) {
    std::vector<Grip> grips{{Effector::LeftHand, {0.1875, 0.0, 0.0}},
                            {Effector::RightHand, {-0.1875, 0.0, 0.0}}};
    grips[0].rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    BodyState body_state;
    HoldState state;
    for (int frame = 0; frame < 20; ++frame) {
        const glm::dvec3 turn = 0.25 * some_vector(random);
        const ObjectPose asked{glm::dvec3(0.0, 1.25, 0.5) + 0.25 * some_vector(random),
                               rig::normalised(glm::dquat(1.0, turn.x, turn.y, turn.z))};
        auto pose = rest;
        const auto report = hold(body, pose, {}, {grips, asked}, body_state, state);
        hash.add(report ? report->moved : -1.0);
        add(hash, pose);
    }
}

/// Bends the spine along a curve.
void add_bend(Fnv& hash, const Skeleton& skeleton, const std::vector<rig::Transform>& rest, Random& random) {
    BentChain spine = *BentChain::make(skeleton, *skeleton.find("Spine"), *skeleton.find("Head"));
    for (int frame = 0; frame < 20; ++frame) {
        auto pose = rest;
        std::vector<glm::vec3> points = spine.points_through(pose, 3);
        for (glm::vec3& each : points) each += glm::vec3(0.25 * some_vector(random));
        const auto report = spine.bend(pose, points, {.fit = frame % 2 == 0, .roll_end = 0.5f});
        hash.add(static_cast<double>(report.factor));
        add(hash, pose);
    }
}

}  // namespace

std::uint64_t humanoid_hash() {
    Fnv hash;
    Random random(11);
    const Skeleton skeleton = make_figure({});
    const BoneMap map = match_bones(skeleton);
    const auto rest = rest_pose(skeleton);
    const auto capsules = default_capsules(skeleton, map);
    Body free = *Body::make(skeleton, map),
         held = *Body::make(skeleton, map, default_limits(skeleton, map), capsules);
    const Feet feet = *Feet::make(skeleton, map);
    const Ground stairs = *Ground::stairs(0.125, 0.25);
    BodyState free_state, held_state;
    FeetState feet_state;
    // A map without bones leaves the left arm to the spring chain.
    SpringChain arm = *SpringChain::make(skeleton, BoneMap(), *skeleton.find("LeftShoulder"));
    SpringChainState arm_state;
    for (int frame = 0; frame < 300; ++frame) {
        std::vector<BodyTarget> targets;
        for (std::size_t i = 0; i < effector_count; ++i)
            if (random.chance(2))
                targets.push_back(
                    {static_cast<Effector>(i), glm::dvec3(0.0, 1.0, 0.0) + some_vector(random)});
        auto pose = rest;
        for (const Bone bone : {Bone::LeftUpperLeg, Bone::RightUpperLeg, Bone::LeftUpperArm, Bone::Chest}) {
            const glm::dvec3 turn = 0.25 * some_vector(random);
            pose[static_cast<std::size_t>(map[bone].node)].rotation =
                rig::normalised(glm::dquat(1.0, turn.x, turn.y, turn.z));
        }
        pose[0].translation += glm::dvec3(0.0, 0.0, frame / 256.0);
        auto walked = pose;
        static_cast<void>(feet.step(walked, stairs, 1.0 / 64.0, feet_state));
        add(hash, walked);
        arm.step(walked, {.critical_damping = 0.125}, 1.0 / 64.0, arm_state);
        add(hash, walked);
        for (Body* body : {&free, &held}) {
            auto solved = pose;
            const auto report = body->solve(solved, targets, body == &free ? free_state : held_state);
            hash.add(report ? report->residual : -1.0);
            add(hash, solved);
        }
    }
    add_hold(hash, held, rest, random);
    add_bend(hash, skeleton, rest, random);
    return hash.value();
}

}  // namespace tendril::test
