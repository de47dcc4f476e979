// Commands that change the chain itself: its segments and presets.
#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/io/samples.hpp"
#include "app/io/text.hpp"
#include "app/io/trace/trace.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

Argument length_argument() {
    return {.name = "length", .help = "metres", .low = 0};
}

Argument position_argument() {
    return point_argument("position", false,
                          "its position, before its length is enforced; straight on if omitted");
}

void check_size(const ChainPart& part) {
    if (part.chain.size() >= max_segments) {
        throw Refused("the chain is full: it has " + std::to_string(max_segments) + " segments");
    }
}

/// Drops the result and the study of the old chain.
void shape_changed(ChainPart& part) {
    part.result.reset();
    part.study.close();
}

void set_length(ChainPart& part, const Arguments& given) {
    const std::vector<std::size_t> joints = joints_to_set(given, part);
    const float length = given.number("length");
    if (joints.size() == 1) {
        require_ok(part.chain.set_length(joints.front(), length));
    } else {
        const auto now = part.chain.segments();
        std::vector<Segment> segments(now.begin(), now.end());
        for (const std::size_t index : joints) segments[index].length = length;
        part.chain = require_value(Chain::from_segments(std::move(segments), part.chain.default_direction()));
    }
    part.result.reset();
}

void add(ChainPart& part, const Arguments& given) {
    check_size(part);
    if (given.has("position")) {
        require_ok(part.chain.add(Segment{given.point("position"), given.number("length")}));
    } else {
        require_ok(part.chain.add(given.number("length")));
    }
    shape_changed(part);
    bone_inserted(part.reach, part.chain.size() - 1, part.chain.size());
}

void insert(ChainPart& part, const Arguments& given) {
    check_size(part);
    const std::size_t index = index_of(given);
    if (given.has("position")) {
        require_ok(part.chain.insert(index, Segment{given.point("position"), given.number("length")}));
    } else {
        require_ok(part.chain.insert(index, given.number("length")));
    }
    // Keep pointing to the same segments.
    part.selection.inserted(index);
    if (part.index >= index) ++part.index;
    shape_changed(part);
    bone_inserted(part.reach, index, part.chain.size());
}

void remove_at(ChainPart& part, std::size_t index) {
    require_ok(part.chain.remove(index));
    shape_changed(part);
    bone_removed(part.reach, index, part.chain.size());
    // If only this joint was selected, selects the next one, so that the user can keep deleting.
    const bool alone = part.selection.active() == index && !part.selection.several();
    part.selection.removed(index);
    if (part.index > index) --part.index;
    if (part.chain.empty()) {
        part.index = 0;
        return;
    }
    const std::size_t last = part.chain.size() - 1;
    if (alone) part.selection.only(std::min(index, last));
    part.index = std::min(part.index, last);
}

/// Removes all at once; one by one, each removal would move the joints after it.
void remove_all(ChainPart& part, const std::vector<std::size_t>& joints) {
    const auto gone = [&](std::size_t i) { return std::binary_search(joints.begin(), joints.end(), i); };
    std::vector<Segment> left;
    for (std::size_t i = 0; i < part.chain.size(); ++i)
        if (!gone(i)) left.push_back(part.chain.segments()[i]);
    part.index -=
        static_cast<std::size_t>(std::lower_bound(joints.begin(), joints.end(), part.index) - joints.begin());
    part.chain = require_value(Chain::from_segments(std::move(left), part.chain.default_direction()));
    part.index = std::min(part.index, std::max<std::size_t>(part.chain.size(), 1) - 1);
    bones_removed(part.reach, joints, part.chain.size());
    part.selection.clear();
    shape_changed(part);
}

void remove(ChainPart& part, const Arguments& given) {
    remove_at(part, index_of(given));
}

void remove_selected(ChainPart& part, const Arguments&) {
    if (!part.along.selection.empty()) return remove_selected_points(part);
    if (part.selection.empty()) throw Refused("no joint is selected");
    if (part.selection.several()) return remove_all(part, std::vector(part.selection.all()));
    remove_at(part, *part.selection.active());
}

