// The contents of a Batch and the entry points of solve_many: validation and distribution of the work. The
// solve itself is in work.cpp, its iterations in iterate.cpp.
#include "tendril/ik/many.hpp"

#include <algorithm>
#include <vector>

#include "ik/batch/work.hpp"
#include "ik/math.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"
#include "math/tasks.hpp"
#include "tendril/ik/options.hpp"

namespace tendril::ik {

using namespace detail;
using tendril::detail::check_count;
using tendril::detail::check_index;
using tendril::detail::check_length;
using tendril::detail::check_point;

namespace {

constexpr std::size_t max_chains = std::size_t{1} << 31, max_bones = 1'000'000;
/// Starting a thread takes as long as solving about ten thousand bones.
constexpr std::size_t min_bones_per_thread = 8192;

const VectorUnit& widest() noexcept {
    static const VectorUnit& unit = *vector_unit_named(vector_units().front());
    return unit;
}

}  // namespace

struct Batch::Parts {
    Parts(std::size_t chain_count, std::size_t bone_count, std::size_t threads)
        : chains(chain_count), bones(bone_count), blocks(block_count() * Block::chain_floats(bone_count)) {
        for (std::size_t i = 0; i < threads; ++i) scratch.push_back(std::make_unique<Scratch>(bones));
        for (std::size_t i = 0; i < block_count(); ++i) fill(block(i * block_lanes));
    }

    /// Straight along +X, including unused lanes, which take part in the passes.
    static void fill(const Block& block) noexcept;

    std::size_t block_count() const noexcept { return (chains + block_lanes - 1) / block_lanes; }
    Block block(std::size_t chain) const noexcept {
        return {blocks.get() + chain / block_lanes * Block::chain_floats(bones), nullptr, bones};
    }
    void set_lengths(std::size_t chain, std::span<const float> lengths) noexcept;
    /// The rotations of a chain's block.
    float* rotation_rows(std::size_t chain) const noexcept {
        return rotations.get() + chain / block_lanes * 4 * bones * block_lanes;
    }
    void forget_rotations() noexcept;
    static ManySummary solve(Parts& parts, std::span<const glm::vec3> targets, glm::vec3* joints,
                             std::span<ManyReport> reports, const ManyOptions& options) noexcept;
    /// Calls `call` with each block, the index of its first chain and its number of chains.
    template <class Call>
    void for_each_block(Call call) const noexcept {
        for (std::size_t first = 0; first < chains; first += block_lanes) {
            call(block(first), first, std::min(block_lanes, chains - first));
        }
    }

    std::size_t chains, bones;
    Rows blocks;
    std::vector<std::unique_ptr<Scratch>> scratch;  ///< one per thread
    std::unique_ptr<BatchLimits> limits;
    Rows rotations;  ///< with limits
};

void Batch::Parts::fill(const Block& block) noexcept {
    std::fill_n(block.joint(0), Block::chain_floats(block.bones()), 0.0f);
    for (std::size_t i = 0; i <= block.bones(); ++i) {
        std::fill_n(block.joint(i), block_lanes, static_cast<float>(i));
    }
    std::fill_n(block.length(0), block.bones() * block_lanes, 1.0f);
    std::fill_n(block.reach(), block_lanes, static_cast<float>(block.bones()));
    std::fill_n(block.longest(), block_lanes, 1.0f);
}

void Batch::Parts::set_lengths(std::size_t chain, std::span<const float> lengths) noexcept {
    const Block to = block(chain);
    const std::size_t lane = chain % block_lanes;
    double reach = 0.0;
    float longest = 0.0f;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        reach += static_cast<double>(lengths[i]);
        longest = std::max(longest, lengths[i]);
        to.length(i)[lane] = lengths[i];
    }
    to.reach()[lane] = static_cast<float>(reach);
    to.longest()[lane] = longest;
}

void Batch::Parts::forget_rotations() noexcept {
    const glm::quat none(1.0f, 0.0f, 0.0f, 0.0f);
    for (std::size_t row = 0; row < block_count() * bones * 4; ++row) {
        std::fill_n(rotations.get() + row * block_lanes, block_lanes, none[static_cast<int>(row % 4)]);
    }
}

