// Between points one after the other, as programs keep them, and the rows of a block.
//
// Highway compiles this file once for each vector unit: it includes it again and again, each time with
// another HWY_NAMESPACE.
#include <glm/gtc/quaternion.hpp>

#include "ik/batch/vector.hpp"
#include "math/dispatch.hpp"
#include "tendril/chain/segment.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ik/batch/transfer.cpp"
#include <hwy/foreach_target.h>  // before highway.h
#include <hwy/highway.h>

#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

/// From `lanes` lists of `count` floats, each `stride` after the one before, to rows.
HWY_INLINE void transpose_in(const float* lists, std::size_t stride, std::size_t lanes, std::size_t count,
                             float* rows) {
    std::size_t lane = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::FixedTag<float, 4> d;
    for (; lane + 4 <= lanes; lane += 4) {
        const float* const from = lists + lane * stride;
        std::size_t i = 0;
        for (; i + 4 <= count; i += 4) {
            const auto a = hn::LoadU(d, from + i), b = hn::LoadU(d, from + stride + i),
                       c = hn::LoadU(d, from + 2 * stride + i), e = hn::LoadU(d, from + 3 * stride + i);
            const auto ac = hn::InterleaveLower(d, a, c), be = hn::InterleaveLower(d, b, e),
                       ac2 = hn::InterleaveUpper(d, a, c), be2 = hn::InterleaveUpper(d, b, e);
            float* const to = rows + i * block_lanes + lane;
            hn::Store(hn::InterleaveLower(d, ac, be), d, to);
            hn::Store(hn::InterleaveUpper(d, ac, be), d, to + block_lanes);
            hn::Store(hn::InterleaveLower(d, ac2, be2), d, to + 2 * block_lanes);
            hn::Store(hn::InterleaveUpper(d, ac2, be2), d, to + 3 * block_lanes);
        }
        for (; i < count; ++i) {
            for (std::size_t k = 0; k < 4; ++k) rows[i * block_lanes + lane + k] = from[k * stride + i];
        }
    }
#endif
    for (; lane < lanes; ++lane) {
        for (std::size_t i = 0; i < count; ++i) rows[i * block_lanes + lane] = lists[lane * stride + i];
    }
}

/// The other way.
HWY_INLINE void transpose_out(const float* rows, std::size_t stride, std::size_t lanes, std::size_t count,
                              float* lists) {
    std::size_t lane = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::FixedTag<float, 4> d;
    for (; lane + 4 <= lanes; lane += 4) {
        float* const to = lists + lane * stride;
        std::size_t i = 0;
        for (; i + 4 <= count; i += 4) {
            const float* const from = rows + i * block_lanes + lane;
            const auto a = hn::Load(d, from), b = hn::Load(d, from + block_lanes),
                       c = hn::Load(d, from + 2 * block_lanes), e = hn::Load(d, from + 3 * block_lanes);
            const auto ac = hn::InterleaveLower(d, a, c), be = hn::InterleaveLower(d, b, e),
                       ac2 = hn::InterleaveUpper(d, a, c), be2 = hn::InterleaveUpper(d, b, e);
            hn::StoreU(hn::InterleaveLower(d, ac, be), d, to + i);
            hn::StoreU(hn::InterleaveUpper(d, ac, be), d, to + stride + i);
            hn::StoreU(hn::InterleaveLower(d, ac2, be2), d, to + 2 * stride + i);
            hn::StoreU(hn::InterleaveUpper(d, ac2, be2), d, to + 3 * stride + i);
        }
        for (; i < count; ++i) {
            for (std::size_t k = 0; k < 4; ++k) to[k * stride + i] = rows[i * block_lanes + lane + k];
        }
    }
#endif
    for (; lane < lanes; ++lane) {
        for (std::size_t i = 0; i < count; ++i) lists[lane * stride + i] = rows[i * block_lanes + lane];
    }
}

void copy_in(const float* lists, std::size_t lanes, std::size_t count, float* rows) {
    transpose_in(lists, count, lanes, count, rows);
}

void copy_out(const float* rows, std::size_t lanes, std::size_t count, float* lists) {
    transpose_out(rows, count, lanes, count, lists);
}

void set_targets(const Block& block, std::size_t lanes, const glm::vec3* targets, float tolerance) {
    transpose_in(&targets->x, 3, lanes, 3, block.target());
    const Floats d;
    for (std::size_t i = 0; i < lanes; i += hn::Lanes(d)) {
        const Lanes own = hn::Mul(all(1e-3f), load(block.reach() + i));
        store(tolerance >= 0.0f ? all(tolerance) : own, block.row(Row::Tolerance) + i);
    }
}

bool are_valid(const float* coordinates, std::size_t count) {
    const Floats d;
    Mask fine = hn::Not(none());
    std::size_t i = 0;
    for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d)) {
        fine = hn::And(fine, hn::Le(hn::Abs(hn::LoadU(d, coordinates + i)), all(max_magnitude)));
    }
    bool all_fine = hn::AllTrue(d, fine);
    for (; i < count; ++i) all_fine = all_fine && std::abs(coordinates[i]) <= max_magnitude;
    return all_fine;
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::ik::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::ik::detail {
namespace {
HWY_EXPORT(copy_in);
HWY_EXPORT(copy_out);
HWY_EXPORT(set_targets);
HWY_EXPORT(are_valid);
}  // namespace

static_assert(sizeof(glm::vec3) == 3 * sizeof(float) && sizeof(glm::quat) == 4 * sizeof(float),
              "their coordinates lie one after the other");

void transfers_with(std::int64_t target, VectorUnit& unit) noexcept {
    unit.copy_in = TENDRIL_COMPILED_FOR(copy_in, target);
    unit.copy_out = TENDRIL_COMPILED_FOR(copy_out, target);
    unit.set_targets = TENDRIL_COMPILED_FOR(set_targets, target);
    unit.are_valid = TENDRIL_COMPILED_FOR(are_valid, target);
}

}  // namespace tendril::ik::detail
#endif
