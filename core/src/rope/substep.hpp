// One fixed substep of one island. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rope/scratch.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

namespace detail {

/// The part of the way to a goal that is covered in `h`, with `seconds` left to get there.
inline double part_of(double h, double& seconds) {
    const double part = seconds > h * (1.0 + 1e-6) ? h / seconds : 1.0;
    seconds = part < 1.0 ? seconds - h : 0.0;
    return part;
}

}  // namespace detail

class Substep : IslandStep {
  public:
    /// Adds its report to `local.done`.
    Substep(State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
            IslandScratch& local);
    /// `measures`: bodies get their length error at the end.
    void run(bool measures);

  private:
    Substep(const Substep& whole, const Plan::Island& part);

    /// A contact or correction that moves a body faster than this, m/s, would throw it.
    static constexpr double correction_speed = 2.0;

    // substep.cpp
    void move_particles();
    void measure();
    void clamp_to_world();
    void commit();
    int passes_allowed() const;

    // wind.cpp
    struct Air {
        glm::dvec3 by;  ///< in the substep, metres
        double gusts;   ///< their maximum, in the same unit
    };
    void apply_wind();
    /// A triangle of a cloth, or a segment of a rope or hair.
    struct Face {
        double mass = 0.0;
        glm::dvec3 flow{0.0};  ///< displacement of the air past it in the substep
    };
    Face face_of(std::span<const std::size_t> corners, const Air& air) const;
    void wind_on_cloth(const Body& body, const Air& air);
    void wind_on_strands(const Body& body, const Air& air);
    void wind_on_triangle(const std::array<std::size_t, 3>& corners, const Air& air);
    void wind_on_segment(const std::array<std::size_t, 2>& ends, double thickness, const Air& air);
    void add_wind(std::span<const std::size_t> corners, const glm::dvec3& by);

    // contact.cpp: finds near colliders, and keeps bodies that are not solved with their contacts out of them
    void find_near();
    void resolve_contacts(bool first);
    void resolve_particle(std::uint32_t i, std::uint32_t collider, std::uint32_t body, bool first);
    void resolve_link(const Link& link, std::uint32_t collider, std::uint32_t body);
    void record_impact(std::uint32_t body, double depth);
    void apply_friction(std::uint32_t i, std::uint32_t body);  ///< Coulomb's friction
    Touch& touch(std::uint32_t i, std::uint32_t collider, const glm::dvec3& normal);

    // impulses.cpp
    void push_touched();
    void push_attached();

    // depenetration.cpp: particles still inside after the last pass
    void depenetrate();
    template <class Visit>
    void each_near(std::size_t first, std::size_t end, Visit visit);
    double depth_of(const Plan::Chain& chain, const std::vector<glm::dvec3>& at);

    // relax.cpp: one link after the other
    int relax();
    void record_overstretch();
    void satisfy(std::uint32_t link, double compliance);
    void satisfy_soft();
    void satisfy_ties();

    // direct.cpp: whole chains at once
    struct Batch;
    int direct();
    int direct_part();
    void project_contacts();
    int direct_isolated();
    int direct_grid();
    int direct_tied();
    double solve_group(const Plan::Group& group, int iteration);
    double solve_batch(const Batch& batch, int iteration);
    bool accepts(std::uint32_t chain, double tolerance, bool bounded);
    void solve_again(std::uint32_t chain);
    double backward() const;
    void relax_failed_bodies();
    void shorten_steps();
    void shorten_step(std::uint32_t chain);
    double correction_scale(const Plan::Chain& chain) const;
    void scale_correction(const Plan::Chain& chain);
    void gather(const detail::Block& block, const Batch& batch) const;
    void scatter(const detail::Block& block, std::uint32_t lane, std::uint32_t chain);
    /// Whether contacts displace a body after its lengths are solved, not together with them.
    bool has_fallback_contact(std::uint32_t body) const { return !island_.isolated && is_near(body); }
    bool is_near(std::uint32_t body) const { return scratch_.body_near[body] != Scratch::Nearest::None; }

    // energy.cpp
    class Ledger;
    using Slowdown = Scratch::Slowdown;
    Ledger ledger_of(Group group) const;
    void add_part(Ledger& ledger, const Plan::Island& part) const;
    bool tied_in_grid(const Plan::Island& part, std::size_t link) const;
    void add_chain(Ledger& ledger, const Plan::Chain& chain) const;
    void restore_momentum();
    void limit_energy();
    Slowdown limit_gain(const Ledger& ledger);
    void apply_slowdown();

    Advance& report_;
    bool measures_ = false;
    double before_ = 1.0;   ///< length of the previous substep relative to this one
    double damping_ = 1.0;  ///< factor on velocity, in the substep
    glm::dvec3 acceleration_;
    bool has_air_;  ///< whether there is air
};

/// The energy that particles and links gain in this substep, in joules.
class Substep::Ledger {
  public:
    Ledger(const Substep& substep, Group group)
        : step_(&substep),
          group_(group),
          near_(substep.nearest_to(group)),
          driven_(near_ == Scratch::Nearest::Moving) {}

    void add_particle(std::size_t i);
    void add_link(std::uint32_t link);
    void add_cloth(const detail::Cloth& cloth);
    void add_bending(const Plan::Chain& chain);
    /// Zero if a moving collider or pin may have done work.
    double gained() const { return driven_ ? 0.0 : gained_; }
    /// Whether the gain exceeds this part of weight times length.
    bool gains_over(double part) const;
    /// Whether slowdown() leaves a gain of more than this part of weight times length, or of the earlier
    /// kinetic energy.
    bool leaves_gain(double part) const;
    Slowdown slowdown() const;
    /// Joules lost to contact. The work of moving colliders cannot be separated from it.
    double contact_loss() const;
    /// Relaxation and XPBD can hold strain energy that is not counted; the bound would make a taut rope sag.
    bool bounds_relaxation() const {
        return near_ == Scratch::Nearest::Impact || (near_ != Scratch::Nearest::None && !strained_);
    }
    /// Whether it fails to fall freely although nothing holds or touches it.
    bool suspended() const;

  private:
    const Substep* step_;
    Group group_;
    Scratch::Nearest near_;
    double gained_ = 0.0, damping_loss_ = 0.0, kinetic_ = 0.0, kinetic_before_ = 0.0, elastic_ = 0.0,
           mass_ = 0.0, length_ = 0.0;
    glm::dvec3 solver_momentum_{0.0};  ///< momentum from all but gravity, times the substep
    double gravity_work_ = 0.0,
           elastic_release_ = 0.0;  ///< energy released by gravity and by links, since halfway
    bool driven_, pinned_ = false, strained_ = false;
};

}  // namespace tendril::rope