void clear(ChainPart& part, const Arguments& given) {
    ChainPart empty;
    empty.mode = part.mode;
    if (given.has("default_direction"))
        require_ok(empty.chain.set_default_direction(given.point("default_direction")));
    part = std::move(empty);
}

void reset(ChainPart& part, const Arguments&) {
    part = first_chain();
}

/// Replaces the chain and puts the target on its tail or, in a trailing mode, on the led joint. Removes
/// limits and the pole target.
void take_chain(ChainPart& part, Chain chain) {
    part.chain = std::move(chain);
    part.target = part.chain.position(part.chain.size() - 1);
    part.index = std::min(part.index, part.chain.size() - 1);
    part.selection.clear();
    part.chosen_point.reset();
    part.motion.path = Motion::Path::Still;
    forget_limits(part.reach);
    part.reach.options.pole.reset();
    part.reach.plane.reset();
    part.reach_target.reset();
    part.reach.state = {};
    part.curve.points.clear();  // mode Curve draws one through the new chain
    part.along.selection.clear();
    shape_changed(part);
    put_target_on_led_joint(part);
}

void take_preset(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const Preset& preset = preset_named(given.text("name"));
    const int count = given.has("count") ? given.integer("count") : preset.count;
    const std::uint32_t seed = given.has("seed") ? static_cast<std::uint32_t>(given.integer("seed")) : 1u;
    take_chain(part, make_preset(preset, static_cast<std::size_t>(count), seed));
    take_scene(part, preset, runtime);
}

}  // namespace

void add_shape_commands(CommandTable& table) {
    table.add(chain_command("chain.clear", "Remove every joint",
                            {point_argument("default_direction", false,
                                            "unit vector along which a chain without a direction extends")},
                            "Removes every segment, and resets everything but the mode", clear));
    table.add(chain_command("chain.add", "Add a joint at the tip", {length_argument(), position_argument()},
                            "Appends a segment at the tail", add));
    table.add(
        chain_command("chain.insert", "Insert a joint",
                      {index_argument(true, "the new segment's"), length_argument(), position_argument()},
                      "Inserts a segment before another", insert));
    table.add(chain_command("chain.remove", "Remove a joint", {index_argument(true, "which segment")},
                            "Removes a segment", remove));
    table.add(chain_command("chain.remove_selected", "Delete selection", {},
                            "Removes the selected joints, or the selected control points", remove_selected));
    table.add(
        chain_command("chain.reset", "Reset the Chain lab", {}, "Resets this lab to its first state", reset));
    table.add(chain_command(
        "chain.set_length", "Set the length of bones",
        {length_argument(), index_argument(false, "which joint: the bone before it gets the length"),
         joints_argument()},
        "Sets the length of the bones that lead to joints", set_length));
    table.add(chain_command(
        "chain.preset", "Open a chain preset",
        {choice_argument("name", true, "which chain",
                         names(presets(), [](const Preset& p) { return p.name; })),
         integer_argument("count", "segments", 1, static_cast<double>(max_segments)),
         {.name = "seed", .type = ArgumentType::Integer, .required = false, .help = "for random", .low = 0}},
        "Makes a preset chain, the target on its tail. Some come with mode reach: reaching_arm with limits "
        "and a pole target, straight with a target on its own line, where FABRIK (2011) stalls, those whose "
        "names begin with flat_ in a plane; spine, tail and tentacle with mode curve",
        take_preset));
}

// Pasted text: a trace, or points (the new position of a joint, the target or the pole target, or a new
// chain).

Chain chain_through(const std::vector<glm::vec3>& points) {
    std::vector<Segment> segments;
    // As in presets, the head's stored length is the first bone's.
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t bone = std::max<std::size_t>(i, 1);
        segments.push_back({points[i], glm::distance(points[bone - 1], points[bone])});
    }
    return require_value(Chain::from_segments(std::move(segments)));
}

