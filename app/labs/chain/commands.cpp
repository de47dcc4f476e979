#include "app/labs/chain/commands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/engine_trace.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/view/assets.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainSolve change, Effect effect) {
    return part_command<ChainPart>(chain_lab, name, title, std::move(arguments), help, effect,
                                   [change, effect](Workspace& workspace, ChainPart& part,
                                                    const ChainPart& before, const Arguments& given) {
                                       ChainRuntime& runtime = workspace.runtimes.of<ChainRuntime>(chain_lab);
                                       part.study.gesture_begins = workspace.gesture_begins;
                                       const bool edits = effect == Effect::Edit;
                                       // Edits apply to the chain as it was given.
                                       if (edits && part.mode == ChainMode::Curve)
                                           std::swap(part.chain, part.along.given);
                                       change(part, given, runtime);
                                       if (edits) keep_on_curve(part, before);
                                       if (part.mode != ChainMode::Curve)
                                           keep_in_plane(part.chain, part.reach, runtime);
                                       // The study must always belong to the chain that is shown.
                                       if (part.study.open() && edits) reach_for(part, part.target, runtime);
                                       check_range(part);
                                       keep_step(part, runtime);
                                   });
}

Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainChange change, Effect effect) {
    return chain_command(
        name, title, std::move(arguments), help,
        ChainSolve([change](ChainPart& part, const Arguments& given, ChainRuntime&) { change(part, given); }),
        effect);
}

Argument index_argument(bool required, const char* help) {
    return offering(index_argument("index", required, help, max_segments), [](const Workspace& w) {
        return places(w.document.get<ChainPart>(chain_lab).chain.size());
    });
}

std::size_t index_of(const Arguments& given) {
    return static_cast<std::size_t>(given.integer("index"));
}

void check_index(const ChainPart& part, std::size_t index) {
    if (index >= part.chain.size()) {
        throw Refused("index " + std::to_string(index) + " is out of range, the chain has " +
                      std::to_string(part.chain.size()) + " segments");
    }
}

Argument joints_argument() {
    return index_list_argument("joints", "index");
}

std::vector<std::size_t> joints_of(const Arguments& given, const ChainPart& part) {
    if (!gives_one(given, "index", "joints")) return index_list(given, "joints", part.chain.size());
    const std::size_t index = index_of(given);
    check_index(part, index);
    return {index};
}

std::vector<std::size_t> joints_to_set(const Arguments& given, const ChainPart& part) {
    std::vector<std::size_t> joints = joints_of(given, part);
    if (joints.empty()) throw Refused("joints is empty");
    std::sort(joints.begin(), joints.end());
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    return joints;
}

void add_chain_commands(CommandTable& table) {
    add_shape_commands(table);
    add_mode_commands(table);
    add_reach_commands(table);
    add_curve_command(table);
    add_study_commands(table);
    add_copy_commands(table);
    add_paste_command(table);
    add_trace_commands(table);
    add_save_trace_command(table);
}

void pull_joints(ChainPart& part, const std::vector<JointPull>& asked, ChainRuntime& runtime) {
    if (part.mode == ChainMode::Curve) throw Refused("in mode curve the control points move the joints");
    std::vector<JointPull> pulls = asked;
    for (JointPull& pull : pulls)
        // The plane passes through the root, so a dragged root moves the plane.
        if (pull.joint > 0 || part.mode != ChainMode::Reach)
            pull.to = in_plane(part.chain, part.reach, pull.to);
    if (part.mode == ChainMode::Reach) {
        drag_joints(part.chain, part.reach, pulls, part.target, runtime);
    } else {
        require_ok(trail_joints(part.chain, pulls));
        part.target = pulls.front().to;
    }
    part.result.reset();
    const Study::Kind kind = part.study.kind;
    if (part.study.open()) part.study.begin(kind, Study::From::Here, part.chain, part.reach);
}

// Mode, target, drags and motion.

