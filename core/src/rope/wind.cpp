// Wind, and the drag of air at rest (J. Wejchert, D. Haumann, "Animation Aerodynamics", SIGGRAPH 1991). The
// air pushes each triangle of a cloth mostly along its normal, as it does a flat plate at an angle, so it
// lifts too, and a little along its surface. Waves that run down a flag slower than the wind are then driven
// by it: the flag flutters. Gusts start the waves. A segment of a rope or hair is a cylinder.
//
// Drag acts on the motion relative to the air and is implicit: in a substep a face takes on part of the
// difference, at most all of it. Summed over a body without pins it cannot raise the kinetic energy relative
// to the air. The ledger counts the work of the wind (energy.cpp).
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr double air_density = 1.2;  // kg/m^3
/// Force on a plate over dynamic pressure times area, along its normal and along its surface.
constexpr double across_plate = 2.0, along_plate = 0.1;
/// The same for a cylinder; its area is thickness times length.
constexpr double across_thread = 1.2, along_thread = 0.03;
constexpr double eddy_size = 1.0;                              // metres: the distance over which gusts differ
constexpr std::uint64_t gust_period = std::uint64_t{1} << 20;  // eddies after which the gusts repeat

/// Part of a velocity difference that implicit drag removes in a substep, for `rate` per substep.
double implicit_part(double rate) {
    return rate < 1e12 ? rate / (1.0 + rate) : 1.0;
}

