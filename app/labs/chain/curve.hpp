// Mode Curve: the chain lies along a curve through control points (tendril/ik/curve.hpp). The last control
// point is the mode's target: what moves the target moves it.
//
// The chain as it was given, its bone lengths and its pose, is kept beside: every placement starts from it,
// so that equal settings place it equally however often it was placed before. It is what edits edit, and what
// a scene file has; the placed chain follows.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/curve.hpp>
#include <vector>

#include "app/document/json_place.hpp"
#include "app/document/names.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

struct ChainPart;

inline constexpr std::size_t max_control_points = 4096;

inline constexpr EnumNames<ik::CurveKind, 2> curve_kinds{
    "kind of curve",
    {{"hermite", "Through points", "Passes through every control point."},
     {"b_spline", "B-spline", "Smoother; passes through the first and the last, and near the others."}}};

struct CurveSettings {
    std::vector<glm::vec3> points;  ///< metres; none, or at least two
    ik::CurveKind kind = ik::CurveKind::Hermite;
    bool fit = false;
    float max_factor = 2.0f;  ///< of fit
    float weight = 1.0f;      ///< 0: the given pose, 1: the curve
    /// -1 to 1: by how much less the first bones follow the curve than the last; negative: the last bones.
    float falloff = 0.0f;
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float roll_start_deg = 0.0f, roll_end_deg = 0.0f;

    bool operator==(const CurveSettings&) const = default;
};

/// What mode Curve keeps; blank in other modes.
struct AlongCurve {
    Chain given;
    Selection selection;  ///< of control points
    ik::CurveMemory memory;
    std::optional<ik::CurveReport> report;  ///< of the last placement; none for fewer than two joints

    bool operator==(const AlongCurve&) const = default;
};

/// The chain that is edited and saved: in mode Curve the given one.
const Chain& own_chain(const ChainPart& part);
/// Places the given chain along the curve, which is drawn through it if it has no control points yet. Throws
/// std::invalid_argument if the library refuses.
void follow_curve(ChainPart& part);
/// After an edit that began with the given chain in place of the chain: places it again if need be, and
/// forgets what only mode Curve keeps in another mode.
void keep_on_curve(ChainPart& part, const ChainPart& before);
/// How far each bone turns to the curve, times the weight; empty: all the way.
std::vector<float> curve_weights(const CurveSettings& settings, std::size_t bones);
ik::CurveOptions curve_options(const CurveSettings& settings, std::span<const float> weights);

/// A control point more, at place `at` of ik::curve_point(): the shape stays nearly as it
/// is.
std::vector<glm::vec3> with_point_at(const CurveSettings& settings, float at);
/// Removes the selected control points. Throws Refused if fewer than two would be left.
void remove_selected_points(ChainPart& part);

/// Why the joint went on to another crossing.
std::string jump_cause(const ChainPart& before, const ChainPart& after);

Json save_curve(const CurveSettings& settings);
CurveSettings load_curve(const JsonPlace& place);
Json points_json(const std::vector<glm::vec3>& points);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::CurveSettings>();
