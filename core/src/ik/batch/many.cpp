// What a Batch holds, and the door of solve_many: what is checked, and how the threads are started. The solve
// itself is in many_work.cpp, its pulls in many_vector.cpp.
#include "tendril/ik/many.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "chain/checks.hpp"
#include "ik/batch/work.hpp"
#include "ik/solve/validate.hpp"
#include "math/tasks.hpp"

namespace tendril::ik {

using namespace detail;

namespace {

constexpr std::size_t max_chains = std::size_t{1} << 31, max_bones = 1'000'000;
/// Starting a thread takes as long as some ten thousand bones do.
constexpr std::size_t bones_a_thread = 8192;

std::size_t checked(std::string_view what, std::size_t value, std::size_t least, std::size_t most) {
    if (value >= least && value <= most) return value;
    tendril::detail::refuse("Batch", what, std::to_string(least) + " to " + std::to_string(most),
                            std::to_string(value));
}

void require_index(std::string_view what, std::size_t index, std::size_t count) {
    if (index < count) return;
    throw std::out_of_range("Batch: " + std::string(what) + " " + std::to_string(index) +
                            " is out of range, there are " + std::to_string(count));
}

void require_count(std::string_view what, std::size_t count, std::size_t expected) {
    if (count == expected) return;
    tendril::detail::refuse("Batch", what, std::to_string(expected) + " in number", std::to_string(count));
}

}  // namespace

struct Batch::Parts {
    Parts(std::size_t chain_count, std::size_t bone_count)
        : chains(chain_count),
          bones(bone_count),
          blocks(block_count() * Block::floats(bone_count)),
          late(chain_count) {
        rooms.push_back(std::make_unique<WorkRoom>(bones));
        fill(Block(rooms[0]->tile.get(), bones));
        for (std::size_t i = 0; i < block_count(); ++i) fill(block(i * block_lanes));
    }

    /// Straight along +X: also the lanes that stay unused, for they are pulled along.
    static void fill(const Block& block) noexcept;

    std::size_t block_count() const noexcept { return (chains + block_lanes - 1) / block_lanes; }
    /// The one that a chain is in.
    Block block(std::size_t chain) const noexcept {
        return {blocks.get() + chain / block_lanes * Block::floats(bones), bones};
    }
    /// As many as there is work and memory for, at most `wanted`.
    std::size_t rooms_for(int wanted) noexcept;

    std::size_t chains, bones;
    BlockMemory blocks;
    std::vector<std::uint32_t> late;               ///< for the stragglers of a solve
    std::vector<std::unique_ptr<WorkRoom>> rooms;  ///< one a thread
};

void Batch::Parts::fill(const Block& block) noexcept {
    std::fill_n(block.joint(0), Block::floats(block.bones()), 0.0f);
    for (std::size_t i = 0; i <= block.bones(); ++i) {
        std::fill_n(block.joint(i), block_lanes, static_cast<float>(i));
    }
    std::fill_n(block.length(0), block.bones() * block_lanes, 1.0f);
    std::fill_n(block.row(Row::Reach), block_lanes, static_cast<float>(block.bones()));
    std::fill_n(block.row(Row::Longest), block_lanes, 1.0f);
}

std::size_t Batch::Parts::rooms_for(int wanted) noexcept {
    const std::size_t useful = std::min(block_count(), chains * bones / bones_a_thread);
    const std::size_t count = std::max<std::size_t>(1, std::min(static_cast<std::size_t>(wanted), useful));
    try {
        while (rooms.size() < count) {
            auto room = std::make_unique<WorkRoom>(bones);
            fill(Block(room->tile.get(), bones));
            rooms.push_back(std::move(room));
        }
    } catch (...) {
    }
    return std::min(count, rooms.size());
}

Batch::Batch(std::size_t chains, std::size_t bones)
    : parts_(std::make_unique<Parts>(checked("chains", chains, 0, max_chains),
                                     checked("bones", bones, 1, max_bones))) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

std::size_t Batch::size() const noexcept {
    return parts_->chains;
}
std::size_t Batch::bones() const noexcept {
    return parts_->bones;
}

void Batch::set_lengths(std::size_t chain, std::span<const float> lengths) {
    require_index("chain", chain, size());
    require_count("lengths", lengths.size(), bones());
    double reach = 0.0;
    float longest = 0.0f;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (!tendril::detail::is_length(lengths[i])) {
            tendril::detail::require_length("Batch", "lengths[" + std::to_string(i) + "]", lengths[i]);
        }
        reach += static_cast<double>(lengths[i]);
        longest = std::max(longest, lengths[i]);
    }
    const Block block = parts_->block(chain);
    const std::size_t lane = chain % block_lanes;
    for (std::size_t i = 0; i < lengths.size(); ++i) block.length(i)[lane] = lengths[i];
    block.at(Row::Reach, lane) = static_cast<float>(reach);
    block.at(Row::Longest, lane) = longest;
}

