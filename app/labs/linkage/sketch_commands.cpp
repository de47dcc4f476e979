// Commands that draw a linkage by hand: joints, bars, pins and motors.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/linkage/linkage_commands.hpp"

namespace tendril::app {
namespace {

using ik::LinkageSketch, ik::SketchHold;

std::size_t require_in_sketch(const LinkageSketch& sketch, const std::string& point) {
    const auto found = sketch.find_point(point);
    if (!found) throw Refused("there is no point \"" + point + "\"");
    return *found;
}

std::size_t require_bar(const LinkageSketch& sketch, const std::string& bar) {
    const auto found = sketch.find_bar(bar);
    if (!found) throw Refused("there is no bar \"" + bar + "\"");
    return *found;
}

/// A to Z, then A2 to Z2, ...
std::string free_point_name(const LinkageSketch& sketch) {
    for (std::size_t i = 0;; ++i) {
        std::string name(1, static_cast<char>('A' + i % 26));
        if (i >= 26) name += std::to_string(i / 26 + 1);
        if (!sketch.find_point(name)) return name;
    }
}

/// True if a bar, a motor or a sliding joint has this name: each of them becomes a link.
bool is_link_name(const LinkageSketch& sketch, const std::string& name) {
    const auto point = sketch.find_point(name);
    return sketch.find_bar(name) || std::ranges::count(sketch.motors, name, &ik::SketchMotor::name) > 0 ||
           (point && sketch.points[*point].hold == SketchHold::Guided);
}

/// The first unused name: "motor 2".
std::string free_link_name(const LinkageSketch& sketch, const std::string& what) {
    for (std::size_t i = 1;; ++i) {
        std::string name = what + " " + std::to_string(i);
        if (!is_link_name(sketch, name)) return name;
    }
}

/// "BC", or "B-foot", after the joints at its ends.
std::string free_bar_name(const LinkageSketch& sketch, std::size_t from, std::size_t to) {
    const auto [a, b] = std::minmax(sketch.points[from].name, sketch.points[to].name);
    const std::string name = a + (a.size() + b.size() == 2 ? "" : "-") + b;
    return is_link_name(sketch, name) ? free_link_name(sketch, name) : name;
}

glm::dvec2 place_in_plane(const Json& json, const std::string& where) {
    const glm::dvec3 at = json_dpoint(json, where);
    if (glm::length(at) > max_linkage_extent) throw Refused(where + ": at most 1e6 m from the origin");
    return glm::dvec2(at);
}

std::size_t add_point(LinkageSketch& sketch, const std::string& name, const glm::dvec2& at) {
    if (sketch.points.size() >= max_linkage_points)
        throw Refused("a linkage has at most " + std::to_string(max_linkage_points) + " joints");
    if (sketch.find_point(name)) throw Refused("there is a joint \"" + name + "\" already");
    sketch.points.push_back({.name = name, .at = at});
    return sketch.points.size() - 1;
}

void add_joint(LinkageSketch& sketch, const Arguments& given) {
    const std::string name = given.has("name") ? given.text("name") : free_point_name(sketch);
    if (name.empty()) throw Refused("name: a joint needs one");
    const std::size_t point = add_point(sketch, name, place_in_plane(given.json("at"), "at"));
    if (given.has("bar")) sketch.bars[require_bar(sketch, given.text("bar"))].points.push_back(point);
}

/// A joint by name, or a new one at a position.
std::size_t end_of_bar(LinkageSketch& sketch, const Arguments& given, const char* argument) {
    const Json& json = given.json(argument);
    if (json.is_string()) return require_in_sketch(sketch, json.get<std::string>());
    return add_point(sketch, free_point_name(sketch), place_in_plane(json, argument));
}

void add_bar(LinkageSketch& sketch, const Arguments& given) {
    if (sketch.bars.size() >= max_linkage_bars)
        throw Refused("a linkage has at most " + std::to_string(max_linkage_bars) + " bars");
    const std::size_t from = end_of_bar(sketch, given, "from"), to = end_of_bar(sketch, given, "to");
    const std::string name = given.has("name") ? given.text("name") : free_bar_name(sketch, from, to);
    if (name.empty()) throw Refused("name: a bar needs one");
    if (is_link_name(sketch, name)) throw Refused("name: \"" + name + "\" is taken");
    if (from == to || sketch.points[from].at == sketch.points[to].at)
        throw Refused("a bar needs two different joints");
    for (const ik::SketchBar& each : sketch.bars)
        if (is_on_bar(each, from) && is_on_bar(each, to))
            throw Refused("bar \"" + each.name + "\" joins " + sketch.points[from].name + " and " +
                          sketch.points[to].name + " already");
    sketch.bars.push_back({.name = name, .points = {from, to}});
}

/// Removes motors against the ground at a joint that the ground no longer holds.
void remove_motors_at(LinkageSketch& sketch, std::size_t point) {
    std::erase_if(sketch.motors, [&](const ik::SketchMotor& each) {
        return each.point == point && each.against == ik::ground_link;
    });
}

void pin(LinkageSketch& sketch, const Arguments& given) {
    const std::size_t index = require_in_sketch(sketch, given.text("point"));
    ik::SketchPoint& point = sketch.points[index];
    const bool pinned = point.hold == SketchHold::Pinned;
    const bool on = given.has("on") ? given.boolean("on") : !pinned;
    const SketchHold hold = on ? SketchHold::Pinned : SketchHold::Free;
    if (std::exchange(point.hold, hold) == hold) return;
    if (!on) remove_motors_at(sketch, index);
}

void guide(LinkageSketch& sketch, const Arguments& given) {
    const std::size_t index = require_in_sketch(sketch, given.text("point"));
    if (sketch.points[index].hold != SketchHold::Guided && is_link_name(sketch, sketch.points[index].name))
        throw Refused("\"" + sketch.points[index].name + "\" is a bar's or motor's name: it cannot slide");
    sketch.points[index].hold = SketchHold::Guided;
    sketch.points[index].guide = 0.0;
    set_fields(given, {guide_fields(), &sketch.points[index]});
    remove_motors_at(sketch, index);
}

void move(LinkageSketch& sketch, const Arguments& given) {
    sketch.points[require_in_sketch(sketch, given.text("point"))].at = place_in_plane(given.json("to"), "to");
}

/// Makes a link a telescope: inserts a slider after it, which takes over everything at its far end.
ik::Linkage with_telescope(ik::Linkage linkage, std::size_t link, const glm::dvec3& far) {
    const glm::dvec3 near = linkage.links[link].at;
    const std::size_t slider = link + 1;
    const auto renumber = [&](std::size_t& index, const glm::dvec3& at) {
        if (index == ik::ground_link || index < link) return;
        if (index > link || glm::distance(at, far) < glm::distance(at, near)) ++index;
    };
    for (ik::Link& each : linkage.links)
        if (each.parent != ik::ground_link) renumber(each.parent, each.at);
    for (ik::LinkPoint& each : linkage.points) renumber(each.link, each.at);
    for (ik::Closure& each : linkage.closures) {
        renumber(each.first, each.first_at);
        renumber(each.second, each.second_at);
    }
    linkage.links.insert(linkage.links.begin() + static_cast<std::ptrdiff_t>(slider),
                         {.parent = link, .joint = ik::LinkJoint::Slider, .at = near, .axis = far - near});
    return linkage;
}

void set_length(LinkageSketch& sketch, const Arguments& given) {
    set_bar_length(sketch, require_bar(sketch, given.text("bar")), given.real("length"));
}

bool has_motor(const LinkageSketch& sketch, std::size_t point, std::size_t bar, std::size_t against) {
    return std::ranges::any_of(sketch.motors, [&](const ik::SketchMotor& each) {
        return each.point == point &&
               ((each.bar == bar && each.against == against) || (each.bar == against && each.against == bar));
    });
}

/// The bar that a motor turns, and the bar that it turns against; the second is nearer to the ground.
std::pair<std::size_t, std::size_t> motor_bars(const LinkageSketch& sketch, std::size_t point,
                                               const Arguments& given) {
    const std::string& at = sketch.points[point].name;
    const bool pinned = sketch.points[point].hold == SketchHold::Pinned;
    const std::vector<std::size_t> here = bars_at(sketch, point);
    const auto given_bar = [&](const char* argument) {
        if (!given.has(argument)) return ik::ground_link;
        const std::size_t bar = require_bar(sketch, given.text(argument));
        if (std::ranges::count(here, bar) == 0)
            throw Refused("bar \"" + sketch.bars[bar].name + "\" is not on " + at);
        return bar;
    };
    std::size_t bar = given_bar("bar");
    const std::size_t against = given_bar("against");
    if (bar != ik::ground_link && bar == against)
        throw Refused("against: give another bar than \"" + sketch.bars[bar].name + "\"");
    if (pinned && against == ik::ground_link) {
        const auto still = std::ranges::find_if(
            here, [&](std::size_t each) { return !has_motor(sketch, point, each, ik::ground_link); });
        if (bar == ik::ground_link && still == here.end())
            throw Refused("there is no bar on " + at + " that a motor could turn");
        return {bar == ik::ground_link ? *still : bar, ik::ground_link};
    }
    if (bar != ik::ground_link && against != ik::ground_link) return {bar, against};
    if (here.size() < 2)
        throw Refused(at + (pinned
                                ? " has one bar: leave out against, and the motor turns it against the ground"
                                : " is not pinned: a motor there needs a second bar to push against"));
    if (here.size() > 2)
        throw Refused(count_text(here.size(), "bar") + " meet at " + at +
                      (chooses_pair(sketch, point)
                           ? ": choose two of them in the inspector, or give bar and against"
                           : ": give bar and against"));
    if (bar != ik::ground_link) return {bar, here[0] == bar ? here[1] : here[0]};
    if (against != ik::ground_link) return {here[0] == against ? here[1] : here[0], against};
    const std::vector<std::size_t> away = bars_from_ground(sketch);
    return away[here[1]] < away[here[0]] ? std::pair(here[0], here[1]) : std::pair(here[1], here[0]);
}

void add_motor(LinkageSketch& sketch, const Arguments& given) {
    const std::size_t point = require_in_sketch(sketch, given.text("point"));
    const auto [bar, against] = motor_bars(sketch, point, given);
    if (has_motor(sketch, point, bar, against))
        throw Refused("bar \"" + sketch.bars[bar].name + "\" has a motor there already");
    const std::string name = given.has("name") ? given.text("name") : free_link_name(sketch, "motor");
    if (name.empty() || is_link_name(sketch, name)) throw Refused("name: \"" + name + "\" is taken");
    sketch.motors.push_back({.name = name, .point = point, .bar = bar, .against = against});
}

void remove_motor(LinkageSketch& sketch, const Arguments& given) {
    const std::string name = given.text("joint");
    if (std::erase_if(sketch.motors, [&](const ik::SketchMotor& each) { return each.name == name; }) == 0)
        throw Refused("there is no motor \"" + name + "\"");
}

void remove_bar_or_joint(LinkageSketch& sketch, const Arguments& given) {
    if (given.has("point") == given.has("bar")) throw Refused("give a point or a bar, and not both");
    if (given.has("point"))
        require_ok(ik::remove_point(sketch, require_in_sketch(sketch, given.text("point"))));
    else
        require_ok(ik::remove_bar(sketch, require_bar(sketch, given.text("bar"))));
}

/// Reports when a mechanism loses its named lengths.
void edit_by_hand(Workspace& workspace, const auto& change) {
    const MechanismKind* const was = kind_of(linkage_part(workspace).shape->mechanism);
    change_part<LinkagePart>(workspace, linkage_lab, change);
    if (was != nullptr && kind_of(linkage_part(workspace).shape->mechanism) == nullptr)
        workspace.toast(std::string(was->title) + ": drawn by hand from here on, without named lengths");
}

/// A command that edits the sketch in the present pose.
Command sketch_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                       void (*edit)(LinkageSketch&, const Arguments&)) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = Effect::Edit,
            .apply = [edit](Workspace& workspace, const Arguments& given) {
                auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
                const auto change = [&](LinkagePart& part, const LinkagePart&) {
                    const LinkageSketch before = present_sketch(part);
                    LinkageSketch sketch = before;
                    edit(sketch, given);
                    if (!(sketch == before)) take_shape(part, shape_of(std::move(sketch)), runtime);
                    if (part.tool == LinkageTool::Motor) part.tool = LinkageTool::Move;
                };
                edit_by_hand(workspace, change);
            }};
}

