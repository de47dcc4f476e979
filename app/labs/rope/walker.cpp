#include "app/labs/rope/rope_part.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>
#include <tendril/humanoid/clip.hpp>
#include <tendril/magnitude.hpp>

#include "app/io/character/character.hpp"
#include "app/io/character/skin.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/body_commands.hpp"

namespace tendril::app {
namespace {

constexpr double walker_edge = 1e6;  ///< metres: the limit for capsules

const humanoid::Clip* clip_of(const Walker& walker) {
    const auto& clips = walker.figure->character.clips;
    const auto found = std::ranges::find(clips, walker.clip, &humanoid::Clip::name);
    return found == clips.end() ? nullptr : &*found;
}

/// The number of times that the clip has restarted.
double rounds(const Walker& walker, double time) {
    const humanoid::Clip* const clip = clip_of(walker);
    if (clip == nullptr || !(clip->duration > 0.0)) return 0.0;
    return std::floor((time - walker.began) / clip->duration + 1e-9);
}

glm::vec3 within(const glm::dvec3& point, const glm::vec3& at) {
    glm::dvec3 kept(at);
    for (int i = 0; i < 3; ++i)
        if (std::isfinite(point[i])) kept[i] += point[i];
    return glm::vec3(glm::clamp(kept, glm::dvec3(-walker_edge), glm::dvec3(walker_edge)));
}

}  // namespace

std::shared_ptr<const WalkerFigure> read_walker(const std::string& path, const std::string& file) {
    auto figure = std::make_shared<WalkerFigure>();
    figure->character = path.empty() ? stick_figure() : read_character(path);
    static_cast<OutsideFile&>(*figure) = outside_file(path, file);
    const humanoid::Skeleton& skeleton = figure->character.skeleton;
    figure->map = bone_map(figure->character);
    const Skin& skin = figure->character.skin;
    if (skin.mesh) {
        std::vector<humanoid::Placement> rest(skeleton.size());
        humanoid::place(skeleton, humanoid::rest_pose(skeleton), rest);
        figure->capsules = humanoid::fitted_capsules(skeleton, figure->map, skin_points(skin, rest));
    } else {
        figure->capsules = humanoid::default_capsules(skeleton, figure->map);
    }
    if (figure->capsules.empty()) throw std::runtime_error(path + ": no bone of a body was found in it");
    return figure;
}

std::vector<WalkerCapsule> walker_capsules(const Walker& walker, double time) {
    const WalkerFigure& figure = *walker.figure;
    const humanoid::Skeleton& skeleton = figure.character.skeleton;
    std::vector<rig::Transform> pose = humanoid::rest_pose(skeleton);
    if (const humanoid::Clip* const clip = clip_of(walker)) {
        const double since = time - walker.began - rounds(walker, time) * clip->duration;
        humanoid::sample(*clip, skeleton, since, pose);
    }
    std::vector<humanoid::Placement> placed(skeleton.size());
    humanoid::place(skeleton, pose, placed);
    std::vector<WalkerCapsule> all;
    for (const humanoid::BodyCapsule& each : figure.capsules) {
        const humanoid::PlacedCapsule there = humanoid::place(each, figure.map, placed);
        all.push_back({humanoid::name(each.bone),
                       {within(there.from, walker.at), within(there.to, walker.at),
                        static_cast<float>(std::clamp(there.radius, 0.0, walker_edge))}});
    }
    return all;
}

void aim_walker(const Walker& walker, NamedWorld& world, double now, double next) {
    const bool again = rounds(walker, now) != rounds(walker, next);
    for (const WalkerCapsule& each : walker_capsules(walker, next)) {
        const rope::Collider* const there = world.find_collider(each.name);
        if (there == nullptr || !std::holds_alternative<rope::Capsule>(there->shape)) continue;
        if (again)
            world.change(each.name, &rope::World::set_collider, each.shape);
        else
            world.change(each.name, &rope::World::move_capsule, each.shape,
                         world.world().pending() + (next - now));
    }
}

Json save_walker(const Walker& walker) {
    if (!walker.figure) return nullptr;
    Json json = save_outside_file(*walker.figure);
    json.update({{"clip", walker.clip}, {"at", point(walker.at)}, {"began", walker.began}});
    return json;
}

Walker load_walker(const JsonPlace& place) {
    if (place.json().is_null()) return {};
    Walker walker;
    walker.figure = read_outside_file(place, read_walker);
    walker.clip = place["clip"].text();
    if (!walker.clip.empty() && clip_of(walker) == nullptr)
        place["clip"].fail("the character has no clip \"" + walker.clip + "\"");
    walker.at = place["at"].point();
    walker.began = place["began"].real(0.0, 1e9);
    return walker;
}

namespace {

void leave(RopeEdit& edit) {
    if (!edit.part.walker.figure) return;
    for (const WalkerCapsule& each : walker_capsules(edit.part.walker, edit.part.time))
        if (edit.seen().find_collider(each.name) != nullptr)
            edit.world().change(each.name, &rope::World::remove_collider);
    edit.part.walker = {};
    forget_missing(edit.part);
}

void enter(RopeEdit& edit, const Arguments& given) {
    Walker walker;
    const std::string file = given.has("path") ? given.text("path") : std::string();
    // Do not read the file again for another position or clip of the same character.
    const auto& now = edit.part.walker.figure;
    const bool same = now && now->file == file && (given.has("clip") || given.has("at"));
    walker.figure = same ? now : read_walker(file);
    const auto& clips = walker.figure->character.clips;
    if (given.has("clip"))
        walker.clip = given.text("clip");
    else if (!clips.empty())
        walker.clip = clips.front().name;
    if (!walker.clip.empty() && clip_of(walker) == nullptr)
        throw Refused("the character has no clip \"" + walker.clip + "\"");
    if (given.has("at")) walker.at = given.point("at");
    walker.began = edit.part.time;
    leave(edit);
    for (const WalkerCapsule& each : walker_capsules(walker, walker.began)) {
        check_collider_count(edit.seen());
        edit.world().add_collider(each.name, each.shape);
    }
    edit.part.walker = std::move(walker);
}

void leave_by_command(RopeEdit& edit, const Arguments&) {
    if (!edit.part.walker.figure) throw Refused("there is no character");
    leave(edit);
}

}  // namespace

void add_walker_commands(CommandTable& table) {
    table.add(rope_command(
        "rope.character", "Let a character walk in",
        {text_argument("path", false,
                       "a .gltf, .glb, .vrm, .vrma, .fbx or .bvh file; if omitted, the stick figure"),
         text_argument("clip", false, "which of its clips; omitted: the first; empty: it stands"),
         point_argument("at", false, "position of its file's origin, metres")},
        "Makes the capsules of a character colliders that follow its clip; replaces an earlier character",
        enter));
    table.add(rope_command("rope.character.remove", "Remove the character", {},
                           "Removes the character and its colliders", leave_by_command));
}

}  // namespace tendril::app
