// Shared by tests of ropes, hair and cloth on a character: their distance from the body.
#pragma once

#include <tendril/humanoid/capsules.hpp>

#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "humanoid_support.hpp"

namespace tendril::app {

class HumanoidAttach : public HumanoidTest {
  protected:
    const NamedWorld& world() const { return *part().attachments.world; }
    const rope::Body& body(const char* name) const { return *world().find(name); }
    glm::dvec3 particle(const char* name, std::size_t i) const {
        return world().state().position[body(name).first + i];
    }
    glm::dvec3 last(const char* name) const { return particle(name, body(name).count - 1); }

    std::vector<humanoid::PlacedCapsule> capsules() const {
        const ShownPose& shown = shown_pose(workspace);
        std::vector<humanoid::PlacedCapsule> all;
        for (const humanoid::BodyCapsule& each : humanoid_runtime(workspace).solvers.volume(part()))
            all.push_back(humanoid::place(each, *part().map, shown.placed));
        return all;
    }
    static double depth(const std::vector<humanoid::PlacedCapsule>& capsules, const glm::dvec3& from,
                        const glm::dvec3& to) {
        double deepest = 0.0;
        for (const humanoid::PlacedCapsule& each : capsules)
            deepest = std::max(deepest, -humanoid::gap(each, {from, to, 0.0}));
        return deepest;
    }
    /// The maximum depth of free particles inside the body, metres.
    double particle_depth() const {
        const auto all = capsules();
        double deepest = 0.0;
        for (std::size_t i = 0; i < world().size(); ++i)
            if (const glm::dvec3& at = world().state().position[i]; !world().pinned(i))
                deepest = std::max(deepest, depth(all, at, at));
        return deepest;
    }
    /// The same for links between them.
    double link_depth() const {
        const auto all = capsules();
        const rope::State& state = world().state();
        double deepest = 0.0;
        for (const rope::Link& link : state.links)
            if (link.kind == rope::Link::Kind::Stretch && !world().pinned(link.a) && !world().pinned(link.b))
                deepest = std::max(deepest, depth(all, state.position[link.a], state.position[link.b]));
        return deepest;
    }
    double fastest() const {
        double speed = 0.0;
        for (std::size_t i = 0; i < world().size(); ++i)
            speed = std::max(speed, static_cast<double>(glm::length(world().velocity(i))));
        return speed;
    }
    bool all_finite() const {
        return std::ranges::all_of(world().state().position, [](const glm::dvec3& at) {
            return std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z);
        });
    }
    /// A cape, a ponytail and a tail.
    void dress() {
        run("humanoid.attach", {{"bone", "UpperChest"}, {"kind", "cloth"}, {"name", "cape"}});
        run("humanoid.attach", {{"bone", "Head"}, {"kind", "hair"}, {"name", "ponytail"}});
        run("humanoid.attach", {{"bone", "Hips"}, {"kind", "rope"}, {"name", "tail"}});
    }
};

}  // namespace tendril::app
