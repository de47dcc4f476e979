// Inverse kinematics of thousands of chains at once: crowds, grass, tentacles, feathers.
//
// A Batch keeps chains of the same number of bones side by side, so that one vector register holds the same
// coordinate of many chains; solve_many iterates them all at once. Each chain has its own lengths, root and
// target, and ends with its own report.
//
// Method: that of Method::Fabrik, which is FABRIK (A. Aristidou, J. Lasenby, Graphical Models 73(5), 2011)
// with a step that fits the span (core/src/ik/methods/accelerate.hpp), with the widest vector unit that this
// machine has (Highway chooses it at run time). A pass is one long wait for a square root and a division; so
// several registers of chains take the same step side by side, and chains that take long are collected and
// solved together.
//
// Answers: bit for bit those of Solver with Method::Fabrik, whatever the vector unit, the number of threads
// and the company that a chain is in; but for targets out of reach or too close, which are answered in float
// where Solver takes double (the same to 1e-4 of the reach). Where a target is so near to the rim of what can
// be reached that floats cannot decide, the scalar solver takes that chain: ManyReport::scalar_fallback.
//
// With limits, one for each bone and the same for all chains, the vector units take damped least-squares
// steps over the joints' rotations, every joint clamped to its limit (K. Levenberg, "A method for the
// solution of certain non-linear problems in least squares", 1944). A chain that does not arrive in this way
// within 30 steps or `max_iterations`, or that stops coming nearer, is solved by the scalar solver from where
// it was; so is one whose target is out of reach, and all of them with `every_iteration` or where a cone is
// flat (a suture). Poses differ from the scalar solver's: both arrive, each within the limits to 0.1 degrees.
//
// Cost: O(bones) an iteration and chain. Over as many calls of Solver::solve to tolerance, 1 000 chains, all
// joints in and out (tests/bench/ik_many.cpp): 8 to 18 times the throughput with AVX-512 and 6 to 15 times
// with AVX2, the most near full reach; within limits 3 to 20 and 2 to 16 times, the most for hinges, the
// least for long chains of cones far from full reach. It pays from four chains on, and hardly where most
// targets fall to the scalar solver.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tendril/ik/limit.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/tasks.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// What Options offers and a batch has; the same names, ranges and defaults.
struct ManyOptions {
    /// Metres, 0 to max_magnitude; 1e-3 of each chain's own reach where left out.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Goes on to max_iterations whatever was reached; for measuring, and for comparing solvers.
    bool every_iteration = false;
    /// Of the scalar solver within limits, as Options::restarts.
    std::optional<int> restarts{};
    /// Who runs the threads' parts (as many as Batch::make was told of, where there is work for them); the
    /// library's own threads where left out.
    Tasks tasks{};
    /// One of vector_units(), for comparing; the widest where left empty.
    std::string_view vector_unit{};
};

/// What came of one chain.
struct ManyReport {
    Status status = Status::Converged;
    bool scalar_fallback = false;  ///< the scalar solver took this chain
    int iterations = 0;
    float residual = 0.0f;  ///< metres from the tip to the target
    bool operator==(const ManyReport&) const = default;
};

/// What came of all of them, counted.
struct ManySummary {
    std::size_t invalid = 0;           ///< chains whose status is InvalidInput
    std::size_t scalar_fallbacks = 0;  ///< chains that the scalar solver took
    bool operator==(const ManySummary&) const = default;
};

/// The vector units that solve_many can use on this machine, the widest first: "AVX3" (AVX-512), "AVX2",
/// "SSE4". All give the same bits. There is always at least one.
std::span<const std::string_view> vector_units() noexcept;

/// Chains side by side. One thread at a time may use it.
class Batch {
  public:
    /// `chains`, up to 2^31, of 1 to 1 000 000 bones each. Every chain starts at the origin and lies straight
    /// along +X; each bone is 1 m long. A solve takes at most `threads`, 1 to 256, the caller's among them;
    /// what each of them needs is allocated here, and nothing later. InvalidArgument.
    static Expected<Batch> make(std::size_t chains, std::size_t bones, int threads = 1);
    ~Batch();
    Batch(Batch&&) noexcept;
    Batch& operator=(Batch&&) noexcept;

