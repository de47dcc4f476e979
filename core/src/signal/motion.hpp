// The motion of a damped spring over t seconds: exactly how much of its distance and its velocity remains.
// Not installed.
//
// With w = 2 pi strength and z the damping ratio, x'' = -w^2 x - 2 z w x' has the solution
//
//     x(t) = (C + z w S) x + S v,    v(t) = -w^2 S x + (C - z w S) v,
//
// where C = exp(-z w t) cos(d t), S = exp(-z w t) sin(d t) / d, d = w sqrt(1 - z^2). Over critical damping d
// is imaginary, and cosine and sine become hyperbolic; at critical damping S = t exp(-w t). The same holds
// without damping or strength.
#pragma once

#include "tendril/elementary.hpp"

namespace tendril::signal::detail {

struct Motion {
    double x_by_x, x_by_v, v_by_x, v_by_v;
};

/// Strength in Hz, at least 0; damping at least 0; t at least 0, seconds.
static inline Motion motion_of(double strength, double damping, double t) noexcept {
    const double w = 2.0 * math::pi * strength;
    const double below = (1.0 - damping) * (1.0 + damping);  // 1 - z^2, without rounding near 1
    double c, s;
    if (below >= 0.0) {
        const double turns = strength * t * std::sqrt(below), angle = 2.0 * math::pi * turns;
        const math::SineCosine swing = math::sine_cosine_of_turns(turns);
        const double left = math::decay(damping * w * t);
        c = left * swing.cosine;
        s = left * t * (angle > 1e-100 ? swing.sine / angle : 1.0);
    } else if (const double root = std::sqrt(-below), angle = w * t * root; angle < 0.5) {
        // Power series of the hyperbolic cosine and sine: differences of exponentials would lose digits.
        double cosine = 1.0, sine = 1.0;
        for (int n = 14; n > 0; n -= 2) {
            cosine = 1.0 + (angle * angle * (1.0 / (n * (n - 1)))) * cosine;
            sine = 1.0 + (angle * angle * (1.0 / (n * (n + 1)))) * sine;
        }
        const double left = math::decay(damping * w * t);
        c = left * cosine;
        s = left * t * sine;
    } else {
        // The slower of the two decays, and the ratio of the faster one to it.
        const double slow = math::decay(w * t / (damping + root)), fast = math::decay(2.0 * angle);
        c = slow * 0.5 * (1.0 + fast);
        s = slow * 0.5 * (1.0 - fast) * t / angle;
    }
    const double drag = damping * w * s;
    return {c + drag, s, -w * w * s, c - drag};
}

}  // namespace tendril::signal::detail
