// The contents of a workspace. Only the lists of candidates outlast a substep, and no result depends on them.
// Not installed.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "math/fork_join.hpp"
#include "rope/chain_system.hpp"
#include "rope/cloth_grid.hpp"
#include "rope/direct_block.hpp"
#include "rope/plan.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// Maximum distance by which solvers move a particle off its free path, metres, and contact distance.
inline constexpr double path_margin = 1e-3, touch_distance = 1e-5;
/// Penetration, metres, that a cloth or a chain with bending stiffness may keep: moving one particle would
/// strain or bend it, and the next substep turn that into motion.
inline constexpr double penetration_slop = 5e-5;

/// A displacement of particles as one rigid whole: the mean, and a rotation about the centre of mass.
struct RigidMotion {
    glm::dvec3 centre{0.0}, mean{0.0}, spin{0.0};
    double energy = 0.0;  ///< kinetic, times h^2
    glm::dvec3 at(const glm::dvec3& x) const { return mean + detail::cross(spin, x - centre); }
};

/// A particle's contact with a collider in one substep.
struct Touch {
    glm::dvec3 normal{0.0};
    glm::dvec3 displacement{0.0};           ///< by the collider so far, metres
    glm::dvec3 collider_displacement{0.0};  ///< displacement of the collider in the substep
    std::uint32_t collider = 0;
    bool touching = false;
    /// The displacement by the first collider, and by all others as if by the second.
    struct Share {
        std::uint32_t collider = 0;
        glm::dvec3 moved{0.0};
    };
    std::array<Share, 2> shares{};
    void record(std::uint32_t by, const glm::dvec3& moved) {
        Share& share = shares[by == collider ? 0 : 1];
        share.collider = by;
        share.moved += moved;
    }
};

/// An impulse of a particle on a collider.
struct Push {
    std::uint32_t collider = 0, island = 0;
    glm::dvec3 impulse{0.0}, at{0.0};
};

/// Memory for solving a chain among colliders.
struct ContactScratch {
    /// The tangent plane of a collider nearest to a particle.
    struct Plane {
        std::uint32_t collider = 0;
        bool active = false;
        double gap = 0.0;
        glm::dvec3 normal{0.0}, point{0.0};  ///< a particle on the plane touches
        glm::dvec3 by{0.0};                  ///< displacement of the collider there, in the substep
    };
    struct Contact {
        std::uint32_t node = 0;
        std::uint32_t first = 0, count = 0;  ///< in `planes`
        bool deferred = false;               ///< for a deeper contact nearby
        double drag = 0.0;                   ///< its own friction, as in NodeContact
    };
    /// A contact with colliders so small that a link can touch them between its ends.
    struct LinkContact {
        struct Touch {
            std::uint32_t collider = 0xffffffffu;
            glm::dvec3 point{0.0};  ///< on its plane
            double drag = 0.0;      ///< friction, as in NodeContact
        };
        std::uint32_t bond = 0;
        std::uint32_t first = 0, count = 0;                            ///< in `link_colliders`
        std::array<Touch, detail::ChainBond::max_contacts> touches{};  ///< parallel to its effects
    };
    struct Saved {
        glm::dvec3 x{0.0};
        double multiplier = 0.0, error = 0.0;
    };
    std::vector<Contact> contacts;  ///< parallel to `node_effects`, by node
    std::vector<Plane> planes;
    std::vector<LinkContact> link_contacts;  ///< by bond
    std::vector<std::uint32_t> link_colliders;
    std::vector<detail::ChainNode> nodes;
    std::vector<detail::ChainBond> bonds;
    std::vector<detail::NodeContact> node_effects;
    std::vector<detail::BondContact> bond_effects;  ///< max_contacts for each of `link_contacts`
    std::vector<detail::ChainBend> bends;           ///< by node; empty if the body does not resist bending
    std::vector<Saved> saved;                       ///< nodes and bonds before a step
    std::vector<double> saved_contacts;
    std::vector<detail::NodePush> pushes;  ///< by contacts with other segments
    /// Progress of the solve.
    struct {
        double mass = 0.0;    ///< of the chain
        double excess = 0.0;  ///< of friction over its limit, in all
        double extra_stiffness = 0.0, used_stiffness = 0.0, turn = 1.0, worst = 0.0;
        int steps_taken = 0, rejected = 0, divergences = 0;
        bool moved = false;        ///< a step was taken
        bool may_release = false;  ///< contacts may still be dropped
    } progress;
};

