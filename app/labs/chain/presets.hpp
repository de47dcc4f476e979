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
    std::size_t count;  ///< default number of segments
    int of;             ///< buttons in its row of the panel
};

/// The preset that is more than a chain, and the scene that the program opens with.
inline constexpr const char* reaching_arm = "reaching_arm";

const std::vector<Preset>& presets();

/// Throws std::invalid_argument for an unknown name. Only "random" uses `seed`.
Chain make_preset(const std::string& name, std::size_t count, std::uint32_t seed);

/// Completes the preset reaching_arm: mode Reach, a hinge at the elbow, a pole target above it, and the hand
/// on the target. `part` already has the preset's chain.
void make_it_reach(ChainPart& part, ChainRuntime& runtime);

}  // namespace tendril::app
