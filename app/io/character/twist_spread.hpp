// A skin whose arms are twisted evenly along their bones, where linear blending lets them shrink to a thread
// at wrist and shoulder (tendril/humanoid/twist.hpp has the method and its sources).
//
//     const TwistSpread spread(character.skin, character.skeleton, map);  // once
//     draw.mesh = character.skin.mesh;
//     draw.weights = spread.weights();
//     draw.matrices = spread.matrices(character.skin, placements);
//
// A corner follows the same joints by the same weights. Only, where one is a bone of an arm, it follows a
// copy of that joint which is turned about the bone by the twist of the corner's own place along it: a
// hundred places to a bone, of which a skin has those that its corners stand at. So no corner is blended
// between places that are far from each other, and one that is not twisted is where it was, to the bit.
#pragma once

#include <memory>
#include <span>
#include <tendril/humanoid/twist.hpp>
#include <vector>

#include "app/io/character/skin.hpp"

namespace tendril::app {

class TwistSpread {
  public:
    /// Spreads nothing.
    TwistSpread() = default;
    /// Bones with twist nodes that corners hang on are left to those. What counts as untwisted is how the
    /// skin was bound, or the rest pose where it has no joints that say.
    TwistSpread(const Skin& skin, const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map);

    /// For SkinDraw::weights; null where no bone is spread.
    const std::shared_ptr<const std::vector<JointWeights>>& weights() const { return weights_; }
    /// For SkinDraw::matrices: those of skin_matrices(), and behind them those of the copies.
    std::vector<AffineRows> matrices(const Skin& skin, std::span<const humanoid::Placement> placements) const;

  private:
    struct Arm {
        humanoid::TwistBone bone{};
        glm::dquat bound{1.0, 0.0, 0.0, 0.0};      ///< the bone against the one before
        glm::dquat end_bound{1.0, 0.0, 0.0, 0.0};  ///< the one after against the bone
    };
    struct Copy {
        std::size_t arm, joint;  ///< of the skin
        double part;             ///< along the bone
    };
    void spread(const Skin& skin, const humanoid::Skeleton& skeleton,
                std::span<const humanoid::Placement> rest);

    std::vector<Arm> arms_{};
    std::vector<Copy> copies_{};
    std::shared_ptr<const std::vector<JointWeights>> weights_{};
};

}  // namespace tendril::app
