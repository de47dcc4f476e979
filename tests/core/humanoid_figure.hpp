// A figure of 1.8 m in T-pose, arms along X, facing +Z, with configurable node names.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <tendril/humanoid/bone_map.hpp>

namespace tendril::test {

inline bool same_bits(const std::vector<rig::Transform>& a, const std::vector<rig::Transform>& b) {
    if (a.size() != b.size() || a.empty()) return a.size() == b.size();
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(rig::Transform)) == 0;
}

using namespace humanoid;

struct FigureNode {
    const char* key;     // the bone's name, or another key for other nodes
    const char* parent;  // "" for the root
    glm::dvec3 at;       // in the figure's space
};

inline const std::vector<FigureNode>& figure_nodes() {
    static const std::vector<FigureNode> nodes{{"Hips", "", {0, 1.0, 0}},
                                               {"Spine", "Hips", {0, 1.1, 0}},
                                               {"Chest", "Spine", {0, 1.2, 0}},
                                               {"UpperChest", "Chest", {0, 1.33, 0}},
                                               {"Neck", "UpperChest", {0, 1.5, 0}},
                                               {"Head", "Neck", {0, 1.6, 0}},
                                               {"Head end", "Head", {0, 1.8, 0}},
                                               {"LeftShoulder", "UpperChest", {0.05, 1.45, 0}},
                                               {"LeftUpperArm", "LeftShoulder", {0.18, 1.45, 0}},
                                               {"LeftLowerArm", "LeftUpperArm", {0.46, 1.45, 0}},
                                               {"LeftHand", "LeftLowerArm", {0.72, 1.45, 0}},
                                               {"LeftHand end", "LeftHand", {0.9, 1.45, 0}},
                                               {"RightShoulder", "UpperChest", {-0.05, 1.45, 0}},
                                               {"RightUpperArm", "RightShoulder", {-0.18, 1.45, 0}},
                                               {"RightLowerArm", "RightUpperArm", {-0.46, 1.45, 0}},
                                               {"RightHand", "RightLowerArm", {-0.72, 1.45, 0}},
                                               {"RightHand end", "RightHand", {-0.9, 1.45, 0}},
                                               {"LeftUpperLeg", "Hips", {0.1, 0.94, 0}},
                                               {"LeftLowerLeg", "LeftUpperLeg", {0.1, 0.52, 0.01}},
                                               {"LeftFoot", "LeftLowerLeg", {0.1, 0.09, 0}},
                                               {"LeftToes", "LeftFoot", {0.1, 0.02, 0.15}},
                                               {"LeftToes end", "LeftToes", {0.1, 0.02, 0.22}},
                                               {"RightUpperLeg", "Hips", {-0.1, 0.94, 0}},
                                               {"RightLowerLeg", "RightUpperLeg", {-0.1, 0.52, 0.01}},
                                               {"RightFoot", "RightLowerLeg", {-0.1, 0.09, 0}},
                                               {"RightToes", "RightFoot", {-0.1, 0.02, 0.15}},
                                               {"RightToes end", "RightToes", {-0.1, 0.02, 0.22}}};
    return nodes;
}

/// The figure with the nodes in `named`, in the order of figure_nodes(). A node without a name is omitted,
/// and its children are attached to its parent. `turn` is about Y.
inline Skeleton make_figure(const std::map<std::string, std::string>& named, double turn = 0.0) {
    std::vector<Node> nodes;
    std::map<std::string, std::pair<std::int32_t, glm::dvec3>> placed{{"", {-1, glm::dvec3(0.0)}}};
    const glm::dquat about_y = glm::angleAxis(turn, glm::dvec3(0, 1, 0));
    for (const FigureNode& each : figure_nodes()) {
        const auto name = named.find(each.key);
        const auto parent = placed.at(each.parent);
        if (name != named.end() && name->second.empty()) {
            placed[each.key] = parent;
            continue;
        }
        Node node{name == named.end() ? each.key : name->second, parent.first, {}};
        const glm::dvec3 at = about_y * each.at;
        node.rest.translation = at - parent.second;
        placed[each.key] = {static_cast<std::int32_t>(nodes.size()), at};
        nodes.push_back(node);
    }
    return *Skeleton::make(std::move(nodes));
}

/// The figure with its map and its rest pose.
struct Figured {
    Skeleton skeleton = make_figure({});
    BoneMap map = match_bones(skeleton);
    std::vector<rig::Transform> rest = rest_pose(skeleton);

    std::size_t node(Bone bone) const { return static_cast<std::size_t>(map[bone].node); }
    std::vector<Placement> placed(const std::vector<rig::Transform>& pose) const {
        std::vector<Placement> placements(skeleton.size());
        place(skeleton, pose, placements);
        return placements;
    }
    glm::dvec3 at(const std::vector<rig::Transform>& pose, Bone bone) const {
        return placed(pose)[node(bone)].position;
    }
};

/// Random numbers, vectors and rotations.
class RandomPoses {
  public:
    explicit RandomPoses(unsigned seed) : engine_(seed) {}
    double from(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    double operator()(double low, double high) { return from(low, high); }
    glm::dvec3 vector(double size) {
        const double x = from(-size, size), y = from(-size, size), z = from(-size, size);
        return {x, y, z};
    }
    glm::dquat rotation() {
        const glm::dvec3 axis = vector(1.0);
        const double w = from(-1.0, 1.0);
        return glm::normalize(glm::dquat(w, axis.x, axis.y, axis.z));
    }
    /// About any axis by up to `most` radians either way.
    glm::dquat turn(double most) {
        const glm::dvec3 axis = glm::normalize(vector(1.0) + glm::dvec3(0.0, 0.0, 1e-3));
        return glm::angleAxis(from(-most, most), axis);
    }

  private:
    std::mt19937 engine_;
};

inline double farthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::distance(a[i], b[i]));
    return most;
}

/// Positions of all nodes, metres.
inline std::vector<glm::dvec3> positions_of(const Skeleton& skeleton,
                                            const std::vector<rig::Transform>& pose) {
    std::vector<Placement> placements(skeleton.size());
    place(skeleton, pose, placements);
    std::vector<glm::dvec3> result;
    for (const Placement& each : placements) result.push_back(each.position);
    return result;
}

}  // namespace tendril::test
