// Newton's method for one chain among colliders: lengths, contacts and friction together. Not installed.
//
// Each step linearises all of them and solves one system (chain_system.hpp). A contact is the tangent plane
// at the nearest point of a surface, recomputed in every step. An active set decides which contacts hold: one
// is added when a particle is inside, and dropped when it would have to pull. Friction (Coulomb's) is a drag
// on slip: the normal force times the coefficient over the slip distance, both from the last step, which
// converges in a few steps (iteratively reweighted least squares). Contacts that stick creep invisibly.
//
// A step that lengthens a link too much, or turns it too far for its linearisation, is repeated with extra
// sideways stiffness (K. Levenberg, 1944), and finally cut. If it keeps diverging, the stiffness stays.
#pragma once

#include <cstdint>
#include <vector>

#include "rope/scratch.hpp"

namespace tendril::rope {

class ChainNewton {
  public:
    ChainNewton(const State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
                IslandScratch& local)
        : ChainNewton(state, plan, island, scratch, local, local.contact) {}
    /// Uses the chain's own scratch, so that several chains can be solved in turns.
    ChainNewton(const State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
                IslandScratch& local, ContactScratch& own)
        : state_(state), plan_(plan), island_(island), scratch_(scratch), local_(local), s_(own) {}

    /// Finds the colliders that a chain may touch in this substep; false if there are none.
    bool find(std::uint32_t chain);
    /// Whether the chain touches a collider at the start of the substep, or would on a free path.
    bool touches() const;
    /// Whether the solver's result is inside a collider.
    bool inside() const;
    /// Solves the chain that was found last, starting at the beginning of the substep; without contacts if
    /// there are none.
    void solve();

    // The same in parts. Between steps the caller sets the pushes of other chains on nodes.
    void open(std::uint32_t chain);  ///< a chain that was found earlier
    void begin();
    /// Returns whether it took a step. `pushes_changed`: since the last one. `force_step`: even if converged.
    bool step(bool pushes_changed, bool force_step);
    void finish();

  private:
    const Scratch::Moving& collider(std::uint32_t number) const { return scratch_.colliders[number]; }
    double thickness(std::uint32_t number) const { return 0.5 * collider(number).size + radius_; }
    std::uint32_t particle(std::uint32_t node) const;
    ContactScratch::Contact& contact_of(std::uint32_t node);
    std::span<const IslandScratch::Near> near_of(std::uint32_t particle, std::uint32_t& chunk) const;

    Scratch::Moving::Segment start_of(std::uint32_t bond, const Scratch::Moving& moving) const;
    bool link_touches(const ContactScratch::LinkContact& contact, const std::vector<glm::dvec3>& to) const;
    void begin_plane(ContactScratch::Contact& contact, ContactScratch::Plane& plane);
    bool rests() const;  ///< whether contacts keep their normals
    bool update_contacts();
    void measure_planes(const ContactScratch::Contact& contact);
    void choose_deepest();
    bool update_planes(ContactScratch::Contact& contact);
    bool set_drag(double& drag, double limit, double slip, bool sums);
    bool apply_friction(ContactScratch::Contact& contact, bool sums);
    bool holds_end(const ContactScratch::LinkContact& contact, std::uint32_t collider, double at) const;
    std::span<detail::BondContact> effects_of(const ContactScratch::LinkContact& contact) const {
        const auto first = static_cast<std::size_t>(s_.bonds[contact.bond].contact);
        return std::span(s_.bond_effects).subspan(first, contact.touches.size());
    }
    bool update_link(ContactScratch::LinkContact& contact);
    bool apply_link_friction(std::uint32_t bond, ContactScratch::LinkContact::Touch& touch,
                             const detail::BondContact& effect, bool sums);
    void push_colliders() const;
    void push_planes(const ContactScratch::Contact& contact, const detail::NodeContact& effect,
                     double per_substep) const;
    void begin_bends();
    void save_state();
    void scale_step(double part);
    bool has_diverged(double& turn) const;
    detail::ChainSystem system() const {
        return {s_.nodes, s_.bonds, s_.node_effects, s_.bond_effects, s_.pushes, s_.bends};
    }

    const State& state_;
    const Plan& plan_;
    const Plan::Island& island_;
    Scratch& scratch_;
    IslandScratch& local_;
    ContactScratch& s_;
    std::uint32_t chain_ = 0;
    double radius_ = 0.0;
};

}  // namespace tendril::rope
