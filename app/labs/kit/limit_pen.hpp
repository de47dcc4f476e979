// Draws the limit of a joint: a cone with spokes where its bone may point, a fan for a hinge, a dial for
// twist.
#pragma once

#include "app/labs/kit/limit_shape.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

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

}  // namespace tendril::app