/// A random number from -1 to 1 in each coordinate: the gust at a corner of the lattice of eddies.
dvec3 corner_gust(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    // The finaliser of MurmurHash3 (A. Appleby, public domain).
    std::uint64_t bits = (x << 42) ^ (y << 21) ^ z ^ 0x9e3779b97f4a7c15ULL;
    bits = (bits ^ (bits >> 33)) * 0xff51afd7ed558ccdULL;
    bits = (bits ^ (bits >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    bits ^= bits >> 33;
    constexpr std::uint64_t mask = (1u << 21) - 1;
    constexpr double scale = 2.0 / static_cast<double>(mask);
    const auto number = [&](int shift) { return static_cast<double>((bits >> shift) & mask) * scale - 1.0; };
    return {number(0), number(21), number(42)};
}

/// Smooth noise from -1 to 1 in each coordinate, with one value per unit of length.
dvec3 smooth_gust(const dvec3& at) {
    constexpr auto period = static_cast<double>(gust_period);
    std::uint64_t cell[3];
    double part[3];
    for (int c = 0; c < 3; ++c) {
        const double whole = std::floor(at[c]), from = at[c] - whole;
        cell[c] = static_cast<std::uint64_t>(whole - period * std::floor(whole / period));
        part[c] = from * from * (3.0 - 2.0 * from);
    }
    dvec3 sum(0.0);
    for (unsigned k = 0; k < 8; ++k) {
        const unsigned x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const double weight = (x != 0 ? part[0] : 1.0 - part[0]) * (y != 0 ? part[1] : 1.0 - part[1]) *
                              (z != 0 ? part[2] : 1.0 - part[2]);
        sum += weight * corner_gust((cell[0] + x) % gust_period, (cell[1] + y) % gust_period,
                                    (cell[2] + z) % gust_period);
    }
    return sum;
}

}  // namespace

double detail::wind_pressure(const Settings& settings) noexcept {
    const dvec3 wind = (1.0 + static_cast<double>(settings.gusts)) * dvec3(settings.wind);
    return 0.5 * across_plate * air_density * dot(wind, wind);
}

// The drift is bounded, so that it keeps its precision.
void detail::advect_gusts(State& state) noexcept {
    constexpr double period = static_cast<double>(gust_period) * eddy_size;
    state.drift += state.settings.substep * dvec3(state.settings.wind);
    for (int c = 0; c < 3; ++c) state.drift[c] = std::fmod(state.drift[c], period);
}

/// Adds the air's displacement of bodies to `base`.
void Substep::apply_wind() {
    const dvec3 wind(state_.settings.wind);
    const Air air{.by = h_ * wind,
                  .gusts = h_ * static_cast<double>(state_.settings.gusts) * detail::length(wind)};
    for (const std::uint32_t b : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[b];
        const std::size_t end = body.first + body.count;
        for (std::size_t i = body.first; i < end; ++i) scratch_.wind_move[i] = dvec3(0.0);
        if (body.kind == Body::Kind::Cloth)
            wind_on_cloth(body, air);
        else
            wind_on_strands(body, air);
        for (std::size_t i = body.first; i < end; ++i)
            if (scratch_.weight[i] != 0.0) scratch_.base[i] += scratch_.wind_move[i];
    }
}

void Substep::wind_on_cloth(const Body& body, const Air& air) {
    for (std::size_t i = body.first; i < body.first + body.count; ++i) {
        const std::size_t below = plan_.below[i];
        if (below == 0) continue;
        wind_on_triangle({i, i + 1, below}, air);
        wind_on_triangle({i + 1, below + 1, below}, air);
    }
}

void Substep::wind_on_strands(const Body& body, const Air& air) {
    for (std::size_t i = body.first; i < body.first + body.count; ++i)
        if (plan_.below[i] != 0) wind_on_segment({i, i + 1}, 2.0 * static_cast<double>(body.radius), air);
}

/// A particle shares its mass and motion among its faces.
Substep::Face Substep::face_of(std::span<const std::size_t> corners, const Air& air) const {
    Face face;
    dvec3 momentum(0.0), middle(0.0);
    for (const std::size_t i : corners) {
        const double share = state_.mass[i] / plan_.faces[i];
        face.mass += share;
        momentum += share * (scratch_.base[i] - state_.position[i]);
        middle += (1.0 / static_cast<double>(corners.size())) * state_.position[i];
    }
    face.flow = air.by - (1.0 / face.mass) * momentum;
    if (air.gusts > 0.0) face.flow += air.gusts * smooth_gust((1.0 / eddy_size) * (middle - state_.drift));
    return face;
}

void Substep::add_wind(std::span<const std::size_t> corners, const dvec3& by) {
    for (const std::size_t i : corners) scratch_.wind_move[i] += (1.0 / plan_.faces[i]) * by;
}

void Substep::wind_on_triangle(const std::array<std::size_t, 3>& corners, const Air& air) {
    const dvec3& a = state_.position[corners[0]];
    const dvec3 normal = detail::cross(state_.position[corners[1]] - a, state_.position[corners[2]] - a);
    const double double_area = detail::length(normal);
    if (!(double_area > 1e-30)) return;
    const Face face = face_of(corners, air);
    const double drag = 0.25 * air_density * double_area * detail::length(face.flow) / face.mass;
    const dvec3 normal_flow = detail::dot(face.flow, normal) / (double_area * double_area) * normal;
    add_wind(corners, implicit_part(across_plate * drag) * normal_flow +
                          implicit_part(along_plate * drag) * (face.flow - normal_flow));
}

/// The force across depends only on the flow across (S. Hoerner, "Fluid-Dynamic Drag", 1965).
void Substep::wind_on_segment(const std::array<std::size_t, 2>& ends, double thickness, const Air& air) {
    const dvec3 along = state_.position[ends[1]] - state_.position[ends[0]];
    const double square = detail::dot(along, along);
    if (!(square > 1e-30)) return;
    const Face face = face_of(ends, air);
    const dvec3 normal_flow = face.flow - detail::dot(face.flow, along) / square * along;
    const double drag = 0.5 * air_density * thickness * std::sqrt(square) / face.mass;
    add_wind(ends,
             implicit_part(across_thread * drag * detail::length(normal_flow)) * normal_flow +
                 implicit_part(along_thread * drag * detail::length(face.flow)) * (face.flow - normal_flow));
}

}  // namespace tendril::rope
