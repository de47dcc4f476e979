// How a Batch keeps its chains: in blocks of 128, each a table of floats with a row for every coordinate of
// every joint and a column ("lane") for every chain. The rows of a block lie one after the other, so a block
// stays in the nearest cache while it is solved. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <new>

namespace tendril::ik::detail {

/// Eight registers of AVX-512, sixteen of AVX2: enough side by side that none waits for its own square root.
inline constexpr std::size_t block_lanes = 128;

/// What is known of a chain besides its joints and lengths: one row each, after theirs.
enum class Row : std::size_t {
    Reach,
    Longest,
    TargetX,
    TargetY,
    TargetZ,
    Tolerance,
    Residual,
    Nearest,     ///< the least residual so far
    Idle,        ///< iterations since that was last beaten
    Iterations,  ///< whole numbers up to 1 000 000, which a float holds
    Active,      ///< 1: pulled, 0: left alone
    Start        ///< what the look before the first pull found, see Start below
};
inline constexpr std::size_t info_rows = 12;

/// Iterations without a nearer tip until a solve has stalled; as in loop.cpp.
inline constexpr int stall_patience = 10;

/// In Row::Start.
enum class Start : std::uint8_t {
    Plain,     ///< reachable, bent and at its lengths: can be pulled
    Straight,  ///< out of reach, and already laid straight
    Careful,   ///< some special case, or too near to one to tell in float: the scalar code looks at it
    Invalid    ///< some coordinate is out of range
};

/// One block; the rows belong to somebody else.
class Block {
  public:
    Block(float* rows, std::size_t bones) noexcept : rows_(rows), bones_(bones) {}

    static std::size_t rows(std::size_t bones) noexcept { return 3 * (bones + 1) + bones + info_rows; }
    static std::size_t floats(std::size_t bones) noexcept { return rows(bones) * block_lanes; }

    std::size_t bones() const noexcept { return bones_; }
    /// Three rows: x, y and z.
    float* joint(std::size_t index) const noexcept { return rows_ + 3 * index * block_lanes; }
    float* length(std::size_t bone) const noexcept { return joint(bones_ + 1) + bone * block_lanes; }
    float* row(Row which) const noexcept {
        return length(bones_) + static_cast<std::size_t>(which) * block_lanes;
    }
    float& at(Row which, std::size_t lane) const noexcept { return row(which)[lane]; }

    glm::vec3 point(std::size_t joint_index, std::size_t lane) const noexcept {
        const float* const p = joint(joint_index) + lane;
        return {p[0], p[block_lanes], p[2 * block_lanes]};
    }
    void set_point(std::size_t joint_index, std::size_t lane, const glm::vec3& to) const noexcept {
        float* const p = joint(joint_index) + lane;
        p[0] = to.x, p[block_lanes] = to.y, p[2 * block_lanes] = to.z;
    }
    glm::vec3 target(std::size_t lane) const noexcept {
        return {at(Row::TargetX, lane), at(Row::TargetY, lane), at(Row::TargetZ, lane)};
    }
    void set_target(std::size_t lane, const glm::vec3& to) const noexcept {
        at(Row::TargetX, lane) = to.x, at(Row::TargetY, lane) = to.y, at(Row::TargetZ, lane) = to.z;
    }
    Start start(std::size_t lane) const noexcept {
        return static_cast<Start>(static_cast<int>(at(Row::Start, lane)));
    }

  private:
    float* rows_;
    std::size_t bones_;
};

/// Memory for blocks, aligned as the widest register wants it.
class BlockMemory {
  public:
    BlockMemory() = default;
    explicit BlockMemory(std::size_t floats)
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
