// Newton's method for one chain among colliders: lengths, contacts and friction at once. Not installed.
//
// A step solves all of them, linearised, as one system (chain_system.hpp). Contacts are planes that touch the
// surface where it is nearest, found anew in every step. Which of them hold is an active set: one comes in
// where a particle is inside, and goes where it would have to pull. Friction (Coulomb's) drags on what slips:
// the normal force times the coefficient over how far it slips, both as last known, which a few steps make
// right (iteratively reweighted least squares). What it holds creeps, by less than anybody sees.
//
// A step that makes a link much longer, or turns it too far to go by its direction, is taken again with links
// that turn less easily (K. Levenberg, 1944), and in the end only in part.
#pragma once

#include <cstdint>

#include "rope/scratch.hpp"

namespace tendril::rope {

class ChainNewton {
  public:
    ChainNewton(const State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
                IslandScratch& local)
        : state_(state), plan_(plan), island_(island), scratch_(scratch), local_(local), s_(local.contact) {}

    /// Finds what a chain may touch in this substep; false where there is nothing.
    bool find(std::uint32_t chain);
    /// Whether it touches any of that where the substep begins, or would on a free way.
    bool touches() const;
    /// Whether it is inside of any of that where the solver has put it.
    bool inside() const;
    /// Moves the chain that was found last from where the substep begins; with no contacts where there are
    /// none.
    void solve();

  private:
    const Scratch::Moving& collider(std::uint32_t number) const { return scratch_.colliders[number]; }
    std::uint32_t particle(std::uint32_t node) const;
    ContactScratch::Contact& contact_of(std::uint32_t node);
    std::span<const IslandScratch::Near> near_of(std::uint32_t particle, std::uint32_t& chunk) const;

    bool link_touches(const ContactScratch::LinkContact& contact, const glm::dvec3& a, const glm::dvec3& b,
                      bool moved) const;
    void begin();
    void begin_plane(ContactScratch::Contact& contact, ContactScratch::Plane& plane);
    bool update_contacts();
    bool update_planes(ContactScratch::Contact& contact);
    void rub(ContactScratch::Contact& contact);
    bool update_link(ContactScratch::LinkContact& contact);
    void rub_link(const ContactScratch::LinkContact& contact);
    void keep();
    void go_back(double part);
    bool went_too_far(double& turned) const;
    void finish(double worst);

    const State& state_;
    const Plan& plan_;
    const Plan::Island& island_;
    Scratch& scratch_;
    IslandScratch& local_;
    ContactScratch& s_;
    std::uint32_t chain_ = 0;
    double radius_ = 0.0;
    bool moved_ = false;   ///< a step was taken since the substep began
    bool may_go_ = false;  ///< contacts may still go again
};

}  // namespace tendril::rope