/// The forces of ties that join grids to anything, as unknowns of a small dense system.
struct TieForces {
    struct End {
        enum class Of : std::uint8_t { Pinned, Grid, Node } of = Of::Pinned;
        std::uint32_t grid = 0;  ///< index in the island's grids
        std::uint32_t at = 0;    ///< a cell, or a place in the order of elimination
        double sign = 1.0;       ///< sign of its displacement in the tie's
    };
    std::vector<std::array<End, 2>> ends;                ///< by tie
    std::vector<glm::dvec3> gap, now, direction, total;  ///< by tie: metres; the others are forces
    detail::DenseSystem system;                          ///< how far forces move the ends
    std::vector<double> flat;                            ///< the system's right side
    std::vector<glm::dvec3> local;                       ///< by place in the order of elimination

    void resize(std::size_t ties, std::size_t nodes);
    void solve();  ///< turns `now` from displacements into forces
};

/// Contacts between the bodies of an island.
struct BodyContactScratch {
    /// A particle, segment or triangle, which stays in a ball until the candidates are listed again.
    struct Feature {
        glm::dvec3 middle{0.0};
        double radius = 0.0;
        double reach = 0.0;  ///< the part of the radius added to the feature's own when listed
        std::uint32_t body = 0;
        std::uint32_t link = 0;  ///< a segment's; for a diagonal, a number beyond all links
        std::uint32_t count = 0;
        std::array<std::uint32_t, 3> points{};
    };
    /// Two features that may meet: two segments, or a particle and a triangle.
    struct Candidate {
        std::uint32_t a = 0, b = 0;             ///< links, for segments; a < b
        std::array<std::uint32_t, 4> points{};  ///< particles: two of a and two of b, or one and three
        std::uint32_t split = 2;                ///< how many belong to a
        std::uint32_t body_a = 0, body_b = 0;
        double min_thickness = 0.0;  ///< thickness, metres
        double listed = 0.0;         ///< distance when listed, metres
    };
    /// Candidates that may come near each other in the substep.
    struct Pair : Candidate {
        glm::dvec3 normal{0.0};  ///< from a to b where they are nearest, at the start of the substep
        double distance = 0.0;   ///< distance of centre lines there, metres
        double thickness = 0.0;
        std::array<double, 4> weights{};  ///< of the points, where they are nearest; negative for a
    };
    /// A pair that is nearer than its neighbours are.
    struct Contact : Pair {
        glm::dvec3 force{0.0};  ///< on b, times h^2
        double target = 0.0;    ///< the gap to reach, metres; below 0 while pressed into each other
        double stiffness = 0.0;
    };
    /// A contact as one of its two chains sees it.
    struct Side {
        std::uint32_t chain = 0, bond = 0, contact = 0;
        bool is_b = false;
    };
    glm::dvec3 mean{0.0};  ///< mean displacement of all particles
    // The lists are valid until a particle drifts too far (Scratch::Listed).
    bool listed = false;
    std::vector<float> radii;  ///< radii of the island's bodies
    std::vector<Candidate> candidates;
    std::vector<Feature> features;
    struct Chunk {
        glm::dvec3 low{0.0}, high{0.0};
        std::uint32_t body = 0;
        std::array<std::uint32_t, 4>
            first{};  ///< of its particles, segments, triangles in `features`; the end
    };
    std::vector<Chunk> chunks;                  ///< of colliding bodies, by `low.x`
    std::vector<std::uint32_t> near_a, near_b;  ///< features of two chunks that are in both boxes
    std::vector<Pair> pairs;
    std::vector<Contact> contacts;      ///< solved with the chains
    std::vector<Contact> projected;     ///< by depth
    std::vector<Side> sides;            ///< sorted by chain and bond
    std::vector<std::uint32_t> chains;  ///< solved together
    std::vector<std::uint8_t> reused;   ///< whether a contact continues each State::contacts
};

