// A joint's limit as it lies in the world: where its bone may point, and how it may be twisted. The numbers
// are those that solvers use (tendril/ik/limit.hpp); limit_pen.hpp draws them.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <tendril/ik/limit.hpp>
#include <vector>

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

}  // namespace tendril::app
