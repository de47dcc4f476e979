// One fixed step of time. Not installed.
#pragma once

#include "rope/scratch.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

class Substep {
  public:
    /// What it did is added to `report`.
    Substep(State& state, const Plan& plan, Scratch& scratch, Advance& report);
    /// Whether bodies get their length error in the end.
    bool measures = false;
    void run();

  private:
    // advance.cpp
    void move_colliders();
    void move_particles();
    void measure();
    void commit();
    int passes_allowed() const;

    // contact.cpp: finds what is near, and keeps it out of colliders
    void find_near();
    void resolve_contacts(bool first);
    void resolve_particle(std::uint32_t i, std::uint32_t collider, double radius, bool first);
    void resolve_link(const Link& link, std::uint32_t collider, double radius);
    void apply_friction(std::uint32_t i);  ///< Coulomb's friction
    Touch& touch(std::uint32_t i, std::uint32_t collider, const glm::dvec3& normal);

    // depenetration.cpp: what is still inside after the last pass
    void depenetrate();

    // relax.cpp: one link after the other
    int relax(bool compliant);
    void satisfy(std::uint32_t link, double compliance);
    void satisfy_soft();

    // direct.cpp: whole chains at once
    struct Batch;
    int direct();
    double solve_group(const Plan::Group& group, int iteration);
    double solve_batch(const Batch& batch, int iteration);
    void solve_again(std::uint32_t chain);
    void relax_failed_bodies();
    void gather(const detail::Block& block, const Batch& batch) const;
    void scatter(const detail::Block& block, std::uint32_t lane, std::uint32_t chain);
    double energy_gained(std::uint32_t chain) const;
    bool gains_energy(std::uint32_t chain, double part) const;
    double energy_scale(std::uint32_t chain) const;
    void limit_energy();

    double compliance_of(const Link& link) const {
        return static_cast<double>(state_.settings.compliance) * link.rest + link.compliance;
    }

    State& state_;
    const Plan& plan_;
    Scratch& scratch_;
    Advance& report_;
    double h_;
    glm::dvec3 acceleration_;
};

}  // namespace tendril::rope