/// Shared by the islands: each writes only data of its own bodies, links, chains and chunks. Colliders have
/// moved before islands are solved.
struct Scratch {
    std::vector<glm::dvec3> x;          ///< current position of each particle
    std::vector<glm::dvec3> base;       ///< position without links and colliders
    std::vector<glm::dvec3> wind_move;  ///< displacement by the wind in `base`; empty without wind
    std::vector<double> weight;         ///< inverse mass; 0: pinned
    std::vector<double> multiplier;     ///< by link: tension times h^2
    std::vector<Touch> touch;
    /// The colliders near a body. Impact: a resting one displaced it faster than correction_speed.
    enum class Nearest : std::uint8_t { None, Resting, Impact, Moving };
    std::vector<Nearest> body_near;
    std::vector<std::uint32_t> body_group;  ///< an earlier body that contacts join it to, or itself
    std::vector<std::uint8_t> body_failed;  ///< whether a body could not be solved
    std::vector<glm::dvec3> chunk_low, chunk_high;
    struct Moving {
        const Shape* shape = nullptr;  ///< at the end of the substep
        glm::dvec3 by{0.0};            ///< displacement in the substep
        glm::dvec3 low{0.0}, high{0.0};
        double size = 0.0;
        glm::dvec3 turn{0.0};  ///< a capsule's end b moves this much further than `by`, end a this much less
        bool spins = false;
        glm::dquat inverse_spin{1.0, 0.0, 0.0, 0.0};  ///< rotates back to the start of the substep
        glm::dvec3 middle{0.0};                       ///< centre of the spin at the end of the substep

        /// The displacement of the shape at its point nearest to `at`.
        glm::dvec3 move_at(const glm::dvec3& at) const;
        /// The distance of a particle that moved from `was` to `at` in the substep. If it is fast, moves `at`
        /// back to where it first touches, on the side that it came from.
        SurfaceDistance sweep(const glm::dvec3& was, glm::dvec3& at, double radius,
                              std::uint64_t& work) const;
        /// A segment, or a particle if both ends are the same, relative to the shape.
        using Segment = std::array<glm::dvec3, 2>;
        /// A touch of a segment: the part along it, the point there, and the surface.
        struct At {
            double along = 0.0;
            glm::dvec3 point{0.0};
            SurfaceDistance surface;
        };
        /// Where, between its ends, a moving segment first touches. None if it moves so little that its final
        /// position still shows which side it came from.
        std::optional<At> first_touch(const Segment& from, const Segment& to, double radius,
                                      std::uint64_t& work) const;
        /// Where, between its ends, a resting segment is nearest, if nearer than `reach`.
        std::optional<At> nearest(const Segment& at, double reach, std::uint64_t& work) const;
        bool moves() const { return by != glm::dvec3(0.0) || turn != glm::dvec3(0.0) || spins; }
        /// Whether a ball is entirely beyond the shape's bounds in the substep.
        bool far_from(const glm::dvec3& at, double radius) const {
            return at.x + radius < low.x || at.y + radius < low.y || at.z + radius < low.z ||
                   at.x - radius > high.x || at.y - radius > high.y || at.z - radius > high.z;
        }
    };
    std::vector<Moving> colliders;
    std::vector<std::uint8_t> chain_solved;  ///< whether a chain is solved with its contacts
    std::vector<double> chain_error;         ///< by chain: relative length error after its last pass
    /// Factors on the motion of some particles as a whole, on the deviations from it, and on the tension of
    /// links.
    struct Slowdown {
        RigidMotion whole;
        double whole_factor = 1.0, relative_factor = 1.0, tension_factor = 1.0;
        double remaining_gain = 0.0;  ///< joules of gain that slowing leaves
        bool any() const { return whole_factor != 1.0 || relative_factor != 1.0 || tension_factor != 1.0; }
    };
    std::vector<BodyContactScratch> body_contacts;  ///< by island of the plan with collisions
    /// A particle that may collide: its position when candidates were listed, the drift and travel per
    /// substep that they allow, metres; and its drift, free travel and move by the solver in this substep,
    /// squared.
    struct Listed {
        glm::dvec3 at{0.0};
        double max_drift = 0.0, reach = 0.0, drifted = 0.0, travel = 0.0, moved = 0.0;
    };
    std::vector<Listed> listed;                   ///< by particle; empty if nothing collides
    std::vector<ContactScratch> chain_contacts;   ///< by chain; empty if nothing collides
    std::vector<std::uint32_t> collider_at;       ///< list index by slot
    std::vector<detail::Cloth> cloths;            ///< by grid of the plan
    std::vector<detail::EliminationSystem> tied;  ///< by tied bodies of the plan
    std::vector<TieForces> tie_forces;            ///< by tied bodies of the plan
    std::vector<glm::dvec3> tied_step;            ///< by particle: a step of the tied solver; else empty
    std::vector<double> tie_multiplier;           ///< by tie: tension times h^2
    detail::VectorUnit unit;
    detail::GridUnit grid_unit;
    detail::ClothUnit cloth_unit;
};

