// The grid operations for each vector unit.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "rope/grid_system.hpp"

#define HWY_TARGET_INCLUDE "rope/grid_vector.cpp"
#include "math/each_target-inl.hpp"

#include "rope/grid_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {
/// L d L^T of each block: 1 / d in xx, yy and zz, L in the others.
void factorize(const GridLevel& level, float floor, GridRange cells) {
    const V least = hn::Set(Tag(), floor), one = hn::Set(Tag(), 1.0f);
    each_register(cells, [&](std::ptrdiff_t i) {
        const Block m = load(level.diagonal, i);
        const V x = hn::Div(one, hn::Max(m.xx, least));
        const V xy = hn::Mul(m.xy, x), xz = hn::Mul(m.xz, x);
        const V y = hn::Div(one, hn::Max(hn::Sub(m.yy, hn::Mul(xy, m.xy)), least));
        const V rest = hn::Sub(m.yz, hn::Mul(xy, m.xz)), yz = hn::Mul(rest, y);
        const V last = hn::Sub(hn::Sub(m.zz, hn::Mul(xz, m.xz)), hn::Mul(yz, rest));
        const V z = hn::Div(one, hn::Max(last, least));
        const V values[] = {x, xy, xz, y, yz, z};
        for (std::size_t k = 0; k < 6; ++k) hn::StoreU(values[k], Tag(), level.factor[k] + i);
    });
}

V3 solve(const Block& factor, const V3& right) {
    const V y = hn::Sub(right.y, hn::Mul(factor.xy, right.x));
    const V z = hn::Sub(hn::Sub(right.z, hn::Mul(factor.xz, right.x)), hn::Mul(factor.yz, y));
    const V to_z = hn::Mul(factor.zz, z);
    const V to_y = hn::Sub(hn::Mul(factor.yy, y), hn::Mul(factor.yz, to_z));
    const V to_x =
        hn::Sub(hn::Sub(hn::Mul(factor.xx, right.x), hn::Mul(factor.xy, to_y)), hn::Mul(factor.xz, to_z));
    return {to_x, to_y, to_z};
}

template <std::size_t steps>
void multiply_steps(const GridLevel& level, const GridVector& x, const GridVector& product, GridRange cells) {
    std::ptrdiff_t by[steps];
    for (std::size_t s = 0; s < steps; ++s) by[s] = level.step(s);
    each_register(cells, [&](std::ptrdiff_t i) {
        V3 sum = load(level.diagonal, i) * load(x, i);
        for (std::size_t s = 0; s < steps; ++s) {
            const GridBlocks& link = level.links[s];
            sum = sum - (load(link, i) * load(x, i + by[s]) + load(link, i - by[s]) * load(x, i - by[s]));
        }
        store(sum, product, i);
    });
}
void multiply(const GridLevel& level, const GridVector& x, const GridVector& product, GridRange cells) {
    level.steps == fine_steps ? multiply_steps<fine_steps>(level, x, product, cells)
                              : multiply_steps<coarse_steps>(level, x, product, cells);
}

void smooth_first(const GridLevel& level, GridRange cells) {
    const V part = hn::Set(Tag(), grid_damping);
    each_register(cells, [&](std::ptrdiff_t i) {
        store(part * solve(load(level.factor, i), load(level.right, i)), level.x, i);
    });
}
void smooth(const GridLevel& level, GridRange cells) {
    const V part = hn::Set(Tag(), grid_damping);
    each_register(cells, [&](std::ptrdiff_t i) {
        const V3 residual = load(level.right, i) - load(level.product, i);
        store(load(level.x, i) + part * solve(load(level.factor, i), residual), level.x, i);
    });
}

/// Interleaved numbers, separated.
struct Pairs {
    V even, odd;
};
Pairs load_pairs(const float* from) {
    Pairs pairs;
    hn::LoadInterleaved2(Tag(), from, pairs.even, pairs.odd);
    return pairs;
}
V sum(const Pairs& pairs) {
    return hn::Add(pairs.even, pairs.odd);
}

