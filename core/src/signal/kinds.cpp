// The table of all filters and their fields.
#include <array>

#include "tendril/signal/filter.hpp"

namespace tendril::signal {
namespace {

using enum FieldScale;

/// A number or a pair. `range`: accepted by check().
template <auto member>
constexpr Field number(const char* name, const char* unit, FieldRange range, FieldRange usual,
                       FieldScale scale = Linear) noexcept {
    Field row = field<member>(name, range, unit);
    row.usual = usual;
    row.scale = scale;
    return row;
}

constexpr FieldRange outputs{-max_output, max_output}, any{-1e9, 1e9}, amount{0.0, 1e9}, speeds{-1e6, 1e6},
    seconds{0.0, 1e4};
constexpr FieldRange strengths{0.0, max_strength}, dampings{0.0, max_damping}, cutoffs{0.0, 1e6};
constexpr FieldRange usual_values{-10.0, 10.0}, usual_speeds{0.1, 60.0}, usual_strengths{0.1, 20.0};
constexpr FieldRange usual_seconds{0.005, 2.0};

constexpr const char* pieces[] = {"constant", "linear", "cubic"};

template <class P>
Filter blank() noexcept {
    return P{};
}
template <std::size_t... index>
constexpr std::array<Kind, sizeof...(index)> all(std::index_sequence<index...>) noexcept {
    return {{{tendril::detail::FieldKinds<Filter>::list[index], kind_names[index],
              blank<std::variant_alternative_t<index, Filter>>}...}};
}
constexpr auto all_kinds = all(std::make_index_sequence<std::variant_size_v<Filter>>());

}  // namespace

const char* name(Piece piece) noexcept {
    return pieces[static_cast<std::size_t>(piece)];
}

std::span<const Kind> kinds() noexcept {
    return all_kinds;
}

const Kind* find_kind(std::string_view name) noexcept {
    for (const Kind& each : all_kinds)
        if (each.name == name) return &each;
    return nullptr;
}

const Kind& kind_of(const Filter& filter) noexcept {
    return all_kinds[filter.index()];
}

void* fields_in(Filter& filter) noexcept {
    return std::visit([](auto& each) { return static_cast<void*>(&each); }, filter);
}

const void* fields_in(const Filter& filter) noexcept {
    return std::visit([](const auto& each) { return static_cast<const void*>(&each); }, filter);
}

const char* kind(const Filter& filter) noexcept {
    return kind_of(filter).name;
}

}  // namespace tendril::signal