namespace {

void set_mode(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const ChainMode mode = chain_modes.value(given.text("mode"));
    const std::size_t led = part.index;
    const bool was_led = mode == ChainMode::WithIndex && part.mode == mode;
    if (given.has("index")) {
        const std::size_t index = index_of(given);
        check_index(part, index);
        part.index = index;
    } else if (mode == ChainMode::WithIndex && part.mode != mode && part.selection.active()) {
        part.index = *part.selection.active();
    }
    enter_mode(part, mode);
    if (was_led && part.index != led) reach_for(part, part.target, runtime);
    if (part.mode != ChainMode::Reach) part.study.close();
    if (part.mode != ChainMode::Reach && part.chosen_point == ChainPoint::Pole) part.chosen_point.reset();
    if (part.mode == ChainMode::Curve) part.chosen_point.reset();  // its target is a control point
    if (given.has("iterations")) {
        if (part.mode == ChainMode::Curve) throw Refused("mode curve does not iterate");
        iterations_of(part, part.mode) = given.integer("iterations");
    }
    if (!given.has("tolerance")) return;
    if (part.mode == ChainMode::Reach) {
        part.reach.options.tolerance = given.number("tolerance");
    } else {
        part.tolerance = given.number("tolerance");
    }
}

/// In ascending order.
std::vector<JointPull> pulls_of(const ChainPart& part, const Arguments& given) {
    const std::vector<std::size_t> joints = joints_of(given, part);
    if (given.has("index") != given.has("to"))
        throw Refused(given.has("to") ? "to is for index; joints take points"
                                      : "index needs the argument to");
    if (given.has("index")) {
        if (given.has("points")) throw Refused("points is for joints");
        return {{joints.front(), given.point("to")}};
    }
    if (joints.empty()) throw Refused("joints is empty");
    if (!given.has("points")) throw Refused("joints needs points");
    const JsonPlace points = each_list(given, "points", "joints", joints.size());
    std::vector<JointPull> pulls;
    for (const std::size_t joint : joints) pulls.push_back({joint, points.element(pulls.size()).point()});
    std::ranges::sort(pulls, {}, &JointPull::joint);
    const auto twice = std::ranges::adjacent_find(pulls, {}, &JointPull::joint);
    if (twice != pulls.end()) throw Refused("joints: " + std::to_string(twice->joint) + " is listed twice");
    return pulls;
}

void pull(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    pull_joints(part, pulls_of(part, given), runtime);
}

/// Selects control points instead of joints.
void select_controls(ChainPart& part, const Arguments& given, bool add) {
    if (part.mode != ChainMode::Curve) throw Refused("only mode curve has control points");
    if (given.has("index") || given.has("joints") || given.has("point"))
        throw Refused("joints and control points cannot be selected together");
    const std::size_t count = part.curve.points.size();
    Selection& selection = part.along.selection;
    if (gives_one(given, "control", "controls")) {
        const auto control = static_cast<std::size_t>(given.integer("control"));
        if (control >= count)
            throw Refused("control " + std::to_string(control) + " is out of range, there are " +
                          std::to_string(count));
        add ? selection.toggle(control) : selection.only(control);
    } else {
        selection.take(index_list(given, "controls", count), add);
    }
    part.selection.clear();
    part.chosen_point.reset();
}

void select(ChainPart& part, const Arguments& given) {
    const bool add = given.has("add") && given.boolean("add");
    if (given.has("control") || given.has("controls")) return select_controls(part, given, add);
    if (given.has("point")) {
        if (given.has("index") || given.has("joints") || add)
            throw Refused("point cannot be given with joints: it is selected instead of them");
        const ChainPoint chosen = chain_points.value(given.text("point"));
        if (chosen == ChainPoint::Pole && !(part.mode == ChainMode::Reach && part.reach.options.pole))
            throw Refused("there is no pole target");
        if (part.mode == ChainMode::Curve)
            throw Refused("in mode curve the last control point is the target");
        part.selection.clear();
        part.chosen_point = chosen;
        return;
    }
    if (given.has("index") || given.has("joints")) {
        const std::vector<std::size_t> joints = joints_of(given, part);
        if (given.has("index") && add) {
            part.selection.toggle(joints.front());
        } else {
            part.selection.take(joints, add);
        }
    } else if (!add) {
        part.selection.clear();
    }
    part.along.selection.clear();
    part.chosen_point.reset();
}

void set_target(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    reach_for(part, given.point("to"), runtime);
}

/// Starts the path at the target, so that the target never jumps.
void set_motion(ChainPart& part, const Arguments& given) {
    Motion motion = part.motion;
    set_fields(given, motion);
    motion.ticks = 0;
    motion.centre = glm::vec3(0.0f);
    motion.centre = part.target - motion_point(motion, 0);
    part.motion = motion;
}

/// Seeks to a tick of the round: moves the target there and applies the mode once.
void seek_on_path(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    if (part.motion.path == Motion::Path::Still) throw Refused("the target does not follow a path");
    part.motion.ticks = static_cast<std::uint32_t>(given.integer("tick")) % ticks_per_round(part.motion);
    reach_for(part, motion_point(part.motion, part.motion.ticks), runtime);
}

}  // namespace

