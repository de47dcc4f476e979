#include "app/labs/humanoid/character/character_commands.hpp"

#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>
#include <stdexcept>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/map_file.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/clip/clip_lint.hpp"
#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/system/atomic_file.hpp"
#include "app/view/camera.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::FileSpace>() noexcept {
    using namespace app;
    static constexpr auto axes = up_axes.name_array();
    static constexpr auto ways = root_positions.name_array();
    static constexpr Field rows[] = {field<&FileSpace::up>("axis", axes),
                                     field<&FileSpace::positions>("positions", ways)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<FileSpace>() {
    static constexpr FieldText texts[] = {
        {.name = "axis",
         .label = "up axis",
         .help =
             "The axis of the file that points up. A BVH does not say, so it is found from the zero pose and "
             "the motion; of FBX and glTF, Y means up as the file says",
         .more = true,
         .listed = true,
         .choices = up_axes.rows},
        {.name = "positions",
         .label = "root",
         .help = "Whether the root's positions in a BVH replace its OFFSET or are added to it. Chosen so "
                 "that the feet are on the floor",
         .more = true,
         .listed = true,
         .choices = root_positions.rows}};
    return texts;
}

namespace {

using humanoid::Bone;

const std::filesystem::path& folder_of(const Workspace& workspace) {
    if (workspace.config.empty()) throw std::invalid_argument("there is no folder to keep maps in");
    return workspace.config;
}

void keep(Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    humanoid_runtime(workspace).kept_maps.forget();
    keep_map(folder_of(workspace), saved_map(*part.map, part.skeleton()), part.skeleton());
}

void keep_and_report(Workspace& workspace, const Arguments&) {
    keep(workspace);
    workspace.toast("The bone map is kept for characters with these node names");
}

void use(Workspace& workspace, const Arguments&) {
    KeptMaps& maps = humanoid_runtime(workspace).kept_maps;
    if (const std::string& why = maps.refused(workspace); !why.empty()) throw std::invalid_argument(why);
    const SavedMap* const kept = maps.kept(workspace);
    if (kept == nullptr) throw std::invalid_argument("no map is kept for the character's node names");
    change_part<HumanoidPart>(workspace, humanoid_lab, [&](HumanoidPart& part, const HumanoidPart&) {
        correct(part, corrections_of(applied(*kept, part.skeleton()), *part.loaded));
    });
}

void forget(Workspace& workspace, const Arguments&) {
    humanoid_runtime(workspace).kept_maps.forget();
    if (!forget_kept_map(folder_of(workspace), humanoid_part(workspace).skeleton()))
        throw std::invalid_argument("no map is kept for the character's node names");
}

/// Keeps a correction, if the window keeps things. Reports errors as a toast only.
void keep_correction(Workspace& workspace) {
    if (!workspace.keeps || workspace.config.empty()) return;
    const HumanoidPart& part = humanoid_part(workspace);
    try {
        // A map that equals the automatic match need not be kept.
        const SavedMap matched = saved_map(part.loaded->matched, part.skeleton());
        if (!bones_that_differ(matched, part).empty()) return keep(workspace);
        humanoid_runtime(workspace).kept_maps.forget();
        forget_kept_map(workspace.config, part.skeleton());
    } catch (const std::exception& error) {
        workspace.toast(std::string("The bone map is not kept: ") + error.what(), ToastKind::Refusal);
    }
}

}  // namespace

void KeptMaps::look(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    if (of_ == part.loaded && folder_ == workspace.config) return;
    of_ = part.loaded;
    folder_ = workspace.config;
    kept_.reset();
    refused_.clear();
    if (folder_.empty()) return;
    try {
        kept_ = find_kept_map(folder_, part.skeleton());
    } catch (const std::exception& error) {
        refused_ = std::string("the kept bone map is ignored: ") + error.what();
    }
}

const SavedMap* KeptMaps::kept(const Workspace& workspace) {
    look(workspace);
    return kept_ ? &*kept_ : nullptr;
}

const SavedMap* KeptMaps::offered(const Workspace& workspace) {
    const SavedMap* const map = kept(workspace);
    return map != nullptr && !bones_that_differ(*map, humanoid_part(workspace)).empty() ? map : nullptr;
}

const std::string& KeptMaps::refused(const Workspace& workspace) {
    look(workspace);
    return refused_;
}

std::vector<Bone> bones_that_differ(const SavedMap& map, const HumanoidPart& part) {
    std::vector<Bone> bones;
    const SavedMap now = saved_map(*part.map, part.skeleton());
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map.bones[i] != now.bones[i]) bones.push_back(static_cast<Bone>(i));
    return bones;
}

