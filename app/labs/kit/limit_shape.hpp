// A joint's limit in world space: where its bone may point and how it may twist, and its drawing. The
// geometry is the solvers' (tendril/ik/limit.hpp).
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/ik/limit.hpp>
#include <vector>

#include "app/labs/lab.hpp"

namespace tendril::app {

class LimitShape {
  public:
    /// `rest`, of length 1, is the bone's rest direction in the frame of the limit's axis; `parent` rotates
    /// that frame to world space. The limit must be valid and not free.
    LimitShape(const ik::Limit& limit, glm::vec3 rest, glm::quat parent);

    const ik::Limit& limit() const { return limit_; }
    bool is_hinge() const { return limit_.kind == ik::JointKind::Hinge; }
    /// The bone's direction after a swing of `up` and `left` radians; of length 1.
    glm::vec3 direction(float up, float left) const;
    /// `steps` + 1 directions on the boundary: once round a cone, or from a hinge's minimum to its maximum.
    std::vector<glm::vec3> outline(int steps) const;
    /// A direction perpendicular to the bone at these angles that shows its twist; of length 1.
    glm::vec3 side(const ik::JointAngles& angles) const;

  private:
    glm::quat swing(float up, float left) const;

    ik::Limit limit_;
    glm::vec3 rest_, up_axis_, left_axis_;
    glm::quat parent_;
};

// Draws a joint's limit: a cone with spokes, a fan for a hinge, a dial for twist.

struct LimitLook {
    glm::vec3 centre{0.0f};  ///< the joint
    float radius = 0.0f;     ///< metres
    glm::vec3 colour{1.0f};
    float strength = 1.0f;  ///< below 1: paler
    bool spokes = true;     ///< a cone's spokes; a hinge's ticks
};

class LimitPen {
  public:
    LimitPen(const View& view, DrawList& list, const LimitLook& look)
        : view_(view), list_(list), look_(look) {}

    /// The boundary of swing.
    void outline(const LimitShape& shape) const;
    /// The area within the boundary, translucent.
    void fill(const LimitShape& shape) const;
    /// The range of twist about the bone at these angles, as an arc of `size` times the radius, centred `at`
    /// times the radius along the bone, with a needle at the present twist. Draws nothing for a hinge, or if
    /// the limit allows no twist.
    void dial(const LimitShape& shape, const ik::JointAngles& angles, float at, float size) const;
    /// A dot in the direction of the bone.
    void dot(const LimitShape& shape, const ik::JointAngles& angles) const;
    /// The dot with a line from the joint, like a clock hand; drawn in front of everything.
    void needle(const LimitShape& shape, const ik::JointAngles& angles) const;
    /// A thin line from the joint in the rest direction.
    void rest(const LimitShape& shape) const;
    void line(glm::vec3 a, glm::vec3 b, float width, float alpha) const;

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    glm::vec3 at(glm::vec3 direction) const { return look_.centre + look_.radius * direction; }

    const View& view_;
    DrawList& list_;
    LimitLook look_;
};

// A joint's rotation in familiar terms: swing (where the bone points) and twist (about the bone).

/// Degrees.
struct JointTurn {
    double swing = 0.0;  ///< 0 to 180
    double twist = 0.0;  ///< -180 to 180
    double angle = 0.0;  ///< of the whole rotation, 0 to 180
};

/// `turn`: the rotation from rest, of any length but 0. `along`: the bone's rest direction in the same frame,
/// of any length but 0. The twist is 0 if the bone points opposite to its rest direction.
JointTurn joint_turn(const glm::dquat& turn, const glm::dvec3& along);

}  // namespace tendril::app
