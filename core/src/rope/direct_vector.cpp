// The direct solver for each vector unit. Highway compiles this file once for each: it includes it again and
// again, each time with another HWY_NAMESPACE.
#include <cstdint>
#include <string_view>

#include "rope/direct_block.hpp"

// Adds nothing for doubles, and some versions do not compile with it as the baseline (-march=native).
#define HWY_DISABLED_TARGETS HWY_AVX3_DL
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rope/direct_vector.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "rope/direct_step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {

using Wide = hn::CappedTag<double, most_lanes>;
using Single = hn::CappedTag<double, 1>;

void solve_wide(const Block& block, Order& order) {
    BlockSolver<Wide>(block).run(order);
}
void solve_single(const Block& block, Order& order) {
    BlockSolver<Single>(block).run(order);
}
std::size_t wide_lanes() {
    return hn::Lanes(Wide());
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::rope::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::rope::detail {
namespace {

HWY_EXPORT(solve_wide);
HWY_EXPORT(solve_single);
HWY_EXPORT(wide_lanes);

VectorUnit unit_for(std::int64_t target) {
#if HWY_TARGETS == HWY_STATIC_TARGET
    static_cast<void>(target);
    return {HWY_STATIC_DISPATCH(solve_wide), HWY_STATIC_DISPATCH(solve_single),
            HWY_STATIC_DISPATCH(wide_lanes)()};
#else
    hwy::ChosenTarget chosen;
    chosen.Update(target);
    const std::size_t index = chosen.GetIndex();
    return {HWY_DISPATCH_TABLE(solve_wide)[index], HWY_DISPATCH_TABLE(solve_single)[index],
            HWY_DISPATCH_TABLE(wide_lanes)[index]()};
#endif
}

}  // namespace

VectorUnit vector_unit(std::string_view name) noexcept {
    std::int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    if (targets == 0) targets = HWY_STATIC_TARGET;
    // A lower bit is a better target.
    for (; targets != 0; targets &= targets - 1) {
        const std::int64_t target = targets & -targets;
        if (name.empty() || name == hwy::TargetName(target)) return unit_for(target);
    }
    return {};
}

}  // namespace tendril::rope::detail
#endif
