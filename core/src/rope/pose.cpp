// The positions of particles and colliders between two substeps.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <span>

#include "math/rotation.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"
#include "tendril/magnitude.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {
namespace {

using glm::dvec3;

/// The part of the way to a goal that is covered after `pending` seconds.
double part_after(double pending, double seconds) {
    if (pending == 0.0) return 0.0;
    return seconds > pending ? pending / seconds : 1.0;
}

/// Part of the world's particles: those from `first` on.
class PoseExtrapolation {
  public:
    PoseExtrapolation(const World& world, std::span<dvec3> at, std::size_t first)
        : world_(world),
          state_(world.state()),
          pending_(world.pending()),
          first_(std::min(first, world.size())),
          at_(at.first(std::min(at.size(), world.size() - first_))) {}

    void run() {
        extrapolate();
        if (pending_ == 0.0) return;
        for (const Collider& collider : state_.colliders) depenetrate(collider);
        place_pins();
    }

  private:
    /// Each particle goes on as in the last substep.
    void extrapolate() {
        const double rate = state_.displaced_in > 0.0 ? pending_ / state_.displaced_in : 0.0;
        constexpr double edge = max_magnitude;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            const dvec3& now = state_.position[first_ + i];
            at_[i] = now;
            if (rate > 0.0)
                at_[i] = glm::clamp(now + rate * state_.displacement[first_ + i], dvec3(-edge), dvec3(edge));
        }
    }

    /// No particle gets deeper into a collider than it was after the last substep.
    void depenetrate(const Collider& collider) {
        const Shape shape = world_.pose(collider);
        dvec3 low, high;
        detail::bounds(shape, dvec3(0.0), low, high);
        for (const Body& body : state_.bodies) {
            const double radius = static_cast<double>(body.radius);
            const std::size_t from = std::max(body.first, first_);
            const std::size_t end = std::min(body.first + body.count, first_ + at_.size());
            for (std::size_t i = from; i < end; ++i) {
                dvec3& at = at_[i - first_];
                const dvec3 nearest = glm::clamp(at, low, high);
                if (glm::any(glm::greaterThan(glm::abs(at - nearest), dvec3(radius)))) continue;
                const SurfaceDistance surface = surface_distance(shape, at);
                if (surface.distance >= radius) continue;
                const double was = surface_distance(collider.shape, state_.position[i]).distance;
                const double deeper = std::min(radius, was) - surface.distance;
                if (deeper > 0.0) at += deeper * surface.normal;
            }
        }
    }

    void place_pins() {
        auto pin = std::ranges::lower_bound(state_.pins, first_, {}, &Pin::particle);
        for (; pin != state_.pins.end() && pin->particle - first_ < at_.size(); ++pin) {
            const dvec3& now = state_.position[pin->particle];
            dvec3 goal = pin->goal;
            if (const Collider* const holder = world_.find(pin->collider)) {
                if (holder->drive.spin != 0.0f)
                    goal = math::rotated(detail::rotation_after(holder->drive, pending_), goal);
                goal += dvec3(centre(world_.pose(*holder)));
            }
            at_[pin->particle - first_] = now + part_after(pending_, pin->seconds) * (goal - now);
        }
    }

    const World& world_;
    const State& state_;
    double pending_;
    std::size_t first_;
    std::span<dvec3> at_;
};

}  // namespace

double World::pending() const noexcept {
    constexpr double rounding = 1e-6;  // relative to a substep, as in advance()
    return state_.remainder > rounding * state_.settings.substep ? state_.remainder : 0.0;
}

void World::pose(std::span<dvec3> particles, std::size_t first) const noexcept {
    PoseExtrapolation(*this, particles, first).run();
}

Shape World::pose(const Collider& collider) const noexcept {
    const double ahead = pending(), part = part_after(ahead, collider.seconds);
    if (part == 0.0) return collider.shape;
    const Shape there = detail::interpolated(collider, part);
    return collider.drive.any() ? detail::driven(there, collider.drive, ahead) : there;
}

}  // namespace tendril::rope
