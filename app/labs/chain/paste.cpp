// Text from the clipboard: a trace, or points: the new position of a joint, the target or the pole target, or
// a new chain.
#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "app/document/units.hpp"
#include "app/io/points.hpp"
#include "app/io/trace/trace.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/commands.hpp"

namespace tendril::app {

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
    std::string told = part.chosen_point == ChainPoint::Pole ? "The pole target goes"
                       : part.selection.empty()              ? "The target goes"
                       : part.selection.several()            ? "The active joint, and the others with it, go"
                                                             : "The selected joint goes";
    told += " to (";
    for (const int axis : {0, 1, 2})
        told += (axis > 0 ? ", " : "") + fixed_text(static_cast<double>(points.front()[axis]), 3);
    return told + ") m";
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
