#include "app/io/character/character.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/io/text.hpp"
#include "tendril/elementary.hpp"

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

glm::dvec3 direction(UpAxis up) {
    const auto axis = static_cast<int>(up);
    glm::dvec3 along(0.0);
    along[axis % 3] = axis < 3 ? 1.0 : -1.0;
    return along;
}

glm::dquat turn_of(UpAxis up) {
    const double half = std::sqrt(0.5);
    switch (up) {
        case UpAxis::X:
            return {half, 0.0, 0.0, half};
        case UpAxis::Y:
            break;
        case UpAxis::Z:
            return {half, -half, 0.0, 0.0};
        case UpAxis::MinusX:
            return {half, 0.0, 0.0, -half};
        case UpAxis::MinusY:
            return {0.0, 1.0, 0.0, 0.0};
        case UpAxis::MinusZ:
            return {half, half, 0.0, 0.0};
    }
    return {1.0, 0.0, 0.0, 0.0};
}

std::vector<std::string> Character::sentences() const {
    std::vector<std::string> all;
    for (const std::string& each : {guesses.up, guesses.positions, guesses.unit})
        if (!each.empty()) all.push_back(each);
    all.insert(all.end(), notes.begin(), notes.end());
    return all;
}

namespace {

struct HowRead {
    double scale;
    FileSpace space;
};

void convert(std::vector<humanoid::Node>& nodes, std::vector<humanoid::Clip>& clips,
             std::span<const RootOffset> roots, const HowRead& before, const HowRead& now) {
    if (now.space.positions != before.space.positions) {
        const double times = now.space.positions == RootPositions::Add ? before.scale : -before.scale;
        for (const RootOffset& root : roots)
            for (humanoid::Clip& clip : clips)
                for (humanoid::Channel& channel : clip.channels)
                    if (channel.node == root.node)
                        for (glm::dvec3& value : channel.translation.values)
                            value += turn_of(before.space.up) * (times * root.offset);
    }
    normalise(nodes, clips, now.scale / before.scale,
              now.space.up == before.space.up ? turn_of(UpAxis::Y)
                                              : turn_of(now.space.up) * conjugate(turn_of(before.space.up)));
}

}  // namespace

humanoid::Clip read_as_now(humanoid::Clip clip, double scale, const FileSpace& space,
                           const Character& character, bool of_its_file) {
    std::vector<humanoid::Node> nodes = character.skeleton.nodes();
    std::vector<humanoid::Clip> clips{std::move(clip)};
    convert(nodes, clips, of_its_file ? character.root_offsets : std::vector<RootOffset>(), {scale, space},
            {character.scale, character.space});
    if (const Result bad = check(clips[0], character.skeleton); !bad)
        throw std::runtime_error(std::string(bad.message()));
    return std::move(clips[0]);
}

void read_as(Character& character, double scale, const FileSpace& space) {
    const HowRead before{std::exchange(character.scale, scale), std::exchange(character.space, space)};
    const double times = scale / before.scale;
    if (times != 1.0) character.guesses.unit.clear();
    if (space.up != before.space.up) character.guesses.up.clear();
    if (space.positions != before.space.positions) character.guesses.positions.clear();
    std::vector<humanoid::Node> nodes = character.skeleton.nodes();
    convert(nodes, character.clips, character.root_offsets, before, {scale, space});
    character.skeleton = skeleton_of(std::move(nodes));
    for (const humanoid::Clip& clip : character.clips)
        if (const Result bad = check(clip, character.skeleton); !bad)
            throw std::runtime_error(std::string(bad.message()));
    scale_skin(character.skin, times);
    for (NamedSpring& spring : character.springs) {
        spring.hit_radius *= times;
        for (SpringCollider& each : spring.colliders)
            each = {each.node, times * each.from, times * each.to, times * each.radius};
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
    // CMU's captures are in inches, for a skeleton scaled by 0.45.
    constexpr std::array<LengthUnit, 6> units{{{"metres", 1.0},
                                               {"centimetres", 0.01},
                                               {"inches", 0.0254},
                                               {"CMU's unit of 56.4 mm", 0.0254 / 0.45},
                                               {"decimetres", 0.1},
                                               {"millimetres", 0.001}}};
    LengthUnit best = units[0];
    double nearest = INFINITY;
    for (const LengthUnit& unit : units) {
        if (!(height > 0.0)) break;
        const double off = std::abs(math::logarithm(height * unit.metres / 1.75));
        if (off < nearest) nearest = off, best = unit;
    }
    return best;
}

RestBounds bounds_at_rest(const Character& character, std::span<const humanoid::Placement> rest) {
    RestBounds bounds{glm::dvec3(std::numeric_limits<double>::max()),
                      glm::dvec3(-std::numeric_limits<double>::max())};
    const auto extend = [&](const glm::dvec3& to) {
        bounds.low = glm::min(bounds.low, to);
        bounds.high = glm::max(bounds.high, to);
    };
    for (const humanoid::Placement& each : rest) extend(each.position);
    if (const Skin& skin = character.skin; skin.mesh) {
        const SkinDraw draw{skin.mesh, skin_matrices(skin, rest)};
        for (std::size_t i = 0; i < skin.mesh->positions.size(); ++i) extend(glm::dvec3(skinned(draw, i)));
    }
    return bounds;
}

std::optional<UnitDoubt> doubted_unit(double height, double scale, const humanoid::BoneMap& map) {
    constexpr double smallest = 0.5, largest = 3.0, usual = 1.75;
    if (!map.is_usable()) return std::nullopt;
    const double units = height / scale;
    if (!(height > 0.0) || (height >= smallest && height <= largest)) return std::nullopt;
    const LengthUnit unit = guess_unit(units);
    const bool fits = units * unit.metres >= smallest && units * unit.metres <= largest;
    if (fits) return UnitDoubt{height, unit, units * unit.metres};
    return UnitDoubt{height, {"", usual / units}, usual};
}

std::string text(const UnitDoubt& doubt) {
    const std::string then = fixed_text(doubt.then, 2) + " m";
    return "This figure is " + length_text(doubt.height) + " tall at rest; " +
           (*doubt.unit.name != '\0' ? std::string("if the file is in ") + doubt.unit.name + ", " + then + '.'
                                     : "no common unit makes it a usual height.");
}

}  // namespace tendril::app
