// How the links of a world are solved: which follow each other in constraint chains, and which chains can be
// solved side by side. It follows from bodies and links alone. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "tendril/rope/state.hpp"

namespace tendril::rope {

struct Plan {
    /// Stretch links that follow each other: each begins at the particle where the one before ended.
    struct Chain {
        std::uint32_t first_link = 0, links = 0;
        std::uint32_t first_node = 0;  ///< in `nodes`, links + 1 of them
        std::uint32_t body = 0;
        bool alone = false;  ///< no other link touches its particles
    };
    /// Chains of equal length that share no particle, one after the other in `chains`.
    struct Group {
        std::uint32_t first_chain = 0, chains = 0;
        bool alone = false;  ///< all of its chains are
    };
    /// Particles of one body that lie together: what colliders are looked for with.
    struct Chunk {
        std::uint32_t first = 0, count = 0, body = 0;
        std::uint32_t first_link = 0, links = 0;  ///< in `chunk_links`: stretch links that begin in it
        float reach = 0.0f;                       ///< the longest of them
    };

    Plan() = default;
    explicit Plan(const State& state);
    /// Whether another plan of this state would be the same.
    bool fits(const State& state) const noexcept;

    std::vector<std::uint32_t> nodes;
    std::vector<Chain> chains;
    std::vector<Group> groups;
    std::vector<std::uint32_t> soft;  ///< links that are no stretch links
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> chunk_links;
    std::uint32_t longest = 0;  ///< links in the longest chain
    bool all_alone = false;     ///< every chain is, and there is no soft link
    bool tears = false;

  private:
    void group_chains(std::size_t particles);
    void cut_into_chunks(const State& state);
    void name_bodies(const State& state);

    // What it follows from.
    struct Joined {
        std::uint32_t a, b;
        float rest;
        Link::Kind kind;
    };
    struct Range {
        std::size_t first, count;
        bool tears;
    };
    std::vector<Joined> joined_;  ///< links
    std::vector<Range> ranges_;   ///< bodies
    std::size_t particles_ = 0;
};

}  // namespace tendril::rope
