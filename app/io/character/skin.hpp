// A character's skin: its meshes merged into one, bound to the skeleton's nodes, with morph animations, and
// with arms whose twist is spread along them.
//
//     draw.mesh = character.skin.mesh;
//     draw.matrices = skin_matrices(character.skin, placements);
//     draw.morph_weights = morph_weights(character.skin, clip, seconds);
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <tendril/humanoid/capsules.hpp>
#include <tendril/humanoid/clip.hpp>
#include <tendril/humanoid/twist.hpp>
#include <vector>

#include "app/io/character/skinned_mesh.hpp"

namespace tendril::app {

/// A joint of the skin. `from_bind`, then the node's placement, maps a vertex from the bind pose to its
/// position in metres.
struct SkinJoint {
    std::size_t node = 0;
    humanoid::Placement from_bind{};
};

/// Weights of morphs over a clip's time.
struct MorphTrack {
    std::size_t first = 0, count = 0;  ///< a range of the mesh's morphs
    humanoid::Interpolation interpolation = humanoid::Interpolation::Linear;
    std::vector<double> times{};   ///< seconds, as in a clip
    std::vector<double> values{};  ///< `count` per key; cubic: three times that, as in a clip
};

struct Skin {
    std::shared_ptr<const SkinnedMesh> mesh{};           ///< null: the file has none
    std::vector<SkinJoint> joints{};                     ///< joints of the mesh, in its order
    std::vector<std::vector<MorphTrack>> morph_clips{};  ///< one list per clip, in order, or empty
};

/// For SkinDraw::matrices. `placements`: of all nodes, from humanoid::place().
std::vector<AffineRows> skin_matrices(const Skin& skin, std::span<const humanoid::Placement> placements);
/// Every vertex at its skinned position, with the node of its strongest joint, for
/// humanoid::fitted_capsules(). `rest`: the placements at rest.
std::vector<humanoid::SkinPoint> skin_points(const Skin& skin, std::span<const humanoid::Placement> rest);
/// For SkinDraw::morph_weights; a clip without tracks keeps the morphs' own weights.
std::vector<float> morph_weights(const Skin& skin, std::size_t clip, double time);

/// Scales the skinned result; the vertices in the bind pose stay as they are.
void scale_skin(Skin& skin, double times);

/// Merges meshes while a file is read: add a part, then its morphs.
class SkinBuilder {
  public:
    static constexpr std::size_t max_corners = 4'000'000, max_indices = 30'000'000, max_joints = 16'000;
    static constexpr std::size_t usual_pixels = std::size_t{1} << 27;  ///< 512 MB

    /// The limit is for all pictures together.
    explicit SkinBuilder(std::size_t max_picture_pixels = usual_pixels) : max_pixels_(max_picture_pixels) {}

    /// Returns the index of the new joint.
    std::size_t add_joint(std::size_t node, const humanoid::Placement& from_bind);
    /// Vertices of a part; lists other than the positions have the same size or are empty. `influences` are
    /// any number of joints and weights for each vertex: the four strongest are kept and normalised.
    struct Corners {
        std::vector<glm::vec3> positions, normals;
        std::vector<glm::vec2> uvs;
        std::vector<glm::u8vec4> tints;
        std::vector<std::vector<std::pair<std::size_t, double>>> influences;
        std::size_t only_joint = 0;  ///< for vertices without influences
    };
    /// Adds triangles with one material; `indices` count the part's vertices from 0. Throws
    /// std::runtime_error that begins with `what` for an index out of range, a position that is not finite,
    /// or too many vertices; a texture coordinate that is not finite becomes 0.
    void add_part(const std::string& what, Corners corners, std::vector<std::uint32_t> indices,
                  SkinPart material);
    /// Adds a morph of the last part. Returns its index.
    std::size_t add_morph(const std::string& what, std::string name, double weight,
                          std::vector<glm::vec3> positions, std::vector<glm::vec3> normals);
    /// Adds a picture from the bytes of a PNG or JPEG file and returns its index, or the index of an earlier
    /// picture with the same bytes; -1 if it is neither, is broken or exceeds the limit. It is halved until
    /// no side is over 2048 and it takes at most an eighth of the space left for pictures.
    std::int32_t add_picture(std::string_view bytes);
    /// True if the picture limit was reached: no more are decoded, even if they would shrink enough.
    bool pictures_are_full() const { return full_; }

    std::size_t corners() const { return mesh_.positions.size(); }
    /// The mesh is null if nothing was added.
    Skin finish();

  private:
    SkinnedMesh mesh_{};
    Skin skin_{};
    std::size_t last_first_ = 0, last_count_ = 0;
    std::map<std::string, std::int32_t, std::less<>> known_{};  // pictures by their bytes
    std::size_t max_pixels_, kept_ = 0, decoded_ = 0;           // pixels
    bool full_ = false;
};

/// Converts linear light to sRGB.
glm::vec3 shown_colour(const glm::vec3& linear);

/// Distributes the twist of arms evenly along their bones; plain linear blending makes wrists and shoulders
/// collapse (tendril/humanoid/twist.hpp has the method and its sources).
///
///     const TwistSpread spread(character.skin, character.skeleton, map);  // once
///     draw.mesh = character.skin.mesh;
///     draw.weights = spread.weights();
///     draw.matrices = spread.matrices(character.skin, placements);
///
/// A vertex keeps its joints and weights, but instead of a joint on an arm's bone it follows a copy of that
/// joint, rotated about the bone by the twist at the vertex's position along it. Positions are rounded to a
/// hundredth of the bone, and only those in use get a copy. So no vertex is blended between distant
/// positions, and without twist every vertex stays the same, bit for bit.
class TwistSpread {
  public:
    /// Makes a spread that does nothing.
    TwistSpread() = default;
    /// Skips bones with twist nodes that vertices follow. Twist is relative to the skin's bind pose, or to
    /// the rest pose if the skin lacks the joints.
    TwistSpread(const Skin& skin, const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map);

    /// For SkinDraw::weights; null if nothing is distributed.
    const std::shared_ptr<const std::vector<JointWeights>>& weights() const { return weights_; }
    /// For SkinDraw::matrices: skin_matrices(), followed by the copies' matrices.
    std::vector<AffineRows> matrices(const Skin& skin, std::span<const humanoid::Placement> placements) const;

  private:
    struct Arm {
        humanoid::TwistBone bone{};
        glm::dquat bound{1.0, 0.0, 0.0, 0.0};      ///< the bone relative to the one above
        glm::dquat end_bound{1.0, 0.0, 0.0, 0.0};  ///< the next bone relative to the bone
    };
    struct Copy {
        std::size_t arm, joint;  ///< indices of an arm and of a joint of the skin
        double part;             ///< position along the bone, 0 to 1
    };
    void spread(const Skin& skin, const humanoid::Skeleton& skeleton,
                std::span<const humanoid::Placement> rest);

    std::vector<Arm> arms_{};
    std::vector<Copy> copies_{};
    std::shared_ptr<const std::vector<JointWeights>> weights_{};
};

}  // namespace tendril::app
