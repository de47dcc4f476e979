// Storage of a Batch: blocks of 80 chains, each a table of floats with a row per coordinate of each joint and
// a column ("lane") per chain, so that one register holds the same coordinate of many chains. Data that only
// a solve needs (residuals, counts, the best pose) is in a second table that a thread reuses for one block
// after the other, so it stays in the nearest cache. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <new>
#include <span>
#include <utility>

namespace tendril::ik::detail {

/// Five registers of AVX-512, ten of AVX2: enough side by side that none waits for its own square root.
inline constexpr std::size_t block_lanes = 80;
static_assert(block_lanes % 16 == 0, "whole registers fill a block");

/// State of a chain during a solve, besides joints and lengths: one row each.
enum class Row : std::size_t {
    TargetX,
    TargetY,
    TargetZ,
    Tolerance,
    Residual,
    Best,     ///< minimum residual of the whole solve
    Saved,    ///< 1 if the rows of the best pose are valid; 0 if the chain's joints are the best
    Nearest,  ///< minimum residual since the last perturbation
    Last,     ///< the previous residual
    Idle,     ///< successive iterations without gain, and slow ones; see convergence.hpp
    Slow,
    Perturbations,  ///< number of perturbations so far
    Iterations,     ///< integers up to 1 000 000, which a float holds
    Activity,
    Class,
    Side  ///< the ik::Side of a chain in a plane
};
inline constexpr std::size_t state_rows = 16;

/// Values of Row::Activity.
enum class Activity : std::uint8_t {
    Done,     ///< finished
    Active,   ///< iterates
    Perturb,  ///< to be perturbed, then iterates
};

/// Values of Row::Class: the result of classifying a chain before its first iteration.
enum class Class : std::uint8_t {
    Reachable,  ///< iterates
    Straight,   ///< out of reach, already straightened
    Folded,     ///< too close, already folded back along its longest bone
    Collinear,  ///< reachable, but maybe collinear with its target: the scalar code decides and perturbs
    Scalar,     ///< too close to a threshold for floats: the scalar solver takes it
    Invalid     ///< a coordinate is out of range
};

/// A view of one block; does not own the rows.
class Block {
  public:
    Block(float* joints, float* lengths, float* state, std::size_t bones) noexcept
        : joints_(joints), lengths_(lengths), state_(state), bones_(bones) {}
    /// For rows of joints and lengths that are contiguous.
    Block(float* rows, float* state, std::size_t bones) noexcept
        : Block(rows, rows + joint_rows(bones) * block_lanes, state, bones) {}

    static std::size_t joint_rows(std::size_t bones) noexcept { return 3 * (bones + 1); }
    /// Rows of lengths, reach and longest bone.
    static std::size_t length_rows(std::size_t bones) noexcept { return bones + 2; }
    static std::size_t joint_floats(std::size_t bones) noexcept { return joint_rows(bones) * block_lanes; }
    static std::size_t chain_floats(std::size_t bones) noexcept {
        return (joint_rows(bones) + length_rows(bones)) * block_lanes;
    }
    static std::size_t state_floats(std::size_t bones) noexcept {
        return (state_rows + 3 * bones) * block_lanes;
    }

    std::size_t bones() const noexcept { return bones_; }
    /// Three rows: x, y and z.
    float* joint(std::size_t index) const noexcept { return joints_ + 3 * index * block_lanes; }
    float* length(std::size_t bone) const noexcept { return lengths_ + bone * block_lanes; }
    float* reach() const noexcept { return length(bones_); }
    float* longest() const noexcept { return reach() + block_lanes; }

    float* row(Row which) const noexcept { return state_ + static_cast<std::size_t>(which) * block_lanes; }
    float& at(Row which, std::size_t lane) const noexcept { return row(which)[lane]; }
    float* target() const noexcept { return row(Row::TargetX); }
    /// Three rows of the best pose so far, from joint 1 on.
    float* best(std::size_t index) const noexcept {
        return state_ + (state_rows + 3 * (index - 1)) * block_lanes;
    }

    glm::vec3 point(std::size_t joint_index, std::size_t lane) const noexcept {
        const float* const p = joint(joint_index) + lane;
        return {p[0], p[block_lanes], p[2 * block_lanes]};
    }
    void set_point(std::size_t joint_index, std::size_t lane, const glm::vec3& to) const noexcept {
        float* const p = joint(joint_index) + lane;
        p[0] = to.x, p[block_lanes] = to.y, p[2 * block_lanes] = to.z;
    }
    glm::vec3 target_of(std::size_t lane) const noexcept {
        return {at(Row::TargetX, lane), at(Row::TargetY, lane), at(Row::TargetZ, lane)};
    }
    Class class_of(std::size_t lane) const noexcept {
        return static_cast<Class>(static_cast<int>(at(Row::Class, lane)));
    }
    Activity activity(std::size_t lane) const noexcept {
        return static_cast<Activity>(static_cast<int>(at(Row::Activity, lane)));
    }
    void set_activity(std::size_t lane, Activity to) const noexcept {
        at(Row::Activity, lane) = static_cast<float>(to);
    }

    /// Call before the joints get worse.
    void save_best(std::size_t lane) const noexcept;

  private:
    float* joints_;
    float* lengths_;
    float* state_;
    std::size_t bones_;
};

/// Gathers lanes of rows side by side; works in place if `to` is `from` and the lanes ascend.
inline void gather_lanes(const float* from, std::span<const std::uint8_t> lanes, float* to,
                         std::size_t rows) noexcept {
    for (std::size_t row = 0; row < rows; ++row, from += block_lanes, to += block_lanes) {
        for (std::size_t k = 0; k < lanes.size(); ++k) to[k] = from[lanes[k]];
    }
}
/// The inverse of gather_lanes.
inline void scatter_lanes(const float* from, std::span<const std::uint8_t> lanes, float* to,
                          std::size_t rows) noexcept {
    for (std::size_t row = 0; row < rows; ++row, from += block_lanes, to += block_lanes) {
        for (std::size_t k = 0; k < lanes.size(); ++k) to[lanes[k]] = from[k];
    }
}
inline void copy_lane(const float* from, float* to, std::size_t rows) noexcept {
    for (std::size_t row = 0; row < rows; ++row) to[row * block_lanes] = from[row * block_lanes];
}

inline void Block::save_best(std::size_t lane) const noexcept {
    if (std::exchange(at(Row::Saved, lane), 1.0f) == 0.0f)
        copy_lane(joint(1) + lane, best(1) + lane, 3 * bones_);
}

/// The lanes of a block, usually ascending.
struct LaneList {
    std::array<std::uint8_t, block_lanes> lanes;
    std::size_t count = 0;

    void add(std::size_t lane) noexcept { lanes[count++] = static_cast<std::uint8_t>(lane); }
    std::span<const std::uint8_t> span() const noexcept { return {lanes.data(), count}; }
};

/// Memory for rows, aligned for the widest register.
class Rows {
  public:
    Rows() = default;
    explicit Rows(std::size_t floats)
        : floats_(static_cast<float*>(::operator new(floats * sizeof(float), alignment))) {}
    float* get() const noexcept { return floats_.get(); }

  private:
    static constexpr std::align_val_t alignment{128};
    struct Free {
        void operator()(float* memory) const noexcept { ::operator delete(memory, alignment); }
    };
    std::unique_ptr<float, Free> floats_;
};

}  // namespace tendril::ik::detail
