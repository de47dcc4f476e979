// Places a chain along a curve ("spline IK"): spines, tails, tentacles.
//
// The curve runs from the first control point to the last and continues straight beyond it. Joint 0 lies on
// the first control point; joint i + 1 is the first point of the curve after joint i at bone i's length from
// it. The distance to a joint is a polynomial of degree six on each piece of the curve; its first root is
// isolated by the sign changes of its Bernstein coefficients (Descartes' rule; J. Lane, R. Riesenfeld,
// "Bounds on a polynomial", 1981), so that no crossing is overlooked, however tight the loop.
//
// Rotations follow the curve's rotation-minimising frames, by double reflection (W. Wang, B. Juettler,
// D. Zheng, Y. Liu, "Computation of rotation minimizing frames", 2008): a loop causes no roll, and a curve
// that moves a little rolls a little.
//
// Cost: O(bones + control points); 30 bones along 8 points take about 9 µs. Does not allocate or throw; same
// input, same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tendril/fields.hpp"
#include "tendril/ik/report.hpp"
#include "tendril/ik/state.hpp"
#include "tendril/vec3.hpp"

namespace tendril::ik {

enum class CurveKind : std::uint8_t {
    Hermite,  ///< through all control points; tangents: half the vector from the previous point to the next
    BSpline   ///< uniform cubic from the first control point to the last; smoother, but only passes near the
              ///< others
};
/// "hermite", "b_spline"
const char* name(CurveKind kind) noexcept;

struct CurveOptions {
    CurveKind kind = CurveKind::Hermite;
    /// Scales all bones by one factor, so that the tip lies on the last control point. The factor stays
    /// between 1 / max_factor and max_factor, which is over 1, up to 100. Where the curve folds more tightly
    /// than a bone, the tip may jump past the end and no factor fits: the report has the remaining distance.
    /// Costs two to seven times as much.
    bool fit = false;
    float max_factor = 2.0f;
    /// The direction that the bones' upper side faces where the curve begins. If zero or parallel to the
    /// curve, a fixed perpendicular is used.
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    /// Roll about the first and the last bone, radians, right-handed, at most 1e6; between them in proportion
    /// to length.
    float roll_start = 0.0f, roll_end = 0.0f;
    /// Blend from the given pose to the curve, 0 to 1, for each bone's rotation and the root's position.
    /// `weights` multiplies it per bone, 0 to 1; empty: all 1.
    float weight = 1.0f;
    std::span<const float> weights{};
    bool operator==(const CurveOptions& other) const noexcept;  ///< compares the weights, not the span
};

/// The joints' positions along the curve after the last call. Keep it with the joints; only needed to report
/// jumps.
struct CurveMemory {
    std::size_t points = 0;    ///< control points; 0: no memory
    std::vector<double> at{};  ///< one per joint: piece of the curve plus the fraction along it

    CurveMemory() = default;
    explicit CurveMemory(std::size_t bones) : at(bones + 1) {}
    bool operator==(const CurveMemory&) const = default;
};

struct CurveReport {
    /// Converged: the whole chain is on the curve. Stretched: its tip is beyond the end. InvalidInput:
    /// nothing was changed.
    Status status = Status::Converged;
    std::size_t bones_past_end = 0;  ///< bones whose far joint is beyond the last control point
    float past_end = 0.0f;           ///< metres from the last control point to the tip, if it is beyond
    float short_of_end = 0.0f;       ///< metres from the tip to the last control point, if it is before
    float factor = 1.0f;             ///< scale of the bones
    /// The first joint that jumped to another crossing since the last call. It has not jumped if the curve
    /// between its old and new positions only moves away from the previous joint: no other crossing lies
    /// between. The distance does not matter, so a fast drag hides no jump, and a joint swept along by a flat
    /// curve has not jumped.
    std::optional<std::size_t> jumped{};
    /// All control points coincide, so the curve has no direction; the chain lies along its first rest
    /// direction.
    bool collapsed = false;
    Result accepted{};  ///< why the status is InvalidInput
    bool operator==(const CurveReport&) const = default;
};

/// The chain to place along the curve.
struct CurveChain {
    std::span<const float> lengths{};              ///< metres, 0 to max_magnitude; at least one
    std::span<const glm::vec3> rest_directions{};  ///< unit, one per bone; empty: all along +X
};

/// `points`: control points, metres, 2 to 4096. `joints` (lengths.size() + 1) and `state` receive the new
/// pose; with a weight under 1 they also give the start pose. `memory` needs as many joints, or none, which
/// disables the report of jumps.
///
/// At rest the upper side starts at `up` and follows the rest directions by minimal rotations. The bones'
/// rotations take it to the side along the curve, so the twist of the rest pose stays.
CurveReport place_along(std::span<const glm::vec3> points, const CurveChain& chain,
                        std::span<glm::vec3> joints, State& state, CurveMemory& memory,
                        const CurveOptions& options = {}) noexcept;

/// A point of the curve as drawn: `at` counts pieces, 0 to points.size() - 1. The origin if under two points.
glm::vec3 curve_point(std::span<const glm::vec3> points, CurveKind kind, float at) noexcept;

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::CurveOptions>() noexcept;