namespace tendril {

using namespace signal;

template <>
std::span<const Field> fields<InterpTo>() noexcept {
    static constexpr Field rows[] = {
        number<&InterpTo::speed>("speed", "1/s", speeds, usual_speeds, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<InterpToExact>() noexcept {
    static constexpr Field rows[] = {
        number<&InterpToExact::speed>("speed", "1/s", speeds, usual_speeds, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<ScaleBiasClamp>() noexcept {
    static constexpr Field rows[] = {field<&ScaleBiasClamp::map_range>("map_range"),
                                     number<&ScaleBiasClamp::in_range>("in_range", "", any, usual_values),
                                     number<&ScaleBiasClamp::out_range>("out_range", "", any, usual_values),
                                     number<&ScaleBiasClamp::scale>("scale", "", any, usual_values),
                                     number<&ScaleBiasClamp::bias>("bias", "", any, usual_values),
                                     field<&ScaleBiasClamp::clamp>("clamp"),
                                     number<&ScaleBiasClamp::clamp_min>("clamp_min", "", any, usual_values),
                                     number<&ScaleBiasClamp::clamp_max>("clamp_max", "", any, usual_values),
                                     field<&ScaleBiasClamp::interp>("interp"),
                                     number<&ScaleBiasClamp::speed_increasing>(
                                         "speed_increasing", "1/s", speeds, usual_speeds, Logarithmic),
                                     number<&ScaleBiasClamp::speed_decreasing>(
                                         "speed_decreasing", "1/s", speeds, usual_speeds, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<Spring<>>() noexcept {
    static constexpr Field rows[] = {
        number<&Spring<>::strength>("strength", "Hz", strengths, usual_strengths, Logarithmic),
        number<&Spring<>::critical_damping>("critical_damping", "", dampings, {0.0, 3.0}),
        number<&Spring<>::force>("force", "1/s^2", any, {-100.0, 100.0}),
        number<&Spring<>::target_velocity_amount>("target_velocity_amount", "", {0.0, 1.0}, {0.0, 1.0})};
    return rows;
}
template <>
std::span<const Field> fields<ExponentialDecay>() noexcept {
    static constexpr Field rows[] = {
        number<&ExponentialDecay::halflife>("halflife", "s", seconds, usual_seconds, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<RateLimit>() noexcept {
    static constexpr Field rows[] = {
        number<&RateLimit::rise>("rise", "1/s", amount, {0.05, 50.0}, Logarithmic),
        number<&RateLimit::fall>("fall", "1/s", amount, {0.05, 50.0}, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<SmoothDamp>() noexcept {
    static constexpr Field rows[] = {
        number<&SmoothDamp::smooth_time>("smooth_time", "s", seconds, usual_seconds, Logarithmic),
        number<&SmoothDamp::max_speed>("max_speed", "1/s", amount, {0.1, 1e6}, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<SpringSemiImplicit>() noexcept {
    static constexpr Field rows[] = {
        number<&SpringSemiImplicit::strength>("strength", "Hz", strengths, usual_strengths, Logarithmic),
        number<&SpringSemiImplicit::critical_damping>("critical_damping", "", dampings, {0.0, 3.0})};
    return rows;
}
template <>
std::span<const Field> fields<OneEuro>() noexcept {
    static constexpr Field rows[] = {
        number<&OneEuro::min_cutoff>("min_cutoff", "Hz", cutoffs, {0.05, 20.0}, Logarithmic),
        number<&OneEuro::beta>("beta", "", cutoffs, {0.0, 2.0}),
        number<&OneEuro::derivative_cutoff>("derivative_cutoff", "Hz", cutoffs, {0.05, 20.0}, Logarithmic),
        number<&OneEuro::reset_jump>("reset_jump", "", amount, {0.0, 2.0})};
    return rows;
}
template <>
std::span<const Field> fields<MovingAverage>() noexcept {
    static constexpr Field rows[] = {
        number<&MovingAverage::window>("window", "s", {0.0, 3600.0}, usual_seconds, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<DeadZone>() noexcept {
    static constexpr Field rows[] = {number<&DeadZone::width>("width", "", amount, {0.0, 2.0})};
    return rows;
}
template <>
std::span<const Field> fields<Hysteresis>() noexcept {
    static constexpr Field rows[] = {number<&Hysteresis::low>("low", "", any, {-2.0, 2.0}),
                                     number<&Hysteresis::high>("high", "", any, {-2.0, 2.0})};
    return rows;
}
template <>
std::span<const Field> fields<Inertialize>() noexcept {
    static constexpr Field rows[] = {
        number<&Inertialize::halflife>("halflife", "s", seconds, usual_seconds, Logarithmic),
        number<&Inertialize::threshold>("threshold", "", amount, {0.01, 2.0}, Logarithmic)};
    return rows;
}
template <>
std::span<const Field> fields<OutputState>() noexcept {
    static constexpr Field rows[] = {field<&OutputState::value>("value", outputs).needed(),
                                     field<&OutputState::started>("started").needed()};
    return rows;
}
template <>
std::span<const Field> fields<MotionState>() noexcept {
    static constexpr Field rows[] = {field<&MotionState::started>("started").needed(),
                                     field<&MotionState::value>("value", outputs).needed(),
                                     field<&MotionState::velocity>("velocity", outputs, "1/s").needed()};
    return rows;
}
template <>
std::span<const Field> fields<MovingAverageState>() noexcept {
    using State = signal::MovingAverageState;
    constexpr FieldRange index{0.0, 1e9};
    static constexpr Field rows[] = {field<&State::started>("started").needed(),
                                     field<&State::value>("value", outputs).needed(),
                                     field<&State::first>("first", index).needed(),
                                     field<&State::split>("split", index).needed(),
                                     field<&State::new_time>("new_time", outputs, "s").needed(),
                                     field<&State::new_area>("new_area", outputs, "s").needed()};
    return rows;
}
template <>
std::span<const Field> fields<InertializeState>() noexcept {
    using State = signal::InertializeState;
    static constexpr Field rows[] = {
        field<&State::started>("started").needed(),
        field<&State::jumped>("jumped").needed(),
        field<&State::value>("value", outputs).needed(),
        field<&State::velocity>("velocity", outputs, "1/s").needed(),
        field<&State::input>("input", outputs).needed(),
        field<&State::offset>("offset", outputs).needed(),
        field<&State::offset_velocity>("offset_velocity", outputs, "1/s").needed()};
    return rows;
}
template <>
std::span<const Field> fields<CurveKey>() noexcept {
    static constexpr Field rows[] = {
        field<&CurveKey::time>("time", any).needed(), field<&CurveKey::value>("value", any).needed(),
        field<&CurveKey::arrive>("arrive", any), field<&CurveKey::leave>("leave", any),
        field<&CurveKey::piece>("piece", pieces)};
    return rows;
}
template <>
std::span<const Field> fields<Curve>() noexcept {
    static constexpr Field rows[] = {list<&Curve::keys>("keys").sparsely().up_to(1'000, 1),
                                     number<&Curve::source_min>("source_min", "", any, usual_values),
                                     number<&Curve::source_max>("source_max", "", any, usual_values),
                                     number<&Curve::target_min>("target_min", "", any, usual_values),
                                     number<&Curve::target_max>("target_max", "", any, usual_values)};
    return rows;
}
}  // namespace tendril