Argument place_argument(const char* name) {
    return point_argument(name, true, "[x, y, 0], metres");
}

Argument bar_argument(bool required, const char* help, const char* name = "bar") {
    return offering(text_argument(name, required, help), [](const Workspace& workspace) {
        return names(linkage_part(workspace).shape->sketch.bars, [](const auto& each) { return each.name; });
    });
}

Argument end_argument(const char* name) {
    return {.name = name,
            .type = ArgumentType::ListOrText,
            .help = "a joint's name, or [x, y, 0] for a new joint, metres"};
}

}  // namespace

std::span<const Field> guide_fields() {
    static const Field row = [] {
        Field named = field_of<&ik::SketchPoint::guide>();
        named.name = "angle";
        named.usual = {-std::numbers::pi, std::numbers::pi};
        return named;
    }();
    return {&row, 1};
}

template <>
std::span<const FieldText> field_texts<ik::SketchPoint>() {
    static constexpr FieldText texts[] = {{.name = "angle",
                                           .label = "line",
                                           .help = "The direction of its line, from +X; by default 0.",
                                           .step = 0.5f,
                                           .decimals = 1}};
    return texts;
}

void set_bar_length(LinkageSketch& sketch, std::size_t index, double wanted) {
    const ik::SketchBar& bar = sketch.bars[index];
    if (bar.points.size() != 2)
        throw Refused("bar \"" + bar.name + "\" has more than two joints: move the joints instead");
    LinkageSketch held = sketch;
    if (floating_bars(held)[index]) held.points[bar.points[0]].hold = SketchHold::Pinned;
    const ik::Linkage linkage = shape_of(held).linkage;
    const std::size_t link = link_of_bar(linkage, held, index).value();
    glm::dvec3 near(sketch.points[bar.points[0]].at, 0.0), far(sketch.points[bar.points[1]].at, 0.0);
    if (glm::distance(linkage.links[link].at, far) < glm::distance(linkage.links[link].at, near))
        std::swap(near, far);
    auto solver = require_value(ik::LinkageSolver::make(with_telescope(linkage, link, far)));
    ik::LinkageState state = solver.initial_state();
    const double now = glm::distance(near, far);
    const ik::LinkDriver grow{link + 1, wanted - now};
    if (solver.solve(state, {{&grow, 1}, {}}).status != ik::LinkageStatus::Reached)
        throw Refused("bar \"" + bar.name + "\" gets to " +
                      app::length_text(now + state.joints[link + 1].value) +
                      " while the others keep their lengths, not " + app::length_text(wanted));
    for (std::size_t i = 0; i < sketch.points.size(); ++i) sketch.points[i].at = glm::dvec2(solver.point(i));
}