void add_mode_commands(CommandTable& table) {
    table.add(chain_command(
        "chain.mode", "Choose how the chain follows",
        {choice_argument("mode", true, "how the chain follows the target", chain_modes.names()),
         index_argument(false, "which segment with_index pulls"),
         integer_argument("iterations", "maximum, for fixed and reach", 1, max_iterations),
         number_argument("tolerance", "metres from the target at which fixed or reach stops", 0, 1e9)},
        "Sets how the chain follows the target, from the next move of the target on; another index of "
        "with_index goes to the target at once",
        set_mode));
    table.add(chain_command("chain.target", "Move the target", {point_argument("to", true, "metres")},
                            "Moves the target and applies the mode once", set_target));
    table.add(chain_command("chain.pull", "Pull a joint",
                            {index_argument(false, "which segment"), point_argument("to", false, "metres"),
                             joints_argument(), each_argument("points", "joints")},
                            "Pulls one or more segments, and the target with the first of them; the mode "
                            "does not change. In mode reach: drags joints; root and target stay",
                            pull));
    table.add(chain_command(
        "chain.select", "Select joints",
        {index_argument(false, "which joint; if all are omitted, nothing is selected"), joints_argument(),
         switch_argument("add",
                         "true: adds to the selection, or with index removes one that is already in it"),
         choice_argument("point", false, "selects this instead of joints", chain_points.names()),
         offering(
             index_argument("control", false, "which control point, instead of joints", max_control_points),
             [](const Workspace& w) {
                 return places(w.document.get<ChainPart>(chain_lab).curve.points.size());
             }),
         index_list_argument("controls", "control")},
        "Selects joints, the target, the pole target, or control points", select, Effect::Look));
    table.add(chain_command("chain.motion", "Move the target along a path", field_arguments<Motion>(),
                            "Moves the target along a path while the simulation runs", set_motion));
    table.add(chain_command(
        "chain.seek", "Place the target on its path",
        {{.name = "tick", .type = ArgumentType::Integer, .help = "tick of the round", .low = 0}},
        "Moves the target to a tick of its round", seek_on_path));
    table.add(flip_command<ChainPart>(chain_lab, "chain.flips"));
}

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Preset>() noexcept {
    using app::Preset;
    constexpr FieldRange near{-100.0, 100.0};
    static constexpr Field rows[] = {field<&Preset::name>("name").needed(),
                                     field<&Preset::title>("title").needed(),
                                     field<&Preset::count>("count", {1, 1000}),
                                     field<&Preset::of>("of", {0, 4}),
                                     field<&Preset::what>("what"),
                                     field<&Preset::head>("head", near, "m"),
                                     list<&Preset::steps>("steps", near, "m"),
                                     field<&Preset::path>("path"),
                                     field<&Preset::height>("height", {0.0, 100.0}, "m")};
    return rows;
}

