// Panel rows and commands for the curves that chains of the character bend along.
#include <imgui.h>
#include <algorithm>
#include <stdexcept>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/curves/curves.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// "on the curve", "12 cm past its end"
std::string report_text(const BoneCurve& curve, const ik::CurveReport& report) {
    if (report.collapsed) return "no direction";
    if (report.status == ik::Status::Stretched)
        return length_text(static_cast<double>(report.past_end)) + " past the end";
    if (curve.shape.options.weight < 1.0f || curve.shape.falloff != 0.0f) return "partly on the curve";
    return "on the curve";
}

void curve_row(const HumanoidPanel& panel, std::size_t which) {
    const BoneCurve& curve = panel.part.curves[which];
    ImGui::PushID(curve.first.c_str());
    reading(curve.first.c_str(), "%s",
            report_text(curve, panel.runtime.shown(panel.workspace).curves[which]).c_str());
    explain(("From " + curve.first + " to " + curve.last + ".").c_str());
    settings_row(panel, curve.first, "humanoid.curve", "first",
                 "Removes the curve: only clip and IK move the bones");
    ImGui::PopID();
}

/// A list of the chains that can be bent.
void add_curve_row(const HumanoidPanel& panel) {
    const std::string none = "choose a chain";
    if (!begin_list("add curve", &none)) {
        explain("The spine, or a chain beside the body: a tail, an ear. Any other: select its first node.");
        return;
    }
    bool any = false;
    for (const BoneChain& each : bendable_chains(panel.part)) {
        if (curve_from(panel.part, each.first) || !why_no_curve(panel.part, each).empty()) continue;
        any = true;
        const auto& skeleton = panel.part.skeleton();
        if (!list_row(title_of(panel.part, each), false)) continue;
        panel.emit("humanoid.curve",
                   {{"first", skeleton[each.first].name}, {"last", skeleton[each.last].name}});
        panel.emit("humanoid.select", {{"node", skeleton[each.first].name}});
    }
    if (!any) note("There is no other chain of two bones or more.");
    end_list();
}

/// The selected chain: from a node down, or between two nodes.
std::optional<BoneChain> selected_chain(const HumanoidPart& part) {
    const std::vector<std::size_t>& all = part.selection.all();
    if (all.empty() || all.size() > 2) return std::nullopt;
    BoneChain chain{all.front(), all.size() == 2 ? all.back() : end_of_chain(part, all.front())};
    if (all.size() == 2 && part.skeleton().is_below(chain.first, chain.last))
        std::swap(chain.first, chain.last);
    if (chain.first == chain.last || !part.skeleton().is_below(chain.last, chain.first)) return std::nullopt;
    return chain;
}

void bend_row(const HumanoidPanel& panel) {
    const auto chain = selected_chain(panel.part);
    if (!chain || curve_from(panel.part, chain->first)) return;
    const std::string why = why_no_curve(panel.part, *chain);
    const auto& skeleton = panel.part.skeleton();
    const std::string what = "Lays " + title_of(panel.part, *chain) + " along a curve that you drag";
    if (row_button("Bend along a curve", 1, why.empty(), why.empty() ? what.c_str() : why.c_str()))
        panel.emit("humanoid.curve",
                   {{"first", skeleton[chain->first].name}, {"last", skeleton[chain->last].name}});
    end_row();
}

void curve_notes(const BoneCurve& curve, const ik::CurveReport& report, const humanoid::BentChain& chain,
                 const HumanoidPanel& panel) {
    std::string said;
    if (report.collapsed)
        said = "All control points are on the first node: drag one away.";
    else if (report.bones_past_end > 0)
        said = count_text(report.bones_past_end, "bone") + (report.bones_past_end == 1 ? " goes" : " go") +
               " straight on past the last control point, " +
               length_text(static_cast<double>(report.past_end)) + " in all.";
    if (curve.jumped)
        said += (said.empty() ? "" : " ") + panel.part.skeleton()[chain.nodes()[*curve.jumped]].name +
                " jumped to another crossing of the curve: open that bend.";
    const bool partly = curve.shape.options.weight < 1.0f || curve.shape.falloff != 0.0f;
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    const bool reached = shown.body || shown.hold;
    if (said.empty())
        said = partly    ? "Between the clip and the curve."
               : reached ? "Every joint lies on the curve, until IK moves the body."
                         : "Every joint lies on the curve.";
    kept_note("curve report", said, 3);
}

}  // namespace

void curve_rows(const HumanoidPanel& panel) {
    ImGui::PushID("curves");  // a spring may begin at the same node
    if (panel.part.curves.empty()) note("Bends a tail or the spine along a curve that you drag.");
    for (std::size_t i = 0; i < panel.part.curves.size(); ++i) curve_row(panel, i);
    if (panel.part.curves.size() < max_bone_curves) add_curve_row(panel);
    ImGui::PopID();
}

