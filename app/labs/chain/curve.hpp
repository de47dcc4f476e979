// Mode Curve: the chain lies along a curve through control points (tendril/ik/curve.hpp). The last control
// point is the mode's target: what moves the target moves it.
//
// The chain as it was given, its bone lengths and its pose, is kept beside: every placement starts from it,
// so that equal settings place it equally however often it was placed before. It is what edits edit, and what
// a scene file has; the placed chain follows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

#include "app/document/json_place.hpp"
#include "app/labs/kit/curve.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

struct ChainPart;

inline constexpr std::size_t max_control_points = 4096;

/// With none of its points, or at least two.
struct CurveSettings : CurveShape {
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

/// Removes the selected control points. Throws Refused if fewer than two would be left.
void remove_selected_points(ChainPart& part);

/// Why the joint went on to another crossing.
std::string jump_cause(const ChainPart& before, const ChainPart& after);

Json save_curve(const CurveSettings& settings);
CurveSettings load_curve(const JsonPlace& place);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::CurveSettings>();