Command keeping(Command command) {
    command.apply = [correct = command.apply](Workspace& workspace, const Arguments& given) {
        correct(workspace, given);
        keep_correction(workspace);
    };
    return command;
}

void add_kept_map_commands(CommandTable& table) {
    table.add("humanoid.map.keep", "Keep the bone map", {},
              "Keeps the bone map, to be offered for characters with the same node names", Effect::Look,
              keep_and_report);
    table.add("humanoid.map.use", "Use the kept bone map", {},
              "Uses the bone map that was kept for these node names", Effect::Edit, use);
    table.add("humanoid.map.forget", "Forget the kept bone map", {},
              "Removes the bone map that was kept for these node names", Effect::Look, forget);
}

// Commands on the character and its bone map.

namespace {

/// Frames the whole figure as it stands now, in the lab's current view or the one that it will open with.
void show_all(Workspace& workspace) {
    CameraPose& camera = workspace.lab == humanoid_lab ? workspace.camera : workspace.cameras[humanoid_lab];
    camera = workspace.first_view_of(humanoid_lab);
    if (humanoid_part(workspace).loaded->file.empty()) return;
    const Bounds all = figure_bounds(workspace);
    camera = framed(camera, {{0.0f, 0.0f}, workspace.ui.view_size}, all.centre, all.radius);
}

/// Work that loading another character would discard, for the user: "2 fixes, 1 loaded motion"; empty if
/// there is none. `keeps_clip`: the chosen clip stays, with its fixes and the bone map it was read with.
std::string discarded_text(const HumanoidPart& part, bool keeps_clip) {
    std::vector<std::string> all;
    const auto add = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) all.push_back(std::to_string(count) + ' ' + (count == 1 ? one : many));
    };
    std::vector<ClipEdit> edits = part.loaded->edits;
    if (keeps_clip)
        std::erase_if(edits, [&](const ClipEdit& each) { return each.clip->name == part.clip()->name; });
    const auto motions = static_cast<std::size_t>(std::ranges::count_if(
        edits, [](const ClipEdit& each) { return std::holds_alternative<LoadedMotion>(each.what); }));
    add(edits.size() - motions, "fix of a clip", "fixes of clips");
    add(motions, "loaded motion", "loaded motions");
    if (!keeps_clip) add(corrections_of(*part.map, *part.loaded).size(), "corrected bone", "corrected bones");
    add(static_cast<std::size_t>(
            std::ranges::count_if(part.ik.targets, [](const auto& each) { return each.has_value(); })),
        "target", "targets");
    add(part.curves.size(), "curve", "curves");
    // The built-in figure's attachments and IK may come from the opening.
    if (part.loaded->file.empty()) return comma_list(all);
    add(part.attachments.list.size(), "attachment", "attachments");
    IkSettings rest = part.ik;
    rest.targets = {};
    if (!(rest == IkSettings())) all.emplace_back("IK settings");
    return comma_list(all);
}

/// `plays`: the new character plays the old one's clip.
void show(Workspace& workspace, SharedCharacter character, bool plays) {
    const HumanoidPart& before = humanoid_part(workspace);
    HumanoidPart part(std::move(character));
    // If a file has only one clip, play it.
    if (part.loaded->clips().size() == 1) part.playback = {.clip = 0, .playing = true};
    std::string text;
    if (plays) {
        if (before.clip() == nullptr) throw std::invalid_argument("no clip is chosen");
        PlayedMotion played = with_motion(part, before, before.clip()->name);
        part.loaded = std::move(played.loaded);
        play_last_clip(part);
        text = played.text;
    }
    if (const std::string lost = discarded_text(before, plays); !lost.empty())
        text +=
            (plays ? " " : "") + ("Discarded with the last character: " + lost) + ". Undo brings it back.";
    if (!text.empty()) workspace.toast(text);
    take_springs(part);
    part.view = before.view;
    part.attachments.world = empty_world(before.attachments.world->settings());
    part.selection = selection_in(part.skeleton(), before.selection, before.skeleton());
    workspace.document.edit<HumanoidPart>(humanoid_lab) = part;
    show_all(workspace);
    if (const std::string& why = humanoid_runtime(workspace).kept_maps.refused(workspace); !why.empty())
        workspace.toast(why, ToastKind::Refusal);
}

