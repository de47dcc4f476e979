#include "app/labs/humanoid/humanoid_part.hpp"

#include <imgui.h>
#include <algorithm>
#include <filesystem>
#include <span>
#include <stdexcept>

#include "app/io/character/character.hpp"
#include "app/io/character/retargeted_motion.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

using humanoid::Clip;

std::string free_name(const LoadedCharacter& character, const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; std::ranges::find(character.clips(), name, &Clip::name) != character.clips().end(); ++i)
        name = wanted + '_' + std::to_string(i);
    return name;
}

/// Maximum number of times that a motion was moved to another character. A scene file nests them.
int times_taken(const LoadedCharacter& character) {
    int most = 0;
    for (const ClipEdit& each : character.edits)
        if (const auto* motion = std::get_if<LoadedMotion>(&each.what); motion != nullptr && motion->source)
            most = std::max(most, 1 + times_taken(*motion->source));
    return most;
}
constexpr int max_times_taken = 12;

}  // namespace

PlayedMotion with_motion(const HumanoidPart& part, const HumanoidPart& source, const std::string& clip) {
    const LoadedCharacter& from = *source.loaded;
    if (times_taken(from) >= max_times_taken)
        throw std::runtime_error("the clip was retargeted to " + std::to_string(max_times_taken) +
                                 " characters already, the maximum: export it, and load that file");
    const std::filesystem::path path(from.path);
    const Clip& wanted = clip_named(from.character, path, clip);
    const auto retargeted = [&](const Clip& each) {
        RetargetedMotion motion =
            retargeted_clip(from.character, *source.map, path, each, part.skeleton(), *part.map);
        motion.clip.name = free_name(*part.loaded, wanted.name);
        return motion;
    };
    RetargetedMotion motion = retargeted(wanted);
    const auto before = from.unfixed.find(wanted.name);
    const bool fixed = before != from.unfixed.end();
    PlayedMotion played;
    played.text = "Clip " + motion.clip.name + " from " + path.filename().string() +
                  (fixed ? ", with its fixes. " : ". ") + motion.notes.front();
    LoadedMotion made{from, wanted.name, std::move(motion.notes)};
    if (from.source || !corrections_of(*source.map, from).empty())
        made.source = source.loaded, made.source_as = reading_of(source);
    played.loaded = edited(
        part.loaded, {std::move(made), reading_of(part), std::make_shared<const Clip>(std::move(motion.clip)),
                      fixed ? std::make_shared<const Clip>(retargeted(*before->second).clip) : nullptr});
    return played;
}

void play_last_clip(HumanoidPart& part) {
    part.playback.clip = part.loaded->clips().size() - 1;
    part.playback.time = 0.0;
    part.playback.rounds = 0;
    part.playback.playing = true;
    measure_pace(part);
    part.quiet_ticks = 0;
}

const LoadedMotion* motion_of(const LoadedCharacter& character, std::size_t clip) {
    // Each edit has added a clip after the character's own.
    std::size_t at = character.source ? character.source->clips().size() : 0;
    for (const ClipEdit& each : character.edits)
        if (const auto* motion = std::get_if<LoadedMotion>(&each.what); motion && at++ == clip) return motion;
    return nullptr;
}

// The command and its rows in the panel.

namespace {

void load_motion(Workspace& workspace, const Arguments& given) {
    PlayedMotion played =
        with_motion(humanoid_part(workspace), HumanoidPart(load_character(given.text("path"))),
                    given.has("clip") ? given.text("clip") : std::string());
    HumanoidPart& part = workspace.document.edit<HumanoidPart>(humanoid_lab);
    part.loaded = std::move(played.loaded);
    play_last_clip(part);
    workspace.toast(played.text);
}

}  // namespace

void motion_note(const HumanoidPanel& panel) {
    if (!panel.part.playback.clip) return;
    const LoadedMotion* motion = motion_of(*panel.part.loaded, *panel.part.playback.clip);
    if (!motion) return;
    note("From " + std::filesystem::path(motion->file).filename().string() + ". " + motion->notes.front());
    if (ImGui::IsItemHovered()) tooltip(joined(std::span(motion->notes).subspan(1)));
}

void add_motion_commands(CommandTable& table) {
    table.add(
        followed({.name = "humanoid.motion.load",
                  .title = "Load another character's motion",
                  .arguments = {text_argument("path", true,
                                              "a .vrma, .vrm, .gltf, .glb, .fbx or .bvh file with a clip"),
                                text_argument("clip", false, "which one, by name; default: the first")},
                  .help = "Plays a clip of another character on this one through the two bone maps: limbs, "
                          "hands and fingers point in the same directions, feet stand where the other's do, "
                          "and the hips move in proportion to the legs",
                  .effect = Effect::Edit,
                  .apply = load_motion}));
}

}  // namespace tendril::app