Expected<Batch> Batch::make(std::size_t chains, std::size_t bones, int threads) {
    const auto refused = [](const char* what, const char* wanted, std::size_t value) {
        return tendril::detail::refused("Batch::make", what, wanted, value);
    };
    if (chains > max_chains) return refused("chains", "at most 2147483648", chains);
    if (bones < 1 || bones > max_bones) return refused("bones", "1 to 1000000", bones);
    if (threads < 1 || threads > static_cast<int>(tendril::detail::max_threads)) {
        return tendril::detail::refused("Batch::make", "threads", "1 to 256", threads);
    }
    return Batch(std::make_unique<Parts>(chains, bones, static_cast<std::size_t>(threads)));
}

Batch::Batch(std::unique_ptr<Parts> parts) noexcept : parts_(std::move(parts)) {}
Batch::~Batch() = default;
Batch::Batch(Batch&&) noexcept = default;
Batch& Batch::operator=(Batch&&) noexcept = default;

std::size_t Batch::size() const noexcept {
    return parts_ ? parts_->chains : 0;
}
std::size_t Batch::bones() const noexcept {
    return parts_ ? parts_->bones : 0;
}

namespace {

Result check_chain(const char* operation, std::size_t chain, std::size_t chains) noexcept {
    return check_index(operation, chain, chains, "the batch", "chain");
}

Result no_limits(const char* operation) noexcept {
    return {ErrorCode::NotFound, std::string_view(operation) == "set_rotations"
                                     ? "set_rotations: a batch without limits has no rotations"
                                     : "copy_rotations: a batch without limits has no rotations"};
}

Result check_lengths(std::span<const float> lengths, std::size_t bones) noexcept {
    if (const Result bad = check_count("set_lengths", "lengths", lengths.size(), bones); !bad) return bad;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        if (const Result bad = check_length("set_lengths", {"lengths", i}, lengths[i]); !bad) return bad;
    }
    return {};
}

Result check_joints(std::span<const glm::vec3> joints, std::size_t count) noexcept {
    if (const Result bad = check_count("set_joints", "joints", joints.size(), count); !bad) return bad;
    if (joints.empty() || widest().are_valid(&joints[0].x, 3 * joints.size())) return {};
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (const Result bad = check_point("set_joints", {"joints", i}, joints[i]); !bad) return bad;
    }
    return {};
}

}  // namespace

Result Batch::set_lengths(std::size_t chain, std::span<const float> lengths) {
    if (const Result bad = check_chain("set_lengths", chain, size()); !bad) return bad;
    if (const Result bad = check_lengths(lengths, bones()); !bad) return bad;
    parts_->set_lengths(chain, lengths);
    return {};
}

Result Batch::set_lengths(std::span<const float> lengths) {
    if (!parts_) return tendril::detail::moved_from("set_lengths", "batch");
    if (const Result bad = check_lengths(lengths, bones()); !bad) return bad;
    for (std::size_t chain = 0; chain < size(); ++chain) parts_->set_lengths(chain, lengths);
    return {};
}

Result Batch::set_joints(std::size_t chain, std::span<const glm::vec3> joints) {
    if (const Result bad = check_chain("set_joints", chain, size()); !bad) return bad;
    if (const Result bad = check_joints(joints, bones() + 1); !bad) return bad;
    const Block block = parts_->block(chain);
    for (std::size_t i = 0; i < joints.size(); ++i) block.set_point(i, chain % block_lanes, joints[i]);
    return {};
}

Result Batch::set_joints(std::span<const glm::vec3> joints) {
    if (!parts_) return tendril::detail::moved_from("set_joints", "batch");
    const std::size_t each = bones() + 1;
    if (const Result bad = check_joints(joints, size() * each); !bad) return bad;
    parts_->for_each_block([&](const Block& block, std::size_t first, std::size_t lanes) {
        widest().copy_in(&joints[first * each].x, lanes, 3 * each, block.joint(0));
    });
    return {};
}

Result Batch::set_root(std::size_t chain, glm::vec3 root) {
    if (const Result bad = check_chain("set_root", chain, size()); !bad) return bad;
    if (const Result bad = check_point("set_root", "root", root); !bad) return bad;
    parts_->block(chain).set_point(0, chain % block_lanes, root);
    return {};
}

