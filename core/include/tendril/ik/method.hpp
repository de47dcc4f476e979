// The methods that solve a chain, and which of them honours which option.
//
// An option that a method does not honour changes nothing: neither pose nor report. `without` and `within`
// say without and within joint limits. This is the table of honours(), which a test walks:
//
//     option           fabrik       plain     ccd       transpose dls, svd  two_bone
//     tolerance        both         both      both      both      both      both (1)
//     max_iterations   both         both      both      both      both      within
//     every_iteration  both         both      both      both      both      within
//     limits           yes          yes       yes       yes       yes       yes (2)
//     pole             both         both      both      both      both      both
//     pole_turn        without (3)  without   without   without   without   never (3)
//     snap_back        both         both      both      both      both      within
//     tip_orientation  both         both      both      both      both      both (4)
//     soft_zone        both         both      both      both      both      both
//     damping          never        never     never     never     both      within (2)
//     stretch          never        never     never     never     never     without (5)
//     twist            never        never     never     never     never     both (4)
//     weight           both         both      both      both      both      both
//     restarts         within       never     never     never     never     never
//     rotations        without (6)  without   without   without   without   without
//     residuals        both         both      both      both      both      both
//
// `plain` is fabrik_plain, `stretch` start_stretch_ratio and max_stretch_scale.
// (1) Two bones are worked out as exactly as floats allow; the tolerance only decides the status.
// (2) Within limits a two-bone solve starts from its closed form and goes on as damped least squares.
// (3) Within limits the whole chain turns to its pole at once, whatever pole_turn says: the joints could not
//     turn one by one. A chain of two bones has one joint to turn, so both ways are the same.
// (4) With a tip orientation the last bone is placed as it asks, so a two-bone solve takes three bones, or two
//     of which one is left to solve for; within limits it is damped least squares from the start, without
//     twist.
// (5) Not when a tendril::Chain is solved, which keeps its lengths.
// (6) Within limits the rotations are always kept up: limits are about them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tendril/result.hpp"

namespace tendril::ik {

enum class Method : std::uint8_t {
    Fabrik,             ///< FABRIK with a step that takes the bend out near full reach: the default
    FabrikPlain,        ///< as Aristidou and Lasenby published it in 2011, for study; stalls on a line
    Ccd,                ///< cyclic coordinate descent (Wang and Chen 1991)
    JacobianTranspose,  ///< with the step that is best along the gradient (Buss 2004)
    Dls,                ///< damped least squares (Wampler 1986, Nakamura and Hanafusa 1986)
    SvdDls,             ///< the same, damped singular value by singular value (Maciejewski and Klein 1988)
    TwoBone             ///< law of cosines; two bones only
};
inline constexpr std::array all_methods{
    Method::Fabrik, Method::FabrikPlain, Method::Ccd,    Method::JacobianTranspose,
    Method::Dls,    Method::SvdDls,      Method::TwoBone};
/// "fabrik_plain": as commands and files name it.
const char* name(Method method) noexcept;
/// None for an unknown name.
std::optional<Method> method_named(std::string_view name) noexcept;

/// Whether a method takes a chain of so many bones: "Two-bone needs exactly two bones, this chain has 5".
/// (With a tip orientation it takes three as well.)
Result check_takes(Method method, std::size_t bones) noexcept;

/// The members of Options, as the table above has them.
enum class Option : std::uint8_t {
    Tolerance,
    MaxIterations,
    EveryIteration,
    Limits,
    Pole,
    PoleTurn,
    SnapBack,
    TipOrientation,
    SoftZone,
    Damping,
    Stretch,  ///< start_stretch_ratio and max_stretch_scale
    Twist,
    Weight,
    Restarts,
    Rotations,
    Residuals
};
inline constexpr std::array all_options{
    Option::Tolerance, Option::MaxIterations, Option::EveryIteration, Option::Limits,
    Option::Pole,      Option::PoleTurn,      Option::SnapBack,       Option::TipOrientation,
    Option::SoftZone,  Option::Damping,       Option::Stretch,        Option::Twist,
    Option::Weight,    Option::Restarts,      Option::Rotations,      Option::Residuals};
/// "snap_back": the member's name; "start_stretch_ratio" for Stretch.
const char* name(Option option) noexcept;

/// The table. `within_limits`: whether joint limits are set beside it.
bool honours(Method method, Option option, bool within_limits) noexcept;

}  // namespace tendril::ik
