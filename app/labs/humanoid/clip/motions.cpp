#include "app/labs/humanoid/clip/motions.hpp"

#include <imgui.h>
#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <tendril/humanoid/retarget.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/document/units.hpp"
#include "app/io/character/read.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using humanoid::Clip;

const Clip& clip_of_motion(const Character& character, const std::string& name) {
    if (character.clips.empty()) throw std::runtime_error("has no clips");
    if (name.empty()) return character.clips.front();
    const auto found = std::ranges::find(character.clips, name, &Clip::name);
    if (found == character.clips.end()) throw std::runtime_error("has no clip \"" + name + '"');
    return *found;
}

std::string free_name(const LoadedCharacter& character, const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; std::ranges::find(character.clips(), name, &Clip::name) != character.clips().end(); ++i)
        name = wanted + '_' + std::to_string(i);
    return name;
}

std::string bones_text(const std::vector<humanoid::Bone>& bones) {
    std::string text;
    for (const humanoid::Bone each : bones)
        text += (text.empty() ? "" : ", ") + std::string(humanoid::name(each));
    return text;
}

}  // namespace

PlayedMotion with_motion(const HumanoidPart& part, const std::string& file, const std::string& clip) {
    const Character source = read_character(file);
    const std::string name = std::filesystem::path(file).filename().string();
    try {
        const Clip& wanted = clip_of_motion(source, clip);
        auto made =
            humanoid::retarget({source.skeleton, bone_map(source)}, wanted, {part.skeleton(), *part.map});
        if (!made) throw std::runtime_error(made.message());
        auto loaded = std::make_shared<LoadedCharacter>(*part.loaded);
        made->clip.name = free_name(*loaded, wanted.name);
        PlayedMotion played;
        played.text =
            "Clip " + made->clip.name + ", the hips' motion scaled by " + fixed_text(made->scale, 2);
        if (!made->left_out.empty()) played.text += ". Not on this character: " + bones_text(made->left_out);
        if (!made->at_rest.empty())
            played.text += ". Not in the file, so at rest: " + bones_text(made->at_rest);
        loaded->motions.push_back(
            {file, std::filesystem::absolute(file).lexically_normal().string(), wanted.name});
        loaded->character.clips.push_back(std::move(made->clip));
        played.loaded = std::move(loaded);
        return played;
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

Json motions_json(const LoadedCharacter& character) {
    Json list = Json::array();
    for (const LoadedMotion& each : character.motions)
        list.push_back({{"file", each.file}, {"path", each.path}, {"clip", each.clip}});
    return list;
}

void read_motions(const JsonPlace& place, HumanoidPart& part) {
    constexpr std::size_t max_motions = 1000;
    place.for_each("motions", max_motions, [&](const JsonPlace& each) {
        const std::string file = each["file"].text(), path = each["path"].text();
        try {
            // The path may not exist on another machine.
            auto played = with_motion(part, std::filesystem::exists(path) ? path : file, each["clip"].text());
            auto loaded = std::make_shared<LoadedCharacter>(*played.loaded);
            loaded->motions.back().file = file;
            part.loaded = std::move(loaded);
        } catch (const std::exception& error) {
            each["file"].fail(error.what());
        }
    });
}

// The command and its rows.

namespace {

void load_motion(Workspace& workspace, const Arguments& given) {
    PlayedMotion played = with_motion(humanoid_part(workspace), given.text("path"),
                                      given.has("clip") ? given.text("clip") : std::string());
    HumanoidPart& part = workspace.document.edit<HumanoidPart>(humanoid_lab);
    part.loaded = std::move(played.loaded);
    part.playback.clip = part.loaded->clips().size() - 1;
    part.playback.time = 0.0;
    part.playback.rounds = 0;
    part.playback.playing = true;
    measure_pace(part);
    part.quiet_ticks = 0;
    workspace.toast(played.text);
}

}  // namespace

void motion_rows(const HumanoidPanel& panel, MoreRows& more) {
    more.add("motion", {"humanoid.motion.load", {"path"}}, false, [&panel] {
        std::string& path = panel.runtime.panel.motion;
        text_field("motion", path, "walk.vrma");
        explain(
            "A file with a motion of another character: .vrma, .vrm, .gltf, .glb, .fbx or .bvh. Its first "
            "clip "
            "is carried over by the two bone maps.");
        if (row_button("Load motion", 1, !path.empty(), "Adds it to this character's clips and plays it"))
            panel.emit("humanoid.motion.load", {{"path", path}});
        end_row();
    });
}

void add_motion_commands(CommandTable& table) {
    table.add({.name = "humanoid.motion.load",
               .title = "Load another character's motion",
               .arguments = {text_argument("path", true,
                                           "a .vrma, .vrm, .gltf, .glb, .fbx or .bvh file with a clip"),
                             text_argument("clip", false, "which one, by name; default: the first")},
               .help =
                   "Plays a clip of another character on this one, by the two bone maps: limbs point in the "
                   "same directions, and the hips move in proportion to their height",
               .effect = Effect::Edit,
               .apply = load_motion});
}

}  // namespace tendril::app
