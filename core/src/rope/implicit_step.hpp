// The common part of the implicit solvers of a cloth (cloth_solver.hpp) and of tied bodies (tied_solver.hpp).
// Each minimises an incremental potential by Newton's method, in which a contact is a stiff spring along the
// normal of a surface. Friction is a drag along it (Coulomb's law, with the force and the slip of the
// previous solve: M. Li et al., "Incremental Potential Contact", 2020). Not installed.
#pragma once

#include "rope/build.hpp"
#include "rope/scratch.hpp"

namespace tendril::rope {

class ImplicitStep : protected IslandStep {
  protected:
    explicit ImplicitStep(const IslandStep& step) : IslandStep(step) {}

    // implicit_contact.cpp
    void find_contacts(bool first);
    void find_at_particle(ClothContact contact, double radius, bool first);
    void find_at_link(ClothContact contact, double radius, bool first);
    void add_if_active(ClothContact contact, const SurfaceDistance& surface, double radius, bool first);
    void apply_friction(ClothContact& contact) const;
    double potential_of(const ClothContact& contact) const;
    void push_colliders(const std::vector<ClothContact>& contacts) const;  ///< the contacts of the last step
    const Scratch::Moving& collider_of(const ClothContact& contact) const {
        return scratch_.colliders[local_.near[contact.near].collider];
    }
    double friction_of(const ClothContact& contact) const {
        const Plan::Chunk& chunk = plan_.chunks[local_.near[contact.near].chunk];
        return detail::friction(state_, state_.bodies[chunk.body]);
    }
    static glm::dvec3 contact_point(const ClothContact& contact, const std::vector<glm::dvec3>& all) {
        return (1.0 - contact.t) * all[contact.a] + contact.t * all[contact.b];
    }

    double mass_ = 0.0;       ///< mean mass of a particle, kg
    double stiffness_ = 0.0;  ///< stiffness of contacts and the stiffest links, times h^2 over that mass
};

}  // namespace tendril::rope
