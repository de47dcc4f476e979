// Springs on the character's own nodes: ears, antennae, a tail and other nodes outside the body trail behind.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <tendril/humanoid/spring_chain.hpp>
#include <vector>

#include "app/document/json.hpp"
#include "app/fields/fields.hpp"
#include "app/io/character/character.hpp"

namespace tendril::app {

struct HumanoidPart;
class JsonPlace;

inline constexpr std::size_t max_springs = 64;

/// A spring on a node and all its descendants.
struct SpringSetting {
    std::string node;                   ///< by name
    humanoid::SpringOptions options{};  ///< except for the hit radius, which the character's file gives
    bool operator==(const SpringSetting&) const = default;
};

/// The index of the part's spring that turns the node; empty if none does.
std::optional<std::size_t> spring_on(const HumanoidPart& part, std::size_t node);
/// Why there can be no spring on the node: another spring is in the way, the node belongs to the body or has
/// no parent. Empty if there can be one, provided that the node has some length.
std::string why_no_spring(const HumanoidPart& part, std::size_t node);
/// Adds the springs in the character's file, except those that are not possible.
void take_springs(HumanoidPart& part);
/// The selected nodes that can have a spring, without descendants of one another.
std::vector<std::size_t> selected_for_springs(const HumanoidPart& part);
/// The indices of the part's springs that turn selected nodes, ascending.
std::vector<std::size_t> selected_springs(const HumanoidPart& part);

Json springs_json(const HumanoidPart& part);
/// Throws std::runtime_error that begins with the JSON path.
void read_springs(const JsonPlace& place, HumanoidPart& part);

}  // namespace tendril::app

/// Except for its node.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SpringSetting>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::SpringSetting>();

namespace tendril::app {

// Applying springs to a pose.

/// The file's own spring from the same node down, if it has colliders; else null.
const NamedSpring* colliding(const HumanoidPart& part, const SpringSetting& setting);
humanoid::PlacedCapsule place(const SpringCollider& collider, const std::vector<humanoid::Placement>& placed);

/// One per setting; null if the bone map does not allow it.
using SpringChains = std::vector<std::unique_ptr<humanoid::SpringChain>>;
using SpringStates = std::vector<humanoid::SpringChainState>;

/// Turns the nodes of the pose. With a dt of 0 no time passes. Colliders are placed before any spring turns
/// the pose.
std::vector<humanoid::SpringReport> swing(const HumanoidPart& part, const SpringChains& chains, double dt,
                                          std::vector<rig::Transform>& pose, SpringStates& states);
/// For a pose that was set rather than reached over time.
void carry(const std::vector<SpringSetting>& settings, const SpringChains& chains,
           std::vector<rig::Transform> pose, SpringStates& states);
/// Whether everything moves negligibly slowly.
bool at_rest(const SpringStates& states);

}  // namespace tendril::app
