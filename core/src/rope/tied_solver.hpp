// Solves bodies that ties join as a whole, together with their contacts, in one implicit step: ropes, hair
// and cloth, their links and their ties are one system. Not installed.
//
// As for a cloth (cloth_grid.hpp) the step minimises an incremental potential by Newton's method, from where
// particles would be without forces, but each step of Newton's method is solved exactly (elimination.hpp) and
// in double precision. Links and ties are springs so stiff that what they carry does not show; the tension of
// the previous substep makes them stiff sideways.
#pragma once

#include "rope/implicit_step.hpp"

namespace tendril::rope {

class TiedSolver : ImplicitStep {
  public:
    explicit TiedSolver(const IslandStep& step);

    /// Solves the island's particles, from `base`; returns the steps of Newton's method.
    int solve(int iterations);
    bool converged() const { return converged_; }
    bool shortened() const { return taken_ < 1.0; }  ///< the last step was not taken as a whole

  private:
    /// Of two particles: the force of a spring between them, over its stiffness, and what it resists.
    struct Spring {
        std::uint32_t a, b, block;
        double rest, stiffness, multiplier;
        bool stiff;
    };
    template <class Visit>
    void each_spring(Visit visit);

    void assemble(bool first);
    void add_contacts();
    void add(std::uint32_t particle, const detail::Symmetric3& matrix, const glm::dvec3& force);
    void step(bool first);
    void go(double part);
    void note_tensions(bool exact);
    double potential();
    void keep_centre();

    const Plan::Tied& tied_;
    detail::EliminationSystem& system_;
    double taken_ = 1.0;
    double turned_ = 0.0;  ///< in the last step: of a stiff link, relative to its length
    bool converged_ = true;
};

}  // namespace tendril::rope
