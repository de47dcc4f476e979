// Inverse kinematics of thousands of chains at once: crowds, grass, tentacles, feathers.
//
// A Batch keeps chains of the same number of bones side by side, so that one vector register holds the same
// coordinate of many chains; solve_many pulls them all at once. Each chain has its own lengths, root and
// target, and ends with its own report.
//
// Method: plain FABRIK (A. Aristidou, J. Lasenby, Graphical Models 73(5), 2011), with the widest vector unit
// that this machine has (Highway chooses it at run time). A pull is one long wait for a square root and a
// division; so several registers of chains take the same step side by side, and chains that are done leave
// room for those that are not.
//
// Answers: the pulls are those of Solver with Method::FabrikPlain, bit for bit, whatever the vector unit, the
// number of threads and the company that a chain is in. Three things differ. A chain that lies on a line with
// its target, which plain FABRIK would not get off, is solved as Method::Fabrik solves it. A target out of
// reach is answered in float, where Solver takes double. And where the last pose is not the nearest (pulls
// never take the tip away by more than rounding), Solver goes back to the nearest. To 1e-4 of the reach the
// last two come to the same.
//
// Cost: O(bones) an iteration and chain. Next to as many calls of Solver::solve, some 30 times less with AVX2
// and 50 times less with AVX-512 where all chains iterate alike, a third to two thirds of that gain where
// some are done long before others; from four chains on it pays (tests/bench/ik_many.cpp).
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "tendril/ik/options.hpp"
#include "tendril/tasks.hpp"

namespace tendril::ik {

struct ManyOptions {
    /// Metres, 0 to max_magnitude; 1e-3 of each chain's own reach where left out.
    std::optional<float> tolerance{};
    /// 1 to 1 000 000.
    int max_iterations = 100;
    /// Goes on to max_iterations whatever was reached; for measuring, and for comparing solvers.
    bool every_iteration = false;
    /// At most so many threads, the caller's among them; 1 to 256. They are started anew and end with the
    /// call, so only as many as have something to do. A program with jobs of its own rather keeps one Batch a
    /// job.
    int threads = 1;
    /// Who runs the threads' parts; the library's own threads where left out.
    Tasks tasks{};
    /// One of vector_units(), for comparing; the widest where left empty.
    std::string_view vector_unit{};
};

/// The vector units that solve_many can use on this machine, the widest first: "AVX3" (AVX-512), "AVX2",
/// "SSE4". All give the same bits. There is always at least one.
std::span<const std::string_view> vector_units() noexcept;

/// Chains side by side. One thread at a time may use it.
class Batch {
  public:
    /// Every chain starts at the origin and lies straight along +X; each bone is 1 m long. Throws
    /// std::invalid_argument for more than 2^31 chains, no bone or more than 1 000 000 of them, and
    /// std::bad_alloc.
    Batch(std::size_t chains, std::size_t bones);
    ~Batch();
    Batch(Batch&&) noexcept;
    Batch& operator=(Batch&&) noexcept;

    /// Chains.
    std::size_t size() const noexcept;
    /// Of each chain.
    std::size_t bones() const noexcept;

    // ---- Throw std::out_of_range for a bad chain, bone or joint, and std::invalid_argument for a number
    // that
    // ---- chain.hpp would not take or a list of the wrong size; nothing is changed then. Metres.

    /// bones() of them. The joints stay where they are until the next solve lays them to their lengths.
    void set_lengths(std::size_t chain, std::span<const float> lengths);
    /// bones() + 1 of them, root first. They need not be at their lengths: a solve begins by laying them.
    void set_joints(std::size_t chain, std::span<const glm::vec3> joints);
    /// The first joint goes there and the others stay; the next solve lets them follow.
    void set_root(std::size_t chain, glm::vec3 root);

    float length(std::size_t chain, std::size_t bone) const;
    glm::vec3 joint(std::size_t chain, std::size_t index) const;
    /// Writes all bones() + 1 of them.
    void joints(std::size_t chain, std::span<glm::vec3> out) const;
    /// Sum of the lengths.
    float reach(std::size_t chain) const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
    friend void solve_many(Batch&, std::span<const glm::vec3>, std::span<Report>,
                           const ManyOptions&) noexcept;
};

/// Moves all joints but the roots so that every tip comes to its target: one target a chain, metres. Report i
/// tells of chain i; as many as there are chains, or none.
///
/// A target that is not finite or over max_magnitude, or joints that an earlier solve left further out, give
/// that chain Status::InvalidInput and leave it as it was; the others do not notice. Options out of range or
/// lists of the wrong size give it to all of them.
///
/// Allocates nothing, except that the first call with more threads makes room for them, and that starting a
/// thread takes memory; where there is none, fewer threads do the work.
void solve_many(Batch& batch, std::span<const glm::vec3> targets, std::span<Report> reports = {},
                const ManyOptions& options = {}) noexcept;

}  // namespace tendril::ik
