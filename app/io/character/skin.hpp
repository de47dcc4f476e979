// What a character wears: its meshes as one, bound to the skeleton's nodes, and the clips of its morphs.
//
//     draw.mesh = character.skin.mesh;
//     draw.matrices = skin_matrices(character.skin, placements);
//     draw.morph_weights = morph_weights(character.skin, clip, seconds);
#pragma once

#include <memory>
#include <span>
#include <tendril/humanoid/capsules.hpp>
#include <tendril/humanoid/clip.hpp>
#include <vector>

#include "app/view/skinned_mesh.hpp"

namespace tendril::app {

/// A joint of the skin: `from_bind`, then the node's placement, takes a corner as bound to where it is.
/// Metres.
struct SkinJoint {
    std::size_t node = 0;
    humanoid::Placement from_bind{};
};

/// Weights of morphs over a clip's time.
struct MorphTrack {
    std::size_t first = 0, count = 0;  ///< of the mesh's morphs
    humanoid::Interpolation interpolation = humanoid::Interpolation::Linear;
    std::vector<double> times{};   ///< as a clip's
    std::vector<double> values{};  ///< `count` a key; cubic: three times that, as a clip's are
};

struct Skin {
    std::shared_ptr<const SkinnedMesh> mesh{};           ///< null: the file has none
    std::vector<SkinJoint> joints{};                     ///< the mesh's, in its order
    std::vector<std::vector<MorphTrack>> morph_clips{};  ///< one list a clip, in the clips' order, or none
};

/// For SkinDraw::matrices. `placements` are of all nodes, as humanoid::place() gives them.
std::vector<AffineRows> skin_matrices(const Skin& skin, std::span<const humanoid::Placement> placements);
/// Every corner where that takes it, for humanoid::fitted_capsules(); `rest`: the placements at rest.
std::vector<humanoid::SkinPoint> skin_points(const Skin& skin, std::span<const humanoid::Placement> rest);
/// For SkinDraw::morph_weights; a clip without tracks leaves the morphs' own.
std::vector<float> morph_weights(const Skin& skin, std::size_t clip, double time);

/// Corners stay as they are bound; what they come out as is `times` as large.
void scale_skin(Skin& skin, double times);

/// Meshes put together while a file is read: corners, then triangles over them, then their morphs.
class SkinBuilder {
  public:
    static constexpr std::size_t max_corners = 4'000'000, max_indices = 30'000'000, max_joints = 16'000;

    /// The place of a new joint.
    std::size_t add_joint(std::size_t node, const humanoid::Placement& from_bind);
    /// Corners of a part; lists beside the positions have as many, or are empty. `influences` are joint and
    /// weight for each corner, any number: the four strongest stay, and are made 1 together. Throws
    /// std::runtime_error where there are too many corners.
    struct Corners {
        std::vector<glm::vec3> positions, normals;
        std::vector<glm::vec2> uvs;
        std::vector<glm::u8vec4> tints;
        std::vector<std::vector<std::pair<std::size_t, double>>> influences;
        std::size_t only_joint = 0;  ///< of corners without influences
    };
    /// Triangles, their material, and what `indices` say of the corners from 0. Throws std::runtime_error
    /// with `what` before it where an index points nowhere or a number is none.
    void add_part(const std::string& what, Corners corners, std::vector<std::uint32_t> indices,
                  SkinPart material);
    /// Of the part that was added last. Returns its place.
    std::size_t add_morph(const std::string& what, std::string name, double weight,
                          std::vector<glm::vec3> positions, std::vector<glm::vec3> normals);
    /// A file's bytes, PNG or JPEG; -1 where it is neither, or broken. Sides over
    /// 2048 are halved.
    std::int32_t add_picture(const unsigned char* bytes, std::size_t size);

    std::size_t corners() const { return mesh_.positions.size(); }
    /// Null mesh where nothing was added.
    Skin finish();

  private:
    SkinnedMesh mesh_{};
    Skin skin_{};
    std::size_t last_first_ = 0, last_count_ = 0;
};

/// Linear light to what a screen shows.
glm::vec3 shown_colour(const glm::vec3& linear);

}  // namespace tendril::app