/// A contact of a collider with a particle of a cloth, or with a link between its ends.
struct ClothContact {
    std::uint32_t near = 0;      ///< index in IslandScratch::near
    std::uint32_t a = 0, b = 0;  ///< particles: the same one twice, or a link's ends
    std::uint32_t link = 0;      ///< a link's index
    double t = 0.0;              ///< position between them, 0: at a
    double force = 0.0;          ///< in the last solve; over 0 in compression
    double gap = 0.0;            ///< from the collider's surface, less the radius of the cloth
    glm::dvec3 normal{0.0};
    glm::dvec3 at{0.0};    ///< where it was found
    glm::dvec3 slip{0.0};  ///< along the surface, since the substep began
    double drag = 0.0;     ///< against the slip, in the unit of link stiffness

    bool is_link() const { return a != b; }
};

/// A contact within a cloth, where it is now: its features press on each other like a spring.
struct ClothSelfContact {
    std::array<std::uint32_t, 4> points{};
    std::array<double, 4> weights{};
    glm::dvec3 normal{0.0};
    double along = 0.0, across = 0.0;  ///< stiffness along the normal, and along the surface
    double gap = 0.0;                  ///< beyond the target gap, metres
    glm::dvec3 at{0.0};                ///< from a to b, where it was found
    glm::dvec3 slip{0.0};              ///< along the surface, since the substep began
};

/// Memory for solving one island; each thread has its own.
struct IslandScratch {
    struct Near {
        std::uint32_t chunk, collider;
    };
    std::vector<Near> near;              ///< chunk by chunk
    std::vector<std::uint32_t> close;    ///< colliders near anything
    std::vector<std::uint32_t> touched;  ///< particles in contact
    std::vector<double> block;           ///< memory of a block
    std::size_t block_offset = 0;
    ContactScratch contact;
    std::vector<ClothContact> cloth_contacts, earlier_contacts;
    std::vector<ClothSelfContact> self_contacts;
    /// A part of the island, or a chain of an isolated part. Contacts join members to a group, which keeps
    /// momentum and energy as one.
    struct Member {
        static constexpr std::uint32_t no_chain = 0xffffffffu;
        std::uint32_t group = 0, part = 0, chain = no_chain;
        std::optional<Scratch::Slowdown> slowdown{};  ///< empty until its energy is balanced
    };
    std::vector<Member> members;  ///< by group
    bool records_pushes = false;
    std::vector<Push> pushes;         ///< in this substep, of all the thread's islands
    std::size_t next_push = 0;        ///< while impulses are added up
    std::uint32_t island = 0;         ///< its index in the plan
    bool attached = false;            ///< a particle of the island is attached to a collider
    bool at_edge = false;             ///< a particle is near the edge of the world, which may hold it
    tendril::detail::ForkJoin loops;  ///< over a cloth; idle threads help
    Advance done;                     ///< in this substep; `passes`: maximum over the islands

    void push(std::uint32_t collider, const glm::dvec3& impulse, const glm::dvec3& at) {
        pushes.push_back({collider, island, impulse, at});
    }
};

/// The data that an island's solvers share in one fixed substep. They write only the island's own data, so
/// that others can be solved at the same time.
class IslandStep {
  protected:
    IslandStep(State& state, const Plan& plan, const Plan::Island& island, Scratch& scratch,
               IslandScratch& local)
        : state_(state),
          plan_(plan),
          island_(island),
          scratch_(scratch),
          local_(local),
          h_(state.settings.substep) {}
    IslandStep(const IslandStep& whole, const Plan::Island& part)
        : IslandStep(whole.state_, whole.plan_, part, whole.scratch_, whole.local_) {}

