// Mode Curve: the chain lies along a curve through control points (tendril/ik/curve.hpp). The last control
// point is the mode's target: moving the target moves it.
//
// The given chain, with its own bone lengths and pose, is stored separately. Every placement starts from it,
// so equal settings place it equally however often it was placed before. Edits and scene files use it; the
// placed chain follows.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tendril/chain/chain.hpp>

#include "app/document/json_place.hpp"
#include "app/labs/kit/curve.hpp"
#include "app/labs/kit/selection.hpp"

namespace tendril::app {

struct ChainPart;

inline constexpr std::size_t max_control_points = 4096;

/// Has no control points, or at least two.
struct CurveSettings : CurveShape {
    bool operator==(const CurveSettings&) const = default;
};

/// State that only mode Curve keeps; blank in other modes.
struct AlongCurve {
    Chain given;
    Selection selection;  ///< selected control points
    ik::CurveMemory memory;
    std::optional<ik::CurveReport> report;  ///< report of the last placement; none for fewer than two joints

    bool operator==(const AlongCurve&) const = default;
};

/// The chain that is edited and saved: the given one in mode Curve.
const Chain& own_chain(const ChainPart& part);
/// Places the given chain along the curve; without control points, first draws the curve through the chain.
/// Throws std::invalid_argument if the library refuses.
void follow_curve(ChainPart& part);
/// Call after an edit that changed the given chain in place of the placed one: places it again if needed and,
/// in other modes, clears AlongCurve.
void keep_on_curve(ChainPart& part, const ChainPart& before);

/// Removes the selected control points. Throws Refused if fewer than two would be left.
void remove_selected_points(ChainPart& part);

/// Why the joint jumped to another crossing.
std::string jump_cause(const ChainPart& before, const ChainPart& after);

Json save_curve(const CurveSettings& settings);
CurveSettings load_curve(const JsonPlace& place);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::CurveSettings>();
