#include "tendril/signal/curve.hpp"

#include <algorithm>
#include <cstdio>

#include "math/checks.hpp"
#include "signal/stepped.hpp"
#include "tendril/signal/filter.hpp"

namespace tendril::signal {
namespace {

using tendril::detail::refused;

Result check_key(const Curve& curve, std::size_t i) noexcept {
    char place[40];
    std::snprintf(place, sizeof place, "keys[%zu]", i);
    if (const Result bad = check_fields("curve", curve.keys[i], place); !bad) return bad;
    if (i > 0 && !(curve.keys[i].time > curve.keys[i - 1].time))
        return refused("curve", {"keys", i, "time"}, "over the time of the key before it",
                       curve.keys[i].time);
    return {};
}

/// Hermite's cubic over 0 to 1; tangents are per piece.
double cubic(double from, double leave, double to, double arrive, double u) noexcept {
    const double v = 1.0 - u;
    return v * v * (from * (1.0 + 2.0 * u) + leave * u) + u * u * (to * (1.0 + 2.0 * v) - arrive * v);
}

double evaluate_piece(const CurveKey& from, const CurveKey& to, double time) noexcept {
    const double width = to.time - from.time;
    if (from.piece == Piece::Constant || !(width > 0.0)) return from.value;
    const double u = (time - from.time) / width;
    if (from.piece == Piece::Linear) return from.value + (to.value - from.value) * u;
    return cubic(from.value, from.leave * width, to.value, to.arrive * width, u);
}

/// The slope from key to key, at most max_magnitude, the limit of tangents.
double slope_between(const CurveKey& a, const CurveKey& b) noexcept {
    const double width = b.time - a.time, limit = static_cast<double>(max_magnitude);
    return width > 0.0 ? std::clamp((b.value - a.value) / width, -limit, limit) : 0.0;
}

}  // namespace

Result check(const Curve& curve) noexcept {
    const auto ends = fields<Curve>().subspan(1);
    if (const Result bad = check_fields("curve", ends, &curve); !bad) return bad;
    if (curve.keys.empty()) return refused("curve", "keys", "at least one", "none");
    for (std::size_t i = 0; i < curve.keys.size(); ++i)
        if (const Result bad = check_key(curve, i); !bad) return bad;
    return {};
}

double evaluate_keys(const Curve& curve, double time) noexcept {
    if (curve.keys.empty()) return 0.0;
    const auto after = std::upper_bound(curve.keys.begin(), curve.keys.end(), time,
                                        [](double at, const CurveKey& key) { return at < key.time; });
    if (after == curve.keys.begin()) return curve.keys.front().value;
    if (after == curve.keys.end()) return curve.keys.back().value;
    return evaluate_piece(*(after - 1), *after, time);
}

double evaluate(const Curve& curve, double value) noexcept {
    const double width = curve.source_max - curve.source_min;
    const bool maps = width != 0.0 && is_input(value);
    const double time = maps ? detail::bounded((value - curve.source_min) / width) : 0.0;
    const double part = evaluate_keys(curve, time);
    return detail::bounded(curve.target_min + part * (curve.target_max - curve.target_min));
}

double step(const Curve& parameters, OutputState& state, double input, double dt, Result* why) noexcept {
    return detail::stepped(
        state, input, dt, [&](double) { return detail::output(evaluate(parameters, input)); },
        [&](double) { state.value = evaluate(parameters, input); }, why);
}

void set_smooth_tangents(Curve& curve) noexcept {
    auto& keys = curve.keys;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        double slope = 0.0;
        if (i > 0 && i + 1 < keys.size()) {
            const double before = slope_between(keys[i - 1], keys[i]);
            const double after = slope_between(keys[i], keys[i + 1]);
            const bool monotonic = (before > 0.0 && after > 0.0) || (before < 0.0 && after < 0.0);
            if (monotonic) slope = slope_between(keys[i - 1], keys[i + 1]);
        }
        keys[i].arrive = keys[i].leave = slope;
    }
}

}  // namespace tendril::signal