namespace tendril::app {

// Presets.

namespace {

using Segments = std::vector<Segment>;

/// Places `count` segments, head first, along the steps that `step(i)` returns; a step's length is its
/// segment's.
template <class Step>
Segments placed(glm::vec3 head, std::size_t count, Step step) {
    Segments segments;
    segments.reserve(count);
    glm::vec3 at = head;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 by = step(i);
        if (i > 0) at += by;
        segments.push_back({at, glm::length(by)});
    }
    return segments;
}

float part_of(std::size_t i, std::size_t count) {
    return count < 2 ? 0.0f : static_cast<float>(i) / static_cast<float>(count - 1);
}

/// Rises from the ground in an S, with bones that get shorter towards the tip.
Segments tentacle(std::size_t count) {
    const float scale = 7.0f / static_cast<float>(count);
    return placed({0, 0, 0}, count, [=](std::size_t i) {
        const float t = part_of(i, count);
        const float lean = 1.1f * math::sine(6.0f * t) * (0.3f + 0.7f * t);
        return scale * (1.5f - 0.9f * t) *
               glm::vec3(math::sine(lean), math::cosine(lean), 0.35f * math::sine(4.0f * t));
    });
}

/// A wave on the ground.
Segments wave(std::size_t count) {
    const float step = 9.0f / static_cast<float>(count);
    return placed({-4.5f, 0.1f, 0}, count, [=](std::size_t i) {
        const float lean = 1.0f * math::cosine(15.0f * part_of(i, count));
        return step * glm::vec3(math::cosine(lean), 0.0f, math::sine(lean));
    });
}

/// A rising coil.
Segments coil(std::size_t count) {
    const float step = 26.0f / static_cast<float>(count);
    return placed({2, 0.1f, 0}, count, [=](std::size_t i) {
        const float turn = 13.0f * part_of(i, count);
        return step * glm::vec3(-math::sine(turn), 0.14f, math::cosine(turn));
    });
}

/// Random lengths and directions, the same for the same seed.
Segments random_walk(std::size_t count, std::uint32_t seed) {
    std::mt19937 generator(seed);
    // Own mapping to [-1, 1]: the distributions of the standard library differ between implementations.
    const auto signed_unit = [&] { return static_cast<float>(generator() >> 8) / 8388608.0f - 1.0f; };
    const float scale = 8.0f / std::sqrt(static_cast<float>(count));
    return placed({0, 2.5f, 0}, count, [&](std::size_t) {
        const glm::vec3 direction{signed_unit(), 0.8f * signed_unit(), signed_unit()};
        return scale * 0.6f * (direction + glm::vec3(0.25f, 0.0f, 0.0f));
    });
}

Segments segments_of(const Preset& preset, std::size_t count, std::uint32_t seed) {
    if (preset.path == "tentacle") return tentacle(count);
    if (preset.path == "wave") return wave(count);
    if (preset.path == "coil") return coil(count);
    if (preset.path == "random") return random_walk(count, seed);
    const float rise = count < 2 ? preset.height : preset.height / static_cast<float>(count - 1);
    return placed(preset.head, count, [&](std::size_t i) {
        return preset.steps.empty() ? glm::vec3(0.0f, rise, 0.0f)
                                    : preset.steps[std::min(i, preset.steps.size() - 1)];
    });
}

}  // namespace

bool Preset::curved() const {
    return scene->contains("curve");
}
bool Preset::planar() const {
    return scene->contains("reach") && scene->at("reach").contains("plane");
}

const std::vector<Preset>& presets() {
    static const std::vector<Preset> list = [] {
        std::vector<Preset> read;
        for (const Json& each : parse_json(presets_source(chain_lab))) {
            load_fields({each, "presets"}, read.emplace_back());
            read.back().scene = std::make_shared<const Json>(each);
        }
        return read;
    }();
    return list;
}

const Preset& preset_named(const std::string& name) {
    return named(
        presets(), [](const Preset& each) { return each.name; }, name, "preset");
}

Chain make_preset(const Preset& preset, std::size_t count, std::uint32_t seed) {
    return require_value(Chain::from_segments(segments_of(preset, count, seed)));
}

void take_scene(ChainPart& part, const Preset& preset, ChainRuntime& runtime) {
    const JsonPlace scene(*preset.scene, preset.name);
    if (const auto curve = scene.optional("curve")) {
        part.mode = ChainMode::Curve;
        part.curve = load_curve(*curve);
    }
    if (!scene.has("reach")) return;
    const std::size_t bones = part.chain.size() - 1;
    // As many bones as it lists limits.
    const Json& reach = preset.scene->at("reach");
    const Json& limited = preset.planar() ? reach["plane"] : reach;
    const std::size_t listed = limited.contains("limits") ? limited["limits"].size() : 0;
    part.mode = ChainMode::Reach;
    part.reach = load_reach(scene["reach"], make_preset(preset_named("start"), listed + 1));
    const auto fit = [&](auto& limits) {
        if (limits.empty()) return;
        const auto last = limits.back();
        limits.resize(bones, last);
    };
    if (preset.planar()) fit(part.reach.plane->limits);
    bones < 2 ? part.reach.limits.clear() : fit(part.reach.limits);  // a hinge needs two
    const auto target = scene.optional("target");
    reach_for(part, target ? target->point() : part.chain.position(bones) + scene["target_from_tip"].point(),
              runtime);
}

}  // namespace tendril::app