Result Batch::set_limits(std::span<const Limit> limits, std::span<const glm::vec3> rest_directions) {
    if (!parts_) return tendril::detail::moved_from("set_limits", "batch");
    if (limits.empty()) {
        parts_->limits.reset();
        return {};
    }
    if (const Result bad = check_count("set_limits", "limits", limits.size(), bones()); !bad) return bad;
    std::vector<glm::vec3> rest(bones(), glm::vec3(1.0f, 0.0f, 0.0f));
    if (!rest_directions.empty()) {
        const Result bad = check_count("set_limits", "rest_directions", rest_directions.size(), bones());
        if (!bad) return bad;
        rest.assign(rest_directions.begin(), rest_directions.end());
    }
    for (std::size_t i = 0; i < rest.size(); ++i) {
        const float size = math::length(rest[i]);
        if (!(std::abs(size - 1.0f) <= 1e-3f)) {
            return tendril::detail::refused("set_limits", {"rest_directions", i}, "a unit vector", size);
        }
        rest[i] = times(rest[i], 1.0f / size);
        if (const char* const wrong = fault(limits[i], rest[i])) {
            return tendril::detail::refused("set_limits", {"limits", i}, "a valid limit", wrong);
        }
    }
    parts_->limits = std::make_unique<BatchLimits>(batch_limits(limits, rest));
    for (const std::unique_ptr<Scratch>& scratch : parts_->scratch) {
        scratch->scalar.limited.made = false;  // the cached limits may be for other rest directions
        if (scratch->limited.get() != nullptr) continue;
        scratch->limited = Rows(limited_floats(bones()));
        const auto zeros = [](std::size_t rows) {
            Rows made(rows * block_lanes);
            std::fill_n(made.get(), rows * block_lanes, 0.0f);
            return made;
        };
        scratch->poses = zeros(pose_rows(bones()));
        scratch->rotations = zeros(4 * bones());
    }
    if (parts_->rotations.get() == nullptr) {
        parts_->rotations = Rows(parts_->block_count() * 4 * bones() * block_lanes);
    }
    parts_->forget_rotations();
    return {};
}

Result Batch::set_rotations(std::span<const glm::quat> rotations) {
    if (!parts_) return tendril::detail::moved_from("set_rotations", "batch");
    if (parts_->limits == nullptr) return no_limits("set_rotations");
    const Result bad = check_count("set_rotations", "rotations", rotations.size(), size() * bones());
    if (!bad) return bad;
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        if (is_unit(rotations[i])) continue;
        return tendril::detail::refused("set_rotations", {"rotations", i}, "a unit quaternion",
                                        "one of another length");
    }
    parts_->for_each_block([&](const Block&, std::size_t first, std::size_t lanes) {
        widest().copy_in(&rotations[first * bones()][0], lanes, 4 * bones(), parts_->rotation_rows(first));
    });
    return {};
}

Result Batch::copy_rotations(std::span<glm::quat> out) const {
    if (!parts_) return tendril::detail::moved_from("copy_rotations", "batch");
    if (parts_->limits == nullptr) return no_limits("copy_rotations");
    if (const Result bad = check_count("copy_rotations", "out", out.size(), size() * bones()); !bad)
        return bad;
    parts_->for_each_block([&](const Block&, std::size_t first, std::size_t lanes) {
        widest().copy_out(parts_->rotation_rows(first), lanes, 4 * bones(), &out[first * bones()][0]);
    });
    return {};
}

Result Batch::copy_joints(std::size_t chain, std::span<glm::vec3> out) const {
    if (const Result bad = check_chain("copy_joints", chain, size()); !bad) return bad;
    if (const Result bad = check_count("copy_joints", "out", out.size(), bones() + 1); !bad) return bad;
    const Block block = parts_->block(chain);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = block.point(i, chain % block_lanes);
    return {};
}

Result Batch::copy_joints(std::span<glm::vec3> out) const {
    if (!parts_) return tendril::detail::moved_from("copy_joints", "batch");
    const std::size_t each = bones() + 1;
    if (const Result bad = check_count("copy_joints", "out", out.size(), size() * each); !bad) return bad;
    parts_->for_each_block([&](const Block& block, std::size_t first, std::size_t lanes) {
        widest().copy_out(block.joint(0), lanes, 3 * each, &out[first * each].x);
    });
    return {};
}

float Batch::length(std::size_t chain, std::size_t bone) const noexcept {
    return parts_->block(chain).length(bone)[chain % block_lanes];
}

