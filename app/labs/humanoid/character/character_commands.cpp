// Which character it is, and which of its nodes are which bones.
#include <glm/common.hpp>
#include <stdexcept>

#include "app/labs/humanoid/attachments/wearing.hpp"
#include "app/labs/humanoid/character/kept_maps.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/node_selection.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/index_list.hpp"
#include "app/labs/kit/name_list.hpp"
#include "app/view/camera.hpp"

namespace tendril::app {
namespace {

/// The view that the lab has, or will have when it is opened, is on the whole of the character.
void show_all(Workspace& workspace, const LoadedCharacter& character) {
    CameraPose& camera = workspace.lab == humanoid_lab ? workspace.camera : workspace.cameras[humanoid_lab];
    camera = workspace.first_view_of(humanoid_lab);
    if (character.file.empty()) return;
    const glm::vec3 centre(0.5 * (character.low + character.high));
    const auto radius = static_cast<float>(0.5 * glm::distance(character.low, character.high));
    camera = framed(camera, {{0.0f, 0.0f}, workspace.ui.view_size}, centre, std::max(radius, 0.01f));
}

void show(Workspace& workspace, SharedCharacter character) {
    HumanoidPart part(std::move(character));
    const HumanoidPart& before = humanoid_part(workspace);
    part.view = before.view;
    part.selection = selection_in(part.skeleton(), before.selection, before.skeleton());
    workspace.document.edit<HumanoidPart>(humanoid_lab) = part;
    show_all(workspace, *part.loaded);
    if (const std::string& why = humanoid_runtime(workspace).kept_maps.refused(workspace); !why.empty())
        workspace.toast(why, ToastKind::Refusal);
}

void load(Workspace& workspace, const Arguments& given) {
    const std::string file = given.has("path") ? given.text("path") : std::string();
    if (given.has("path") && file.empty()) throw std::invalid_argument("path is empty");
    Loading& loading = humanoid_runtime(workspace).loading;
    if (loads_beside(workspace, file)) return loading.begin(file);
    SharedCharacter character = load_character(file);
    loading.cancel();
    show(workspace, std::move(character));
}

void map(HumanoidPart& part, const Arguments& given) {
    const auto bone = humanoid::bone_named(given.text("bone"));
    std::optional<std::size_t> node;
    if (given.has("node") && !given.text("node").empty()) node = node_named(part, given.text("node"));
    set_bone(part, *bone, node);
    check_bones(part);
}

void rescale(Workspace& workspace, const Arguments& given) {
    const HumanoidPart& before = humanoid_part(workspace);
    const double metres = given.real("metres");
    if (metres == before.loaded->character.scale) return;
    if (before.loaded->file.empty())
        throw std::invalid_argument("the stick figure comes from no file, and is in metres");
    const double was = before.loaded->character.scale;
    const SharedCharacter loaded = rescaled(*before.loaded, metres);
    HumanoidPart& part = workspace.document.edit<HumanoidPart>(humanoid_lab);
    part.loaded = loaded;
    part.ik_state.springs.clear();  // what swings and what fades out was in the old metres
    part.ik_state.release = {};
    remake_attachments(workspace, metres / was);
    show_all(workspace, *loaded);
}

/// Whether a correction would turn anything: a limb of two bones.
bool has_limbs(const HumanoidPart& part) {
    using humanoid::Bone;
    for (const Bone upper :
         {Bone::LeftUpperArm, Bone::RightUpperArm, Bone::LeftUpperLeg, Bone::RightUpperLeg})
        if (part.node_of(upper) && part.node_of(static_cast<Bone>(static_cast<int>(upper) + 1))) return true;
    return false;
}

void set_t_pose(HumanoidPart& part, const Arguments& given) {
    const bool on = given.boolean("on");
    if (on && !has_limbs(part)) throw std::invalid_argument("no arm or leg is mapped");
    part.t_pose = on;
}

}  // namespace

void finish_loading(Workspace& workspace) {
    Loading& loading = humanoid_runtime(workspace).loading;
    if (!loading.running()) return;
    SharedCharacter character;
    try {
        character = loading.take();
    } catch (const std::exception& error) {
        throw Refused(std::string("humanoid.load: ") + error.what());
    }
    // A step to undo, as if the command had done all of it now.
    const Document before = workspace.document;
    const Place from = workspace.place();
    show(workspace, std::move(character));
    workspace.rewind.forget_from(workspace.moment);
    ++workspace.edition;
    workspace.history.push(before.without(workspace.document), "humanoid.load", 0, from, workspace.place());
}

std::vector<std::string> bone_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        names.emplace_back(humanoid::name(static_cast<humanoid::Bone>(i)));
    return names;
}

std::size_t node_named(const HumanoidPart& part, const std::string& name) {
    if (const auto node = part.skeleton().find(name)) return *node;
    throw std::invalid_argument("the character has no node \"" + name + "\"");
}

std::vector<std::size_t> nodes_named(const HumanoidPart& part, const Arguments& given) {
    if (gives_one(given, "node", "nodes")) return {node_named(part, given.text("node"))};
    std::vector<std::size_t> nodes;
    for (const std::string& name : name_list(given, "nodes")) nodes.push_back(node_named(part, name));
    return nodes;
}

Argument node_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& w) {
        return names(humanoid_part(w).skeleton().nodes(),
                     [](const humanoid::Node& node) { return node.name; });
    });
}

Argument clip_argument(const char* name, const char* help) {
    return offering(text_argument(name, false, help), [](const Workspace& w) {
        return names(humanoid_part(w).loaded->clips(), [](const humanoid::Clip& clip) { return clip.name; });
    });
}

void add_character_commands(CommandTable& table) {
    table.add(
        {.name = "humanoid.load",
         .title = "Load a character",
         .arguments = {text_argument("path", false,
                                     "a .gltf, .glb, .fbx or .bvh file; the stick figure when left out")},
         .help = "Loads a character, as it rests, with nothing playing; selected nodes that it has too stay "
                 "selected",
         .effect = Effect::Edit,
         .apply = load,
         .finish = finish_loading});
    table.add({.name = "humanoid.load.cancel",
               .title = "Stop loading the character",
               .arguments = {},
               .help = "Ends the loading of a large file; the character that is there stays",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   humanoid_runtime(workspace).loading.cancel();
               }});
    table.add(keeping(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.map", "Map a bone to a node",
        {choice_argument("bone", true, "which", bone_names()),
         node_argument("node", false, "of the skeleton, by name; none when left out")},
        "Says which node of the character is a bone", map)));
    table.add({.name = "humanoid.scale",
               .title = "Correct the character's scale",
               .arguments =
                   {{.name = "metres", .help = "of a unit of the file", .low = min_unit, .high = max_unit}},
               .help = "Corrects the unit of the character's file",
               .effect = Effect::Edit,
               .apply = rescale});
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.t_pose", "Show the T-pose",
        {{.name = "on", .type = ArgumentType::Boolean, .help = "or off"}},
        "Shows the rest pose with its arms straight aside and its legs straight down", set_t_pose));
}

}  // namespace tendril::app
