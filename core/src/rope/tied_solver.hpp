// Solves tied bodies (ropes, hair and cloth) as one system of links, ties and contacts, in one implicit step.
// Not installed.
//
// As for a cloth (cloth_grid.hpp) Newton's method minimises an incremental potential, but each of its steps
// is solved exactly (elimination.hpp), in double precision. Links and ties are springs too stiff to stretch
// visibly; the previous substep's tension makes them stiff sideways. A cloth that is a grid keeps its own
// system, stiffness and tolerance; its ties still hold exactly (tied_grids.cpp).
#pragma once

#include "rope/cloth_solver.hpp"
#include "rope/implicit_step.hpp"

namespace tendril::rope {

class TiedSolver : ImplicitStep {
  public:
    explicit TiedSolver(const IslandStep& step);

    /// Solves the island's particles, from `base`; returns the steps of Newton's method.
    int solve(int iterations);
    bool converged() const { return converged_; }
    bool shortened() const { return step_scale_ < 1.0; }  ///< only part of the last step was taken

  private:
    /// A spring between two particles.
    struct Spring {
        std::uint32_t a, b, block;
        double rest, stiffness, multiplier;
        bool stiff;
        bool across = false;  ///< a tie that ends on a grid: its force is an unknown
    };
    /// A cloth that is a grid, in the island's units.
    struct Cloth : ClothSolver {
        Cloth(const TiedSolver& island, std::uint32_t grid);
        using ClothSolver::add_contact, ClothSolver::add_links, ClothSolver::evaluate, ClothSolver::finish,
            ClothSolver::load, ClothSolver::pin, ClothSolver::predict, ClothSolver::link_stiffness,
            ClothSolver::cloth_, ClothSolver::in_cells, ClothSolver::level_, ClothSolver::strain_;
    };
    template <class Visit>
    void each_spring(Visit visit);

    void assemble(bool first);
    void add_contacts();
    /// Calls `visit` with the number of each grid, from 1.
    template <class Visit>
    void each_grid(Visit visit) const {
        for (std::uint32_t g = 1; g <= tied_.grids.count; ++g) visit(tied_.grids.first + g);
    }
    std::uint32_t grid_of_particle(std::uint32_t particle) const;  ///< the grid's number, or 0
    void measure_grids();
    void evaluate_grids();
    void predict();
    template <class Visit>
    void each_bend(Visit visit) const;
    void add_bends();
    void add(std::uint32_t particle, const detail::Symmetric3& matrix, const glm::dvec3& force);
    void find_step(const detail::GridSystem::Tolerance& tolerance, int iterations);
    void step(bool first, int iterations, double max_residual);
    void move_by(double part);
    void store_tensions(bool exact);
    double potential();

    double tie_stiffness(const Tie& tie) const;  ///< times h^2 over the mean mass

    // tied_grids.cpp
    void load_ties();
    void add_responses();
    void solve_with_grids(const detail::GridSystem::Tolerance& tolerance, int iterations);

    const Plan::Tied& tied_;
    detail::EliminationSystem& system_;
    double step_scale_ = 1.0;
    double turn_ = 0.0;       ///< turn of a stiff link in the last step, relative to its length
    double strain_ = 0.0;     ///< maximum strain of the grids' stretch links
    double shortest_ = 1e30;  ///< minimum rest length of the grids' stretch links
    float lightest_ = 1.0f;
    bool converged_ = true;
};

}  // namespace tendril::rope