    /// Chains.
    std::size_t size() const noexcept;
    /// Of each chain.
    std::size_t bones() const noexcept;

    // ---- Metres. OutOfRange for a bad chain or joint, InvalidArgument for a number that chain.hpp would not
    // ---- take or a list of the wrong size; nothing is changed then.

    /// bones() of them, for one chain or for all. The joints stay where they are until the next solve
    /// brings the bones to their lengths.
    Result set_lengths(std::size_t chain, std::span<const float> lengths);
    Result set_lengths(std::span<const float> lengths);
    /// bones() + 1 of them, root first. They need not be at their lengths: a solve begins by bringing them
    /// there.
    Result set_joints(std::size_t chain, std::span<const glm::vec3> joints);
    /// Of all chains, one after the other: the fast way, some 0.3 ns a coordinate.
    Result set_joints(std::span<const glm::vec3> joints);
    /// The first joint goes there and the others stay; the next solve lets them follow.
    Result set_root(std::size_t chain, glm::vec3 root);

    /// One for each bone, at the joint that it starts from, the same for every chain; none at all takes them
    /// away. `rest_directions`: where each bone points at rest, unit vectors; all along +X where left out.
    /// Every bone is turned as at rest again. InvalidArgument.
    Result set_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions = {});
    /// With limits: how each bone is turned against its rest, in the world, bones() of them a chain, one
    /// chain after the other; as Solver::rotations. NotFound where the batch has no limits, InvalidArgument
    /// for what is no unit quaternion.
    Result set_rotations(std::span<const glm::quat> rotations);
    Result copy_rotations(std::span<glm::quat> out) const;

    /// Writes all bones() + 1 joints of a chain; or those of all chains, one after the other. What was copied
    /// out and is set again gives the same solves to the bit, so this, and the rotations where there are
    /// limits, is all that a rollback has to keep.
    Result copy_joints(std::size_t chain, std::span<glm::vec3> out) const;
    Result copy_joints(std::span<glm::vec3> out) const;

    // ---- The indices must be in range.

    float length(std::size_t chain, std::size_t bone) const noexcept;
    glm::vec3 joint(std::size_t chain, std::size_t index) const noexcept;
    /// Sum of the lengths.
    float reach(std::size_t chain) const noexcept;

  private:
    struct Parts;
    explicit Batch(std::unique_ptr<Parts> parts) noexcept;
    std::unique_ptr<Parts> parts_;
    friend ManySummary solve_many(Batch&, std::span<const glm::vec3>, std::span<ManyReport>,
                                  const ManyOptions&) noexcept;
    friend ManySummary solve_many(Batch&, std::span<glm::vec3>, std::span<const glm::vec3>,
                                  std::span<ManyReport>, const ManyOptions&) noexcept;
};

/// Moves all joints but the roots so that every tip comes to its target: one target a chain, metres. Report i
/// is of chain i; as many as there are chains, or none. Allocates nothing.
///
/// A target that is not finite or over max_magnitude, or joints that an earlier solve left further out, give
/// that chain Status::InvalidInput and leave it as it was; the others do not notice. Options out of range or
/// lists of the wrong size give it to all of them.
ManySummary solve_many(Batch& batch, std::span<const glm::vec3> targets, std::span<ManyReport> reports = {},
                       const ManyOptions& options = {}) noexcept;

/// The same for joints that the caller keeps: those of all chains, root first, one chain after the other. The
/// solve starts from them and writes them; the batch's own stay as they were, and lengths, limits and
/// rotations are the batch's. Same bits as set_joints, solve_many and copy_joints, in less time than these:
/// the joints pass through the nearest cache only. A chain with a joint that set_joints would refuse gets
/// Status::InvalidInput and stays as it was.
ManySummary solve_many(Batch& batch, std::span<glm::vec3> joints, std::span<const glm::vec3> targets,
                       std::span<ManyReport> reports, const ManyOptions& options = {}) noexcept;

}  // namespace tendril::ik
