// The methods that solve a chain, and which options each of them honours.
//
// An option that a method does not honour changes neither pose nor report. The option's row in
// fields<Options>() says which methods honour it, without and within joint limits (Field::without_limits and
// within_limits, given by Field::by()). honours() reads the rows, and a test verifies them. Some options have
// a special meaning:
//
//   tolerance        Two bones are solved as exactly as floats allow; it only decides the status.
//   limits, damping  Within limits, a two-bone solve starts from its closed form and continues with damped
//                    least squares.
//   pole_turn        Within limits, the whole chain always turns to its pole at once: turning joints one by
//                    one would bend all of them. A chain of two bones has one joint to turn, so both modes
//                    are the same.
//   tip_orientation  It fixes the last bone, so a two-bone solve takes three bones, or two of which one is
//                    left to solve. Within limits it is damped least squares from the start, without twist.
//   start_stretch_ratio, max_stretch_scale
//                    Not if a tendril::Chain is solved, which keeps its lengths.
//   rotations        Within limits they are always kept up to date, because limits are defined on them.
//   plane            A chain in a plane has its own limits (Plane::limits). It is solved as within limits,
//                    but its rotations are updated only as without, and pole_turn and twist have no effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tendril/fields.hpp"
#include "tendril/result.hpp"

namespace tendril::ik {

enum class Method : std::uint8_t {
    Fabrik,             ///< the default: FABRIK plus a step that removes the bend near full reach
    FabrikPlain,        ///< as published by Aristidou and Lasenby in 2011, for study; stalls when collinear
    Ccd,                ///< cyclic coordinate descent (Wang and Chen 1991)
    JacobianTranspose,  ///< with the optimal step along the gradient (Buss 2004)
    Dls,                ///< damped least squares (Wampler 1986, Nakamura and Hanafusa 1986)
    SvdDls,             ///< the same, damped singular value by singular value (Maciejewski and Klein 1988)
    TwoBone             ///< law of cosines; two bones only
};
inline constexpr std::array all_methods{
    Method::Fabrik, Method::FabrikPlain, Method::Ccd,    Method::JacobianTranspose,
    Method::Dls,    Method::SvdDls,      Method::TwoBone};
/// "fabrik_plain": the name in commands and files.
const char* name(Method method) noexcept;
/// None for an unknown name.
std::optional<Method> method_named(std::string_view name) noexcept;

/// Refuses a number of bones that the method cannot take: "Two-bone needs exactly two bones". (With a tip
/// orientation Solver::solve also takes three.)
Result check_takes(Method method, std::size_t bones) noexcept;

/// True if the method honours the option, a row of fields<Options>(): honours(Method::Ccd,
/// field_of<&Options::damping>(), limited). `within_limits`: joint limits are set as well.
bool honours(Method method, const Field& option, bool within_limits) noexcept;

}  // namespace tendril::ik
