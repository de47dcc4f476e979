// Distributes the twist of arms evenly along their bones; with plain linear blending they collapse at wrist
// and shoulder (tendril/humanoid/twist.hpp has the method and its sources).
//
//     const TwistSpread spread(character.skin, character.skeleton, map);  // once
//     draw.mesh = character.skin.mesh;
//     draw.weights = spread.weights();
//     draw.matrices = spread.matrices(character.skin, placements);
//
// A vertex keeps its joints and weights, but instead of a joint on an arm's bone it follows a copy of the
// joint, rotated about the bone by the twist at the vertex's position along it. Positions are rounded to a
// hundredth of the bone, and only those in use get a copy. So no vertex is blended between distant positions,
// and without twist every vertex stays the same, bit for bit.
#pragma once

#include <memory>
#include <span>
#include <tendril/humanoid/twist.hpp>
#include <vector>

#include "app/io/character/skin.hpp"

namespace tendril::app {

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
