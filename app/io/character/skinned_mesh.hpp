// Skins as values: triangles that follow joints. One is built once, shared, and drawn each frame with the
// joints' matrices (app/view/renderer_skin.hpp).
//
// Linear blend skinning (N. Magnenat-Thalmann, R. Laperriere, D. Thalmann, "Joint-dependent local
// deformations for hand animation and object grasping", Graphics Interface 1988): a vertex p moves to the sum
// of weight * matrix * p over at most four joints.
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

/// Three rows of an affine matrix: a point's x, y, z become the rows' dot products with (x, y, z, 1).
using AffineRows = std::array<glm::vec4, 3>;

/// The joints that a vertex follows; the weights sum to 1.
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
    std::uint32_t first = 0, count = 0;  ///< range of the indices
    glm::vec4 colour{0.8f, 0.8f, 0.8f, 1.0f};
    std::int32_t picture = -1;  ///< multiplies the colour; -1: none
    float cutoff = 0.0f;        ///< fragments with a smaller alpha are discarded
};

/// A blend shape: at weight 1, the displacement of the vertices from `first` on.
struct MorphTarget {
    std::string name{};
    std::uint32_t first = 0;
    float weight = 0.0f;                            ///< if not animated
    std::vector<glm::vec3> positions{}, normals{};  ///< one per vertex; normals may be empty
};

struct SkinnedMesh {
    std::vector<glm::vec3> positions{};  ///< in the bind pose; metres
    std::vector<glm::vec3> normals{};    ///< unit, one per position
    std::vector<JointWeights> weights{};
    std::vector<glm::vec2> uvs{};      ///< one per position, or empty
    std::vector<glm::u8vec4> tints{};  ///< multiply the colour; one per position, or empty
    std::vector<std::uint32_t> indices{};
    std::vector<SkinPart> parts{};
    std::vector<Picture> pictures{};
    std::vector<MorphTarget> morphs{};
    std::size_t joints = 0;  ///< number of matrices; all joints in `weights` are less
};

/// A skin to draw in one frame.
struct SkinDraw {
    std::shared_ptr<const SkinnedMesh> mesh{};
    std::vector<AffineRows> matrices{};  ///< one per joint
    std::vector<float> morph_weights{};  ///< one per morph; missing weights are the morphs' own
    float opacity = 1.0f;                ///< 1: solid; less: transparent
    glm::vec3 tint{1.0f};                ///< multiplies every colour
    /// One per vertex; they may use matrices beyond those for the mesh's joints. Null: the mesh's weights.
    std::shared_ptr<const std::vector<JointWeights>> weights{};
};

/// The vertices with morphs blended in.
void apply_morphs(const SkinnedMesh& mesh, std::span<const float> weights, std::vector<glm::vec3>& positions,
                  std::vector<glm::vec3>& normals);
/// The position of a vertex, as the shader computes it, for tests and picking.
glm::vec3 skinned(const SkinDraw& draw, std::size_t corner);

}  // namespace tendril::app
