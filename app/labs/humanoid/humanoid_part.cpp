#include "app/labs/humanoid/humanoid_part.hpp"

#include <algorithm>
#include <stdexcept>

#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/kit/part_cache.hpp"

namespace tendril::app {

using humanoid::Bone;
using humanoid::BoneMap;

HumanoidPart::HumanoidPart() : HumanoidPart(load_character({})) {}

HumanoidPart::HumanoidPart(SharedCharacter character)
    : loaded(std::move(character)), map(std::make_shared<const BoneMap>(loaded->matched)) {}

std::optional<std::size_t> HumanoidPart::node_of(Bone bone) const {
    const std::int32_t node = (*map)[bone].node;
    return node < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(node));
}

std::string HumanoidPart::called(std::size_t node) const {
    const auto bone = bone_of(node);
    return bone ? humanoid::name(*bone) : skeleton()[node].name;
}

std::string HumanoidPart::titled(std::size_t node) const {
    const std::string& name = skeleton()[node].name;
    return called(node) == name ? name : name + " (" + called(node) + ')';
}

std::vector<std::string> HumanoidPart::unmapped() const {
    return bone_names([&](std::size_t i) { return map->bones[i].node < 0; });
}

std::optional<Bone> HumanoidPart::bone_of(std::size_t node) const {
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map->bones[i].node == static_cast<std::int32_t>(node)) return static_cast<Bone>(i);
    return std::nullopt;
}

/// Selection, view and flip rule do not rewind.
std::shared_ptr<const Part> HumanoidPart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<HumanoidPart>(dynamic_cast<const HumanoidPart&>(*then));
    part->view = view;
    part->flips = flips;
    part->selection = selection_in(part->skeleton(), selection, skeleton());
    return part;
}

std::vector<std::filesystem::path> HumanoidPart::files() const {
    std::vector<std::filesystem::path> all;
    if (!loaded->path.empty()) all.emplace_back(loaded->path);
    for (const ClipEdit& each : loaded->edits)
        if (const auto* motion = std::get_if<LoadedMotion>(&each.what)) all.emplace_back(motion->path);
    if (ik.ground.mesh) all.emplace_back(ik.ground.mesh->path);
    return all;
}

namespace {

template <class Value>
std::size_t bytes_of(const humanoid::Track<Value>& track) {
    return track.times.size() * sizeof(double) + track.values.size() * sizeof(Value);
}

std::size_t bytes_of(const SkinnedMesh& mesh) {
    std::size_t pixels = 0;
    for (const Picture& each : mesh.pictures) pixels += each.rgba.size();
    constexpr std::size_t a_vertex = 2 * sizeof(glm::vec3) + sizeof(JointWeights) + sizeof(glm::vec2);
    return mesh.positions.size() * a_vertex + mesh.indices.size() * sizeof(mesh.indices[0]) + pixels;
}

/// Each retarget, fix or change of unit makes its own character with all clips. They share meshes.
std::size_t bytes_of(const LoadedCharacter& loaded) {
    constexpr std::size_t a_node = 400;  // including its name, placement and bone
    std::size_t bytes = loaded.skeleton().size() * a_node;
    const auto add = [&](const humanoid::Clip& clip) {
        for (const humanoid::Channel& channel : clip.channels)
            bytes += sizeof(channel) + bytes_of(channel.translation) + bytes_of(channel.rotation) +
                     bytes_of(channel.scale);
    };
    for (const humanoid::Clip& clip : loaded.clips()) add(clip);
    for (const auto& [name, clip] : loaded.unfixed) add(*clip);
    for (const ClipEdit& edit : loaded.edits) {
        if (edit.clip) add(*edit.clip);
        if (edit.unfixed) add(*edit.unfixed);
        if (const auto* motion = std::get_if<LoadedMotion>(&edit.what); motion != nullptr && motion->source)
            bytes += share_of(motion->source, bytes_of(*motion->source));
    }
    if (loaded.source) bytes += share_of(loaded.source, bytes_of(*loaded.source));
    const auto& mesh = loaded.character.skin.mesh;
    return bytes + (mesh ? share_of(mesh, bytes_of(*mesh)) : 0);
}

}  // namespace

