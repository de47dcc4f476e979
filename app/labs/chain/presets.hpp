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
    std::size_t count;      ///< default number of segments
    int of;                 ///< buttons in its row of the panel; 0: among the rows of mode Curve
    const char* what = "";  ///< after the number of joints, in its tooltip
};

/// The preset that the program opens with: a chain that reaches.
inline constexpr const char* reaching_arm = "reaching_arm";
/// A straight chain that FABRIK (2011) cannot bend.
inline constexpr const char* straight_chain_preset = "straight";

const std::vector<Preset>& presets();

/// Throws std::invalid_argument for an unknown name. Only "random" uses `seed`.
Chain make_preset(const std::string& name, std::size_t count, std::uint32_t seed);

/// Whether the preset is planar: an arm, a tail, and a figure with limits from bone before and from base.
bool is_planar(const std::string& name);
/// Completes a planar preset: mode Reach, the plane z = 0, its limits, and a target within them.
void make_it_planar(ChainPart& part, const std::string& name, ChainRuntime& runtime);

/// Completes the preset reaching_arm: mode Reach, a hinge at the elbow, a pole target above it, and the hand
/// on the target. `part` already has the preset's chain.
void make_it_reach(ChainPart& part, ChainRuntime& runtime);

/// Whether the preset comes with a curve.
bool is_along_curve(const std::string& name);
/// Completes such a preset: mode Curve, with its own control points or with some drawn through the chain.
void put_on_curve(ChainPart& part, const std::string& preset);

/// Completes the preset straight: mode Reach, solver FABRIK (2011), and the target on the chain's own line,
/// three quarters of a bone before the tip. Both passes then shift the joints along the line and back: the
/// chain stays as it is, to the last bit. Nearer to the root it would fold onto the line, and could end on
/// the target by chance. From 750 bones on, the gap is within the default tolerance.
void make_it_stall(ChainPart& part, ChainRuntime& runtime);

}  // namespace tendril::app
