#include "rope/hang.hpp"

#include <algorithm>
#include <cmath>

#include "rope/geometry.hpp"
#include "tendril/elementary.hpp"

namespace tendril::rope::detail {
namespace {

/// p(t) = from + t across + 4 sag t (1 - t) down, for any t.
struct Parabola {
    dvec3 from, across, down;
    double sag = 0.0;

    dvec3 at(double t) const { return from + t * across + (4.0 * sag * t * (1.0 - t)) * down; }
    dvec3 slope(double t) const { return across + (4.0 * sag * (1.0 - 2.0 * t)) * down; }

    /// The parameter of the next point after t that is `chord` away.
    double next(double t, double chord) const {
        const dvec3 here = at(t);
        double low = t, step = chord / std::max(length(slope(t)), 1e-300), high = t + step;
        while (length(at(high) - here) < chord && high < t + 1e6) high += step, step *= 2.0;
        // Newton's method, kept within the bracket.
        double guess = std::min(high, t + chord / std::max(length(slope(t)), 1e-300));
        for (int i = 0; i < 60; ++i) {
            const dvec3 by = at(guess) - here;
            const double distance = length(by), error = distance - chord;
            if (std::abs(error) <= 1e-14 * chord) break;
            (error < 0.0 ? low : high) = guess;
            const double rate = distance > 0.0 ? dot(by, slope(guess)) / distance : 0.0;
            double better = rate > 0.0 ? guess - error / rate : 0.5 * (low + high);
            if (!(better > low && better < high)) better = 0.5 * (low + high);
            if (better == guess) break;
            guess = better;
        }
        return guess;
    }

    /// The parameter where `segments` chords from the start end; 1 is `to`. Stops soon after that.
    double end(double chord, std::size_t segments) const {
        double t = 0.0;
        for (std::size_t i = 0; i < segments && t < 2.0; ++i) t = next(t, chord);
        return t;
    }
};

/// Down along a line and up again: a rope without horizontal extent.
std::vector<dvec3> folded(const dvec3& from, const dvec3& to, double length_, std::size_t segments,
                          const dvec3& down) {
    const double lower = dot(to - from, down);  // height of `from` above `to`
    const double turn = 0.5 * (length_ + lower);
    std::vector<dvec3> points;
    points.reserve(segments + 1);
    for (std::size_t i = 0; i <= segments; ++i) {
        const double along = length_ * static_cast<double>(i) / static_cast<double>(segments);
        const double depth = along <= turn ? along : 2.0 * turn - along;
        const double part = static_cast<double>(i) / static_cast<double>(segments);
        points.push_back(from + part * ((to - from) - lower * down) + depth * down);
    }
    return points;
}

/// Chords of a circle's arc below the line from `from` to `to`. Each bends from the one before by the same
/// angle.
std::vector<dvec3> arc(const dvec3& from, const dvec3& across, double chord, std::size_t segments,
                       const dvec3& down) {
    const double distance = length(across), count = static_cast<double>(segments);
    double low = 0.0, high = math::pi / count;  // half that angle
    for (int i = 0; i < 60; ++i) {
        const double half = 0.5 * (low + high);
        (math::sine(count * half) * chord > distance * math::sine(half) ? low : high) = half;
    }
    const dvec3 along = (1.0 / distance) * across, below = down - dot(down, along) * along;
    const dvec3 aside = (1.0 / length(below)) * below;
    std::vector<dvec3> points{from};
    for (std::size_t i = 0; i < segments; ++i) {
        const auto [sine, cosine] = math::sine_cosine((count - 1.0 - 2.0 * static_cast<double>(i)) * low);
        points.push_back(points.back() + chord * (cosine * along + sine * aside));
    }
    return points;
}

}  // namespace

std::vector<dvec3> hang(const dvec3& from, const dvec3& to, double length_, std::size_t segments,
                        const dvec3& down) {
    const dvec3 across = to - from;
    const double distance = length(across), count = static_cast<double>(segments);
    std::vector<dvec3> points;
    points.reserve(segments + 1);
    if (!(length_ > distance * (1.0 + 1e-9))) {
        for (std::size_t i = 0; i <= segments; ++i)
            points.push_back(from + (static_cast<double>(i) / count) * across);
        points.back() = to;
        return points;
    }
    const dvec3 level = across - dot(across, down) * down;
    if (length(level) < 1e-6 * length_ || segments < 2) return folded(from, to, length_, segments, down);

    Parabola parabola{from, across, down};
    const double chord = length_ / count;
    double low = 0.0, high = length_;  // too little and too much sag
    for (int i = 0; i < 60 && high - low > 1e-13 * length_; ++i) {
        parabola.sag = 0.5 * (low + high);
        (parabola.end(chord, segments) > 1.0 ? low : high) = parabola.sag;
    }
    double t = 0.0;
    for (std::size_t i = 0; i <= segments; ++i) {
        points.push_back(parabola.at(t));
        t = parabola.next(t, chord);
    }
    // No parabola may end there if a rope is coarse and slack or steep.
    if (length(points.back() - to) > 1e-4 * chord) points = arc(from, across, chord, segments, down);
    points.back() = to;
    return points;
}

}  // namespace tendril::rope::detail
