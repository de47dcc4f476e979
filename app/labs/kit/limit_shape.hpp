// A joint's limit as it lies in the world: where its bone may point, and how it may be twisted. The numbers
// are those that solvers use (tendril/ik/limit.hpp); limit_pen.hpp draws them.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/ik/limit.hpp>
#include <vector>

#include "app/labs/lab.hpp"

namespace tendril::app {

class LimitShape {
  public:
    /// `rest`, of length 1, is where the bone points at rest, in the frame of the limit's axis; `parent`
    /// turns that frame into the world's. The limit has no fault, and is not free.
    LimitShape(const ik::Limit& limit, glm::vec3 rest, glm::quat parent);

    const ik::Limit& limit() const { return limit_; }
    bool is_hinge() const { return limit_.kind == ik::JointKind::Hinge; }
    /// Where the bone points after a swing of so much up and left, radians; of length 1.
    glm::vec3 direction(float up, float left) const;
    /// Where it points at the bound, `steps` steps after the first: once round a cone, or from a hinge's
    /// minimum to its maximum.
    std::vector<glm::vec3> outline(int steps) const;
    /// At right angles to the bone that is turned so, what shows its twist; of length 1.
    glm::vec3 side(const ik::JointAngles& angles) const;

  private:
    glm::quat swing(float up, float left) const;

    ik::Limit limit_;
    glm::vec3 rest_, up_axis_, left_axis_;
    glm::quat parent_;
};

// Draws the limit of a joint: a cone with spokes where its bone may point, a fan for a hinge, a dial for
// twist.

struct LimitLook {
    glm::vec3 centre{0.0f};  ///< the joint
    float radius = 0.0f;     ///< metres
    glm::vec3 colour{1.0f};
    float strength = 1.0f;  ///< below 1 it stands back
    bool spokes = true;     ///< and ticks of a hinge
};

class LimitPen {
  public:
    LimitPen(const View& view, DrawList& list, const LimitLook& look)
        : view_(view), list_(list), look_(look) {}

    /// The bound of swing.
    void outline(const LimitShape& shape) const;
    /// What lies within it, seen through.
    void fill(const LimitShape& shape) const;
    /// The range of twist about a bone that is turned so, as an arc `size` of the radius wide, `at` of it
    /// along the bone, with a needle where the twist is now. Nothing for a hinge, and where nothing may
    /// twist.
    void dial(const LimitShape& shape, const ik::JointAngles& angles, float at, float size) const;
    /// Where the bone points now, as a dot at the end of it.
    void dot(const LimitShape& shape, const ik::JointAngles& angles) const;
    /// The same with a line from the joint, as the hand of a clock; in front of whatever is there.
    void needle(const LimitShape& shape, const ik::JointAngles& angles) const;
    /// From the joint to where the bone points at rest, thin.
    void rest(const LimitShape& shape) const;
    void line(glm::vec3 a, glm::vec3 b, float width, float alpha) const;

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    glm::vec3 at(glm::vec3 direction) const { return look_.centre + look_.radius * direction; }

    const View& view_;
    DrawList& list_;
    LimitLook look_;
};

// A turn of a joint in the terms that people know: swing, where its bone points, and twist, about the bone.

/// Degrees.
struct JointTurn {
    double swing = 0.0;  ///< 0 to 180
    double twist = 0.0;  ///< -180 to 180
    double angle = 0.0;  ///< of both together: 0 to 180
};

/// `turn`: from rest, a rotation of any length but 0. `along`: where the bone points at rest, in the same
/// frame, of any length but 0. The twist of a bone that points the very other way than at rest is 0.
JointTurn joint_turn(const glm::dquat& turn, const glm::dvec3& along);

}  // namespace tendril::app
