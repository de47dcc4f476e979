// Copies between lists of points, as programs store them, and the rows of a block.
#include <glm/gtc/quaternion.hpp>

#include "ik/batch/vector.hpp"
#include "tendril/chain/segment.hpp"

#define HWY_TARGET_INCLUDE "ik/batch/transfer.cpp"
#include "math/each_target-inl.hpp"

#include "ik/batch/step-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::ik::detail {
namespace HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR

/// Loads four floats of every fourth list (or row): 0, 4, 8 and so on, until a register is full.
template <class D>
HWY_INLINE hn::Vec<D> load_quads(D d, const float* from, std::size_t stride) {
    if constexpr (hn::MaxLanes(D()) <= 4) {
        return hn::LoadU(d, from);
    } else {
        const hn::Half<D> half;
        const std::size_t lists = hn::MaxLanes(half);
        return hn::Combine(d, load_quads(half, from + lists * stride, stride),
                           load_quads(half, from, stride));
    }
}

/// Four registers; each block of four lanes is a matrix with these as rows.
template <class D>
struct Quads {
    hn::Vec<D> a, b, c, e;

    HWY_INLINE void transpose(D d) {
        const auto ac = hn::InterleaveLower(d, a, c), be = hn::InterleaveLower(d, b, e);
        const auto ac2 = hn::InterleaveUpper(d, a, c), be2 = hn::InterleaveUpper(d, b, e);
        a = hn::InterleaveLower(d, ac, be), b = hn::InterleaveUpper(d, ac, be);
        c = hn::InterleaveLower(d, ac2, be2), e = hn::InterleaveUpper(d, ac2, be2);
    }
};

template <class D>
HWY_INLINE void quads_in(D d, const float* from, std::size_t stride, float* to) {
    Quads<D> quads{load_quads(d, from, stride), load_quads(d, from + stride, stride),
                   load_quads(d, from + 2 * stride, stride), load_quads(d, from + 3 * stride, stride)};
    quads.transpose(d);
    hn::Store(quads.a, d, to), hn::Store(quads.b, d, to + block_lanes);
    hn::Store(quads.c, d, to + 2 * block_lanes), hn::Store(quads.e, d, to + 3 * block_lanes);
}
/// Writes a register's worth of each of four lists.
template <class D>
HWY_INLINE void quads_out(D d, const float* from, std::size_t stride, float* to) {
    const auto quads_of = [&](std::size_t row) {
        return load_quads(d, from + row * block_lanes, block_lanes);
    };
    Quads<D> quads{quads_of(0), quads_of(1), quads_of(2), quads_of(3)};
    quads.transpose(d);
    hn::StoreU(quads.a, d, to), hn::StoreU(quads.b, d, to + stride);
    hn::StoreU(quads.c, d, to + 2 * stride), hn::StoreU(quads.e, d, to + 3 * stride);
}

/// Writes four lists, from float `done` on. The last register may overlap floats already written.
template <class D>
HWY_INLINE void lists_out(D d, const float* rows, std::size_t count, float* lists, std::size_t done = 0) {
    const auto out = [&](std::size_t i) { quads_out(d, rows + i * block_lanes, count, lists + i); };
    constexpr std::size_t size = hn::MaxLanes(D());
    for (; done + size <= count; done += size) out(done);
    if (done == count) return;
    if constexpr (size > 4) {
        if (count < size || done + size / 2 > count)
            return lists_out(hn::Half<D>(), rows, count, lists, done);
    }
    out(count - size);
}

/// Calls `quad` with every four of `count` floats; the last four may overlap the previous ones.
template <class Quad>
HWY_INLINE void for_each_quad(std::size_t count, Quad quad) {
    for (std::size_t i = 0; i + 4 <= count; i += 4) quad(i);
    if (count % 4 != 0) quad(count - 4);
}

#endif

/// Copies `lanes` lists of `count` floats to rows.
void copy_in(const float* lists, std::size_t lanes, std::size_t count, float* rows) {
    std::size_t lane = 0;
#if HWY_TARGET != HWY_SCALAR
    const auto some = [&](auto d) {
        for (; lane + hn::MaxLanes(d) <= lanes; lane += hn::MaxLanes(d)) {
            for_each_quad(count, [&](std::size_t i) {
                quads_in(d, lists + lane * count + i, count, rows + i * block_lanes + lane);
            });
        }
    };
    if (count >= 4) some(Floats()), some(hn::CappedTag<float, 4>());
#endif
    for (; lane < lanes; ++lane) {
        for (std::size_t i = 0; i < count; ++i) rows[i * block_lanes + lane] = lists[lane * count + i];
    }
}

/// Copies rows to `lanes` lists of `count` floats.
void copy_out(const float* rows, std::size_t lanes, std::size_t count, float* lists) {
    std::size_t lane = 0;
#if HWY_TARGET != HWY_SCALAR
    for (; count >= 4 && lane + 4 <= lanes; lane += 4) {
        lists_out(Floats(), rows + lane, count, lists + lane * count);
    }
#endif
    for (; lane < lanes; ++lane) {
        for (std::size_t i = 0; i < count; ++i) lists[lane * count + i] = rows[i * block_lanes + lane];
    }
}

void set_targets(const Block& block, std::size_t lanes, const glm::vec3* targets, float tolerance) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        for (int k = 0; k < 3; ++k)
            block.target()[static_cast<std::size_t>(k) * block_lanes + lane] = targets[lane][k];
    }
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
