// Preset chains.
#pragma once

#include <cstdint>
#include <string>
#include <tendril/chain/chain.hpp>
#include <vector>

namespace tendril::app {

class ChainRuntime;
struct ChainPart;

struct Preset {
    const char* name;
    const char* title;
    std::size_t count;  ///< segments unless told otherwise
    int of;             ///< buttons to its row of the panel
};

/// The preset that is more than a chain; also the scene that the program opens on.
inline constexpr const char* reaching_arm = "reaching_arm";

const std::vector<Preset>& presets();

/// Throws std::invalid_argument for an unknown name. `seed` matters to "random" alone.
Chain make_preset(const std::string& name, std::size_t count, std::uint32_t seed);

/// Of the preset reaching_arm: mode reach, a hinge for an elbow, a pole target above it, and the hand on the
/// target. `part` has the preset's chain.
void make_it_reach(ChainPart& part, ChainRuntime& runtime);

}  // namespace tendril::app
