// Springs on the character's own nodes: ears, antennae, a tail and other nodes outside the body trail behind.
#pragma once

#include <memory>
#include <string>
#include <tendril/humanoid/spring_chain.hpp>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/character/character.hpp"
#include "app/io/json.hpp"

namespace tendril::app {

struct HumanoidPart;
class JsonPlace;

inline constexpr std::size_t max_springs = 64;

/// A spring on a node and all its descendants.
struct SpringSetting {
    std::string node;                   ///< by name
    humanoid::SpringOptions options{};  ///< initially as in the character's file
    bool operator==(const SpringSetting&) const = default;
};

inline double max_hit_radius() {
    return field_of<&humanoid::SpringOptions::hit_radius>().range.high;
}
/// Adds the springs of the character's file, except impossible ones.
void take_springs(HumanoidPart& part);
/// The selected nodes that can have a spring, without descendants of one another.
std::vector<std::size_t> selected_for_springs(const HumanoidPart& part);
/// The indices of the part's springs that turn selected nodes, ascending.
std::vector<std::size_t> selected_springs(const HumanoidPart& part);

Json springs_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the JSON path.
void read_springs(const JsonPlace& place, HumanoidPart& part);

}  // namespace tendril::app

template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::humanoid::SpringOptions>();

namespace tendril::app {

// Applying springs to a pose.

/// The file's own spring from the same node down, if it has colliders; else null.
const NamedSpring* colliding(const HumanoidPart& part, const SpringSetting& setting);
humanoid::PlacedCapsule place(const SpringCollider& collider, const std::vector<humanoid::Placement>& placed);

/// One per setting; null if the bone map leaves no room for it.
using SpringChains = std::vector<std::unique_ptr<humanoid::SpringChain>>;
using SpringStates = std::vector<humanoid::SpringChainState>;

/// Turns the pose's nodes; colliders are where it has them before. With a dt of 0 no time passes.
std::vector<humanoid::SpringReport> swing(const HumanoidPart& part, const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states);
/// Call after the pose was set, not reached over time.
void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states);
/// True if everything moves negligibly slowly.
bool at_rest(const SpringStates& states);

}  // namespace tendril::app
