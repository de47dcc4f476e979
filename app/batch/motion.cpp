#include "app/batch/subcommands.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <tendril/humanoid/lint.hpp>

#include "app/batch/output.hpp"
#include "app/io/character/bake.hpp"
#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/retargeted_motion.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using humanoid::Clip;
using humanoid::Finding;
using humanoid::LintReport;

/// A file without clips is checked in its rest pose.
std::vector<Clip> clips_of(const Character& character) {
    if (!character.clips.empty()) return character.clips;
    return {Clip{.name = "rest", .duration = 0.0, .channels = {}}};
}

std::string counted(std::size_t count, const char* what) {
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

Json finding_json(const Finding& finding, const humanoid::Skeleton& skeleton) {
    const Json node = finding.node < 0 ? Json() : Json(skeleton[static_cast<std::size_t>(finding.node)].name);
    return {{"kind", name(finding.fault)}, {"frame", finding.frame}, {"first_frame", finding.first},
            {"last_frame", finding.last},  {"time", finding.time},   {"joint", node},
            {"amount", finding.amount},    {"unit", finding.unit},   {"text", finding.text},
            {"cure", finding.has_cure}};
}

Json lint_json(const LintReport& report, const Clip& clip, const humanoid::Skeleton& skeleton) {
    Json findings = Json::array();
    for (const Finding& each : report.findings) findings.push_back(finding_json(each, skeleton));
    return {{"name", clip.name},
            {"duration", clip.duration},
            {"frame_rate", report.rate},
            {"frames", report.frames},
            {"floor", report.has_floor ? Json(report.floor) : Json()},
            {"findings", findings}};
}

void print_lines(const LintReport& report, const Clip& clip, Output& out) {
    for (const Finding& each : report.findings) {
        char place[120];
        std::snprintf(place, sizeof place, "frame %zu of %zu at %.6g fps, %.3f s", each.frame, report.frames,
                      report.rate, each.time);
        out.write(printable(clip.name) + ": " + name(each.fault) + ", " + place + ": " +
                  printable(each.text) + '\n');
    }
}

/// Replaces the character's clips by the motion's, or by the named one. Returns lines to print about it.
std::vector<std::string> play_motion(Character& character, const std::string& motion,
                                     const std::string* clip) {
    const humanoid::BoneMap map = bone_map(character);
    std::vector<std::string> notes = guesses_of(character, map);
    if (motion.empty()) return notes;
    const Character source = read_character(motion);
    const humanoid::BoneMap source_map = bone_map(source);
    const Clip* const first = &clip_named(source, motion, clip ? *clip : std::string_view());
    character.clips.clear();
    for (const Clip& each : source.clips) {
        if (clip && &each != first) continue;
        RetargetedMotion made = retargeted_clip(source, source_map, motion, each, character.skeleton, map);
        if (character.clips.empty())
            notes.push_back(fs::path(motion).filename().string() + ": " + joined(made.notes));
        character.clips.push_back(std::move(made.clip));
    }
    return notes;
}

void print_notes(const std::vector<std::string>& notes, Output& out) {
    for (const std::string& each : notes) out.write("Note: " + printable(each) + '\n');
}

/// The default output: beside the file, in its format if that can be written, else glTF.
fs::path default_output(const fs::path& file) {
    const std::string ending = ends_as_export(file) ? file.extension().string() : ".glb";
    return file.parent_path() / (file.stem().string() + "_baked" + ending);
}

ExportReport bake_one(const Character& character, const Clip& clip, const BakeOptions& options,
                      const fs::path& out, Outputs& outputs) {
    const double rate = options.fps.value_or(humanoid::frame_rate(clip));
    Clip corrected = clip;
    if (options.travel) {
        const glm::dvec3 ground_moves = lint(character.skeleton, bone_map(character), clip).treadmill;
        if (ground_moves != glm::dvec3(0.0))
            corrected = travelling(character.skeleton, clip, -ground_moves, rate);
    }
    humanoid::Ground ground;
    if (options.ground != "none") {
        try {
            ground = make_ground({.kind = ground_kinds.value(options.ground)});
            corrected = with_feet_on(ground, character.skeleton, bone_map(character), corrected, rate);
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(fs::path(options.file).filename().string() + ": " + error.what());
        }
    }
    return export_clip({.character = character,
                        .file = options.file,
                        .original = clip,
                        .corrected = corrected,
                        .rate = rate,
                        .ground = &ground,
                        .outputs = &outputs},
                       out);
}

}  // namespace

