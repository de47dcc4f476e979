// How the links of a world are solved: which follow each other in runs, and which runs can be solved side by
// side. It follows from bodies and links alone. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "tendril/rope/world.hpp"

namespace tendril::rope {

struct World::Plan {
    /// Stretch links that follow each other: each begins at the particle where the one before ended.
    struct Run {
        std::uint32_t first_link = 0, links = 0;
        std::uint32_t first_node = 0;  ///< in `nodes`, links + 1 of them
        std::uint32_t body = 0;
        bool alone = false;  ///< no other link touches its particles
    };
    /// Runs of equal length that share no particle, one after the other in `runs`.
    struct Group {
        std::uint32_t first_run = 0, runs = 0;
        bool alone = false;  ///< all of its runs are
    };
    /// Particles of one body that lie together: what colliders are looked for with.
    struct Chunk {
        std::uint32_t first = 0, count = 0, body = 0;
        std::uint32_t first_link = 0, links = 0;  ///< in `chunk_links`: stretch links that begin in it
        float reach = 0.0f;                       ///< the longest of them
    };

    explicit Plan(const State& state);

    std::vector<std::uint32_t> nodes;
    std::vector<Run> runs;
    std::vector<Group> groups;
    std::vector<std::uint32_t> soft;  ///< links that are no stretch links
    std::vector<Chunk> chunks;
    std::vector<std::uint32_t> chunk_links;
    std::uint32_t longest = 0;  ///< links in the longest run
    bool all_alone = false;     ///< every run is, and there is no soft link
    bool tears = false;

  private:
    void group_runs(std::size_t particles);
    void cut_into_chunks(const State& state);
    void name_bodies(const State& state);
};

}  // namespace tendril::rope