void load(Workspace& workspace, const Arguments& given, bool plays) {
    const std::string file = text_or_none(given, "path");
    if (given.has("path") && file.empty()) throw std::invalid_argument("path is empty");
    Loading& loading = humanoid_runtime(workspace).loading;
    if (loads_beside(workspace, file))
        return loading.begin({.command = "humanoid.load",
                              .what = "Loading " + std::filesystem::path(file).filename().string(),
                              .from = workspace.lab,
                              .run = [file, plays](LoadProgress& progress) -> Loading::Change {
                                  return [character = load_character(file, &progress),
                                          plays](Workspace& now) { show(now, character, plays); };
                              }});
    SharedCharacter character = load_character(file);
    loading.cancel();
    show(workspace, std::move(character), plays);
}

/// True if a file has a motion but nothing to draw: a BVH, a VRM animation, or a glTF or FBX without a mesh.
bool is_bare_motion(const std::filesystem::path& file) {
    const std::string ending = lower_case(file.extension().string());
    if (ending == ".bvh" || ending == ".vrma") return true;
    // Binary files list their kinds of objects at the start: no need to read their data.
    constexpr std::uintmax_t enough = 4u << 20;
    try {
        const std::string bytes = character_bytes(file, ending == ".gltf" ? UINTMAX_MAX : enough);
        return bytes.find(ending == ".fbx" ? "Geometry" : "\"meshes\"") == bytes.npos;
    } catch (const std::exception&) {
        return false;  // opening it reports why
    }
}

void map(HumanoidPart& part, const Arguments& given) {
    const Bone bone = *humanoid::bone_named(given.text("bone"));
    humanoid::BoneMap wanted = *part.map;
    wanted[bone].node = -1;
    if (given.has("node") && !given.text("node").empty()) {
        const std::size_t node = node_named(part, given.text("node"));
        if (const auto before = part.bone_of(node)) wanted[*before].node = -1;
        wanted[bone].node = static_cast<std::int32_t>(node);
    }
    correct(part, corrections_of(wanted, *part.loaded));
}

/// Scales everything that the user placed on or around the character, to keep its place in the new unit.
void scale_places(HumanoidPart& part, double factor) {
    const auto scale = [&](glm::dvec3& position) {
        constexpr auto most = static_cast<double>(max_magnitude);
        position = glm::clamp(factor * position, -most, most);
    };
    for (BoneCurve& each : part.curves)
        for (glm::vec3& point : each.shape.points) point *= static_cast<float>(factor);
    for (std::optional<humanoid::BodyTarget>& target : part.ik.targets)
        if (target) scale(target->position);
    if (part.ik.look_at.placed) scale(part.ik.look_at.options.target);
    if (part.ik.hold) scale(part.ik.hold->position);
    for (SpringSetting& each : part.springs)
        each.options.hit_radius = std::min(factor * each.options.hit_radius, max_hit_radius());
}

/// Reads the character's file with another unit or other axes.
void read_again(Workspace& workspace, double metres, const FileSpace& space) {
    const HumanoidPart& now = humanoid_part(workspace);
    const SharedCharacter before = now.loaded;
    const double was = before->character.scale;
    if (metres == was && space == before->character.space) return;
    if (before->file.empty())
        throw std::invalid_argument("the stick figure has no file and is in metres, Y up");
    const SharedCharacter loaded = read_as(before, metres, space);
    const Corrections corrections = corrections_of(*now.map, *before);
    HumanoidPart& part = workspace.document.edit<HumanoidPart>(humanoid_lab);
    part.loaded = loaded;
    correct(part, corrections);
    part.ik_state.springs.clear();  // the IK state is in the old metres
    part.ik_state.release = {};
    part.ik_state.body = {};
    part.ik_state.hold = {};
    scale_places(part, metres / was);
    remake_attachments(workspace, metres / was);
    show_all(workspace);
}

