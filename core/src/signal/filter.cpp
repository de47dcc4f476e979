#include "tendril/signal/filter.hpp"

#include "math/checks.hpp"

namespace tendril::signal {
namespace {

using tendril::detail::refused;

template <class P, class... Kinds>
constexpr bool is_one = (std::is_same_v<P, Kinds> || ...);
template <class P>
using StateOf = std::conditional_t<
    is_one<P, Spring<>>, SpringState<>,
    std::conditional_t<
        is_one<P, SmoothDamp, SpringSemiImplicit, OneEuro>, MotionState,
        std::conditional_t<is_one<P, MovingAverage>, MovingAverageState,
                           std::conditional_t<is_one<P, Inertialize>, InertializeState, OutputState>>>>;

Result check_between(const ScaleBiasClamp& parameters) noexcept {
    if (parameters.clamp_min <= parameters.clamp_max) return {};
    return refused("scale_bias_clamp", "clamp_min", "at most clamp_max", parameters.clamp_min);
}
Result check_between(const Hysteresis& parameters) noexcept {
    if (parameters.low <= parameters.high) return {};
    return refused("hysteresis", "low", "at most high", parameters.low);
}
Result check_between(const Curve& parameters) noexcept {
    return check(parameters);
}
template <class P>
Result check_between(const P&) noexcept {
    return {};
}

}  // namespace

double step(const Filter& filter, FilterState& state, double input, double dt, Result* why) noexcept {
    return std::visit(
        [&]<class P>(const P& parameters) {
            using State = StateOf<P>;
            if (State* const kept = std::get_if<State>(&state))
                return step(parameters, *kept, input, dt, why);
            State fresh;
            const double output = step(parameters, fresh, input, dt, why);
            if (fresh.started) state = std::move(fresh);
            return output;
        },
        filter);
}

double immediate(const Filter& filter, double input) noexcept {
    FilterState fresh;
    return step(filter, fresh, input, 0.0);
}

double value(const FilterState& state) noexcept {
    return std::visit([](const auto& each) { return each.value; }, state);
}

bool started(const FilterState& state) noexcept {
    return std::visit([](const auto& each) { return each.started; }, state);
}

Result check(const Filter& filter) noexcept {
    const Kind& kind = kind_of(filter);
    if (const Result bad = check_fields(kind.name, kind.table(), fields_in(filter)); !bad) return bad;
    return std::visit([](const auto& parameters) { return check_between(parameters); }, filter);
}

}  // namespace tendril::signal
