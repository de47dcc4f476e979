// Solves a cloth that is a grid as a whole, together with its contacts, in one implicit step
// (cloth_grid.hpp). A contact is as stiff as a link. Friction is a drag along the surface (Coulomb's law,
// with the force and the slip of the previous solve: M. Li et al., "Incremental Potential Contact", 2020).
// Near colliders the step is solved again from its result, with the contacts found there. Not installed.
#pragma once

#include "rope/scratch.hpp"

namespace tendril::rope {

class ClothSolver {
  public:
    ClothSolver(const State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
                IslandScratch& local);

    /// Solves the island's particles, from `base`, with a maximum of `iterations` in each round; returns the
    /// largest number used.
    int solve(int iterations);
    bool converged() const { return converged_; }
    double taken() const { return taken_; }  ///< the part of the last step that was taken

  private:
    // cloth_solver.cpp
    void load();
    void assemble();
    void pin();
    int step(int iterations);
    double potential();

    // cloth_contact.cpp
    void find_contacts(bool first);
    void find_at_particle(ClothContact contact, double radius, bool first);
    void find_at_link(ClothContact contact, double radius);
    void keep(ClothContact contact, const SurfaceDistance& surface, double radius);
    void add_contacts();
    void rub(ClothContact& contact) const;
    double potential_of(const ClothContact& contact) const;
    void add_contact(const ClothContact& contact);
    void note_forces();
    const Scratch::Moving& collider_of(const ClothContact& contact) const {
        return scratch_.colliders[local_.near[contact.near].collider];
    }

    static glm::dvec3 between(const ClothContact& contact, const std::vector<glm::dvec3>& all) {
        return (1.0 - contact.t) * all[contact.a] + contact.t * all[contact.b];
    }
    double stiffness_of(const Link& link) const;
    std::size_t cell_of(std::size_t particle) const {
        const std::size_t number = particle - first_;
        return number / grid_.columns * detail::grid_stride(grid_.columns) + number % grid_.columns;
    }
    template <class Visit>
    void each_cell(Visit visit) const;

    const State& state_;
    const Plan& plan_;
    const Plan::Island& island_;
    Scratch& scratch_;
    IslandScratch& local_;
    const Plan::Grid& grid_;
    detail::Cloth& cloth_;
    const detail::GridLevel& level_;
    std::size_t first_;
    double h_, mass_ = 0.0, unit_ = 0.0;  ///< mean mass of a particle, kg; that over h^2
    double stiffness_ = 0.0;              ///< maximum of a link, in that unit
    float lightest_ = 1.0f;
    double taken_ = 1.0;
    double elastic_ = 0.0;  ///< energy in links, joules
    double strain_ = 0.0;   ///< maximum of a stretch link
    bool converged_ = true;
};

}  // namespace tendril::rope
