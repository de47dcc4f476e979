// The plan for solving a world's links: which bodies together, which links as chains, and which chains side
// by side. Depends on bodies and links alone. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rope/elimination.hpp"
#include "tendril/rope/state.hpp"

namespace tendril::rope {

struct Plan {
    /// Part of one of the lists below.
    struct Range {
        std::uint32_t first = 0, count = 0;
    };
    /// Bodies that no link, tie or collision joins to any other. Nothing in a substep reaches from one island
    /// to another, so islands can be solved in any order and in parallel. Bodies whose chains are all
    /// isolated are merged to fill registers.
    struct Island {
        Range bodies{}, links{}, soft{}, chains{}, groups{}, chunks{}, ties{};
        /// In `parts`: parts joined only by collisions with cloth are solved one after the other. Empty: all
        /// at once.
        Range parts{};
        std::uint32_t particles = 0;
        bool isolated = false;   ///< every chain is isolated, and there are no soft links
        std::uint32_t grid = 0;  ///< 1-based index in `grids` of the one with all its links; 0: none
        std::uint32_t tied = 0;  ///< 1-based index in `tied` if it has ties; 0: none
        /// 1-based index in Scratch::body_contacts if its bodies collide with each other; 0: none
        std::uint32_t contacts = 0;
    };
    /// Tied bodies: the order in which their system is solved, without those that are grids.
    struct Tied {
        Range grids{};
        detail::Elimination order;
        std::vector<std::uint32_t> link_blocks, tie_blocks;  ///< per link and tie of the island, or no_block
        std::vector<std::uint32_t> across;                   ///< ties of a grid to anything
        /// Where a rope resists bending: three particles, the link between the last two, and the blocks of
        /// each with the next: ab, bc, ca.
        struct Bend {
            std::array<std::uint32_t, 3> points{};
            std::uint32_t link = 0, body = 0;
            std::array<std::uint32_t, 3> blocks{};
        };
        std::vector<Bend> bends;
    };
    static constexpr std::uint32_t no_block = 0xffffffffu;
    /// Consecutive stretch links: each begins at the particle where the previous one ends.
    struct Chain {
        std::uint32_t first_link = 0, links = 0;
        std::uint32_t first_node = 0;  ///< in `nodes`, links + 1 of them
        std::uint32_t body = 0;
        bool isolated = false;  ///< no other link touches its particles
    };
    /// Chains of an island, of equal length, that share no particle; contiguous in `chains`.
    struct Group {
        std::uint32_t first_chain = 0, chains = 0;
    };
    /// Consecutive particles of one body: the unit of the search for colliders.
    struct Chunk {
        std::uint32_t first = 0, count = 0, body = 0;
        std::uint32_t first_link = 0, links = 0;  ///< in `chunk_links`: stretch links that begin in it
        float reach = 0.0f;                       ///< rest length of the longest of them
    };

    /// A cloth with no links outside its grid.
    struct Grid {
        std::uint32_t body = 0, columns = 0, rows = 0;
        Range links{};  ///< in `grid_links`
        Range cells{};  ///< in `grid_cells`
    };
    /// The position of a link in the arrays of its grid's system.
    struct GridLink {
        std::uint32_t link = 0, cell = 0, step = 0;
    };

    Plan() = default;
    explicit Plan(const State& state);
    /// Whether a new plan of this state would be the same.
    bool fits(const State& state) const noexcept;
    template <class T>
    static std::span<const T> part(const std::vector<T>& list, const Range& range) {
        return std::span<const T>(list).subspan(range.first, range.count);
    }
    /// The parts of an island, or the island itself.
    std::span<const Island> parts_of(const Island& island) const {
        return island.parts.count == 0 ? std::span(&island, 1) : part(parts, island.parts);
    }
    /// Calls `visit` with each part or island that is solved at once.
    template <class Visit>
    void each_part(Visit visit) {
        for (Island& island : islands)
            if (island.parts.count == 0) visit(island);
        for (Island& each : parts) visit(each);
    }

    std::vector<Island> islands, parts;
    // The elements of an island are contiguous in each list, in the state's order.
    std::vector<std::uint32_t> bodies, links;
    std::vector<std::uint32_t> soft;  ///< links other than stretch links
    std::vector<Chain> chains;
    std::vector<Group> groups;
    std::vector<Chunk> chunks;
    std::vector<Grid> grids;
    std::vector<GridLink> grid_links;
    std::vector<std::uint32_t> grid_cells;  ///< cell of each particle in its grid's system

    std::vector<std::uint32_t> ties;
    std::vector<Tied> tied;
    std::vector<std::uint32_t> system_index;  ///< per tied particle: place in its system's order, or cell
    std::vector<std::uint32_t> grid_of;       ///< 1-based index of each body in `grids`; 0: none

    /// The bodies, from itself on, that each body collides with, ascending: `collides_with` has them from the
    /// body's entry in `collides_first` on. These and the next four are empty if nothing collides.
    std::vector<std::uint32_t> collides_first, collides_with;
    /// For each body, whether its contacts are solved with its lengths or projected afterwards.
    enum class Collides : std::uint8_t { None, Solved, Projected };
    std::vector<Collides> collides;
    std::vector<std::uint8_t> collides_with_cloth;  ///< whether each body collides with a cloth
    std::vector<std::uint32_t> chain_of;            ///< chain of each link; unused for soft links
    std::vector<glm::dvec3> rest_at;                ///< unstrained position of each particle in its body
    std::uint32_t colliding = 0;                    ///< islands with collisions
    bool collide(std::uint32_t body_a, std::uint32_t body_b) const noexcept;

    std::vector<std::uint32_t> nodes;
    std::vector<std::uint32_t> chunk_links;
    /// Faces for the air, by particle. `below`: the particle below in a cloth, the next one in a rope or
    /// hair, if a whole cell (two triangles) or segment begins here, with all its stretch links; else 0.
    /// `faces`: how many such triangles or segments the particle has.
    std::vector<std::uint32_t> below;
    std::vector<std::uint8_t> faces;
    std::uint32_t longest = 0;  ///< links in the longest chain
    bool tears = false;

  private:
    void find_chains(const State& state);
    void find_faces(const State& state);
    void cut_into_chunks(const State& state);
    void group_chains(std::size_t particles);
    void order_tied(const State& state);
    void index_collisions(const State& state);
    void number_chains(std::size_t count);

    // The inputs of the plan.
    struct Joined {
        std::uint32_t a, b;
        float rest;
        Link::Kind kind;
    };
    struct Particles {
        std::size_t first, count, row;
        std::vector<std::uint32_t> cells;
        bool tears, bends;
    };
    std::vector<Joined> joined_;  ///< links
    std::vector<detail::Elimination::Edge> tied_;
    std::vector<Particles> ranges_;  ///< bodies
    std::vector<Collision> collisions_;
    std::size_t particles_ = 0;
};

}  // namespace tendril::rope
