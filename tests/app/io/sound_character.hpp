// Invariants of a character that a reader accepts, whatever the bytes were.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <tendril/humanoid/clip.hpp>
#include <vector>

#include "app/io/character/character.hpp"

namespace tendril::app::test_sound {

inline bool is_finite(const glm::dvec3& value) {
    return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

inline const char* fault_of_pose(const Character& character, std::span<const rig::Transform> pose) {
    std::vector<humanoid::Placement> placements(pose.size());
    humanoid::place(character.skeleton, pose, placements);
    for (std::size_t i = 0; i < pose.size(); ++i) {
        const glm::dquat& turn = pose[i].rotation;
        if (!is_finite(pose[i].translation) || !std::isfinite(turn.x + turn.y + turn.z + turn.w))
            return "a node has a number that is not finite";
        if (!is_finite(placements[i].position)) return "a node is nowhere";
    }
    if (!character.skin.mesh) return nullptr;
    const SkinDraw draw{character.skin.mesh, skin_matrices(character.skin, placements)};
    for (std::size_t i = 0; i < draw.mesh->positions.size(); i += draw.mesh->positions.size() / 20 + 1)
        if (!is_finite(glm::dvec3(skinned(draw, i)))) return "a vertex is nowhere";
    return nullptr;
}

inline const char* fault_of_skin(const Character& character) {
    const SkinnedMesh& mesh = *character.skin.mesh;
    for (const SkinJoint& each : character.skin.joints)
        if (each.node >= character.skeleton.size()) return "a joint of the skin is no node";
    for (const std::uint32_t each : mesh.indices)
        if (each >= mesh.positions.size()) return "a triangle has a vertex that there is not";
    for (const SkinPart& each : mesh.parts) {
        if (each.first > mesh.indices.size() || each.count > mesh.indices.size() - each.first)
            return "a part has triangles that there are not";
        if (each.picture >= static_cast<std::int32_t>(mesh.pictures.size()))
            return "a part has a picture that there is not";
    }
    for (const glm::vec2& each : mesh.uvs)
        if (!std::isfinite(each.x) || !std::isfinite(each.y)) return "a texture coordinate is not finite";
    for (const JointWeights& each : mesh.weights)
        for (std::size_t i = 0; i < 4; ++i)
            if (each.joints[i] >= mesh.joints || !std::isfinite(each.weights[i]))
                return "a weight is not finite, or its joint is not there";
    return nullptr;
}

/// The first fault found; null if the character can be played and drawn.
inline const char* fault_of(const Character& character) {
    if (character.skeleton.size() == 0) return "it has no nodes";
    if (!std::isfinite(character.scale) || !(character.scale > 0.0)) return "its scale is none";
    for (const NamedSpring& each : character.springs)
        if (each.node >= character.skeleton.size() || !std::isfinite(each.strength + each.critical_damping))
            return "a spring is on no node, or not finite";
    if (character.skin.mesh)
        if (const char* fault = fault_of_skin(character)) return fault;
    std::vector<rig::Transform> pose = humanoid::rest_pose(character.skeleton);
    if (const char* fault = fault_of_pose(character, pose)) return fault;
    for (std::size_t i = 0; i < std::min<std::size_t>(character.clips.size(), 20); ++i) {
        const humanoid::Clip& clip = character.clips[i];
        if (!humanoid::check(clip, character.skeleton)) return "a clip does not hold";
        for (const double part : {0.0, 0.37, 1.0}) {
            humanoid::sample(clip, character.skeleton, part * clip.duration, pose);
            if (const char* fault = fault_of_pose(character, pose)) return fault;
        }
    }
    return nullptr;
}

}  // namespace tendril::app::test_sound
