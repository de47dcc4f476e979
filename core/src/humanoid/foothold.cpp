// Finds positions with ground below the whole sole.
#include "humanoid/foot.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;

/// Positions at which the ground below the sole is sampled, as fractions of its length. The middle two must
/// have ground below them.
constexpr std::array<double, 4> sample_positions{0.0, 0.4, 0.75, 1.0};
/// Maximum distance of a foothold, as a fraction of break_distance.
constexpr double max_foothold_part = 0.75;
/// Weight of the distance from the previous foothold, relative to the distance from the clip's.
constexpr double previous_weight = 0.5;
/// Steps are found to within this distance, metres.
constexpr double step_resolution = 0.002;
/// Shifts to the side to try, metres, for a sole that lies along an edge.
constexpr double side_shifts[]{0.02, -0.02, 0.05, -0.05};

/// A flat sole over the ground.
class SoleProbe {
  public:
    SoleProbe(const glm::dvec3& heel, const glm::dvec3& toe, double from, const FootContext& context) noexcept
        : heel_(heel), from_(from), context_(context) {
        const glm::dvec3 way = minus(toe, heel), level{way.x, 0.0, way.z};
        along_ = direction_of(level, 1e-9).value_or(glm::dvec3(0.0, 0.0, 1.0));
        size_ = length(way);
        margin_ = context.options.edge;
    }
    glm::dvec3 side() const noexcept { return {along_.z, 0.0, -along_.x}; }
    const glm::dvec3& along() const noexcept { return along_; }
    double size() const noexcept { return size_; }

    enum class Stand { Nowhere, Partial, Whole };
    /// Tests how the shifted sole stands. `margin`: required ground before the toe and behind the heel.
    Stand stand(const glm::dvec3& shift, double margin) const noexcept {
        std::array<double, sample_positions.size()> heights;
        std::optional<GroundHit> first;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const glm::dvec3 by = plus(shift, times(along_, place(i, margin)));
            const auto hit = below(by);
            if (check_ground(hit, context_) != FootAlone::No) {
                heights[i] = -1e300;  // a hole
                continue;
            }
            if (!first) first = hit, origin_ = by;
            heights[i] = hit->height - height_of_plane(*first, by.x - origin_.x, by.z - origin_.z);
        }
        const double highest = *std::max_element(heights.begin(), heights.end());
        const auto holds = [&](std::size_t i) { return heights[i] >= highest - step_over_plane; };
        if (!first || !holds(1) || !holds(2)) return Stand::Nowhere;
        return holds(0) && holds(3) ? Stand::Whole : Stand::Partial;
    }
    /// Calls `visit` with the distance from the heel to each step in the ground below the sole.
    void for_steps(auto visit) const noexcept {
        std::optional<GroundHit> before = below(times(along_, place(0, margin_)));
        double last = place(0, margin_);
        for (std::size_t i = 1; i < sample_positions.size(); ++i) {
            const double here = place(i, margin_);
            const auto hit = below(times(along_, here));
            if (before && is_step(*before, last, hit, here)) {
                double low = last, high = here;
                while (high - low > step_resolution) {
                    const double middle = 0.5 * (low + high);
                    (is_step(*before, last, below(times(along_, middle)), middle) ? high : low) = middle;
                }
                visit(0.5 * (low + high));
            }
            before = hit, last = here;
        }
    }

  private:
    double place(std::size_t i, double margin) const noexcept {
        const double ends = i == 0 ? -margin : i + 1 == sample_positions.size() ? margin : 0.0;
        return sample_positions[i] * size_ + ends;
    }
    std::optional<GroundHit> below(const glm::dvec3& by) const noexcept {
        return context_.ground.below({heel_.x + by.x, from_, heel_.z + by.z});
    }
    bool is_step(const GroundHit& before, double at, const std::optional<GroundHit>& hit,
                 double here) const noexcept {
        if (!hit) return true;
        const double way = here - at;
        return std::abs(hit->height - height_of_plane(before, along_.x * way, along_.z * way)) >
               step_over_plane;
    }

    glm::dvec3 heel_, along_{0.0};
    double from_, size_ = 0.0, margin_ = 0.0;
    const FootContext& context_;
    mutable glm::dvec3 origin_{0.0};
};

}  // namespace

FootAlone check_ground(const std::optional<GroundHit>& hit, const FootContext& context) noexcept {
    if (!hit) return FootAlone::NoHit;
    if (hit->normal.y < context.steepest) return FootAlone::TooSteep;
    const double step = std::abs(hit->height - (context.floor + context.base));
    return step <= context.options.max_step ? FootAlone::No : FootAlone::TooFar;
}

glm::dvec3 find_foothold(const glm::dvec3& heel, const glm::dvec3& toe, double from, const glm::dvec3& before,
                         const FootContext& context) noexcept {
    const SoleProbe sole(heel, toe, from, context);
    const double margin = context.options.edge, limit = max_foothold_part * context.options.break_distance;
    using Stand = SoleProbe::Stand;
    if (!(margin > 0.0)) return glm::dvec3(0.0);
    glm::dvec3 best{0.0};
    constexpr int best_stand = 4;
    int best_rank = 0;
    double least_cost = 1e300;
    const auto try_shift = [&](const glm::dvec3& shift) {
        const double size = length(shift);
        if (size > limit) return;
        const double cost = size + previous_weight * length(minus(shift, before));
        // From best to worst: the whole sole with the margin; without it; one end in the air, with the
        // margin; without it.
        if (best_rank == best_stand && cost >= least_cost) return;
        const Stand wide = sole.stand(shift, margin),
                    close = wide == Stand::Whole ? wide : sole.stand(shift, 0.0);
        const int rank = wide == Stand::Whole      ? best_stand
                         : close == Stand::Whole   ? 3
                         : wide == Stand::Partial  ? 2
                         : close == Stand::Partial ? 1
                                                   : 0;
        if (rank < best_rank || (rank == best_rank && cost >= least_cost)) return;
        best = shift, best_rank = rank, least_cost = cost;
    };
    try_shift(glm::dvec3(0.0));
    if (best_rank == best_stand) return best;
    sole.for_steps([&](double at) {
        for (const double clear : {margin + 0.5 * step_resolution, 0.25 * margin}) {
            try_shift(times(sole.along(), at + clear));
            try_shift(times(sole.along(), at - clear - sole.size()));
        }
    });
    for (const double by : side_shifts) try_shift(times(sole.side(), by));
    return best;
}

}  // namespace tendril::humanoid::detail
