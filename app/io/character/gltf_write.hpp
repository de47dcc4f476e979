// Characters and a clip of theirs as glTF 2.0, text or binary, made to pass the Khronos validator.
//
// A character that came from a glTF file keeps what that file has: nodes, skins, materials, meshes, pictures
// and extensions, all as they came; its animations give way to the one clip, of which what moves no node
// (morph weights) stays. Skin weights that do not add up to 1, which the format wants, are made to. Of
// another's, nodes and the clip are written, in metres, Y up, with a skin so that programs see a skeleton.
//
// Keys: those of the clip, with one at each frame besides where tracks are linear; rotations on one
// hemisphere. What is between keys is then what it was: a part of an arc is an arc, and steps and cubics
// keep their own keys.
#pragma once

#include <filesystem>
#include <string>

#include "app/io/character/character.hpp"

namespace tendril::app {

/// The file that a character came from; no bytes: it came from none, or from one that is no glTF.
struct GltfOrigin {
    std::string bytes{};
    std::filesystem::path folder{};
};

/// The whole file. `rate` is frames a second; 0: no keys besides the clip's. Throws std::runtime_error where
/// the origin cannot be read or has other nodes than the character.
std::string gltf_bytes(const Character& character, const humanoid::Clip& clip, double rate,
                       const GltfOrigin& origin, bool binary);

}  // namespace tendril::app
