// Trees for tests: a body, a spider, random ones; poses for them; and their invariant.
#pragma once

#include "chain_support.hpp"
#include "random.hpp"
#include "tendril/ik/tree.hpp"

namespace tendril::test {

using ik::Effector;
using ik::no_joint;
using ik::Status;
using ik::Tree;

using ik::TreeJoint;
using ik::TreeOptions;
using ik::TreeReport;

using TreeJointList = std::vector<TreeJoint>;
using Places = std::vector<glm::vec3>;

/// Makes a tree of valid joints: an invalid one ends the program.
inline Tree tree_of(std::span<const ik::TreeJoint> joints) {
    return Tree::make(joints).value();
}

/// Appends a chain of bones below `parent`; returns its last joint.
inline std::size_t grow(TreeJointList& joints, std::size_t parent, const std::vector<float>& lengths) {
    for (const float length : lengths) {
        joints.push_back({parent, length});
        parent = joints.size() - 1;
    }
    return parent;
}

inline TreeJointList only_root() {
    return {{no_joint, 0.0f}};
}

struct Figure {
    TreeJointList joints = only_root();
    std::vector<Effector> effectors;  ///< targets are set later
};

/// A spine with a head and two arms; human proportions in metres.
inline Figure body() {
    Figure figure;
    const std::size_t shoulders = grow(figure.joints, 0, {0.15f, 0.15f, 0.15f, 0.15f});
    figure.effectors.push_back({grow(figure.joints, shoulders, {0.1f, 0.2f})});
    figure.effectors.push_back({grow(figure.joints, shoulders, {0.18f, 0.3f, 0.27f, 0.1f})});
    figure.effectors.push_back({grow(figure.joints, shoulders, {0.18f, 0.3f, 0.27f, 0.1f})});
    return figure;
}

/// A spine of four bones with two legs on each.
inline Figure spider() {
    Figure figure;
    std::size_t back = 0;
    for (int i = 0; i < 4; ++i) {
        back = grow(figure.joints, back, {0.3f});
        for (int side = 0; side < 2; ++side)
            figure.effectors.push_back({grow(figure.joints, back, {0.15f, 0.4f, 0.4f, 0.3f})});
    }
    return figure;
}

/// A tree of 5 to 200 joints, bushy or in long chains; effectors on any joints, from few to a third.
inline Figure random_figure(Random& random) {
    Figure figure;
    const std::size_t count = 5 + random.below(196);
    const std::size_t kind = random.below(3), fork = kind == 1 ? 5 : 20;
    for (std::size_t k = 1; k < count; ++k) {
        const bool anywhere = kind == 0 || random.chance(fork);
        figure.joints.push_back({anywhere ? random.below(k) : k - 1, 0.05f + std::abs(random.around(1.0f))});
    }
    const std::size_t wanted = 1 + random.below(random.chance(2) ? 4 : count / 3 + 1);
    std::vector<bool> taken(count, false);
    for (std::size_t i = 0; i < wanted; ++i) {
        const std::size_t joint = 1 + random.below(count - 1);
        if (taken[joint]) continue;
        taken[joint] = true;
        const float weight = random.chance(2) ? 1.0f : 0.1f + std::abs(random.around(4.0f));
        figure.effectors.push_back({joint, glm::vec3(0.0f), weight});
    }
    return figure;
}

inline glm::vec3 random_direction(Random& random) {
    for (;;) {
        const glm::vec3 point = random.point(1.0f);
        const double size = distance(point, glm::vec3(0.0f));
        if (size < 1.0 && size > 0.05) return point * static_cast<float>(1.0 / size);
    }
}

/// `straight`: 0 for random directions; towards 1, increasingly along the parent's bone.
inline Places random_pose(const TreeJointList& joints, Random& random, float straight) {
    Places places(joints.size(), glm::vec3(0.0f)), along(joints.size(), random_direction(random));
    for (std::size_t k = 1; k < joints.size(); ++k) {
        const std::size_t parent = joints[k].parent;
        const glm::vec3 on = parent + 1 == k ? along[parent] : random_direction(random);
        const glm::vec3 way = random_direction(random) * (1.0f - straight) + on * straight;
        const float size = static_cast<float>(distance(way, glm::vec3(0.0f)));
        along[k] = size > 1e-3f ? way / size : on;
        places[k] = places[parent] + along[k] * joints[k].length;
    }
    return places;
}

/// All bones along one direction.
inline Places straight_pose(const TreeJointList& joints, glm::vec3 direction = {1, 0, 0}) {
    Places places(joints.size(), glm::vec3(0.0f));
    for (std::size_t k = 1; k < joints.size(); ++k)
        places[k] = places[joints[k].parent] + direction * joints[k].length;
    return places;
}

inline void aim(std::vector<Effector>& effectors, const Places& at) {
    for (Effector& effector : effectors) effector.target = at[effector.joint];
}

/// Every coordinate is finite and every bone has its length; beyond 1e3 m, to the spacing of floats.
inline testing::AssertionResult Holds(const TreeJointList& joints, const Places& places) {
    for (std::size_t k = 0; k < joints.size(); ++k) {
        double furthest = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!std::isfinite(places[k][axis])) return testing::AssertionFailure() << k << " is not finite";
            furthest = std::max(furthest, std::abs(static_cast<double>(places[k][axis])));
        }
        if (k == 0) continue;
        for (int axis = 0; axis < 3; ++axis)
            furthest = std::max(furthest, std::abs(static_cast<double>(places[joints[k].parent][axis])));
        const double length = static_cast<double>(joints[k].length);
        const double allowed = 1e-4 * std::max(1.0, length) + (furthest > 1e3 ? furthest * 2.4e-7 : 0.0);
        const double off = std::abs(distance(places[k], places[joints[k].parent]) - length);
        if (off > allowed)
            return testing::AssertionFailure() << "bone " << k << " of " << length << " m is off by " << off;
    }
    return testing::AssertionSuccess();
}

inline bool same_places(const Places& a, const Places& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const glm::vec3& p, const glm::vec3& q) { return same_bits(p, q); });
}

}  // namespace tendril::test
