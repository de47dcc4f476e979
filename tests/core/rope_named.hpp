// A rope world with named bodies and colliders and a workspace of its own, which throws if the library
// refuses, to keep tests readable. The rest is the library's World.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tendril/rope/world.hpp"

namespace tendril::test {

inline void allow(const Result& result) {
    if (!result) throw std::invalid_argument(result.message());
}
template <class T>
T allowed(Expected<T> given) {
    allow(given.error());
    return *std::move(given);
}

class World : public rope::World {
  public:
    World() = default;
    /// Gives bodies and colliders default names.
    explicit World(rope::State state) : rope::World(allowed(from_state(std::move(state)))) {
        bodies_.resize(this->state().body_slots.size());
        for (const rope::Body& body : this->state().bodies) name_body(body.id, "");
        for (const rope::Collider& collider : this->state().colliders)
            set_name(colliders_, collider.id.index, "collider " + std::to_string(collider.id.index));
    }
    World(const World& other)
        : rope::World(other), bodies_(other.bodies_), colliders_(other.colliders_), unit_(other.unit_) {
        if (!unit_.empty()) use_vector_unit(unit_);
    }
    World(World&&) noexcept = default;
    World& operator=(const World& other) {
        World copy(other);
        return *this = std::move(copy);
    }
    World& operator=(World&&) noexcept = default;
    ~World() = default;

    rope::World& core() { return *this; }
    const rope::World& core() const { return *this; }
    void set_settings(const rope::Settings& settings) { allow(rope::World::set_settings(settings)); }
    void use_vector_unit(std::string_view name) {
        unit_ = name;
        allow(workspace_.use_vector_unit(name));
    }

    std::string add_rope(const rope::RopeShape& shape) { return add_rope("", shape); }
    std::string add_rope(const std::string& name, const rope::RopeShape& shape) {
        return name_body(allowed(rope::World::add_rope(shape)), name);
    }
    std::string add_cloth(const rope::ClothShape& shape) { return add_cloth("", shape); }
    std::string add_cloth(const std::string& name, const rope::ClothShape& shape) {
        return name_body(allowed(rope::World::add_cloth(shape)), name);
    }
    std::string add_hair(const rope::HairShape& shape, const std::string& attach = {}) {
        return add_hair("", shape, attach);
    }
    std::string add_hair(const std::string& name, rope::HairShape shape, const std::string& attach = {}) {
        if (!attach.empty()) shape.attach = collider_id(attach);
        return name_body(allowed(rope::World::add_hair(shape)), name);
    }
    void remove(std::string_view body) { allow(rope::World::remove(id(body))); }
    std::string cut(std::string_view rope, std::size_t segment) {
        const std::string name(rope);
        return name_body(allowed(rope::World::cut(id(rope), segment)), "", name);
    }

    /// The handle of a named body; null if there is none.
    rope::BodyId id(std::string_view body) const {
        for (const rope::Body& each : state().bodies)
            if (name(each) == body) return each.id;
        return {};
    }
    rope::ColliderId collider_id(std::string_view collider) const {
        for (const rope::Collider& each : state().colliders)
            if (name(each) == collider) return each.id;
        return {};
    }
    const std::string& name(const rope::Body& body) const { return bodies_[body.id.index]; }
    const std::string& name(const rope::Collider& collider) const { return colliders_[collider.id.index]; }
    const rope::Body* find(std::string_view body) const { return rope::World::find(id(body)); }
    const rope::Collider* find_collider(std::string_view collider) const {
        return rope::World::find(collider_id(collider));
    }
    std::size_t particle(std::string_view body, std::size_t index) const {
        return allowed(rope::World::particle(id(body), index));
    }

    void pin(std::size_t particle, const glm::vec3& at, double seconds = 0.0) {
        allow(rope::World::pin(particle, glm::dvec3(at), seconds));
    }
    void attach(std::size_t particle, std::string_view collider) {
        allow(rope::World::attach(particle, collider_id(collider)));
    }
    void unpin(std::size_t particle) { allow(rope::World::unpin(particle)); }

    void add_collider(const std::string& name, const rope::Shape& shape) {
        set_name(colliders_, allowed(rope::World::add_collider(shape)).index, name);
    }
    void move_collider(std::string_view collider, const glm::vec3& to, double seconds = 0.0) {
        allow(rope::World::move_collider(collider_id(collider), to, seconds));
    }
    void set_collider(std::string_view collider, const rope::Shape& shape) {
        allow(rope::World::set_collider(collider_id(collider), shape));
    }
    void remove_collider(std::string_view collider) {
        allow(rope::World::remove_collider(collider_id(collider)));
    }

    rope::Advance advance(double seconds, std::uint64_t max_substeps = std::uint64_t{1} << 40) {
        return rope::World::advance(seconds, workspace_, {.max_substeps = max_substeps, .impulses = true});
    }

    // A position in single precision, for comparison with inputs.
    glm::vec3 position(std::size_t particle) const { return glm::vec3(rope::World::position(particle)); }
    glm::vec3 velocity(std::size_t particle) const { return glm::vec3(rope::World::velocity(particle)); }

  private:
    static void set_name(std::vector<std::string>& names, std::size_t slot, const std::string& name) {
        if (names.size() <= slot) names.resize(slot + 1);
        names[slot] = name;
    }
    /// Returns `wanted`, or the first free name of "rope", "rope 2", ...
    std::string name_body(rope::BodyId id, std::string wanted, const std::string& stem = {}) {
        static constexpr const char* kinds[] = {"rope", "cloth", "hair"};
        if (bodies_.size() <= id.index) bodies_.resize(id.index + 1);
        bodies_[id.index].clear();
        const std::string first =
            stem.empty() ? kinds[static_cast<std::size_t>(rope::World::find(id)->kind)] : stem;
        for (int i = stem.empty() ? 1 : 2; wanted.empty(); ++i) {
            const std::string name = i == 1 ? first : first + " " + std::to_string(i);
            if (find(name) == nullptr) wanted = name;
        }
        return bodies_[id.index] = wanted;
    }

    rope::Workspace workspace_;
    std::vector<std::string> bodies_, colliders_;  ///< by slot
    std::string unit_;
};

}  // namespace tendril::test
