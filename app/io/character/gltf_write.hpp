// Writes a character and one of its clips as glTF 2.0, text or binary, that passes the Khronos validator.
//
// A character from a glTF file keeps that file's contents: nodes, skins, materials, meshes, pictures and
// extensions. The clip replaces its animations, but keeps their channels that move no node (morph weights).
// Skin weights are normalised to sum to 1, as the format requires. Other characters are written as their
// nodes and the clip, in metres, Y up, with a skin so that programs recognise a skeleton. A mesh without
// pictures and morphs, such as the built-in figure's, is written too.
//
// The keys are the clip's, plus one at each frame in linear tracks that do not already have that rate;
// rotations are on one hemisphere. This preserves the motion between keys: a part of an arc is an arc, and
// steps and cubics keep their own keys.
#pragma once

#include <filesystem>
#include <string>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// The character's source file; no bytes if there is none, or it is not glTF.
struct GltfOrigin {
    std::string bytes{};
    std::filesystem::path folder{};
};

/// Triangles that follow nodes.
struct WornMesh {
    struct Corner {
        std::size_t node = 0;  ///< index into the dressed skeleton
        glm::dvec3 at{0.0};    ///< in the node's frame at rest, metres
    };
    std::string name{};
    glm::vec4 colour{1.0f};
    std::vector<Corner> corners{};
    std::vector<std::uint32_t> indices{};
};

/// Extra nodes for things that a character wears and holds, parents first, and their meshes. In a clip they
/// follow the character's own nodes.
struct Worn {
    std::vector<humanoid::Node> nodes{};
    std::vector<WornMesh> meshes{};
    /// The character's nodes, then these. Throws std::runtime_error if they are too many.
    humanoid::Skeleton dressed(const humanoid::Skeleton& bare) const {
        std::vector<humanoid::Node> all = bare.nodes();
        all.insert(all.end(), nodes.begin(), nodes.end());
        return skeleton_of(std::move(all));
    }
};

/// The whole file, of a character whose skeleton is dressed in `worn`. `rate` is frames per second; 0: no
/// keys besides the clip's. Throws std::runtime_error if the origin cannot be read or its nodes differ from
/// the character's.
std::string gltf_bytes(const Character& character, const humanoid::Clip& clip, double rate,
                       const GltfOrigin& origin, bool binary, const Worn& worn = {});

}  // namespace tendril::app
