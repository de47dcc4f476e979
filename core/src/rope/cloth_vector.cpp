// The system of a cloth, for each vector unit.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "rope/cloth_grid.hpp"

#define HWY_TARGET_INCLUDE "rope/cloth_vector.cpp"
#include "math/each_target-inl.hpp"

#include "rope/grid_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {

using Double = hn::CappedTag<double, grid_lanes>;
using Narrow = hn::Rebind<float, Double>;

inline hn::Vec<Double> load_double(const float* from) {
    return hn::PromoteTo(Double(), hn::LoadU(Narrow(), from));
}

/// By how much the links of a register exceed their rest length. In single precision the rounding of
/// positions would push a stiff link by more than gravity does in a substep of 1/1000 s.
inline V excess(const ClothArrays& cloth, const float* rest, std::ptrdiff_t from, std::ptrdiff_t to) {
    alignas(64) float lanes[grid_lanes];
    for (std::size_t k = 0; k < hn::Lanes(Tag()); k += hn::Lanes(Double())) {
        hn::Vec<Double> square = hn::Zero(Double());
        for (std::size_t c = 0; c < 3; ++c) {
            const float *high = cloth.position[c] + k, *low = cloth.rounding[c] + k;
            const auto by = hn::Add(hn::Sub(load_double(high + to), load_double(high + from)),
                                    hn::Sub(load_double(low + to), load_double(low + from)));
            square = hn::Add(square, hn::Mul(by, by));
        }
        const auto longer = hn::Sub(hn::Sqrt(square), load_double(rest + from + k));
        hn::StoreU(hn::DemoteTo(Narrow(), longer), Narrow(), lanes + k);
    }
    return load(lanes);
}

/// The links of one step.
template <std::size_t s>
void links_of(const GridLevel& level, const ClothArrays& cloth, float counted_stiffness, ClothPart& part,
              GridRange cells) {
    const V zero = hn::Zero(Tag()), one = hn::Set(Tag(), 1.0f), shortest = hn::Set(Tag(), 1e-18f);
    const std::ptrdiff_t step = level.step(s);
    const GridBlocks& blocks = level.links[s];
    V strain = zero;
    part.potential += sum_of(cells, [&](std::ptrdiff_t i) {
        const V stiffness = load(cloth.stiffness[s] + i), rest = load(cloth.rest[s] + i);
        const V3 by = load(cloth.position, i + step) - load(cloth.position, i);
        const V length =
            hn::Sqrt(hn::Add(hn::Add(hn::Mul(by.x, by.x), hn::Mul(by.y, by.y)), hn::Mul(by.z, by.z)));
        // Coincident particles take an arbitrary direction.
        const auto some = hn::Gt(length, shortest);
        const V inverse = hn::Div(one, hn::IfThenElse(some, length, one));
        const V3 n = {hn::IfThenElse(some, hn::Mul(by.x, inverse), one), hn::Mul(by.y, inverse),
                      hn::Mul(by.z, inverse)};
        const V longer = excess(cloth, cloth.rest[s], i, i + step), force = hn::Mul(stiffness, longer);
        if (s < stretch_steps) {
            const V by_rest = hn::Div(hn::Abs(longer), hn::Max(rest, shortest));
            const auto counts = hn::Eq(stiffness, hn::Set(Tag(), counted_stiffness));
            strain = hn::Max(strain, hn::IfThenElseZero(counts, by_rest));
        }
        const V pull = hn::Mul(force, inverse);
        const V sideways = hn::Max(pull, zero), along = hn::Sub(stiffness, sideways);
        const V3 a = along * n;
        hn::StoreU(pull, Tag(), cloth.pull[s] + i);
        hn::StoreU(hn::Add(hn::Mul(a.x, n.x), sideways), Tag(), blocks[0] + i);
        hn::StoreU(hn::Mul(a.x, n.y), Tag(), blocks[1] + i);
        hn::StoreU(hn::Mul(a.x, n.z), Tag(), blocks[2] + i);
        hn::StoreU(hn::Add(hn::Mul(a.y, n.y), sideways), Tag(), blocks[3] + i);
        hn::StoreU(hn::Mul(a.y, n.z), Tag(), blocks[4] + i);
        hn::StoreU(hn::Add(hn::Mul(a.z, n.z), sideways), Tag(), blocks[5] + i);
        return hn::Mul(force, longer);
    });
    part.strain = std::max(part.strain, hn::GetLane(hn::MaxOfLanes(Tag(), strain)));
}

void links(const GridLevel& level, const ClothArrays& cloth, float counted_stiffness, ClothPart* parts,
           GridRange range) {
    static_assert(fine_steps == 6);
    each_dot(range, [&](GridRange cells) {
        ClothPart& part = parts[cells.first / dot_cells];
        part.strain = 0.0f;
        part.potential = sum_of(cells, [&](std::ptrdiff_t i) {
            const V3 lag = load(cloth.lag, i);
            const V square =
                hn::Add(hn::Add(hn::Mul(lag.x, lag.x), hn::Mul(lag.y, lag.y)), hn::Mul(lag.z, lag.z));
            return hn::Mul(load(cloth.mass + i), square);
        });
        links_of<0>(level, cloth, counted_stiffness, part, cells);
        links_of<1>(level, cloth, counted_stiffness, part, cells);
        links_of<2>(level, cloth, counted_stiffness, part, cells);
        links_of<3>(level, cloth, counted_stiffness, part, cells);
        links_of<4>(level, cloth, counted_stiffness, part, cells);
        links_of<5>(level, cloth, counted_stiffness, part, cells);
    });
}

void cells(const GridLevel& level, const ClothArrays& cloth, GridRange range) {
    std::ptrdiff_t step[fine_steps];
    for (std::size_t s = 0; s < fine_steps; ++s) step[s] = level.step(s);
    each_register(range, [&](std::ptrdiff_t i) {
        const V3 at = load(cloth.position, i);
        V3 right = load(cloth.mass + i) * load(cloth.lag, i);
        for (std::size_t s = 0; s < fine_steps; ++s) {
            const float* pull = cloth.pull[s] + i;
            right = right + load(pull) * (load(cloth.position, i + step[s]) - at);
            right = right - load(pull - step[s]) * (at - load(cloth.position, i - step[s]));
        }
        store(right, level.right, i);
    });
    for (std::size_t k = 0; k < 6; ++k) {
        const bool diagonal = k == 0 || k == 3 || k == 5;
        each_register(range, [&](std::ptrdiff_t i) {
            V sum = diagonal ? load(cloth.mass + i) : hn::Zero(Tag());
            for (std::size_t s = 0; s < fine_steps; ++s) {
                const float* block = level.links[s][k] + i;
                sum = hn::Add(sum, hn::Add(load(block), load(block - step[s])));
            }
            hn::StoreU(sum, Tag(), level.diagonal[k] + i);
        });
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::rope::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::rope::detail {
namespace {

HWY_EXPORT(links);
HWY_EXPORT(cells);

}  // namespace

ClothUnit cloth_unit(std::string_view name) noexcept {
    const std::int64_t target = tendril::detail::target_named(name);
    if (target == 0) return {};
    return {TENDRIL_COMPILED_FOR(links, target), TENDRIL_COMPILED_FOR(cells, target)};
}

}  // namespace tendril::rope::detail
#endif