void curve_inspector(const HumanoidPanel& panel) {
    const auto which = curve_through(panel.part, *panel.part.selection.active());
    if (!which) return bend_row(panel);
    const humanoid::BentChain* const chain = panel.runtime.solvers.curves(panel.part)[*which].get();
    if (chain == nullptr) return;
    const BoneCurve& curve = panel.part.curves[*which];
    const PanelSection ids(("Curve: " + curve.first + " to " + curve.last).c_str());
    const ik::CurveReport& report = panel.runtime.shown(panel.workspace).curves[*which];
    curve_notes(curve, report, *chain, panel);
    const FieldRows rows(curve.shape, "humanoid.curve", panel.emit, {{"first", curve.first}});
    rows.rows("kind", "weight", "falloff", "roll_start", "roll_end", "fit");
    if (!curve.shape.options.fit) return;
    rows.row("max_factor");
    reading("bones scaled by", "%.4f", static_cast<double>(report.factor));
}

// The command.

namespace {

/// Finds a node or a bone by name.
std::size_t node_or_bone(const HumanoidPart& part, const std::string& name) {
    if (part.skeleton().find(name)) return node_named(part, name);
    if (const auto bone = humanoid::bone_named(name))
        if (const auto node = part.node_of(*bone)) return *node;
    return node_named(part, name);  // throws: there is no such node
}

/// A new curve through the pose. Replaces one that begins there, keeping its settings.
BoneCurve& begin_curve(const IkNow& now, HumanoidPart& part, const BoneChain& chain) {
    if (part.skeleton().children(chain.first).empty())
        throw std::invalid_argument("nothing hangs on " + part.skeleton()[chain.first].name +
                                    ": choose a node above it");
    const auto made = require_value(humanoid::BentChain::make(part.skeleton(), chain.first, chain.last));
    if (const std::string why = why_no_curve(part, chain); !why.empty()) throw std::invalid_argument(why);
    std::optional<std::size_t> which = curve_from(part, chain.first);
    if (!which && part.curves.size() >= max_bone_curves)
        throw std::invalid_argument("there are " + std::to_string(max_bone_curves) + " curves already");
    if (!which) {
        which = part.curves.size();
        part.curves.emplace_back();
    }
    BoneCurve& curve = part.curves[*which];
    curve.first = part.skeleton()[chain.first].name;
    curve.last = part.skeleton()[chain.last].name;
    curve.shape.points = made.points_through(now.shown.before_springs, new_curve_points);
    curve.jumped.reset();
    return curve;
}

void set_points(const IkNow& now, HumanoidPart& part, std::size_t which, const Json& list) {
    std::vector<glm::vec3> points = read_control_points(JsonPlace(list, "points"), max_bone_curve_points);
    if (points.empty())
        throw Refused("points: a curve needs a control point; to remove the curve, use on: false");
    BoneCurve& curve = part.curves[which];
    if (points == curve.shape.points) return;
    const auto& chain = now.solvers.curves(part)[which];
    curve.jumped = chain ? jump_between(part, *chain, curve.shape, points) : std::nullopt;
    curve.shape.points = std::move(points);
}

void set_bone_curve(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    const std::size_t first = node_or_bone(part, given.text("first"));
    std::optional<std::size_t> which = curve_from(part, first);
    if (given.has("on") && !given.boolean("on")) {
        if (which) part.curves.erase(part.curves.begin() + static_cast<std::ptrdiff_t>(*which));
        return;
    }
    std::optional<std::size_t> last;
    if (given.has("last")) last = node_or_bone(part, given.text("last"));
    const bool other = which && last && part.skeleton()[*last].name != part.curves[*which].last;
    if (!which || other) begin_curve(now, part, {first, last.value_or(end_of_chain(part, first))});
    which = curve_from(part, first);
    set_fields(given, part.curves[*which].shape);
    if (given.has("points")) set_points(now, part, *which, given.json("points"));
}

/// An argument completed with the ends of bendable chains.
Argument chain_end_argument(const char* name, bool required, const char* help, std::size_t BoneChain::*end) {
    return offering(text_argument(name, required, help), [end](const Workspace& workspace) {
        const HumanoidPart& part = humanoid_part(workspace);
        std::vector<std::string> names;
        for (const BoneChain& each : bendable_chains(part)) {
            const std::string& node = part.skeleton()[each.*end].name;
            if (std::ranges::find(names, node) == names.end()) names.push_back(node);
        }
        return names;
    });
}

}  // namespace

void add_bone_curve_commands(CommandTable& table) {
    std::vector<Argument> arguments{
        chain_end_argument("first", true, "the chain's first node, or a bone of the body, by name",
                           &BoneChain::first),
        chain_end_argument("last", false,
                           "its end, below the first; if omitted, the end of that tail or spine",
                           &BoneChain::last),
        {.name = "points",
         .type = ArgumentType::List,
         .required = false,
         .help =
             "the control points after the first node, in metres, in the space of its parent; a new curve "
             "begins with points through the pose"},
        switch_argument("on", "false: removes the curve")};
    for (Argument& each : field_arguments<CurveShape>()) arguments.push_back(std::move(each));
    table.add(ik_command(
        "humanoid.curve", "Bend a tail or spine", std::move(arguments),
        "Bends a chain of bones along a curve, after the clip and before IK; omitted settings are kept",
        set_bone_curve));
}

}  // namespace tendril::app
