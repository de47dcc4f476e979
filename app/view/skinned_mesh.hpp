// A skin: triangles whose corners follow joints, as values without GL. Made once, shared, and drawn with the
// joints' matrices of the frame (app/view/renderer_skin.hpp).
//
// Linear blend skinning (N. Magnenat-Thalmann, R. Laperriere, D. Thalmann, "Joint-dependent local
// deformations for hand animation and object grasping", Graphics Interface 1988): a corner p is at the sum of
// weight * matrix * p, over four joints at the most.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tendril::app {

/// Three rows of an affine matrix: x, y, z of a point are the rows' products with (x, y, z, 1).
using AffineRows = std::array<glm::vec4, 3>;

/// Which joints a corner follows, and how much: the weights are 1 together.
struct JointWeights {
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{1.0f, 0.0f, 0.0f, 0.0f};
};

struct Picture {
    glm::ivec2 size{0};
    std::vector<std::uint8_t> rgba{};  ///< rows from the top, where v is 0
};

/// Triangles with one material.
struct SkinPart {
    std::uint32_t first = 0, count = 0;  ///< of the indices
    glm::vec4 colour{0.8f, 0.8f, 0.8f, 1.0f};
    std::int32_t picture = -1;  ///< multiplies the colour; -1: none
    float cutoff = 0.0f;        ///< what has a smaller alpha is not there
};

/// A shape to blend in: what `count` corners from `first` on move by at a weight of 1.
struct MorphTarget {
    std::string name{};
    std::uint32_t first = 0;
    float weight = 0.0f;                            ///< where nothing is animated
    std::vector<glm::vec3> positions{}, normals{};  ///< one each; normals: or none
};

struct SkinnedMesh {
    std::vector<glm::vec3> positions{};  ///< as bound; metres
    std::vector<glm::vec3> normals{};    ///< unit, as many
    std::vector<JointWeights> weights{};
    std::vector<glm::vec2> uvs{};      ///< as many as positions, or none
    std::vector<glm::u8vec4> tints{};  ///< multiply the colour; as many, or none
    std::vector<std::uint32_t> indices{};
    std::vector<SkinPart> parts{};
    std::vector<Picture> pictures{};
    std::vector<MorphTarget> morphs{};
    std::size_t joints = 0;  ///< matrices that it wants: those that weights name are under it
};

/// A skin in a frame.
struct SkinDraw {
    std::shared_ptr<const SkinnedMesh> mesh{};
    std::vector<AffineRows> matrices{};  ///< one a joint
    std::vector<float> morph_weights{};  ///< one a morph, or none: the morphs' own
    float opacity = 1.0f;                ///< 1: solid; less: what is inside shows through
    glm::vec3 tint{1.0f};                ///< multiplies every colour
    /// Of the corners, one each; they may name matrices beyond those of the mesh's joints. Null: the mesh's.
    std::shared_ptr<const std::vector<JointWeights>> weights{};
};

/// The corners with morphs blended in.
void apply_morphs(const SkinnedMesh& mesh, std::span<const float> weights, std::vector<glm::vec3>& positions,
                  std::vector<glm::vec3>& normals);
/// Where a corner is; what the shader does, for tests and for picking.
glm::vec3 skinned(const SkinDraw& draw, std::size_t corner);

}  // namespace tendril::app
