// Springs on the character's own nodes: what no bone of the body moves, ears, antennae, a tail, trails
// behind.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/spring_chain.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/fields/fields.hpp"

namespace tendril::app {

struct HumanoidPart;
class JsonPlace;

inline constexpr std::size_t max_springs = 64;
inline constexpr double min_spring_strength = 0.01, max_spring_strength = 100.0;  ///< Hz
inline constexpr double max_spring_damping = 10.0, widest_swing_deg = 179.0;

/// Of a node and all that hangs on it; as humanoid::SpringOptions has it.
struct SpringSetting {
    std::string node;  ///< by name
    double strength = humanoid::SpringOptions().strength;
    double critical_damping = humanoid::SpringOptions().critical_damping;
    double weight = humanoid::SpringOptions().weight;
    double max_angle_deg = 60.0;  ///< as the library's
    bool operator==(const SpringSetting&) const = default;

    humanoid::SpringOptions options() const;
};

/// The place in the part's list of the spring that turns the node; nothing where none does.
std::optional<std::size_t> spring_on(const HumanoidPart& part, std::size_t node);
/// Why there can be no spring from that node on, in words: another spring is in the way, or the node is the
/// body's, or hangs on nothing; empty where there can be one, if it has some length.
std::string why_no_spring(const HumanoidPart& part, std::size_t node);
/// Those of the selected nodes from which there can be a spring, without what hangs on another one of them.
std::vector<std::size_t> selected_for_springs(const HumanoidPart& part);
/// The places in the part's list of the springs that turn what is selected, ascending.
std::vector<std::size_t> selected_springs(const HumanoidPart& part);

Json springs_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the place of what is wrong.
void read_springs(const JsonPlace& place, HumanoidPart& part);

}  // namespace tendril::app

/// Of all but its node.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SpringSetting>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::SpringSetting>();

namespace tendril::app {

// What the springs of a character do to its pose.

/// Made for a character, one for each setting; null where the bone map leaves no room for it.
using SpringChains = std::vector<std::unique_ptr<humanoid::SpringChain>>;
using SpringStates = std::vector<humanoid::SpringChainState>;

/// Turns the nodes of the pose; with a dt of 0 no time passes.
std::vector<humanoid::SpringReport> swing(const std::vector<SpringSetting>& settings,
                                          const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states);
/// The pose was set, not reached in time.
void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states);
/// Whether hardly anything moves.
bool at_rest(const SpringStates& states);

}  // namespace tendril::app
