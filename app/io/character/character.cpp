#include "app/io/character/character.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace tendril::app {

void normalise(std::vector<humanoid::Node>& nodes, std::vector<humanoid::Clip>& clips, double scale,
               const glm::dquat& turn) {
    const bool is_upright = turn == glm::dquat(1.0, 0.0, 0.0, 0.0);
    for (humanoid::Node& node : nodes) {
        const auto convert = [&](rig::Transform& rest, bool is_root) {
            rest.translation *= scale;
            if (is_upright || !is_root) return;
            rest.translation = turn * rest.translation;
            rest.rotation = turn * rest.rotation;
        };
        convert(node.rest, node.parent < 0);
        if (node.keys) convert(node.keys->rest, node.keys->parent < 0);
    }
    for (humanoid::Clip& clip : clips) {
        for (humanoid::Channel& channel : clip.channels) {
            for (glm::dvec3& value : channel.translation.values) value *= scale;
            if (is_upright || nodes[channel.node].key_parent() >= 0) continue;
            for (glm::dvec3& value : channel.translation.values) value = turn * value;
            for (glm::dquat& value : channel.rotation.values) value = turn * value;
        }
    }
}

humanoid::BoneMap bone_map(const Character& character) {
    if (!character.bones) return humanoid::match_bones(character.skeleton);
    humanoid::BoneMap map;
    for (std::size_t i = 0; i < map.bones.size(); ++i) {
        const std::int32_t node = character.bones->nodes[i];
        if (node >= 0) map.bones[i] = {node, 1.0, "the file says so (" + character.bones->source + ')'};
    }
    humanoid::review(map, character.skeleton);
    return map;
}

humanoid::Skeleton skeleton_of(std::vector<humanoid::Node> nodes) {
    if (nodes.empty()) throw std::runtime_error("has no skeleton");
    if (nodes.size() > humanoid::Skeleton::max_nodes)
        throw std::runtime_error("its skeleton has " + std::to_string(nodes.size()) + " nodes, more than " +
                                 std::to_string(humanoid::Skeleton::max_nodes));
    std::vector<std::string> names;
    for (const humanoid::Node& node : nodes) names.push_back(node.name);
    auto skeleton = humanoid::Skeleton::make(std::move(nodes));
    if (skeleton) return std::move(*skeleton);
    std::string words(skeleton.message());
    std::size_t place = names.size();
    constexpr std::string_view list = "nodes[";
    if (const std::size_t at = words.find(list); at != words.npos)
        std::from_chars(words.data() + at + list.size(), words.data() + words.size(), place);
    if (place < names.size()) words += " (node " + names[place] + ')';
    throw std::runtime_error(words);
}

LengthUnit guess_unit(double height) {
    // CMU's captures are in inches, of a skeleton scaled by 0.45.
    constexpr std::array<LengthUnit, 6> units{{{"metres", 1.0},
                                               {"centimetres", 0.01},
                                               {"inches", 0.0254},
                                               {"CMU's inches / 0.45", 0.0254 / 0.45},
                                               {"decimetres", 0.1},
                                               {"millimetres", 0.001}}};
    LengthUnit best = units[0];
    double nearest = INFINITY;
    for (const LengthUnit& unit : units) {
        if (!(height > 0.0)) break;
        const double off = std::abs(std::log(height * unit.metres / 1.75));
        if (off < nearest) nearest = off, best = unit;
    }
    return best;
}

}  // namespace tendril::app