void set_space(Workspace& workspace, const Arguments& given) {
    const Character& character = humanoid_part(workspace).loaded->character;
    FileSpace space = character.space;
    set_fields(given, space);
    if (space.positions == RootPositions::Add && character.root_offsets.empty())
        throw std::invalid_argument("the file has no root with both an OFFSET and positions");
    read_again(workspace, character.scale, space);
}

/// A command for one of the fields of FileSpace.
Command space_command(const char* name, const char* title, std::size_t field, const char* help) {
    Argument argument = field_arguments<FileSpace>()[field];
    argument.required = true;
    return {.name = name,
            .title = title,
            .arguments = {std::move(argument)},
            .help = help,
            .effect = Effect::Edit,
            .apply = set_space};
}

/// True if the T-pose correction would turn anything: it needs a limb of two bones.
bool has_limbs(const HumanoidPart& part) {
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

std::vector<FileWay> HumanoidLab::file_ways(const Workspace& workspace,
                                            const std::filesystem::path& file) const {
    const HumanoidPart& part = humanoid_part(workspace);
    const LoadedCharacter& loaded = *part.loaded;
    if (loaded.file.empty() || !part.map->is_usable() || !ends_as_character(file)) return {};
    const std::string before = std::filesystem::path(loaded.file).filename().string();
    const bool shows_motion = !loaded.character.skin.mesh && part.clip() != nullptr;
    const FileWay alone{"Open it on its own", "Replaces " + before, "humanoid.load"};
    if (is_bare_motion(file) != shows_motion) {
        if (!shows_motion)
            return {{"Play it on the figure", "A clip for " + before + ", by the bone maps",
                     "humanoid.motion.load"},
                    alone};
        return {{"Play \"" + part.clip()->name + "\" on it", "With its fixes, if it has any",
                 "humanoid.motion.take"},
                alone};
    }
    return {};
}

void finish_loading(Workspace& workspace) {
    Loading& loading = humanoid_runtime(workspace).loading;
    if (!loading.running()) return;
    const Loading::Work work = loading.work();
    Loading::Change change;
    try {
        change = loading.take();
    } catch (const std::exception& error) {
        throw Refused(work.command + ": " + error.what());
    }
    // A single undo step, as if the command had done all the work at once.
    const Document before = workspace.document;
    Place from = workspace.place();
    // The user may have opened the file from another lab, which is now closed.
    if (const auto camera = workspace.cameras.find(work.from);
        work.from != workspace.lab && camera != workspace.cameras.end()) {
        from.lab = work.from;
        from.camera = camera->second;
    }
    change(workspace);
    workspace.rewind.forget_from(workspace.moment);
    ++workspace.edition;
    workspace.history.push(before.without(workspace.document), work.command, 0, from, workspace.place());
}

std::vector<std::string> bone_names() {
    return bone_names([](std::size_t) { return true; });
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
         .arguments = {text_argument(
             "path", false, "a .gltf, .glb, .vrm, .vrma, .fbx or .bvh file; if omitted, the stick figure")},
         .help =
             "Loads a character: in its rest pose, or playing if it has just one clip; selected nodes that "
             "it also has stay selected",
         .effect = Effect::Edit,
         .apply = [](Workspace& workspace, const Arguments& given) { load(workspace, given, false); },
         .finish = finish_loading});
    table.add({.name = "humanoid.motion.take",
               .title = "Load a character for this motion",
               .arguments = {text_argument("path", true, "a .gltf, .glb, .vrm, .fbx or .bvh file")},
               .help = "Loads a character, and plays the chosen clip on it, with the fixes made on that clip",
               .effect = Effect::Edit,
               .apply = [](Workspace& workspace, const Arguments& given) { load(workspace, given, true); },
               .finish = finish_loading});
    table.add("humanoid.load.cancel", "Stop loading or fixing", {},
              "Stops loading a large file or fixing a long clip; the current character stays", Effect::Look,
              [](Workspace& workspace, const Arguments&) { humanoid_runtime(workspace).loading.cancel(); });
    table.add(keeping(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.map", "Map a bone to a node",
        {choice_argument("bone", true, "which", bone_names()),
         node_argument("node", false, "of the skeleton, by name; none if omitted")},
        "Sets which node of the character a bone is", map)));
    table.add("humanoid.scale", "Correct the character's scale",
              {{.name = "metres", .help = "per unit of the file", .low = min_unit, .high = max_unit}},
              "Corrects the unit of the character's file", Effect::Edit,
              [](Workspace& w, const Arguments& given) {
                  read_again(w, given.real("metres"), humanoid_part(w).loaded->character.space);
              });
    table.add(space_command("humanoid.up", "Correct the character's up axis", 0,
                            "Sets which axis of the character's file points up"));
    table.add(space_command("humanoid.root", "Correct the character's root positions", 1,
                            "Sets whether a BVH's root positions replace its OFFSET or are added to it"));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.t_pose", "Show the T-pose",
        {{.name = "on", .type = ArgumentType::Boolean, .help = "false: shows the file's own rest pose"}},
        "Shows the rest pose with arms straight out to the sides and legs straight down", set_t_pose));
}

