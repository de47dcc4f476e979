// The height that a foot in the air needs to clear the ground ahead.
#include "humanoid/foot.hpp"

#include <algorithm>
#include <cmath>

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;

/// Distance ahead of the foot over which the ground is sampled, metres, and the number of samples.
constexpr double look_ahead = 0.8;
constexpr int samples = 8;
/// A foot rises for the ground ahead at this fraction of max_speed. It aims to be up this many seconds before
/// the edge, because its lift lags behind its goal by as much.
constexpr double rise_part = 0.6, lead_time = 0.04;
/// A foot that accelerates is assumed to do so for this many more seconds.
constexpr double speedup_time = 0.1;

/// Predicts when a foot reaches a point on its path, from its speed and acceleration.
class SwingMotion {
  public:
    SwingMotion(const SwingSole& sole, double dt) noexcept : speed_(length(sole.velocity)) {
        if (!(speed_ > 1e-9)) return;
        along_ = times(sole.velocity, 1.0 / speed_);
        acceleration_ = (speed_ - dot(sole.before, along_)) / dt;
    }
    const glm::dvec3& along() const noexcept { return along_; }
    bool moves() const noexcept { return speed_ > 1e-9; }
    /// Seconds until the foot has covered `way`; 1e9 if it stops short of it.
    double time_to(double way) const noexcept {
        if (!(way > 0.0)) return 0.0;
        if (!(speed_ > 1e-9)) return 1e9;
        const double square = speed_ * speed_ + 2.0 * acceleration_ * way;
        // The place where it stops is within reach, whatever the rounding.
        if (square < -1e-3 * speed_ * speed_) return 1e9;
        const double time = 2.0 * way / (speed_ + std::sqrt(std::max(0.0, square)));
        if (acceleration_ <= 0.0 || time <= speedup_time) return time;
        const double distance = (speed_ + 0.5 * acceleration_ * speedup_time) * speedup_time;
        return speedup_time + (way - distance) / (speed_ + acceleration_ * speedup_time);
    }

  private:
    double speed_, acceleration_ = 0.0;
    glm::dvec3 along_{0.0};
};

}  // namespace

Clearance find_clearance(const SwingSole& sole, double from, const FootContext& context) noexcept {
    const SwingMotion foot(sole, context.dt);
    const double max_speed = context.options.max_speed, rate = rise_part * max_speed;
    std::array<glm::dvec3, 3> points = sole.points;  // before they moved
    std::array<double, 3> at;
    for (std::size_t i = 0; i < 3; ++i) {
        points[i] = minus(points[i], sole.moved);
        at[i] = dot(points[i], foot.along());
    }
    const auto first = static_cast<std::size_t>(std::max_element(at.begin(), at.end()) - at.begin());
    const auto below = [&](const glm::dvec3& point) {
        return context.ground.below({point.x, from, point.z});
    };
    const auto base = below(points[first]);
    if (check_ground(base, context) != FootAlone::No) return {};
    const auto plane = [&](const glm::dvec3& point) {
        return height_of_plane(*base, point.x - points[first].x, point.z - points[first].z);
    };
    // Height over the plane below the foremost point: a foot follows a slope at any speed.
    const auto height = [&](const glm::dvec3& point) {
        const auto hit = below(point);
        return check_ground(hit, context) == FootAlone::No ? hit->height - plane(point) : 0.0;
    };
    Clearance clearance;
    // Raises every point that will pass `where`.
    const auto pass = [&](double where, double high) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (at[i] > where + 1e-9) continue;
            const double time = std::max(0.0, foot.time_to(where - at[i]) - lead_time);
            clearance.raise = std::max(clearance.raise, plane(points[i]) + high - rate * time - points[i].y);
        }
    };
    for (std::size_t i = 0; i < 3; ++i) pass(at[i], i == first ? 0.0 : height(points[i]));
    if (!foot.moves()) return clearance;
    const double advance = dot(sole.moved, foot.along()), own = points[first].y - plane(points[first]);
    double lower = 0.0, last = 0.0;
    for (int i = 1; i <= samples; ++i) {
        const double ahead = std::min(look_ahead * i / samples, sole.remaining + advance);
        if (foot.time_to(ahead) > 1.0) break;
        const auto high_at = [&](double by) { return height(plus(points[first], times(foot.along(), by))); };
        const double there = high_at(ahead);
        double edge = ahead;
        for (double low = last; there > lower + step_over_plane && edge - low > 0.008;) {
            const double middle = 0.5 * (low + edge);
            (high_at(middle) > 0.5 * (lower + there) ? edge : low) = middle;
        }
        pass(at[first] + edge, there);
        if (there > lower + step_over_plane && there > own && advance > 1e-9) {
            const double steps = (there - own) / (max_speed * context.dt);
            clearance.part = std::min(clearance.part, std::max(0.0, edge - 0.008) / (steps * advance));
        }
        if (ahead == sole.remaining + advance) break;
        lower = there, last = ahead;
    }
    return clearance;
}

}  // namespace tendril::humanoid::detail