void Batch::set_joints(std::size_t chain, std::span<const glm::vec3> joints) {
    require_index("chain", chain, size());
    require_count("joints", joints.size(), bones() + 1);
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (tendril::detail::is_point(joints[i])) continue;
        tendril::detail::require_point("Batch", "joints[" + std::to_string(i) + "]", joints[i]);
    }
    const Block block = parts_->block(chain);
    for (std::size_t i = 0; i < joints.size(); ++i) block.set_point(i, chain % block_lanes, joints[i]);
}

void Batch::set_root(std::size_t chain, glm::vec3 root) {
    require_index("chain", chain, size());
    tendril::detail::require_point("Batch", "root", root);
    parts_->block(chain).set_point(0, chain % block_lanes, root);
}

float Batch::length(std::size_t chain, std::size_t bone) const {
    require_index("chain", chain, size());
    require_index("bone", bone, bones());
    return parts_->block(chain).length(bone)[chain % block_lanes];
}

glm::vec3 Batch::joint(std::size_t chain, std::size_t index) const {
    require_index("chain", chain, size());
    require_index("joint", index, bones() + 1);
    return parts_->block(chain).point(index, chain % block_lanes);
}

void Batch::joints(std::size_t chain, std::span<glm::vec3> out) const {
    require_index("chain", chain, size());
    require_count("joints", out.size(), bones() + 1);
    const Block block = parts_->block(chain);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = block.point(i, chain % block_lanes);
}

float Batch::reach(std::size_t chain) const {
    require_index("chain", chain, size());
    return parts_->block(chain).at(Row::Reach, chain % block_lanes);
}

void solve_many(Batch& batch, std::span<const glm::vec3> targets, std::span<Report> reports,
                const ManyOptions& options) noexcept {
    Batch::Parts& parts = *batch.parts_;
    const VectorUnit* const unit =
        vector_unit_named(options.vector_unit.empty() ? vector_units().front() : options.vector_unit);
    Options scalar;
    scalar.tolerance = options.tolerance;
    scalar.max_iterations = options.max_iterations;
    scalar.every_iteration = options.every_iteration;
    const bool fits = targets.size() == parts.chains && (reports.empty() || reports.size() == parts.chains);
    const bool threads =
        options.threads >= 1 && options.threads <= static_cast<int>(tendril::detail::max_threads);
    if (!fits || !threads || unit == nullptr || !are_valid(scalar, parts.bones)) {
        std::fill(reports.begin(), reports.end(), Report{Status::InvalidInput, 0, 0.0f});
        return;
    }
    Work work(parts.blocks.get(), parts.chains, parts.bones, targets, reports, scalar, *unit, parts.late);
    const std::size_t rooms = parts.rooms_for(options.threads);
    const auto count = static_cast<std::uint32_t>(rooms);
    const auto piece = [&](std::uint32_t index) noexcept { work.run(*parts.rooms[index]); };
    tendril::detail::run_pieces(options.tasks, count, count, piece);
}

}  // namespace tendril::ik