// Commands on files: bone maps, clips exported as IK leaves them, and cures of clips.

namespace {

using humanoid::Clip;
using humanoid::Fault;

void save_map(Workspace& workspace, const Arguments& given) {
    const HumanoidPart& part = humanoid_part(workspace);
    workspace.writes().write(given.text("path"), OutputKind::BoneMap,
                             map_text(saved_map(*part.map, part.skeleton())));
    workspace.toast(written_text(given.text("path")));
}

void load_map(HumanoidPart& part, const Arguments& given) {
    correct(part, corrections_of(applied(read_map(given.text("path")), part.skeleton()), *part.loaded));
}

/// The named clip, else the chosen one, else the first.
std::size_t clip_for(const HumanoidPart& part, const Arguments& given) {
    if (part.loaded->clips().empty()) throw std::invalid_argument("the character has no clips");
    const std::string name = text_or_none(given, "clip");
    return name.empty() ? part.playback.clip.value_or(0) : part.loaded->clip_called(name);
}

/// True if the file can hold more than the character's own bones.
bool takes_worn(const std::filesystem::path& path) {
    return lower_case(path.extension().string()) != ".bvh";
}

/// ". With: cape, rifle" or ". Left out: cape, rifle".
std::string worn_text(const HumanoidPart& part, const ExportReport& report,
                      const std::filesystem::path& path) {
    if (!takes_worn(path)) return left_out_text(part, true);
    return report.worn.empty() ? "" : ". With: " + name_list_text(report.worn);
}

ExportReport export_one(Workspace& workspace, const Arguments& given, std::size_t clip,
                        const std::filesystem::path& path) {
    const HumanoidPart& part = humanoid_part(workspace);
    const Clip& original = part.loaded->clip_unfixed(clip);
    const double rate =
        given.has("fps") ? given.real("fps") : humanoid::frame_rate(part.loaded->clips()[clip]);
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    Wardrobe wardrobe{humanoid_runtime(workspace).ropes};
    const Clip shown = clip_as_shown(part, solvers, clip, rate, takes_worn(path) ? &wardrobe : nullptr);
    return export_clip({.character = part.loaded->character,
                        .file = part.loaded->path,
                        .original = original,
                        .corrected = shown,
                        .rate = rate,
                        .ground = ground_of_feet(part, solvers),
                        .worn = std::move(wardrobe.worn),
                        .outputs = &workspace.writes()},
                       path);
}

void export_shown(Workspace& workspace, const Arguments& given) {
    const Character& character = humanoid_part(workspace).loaded->character;
    const std::size_t clip = clip_for(humanoid_part(workspace), given);
    const std::filesystem::path path = given.text("path");
    if (given.has("all") && given.boolean("all")) {
        if (given.has("clip")) throw std::invalid_argument("give either a clip or all of them");
        const std::vector<std::filesystem::path> paths = paths_of_clips(character, path);
        std::vector<ExportReport> reports;
        workspace.writes().check(paths, OutputKind::Motion);
        for (std::size_t i = 0; i < paths.size(); ++i)
            reports.push_back(export_one(workspace, given, i, paths[i]));
        return workspace.toast(
            written_text(paths.front()) + (paths.size() > 1 ? " and the others" : std::string()) + ". " +
            sum_text(reports) + worn_text(humanoid_part(workspace), reports.front(), path));
    }
    if (ends_as_export(path)) workspace.writes().check({path}, OutputKind::Motion);  // before it is simulated
    const ExportReport report = export_one(workspace, given, clip, path);
    const std::string which = one_of_clips_text(character, character.clips[clip].name);
    workspace.toast(written_text(path) + ". " + (which.empty() ? which : which + ". ") + report.text() +
                    worn_text(humanoid_part(workspace), report, path));
}

std::vector<std::string> fault_names() {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < humanoid::fault_count; ++i)
        names.emplace_back(humanoid::name(static_cast<Fault>(i)));
    return names;
}

