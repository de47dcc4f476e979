// One solve of a Batch, as the threads that share it see it. Not installed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <mutex>
#include <span>

#include "ik/batch/block.hpp"
#include "ik/batch/vector.hpp"
#include "ik/solve/problem.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik::detail {

/// What a thread works with; made once.
struct WorkRoom {
    explicit WorkRoom(std::size_t bones);

    BlockMemory tile;                                 ///< a block of chains from anywhere
    std::array<std::uint32_t, block_lanes> chains{};  ///< which chain is in which lane of it
    Workspace scalar;                                 ///< for the careful ones
};

/// Chains that need more iterations than most of their block: any thread may go on with them.
class Stragglers {
  public:
    explicit Stragglers(std::span<std::uint32_t> list) noexcept : list_(list) {}
    void push(std::span<const std::uint32_t> chains) noexcept;
    /// As many as there are, up to the size of `out`.
    std::size_t pop(std::span<std::uint32_t> out) noexcept;

  private:
    std::mutex mutex_;
    std::span<std::uint32_t> list_;  ///< one place for each chain of the batch: none comes twice
    std::size_t first_ = 0, last_ = 0;
};

class Work {
  public:
    /// All has been checked. `list` is for the stragglers, one place a chain.
    Work(float* blocks, std::size_t chains, std::size_t bones, std::span<const glm::vec3> targets,
         std::span<Report> reports, const Options& options, const VectorUnit& unit,
         std::span<std::uint32_t> list) noexcept
        : blocks_(blocks),
          chains_(chains),
          bones_(bones),
          targets_(targets),
          reports_(reports),
          options_(options),
          unit_(unit),
          stragglers_(list) {}

    /// Takes blocks, then stragglers, until there are none left. Threads may call it side by side, each with
    /// a room of its own.
    void run(WorkRoom& room) noexcept;

  private:
    Block block(std::size_t index) const noexcept {
        return {blocks_ + index * Block::floats(bones_), bones_};
    }
    void set_up(const Block& block, std::size_t first, std::size_t lanes) const noexcept;
    void solve_block(std::size_t index, WorkRoom& room) noexcept;
    void pull_block(const Block& block, std::size_t lanes, std::size_t active) const noexcept;
    void solve_careful(const Block& block, std::size_t lane, std::size_t chain,
                       WorkRoom& room) const noexcept;
    void solve_stragglers(WorkRoom& room) noexcept;
    std::size_t refill(const Block& tile, std::size_t used, WorkRoom& room) noexcept;
    void put_into_tile(const Block& tile, std::size_t lane, std::size_t chain) const noexcept;
    void take_from_tile(const Block& tile, std::size_t lane, std::size_t chain) const noexcept;
    void report(const Block& block, std::size_t lane, std::size_t chain) const noexcept;

    float* blocks_;
    std::size_t chains_, bones_;
    std::span<const glm::vec3> targets_;
    std::span<Report> reports_;
    const Options& options_;
    const VectorUnit& unit_;
    std::atomic<std::size_t> next_block_{0};
    Stragglers stragglers_;
};

}  // namespace tendril::ik::detail
