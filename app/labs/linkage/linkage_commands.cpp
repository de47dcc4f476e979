// Commands that open a linkage, move it, and control its view.
#include "app/labs/linkage/linkage_commands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

std::vector<std::string> joints_here(const LinkagePart& part) {
    std::vector<std::string> joints;
    for (const ik::Link& link : part.linkage().links)
        if (link.joint != ik::LinkJoint::Ball) joints.push_back(link.name);
    return joints;
}

Argument joint_argument() {
    return offering(text_argument("joint", true, "a motor, or the link that the joint moves"),
                    [](const Workspace& workspace) { return joints_here(linkage_part(workspace)); });
}

/// The drive of a hinge or slider; a new one if it has none. Throws Refused.
LinkageDrive& drive_of(LinkagePart& part, const std::string& joint) {
    require_linkage_joint(part, joint);
    if (part.find_drive(joint) == nullptr)
        part.drives.push_back({.joint = joint, .value = part.value_of(joint)});
    return *std::ranges::find(part.drives, joint, &LinkageDrive::joint);
}

void preset(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    open_mechanism(part, mechanism_kind(given.text("name")).blank(), runtime);
}

/// Throws Refused if the part was drawn by hand.
Mechanism mechanism_of(const LinkagePart& part) {
    if (kind_of(part.shape->mechanism) == nullptr)
        throw Refused("this linkage was drawn by hand: it has no named lengths");
    return part.shape->mechanism;
}

void check_length_name(const Mechanism& mechanism, const std::string& name, const std::string& where) {
    const MechanismKind& kind = *kind_of(mechanism);
    for (const Field& field : kind.fields)
        if (file_name(field) == name) return;
    throw Refused(where + ": " + kind.title + " has no length \"" + name + "\"");
}

void set_lengths(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    Mechanism mechanism = mechanism_of(part);
    if (given.has("lengths")) read_lengths({given.json("lengths"), "lengths"}, mechanism);
    for (const auto& each : given.json().items())
        if (each.key() != "lengths") check_length_name(mechanism, each.key(), each.key());
    set_fields(given, mechanism_fields(mechanism));
    const Mechanism& wanted = mechanism;
    if (save_fields(mechanism_fields(wanted)) == save_fields(mechanism_fields(part.shape->mechanism))) return;
    take_shape(part, shape_of(mechanism), runtime);
}

/// Keeps the speed for the next run.
void stop(LinkageDrive& drive) {
    if (drive.rate != 0.0) drive.last_rate = drive.rate;
    drive.rate = 0.0;
}

void drive(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string joint = given.text("joint");
    LinkageDrive& drive = drive_of(part, joint);
    if (given.has("angle_deg") == given.has("value")) throw Refused("give angle_deg or value, and not both");
    if (given.has("angle_deg") && !turns(part, joint))
        throw Refused("joint \"" + joint + "\" is a slider: give value, in metres");
    drive.value = given.has("angle_deg") ? glm::radians(given.real("angle_deg")) : given.real("value");
    if (given.has("angle_deg") && std::abs(given.real("angle_deg")) < 360.0)
        drive.value = turned_near(drive.value, part.value_of(joint),
                                  part.linkage().links[*part.linkage().find_link(joint)]);
    drive.held = true;
    stop(drive);
    solve_linkage(part, runtime);
}

void release(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    LinkageDrive& drive = drive_of(part, given.text("joint"));
    drive.held = false;
    stop(drive);
    solve_linkage(part, runtime);
}

