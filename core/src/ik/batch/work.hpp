// One solve of a Batch, shared by its threads. Not installed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

#include "ik/batch/block.hpp"
#include "ik/batch/vector.hpp"
#include "ik/solve/plane.hpp"
#include "ik/solve/problem.hpp"
#include "math/checks.hpp"
#include "tendril/ik/many.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

/// Report of a refused chain. Its infinite residual never compares as success.
inline constexpr ManyReport refused_chain{.status = Status::InvalidInput,
                                          .residual = std::numeric_limits<float>::infinity()};

/// A block for slow chains gathered from other blocks: the first `used` lanes.
struct Tile {
    explicit Tile(std::size_t bones)
        : rows(Block::chain_floats(bones)),
          state(Block::state_floats(bones)),
          block(rows.get(), state.get(), bones) {}

    Rows rows, state;
    Block block;
    std::array<std::uint32_t, block_lanes> chains{};  ///< index of the chain in each lane
    std::size_t used = 0;
};

/// Scratch memory of one thread; allocated once.
struct Scratch {
    explicit Scratch(std::size_t bones);

    Rows joints;  ///< the current block's, if the caller owns the joints, or in the plane's coordinates
    Rows state;   ///< the current block's
    Rows shapes;  ///< shapes, gathered and second: see StepScratch
    Tile gathered, second;
    Tile tile;
    Rows poses, rotations, limited;  ///< see LimitedJob; allocated with limits
    Workspace scalar;                ///< for the scalar code
    Options options;                 ///< options of the chain in `scalar`
};

/// Access to a chain's joints, in the caller's memory or the batch's.
class JointAccess {
  public:
    JointAccess(float* first, std::size_t joint_stride, std::size_t coordinate_stride) noexcept
        : first_(first), joint_(joint_stride), coordinate_(coordinate_stride) {}
    glm::vec3 joint(std::size_t i) const noexcept {
        const float* const p = first_ + i * joint_;
        return {p[0], p[coordinate_], p[2 * coordinate_]};
    }
    void set_joint(std::size_t i, const glm::vec3& to) const noexcept {
        float* const p = first_ + i * joint_;
        p[0] = to.x, p[coordinate_] = to.y, p[2 * coordinate_] = to.z;
    }

  private:
    float* first_;
    std::size_t joint_, coordinate_;
};

class Work {
  public:
    struct Input {
        float* blocks;
        std::size_t chains, bones;
        std::span<const glm::vec3> targets;
        glm::vec3* joints;  ///< the caller's, chain after chain; null to use those in the blocks
        std::span<ManyReport> reports;
        const Options& options;
        const VectorUnit& unit;
        const BatchLimits* limits;  ///< null if none
        float* rotations;           ///< with limits: rows of one block after the other
    };
    /// The input must be validated.
    explicit Work(const Input& input) noexcept
        : in_(input),
          planar_(input.options.plane && input.options.plane->limits.empty()),
          frame_(glm::vec3(0.0f), planar_ ? input.options.plane->normal : glm::vec3(0.0f, 0.0f, 1.0f),
                 glm::vec3(1.0f, 0.0f, 0.0f)) {}

    /// Processes blocks until none are left. Threads may call it concurrently, each with its own scratch.
    void run(Scratch& scratch) noexcept;
    ManySummary summary() const noexcept {
        return {invalid_.load(), scalar_fallbacks_.load(), invalid_ > 0 ? first_invalid_.load() : 0};
    }

  private:
    Block block(std::size_t index, Scratch& scratch) const noexcept {
        float* const own = in_.blocks + index * Block::chain_floats(in_.bones);
        return {in_.joints != nullptr || planar_ ? scratch.joints.get() : own,
                own + Block::joint_floats(in_.bones), scratch.state.get(), in_.bones};
    }
    void take_joints(const Block& block, std::size_t index, std::size_t lanes) const noexcept;
    void return_joints(const Block& block, std::size_t index, std::size_t lanes) const noexcept;
    void solve_block(std::size_t index, Scratch& scratch) noexcept;
    void solve_limited_block(const Block& block, std::size_t index, std::size_t lanes,
                             Scratch& scratch) noexcept;
    void iterate_block(const Block& block, std::size_t lanes, Scratch& scratch) const noexcept;
    Remaining iterate(const Block& block, std::size_t lanes, int iterations, Scratch& scratch) const noexcept;
    void perturb(const Block& block, std::size_t lane, Scratch& scratch) const noexcept;
    void bend_collinear(const Block& block, std::size_t lane, Scratch& scratch) const noexcept;
    void solve_scalar(const Block& block, std::size_t lane, std::size_t chain, Scratch& scratch) noexcept;
    void solve_scalar_limited(const Block& block, std::size_t lane, std::size_t chain,
                              Scratch& scratch) noexcept;
    // Chains in a plane (planar.cpp).
    void solve_angled_block(std::size_t index, std::size_t lanes, Scratch& scratch) noexcept;
    void project_to_plane(const Block& block, std::size_t first, std::size_t lanes,
                          Scratch& scratch) const noexcept;
    void rotate_to_targets(const Block& block, std::size_t first, std::size_t lanes,
                           Scratch& scratch) const noexcept;
    void return_from_plane(const Block& block, std::size_t lane, std::size_t chain,
                           Scratch& scratch) const noexcept;
    void solve_in_plane(std::size_t chain, Scratch& scratch) noexcept;
    JointAccess home(std::size_t chain) const noexcept;
    void report_invalid(std::size_t chain) noexcept;
    void report_fallback(std::size_t chain, const Report& answer) noexcept;
    float* rotations(std::size_t index) const noexcept {
        return in_.rotations + index * 4 * in_.bones * block_lanes;
    }
    Problem load_problem(const Block& block, std::size_t lane, Scratch& scratch) const noexcept;

    void put_into_tile(const Block& from, const LaneList& lanes, std::size_t first,
                       Scratch& scratch) noexcept;
    void write_back_joints(std::size_t lane, Scratch& scratch) const noexcept;
    void fetch_joints(const Tile& tile, std::size_t lane) const noexcept;
    void run_tile(std::size_t most_left, Scratch& scratch) noexcept;
    void retire_done(Scratch& scratch) noexcept;
    LimitedJob limited_job(Scratch& scratch) const noexcept;
    void run_limited_tile(std::size_t most_left, Scratch& scratch) noexcept;
    void move_limited(std::size_t from, std::size_t to, Scratch& scratch) const noexcept;
    void end_limited(std::size_t lane, Scratch& scratch) noexcept;
    void report(const Block& block, std::size_t lane, std::size_t chain) noexcept;

    Input in_;
    bool planar_;       ///< in a plane without limits
    PlaneFrame frame_;  ///< frame of that plane, at the origin
    std::atomic<std::size_t> next_block_{0}, invalid_{0}, first_invalid_{tendril::detail::no_index},
        scalar_fallbacks_{0};
};

}  // namespace tendril::ik::detail