    template <class Visit>
    void each_particle(Visit visit) const {
        each_particle_of(island_, visit);
    }
    template <class Visit>
    void each_particle_of(const Plan::Island& island, Visit visit) const {
        for (const std::uint32_t body : Plan::part(plan_.bodies, island.bodies)) {
            const std::size_t first = state_.bodies[body].first, end = first + state_.bodies[body].count;
            for (std::size_t i = first; i < end; ++i) visit(i);
        }
    }
    using Member = IslandScratch::Member;
    using Group = std::span<const Member>;
    template <class Visit>
    void each_particle_of(Group group, Visit visit) const {
        for (const Member& each : group) {
            if (each.chain == Member::no_chain) {
                each_particle_of(plan_.parts_of(island_)[each.part], visit);
                continue;
            }
            const Plan::Chain& chain = plan_.chains[each.chain];
            for (std::uint32_t k = 0; k <= chain.links; ++k) visit(plan_.nodes[chain.first_node + k]);
        }
    }
    template <class Visit>
    void each_group(Visit visit) const {
        const std::span<Member> all = local_.members;
        for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
            while (end < all.size() && all[end].group == all[first].group) ++end;
            visit(all.subspan(first, end - first));
        }
    }

    // momentum.cpp
    void list_members();
    Scratch::Nearest nearest_to(Group group) const;
    /// Whether nothing outside a group may hold it: no pin, no collider, not the edge of the world.
    bool is_free(Group group) const;
    /// The rigid motion with the momentum of `move`, a displacement by particle, and with its angular
    /// momentum about the positions `at`. It does not turn at all if it would by more than `max_turn`,
    /// radians: particles move in straight lines, which would lengthen links.
    template <class Move>
    RigidMotion rigid_motion(Group group, const std::vector<glm::dvec3>& at, Move move,
                             double max_turn = 0.1) const;

    State& state_;
    const Plan& plan_;
    const Plan::Island& island_;
    Scratch& scratch_;
    IslandScratch& local_;
    double h_;
};

template <class Move>
RigidMotion IslandStep::rigid_motion(Group group, const std::vector<glm::dvec3>& at, Move move,
                                     double max_turn) const {
    RigidMotion whole;
    double mass = 0.0;
    glm::dvec3 origin(0.0), centre(0.0), turn(0.0);
    detail::Symmetric3 inertia;
    each_particle_of(group, [&](std::size_t i) {
        const double m = state_.mass[i];
        if (mass == 0.0) origin = at[i];
        const glm::dvec3 from = at[i] - origin, by = move(i);
        mass += m;
        centre += m * from;
        whole.mean += m * by;
        turn += m * detail::cross(from, by);
        inertia.add(-m, from, from);
    });
    centre *= 1.0 / mass, whole.mean *= 1.0 / mass;
    whole.centre = origin + centre;
    whole.energy = 0.5 * mass * detail::dot(whole.mean, whole.mean);
    if (max_turn == 0.0) return whole;
    turn -= mass * detail::cross(centre, whole.mean);
    inertia.add(mass, centre, centre);
    constexpr double thin = 1e-12;  // keeps the inertia of collinear particles invertible
    const double all = -(1.0 + thin) * (inertia.xx + inertia.yy + inertia.zz);
    inertia.add({all, 0.0, 0.0, all, 0.0, all});
    const glm::dvec3 spin = detail::inverse_of(inertia) * turn;
    if (!(detail::length(spin) <= max_turn)) return whole;
    whole.spin = spin;
    whole.energy += 0.5 * detail::dot(spin, turn);
    return whole;
}

struct Workspace::Parts {
    Plan plan;
    Scratch scratch;
    std::vector<IslandScratch> threads{1};
    Tasks tasks;
    std::vector<TornLink> torn;             ///< in the last advance()
    std::vector<ColliderImpulse> impulses;  ///< in the last advance(), by collider
    /// Sizes match the plan, and the last advance() was not cut short.
    bool prepared = false;

    /// Adapts everything to a state.
    void prepare(const State& state);
    /// Call after links or bodies have changed.
    void replan(const State& state);

    // advance.cpp
    /// The rest of a substep after colliders have moved: threads take islands until none is left.
    void solve_islands(State& state, bool measures);
    /// Adds the threads' work in the substep to the report of the call.
    void sum_reports(Advance& done);
    void store_contacts(State& state);
    // impulses.cpp
    void begin_impulses(const State& state, bool record);
    void add_impulses(const State& state);
    std::span<const ColliderImpulse> reported_impulses();
};

}  // namespace tendril::rope