void motor(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string joint = given.text("joint");
    const bool angular = turns(part, joint);
    LinkageDrive& drive = drive_of(part, joint);
    if (given.has("deg_per_s") && given.has("per_s")) throw Refused("give deg_per_s or per_s, and not both");
    if (given.has("deg_per_s") && !angular)
        throw Refused("joint \"" + joint + "\" is a slider: give per_s, in metres a second");
    if (given.has("per_s") && angular) throw Refused("joint \"" + joint + "\" is a hinge: give deg_per_s");
    if (drive.rate == 0.0) drive.rate = usual_motor_rate(part, joint, runtime);
    if (given.has("deg_per_s")) drive.rate = glm::radians(given.real("deg_per_s"));
    if (given.has("per_s")) drive.rate = given.real("per_s");
    drive.held = true;
    solve_linkage(part, runtime);
}

void set_range(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string joint = given.text("joint");
    require_linkage_joint(part, joint);
    const bool off = given.has("off") && given.boolean("off");
    if (off == (given.has("min") || given.has("max"))) throw Refused("give min, max or both, or off: true");
    std::vector<LinkageRange> ranges = part.shape->ranges;
    auto range = std::ranges::find(ranges, joint, &LinkageRange::joint);
    if (off) {
        if (range == ranges.end()) throw Refused("\"" + joint + "\" has no range");
        ranges.erase(range);
    } else {
        if (range == ranges.end()) range = ranges.insert(range, LinkageRange{.joint = joint});
        if (given.has("min")) range->minimum = from_degrees(part, joint, given.real("min"));
        if (given.has("max")) range->maximum = from_degrees(part, joint, given.real("max"));
        if (range->minimum > range->maximum) {
            const auto text = [&](double each) { return fixed_text(in_degrees(part, joint, each), 3); };
            throw Refused("min must be at most max, got " + text(range->minimum) + " and " +
                          text(range->maximum));
        }
    }
    const bool drawn = kind_of(part.shape->mechanism) == nullptr;
    LinkageShape shape = drawn ? shape_of(present_sketch(part)) : shape_of(part.shape->mechanism);
    take_shape(part, std::move(shape), std::move(ranges), runtime);
}

void target(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string point = given.text("point");
    static_cast<void>(require_linkage_point(part, point));
    auto found = std::ranges::find(part.targets, point, &LinkageTarget::point);
    if (found == part.targets.end()) found = part.targets.insert(found, LinkageTarget{.point = point});
    found->to = json_dpoint(given.json("to"), "to");
    if (given.has("weight")) found->weight = given.real("weight");
    if (given.has("exact")) found->exact = given.boolean("exact");
    solve_linkage(part, runtime);
}

void remove_target(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string point = given.text("point");
    if (std::erase_if(part.targets, [&](const LinkageTarget& each) { return each.point == point; }) == 0)
        throw Refused("\"" + point + "\" has no target");
    solve_linkage(part, runtime);
}

void drag(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    const std::string point = given.text("point");
    static_cast<void>(require_linkage_point(part, point));
    part.drag = LinkageTarget{.point = point, .to = json_dpoint(given.json("to"), "to")};
    solve_linkage(part, runtime);
}

void let_go(LinkagePart& part, const Arguments&, LinkageRuntime& runtime) {
    part.drag.reset();
    solve_linkage(part, runtime);
}

/// Assembly modes meet at a dead point, so this switches one step beside it, where they differ.
bool switch_near_dead_point(const LinkagePart& part, ik::LinkageSolver& solver, ik::LinkageState& state,
                            std::vector<ik::LinkDriver> drivers) {
    const ik::LinkageReport& report = part.result.report;
    if (report.status != ik::LinkageStatus::DeadPoint || !report.stopped) return false;
    const auto stopped = std::ranges::find(drivers, *report.stopped, &ik::LinkDriver::link);
    if (stopped == drivers.end()) return false;
    const bool hinge = part.linkage().links[stopped->link].joint == ik::LinkJoint::Hinge;
    const double step = hinge ? glm::radians(1.0) : 0.005 * solver.size(), at = stopped->value;
    for (const double by : {-step, step}) {
        ik::LinkageState moved = state;
        stopped->value = at + by;
        if (solver.solve(moved, {drivers, {}}).status != ik::LinkageStatus::Reached ||
            !solver.other_mode(moved, drivers, ik::OtherMode::Nearest))
            continue;
        state = moved;
        return true;
    }
    return false;
}

