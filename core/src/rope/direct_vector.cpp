// The direct solver for each vector unit.
#include <cstdint>
#include <string_view>

#include "rope/direct_block.hpp"

#define HWY_TARGET_INCLUDE "rope/direct_vector.cpp"
#include "math/each_target-inl.hpp"

#include "rope/direct_step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {

using Wide = hn::CappedTag<double, max_lanes>;
using Single = hn::CappedTag<double, 1>;

void solve_wide(const Block& block, SolveJob& job) {
    BlockSolver<Wide>(block).run(job);
}
void solve_single(const Block& block, SolveJob& job) {
    BlockSolver<Single>(block).run(job);
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

}  // namespace

VectorUnit vector_unit(std::string_view name) noexcept {
    const std::int64_t target = tendril::detail::target_named(name);
    if (target == 0) return {};
    return {TENDRIL_COMPILED_FOR(solve_wide, target), TENDRIL_COMPILED_FOR(solve_single, target),
            TENDRIL_COMPILED_FOR(wide_lanes, target)()};
}

}  // namespace tendril::rope::detail
#endif