void cure_clip(Workspace& workspace, const Arguments& given) {
    const HumanoidPart& part = humanoid_part(workspace);
    ClipCure cure{.clip = part.loaded->clips()[clip_for(part, given)].name};
    if (given.has("kind")) cure.fault = fault_named(given.text("kind"));
    cure.node = text_or_none(given, "node");
    if (!cure.node.empty()) node_named(part, cure.node);
    if (given.has("frame")) cure.frame = static_cast<std::size_t>(given.integer("frame"));
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    if (part.view.judged == JudgedClip::Result && part.clip() != nullptr && part.clip()->name == cure.clip)
        require_cure_in_clip(part, cure, *runtime.lint.judge(part, runtime.solvers));
    const auto put = [](Workspace& now, CuredClip result) {
        HumanoidPart& changed = now.document.edit<HumanoidPart>(humanoid_lab);
        changed.loaded = std::move(result.loaded);
        measure_pace(changed);
        now.toast(result.text);
    };
    if (!workspace.clock.measured || judged_soon(part)) return put(workspace, cured(part, cure));
    runtime.loading.begin({.command = "humanoid.cure",
                           .what = "Fixing " + cure.clip,
                           .from = workspace.lab,
                           .run = [was = part, cure, put](LoadProgress& progress) -> Loading::Change {
                               return [loaded = was.loaded, result = cured(was, cure, &progress),
                                       put](Workspace& now) {
                                   if (humanoid_part(now).loaded != loaded)
                                       throw Refused("humanoid.cure: the character has changed");
                                   put(now, result);
                               };
                           }});
}

}  // namespace

std::optional<Fault> fault_named(const std::string& name) {
    for (std::size_t i = 0; i < humanoid::fault_count; ++i)
        if (name == humanoid::name(static_cast<Fault>(i))) return static_cast<Fault>(i);
    return std::nullopt;
}

void add_humanoid_file_commands(CommandTable& table) {
    table.add("humanoid.map.save", "Save the bone map", {text_argument("path", true, "a JSON file to write")},
              "Writes which node is which bone", Effect::Look, save_map);
    table.add(keeping(
        part_command<HumanoidPart>(humanoid_lab, "humanoid.map.load", "Load a bone map",
                                   {text_argument("path", true, "a JSON file that humanoid.map.save wrote")},
                                   "Applies a saved bone map", load_map)));
    add_kept_map_commands(table);
    table.add("humanoid.export", "Export a clip",
              {text_argument("path", true, "a .gltf, .glb or .bvh file to write"),
               clip_argument("clip", "which one; default: the chosen one, or the first"),
               switch_argument("all", "writes every clip, each to a file with its name added"),
               number_argument("fps", "frames per second; default: the clip's own", min_rate, largest_rate)},
              "Writes a clip as shown, after IK; says how far the file is from it, and what Motion lint "
              "finds in it",
              Effect::Look, export_shown);
    table.add({.name = "humanoid.cure",
               .title = "Fix faults in a clip",
               .arguments = {choice_argument("kind", false, "of fault; all if omitted", fault_names()),
                             node_argument("node", false, "of the skeleton; all if omitted"),
                             integer_argument("frame", "of the clip's own frames; all if omitted", 0,
                                              humanoid::max_lint_frames),
                             clip_argument("clip", "which one; default: the chosen one, or the first")},
               .help = "Fixes the faults that Motion lint found in a clip without adding any; says which are "
                       "left and why",
               .effect = Effect::Edit,
               .apply = cure_clip,
               .finish = finish_loading});
}

}  // namespace tendril::app