std::vector<std::size_t> bars_at(const LinkageSketch& sketch, std::size_t point) {
    std::vector<std::size_t> bars;
    for (std::size_t b = 0; b < sketch.bars.size(); ++b)
        if (is_on_bar(sketch.bars[b], point)) bars.push_back(b);
    return bars;
}

bool chooses_pair(const LinkageSketch& sketch, std::size_t point) {
    constexpr std::size_t most_bars = 4;
    return sketch.points[point].hold == SketchHold::Free && bars_at(sketch, point).size() <= most_bars;
}

void add_sketch_commands(CommandTable& table) {
    const Argument point = linkage_point_argument("point", true, "which joint");
    const Argument name = text_argument("name", false, "a free one if omitted");
    table.add(sketch_command(
        "linkage.joint", "Add a joint",
        {place_argument("at"), name, bar_argument(false, "the bar that carries it; omitted: none yet")},
        "Adds a joint, alone or on a bar", add_joint));
    table.add(sketch_command("linkage.bar", "Add a bar", {end_argument("from"), end_argument("to"), name},
                             "Adds a bar between two joints, and the joints where there are none", add_bar));
    table.add(sketch_command("linkage.pin", "Pin a joint to the ground",
                             {point, switch_argument("on", "toggles if omitted")},
                             "Pins a joint to the ground, or unpins it", pin));
    std::vector<Argument> line = field_arguments(guide_fields(), field_texts<ik::SketchPoint>());
    line.insert(line.begin(), point);
    table.add(sketch_command("linkage.guide", "Slide a joint on a line", std::move(line),
                             "Keeps a joint on a straight line through its position", guide));
    table.add(sketch_command("linkage.move", "Move a joint of the drawing", {point, place_argument("to")},
                             "Moves a joint: its bars change their lengths", move));
    table.add(sketch_command(
        "linkage.length", "Set a bar's length",
        {bar_argument(true, "which bar"), {.name = "length", .help = "metres", .low = 1e-6, .high = 1e6}},
        "Makes a bar longer or shorter; the others keep their lengths", set_length));
    table.add(sketch_command(
        "linkage.motor.add", "Add a motor",
        {point,
         bar_argument(false,
                      "which of its bars; if omitted the first on a pin, else of two the "
                      "one farther from the ground"),
         bar_argument(false,
                      "another of its bars; if omitted the ground, or where nothing "
                      "pins the joint, the bar nearer to it",
                      "against"),
         name},
        "Puts a motor at a joint: it turns a bar against the ground, or another bar", add_motor));
    table.add(sketch_command("linkage.motor.remove", "Remove a motor",
                             {text_argument("joint", true, "which motor")}, "Removes a motor; its bar stays",
                             remove_motor));
    table.add(
        sketch_command("linkage.remove", "Remove a joint or bar",
                       {linkage_point_argument("point", false, "which joint, with the bars that end there"),
                        bar_argument(false, "or which bar")},
                       "Removes a joint or a bar", remove_bar_or_joint));
    table.add({.name = "linkage.remove_selected",
               .title = "Delete selection",
               .arguments = {},
               .help = "Removes the selected joint",
               .effect = Effect::Edit,
               .apply = [](Workspace& workspace, const Arguments&) {
                   auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
                   const auto change = [&](LinkagePart& part, const LinkagePart&) {
                       if (part.selected.empty()) throw Refused("no joint is selected");
                       LinkageSketch sketch = present_sketch(part);
                       require_ok(ik::remove_point(sketch, require_in_sketch(sketch, part.selected)));
                       take_shape(part, shape_of(std::move(sketch)), runtime);
                   };
                   edit_by_hand(workspace, change);
               }});
}

}  // namespace tendril::app