glm::vec3 Batch::joint(std::size_t chain, std::size_t index) const noexcept {
    return parts_->block(chain).point(index, chain % block_lanes);
}

float Batch::reach(std::size_t chain) const noexcept {
    return parts_->block(chain).reach()[chain % block_lanes];
}

static ManySummary refused_many(std::span<ManyReport> reports, std::size_t chains,
                                const Result& why) noexcept {
    std::fill(reports.begin(), reports.end(), refused_chain);
    return {.invalid = chains, .accepted = why};
}

ManySummary solve_many(Batch& batch, std::span<const glm::vec3> targets, std::span<ManyReport> reports,
                       const ManyOptions& options) noexcept {
    if (!batch.parts_)
        return refused_many(reports, targets.size(), tendril::detail::moved_from("solve_many", "batch"));
    return Batch::Parts::solve(*batch.parts_, targets, nullptr, reports, options);
}

ManySummary solve_many(Batch& batch, std::span<glm::vec3> joints, std::span<const glm::vec3> targets,
                       std::span<ManyReport> reports, const ManyOptions& options) noexcept {
    if (!batch.parts_)
        return refused_many(reports, targets.size(), tendril::detail::moved_from("solve_many", "batch"));
    const std::size_t wanted = batch.size() * (batch.bones() + 1);
    if (const Result bad = check_count("solve_many", "joints", joints.size(), wanted); !bad)
        return refused_many(reports, batch.size(), bad);
    return Batch::Parts::solve(*batch.parts_, targets, joints.data(), reports, options);
}

/// `joints` is null to use the batch's own.
ManySummary Batch::Parts::solve(Parts& parts, std::span<const glm::vec3> targets, glm::vec3* joints,
                                std::span<ManyReport> reports, const ManyOptions& options) noexcept {
    const VectorUnit* const unit =
        options.vector_unit.empty() ? &widest() : vector_unit_named(options.vector_unit);
    Options scalar;
    scalar.tolerance = options.tolerance;
    scalar.max_iterations = options.max_iterations;
    scalar.every_iteration = options.every_iteration;
    scalar.restarts = options.restarts;
    scalar.plane = options.plane;
    if (parts.limits) scalar.limits = parts.limits->limits;
    const auto no = [&](const Result& why) { return refused_many(reports, parts.chains, why); };
    if (const Result bad = check_count("solve_many", "targets", targets.size(), parts.chains); !bad)
        return no(bad);
    if (!reports.empty() && reports.size() != parts.chains)
        return no(tendril::detail::refused_count("solve_many", "reports", reports.size(), parts.chains));
    if (unit == nullptr)
        return no(tendril::detail::refused("solve_many", "vector_unit", "one of vector_units()",
                                           options.vector_unit));
    if (const Result bad = check(scalar, parts.bones); !bad) return no(bad);
    Work work({parts.blocks.get(), parts.chains, parts.bones, targets, joints, reports, scalar, *unit,
               parts.limits.get(), parts.rotations.get()});
    const std::size_t useful =
        std::min(parts.block_count(), parts.chains * parts.bones / min_bones_per_thread);
    const auto count = static_cast<std::uint32_t>(std::clamp<std::size_t>(useful, 1, parts.scratch.size()));
    const auto piece = [&](std::uint32_t index) noexcept { work.run(*parts.scratch[index]); };
    tendril::detail::run_pieces(options.tasks, count, count, piece);
    ManySummary summary = work.summary();
    if (summary.invalid == 0) return summary;
    summary.accepted =
        check_point("solve_many", {"targets", summary.first_invalid}, targets[summary.first_invalid]);
    if (summary.accepted)
        summary.accepted = tendril::detail::refused("solve_many", {"chains", summary.first_invalid},
                                                    "within 1e9 m of the origin", "a joint farther away");
    return summary;
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ManyOptions>() noexcept {
    using ik::ManyOptions;
    static constexpr Field rows[] = {field<&ManyOptions::tolerance>("tolerance", {0.0, max_magnitude}, "m"),
                                     field<&ManyOptions::max_iterations>("max_iterations", {1, 1'000'000}),
                                     field<&ManyOptions::every_iteration>("every_iteration"),
                                     field<&ManyOptions::restarts>("restarts", {0, 1000}),
                                     nested<&ManyOptions::plane>("plane")};
    return rows;
}
