// What goes to files and comes from them besides characters: bone maps, and clips with all that IK did to
// them; and the cures of clips.
#include <algorithm>
#include <stdexcept>

#include "app/document/atomic_file.hpp"
#include "app/io/character/bake.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/map_file.hpp"
#include "app/labs/humanoid/character/kept_maps.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

using humanoid::Clip;
using humanoid::Fault;

std::string given_text(const Arguments& given, const char* name) {
    return given.has(name) ? given.text(name) : std::string();
}

void save_map(Workspace& workspace, const Arguments& given) {
    const HumanoidPart& part = humanoid_part(workspace);
    write_file_atomically(given.text("path"), map_text(saved_map(*part.map, part.skeleton())));
    workspace.toast("Written: " + given.text("path"));
}

void load_map(HumanoidPart& part, const Arguments& given) {
    take_map(part, applied(read_map(given.text("path")), part.skeleton()));
}

/// The clip that is named, or chosen, or the first.
std::size_t clip_for(const HumanoidPart& part, const Arguments& given) {
    const std::vector<Clip>& clips = part.loaded->clips();
    if (clips.empty()) throw std::invalid_argument("the character has no clips");
    const std::string name = given_text(given, "clip");
    if (name.empty()) return part.playback.clip.value_or(0);
    const auto found = std::ranges::find(clips, name, &Clip::name);
    if (found == clips.end()) throw std::invalid_argument("the character has no clip \"" + name + "\"");
    return static_cast<std::size_t>(found - clips.begin());
}

/// The clip as it would be seen, played once from its beginning.
Clip as_shown(const Workspace& workspace, std::size_t clip, double rate) {
    HumanoidPart part = humanoid_part(workspace);
    part.playback = {.clip = clip, .loop = false};
    IkState state;
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    const Clip& before = part.loaded->clips()[clip];
    return baked(part.skeleton(), before, rate, [&](std::span<rig::Transform> pose, double time, double dt) {
        part.playback.time = time;
        const ShownPose shown = solve_pose(part, solvers, dt, state);
        std::ranges::copy(shown.local, pose.begin());
    });
}

void export_shown(Workspace& workspace, const Arguments& given) {
    const HumanoidPart& part = humanoid_part(workspace);
    const std::size_t clip = clip_for(part, given);
    const double rate = given.has("fps") ? given.real("fps") : 60.0;
    const ExportReport report = export_clip({.character = part.loaded->character,
                                             .file = part.loaded->path,
                                             .original = part.loaded->clips()[clip],
                                             .corrected = as_shown(workspace, clip, rate),
                                             .rate = rate},
                                            given.text("path"));
    workspace.toast("Written: " + given.text("path") + ". " + report.text());
}

std::vector<std::string> fault_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < humanoid::fault_count; ++i)
        names.emplace_back(humanoid::name(static_cast<Fault>(i)));
    return names;
}

void cure_clip(HumanoidPart& part, const Arguments& given) {
    ClipCure cure;
    cure.clip =
        part.loaded->clips().empty() ? std::string() : part.loaded->clips()[clip_for(part, given)].name;
    cure.fault = *fault_named(given.text("kind"));
    cure.node = given_text(given, "node");
    if (!cure.node.empty()) node_named(part, cure.node);
    if (given.has("frame")) cure.frame = static_cast<std::size_t>(given.integer("frame"));
    part.loaded = cured(part, cure);
}

}  // namespace

std::optional<Fault> fault_named(const std::string& name) {
    for (std::size_t i = 0; i < humanoid::fault_count; ++i)
        if (name == humanoid::name(static_cast<Fault>(i))) return static_cast<Fault>(i);
    return std::nullopt;
}

void add_humanoid_file_commands(CommandTable& table) {
    table.add({.name = "humanoid.map.save",
               .title = "Save the bone map",
               .arguments = {text_argument("path", true, "a JSON file to write")},
               .help = "Writes which node is which bone",
               .effect = Effect::Look,
               .apply = save_map});
    table.add(keeping(
        part_command<HumanoidPart>(humanoid_lab, "humanoid.map.load", "Load a bone map",
                                   {text_argument("path", true, "a JSON file that humanoid.map.save wrote")},
                                   "Takes a bone map that was saved", load_map)));
    add_kept_map_commands(table);
    table.add({.name = "humanoid.export",
               .title = "Export a clip",
               .arguments = {text_argument("path", true, "a .gltf, .glb or .bvh file to write"),
                             clip_argument("clip", "which one; the chosen one, or the first"),
                             number_argument("fps", "frames a second; 60", min_rate, largest_rate)},
               .help = "Writes a clip with all that IK does to it, and says how near the file comes",
               .effect = Effect::Look,
               .apply = export_shown});
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.cure", "Fix a fault in a clip",
        {choice_argument("kind", true, "of fault", fault_names()),
         node_argument("node", false, "of the skeleton; all when left out"),
         integer_argument("frame", "of the clip's own; all when left out", 0, humanoid::max_lint_frames),
         clip_argument("clip", "which one; the chosen one, or the first")},
        "Mends what the motion lint has found in a clip", cure_clip));
}

}  // namespace tendril::app