void other_mode(LinkagePart& part, const Arguments& given, LinkageRuntime& runtime) {
    std::vector<ik::LinkDriver> drivers;
    for (const LinkageDrive& each : part.drives)
        drivers.push_back({*part.linkage().find_link(each.joint), part.value_of(each.joint)});
    ik::LinkageSolver& solver = runtime.solver(part.shape);
    const auto which =
        given.has("nearest") && given.boolean("nearest") ? ik::OtherMode::Nearest : ik::OtherMode::Next;
    if (!solver.other_mode(part.state, drivers, which) &&
        !switch_near_dead_point(part, solver, part.state, drivers))
        throw Refused("no other assembly mode was found for the drivers' present values");
    for (LinkageDrive& each : part.drives)
        if (is_running(each)) each.value = part.value_of(each.joint);
    part.copies = copies_of(*part.shape, part.state);
    solve_linkage(part, runtime);
}

void reset(LinkagePart& part, const Arguments&, LinkageRuntime&) {
    part = first_linkage();
}

void clear(LinkagePart& part, const Arguments&, LinkageRuntime& runtime) {
    open_mechanism(part, Mechanism{}, runtime);
    part.tool = LinkageTool::Draw;
}

void select(LinkagePart& part, const Arguments& given, LinkageRuntime&) {
    part.selected = given.has("point") ? given.text("point") : "";
    if (!part.selected.empty()) static_cast<void>(require_linkage_point(part, part.selected));
}

void choose_tool(LinkagePart& part, const Arguments& given, LinkageRuntime&) {
    part.tool = linkage_tools.value(given.text("name"));
}

/// Runs the command, then adjusts the camera.
Command and_then(Command command, void (*look)(Workspace&)) {
    command.apply = [change = std::move(command.apply), look](Workspace& workspace, const Arguments& given) {
        change(workspace, given);
        look(workspace);
    };
    return command;
}

/// Restarts the open lab's last ten seconds at the part that a command has just opened in place of `before`.
/// Undo restores the old ones.
void begin_past(Workspace& workspace, std::shared_ptr<const Part> before) {
    workspace.discarded = {std::exchange(workspace.rewind, Rewind()), std::move(before),
                           workspace.moment_id()};
    ++workspace.beginnings;
    workspace.clock.replaying = false;
    workspace.ui.incident.reset();
}

/// A command that changes the part, given the lab's solver.
Command linkage_command(const char* name, const char* title, std::vector<Argument> arguments,
                        const char* help, void (*change)(LinkagePart&, const Arguments&, LinkageRuntime&),
                        Effect effect = Effect::Edit) {
    return part_command<LinkagePart>(linkage_lab, name, title, std::move(arguments), help, effect,
                                     [change, effect](Workspace& workspace, LinkagePart& part,
                                                      const LinkagePart&, const Arguments& given) {
                                         // Any other edit ends a drag.
                                         if (effect == Effect::Edit) part.drag.reset();
                                         change(part, given,
                                                workspace.runtimes.of<LinkageRuntime>(linkage_lab));
                                     });
}

/// A command that opens another linkage, brings it into view, and restarts the last ten seconds.
Command opening_command(const char* name, const char* title, std::vector<Argument> arguments,
                        const char* help, void (*change)(LinkagePart&, const Arguments&, LinkageRuntime&)) {
    Command command =
        and_then(linkage_command(name, title, std::move(arguments), help, change), look_at_linkage);
    command.apply = [open = std::move(command.apply)](Workspace& workspace, const Arguments& given) {
        const std::shared_ptr<const Part> before = workspace.document.parts().at(linkage_lab);
        open(workspace, given);
        if (workspace.lab == linkage_lab) begin_past(workspace, before);
    };
    return command;
}

