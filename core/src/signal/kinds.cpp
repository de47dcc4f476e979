// The table of all filters and their parameters.
#include <array>

#include "tendril/signal/filter.hpp"

namespace tendril::signal {
namespace {

template <class P, class M>
P owner(M P::*);

/// The parameter itself, or one of a pair.
template <auto Member, int Element, class P>
auto& member(P& parameters) noexcept {
    if constexpr (Element < 0) {
        return parameters.*Member;
    } else {
        return (parameters.*Member)[Element];
    }
}

template <auto Member, int Element>
double get(const Filter& filter) noexcept {
    const auto* const parameters = std::get_if<decltype(owner(Member))>(&filter);
    return parameters ? static_cast<double>(member<Member, Element>(*parameters)) : 0.0;
}
template <auto Member, int Element>
void set(Filter& filter, double value) noexcept {
    auto* const parameters = std::get_if<decltype(owner(Member))>(&filter);
    if (!parameters) return;
    auto& place = member<Member, Element>(*parameters);
    if constexpr (std::is_same_v<decltype(place), bool&>) {
        place = value != 0.0;
    } else {
        place = value;
    }
}

struct Range {
    double low, high;
};
enum class Scale : bool { Linear, Logarithmic };
using enum Scale;

template <auto Member, int Element = -1>
constexpr Parameter number(std::string_view name, std::string_view unit, Range accepted, Range usual,
                           Scale scale = Linear) {
    return {.name = name,
            .unit = unit,
            .type = ParameterType::Number,
            .element = Element,
            .minimum = accepted.low,
            .maximum = accepted.high,
            .low = usual.low,
            .high = usual.high,
            .logarithmic = scale == Logarithmic,
            .get = get<Member, Element>,
            .set = set<Member, Element>};
}
template <auto Member>
constexpr Parameter flag(std::string_view name) {
    return {.name = name,
            .unit = {},
            .type = ParameterType::Flag,
            .get = get<Member, -1>,
            .set = set<Member, -1>};
}

constexpr Range any{-1e9, 1e9}, amount{0.0, 1e9}, speeds{-1e6, 1e6}, seconds{0.0, 1e4};
constexpr Range strengths{0.0, max_strength}, dampings{0.0, max_damping}, cutoffs{0.0, 1e6};
constexpr Range usual_values{-10.0, 10.0}, usual_speeds{0.1, 60.0}, usual_strengths{0.1, 20.0};
constexpr Range usual_seconds{0.005, 2.0};

constexpr Parameter interp_to_parameters[] = {
    number<&InterpTo::speed>("speed", "1/s", speeds, usual_speeds, Logarithmic)};
constexpr Parameter interp_to_exact_parameters[] = {
    number<&InterpToExact::speed>("speed", "1/s", speeds, usual_speeds, Logarithmic)};
constexpr Parameter scale_bias_clamp_parameters[] = {
    flag<&ScaleBiasClamp::map_range>("map_range"),
    number<&ScaleBiasClamp::in_range, 0>("in_range", "", any, usual_values),
    number<&ScaleBiasClamp::in_range, 1>("in_range", "", any, usual_values),
    number<&ScaleBiasClamp::out_range, 0>("out_range", "", any, usual_values),
    number<&ScaleBiasClamp::out_range, 1>("out_range", "", any, usual_values),
    number<&ScaleBiasClamp::scale>("scale", "", any, usual_values),
    number<&ScaleBiasClamp::bias>("bias", "", any, usual_values),
    flag<&ScaleBiasClamp::clamp>("clamp"),
    number<&ScaleBiasClamp::clamp_min>("clamp_min", "", any, usual_values),
    number<&ScaleBiasClamp::clamp_max>("clamp_max", "", any, usual_values),
    flag<&ScaleBiasClamp::interp>("interp"),
    number<&ScaleBiasClamp::speed_increasing>("speed_increasing", "1/s", speeds, usual_speeds, Logarithmic),
    number<&ScaleBiasClamp::speed_decreasing>("speed_decreasing", "1/s", speeds, usual_speeds, Logarithmic)};
constexpr Parameter spring_parameters[] = {
    number<&Spring<>::strength>("strength", "Hz", strengths, usual_strengths, Logarithmic),
    number<&Spring<>::critical_damping>("critical_damping", "", dampings, {0.0, 3.0}),
    number<&Spring<>::force>("force", "1/s^2", any, {-100.0, 100.0}),
    number<&Spring<>::target_velocity_amount>("target_velocity_amount", "", {0.0, 1.0}, {0.0, 1.0})};
constexpr Parameter exponential_decay_parameters[] = {
    number<&ExponentialDecay::halflife>("halflife", "s", seconds, usual_seconds, Logarithmic)};
constexpr Parameter rate_limit_parameters[] = {
    number<&RateLimit::rise>("rise", "1/s", amount, {0.05, 50.0}, Logarithmic),
    number<&RateLimit::fall>("fall", "1/s", amount, {0.05, 50.0}, Logarithmic)};
constexpr Parameter smooth_damp_parameters[] = {
    number<&SmoothDamp::smooth_time>("smooth_time", "s", seconds, usual_seconds, Logarithmic),
    number<&SmoothDamp::max_speed>("max_speed", "1/s", amount, {0.1, 1e6}, Logarithmic)};
constexpr Parameter spring_semi_implicit_parameters[] = {
    number<&SpringSemiImplicit::strength>("strength", "Hz", strengths, usual_strengths, Logarithmic),
    number<&SpringSemiImplicit::critical_damping>("critical_damping", "", dampings, {0.0, 3.0})};
constexpr Parameter one_euro_parameters[] = {
    number<&OneEuro::min_cutoff>("min_cutoff", "Hz", cutoffs, {0.05, 20.0}, Logarithmic),
    number<&OneEuro::beta>("beta", "", cutoffs, {0.0, 2.0}),
    number<&OneEuro::derivative_cutoff>("derivative_cutoff", "Hz", cutoffs, {0.05, 20.0}, Logarithmic)};
constexpr Parameter moving_average_parameters[] = {
    number<&MovingAverage::window>("window", "s", {0.0, 3600.0}, usual_seconds, Logarithmic)};
constexpr Parameter dead_zone_parameters[] = {number<&DeadZone::width>("width", "", amount, {0.0, 2.0})};
constexpr Parameter hysteresis_parameters[] = {number<&Hysteresis::low>("low", "", any, {-2.0, 2.0}),
                                               number<&Hysteresis::high>("high", "", any, {-2.0, 2.0})};
constexpr Parameter inertialize_parameters[] = {
    number<&Inertialize::halflife>("halflife", "s", seconds, usual_seconds, Logarithmic),
    number<&Inertialize::threshold>("threshold", "", amount, {0.01, 2.0}, Logarithmic)};
constexpr Parameter curve_parameters[] = {number<&Curve::source_min>("source_min", "", any, usual_values),
                                          number<&Curve::source_max>("source_max", "", any, usual_values),
                                          number<&Curve::target_min>("target_min", "", any, usual_values),
                                          number<&Curve::target_max>("target_max", "", any, usual_values)};

template <class P>
Filter blank() noexcept {
    return P{};
}

constexpr std::array<Kind, std::variant_size_v<Filter>> all_kinds{{
    {"interp_to", blank<InterpTo>, interp_to_parameters},
    {"interp_to_exact", blank<InterpToExact>, interp_to_exact_parameters},
    {"scale_bias_clamp", blank<ScaleBiasClamp>, scale_bias_clamp_parameters},
    {"spring", blank<Spring<>>, spring_parameters},
    {"exponential_decay", blank<ExponentialDecay>, exponential_decay_parameters},
    {"rate_limit", blank<RateLimit>, rate_limit_parameters},
    {"smooth_damp", blank<SmoothDamp>, smooth_damp_parameters},
    {"spring_semi_implicit", blank<SpringSemiImplicit>, spring_semi_implicit_parameters},
    {"one_euro", blank<OneEuro>, one_euro_parameters},
    {"moving_average", blank<MovingAverage>, moving_average_parameters},
    {"dead_zone", blank<DeadZone>, dead_zone_parameters},
    {"hysteresis", blank<Hysteresis>, hysteresis_parameters},
    {"inertialize", blank<Inertialize>, inertialize_parameters},
    {"curve", blank<Curve>, curve_parameters},
}};

}  // namespace

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

const char* kind(const Filter& filter) noexcept {
    return kind_of(filter).name;
}

}  // namespace tendril::signal
