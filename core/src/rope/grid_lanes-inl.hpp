// Vectors and blocks of grid cells, a register at a time. Not installed; included once per vector unit.
#if defined(TENDRIL_ROPE_GRID_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TENDRIL_ROPE_GRID_LANES_INL
#undef TENDRIL_ROPE_GRID_LANES_INL
#else
#define TENDRIL_ROPE_GRID_LANES_INL
#endif

#include <hwy/highway.h>

#include "rope/grid_system.hpp"

HWY_BEFORE_NAMESPACE();
namespace tendril::rope::detail {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, grid_lanes>;
using V = hn::Vec<Tag>;

struct V3 {
    V x, y, z;
};
/// xx, xy, xz, yy, yz, zz
struct Block {
    V xx, xy, xz, yy, yz, zz;
};

inline V load(const float* from) {
    return hn::LoadU(Tag(), from);
}
inline V3 load(const GridVector& from, std::ptrdiff_t i) {
    return {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
}
inline Block load(const GridBlocks& from, std::ptrdiff_t i) {
    return {load(from[0] + i), load(from[1] + i), load(from[2] + i),
            load(from[3] + i), load(from[4] + i), load(from[5] + i)};
}
inline void store(const V3& value, const GridVector& to, std::ptrdiff_t i) {
    hn::StoreU(value.x, Tag(), to[0] + i);
    hn::StoreU(value.y, Tag(), to[1] + i);
    hn::StoreU(value.z, Tag(), to[2] + i);
}
inline V3 operator*(const Block& m, const V3& v) {
    return {hn::Add(hn::Add(hn::Mul(m.xx, v.x), hn::Mul(m.xy, v.y)), hn::Mul(m.xz, v.z)),
            hn::Add(hn::Add(hn::Mul(m.xy, v.x), hn::Mul(m.yy, v.y)), hn::Mul(m.yz, v.z)),
            hn::Add(hn::Add(hn::Mul(m.xz, v.x), hn::Mul(m.yz, v.y)), hn::Mul(m.zz, v.z))};
}
inline V3 operator+(const V3& a, const V3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
inline V3 operator-(const V3& a, const V3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
inline V3 operator*(V s, const V3& v) {
    return {hn::Mul(s, v.x), hn::Mul(s, v.y), hn::Mul(s, v.z)};
}

/// The sum of `value(i)` over the cells, in single precision and an order that does not depend on the unit.
template <class Value>
double sum_of(GridRange cells, Value value) {
    alignas(64) float lanes[grid_lanes];
    for (std::size_t k = 0; k < grid_lanes; k += hn::Lanes(Tag())) {
        V sum = hn::Zero(Tag());
        for (std::size_t i = cells.first + k; i < cells.end; i += grid_lanes)
            sum = hn::Add(sum, value(static_cast<std::ptrdiff_t>(i)));
        hn::StoreU(sum, Tag(), lanes + k);
    }
    double all = 0.0;
    for (const float lane : lanes) all += static_cast<double>(lane);
    return all;
}
/// Calls `visit` with ranges of dot_cells; `cells` begins at a multiple of it.
template <class Visit>
void each_dot(GridRange cells, Visit visit) {
    for (std::size_t first = cells.first; first < cells.end; first += dot_cells)
        visit(GridRange{first, first + dot_cells < cells.end ? first + dot_cells : cells.end});
}

template <class Visit>
void each_register(GridRange cells, Visit visit) {
    for (std::size_t i = cells.first; i < cells.end; i += hn::Lanes(Tag()))
        visit(static_cast<std::ptrdiff_t>(i));
}

}  // namespace HWY_NAMESPACE
}  // namespace tendril::rope::detail
HWY_AFTER_NAMESPACE();

#endif
