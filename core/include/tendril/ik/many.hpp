// Inverse kinematics of thousands of chains at once: crowds, grass, tentacles, feathers.
//
// A Batch stores chains with the same number of bones side by side, so that one vector register holds the
// same coordinate of many chains. solve_many iterates them all at once. Each chain has its own lengths, root
// and target, and gets its own report.
//
// Method: as Method::Fabrik, which is FABRIK (A. Aristidou, J. Lasenby, Graphical Models 73(5), 2011) with an
// extra step that fits the root-tip span (core/src/ik/methods/accelerate.cpp). It uses the widest vector unit
// of this machine, chosen by Highway at run time. A pass is bound by the latency of a square root and a
// division, so several registers of chains take the same step side by side. Slow chains are gathered and
// solved together.
//
// Results are bitwise equal to Solver's with Method::Fabrik, whatever the vector unit, the number of threads
// and the other chains. Exceptions are targets out of reach or too close: solved in float where Solver uses
// double, they agree to 1e-4 of the reach. If a target is so close to the limit of reach that floats cannot
// decide, the scalar solver takes the chain: ManyReport::scalar_fallback. In a plane, sides are decided from
// float coordinates: a converged chain may differ in its last bits (tests: 1 % of chains; all within 1e-4 of
// the reach).
//
// With limits, one per bone and shared by all chains, the vector units take damped least-squares steps over
// the joint rotations, with every joint clamped to its limit (K. Levenberg, "A method for the solution of
// certain non-linear problems in least squares", 1944). A chain that does not converge within 30 steps or
// `max_iterations`, or that stops improving, is solved by the scalar solver from its original pose. So are
// chains whose target is out of reach, and all chains with `every_iteration`, a stiff joint, or a flat cone
// (a suture). Poses differ from the scalar solver's: both converge, each within the limits to 0.1 degrees.
//
// Cost: O(bones) per iteration and chain. Compared with calling Solver::solve per chain, to tolerance, with
// 1000 chains and copying all joints in and out (tests/bench/ik_many.cpp), throughput is 8 to 18 times higher
// with AVX-512 and 6 to 15 times with AVX2, best near full reach. Within limits it is 3 to 20 and 2 to 16
// times, best for hinges and worst for long chains of cones far from full reach. In a plane it is 1.4 to 2.1
// times: there, most of a solve is coordinates and sides, which are scalar. It pays off from four chains on,
// but hardly if most targets fall back to the scalar solver.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tendril/fields.hpp"
#include "tendril/ik/limit.hpp"
#include "tendril/ik/plane.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/quat.hpp"
#include "tendril/result.hpp"
#include "tendril/tasks.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

/// The subset of Options that a batch supports: same names, ranges and defaults.
struct ManyOptions {
    /// Metres, 0 to max_magnitude; by default 1e-3 of each chain's own reach.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Runs all max_iterations even after converging; for measuring and for comparing solvers.
    bool every_iteration = false;
    /// As Options::restarts, for the scalar solver within limits.
    std::optional<int> restarts{};
    /// Keeps every chain in a plane of this normal through its own root, as Options::plane. No state is kept:
    /// with Side::Free a chain stays on its joints' side. Not for a batch with limits: a plane has its own.
    /// Rotations are not maintained. The work is divided as follows:
    ///
    ///   iterations                       vector units, as for chains in space
    ///   coordinates and sides, once      scalar, in double: bounds the gain, see above
    ///   with limits of angles            scalar, all of it: ManyReport::scalar_fallback
    std::optional<Plane> plane{};
    /// Runs the work of the threads (at most as many as given to Batch::make, fewer if there is little work);
    /// by default the library's own threads.
    Tasks tasks{};
    /// One of vector_units(), for comparisons; by default the widest.
    std::string_view vector_unit{};
};

/// Result of one chain.
struct ManyReport {
    Status status = Status::Converged;
    bool scalar_fallback = false;  ///< the scalar solver took this chain
    int iterations = 0;
    float residual = 0.0f;  ///< metres from the tip to the target; infinite if InvalidInput
    bool operator==(const ManyReport&) const = default;
};

/// Counts over all chains.
struct ManySummary {
    std::size_t invalid = 0;           ///< chains whose status is InvalidInput
    std::size_t scalar_fallbacks = 0;  ///< chains that the scalar solver took
    std::size_t first_invalid = 0;     ///< the first chain whose status is InvalidInput, if there is one
    Result accepted{};                 ///< why that chain was refused, or all of them
    bool operator==(const ManySummary&) const = default;
};

