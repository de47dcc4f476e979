// The state of one solve, shared by all methods. Not installed.
//
// A method is a function `void iteration(Problem&, Watch)`, compiled twice: with Unwatched, whose observer
// calls vanish, and with Watched. The loop around it (loop.cpp) checks reachability, perturbs, counts, and
// reports.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "ik/limits/workspace.hpp"
#include "ik/pole/workspace.hpp"
#include "math/point.hpp"
#include "tendril/ik/observer.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/ik/state.hpp"

namespace tendril::ik {
struct Options;
}

namespace tendril::ik::detail {

/// Memory of a solve in a plane: the chain in its coordinates (plane.cpp).
struct PlaneScratch {
    std::vector<glm::vec3> joints;           ///< n + 1
    std::vector<glm::vec3> rest_directions;  ///< n: all along +X; or, during the solve, the chain's
    std::vector<Limit> limits;               ///< n: hinges about the normal
    State state;

    void resize(std::size_t bones) {
        joints.resize(bones + 1);
        rest_directions.resize(bones, glm::vec3(1.0f, 0.0f, 0.0f));
        limits.resize(bones);
        state = State(bones);
    }
};

/// Memory of a solver, allocated once, so that solves do not allocate.
struct Workspace {
    std::vector<float> lengths;              ///< n
    std::vector<glm::vec3> rest_directions;  ///< n, unit vectors
    std::vector<glm::vec3> best;             ///< n + 1: the best pose so far
    std::vector<glm::vec3> old;              ///< n + 1: scratch of the methods
    std::vector<glm::quat> rotations;        ///< n: scratch of the methods
    std::vector<glm::vec3> joints;           ///< n + 1: the joints of a Chain while it is solved
    LimitedScratch limited;                  ///< for solves with limits
    PoleScratch pole;                        ///< for solves with a pole
    LimitedPose given;                       ///< for solves with a weight under 1: the pose to blend from
    PlaneScratch plane;                      ///< for solves in a plane
    State saved;                             ///< restored after a refused solve; state of explain and of a
                                             ///< batch's chain
    float reach = 0.0f;
    float longest = 0.0f;

    /// Sizes everything for this many bones, at rest along +X with identity rotations.
    void resize(std::size_t bones) {
        lengths.resize(bones);
        rest_directions.resize(bones, glm::vec3(1.0f, 0.0f, 0.0f));
        best.resize(bones + 1);
        old.resize(bones + 1);
        rotations.resize(bones);
        joints.resize(bones + 1);
        limited.resize(bones);
        pole.resize(bones);
        given.resize(bones);
        saved = State(bones);
        plane.resize(bones);
    }
};

struct Problem {
    std::span<glm::vec3> joints;  ///< n + 1; the first stays
    glm::vec3 target;
    float tolerance;
    const Options& options;
    Workspace& scratch;
    State& state;
    glm::vec3 goal = target;  ///< the requested target; with a soft zone `target` is nearer
    int iteration = 0;        ///< current, from 1

    float stretch = 1.0f;  ///< scale of the bones, set by Method::TwoBone

    // For the report.
    bool closed_form = false;
    int perturbations = 0;
    int least_squares_steps = 0;
    int restarts = 0;

    std::size_t bones() const noexcept { return joints.size() - 1; }
    std::span<const float> lengths() const noexcept {
        return std::span<const float>(scratch.lengths).first(bones());
    }
    glm::vec3 root() const noexcept { return joints.front(); }
    float residual() const noexcept { return math::distance(joints.back(), target); }
    Report report(Status status, float left) const noexcept {
        return {status, iteration, left, closed_form, perturbations, least_squares_steps, restarts};
    }
};

struct Unwatched {
    static constexpr bool watching = false;
    void moved(int, Phase, std::size_t, std::size_t, const glm::vec3&, const glm::vec3&) noexcept {}
    void next_step() noexcept {}
    void iteration_done(int, float) noexcept {}
};

class Watched {
  public:
    static constexpr bool watching = true;
    Watched(Observer& observer, int& order) noexcept : observer_(&observer), order_(&order) {}
    /// Reports one joint's move in the current step; see next_step.
    void moved(int iteration, Phase phase, std::size_t joint, std::size_t neighbour, const glm::vec3& from,
               const glm::vec3& to) noexcept {
        observer_->step({iteration, phase, *order_, joint, neighbour, from, to});
    }
    /// Ends the current step: all moves reported since the last call belong to it.
    void next_step() noexcept { ++*order_; }
    void iteration_done(int iteration, float residual) noexcept {
        observer_->iteration_done(iteration, residual);
    }

  private:
    Observer* observer_;
    int* order_;
};

}  // namespace tendril::ik::detail
