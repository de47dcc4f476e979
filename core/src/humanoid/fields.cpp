// The field tables of options and states in tendril/humanoid. States list their members in declaration order.
#include "tendril/fields.hpp"

#include "math/ranges.hpp"
#include "signal/spring_rows.hpp"
#include "tendril/humanoid/feet.hpp"
#include "tendril/humanoid/footsteps.hpp"
#include "tendril/humanoid/hands.hpp"
#include "tendril/humanoid/hold.hpp"
#include "tendril/humanoid/look_at.hpp"
#include "tendril/humanoid/spring_chain.hpp"
#include "tendril/magnitude.hpp"

namespace tendril {
namespace {

using namespace humanoid;

constexpr const char *sides[] = {"left", "right"}, *both_hands[] = {"left_hand", "right_hand"};
constexpr const char* alone[] = {"no", "no_hit", "too_steep", "too_far", "cannot_reach"};

constexpr FieldRange anything{-max_magnitude, max_magnitude}, positive{0.0, max_magnitude},
    thousand{0.0, 1e3}, half_lives{1e-6, 10.0}, speeds{1e-6, 1e3};

constexpr FieldRange up_to_degrees(double high) noexcept {
    return {0.0, high * 0.01745329251994329576923690768489};
}
constexpr FieldRange up_to_half_turn = up_to_degrees(180.0), under_quarter_turn = up_to_degrees(85.0);

}  // namespace

template <>
std::span<const Field> fields<FeetOptions>() noexcept {
    using Options = FeetOptions;
    static constexpr Field rows[] = {field<&Options::weight>("weight"),
                                     field<&Options::root_velocity>("root_velocity", anything, "m/s"),
                                     field<&Options::floor>("floor", anything, "m"),
                                     field<&Options::enter_speed>("enter_speed", thousand, "m/s"),
                                     field<&Options::leave_speed>("leave_speed", thousand, "m/s"),
                                     field<&Options::low>("low", thousand, "m"),
                                     field<&Options::break_distance>("break_distance", thousand, "m"),
                                     field<&Options::half_life>("half_life", half_lives, "s"),
                                     field<&Options::ray_start>("ray_start", thousand, "m"),
                                     field<&Options::max_turn>("max_turn", under_quarter_turn, "rad"),
                                     field<&Options::max_slope>("max_slope", under_quarter_turn, "rad"),
                                     field<&Options::edge>("edge", {0.0, 0.1}, "m"),
                                     field<&Options::max_step>("max_step", thousand, "m"),
                                     field<&Options::root_radius>("root_radius", thousand, "m"),
                                     field<&Options::root_half_life>("root_half_life", half_lives, "s"),
                                     field<&Options::pelvis_drop>("pelvis_drop", thousand, "m"),
                                     field<&Options::pelvis_half_life>("pelvis_half_life", half_lives, "s"),
                                     field<&Options::straightest>("straightest", {0.5, 1.0}),
                                     field<&Options::lift_half_life>("lift_half_life", half_lives, "s"),
                                     field<&Options::max_speed>("max_speed", speeds, "m/s")};
    return rows;
}

constexpr Field foot_rows[] = {field<&FootState::locked>("locked"),
                               field<&FootState::speed_known>("speed_known"),
                               field<&FootState::standing>("standing"),
                               field<&FootState::heel>("heel", anything, "m"),
                               field<&FootState::toe>("toe", anything, "m"),
                               field<&FootState::velocity>("velocity", anything, "m/s"),
                               field<&FootState::lock_x>("lock_x", anything, "m"),
                               field<&FootState::lock_z>("lock_z", anything, "m"),
                               field<&FootState::shift_x>("shift_x", anything, "m"),
                               field<&FootState::shift_z>("shift_z", anything, "m"),
                               field<&FootState::edges_known>("edges_known"),
                               field<&FootState::offset_x>("offset_x", anything, "m"),
                               field<&FootState::offset_z>("offset_z", anything, "m"),
                               field<&FootState::lift>("lift", anything, "m"),
                               field<&FootState::goal>("goal", anything, "m"),
                               nested<&FootState::ease>("ease"),
                               field<&FootState::knee>("knee", anything, "m"),
                               field<&FootState::planting>("planting", anything),
                               field<&FootState::turn>("turn", unit_length),
                               field<&FootState::alone>("alone", alone)};
template <>
std::span<const Field> fields<FootState>() noexcept {
    return foot_rows;
}

constexpr Field feet_rows[] = {field<&FeetState::started>("started"),
                               field<&FeetState::hips>("hips", anything, "m"),
                               field<&FeetState::base>("base", anything, "m"),
                               field<&FeetState::drop>("drop", anything, "m"),
                               nested<&FeetState::root>("root"),
                               nested<&FeetState::pelvis>("pelvis"),
                               list<&FeetState::feet>("feet").with_names(sides)};
template <>
std::span<const Field> fields<FeetState>() noexcept {
    return feet_rows;
}

Result humanoid::check(const FeetState& state) noexcept {
    using tendril::detail::are_in_range, signal::detail::spring_rows;
    const auto fits = [](const FootState& foot) {
        return are_in_range<foot_rows>(&foot) && are_in_range<spring_rows>(&foot.ease);
    };
    const bool fine = are_in_range<feet_rows>(&state) && are_in_range<spring_rows>(&state.root) &&
                      are_in_range<spring_rows>(&state.pelvis) && fits(state.feet[0]) && fits(state.feet[1]);
    return fine ? Result() : check_fields("feet", state);
}

template <>
std::span<const Field> fields<FootstepOptions>() noexcept {
    static constexpr Field rows[] = {field<&FootstepOptions::seconds>("seconds", {0.05, 5.0}, "s"),
                                     field<&FootstepOptions::lift>("lift")};
    return rows;
}

template <>
std::span<const Field> fields<Footstep>() noexcept {
    static constexpr Field rows[] = {field<&Footstep::from>("from", anything, "m"),
                                     field<&Footstep::to>("to", anything, "m"),
                                     field<&Footstep::part>("part")};
    return rows;
}

template <>
std::span<const Field> fields<FootstepsState>() noexcept {
    static constexpr Field rows[] = {list<&FootstepsState::feet>("feet").with_names(sides, true)};
    return rows;
}

template <>
std::span<const Field> fields<HandsOptions>() noexcept {
    static constexpr Field rows[] = {field<&HandsOptions::view>("view", up_to_half_turn, "rad"),
                                     field<&HandsOptions::half_life>("half_life", half_lives, "s"),
                                     field<&HandsOptions::shoulder>("shoulder", under_quarter_turn, "rad")};
    return rows;
}

template <>
std::span<const Field> fields<HandState>() noexcept {
    static constexpr Field rows[] = {field<&HandState::in_view>("in_view"), nested<&HandState::view>("view")};
    return rows;
}

template <>
std::span<const Field> fields<HandsState>() noexcept {
    static constexpr Field rows[] = {list<&HandsState::hands>("hands").with_names(sides, true)};
    return rows;
}

template <>
std::span<const Field> fields<LookAtOptions>() noexcept {
    using Options = LookAtOptions;
    static constexpr Field rows[] = {field<&Options::target>("target", anything, "m"),
                                     field<&Options::weight>("weight"),
                                     field<&Options::spine_part>("spine_part"),
                                     field<&Options::neck_part>("neck_part"),
                                     field<&Options::spine_limit>("spine_limit", up_to_half_turn, "rad"),
                                     field<&Options::neck_limit>("neck_limit", up_to_half_turn, "rad"),
                                     field<&Options::head_limit>("head_limit", up_to_half_turn, "rad"),
                                     field<&Options::view>("view", up_to_half_turn, "rad"),
                                     field<&Options::half_life>("half_life", half_lives, "s"),
                                     field<&Options::max_speed>("max_speed", speeds, "rad/s")};
    return rows;
}

template <>
std::span<const Field> fields<LookAtState>() noexcept {
    static constexpr Field rows[] = {field<&LookAtState::in_view>("in_view"),
                                     nested<&LookAtState::view>("view"),
                                     field<&LookAtState::gaze>("gaze", anything)};
    return rows;
}

template <>
std::span<const Field> fields<SpringOptions>() noexcept {
    using Options = SpringOptions;
    static constexpr Field rows[] = {field<&Options::strength>("strength", {0.01, 100.0}, "Hz"),
                                     field<&Options::critical_damping>("critical_damping", {0.0, 10.0}),
                                     field<&Options::weight>("weight"),
                                     field<&Options::max_angle>("max_angle", up_to_degrees(179.0), "rad"),
                                     field<&Options::hit_radius>("hit_radius", thousand, "m")};
    return rows;
}

template <>
std::span<const Field> fields<SpringMass>() noexcept {
    static constexpr Field rows[] = {field<&SpringMass::position>("position", anything, "m"),
                                     field<&SpringMass::velocity>("velocity", anything, "m/s"),
                                     field<&SpringMass::target>("target", anything, "m"),
                                     field<&SpringMass::started>("started"),
                                     field<&SpringMass::has_velocity>("has_velocity"),
                                     field<&SpringMass::held>("held")};
    return rows;
}

template <>
std::span<const Field> fields<SpringChainState>() noexcept {
    static constexpr Field rows[] = {list<&SpringChainState::masses>("masses").up_to(Skeleton::max_nodes)};
    return rows;
}

template <>
std::span<const Field> fields<BodyTarget>() noexcept {
    static constexpr Field rows[] = {field<&BodyTarget::position>("position", anything, "m"),
                                     field<&BodyTarget::rotation>("rotation", {1e-6, max_magnitude}),
                                     field<&BodyTarget::weight>("weight", thousand)};
    return rows;
}

template <>
std::span<const Field> fields<FootShift>() noexcept {
    static constexpr Field rows[] = {field<&FootShift::stand>("stand", anything, "m"),
                                     field<&FootShift::lift>("lift", anything, "m")};
    return rows;
}

template <>
std::span<const Field> fields<BodyOptions>() noexcept {
    using Options = BodyOptions;
    static constexpr Field rows[] = {field<&Options::max_iterations>("max_iterations", {1, 1000}),
                                     field<&Options::tolerance>("tolerance").over(),
                                     field<&Options::feet_stay>("feet_stay"),
                                     field<&Options::twist_share>("twist_share"),
                                     field<&Options::self_collision>("self_collision"),
                                     field<&Options::settle>("settle", {0.0, 1.0}, "m"),
                                     field<&Options::balance>("balance"),
                                     field<&Options::reserve>("reserve", {0.0, 0.9}),
                                     list<&Options::feet>("feet").with_names(sides)};
    return rows;
}

template <>
std::span<const Field> fields<BodyState>() noexcept {
    using State = BodyState;
    static constexpr Field rows[] = {list<&State::turns>("turns", unit_length).up_to(bone_count),
                                     field<&State::shift>("shift", anything, "m"),
                                     list<&State::clip>("clip", anything, "m"),
                                     field<&State::deepest>("deepest", positive, "m"),
                                     list<&State::left>("left", anything, "m"),
                                     list<&State::weights>("weights", thousand),
                                     field<&State::outside>("outside", positive, "m"),
                                     field<&State::pace>("pace", positive, "m")};
    return rows;
}

template <>
std::span<const Field> fields<HoldOptions>() noexcept {
    static constexpr Field rows[] = {nested<&HoldOptions::body>("body"),
                                     field<&HoldOptions::turn_length>("turn_length", {0.05, 1e3}, "m"),
                                     field<&HoldOptions::max_iterations>("max_iterations", {1, 1000})};
    return rows;
}

template <>
std::span<const Field> fields<HoldState>() noexcept {
    static constexpr Field rows[] = {list<&HoldState::grips>("grips", anything, "m").with_names(both_hands),
                                     list<&HoldState::shoulders>("shoulders", anything, "m"),
                                     list<&HoldState::elbows>("elbows", anything, "m"),
                                     list<&HoldState::hands>("hands", anything, "m")};
    return rows;
}

}  // namespace tendril