std::vector<Argument> length_arguments() {
    std::vector<Argument> all{{.name = "lengths",
                               .type = ArgumentType::Any,
                               .required = false,
                               .help = "an object of lengths by their names"}};
    for (const MechanismKind& kind : mechanism_kinds())
        for (Argument& each : field_arguments(kind.fields, kind.texts)) {
            const auto same = std::ranges::find(all, each.name, &Argument::name);
            if (same == all.end()) {
                all.push_back(std::move(each));
            } else {
                same->low = std::min(same->low, each.low);
                same->high = std::max(same->high, each.high);
            }
        }
    return all;
}

}  // namespace

Argument linkage_point_argument(const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [](const Workspace& workspace) {
        return names(linkage_part(workspace).linkage().points, [](const auto& each) { return each.name; });
    });
}

void require_linkage_joint(const LinkagePart& part, const std::string& joint) {
    const auto link = part.linkage().find_link(joint);
    if (!link) throw Refused("there is no joint \"" + joint + "\"");
    if (part.linkage().links[*link].joint == ik::LinkJoint::Ball)
        throw Refused("joint \"" + joint + "\" is a ball: it has no single value");
}

std::size_t require_linkage_point(const LinkagePart& part, const std::string& name) {
    const auto point = part.linkage().find_point(name);
    if (!point) throw Refused("there is no point \"" + name + "\"");
    return *point;
}

void read_lengths(const JsonPlace& lengths, Mechanism& mechanism) {
    if (!lengths.json().is_object())
        lengths.fail("expected an object, found " + json_summary(lengths.json()));
    for (const auto& each : lengths.json().items())
        check_length_name(mechanism, each.key(), lengths.where() + "." + each.key());
    load_fields(lengths, mechanism_fields(mechanism));
}

bool goes_on(const LinkagePart& part) {
    return part.result.report.status == ik::LinkageStatus::IterationLimit &&
           std::ranges::any_of(part.drives, [&](const LinkageDrive& each) {
               return each.held && each.value != part.value_of(each.joint);
           });
}

bool is_stalled(const LinkagePart& part, const LinkageDrive& drive) {
    const ik::LinkageReport& report = part.result.report;
    return report.stopped && part.linkage().links[*report.stopped].name == drive.joint;
}

namespace {

/// Positions of a walker's feet in its own frame; empty for other linkages.
std::vector<glm::dvec3> feet_of(const LinkagePart& part) {
    std::vector<glm::dvec3> feet;
    if (part.copies.empty()) return feet;
    const std::size_t foot = *part.linkage().find_point(kind_of(part.shape->mechanism)->traced);
    feet.push_back(part.at(foot));
    for (const LinkageCopy& each : part.copies) feet.push_back(part.at(foot, each));
    return feet;
}

}  // namespace

void run_motors(LinkagePart& part, double seconds, LinkageRuntime& runtime) {
    part.time += seconds;
    if (part.drag) return;
    for (LinkageDrive& each : part.drives)
        if (each.rate != 0.0) each.value += each.rate * seconds;
    const std::vector<glm::dvec3> before = feet_of(part);
    solve_linkage(part, runtime);
    // The lowest foot stands still, so the ground moves with it.
    const std::vector<glm::dvec3> after = feet_of(part);
    std::size_t lowest = 0;
    for (std::size_t i = 0; i < after.size(); ++i)
        if (after[i].y < after[lowest].y) lowest = i;
    if (!after.empty()) part.walked -= after[lowest].x - before[lowest].x;
}