/// The vector units that solve_many can use on this machine, the widest first: "AVX3" (AVX-512), "AVX2",
/// "SSE4". All give the same bits. There is always at least one.
std::span<const std::string_view> vector_units() noexcept;

/// Chains stored side by side. Only one thread at a time may use a batch.
class Batch {
  public:
    /// Creates `chains`, up to 2^31, of 1 to 1 000 000 bones each. Every chain starts at the origin and lies
    /// straight along +X; each bone is 1 m long. A solve uses at most `threads`, 1 to 256, including the
    /// caller's. Their scratch memory is allocated here and in set_limits, so a solve allocates nothing.
    /// InvalidArgument.
    static Expected<Batch> make(std::size_t chains, std::size_t bones, int threads = 1);
    ~Batch();
    Batch(Batch&&) noexcept;
    Batch& operator=(Batch&&) noexcept;

    std::size_t size() const noexcept;
    std::size_t bones() const noexcept;

    // ---- Units are metres. OutOfRange for a bad chain or joint; InvalidArgument for a number that chain.hpp
    // ---- refuses or a list of the wrong size. A call that fails changes nothing.

    /// bones() lengths, for one chain or for all. Joints do not move until the next solve enforces the
    /// lengths.
    Result set_lengths(std::size_t chain, std::span<const float> lengths);
    Result set_lengths(std::span<const float> lengths);
    /// bones() + 1 joints, root first. They need not match the lengths: a solve enforces them first.
    Result set_joints(std::size_t chain, std::span<const glm::vec3> joints);
    /// The joints of all chains, chain after chain. The fast path: about 0.3 ns per coordinate.
    Result set_joints(std::span<const glm::vec3> joints);
    /// Moves the root only; the other joints follow in the next solve.
    Result set_root(std::size_t chain, glm::vec3 root);

    /// One limit per bone, at the joint where the bone starts, shared by all chains. An empty list removes
    /// the limits. `rest_directions`: where each bone points at rest, unit vectors; by default all along +X.
    /// Resets all rotations to rest. InvalidArgument.
    Result set_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions = {});
    /// With limits only: each bone's world rotation relative to its rest direction, bones() per chain, chain
    /// after chain; as State::rotations. NotFound if the batch has no limits, InvalidArgument for a
    /// quaternion that is not a unit quaternion or a list of the wrong size.
    Result set_rotations(std::span<const glm::quat> rotations);
    Result copy_rotations(std::span<glm::quat> out) const;

    /// Writes the bones() + 1 joints of one chain, or the joints of all chains, chain after chain. Setting
    /// copied joints again gives bitwise the same solves, so the joints, and with limits the rotations, are
    /// all that a rollback has to save.
    Result copy_joints(std::size_t chain, std::span<glm::vec3> out) const;
    Result copy_joints(std::span<glm::vec3> out) const;

    // ---- No range checks: indices must be valid.

    float length(std::size_t chain, std::size_t bone) const noexcept;
    glm::vec3 joint(std::size_t chain, std::size_t index) const noexcept;
    /// Sum of the bone lengths, metres.
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

/// Moves all joints but the roots so that every tip reaches its target: one target per chain, metres. Report
/// i belongs to chain i; pass one report per chain or none. Allocates nothing.
///
/// A chain gets Status::InvalidInput, and keeps its pose, if its target is not finite or over max_magnitude,
/// or if an earlier solve left its joints out of that range. Other chains are not affected. Options out of
/// range or lists of the wrong size give InvalidInput to all of them.
ManySummary solve_many(Batch& batch, std::span<const glm::vec3> targets, std::span<ManyReport> reports = {},
                       const ManyOptions& options = {}) noexcept;

/// The same for joints that the caller owns: all chains, one after the other, root first. The solve starts
/// from them and writes them back. The batch's own joints do not change; lengths, limits and rotations are
/// the batch's. Bitwise equal to set_joints, solve_many and copy_joints, but faster, because the joints only
/// pass through the nearest cache. A chain with a joint that set_joints would refuse gets
/// Status::InvalidInput and keeps its pose.
ManySummary solve_many(Batch& batch, std::span<glm::vec3> joints, std::span<const glm::vec3> targets,
                       std::span<ManyReport> reports, const ManyOptions& options = {}) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ManyOptions>() noexcept;