namespace {

/// Moves the active joint to `to`; the other selected joints keep their offsets from it.
void place_selection(ChainPart& part, glm::vec3 to, ChainRuntime& runtime) {
    const std::size_t active = *part.selection.active();
    const glm::vec3 by = to - part.chain.position(active);
    std::vector<JointPull> pulls;
    for (const std::size_t joint : part.selection.all())
        pulls.push_back({joint, joint == active ? to : part.chain.position(joint) + by});
    pull_joints(part, pulls, runtime);
}

void paste(ChainPart& part, const Arguments& given, ChainRuntime& runtime) {
    const std::vector<glm::vec3> points = read_points(given.text("text"), max_pasted_points);
    if (points.size() > 1) return take_chain(part, chain_through(points));
    if (part.chosen_point == ChainPoint::Pole) {
        part.reach.options.pole = points.front();
        return reach_again(part, runtime);
    }
    if (part.chosen_point || part.selection.empty()) return reach_for(part, points.front(), runtime);
    place_selection(part, points.front(), runtime);
}

/// Describes what was pasted. `part`: before the change.
std::string pasted_text(const ChainPart& part, const std::string& text) {
    const std::vector<glm::vec3> points = read_points(text, max_pasted_points);
    if (points.size() > 1)
        return "A chain of " + std::to_string(points.size()) + " joints from the clipboard";
    std::string label = part.chosen_point == ChainPoint::Pole ? "The pole target goes"
                        : part.selection.empty()              ? "The target goes"
                        : part.selection.several()            ? "The active joint, and the others with it, go"
                                                              : "The selected joint goes";
    label += " to (";
    for (const int axis : {0, 1, 2})
        label += (axis > 0 ? ", " : "") + fixed_text(static_cast<double>(points.front()[axis]), 3);
    return label + ") m";
}

/// True if pasted text is a trace: two frames or more, or a pose with a target.
bool holds_trace(const std::string& text) {
    try {
        std::istringstream in(text);
        const auto raw = open_raw_trace(in);
        RawFrame first, second;
        if (!raw->next(first) || first.joints.size() < 2) return false;
        return first.target || (raw->next(second) && second.joints.size() == first.joints.size());
    } catch (const std::runtime_error&) {
        return false;
    }
}

}  // namespace

bool begins_like_trace(std::string_view text) {
    if (text.find("\"joints\"") != text.npos || text.find("\"tendril\"") != text.npos) return true;
    try {
        std::istringstream in{std::string(text)};
        RawFrame frame;
        return open_raw_trace(in)->next(frame) && frame.joints.size() >= 2;
    } catch (const std::runtime_error&) {
        return false;
    }
}

TakenText ChainLab::takes_text(const std::string& text) const {
    if (holds_trace(text))
        return {.command = CommandCall{"chain.trace", {{"text", text}}}, .what = "a trace"};
    try {
        read_points(text, max_pasted_points);
    } catch (const std::runtime_error& error) {
        return {.command = {}, .what = std::string("The clipboard holds no points: ") + error.what()};
    }
    return {.command = CommandCall{"chain.paste", {{"text", text}}}, .what = "points"};
}

void add_paste_command(CommandTable& table) {
    Command command = chain_command(
        "chain.paste", "Paste points",
        {text_argument("text", false,
                       "rows of x y z, as a table, a list or source code; default: clipboard")},
        "Three numbers: moves the selection there, or the target. More rows: a new chain through them",
        paste);
    command.apply = [change = std::move(command.apply)](Workspace& workspace, const Arguments& given) {
        if (!given.has("text")) {
            workspace.ui.pastes = true;
            return;
        }
        const std::shared_ptr<const Part> before = workspace.document.parts().at(chain_lab);
        change(workspace, given);
        frame_unless_seen(workspace, ChainLab().bounds(workspace, false));
        workspace.toast(pasted_text(dynamic_cast<const ChainPart&>(*before), given.text("text")));
    };
    table.add(std::move(command));
}

}  // namespace tendril::app