void add_linkage_commands(CommandTable& table) {
    const Argument to = point_argument("to", true, "metres");
    table.add(opening_command(
        "linkage.preset", "Open a linkage preset",
        {choice_argument("name", true, "which mechanism",
                         names(mechanism_kinds(), [](const auto& each) { return each.name; }))},
        "Opens a mechanism made from named lengths", preset));
    table.add(linkage_command("linkage.set", "Set a mechanism's lengths", length_arguments(),
                              "Sets lengths of the preset; omitted ones are kept", set_lengths));
    table.add(linkage_command(
        "linkage.drive", "Give a joint a value",
        {joint_argument(),
         number_argument("angle_deg",
                         "of a hinge, degrees. Under a full turn it is a direction, reached the "
                         "shorter way; from 360 or -360 on, turns are counted from 0",
                         -1e6, 1e6),
         number_argument("value", "of a slider, metres; of a hinge, radians, with its turns counted", -1e6,
                         1e6)},
        "Turns a hinge or moves a slider, and holds it there", drive));
    table.add(linkage_command("linkage.release", "Let a joint move freely", {joint_argument()},
                              "Stops the joint's motor and lets it follow the others", release));
    table.add(linkage_command(
        "linkage.range", "Limit how far a joint goes",
        {joint_argument(), number_argument("min", "degrees of a hinge, metres of a slider", -1e6, 1e6),
         number_argument("max", "likewise; one that is omitted is kept", -1e6, 1e6),
         switch_argument("off", "true: no range of its own")},
        "Limits a hinge or slider to a range", set_range));
    table.add(linkage_command(
        "linkage.motor", "Run a motor",
        {joint_argument(),
         number_argument("deg_per_s", "of a hinge; 0 stops it", -max_motor_rate, max_motor_rate),
         number_argument("per_s", "of a slider, metres a second", -max_motor_rate, max_motor_rate)},
        "Runs a joint at this speed while the simulation runs. Default: the speed it last ran at, or first "
        "90 degrees or a tenth of the linkage's size a second",
        motor));
    table.add(linkage_command("linkage.target", "Pull a point to a position",
                              {linkage_point_argument("point", true, "which point"), to,
                               number_argument("weight", "relative to other targets", 1e-6, 1e6),
                               switch_argument("exact", "comes before all targets that are not")},
                              "Pulls a point to a position as far as the drivers let it", target));
    table.add(linkage_command("linkage.target.remove", "Remove a point's target",
                              {linkage_point_argument("point", true, "which point")},
                              "Removes the target from the point", remove_target));
    table.add(linkage_command("linkage.drag", "Drag a point of the linkage",
                              {linkage_point_argument("point", true, "which point"), to},
                              "Drags a point as the mouse does: drivers follow until it is released", drag));
    table.add(linkage_command("linkage.let_go", "Let go of the linkage", {}, "Ends a drag", let_go));
    table.add(and_then(
        linkage_command("linkage.other_mode", "Switch to another assembly mode",
                        {switch_argument("nearest", "the one most like this; omitted: each in turn")},
                        "Assembles the same bars in another way; the drivers do not move", other_mode),
        keep_linkage_in_view));
    table.add(
        opening_command("linkage.clear", "Remove all bars and joints", {}, "Removes everything", clear));
    table.add(opening_command("linkage.reset", "Reset the Linkage lab", {},
                              "Resets this lab to its first state", reset));
    table.add(linkage_command("linkage.select", "Select a joint",
                              {linkage_point_argument("point", false, "which one; none if omitted")},
                              "Selects a joint or point; its path is drawn", select, Effect::Look));
    table.add(linkage_command("linkage.tool", "Choose what the mouse does",
                              {choice_argument("name", true, "which tool", linkage_tools.names())},
                              "Chooses what clicks and drags in the view do", choose_tool, Effect::Look));
    table.add({.name = "linkage.copy",
               .title = "Copy the linkage as C++",
               .arguments = {},
               .help = "Copies the linkage to the clipboard as a C++ program that uses the library",
               .effect = Effect::Look,
               .apply = [](Workspace& workspace, const Arguments&) {
                   workspace.ui.copied = LinkageLab().code(workspace);
                   workspace.toast("The linkage is on the clipboard as C++");
               }});
}

}  // namespace tendril::app