std::size_t HumanoidPart::bytes() const {
    constexpr std::size_t a_particle = 80, a_pin = 80, a_turn = 80;
    const rope::State& ropes = attachments.world->state();
    const std::size_t hanging = ropes.position.size() * a_particle + ropes.pins.size() * a_pin +
                                ropes.links.size() * sizeof(rope::Link) +
                                ropes.colliders.size() * sizeof(rope::Collider);
    std::size_t swinging = ik_state.release.turns.size() * a_turn;
    for (const humanoid::SpringChainState& each : ik_state.springs)
        swinging += each.masses.size() * sizeof(humanoid::SpringMass);
    std::size_t curved = 0;
    for (const BoneCurve& each : curves)
        curved += sizeof(each) + each.shape.points.size() * sizeof(glm::vec3);
    return sizeof(*this) + swinging + curved + selection.all().size() * sizeof(std::size_t) +
           share_of(loaded, bytes_of(*loaded)) + share_of(map, sizeof(BoneMap)) + hanging;
}

std::size_t HumanoidPart::shared_bytes(const Part& other) const {
    const auto& it = dynamic_cast<const HumanoidPart&>(other);
    return it.loaded == loaded ? share_of(loaded, bytes_of(*loaded)) : 0;
}

bool HumanoidPart::operator==(const HumanoidPart& other) const {
    return loaded == other.loaded && (map == other.map || *map == *other.map) && playback == other.playback &&
           t_pose == other.t_pose && ik == other.ik && springs == other.springs && curves == other.curves &&
           ik_state == other.ik_state && attachments == other.attachments &&
           quiet_ticks == other.quiet_ticks && selection == other.selection && view == other.view &&
           flips == other.flips;
}

Corrections corrections_of(const BoneMap& map, const LoadedCharacter& character) {
    Corrections corrections;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map.bones[i].node != character.matched.bones[i].node)
            corrections[static_cast<Bone>(i)] = map.bones[i].node;
    return corrections;
}

void correct(HumanoidPart& part, const Corrections& corrections) {
    BoneMap map = corrected(*part.loaded, corrections);
    const Result bad = check(map, part.skeleton());
    if (!bad && check(part.loaded->matched, part.skeleton())) throw std::invalid_argument(bad.message());
    part.map = std::make_shared<const BoneMap>(std::move(map));
    measure_pace(part);
}

Reading reading_of(const HumanoidPart& part) {
    const Character& character = part.loaded->character;
    return {character.scale, character.space, corrections_of(*part.map, *part.loaded), part.ik.limits};
}

namespace {

/// The last name becomes the active node, if it exists.
Selection selection_of(const std::vector<std::string>& names, const humanoid::Skeleton& skeleton) {
    std::vector<std::size_t> nodes;
    for (const std::string& name : names)
        if (const auto node = skeleton.find(name)) nodes.push_back(*node);
    Selection selection;
    selection.take(nodes, false);
    return selection;
}

}  // namespace

std::vector<std::string> names_of(const Selection& selection, const humanoid::Skeleton& skeleton) {
    std::vector<std::string> names;
    for (const std::size_t node : selection.all()) names.push_back(skeleton[node].name);
    return names;
}

std::string active_name(const Selection& selection, const humanoid::Skeleton& skeleton) {
    return selection.active() ? skeleton[*selection.active()].name : std::string();
}

Selection selection_in(const humanoid::Skeleton& skeleton, const Selection& selection,
                       const humanoid::Skeleton& before) {
    if (&skeleton == &before || selection.empty()) return selection;
    std::vector<std::string> names = names_of(selection, before);
    names.push_back(active_name(selection, before));
    return selection_of(names, skeleton);
}

std::string left_out_text(const HumanoidPart& part, bool held) {
    std::vector<std::string> all =
        names(part.attachments.list, [](const Attachment& each) { return each.name; });
    if (held && part.ik.hold) all.push_back(held_kinds.title(part.ik.hold->kind));
    return all.empty() ? "" : ". Left out: " + name_list_text(all);
}

Json save_selection(const Selection& selection, const humanoid::Skeleton& skeleton) {
    if (!selection.several()) return active_name(selection, skeleton);
    return {{"active", active_name(selection, skeleton)}, {"all", names_of(selection, skeleton)}};
}

Selection load_selection(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    if (!place.json().is_object()) return selection_of({place.text()}, skeleton);
    check_members(place, {"active", "all"});
    std::vector<std::string> names;
    place["all"].for_each("selected", humanoid::Skeleton::max_nodes,
                          [&](const JsonPlace& each) { names.push_back(each.text()); });
    const std::string active = place["active"].text();
    if (std::find(names.begin(), names.end(), active) == names.end())
        place["active"].fail("is not in the selection");
    names.push_back(active);
    return selection_of(names, skeleton);
}

}  // namespace tendril::app
