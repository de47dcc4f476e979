// What is in a workspace; nothing of it is remembered from one substep to the next. Not installed.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/fork_join.hpp"
#include "rope/chain_system.hpp"
#include "rope/cloth_grid.hpp"
#include "rope/direct_block.hpp"
#include "rope/plan.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {

/// A particle's touch with a collider, in one substep.
struct Touch {
    glm::dvec3 normal{0.0};
    glm::dvec3 displacement{0.0};           ///< by the collider so far, metres
    glm::dvec3 collider_displacement{0.0};  ///< of the collider itself, in the substep
    bool touching = false;
};

/// What islands share: each writes what belongs to its own bodies, links, chains and chunks, and nothing
/// else. Colliders have moved before islands are solved.
struct Scratch {
    std::vector<glm::dvec3> place;   ///< where each particle is as yet
    std::vector<glm::dvec3> base;    ///< where it would be without links and colliders
    std::vector<double> weight;      ///< inverse mass; 0: pinned
    std::vector<double> multiplier;  ///< of each link: tension times h^2
    std::vector<Touch> touch;
    /// The colliders near a body. Struck: one at rest displaced it faster than correction_speed.
    enum class Nearest : std::uint8_t { None, Resting, Struck, Moving };
    std::vector<Nearest> body_near;
    std::vector<std::uint8_t> body_failed;  ///< whether a body could not be solved
    std::vector<glm::dvec3> chunk_low, chunk_high;
    struct Moving {
        const Shape* shape = nullptr;  ///< at the end of the substep
        glm::dvec3 by{0.0};            ///< in the substep
        glm::dvec3 low{0.0}, high{0.0};
        double size = 0.0;
        glm::dvec3 turn{0.0};  ///< of a capsule: by how much more than `by` its end b has moved, and a less

        /// How far the shape has moved at the point of it that is nearest to `at`.
        glm::dvec3 by_at(const glm::dvec3& at) const;
        /// The distance of `at`, where a particle came from `was` in the substep. Something fast is put
        /// back to where it touches first, on the side that it came from.
        SurfaceDistance entered(const glm::dvec3& was, glm::dvec3& at, double radius,
                                std::uint64_t& work) const;
        bool moves() const { return by != glm::dvec3(0.0) || turn != glm::dvec3(0.0); }
        /// Whether a ball is wholly beyond where the shape is or was in the substep.
        bool far_from(const glm::dvec3& at, double radius) const {
            return at.x + radius < low.x || at.y + radius < low.y || at.z + radius < low.z ||
                   at.x - radius > high.x || at.y - radius > high.y || at.z - radius > high.z;
        }
    };
    std::vector<Moving> colliders;
    std::vector<std::uint8_t> chain_solved;  ///< whether a chain is solved with what it touches
    std::vector<double> chain_error;         ///< of each chain: relative length error after its last pass
    /// Factors on the mean velocity of some particles, on what differs from it, and on the tension of a
    /// cloth's links.
    struct Slowed {
        glm::dvec3 mean{0.0};  ///< of their displacements
        double whole = 1.0, apart = 1.0, tension = 1.0;
        bool any() const { return whole != 1.0 || apart != 1.0 || tension != 1.0; }
    };
    std::vector<Slowed> chain_slowed;
    std::vector<std::uint32_t> collider_at;  ///< where a slot's collider is in the list
    std::vector<detail::Cloth> cloths;       ///< of the plan's grids
    detail::VectorUnit unit;
    detail::GridUnit grid_unit;
    detail::ClothUnit cloth_unit;
};

/// What solving a chain among colliders takes.
struct ContactScratch {
    /// Of a collider, where it is nearest to a particle.
    struct Plane {
        std::uint32_t collider = 0;
        bool active = false;
        double gap = 0.0;
        glm::dvec3 normal{0.0}, point{0.0};  ///< a particle on the plane touches
        glm::dvec3 by{0.0};                  ///< how far the collider has moved there, in the substep
    };
    struct Contact {
        std::uint32_t node = 0;
        std::uint32_t first = 0, count = 0;  ///< in `planes`
    };
    /// Of colliders so small that a link can touch them between its ends.
    struct LinkContact {
        std::uint32_t bond = 0;
        std::uint32_t first = 0, count = 0;    ///< in `link_colliders`
        std::uint32_t collider = 0xffffffffu;  ///< that it touches
        glm::dvec3 point{0.0};                 ///< on its plane
    };
    struct Kept {
        glm::dvec3 x{0.0};
        double multiplier = 0.0, error = 0.0;
    };
    std::vector<Contact> contacts;  ///< as `holds`, by node
    std::vector<Plane> planes;
    std::vector<LinkContact> link_contacts;  ///< as `bond_holds`, by bond
    std::vector<std::uint32_t> link_colliders;
    std::vector<detail::ChainNode> nodes;
    std::vector<detail::ChainBond> bonds;
    std::vector<detail::NodeContact> holds;
    std::vector<detail::BondContact> bond_holds;
    std::vector<Kept> kept;  ///< nodes and bonds before a step
    std::vector<double> kept_contacts;
};

/// Where a collider holds a particle of a cloth, or a link between its ends.
struct ClothContact {
    std::uint32_t near = 0;      ///< in IslandScratch's
    std::uint32_t a = 0, b = 0;  ///< particles; one and the same, or a link's
    std::uint32_t link = 0;      ///< of a link: its number
    double t = 0.0;              ///< where it is between them, 0: at a
    double force = 0.0;          ///< in the last solve; over 0: it presses
    double gap = 0.0;            ///< from the collider's surface, less the radius of the cloth
    glm::dvec3 normal{0.0};
    glm::dvec3 at{0.0};    ///< where it was found
    glm::dvec3 slip{0.0};  ///< along the surface, in the substep until then
    double drag = 0.0;     ///< against that, in the stiffness of links

    bool is_link() const { return a != b; }
};

/// What solving one island takes; each thread has its own.
struct IslandScratch {
    struct Near {
        std::uint32_t chunk, collider;
    };
    std::vector<Near> near;              ///< chunk by chunk
    std::vector<std::uint32_t> close;    ///< colliders that anything is near
    std::vector<std::uint32_t> touched;  ///< particles with a touch
    std::vector<double> block;           ///< memory of a block
    std::size_t block_offset = 0;
    ContactScratch contact;
    std::vector<ClothContact> cloth_contacts, earlier_contacts;
    /// Of the cloth solved last: roughly its length, metres, and the energy in its links and by how much that
    /// grew, joules.
    struct {
        double length = 0.0, elastic = 0.0, gained = 0.0;
    } cloth_energy;
    tendril::detail::ForkJoin loops;  ///< of a cloth; threads without an island help
    Advance done;                     ///< in this substep; `passes` of the island that took most
};

struct Workspace::Parts {
    Plan plan;
    Scratch scratch;
    std::vector<IslandScratch> threads{1};
    Tasks tasks;
    bool prepared = false;  ///< sizes follow from a plan

    /// Makes everything fit a state.
    void prepare(const State& state);
    /// Links or bodies are other ones now.
    void replan(const State& state);

    // advance.cpp
    /// The rest of a substep once colliders have moved: threads take islands until there are none left.
    void solve_islands(State& state, bool measures);
    /// What the threads did in the substep becomes part of the whole call's report.
    void add_up(Advance& done);
};

}  // namespace tendril::rope
