// Cost of spring bones per bone and frame, in chains from one bone to many, swinging, at rest and held at the
// edge of their cone, against VRM's method.
//
// The baseline is VRM's method as specified (VRM Consortium, "VRMC_springBone-1.0"): bone after bone, Verlet
// integration with inertia, stiffness and drag, restoring the length, without colliders; here on the same
// skeleton code. It has a fixed frame rate, no damping ratio and no cone.
//
// A second table has the cost of colliders: ten that are out of reach, and ten of which one holds the chain.
//
// Claims: in the worst row at most 0.7 loops (measure.hpp) per bone, and under three and a half times VRM's;
// at most 0.01 loops for each bone and collider.
#define GLM_ENABLE_EXPERIMENTAL
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

#include "measure.hpp"
#include "tendril/humanoid/spring_chain.hpp"

namespace {

using namespace tendril::bench;
using namespace tendril::humanoid;
using glm::dquat;
using glm::dvec3;

constexpr int frames = 200;

/// A head on a body of four nodes, with `joints` joints on it, 0.5 m in total.
Skeleton make_skeleton(int joints) {
    std::vector<Node> nodes{{"a", -1, {}}, {"b", 0, {}}, {"c", 1, {}}, {"head", 2, {}}};
    for (std::size_t i = 1; i < 4; ++i) nodes[i].rest.translation = {0.0, 0.4, 0.0};
    for (int i = 0; i < joints; ++i) {
        nodes.push_back({"joint " + std::to_string(i), static_cast<std::int32_t>(nodes.size()) - 1, {}});
        nodes.back().rest.translation = {0.0, 0.5 / joints, 0.0};
    }
    return Skeleton::make(std::move(nodes)).value();
}

enum class Motion { Swings, Rests, AtEdge };

struct Chain {
    explicit Chain(int joints)
        : skeleton(make_skeleton(joints)),
          chain(SpringChain::make(skeleton, BoneMap(), 4).value()),
          rest(rest_pose(skeleton)),
          tails(rest.size()),
          previous(rest.size()) {}

    void move(Motion motion) {
        time += 1.0 / 60;
        pose = rest;
        if (motion == Motion::Rests) return;
        pose[0].translation.x = (motion == Motion::Swings ? 0.05 : 2.0) * std::sin(9.0 * time);
        pose[3].rotation = glm::angleAxis(0.4 * std::sin(7.0 * time), dvec3(0, 0, 1));
    }
    void springs(Motion motion, std::span<const PlacedCapsule> colliders = {}) {
        for (int i = 0; i < frames; ++i) {
            move(motion);
            chain.step(pose, {}, 1.0 / 60, state, colliders);
        }
    }
    /// The work that both share: the clip's own placements.
    void vrm(Motion motion) {
        for (int i = 0; i < frames; ++i) {
            move(motion);
            Placement at;
            for (std::size_t node = 0; node < pose.size(); ++node) {
                const Placement above = at;
                at = above * placement(pose[node]);
                if (node < 4) continue;
                const dvec3 bone =
                    node + 1 < pose.size() ? pose[node + 1].translation : rest[node].translation;
                const dvec3 goal = at.apply(bone) - at.position;
                const double length = glm::length(goal);
                const dvec3 inertia = (tails[node] - previous[node]) * (1.0 - 0.3);
                dvec3 next = tails[node] + inertia + goal * (4.0 / 60.0 / length);
                next = at.position + glm::normalize(next - at.position) * length;
                previous[node] = tails[node];
                tails[node] = next;
                const dquat turn = glm::rotation(goal / length, (next - at.position) / length);
                const dquat parent = above.rotation();
                pose[node].rotation =
                    glm::normalize(glm::conjugate(parent) * turn * parent * pose[node].rotation);
                at = above * placement(pose[node]);
            }
        }
    }

    Skeleton skeleton;
    SpringChain chain;
    std::vector<tendril::rig::Transform> rest, pose;
    SpringChainState state;
    std::vector<dvec3> tails, previous;
    double time = 0.0;
};

}  // namespace

int main(int count, char** arguments) {
    std::printf("%-8s%-10s%14s%14s%10s\n", "bones", "", "us a bone", "VRM's rule", "times");
    double worst = 0.0, worst_ratio = 0.0;
    for (const int joints : {1, 3, 6, 12, 40, 200}) {
        Chain chain(joints), other(joints);
        const char* const titles[]{"swings", "rests", "at edge"};
        for (const Motion motion : {Motion::Swings, Motion::Rests, Motion::AtEdge}) {
            const std::vector<double> seconds =
                race({[&] { chain.springs(motion); }, [&] { other.vrm(motion); }}, 31);
            const double us = seconds[0] * 1e6 / frames / joints, ratio = seconds[0] / seconds[1];
            std::printf("%-8d%-10s%14.3f%14.3f%10.2f\n", joints, titles[static_cast<int>(motion)], us,
                        seconds[1] * 1e6 / frames / joints, ratio);
            worst = std::max(worst, us);
            worst_ratio = std::max(worst_ratio, ratio);
        }
    }
    double worst_collider = 0.0;
    for (const bool holds : {false, true}) {
        std::vector<PlacedCapsule> colliders(10, {{5.0, 0.0, 0.0}, {5.0, 1.0, 0.0}, 0.1});
        if (holds) colliders.front() = {{0.5, 1.6, 0.0}, {0.5, 1.6, 0.0}, 0.55};
        Chain without(6), with(6);
        const std::vector<double> seconds = race(
            {[&] { without.springs(Motion::Swings); }, [&] { with.springs(Motion::Swings, colliders); }}, 31);
        const double ns = (seconds[1] - seconds[0]) * 1e9 / frames / 6 / 10;
        std::printf("%-18s%14.1f ns a bone and collider\n", holds ? "held by one of 10" : "10 out of reach",
                    ns);
        worst_collider = std::max(worst_collider, ns);
    }
    const bool clear = claim_loops("a bone and collider", 1e-9 * worst_collider, 0.01);
    const bool cheap = claim_loops("a bone, worst row", 1e-6 * worst, 0.7);
    const bool near = claim("3.5 times VRM's rule over springs, worst row", 3.5 / worst_ratio, 1.0);
    return (cheap && near && clear) || !has_flag(count, arguments, "--check") ? 0 : 1;
}