std::size_t run_lint(const LintOptions& options) {
    Character character = read_character(options.file);
    const std::vector<std::string> notes = play_motion(character, options.motion, nullptr);
    const humanoid::BoneMap map = bone_map(character);
    Progress progress;
    Output out(progress);
    if (!options.json) print_notes(notes, out);
    Json clips = Json::array();
    std::size_t findings = 0;
    const std::vector<Clip> all = clips_of(character);
    for (std::size_t i = 0; i < all.size(); ++i) {
        progress.show("judging", static_cast<double>(i) / static_cast<double>(all.size()));
        const LintReport report = lint(character.skeleton, map, all[i]);
        findings += report.findings.size();
        if (options.json)
            clips.push_back(lint_json(report, all[i], character.skeleton));
        else
            print_lines(report, all[i], out);
    }
    if (options.json)
        out.write(
            Json{{"file", options.file}, {"notes", notes}, {"clips", clips}, {"findings", findings}}.dump(
                2, ' ', false, Json::error_handler_t::replace) +
            '\n');
    else
        out.write(counted(findings, "finding") + " in " + counted(character.clips.size(), "clip") + '\n');
    out.finish();
    return findings;
}

std::vector<std::string> bake_grounds() {
    return ground_kinds.names();
}

void run_bake(const BakeOptions& options) {
    // The command line's own check accepts NaN.
    if (options.fps && !(*options.fps >= min_rate && *options.fps <= largest_rate))
        throw std::runtime_error("--fps: must be 1 to 1000, got " + std::to_string(*options.fps));
    Character character = read_character(options.file);
    const std::vector<std::string> notes =
        play_motion(character, options.motion, options.all ? nullptr : &options.clip);
    const Clip* const first = options.motion.empty() ? &clip_named(character, options.file, options.clip)
                                                     : &character.clips.front();
    const fs::path out = options.out.empty() ? default_output(options.file) : fs::path(options.out);
    Outputs outputs;
    outputs.force = options.force;
    outputs.inputs = {options.file};
    if (!options.motion.empty()) outputs.inputs.emplace_back(options.motion);
    Progress progress;
    Output print(progress);
    print_notes(notes, print);
    if (options.all) {
        const std::vector<fs::path> paths = paths_of_clips(character, out);
        outputs.check(paths, OutputKind::Motion);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            progress.show("writing", static_cast<double>(i) / static_cast<double>(paths.size()));
            const Clip& clip = character.clips[i];
            print.write(paths[i].string() + ": " + printable(clip.name) + ", " +
                        bake_one(character, clip, options, paths[i], outputs).text() + '\n');
        }
    } else {
        const std::string which = one_of_clips_text(character, first->name);
        print.write(out.string() + ": " + printable(which.empty() ? first->name : which) + ", " +
                    bake_one(character, *first, options, out, outputs).text() + '\n');
    }
    print.finish();
}

const char* const lint_help =
    R"(FILE is a .gltf, .glb, .vrm, .vrma, .fbx or .bvh file. All of its clips are checked for
skating, floating and sinking feet, knees that pop, rotation keys that go the long
way round, joints that jump or bend far beyond human range, scale and axis faults.
With --motion, the clips of that file are retargeted to this character and checked.
Prints the guesses made where a file does not say (unit, up axis, root), and what was
left out. Then one line per finding, with its frame, time, joint and amount; with
--json one object:
  {"file", "notes": [sentences], "findings": 2, "clips": [{"name", "duration",
   "frame_rate", "frames", "floor", "findings": [{"kind", "frame", "first_frame",
   "last_frame", "time", "joint", "amount", "unit", "text", "cure"}]}]}
Frames are counted from 0 at the rate of the clip's keys; the floor is null if no
foot ever stands. Feet and knees need a skeleton with legs.
Exit code 0: nothing was found; 1: something was; 2: the file cannot be read.
To open a scene file that is named lint, write ./lint.)";

const char* const bake_help =
    R"(FILE is a .gltf, .glb, .vrm, .vrma, .fbx or .bvh file. One of its clips, by
default the first, is written to --out, or to FILE_baked beside the file: as glTF,
GLB or BVH, depending on the name's ending. With --all every clip is written, each
to its own file: its name is added to the file's. With --motion, the clips come from
that file, another character's: limbs point, and feet stand, as they do there. glTF
from a glTF file keeps its nodes, skins, materials, meshes and
pictures unchanged. With a ground, the feet are put on it first: flat, a slope of 20
degrees or stairs 15 cm high and 30 cm deep, which rise along +Z, or terrain, low
hills. A clip that walks in place climbs nothing: with --travel it moves at the speed
of its standing foot. The file is then read back, and two errors are printed: the
largest distance of a joint from its place before, in mm, and how far a standing foot
slides at most, before and after. A BVH's frame 0 is time 0. Guesses made where a file
does not say (unit, up axis, root) are printed first. A glTF, GLB or BVH file
that exists is replaced only with --force, as a whole or not at all; any other file
and the files read never are (exit code 2). A signal ends it at once.
To open a scene file that is named bake, write ./bake.)";

}  // namespace tendril::app
