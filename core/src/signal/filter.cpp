#include "tendril/signal/filter.hpp"

#include "math/checks.hpp"

namespace tendril::signal {
namespace {

using tendril::detail::Argument;
using tendril::detail::refused;
using tendril::detail::Shown;

template <class P>
struct StateOf {
    using type = OutputState;
};
template <>
struct StateOf<Spring<>> {
    using type = SpringState<>;
};
template <>
struct StateOf<SmoothDamp> {
    using type = MotionState;
};
template <>
struct StateOf<SpringSemiImplicit> {
    using type = MotionState;
};
template <>
struct StateOf<OneEuro> {
    using type = MotionState;
};
template <>
struct StateOf<MovingAverage> {
    using type = MovingAverageState;
};
template <>
struct StateOf<Inertialize> {
    using type = InertializeState;
};

/// `from 0 to 1e9`
class RangeText {
  public:
    explicit RangeText(const Parameter& parameter) noexcept {
        add("from ");
        add(Shown(parameter.minimum).text());
        add(" to ");
        add(Shown(parameter.maximum).text());
    }
    std::string_view text() const noexcept { return {buffer_, size_}; }

  private:
    /// 1e+09 as people write it.
    void add(std::string_view text) noexcept {
        for (const char c : text) {
            const bool after_e = size_ > 0 && buffer_[size_ - 1] == 'e';
            if (c != '+' && !(c == '0' && after_e)) buffer_[size_++] = c;
        }
    }
    char buffer_[128];  // two numbers of at most 64
    std::size_t size_ = 0;
};

Result check_range(const Kind& kind, const Parameter& parameter, double value) noexcept {
    if (value >= parameter.minimum && value <= parameter.maximum) return {};
    const auto index =
        parameter.element < 0 ? tendril::detail::no_index : static_cast<std::size_t>(parameter.element);
    return refused(kind.name, Argument(parameter.name, index), RangeText(parameter).text(), value);
}

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

double step(const Filter& filter, FilterState& state, double input, double dt) noexcept {
    return std::visit(
        [&]<class P>(const P& parameters) {
            using State = typename StateOf<P>::type;
            if (State* const kept = std::get_if<State>(&state)) return step(parameters, *kept, input, dt);
            State fresh;
            const double output = step(parameters, fresh, input, dt);
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
    for (const Parameter& parameter : kind.parameters)
        if (const Result bad = check_range(kind, parameter, parameter.get(filter)); !bad) return bad;
    return std::visit([](const auto& parameters) { return check_between(parameters); }, filter);
}

}  // namespace tendril::signal
