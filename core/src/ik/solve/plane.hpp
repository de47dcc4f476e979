// A solve in a plane (tendril/ik/plane.hpp) is a solve in the plane's coordinates: the root at the origin,
// the base direction along +X, the normal along +Y. Not installed.
//
// In these coordinates a flat chain stays exactly flat: where a half turn may use any axis perpendicular to a
// vector, `perpendicular` takes +Y for every vector without a Y of its own. Only three parts know about the
// plane: the pole, which is a side (pole/pole.hpp), perturbations, and limits, which are hinges about the
// normal, some of them measured from the base (LimitedJoint::from_base).
#pragma once

#include "ik/solve/problem.hpp"
#include "tendril/ik/method.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

class PlaneFrame {
  public:
    /// `rest`: rest direction of the first bone.
    PlaneFrame(const glm::vec3& root, const glm::vec3& normal, const glm::vec3& rest) noexcept;

    /// The same plane through another root.
    PlaneFrame at(const glm::vec3& root) const noexcept;

    /// Projects the point onto the plane.
    glm::vec3 local(const glm::vec3& point) const noexcept;
    glm::vec3 world(const glm::vec3& point) const noexcept;
    glm::vec3 local_vector(const glm::vec3& vector) const noexcept;
    glm::vec3 world_vector(const glm::vec3& vector) const noexcept;
    /// World position of a joint with these coordinates; exactly `was`, the old one, if it has not moved.
    glm::vec3 returned(const glm::vec3& local, const glm::vec3& was, float reach) const noexcept;
    /// Signed distance from the plane, metres.
    double off(const glm::vec3& point) const noexcept;

  private:
    glm::dvec3 in_world(const glm::vec3& vector) const noexcept;

    glm::dvec3 root_, along_, normal_, across_;
};

/// A validated solve in the plane of its options. During its lifetime the workspace describes the chain in
/// the plane's coordinates.
class PlaneProblem {
  public:
    PlaneProblem(Workspace& scratch, std::span<glm::vec3> joints, State& state, const glm::vec3& target,
                 const Options& options) noexcept;
    ~PlaneProblem();
    PlaneProblem(const PlaneProblem&) = delete;
    PlaneProblem& operator=(const PlaneProblem&) = delete;

    Report solve(Method method, Observer* observer) noexcept;

    Problem& problem() noexcept { return problem_; }
    const Options& options() const noexcept { return options_; }

  private:
    Options local_options() noexcept;
    void choose_side() noexcept;
    void return_joints() noexcept;

    Workspace& scratch_;
    std::span<glm::vec3> joints_;
    State& state_;
    glm::vec3 target_;
    const Options& given_;
    PlaneFrame frame_;
    Options options_;
    Problem problem_;
};

}  // namespace tendril::ik::detail
