// Random edits of rope worlds with hostile numbers: for tests, and for benchmarks of the worst case.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <iterator>
#include <limits>

#include "random.hpp"
#include "tendril/rope/quasi_static.hpp"

namespace tendril::test {

/// Plausible numbers, at times the worst ones.
class HostileNumbers {
  public:
    explicit HostileNumbers(std::uint64_t seed) : random(seed) {}
    Random random;

    float number(float range) {
        static constexpr float bad[] = {0.0f,
                                        1e9f,
                                        -1e9f,
                                        1e-9f,
                                        1e-30f,
                                        1e6f,
                                        1e4f,
                                        std::numeric_limits<float>::quiet_NaN(),
                                        std::numeric_limits<float>::infinity()};
        return random.chance(20) ? bad[random.below(std::size(bad))] : random.around(range);
    }
    glm::vec3 point(float range) {
        if (!random.chance(12)) return random.point(range);
        const float x = number(range), y = number(range), z = number(range);
        return {x, y, z};
    }
    float amount(float range) { return std::abs(number(range)); }
    rope::Shape shape() {
        switch (random.below(4)) {
            case 0:
                return rope::Sphere{point(2), amount(1)};
            case 1:
                return rope::Capsule{point(2), point(2), amount(0.5f)};
            case 2:
                return rope::Plane{point(2), point(1)};
            default:
                return rope::Box{point(2), glm::abs(point(1)), {random.around(1), random.around(1), 0.5f, 0}};
        }
    }
};

/// Makes one edit, usually a sensible one. Refusals are ignored.
class HostileEditor {
  public:
    /// Clears a world of more than about `particles`: small worlds go through more edits.
    HostileEditor(rope::World& world, rope::Workspace& workspace, HostileNumbers& hostile,
                  std::size_t particles = 80)
        : world_(world),
          workspace_(workspace),
          hostile_(hostile),
          random_(hostile.random),
          particles_(particles) {}

    // One random draw per statement: compilers evaluate arguments in different orders.
    Result edit() {
        const std::size_t what = random_.below(20);
        const rope::BodyId body = some_body();
        const rope::ColliderId collider = some_collider();
        const std::size_t particle = world_.size() == 0 ? 0 : random_.below(world_.size());
        const glm::vec3 at = hostile_.point(2);
        const double seconds = random_.chance(2) ? 0.0 : static_cast<double>(hostile_.amount(1));
        switch (what) {
            case 0:
                return add_rope();
            case 1:
                return add_cloth();
            case 2:
                return add_hair();
            case 3:
                return world_.remove(body);
            case 4:
            case 5:
                return world_.pin(particle, glm::dvec3(at), seconds);
            case 6:
                return world_.attach(particle, collider);
            case 7:
                return world_.unpin(particle);
            case 8:
                return world_.cut(body, random_.below(12)).error();
            case 9:
            case 10:
                if (world_.state().colliders.size() < 5) return world_.add_collider(hostile_.shape()).error();
                [[fallthrough]];
            case 11:
            case 12:
                return world_.move_collider(collider, at, seconds);
            case 13:
                return world_.set_collider(collider, hostile_.shape());
            case 14:
                return world_.remove_collider(collider);
            case 15:
            case 16:
                return settings();
            case 17:
                return material(body);
            case 18:
                return random_.chance(2) ? drag_pin(world_, workspace_, particle, glm::dvec3(at))
                                         : drag_collider(world_, workspace_, collider, at);
            default:
                return {};
        }
    }

  private:
    rope::BodyId some_body() {
        const auto& all = world_.state().bodies;
        return all.empty() ? rope::BodyId{} : all[random_.below(all.size())].id;
    }
    rope::ColliderId some_collider() {
        const auto& all = world_.state().colliders;
        return all.empty() ? rope::ColliderId{} : all[random_.below(all.size())].id;
    }
    void keep_small() {
        if (world_.size() > particles_) world_.clear();
    }

    Result add_rope() {
        keep_small();
        rope::RopeShape shape{.from = hostile_.point(2),
                              .to = hostile_.point(2),
                              .segments = 1 + static_cast<int>(random_.below(20)),
                              .radius = hostile_.amount(0.05f),
                              .density = hostile_.amount(1),
                              .pin_start = random_.chance(2),
                              .pin_end = random_.chance(3)};
        if (random_.chance(2)) shape.length = hostile_.amount(3);
        if (random_.chance(10)) shape.to = shape.from;
        return world_.add_rope(shape).error();
    }
    Result add_cloth() {
        keep_small();
        return world_
            .add_cloth({.corner = hostile_.point(2),
                        .along = hostile_.point(2),
                        .down = hostile_.point(2),
                        .columns = 2 + static_cast<int>(random_.below(4)),
                        .rows = 2 + static_cast<int>(random_.below(4)),
                        .radius = hostile_.amount(0.05f),
                        .density = hostile_.amount(1),
                        .shear = hostile_.amount(1),
                        .bend = hostile_.amount(1),
                        .tear = random_.chance(2) ? hostile_.amount(1) : 0.0f,
                        .pins = static_cast<rope::ClothShape::Pins>(random_.below(3))})
            .error();
    }
    Result add_hair() {
        keep_small();
        rope::HairShape shape{.length = hostile_.amount(1),
                              .segments = 2 + static_cast<int>(random_.below(5)),
                              .radius = hostile_.amount(0.05f),
                              .density = hostile_.amount(1),
                              .bend = hostile_.amount(1)};
        for (std::size_t i = 0, count = 1 + random_.below(9); i < count; ++i)
            shape.roots.push_back({hostile_.point(2), hostile_.point(1)});
        if (random_.chance(2)) shape.attach = some_collider();
        return world_.add_hair(shape).error();
    }
    Result settings() {
        rope::Settings wanted = world_.settings();
        static constexpr double substeps[] = {1e-5, 1e-3, 1.0 / 240.0, 1.0 / 60.0, 0.1};
        switch (random_.below(9)) {
            case 0:
                wanted.substep = substeps[random_.below(5)];
                break;
            case 1:
                wanted.iterations = 1 + static_cast<int>(random_.below(random_.chance(40) ? 10'000 : 20));
                break;
            case 2:
                wanted.solver = static_cast<rope::Solver>(random_.below(3));
                break;
            case 3:
                wanted.damping = hostile_.amount(2);
                break;
            case 4:
                wanted.gravity = hostile_.point(random_.chance(4) ? 1e4f : 20.0f);
                break;
            case 5:
                wanted.gravity_scale = random_.chance(4) ? hostile_.number(1e3f) : 1.0f;
                break;
            case 6:
                wanted.compliance = hostile_.amount(random_.chance(2) ? 1e-3f : 1.0f);
                break;
            case 7:
                wanted.friction = hostile_.amount(1);
                break;
            default:
                wanted.longest_frame = hostile_.amount(0.5f);
        }
        return world_.set_settings(wanted);
    }
    Result material(rope::BodyId body) {
        const auto kind = static_cast<rope::Link::Kind>(random_.below(3));
        switch (random_.below(5)) {
            case 0:
                return world_.set_radius(body, hostile_.amount(0.05f));
            case 1:
                return world_.set_mass(body, static_cast<double>(hostile_.amount(1)));
            case 2:
                return world_.set_tear(body, hostile_.amount(1));
            case 3:
                return world_.set_compliance(body, kind, hostile_.amount(1));
            default:
                return world_.set_length(body, hostile_.amount(2));
        }
    }

    rope::World& world_;
    rope::Workspace& workspace_;
    HostileNumbers& hostile_;
    Random& random_;
    std::size_t particles_;
};

}  // namespace tendril::test
