// Wind on cloth. The air pushes each triangle of a cloth: mostly along its normal, as on a flat plate at an
// angle, and a little along its surface. A wave that runs down a flag slower than the wind is then driven by
// it, so that a flag flutters; gusts start the waves.
//
// The air's force is a drag on the motion relative to it, applied implicitly: in a substep a triangle covers
// a part of the difference, never more. Added up over the triangles of a cloth without pins, this cannot
// raise its kinetic energy as seen by the air, in however strong a wind. The ledger counts the work of the
// wind (energy.cpp).
#include <array>
#include <cmath>
#include <cstdint>

#include "rope/build.hpp"
#include "rope/geometry.hpp"
#include "rope/substep.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

constexpr double air_density = 1.2;  // kg/m^3
/// Coefficients of the force on a plate, of dynamic pressure times area, along its normal and along itself.
constexpr double across_plate = 2.0, along_plate = 0.1;
constexpr double eddy = 1.0;                              // metres: the distance over which gusts differ
constexpr std::uint64_t period = std::uint64_t{1} << 20;  // eddies after which the gusts repeat

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
    constexpr auto lap = static_cast<double>(period);
    std::uint64_t cell[3];
    double part[3];
    for (int c = 0; c < 3; ++c) {
        const double whole = std::floor(at[c]), from = at[c] - whole;
        cell[c] = static_cast<std::uint64_t>(whole - lap * std::floor(whole / lap));
        part[c] = from * from * (3.0 - 2.0 * from);
    }
    dvec3 sum(0.0);
    for (unsigned k = 0; k < 8; ++k) {
        const unsigned x = k & 1, y = k >> 1 & 1, z = k >> 2;
        const double weight = (x != 0 ? part[0] : 1.0 - part[0]) * (y != 0 ? part[1] : 1.0 - part[1]) *
                              (z != 0 ? part[2] : 1.0 - part[2]);
        sum += weight * corner_gust((cell[0] + x) % period, (cell[1] + y) % period, (cell[2] + z) % period);
    }
    return sum;
}

}  // namespace

double detail::wind_pressure(const Settings& settings) noexcept {
    const dvec3 wind = (1.0 + static_cast<double>(settings.gusts)) * dvec3(settings.wind);
    return 0.5 * across_plate * air_density * dot(wind, wind);
}

// The drift is bounded, so that it keeps its precision.
void detail::drift_gusts(State& state) noexcept {
    constexpr double lap = static_cast<double>(period) * eddy;
    state.drift += state.settings.substep * dvec3(state.settings.wind);
    for (int c = 0; c < 3; ++c) state.drift[c] = std::fmod(state.drift[c], lap);
}

/// Adds what the wind moves cloth by to `base`.
void Substep::blow() {
    const dvec3 wind(state_.settings.wind);
    const Air air{.by = h_ * wind,
                  .gusts = h_ * static_cast<double>(state_.settings.gusts) * detail::length(wind)};
    for (const std::uint32_t b : Plan::part(plan_.bodies, island_.bodies)) {
        const Body& body = state_.bodies[b];
        if (body.kind != Body::Kind::Cloth) continue;
        const std::size_t end = body.first + body.count;
        for (std::size_t i = body.first; i < end; ++i) scratch_.blown[i] = dvec3(0.0);
        for (std::size_t i = body.first; i + body.row + 1 < end; ++i) {
            if (plan_.whole[i] == 0) continue;
            const std::size_t below = i + body.row;
            blow_on({i, i + 1, below}, air);
            blow_on({i + 1, below + 1, below}, air);
        }
        for (std::size_t i = body.first; i < end; ++i)
            if (scratch_.weight[i] != 0.0) scratch_.base[i] += scratch_.blown[i];
    }
}

/// A particle shares its mass and motion among its triangles.
void Substep::blow_on(const std::array<std::size_t, 3>& corners, const Air& air) {
    double mass = 0.0;
    dvec3 momentum(0.0), middle(0.0);
    for (const std::size_t i : corners) {
        const double share = state_.mass[i] / plan_.triangles[i];
        mass += share;
        momentum += share * (scratch_.base[i] - state_.position[i]);
        middle += (1.0 / 3.0) * state_.position[i];
    }
    const dvec3& a = state_.position[corners[0]];
    const dvec3 normal = detail::cross(state_.position[corners[1]] - a, state_.position[corners[2]] - a);
    const double twice = detail::length(normal);
    if (!(twice > 1e-30)) return;
    dvec3 past = air.by - (1.0 / mass) * momentum;  // how far the air moves past the triangle
    if (air.gusts > 0.0) past += air.gusts * smooth_gust((1.0 / eddy) * (middle - state_.drift));
    const double grip = 0.25 * air_density * twice * detail::length(past) / mass;
    const auto reached = [grip](double coefficient) {
        const double rate = coefficient * grip;
        return rate < 1e12 ? rate / (1.0 + rate) : 1.0;
    };
    const dvec3 facing = detail::dot(past, normal) / (twice * twice) * normal;
    const dvec3 by = reached(across_plate) * facing + reached(along_plate) * (past - facing);
    for (const std::size_t i : corners) scratch_.blown[i] += (1.0 / plan_.triangles[i]) * by;
}

}  // namespace tendril::rope