/// For rows of the coarse level: calls `visit` with the index of a register, its column, and the index of its
/// first cell on the fine level.
template <class Visit>
void each_coarse(const GridLevel& fine, const GridLevel& coarse, GridRange rows, Visit visit) {
    for (std::size_t row = rows.first; row < rows.end; ++row)
        for (std::size_t column = 0; column < coarse.stride; column += hn::Lanes(Tag()))
            visit(static_cast<std::ptrdiff_t>(row * coarse.stride + column), column,
                  static_cast<std::ptrdiff_t>(2 * row * fine.stride + 2 * column));
}

void restrict_to(const GridLevel& fine, const GridLevel& coarse, GridRange rows) {
    const auto below = static_cast<std::ptrdiff_t>(fine.stride);
    for (std::size_t c = 0; c < 3; ++c) {
        const float *right = fine.right[c], *product = fine.product[c];
        const auto residual = [&](std::ptrdiff_t i) {
            return hn::Sub(sum(load_pairs(right + i)), sum(load_pairs(product + i)));
        };
        each_coarse(fine, coarse, rows, [&](std::ptrdiff_t to, std::size_t, std::ptrdiff_t from) {
            const V all = hn::Add(residual(from), residual(from + below));
            hn::StoreU(hn::Mul(all, load(coarse.free + to)), Tag(), coarse.right[c] + to);
        });
    }
}

void prolong(const GridLevel& fine, const GridLevel& coarse, GridRange rows) {
    const auto below = static_cast<std::ptrdiff_t>(fine.stride);
    const std::size_t lanes = hn::Lanes(Tag());
    alignas(64) float twice[2 * grid_lanes];
    const auto add_to = [&](float* at, const float* free, const float* value) {
        hn::StoreU(hn::Add(load(at), hn::Mul(load(value), load(free))), Tag(), at);
    };
    for (std::size_t c = 0; c < 3; ++c)
        each_coarse(fine, coarse, rows, [&](std::ptrdiff_t from, std::size_t column, std::ptrdiff_t to) {
            const V value = load(coarse.x[c] + from);
            hn::StoreInterleaved2(value, value, Tag(), twice);
            // The fine level's rows may be shorter.
            for (std::size_t k = 0; k < 2 * lanes && 2 * column + k < fine.stride; k += lanes)
                for (const std::ptrdiff_t i : {to, to + below})
                    add_to(fine.x[c] + i + k, fine.free + i + k, twice + k);
        });
}

/// Links within a cell of the coarse level are removed from its diagonal; the others are summed.
void coarsen_blocks(const GridLevel& fine, const GridLevel& coarse, std::size_t k, GridRange rows) {
    const auto below = static_cast<std::ptrdiff_t>(fine.stride);
    const V two = hn::Set(Tag(), 2.0f);
    const float *diagonal = fine.diagonal[k], *right = fine.links[0][k], *down = fine.links[1][k],
                *falling = fine.links[2][k], *rising = fine.links[3][k];
    each_coarse(fine, coarse, rows, [&](std::ptrdiff_t to, std::size_t, std::ptrdiff_t i) {
        const std::ptrdiff_t j = i + below;
        const Pairs free_i = load_pairs(fine.free + i), free_j = load_pairs(fine.free + j);
        const Pairs own_i = load_pairs(diagonal + i), own_j = load_pairs(diagonal + j);
        const Pairs right_i = load_pairs(right + i), right_j = load_pairs(right + j);
        const Pairs down_i = load_pairs(down + i), down_j = load_pairs(down + j);
        const Pairs falling_i = load_pairs(falling + i), falling_j = load_pairs(falling + j);
        const Pairs rising_i = load_pairs(rising + i), rising_j = load_pairs(rising + j);
        const V own = hn::Add(hn::Add(hn::Mul(free_i.even, own_i.even), hn::Mul(free_i.odd, own_i.odd)),
                              hn::Add(hn::Mul(free_j.even, own_j.even), hn::Mul(free_j.odd, own_j.odd)));
        const V inner = hn::Add(hn::Add(hn::Add(right_i.even, right_j.even), sum(down_i)),
                                hn::Add(falling_i.even, rising_i.odd));
        V to_right = hn::Add(hn::Add(right_i.odd, right_j.odd), falling_i.odd);
        // A link down and to the left, from the next cell but within its row of cells: here it leads to the
        // right.
        to_right = hn::Add(to_right, load_pairs(rising + i + 2).even);
        V to_down = hn::Add(hn::Add(sum(down_j), falling_j.even), rising_j.odd);
        if (fine.steps == fine_steps) {
            const float *far_right = fine.links[4][k], *far_down = fine.links[5][k];
            to_right =
                hn::Add(to_right, hn::Add(sum(load_pairs(far_right + i)), sum(load_pairs(far_right + j))));
            to_down = hn::Add(to_down, hn::Add(sum(load_pairs(far_down + i)), sum(load_pairs(far_down + j))));
        }
        const V free = load(coarse.free + to), zero = hn::Zero(Tag());
        const V pinned = k == 0 || k == 3 || k == 5 ? hn::Sub(hn::Set(Tag(), 1.0f), free) : zero;
        const auto keep = [&](V value, float* where) { hn::StoreU(hn::Mul(free, value), Tag(), where + to); };
        hn::StoreU(hn::Add(hn::Mul(free, hn::Sub(own, hn::Mul(two, inner))), pinned), Tag(),
                   coarse.diagonal[k] + to);
        keep(to_right, coarse.links[0][k]);
        keep(to_down, coarse.links[1][k]);
        keep(falling_j.odd, coarse.links[2][k]);
        keep(rising_j.even, coarse.links[3][k]);
    });
}

