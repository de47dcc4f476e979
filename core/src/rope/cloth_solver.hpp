// Solves a cloth that is a grid as a whole, together with its contacts, in one implicit step
// (cloth_grid.hpp). A contact is as stiff as a link. Near colliders the step is solved again from its result,
// with the contacts found there. Not installed.
#pragma once

#include "rope/implicit_step.hpp"

namespace tendril::rope {

class ClothSolver : protected ImplicitStep {
  public:
    explicit ClothSolver(const IslandStep& step);

    /// Solves the island's particles, from `base`, with a maximum of `iterations` in each round; returns the
    /// largest number used.
    int solve(int iterations);
    bool converged() const { return converged_; }
    double step_scale() const { return step_scale_; }  ///< factor on the last step, 0 to 1

  protected:
    /// For any grid of the plan, by its 1-based index; measures nothing.
    ClothSolver(const IslandStep& step, std::uint32_t grid);

    // cloth_solver.cpp
    void load();
    void evaluate();
    void pin();
    int step(int iterations, bool first, double max_residual);
    double potential() const;
    double add_links(double sum) const;  ///< adds the links' potential
    void finish();

    // cloth_contact.cpp
    void add_contacts();
    void add_contact(const ClothContact& contact);
    void store_forces();
    double deepest() const;
    void find_self_contacts();
    void add_self_contacts();
    double self_contact_potential() const;

    double stiffness_of(const Link& link) const;
    std::size_t cell_of(std::size_t particle) const { return cells_[particle - first_]; }
    /// Calls `work` with ranges of up to `size`, in parallel if the cloth is large and threads help.
    template <class Work>
    void in_parts(std::size_t count, std::size_t size, Work work) const {
        detail::in_parts(local_.loops, count, size, level_.cells() >= detail::min_shared_cells, work);
    }
    template <class Work>
    void in_cells(Work work) const {
        in_parts(level_.cells(), detail::part_cells, work);
    }
    static double link_stiffness(double weight, double shortest, double unit);
    /// Initial guess: unchanged velocities, or free motion if forces move particles by as much as a link.
    /// Returns the residual at which a later step is solved.
    double predict();
    bool is_driven() const;
    template <class Visit>
    void each_cell(Visit visit) const;
    template <class Visit>
    double sum_of_links(Visit visit) const;

    const Plan::Grid& grid_;
    detail::Cloth& cloth_;
    const detail::GridLevel& level_;
    std::span<const std::uint32_t> cells_;  ///< cells of the particles
    std::size_t first_;
    double unit_ = 0.0;  ///< mean mass of a particle, over h^2
    float lightest_ = 1.0f;
    double step_scale_ = 1.0;
    double shortest_ = 1e30;  ///< minimum rest length of stretch links
    double strain_ = 0.0;     ///< maximum over stretch links
    double potential_ = 0.0;  ///< inertia plus links
    double decrease_ = 0.0;   ///< decrease of the potential with contacts in the last step
    double forcing_ = 0.0;    ///< the potential of inertia that forces add in a substep
    bool converged_ = true;
};

}  // namespace tendril::rope