void coarsen(const GridLevel& fine, const GridLevel& coarse, GridRange rows) {
    for (std::size_t row = rows.first; row < rows.end; ++row)
        for (std::size_t column = 0; column < coarse.columns; ++column) {
            const float* of = fine.free + 2 * row * fine.stride + 2 * column;
            // Beyond the last row and column nothing is free.
            coarse.free[row * coarse.stride + column] =
                std::max(std::max(of[0], of[1]), std::max(of[fine.stride], of[fine.stride + 1]));
        }
    for (std::size_t k = 0; k < 6; ++k) coarsen_blocks(fine, coarse, k, rows);
}

void dot(const GridVector& a, const GridVector& b, double* sums, GridRange cells) {
    each_dot(cells, [&](GridRange part) {
        sums[part.first / dot_cells] = sum_of(part, [&](std::ptrdiff_t i) {
            const V3 x = load(a, i), y = load(b, i);
            return hn::Add(hn::Add(hn::Mul(x.x, y.x), hn::Mul(x.y, y.y)), hn::Mul(x.z, y.z));
        });
    });
}

void add(float factor, const GridVector& from, const GridVector& to, GridRange cells) {
    const V by = hn::Set(Tag(), factor);
    each_register(cells, [&](std::ptrdiff_t i) { store(load(to, i) + by * load(from, i), to, i); });
}
void scale_and_add(float factor, const GridVector& from, const GridVector& to, GridRange cells) {
    const V by = hn::Set(Tag(), factor);
    each_register(cells, [&](std::ptrdiff_t i) { store(load(from, i) + by * load(to, i), to, i); });
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::rope::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tendril::rope::detail {
namespace {

HWY_EXPORT(factorize);
HWY_EXPORT(coarsen);
HWY_EXPORT(multiply);
HWY_EXPORT(smooth_first);
HWY_EXPORT(smooth);
HWY_EXPORT(restrict_to);
HWY_EXPORT(prolong);
HWY_EXPORT(dot);
HWY_EXPORT(add);
HWY_EXPORT(scale_and_add);

}  // namespace

GridUnit grid_unit(std::string_view name) noexcept {
    const std::int64_t target = tendril::detail::target_named(name);
    if (target == 0) return {};
    return {TENDRIL_COMPILED_FOR(factorize, target), TENDRIL_COMPILED_FOR(coarsen, target),
            TENDRIL_COMPILED_FOR(multiply, target),  TENDRIL_COMPILED_FOR(smooth_first, target),
            TENDRIL_COMPILED_FOR(smooth, target),    TENDRIL_COMPILED_FOR(restrict_to, target),
            TENDRIL_COMPILED_FOR(prolong, target),   TENDRIL_COMPILED_FOR(dot, target),
            TENDRIL_COMPILED_FOR(add, target),       TENDRIL_COMPILED_FOR(scale_and_add, target)};
}

}  // namespace tendril::rope::detail
#endif
