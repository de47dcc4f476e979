#include "app/labs/linkage/linkage_lab.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/linkage/draw.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

/// The picked item of `all`, whose picks begin at `first`; null if something else is picked.
template <class T>
const T* picked(const std::vector<T>& all, PickId pick, PickId first) {
    const bool is_one = pick >= first && static_cast<std::size_t>(pick - first) < all.size();
    return is_one ? &all[static_cast<std::size_t>(pick - first)] : nullptr;
}

constexpr float catch_pixels = 14.0f;  ///< maximum distance from a joint or bar at which a stroke snaps to it

/// The end of a stroke: an existing joint, or a position in the plane.
struct StrokeEnd {
    std::string joint{};
    glm::vec3 place{0.0f};
    ArgumentValue argument() const {
        return joint.empty() ? ArgumentValue(SharedJson(Json{place.x, place.y, 0.0f})) : ArgumentValue(joint);
    }
};

std::optional<StrokeEnd> end_at(const LinkagePart& part, const Camera& camera, glm::vec2 pixel) {
    StrokeEnd end;
    float nearest = catch_pixels;
    for (std::size_t i = 0; i < part.linkage().points.size(); ++i) {
        const auto at = camera.project(in_scene(part, part.at(i)));
        const float far = at ? glm::distance(*at, pixel) : nearest;
        if (far >= nearest) continue;
        nearest = far;
        end.joint = part.linkage().points[i].name;
    }
    if (!end.joint.empty()) return end;
    const auto place = camera.on_plane(pixel, glm::vec3(0.0f), {0, 0, 1});
    if (!place) return std::nullopt;
    end.place = from_scene(part, *place);
    return end;
}

/// The bar nearest to a pixel, within catch_pixels; empty: none.
std::string bar_at(const LinkagePart& part, const Camera& camera, glm::vec2 pixel) {
    std::string found;
    float nearest = catch_pixels;
    for (const ik::SketchBar& bar : part.shape->sketch.bars)
        for (std::size_t i = 0; i < bar.points.size(); ++i) {
            const auto a = camera.project(in_scene(part, part.at(bar.points[i])));
            const auto b = camera.project(in_scene(part, part.at(bar.points[(i + 1) % bar.points.size()])));
            if (!a || !b || *a == *b) continue;
            const glm::vec2 way = *b - *a;
            const float along = std::clamp(glm::dot(pixel - *a, way) / glm::dot(way, way), 0.0f, 1.0f);
            const float far = glm::distance(pixel, *a + along * way);
            if (far >= nearest) continue;
            nearest = far;
            found = bar.name;
        }
    return found;
}

/// A preset as a call: "ik::four_bar({.ground = 3.0, ...})".
std::string call_text(const Mechanism& mechanism) {
    const bool walker = std::holds_alternative<JansenWalker>(mechanism);
    return "ik::" + std::string(walker ? "jansen" : kind_of(mechanism)->name) + "({" +
           comma_list(member_texts(mechanism_fields(mechanism))) + "})";
}

/// Code for the ranges set by hand, before the solver is made.
std::string ranges_text(const LinkagePart& part) {
    std::string text;
    for (const LinkageRange& each : part.shape->ranges) {
        const std::size_t link = *part.linkage().find_link(each.joint);
        const std::string at = "    linkage->links[" + std::to_string(link) + "].";
        if (std::isfinite(each.minimum)) text += at + "minimum = " + double_text(each.minimum) + ";\n";
        if (std::isfinite(each.maximum)) text += at + "maximum = " + double_text(each.maximum) + ";\n";
        text += at + "rest = " + double_text(part.linkage().links[link].rest) + ";\n";
    }
    return text;
}

/// Declares `what` as an Expected and checks it.
std::string expected_text(const std::string& type, const std::string& what, const std::string& from) {
    return "    Expected<ik::" + type + "> " + what + " = " + from + ";\n    if (!" + what +
           ") return std::puts(" + what + ".message()), 1;\n";
}

}  // namespace

std::shared_ptr<Part> LinkageLab::blank() const {
    return std::make_shared<LinkagePart>(first_linkage());
}

CameraPose LinkageLab::first_view() const {
    return {.target = {1.4f, 0.8f, 0.0f}, .distance = 7.5f, .orthographic = true};
}

std::string LinkageLab::invitation(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    const bool empty = part.shape->in_plane() && part.shape->sketch.bars.empty();
    if (empty || part.tool != LinkageTool::Move)
        return linkage_tools.help(empty ? LinkageTool::Draw : part.tool);
    return part.drives.empty() ? "Drag any joint." : "Drag any joint, or run the motor.";
}

void LinkageLab::add_commands(CommandTable& table) const {
    add_linkage_commands(table);
    add_sketch_commands(table);
}

bool LinkageLab::moving(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    return goes_on(part) || std::ranges::any_of(part.drives, [&](const LinkageDrive& each) {
               return each.rate != 0.0 && !is_stalled(part, each);
           });
}

void LinkageLab::step(Workspace& workspace) const {
    const bool modified = workspace.modified();
    auto& runtime = workspace.runtimes.of<LinkageRuntime>(linkage_lab);
    run_motors(workspace.document.edit<LinkagePart>(linkage_lab),
               tick_seconds * static_cast<double>(workspace.clock.speed), runtime);
    if (!modified) workspace.saved = workspace.document;  // time does not modify the scene
}

/// A whole turn of the only motor, to the nearest tick.
int LinkageLab::loop_ticks(const Workspace& workspace) const {
    const auto& drives = linkage_part(workspace).drives;
    const Rewind& past = workspace.rewind;
    if (drives.size() != 1 || drives[0].rate == 0.0 || past.empty()) return 0;
    if (!turns(linkage_part(workspace), drives[0].joint)) return 0;
    const double tick = std::abs(drives[0].rate) * tick_seconds * static_cast<double>(workspace.clock.speed);
    const double ticks = std::round(glm::two_pi<double>() / tick);
    if (ticks < 1.0 || ticks > static_cast<double>(Rewind::max_ticks)) return 0;
    const std::uint64_t present =
        workspace.moment > past.newest() ? 1 : 0;  // the present is not remembered yet
    const auto& then = past.at(static_cast<std::uint64_t>(ticks) - present).part;
    const LinkageDrive* const before = part_as<LinkagePart>(*then).find_drive(drives[0].joint);
    const double turned = before != nullptr ? std::abs(drives[0].value - before->value) : 0.0;
    return std::abs(turned - glm::two_pi<double>()) <= 0.51 * tick ? static_cast<int>(ticks) : 0;
}

std::vector<Handle> LinkageLab::handles(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    std::vector<Handle> all;
    for (std::size_t i = 0; i < part.linkage().points.size(); ++i)
        all.push_back({part.linkage().points[i].name, linkage_pick(i), {in_scene(part, part.at(i))}});
    for (std::size_t i = 0; i < part.targets.size(); ++i)
        all.push_back({"target." + part.targets[i].point,
                       linkage_target_pick(i),
                       {in_scene(part, part.targets[i].to)}});
    return all;
}

void LinkageLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const LinkagePart& part = linkage_part(workspace);
    if (const LinkageTarget* const target = picked(part.targets, pick, linkage_target_pick(0)))
        return emit.continuously("linkage.target",
                                 {{"point", target->point}, {"to", from_scene(part, frame.position)}});
    const ik::LinkPoint* const point = picked(part.linkage().points, pick, linkage_pick(0));
    if (point == nullptr) return;
    const bool stays = point->link == ik::ground_link;
    if (stays && kind_of(part.shape->mechanism) != nullptr) return;  // the lengths determine the pose
    emit.continuously(stays ? "linkage.move" : "linkage.drag",
                      {{"point", point->name}, {"to", from_scene(part, frame.position)}});
}

void LinkageLab::drop(const Workspace& workspace, PickId, Emit& emit) const {
    if (linkage_part(workspace).drag) emit.continuously("linkage.let_go");
}

void LinkageLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    const LinkagePart& part = linkage_part(workspace);
    const ik::LinkPoint* const point = picked(part.linkage().points, pick, linkage_pick(0));
    if (point == nullptr) {
        if (!part.selected.empty() && part.tool == LinkageTool::Move) emit("linkage.select");
        return;
    }
    emit("linkage.select", {{"point", point->name}});
    if (part.tool == LinkageTool::Pin) emit("linkage.pin", {{"point", point->name}});
    if (part.tool != LinkageTool::Motor) return;
    const auto& sketch = part.shape->sketch;
    for (const ik::SketchMotor& each : sketch.motors)
        if (sketch.points[each.point].name == point->name)
            return emit("linkage.motor.remove", {{"joint", each.name}});
    emit("linkage.motor.add", {{"point", point->name}});
}

void LinkageLab::stroke(const Workspace& workspace, std::size_t, const Camera& camera, glm::vec2 from,
                        glm::vec2 to, Emit& emit) const {
    const LinkagePart& part = linkage_part(workspace);
    const auto begin = end_at(part, camera, from), end = end_at(part, camera, to);
    if (!begin || !end) return;
    if (from != to) {
        if (!begin->joint.empty() && begin->joint == end->joint) return;
        return emit.continuously("linkage.bar", {{"from", begin->argument()}, {"to", end->argument()}});
    }
    if (!begin->joint.empty()) return;
    const std::string bar = bar_at(part, camera, from);
    ArgumentList arguments{{"at", begin->place}};
    if (!bar.empty()) arguments.push_back({"bar", bar});
    emit.continuously("linkage.joint", arguments);
}

std::string LinkageLab::hint(const Workspace& workspace, PickId pick) const {
    const LinkagePart& part = linkage_part(workspace);
    if (const LinkageTarget* const target = picked(part.targets, pick, linkage_target_pick(0)))
        return "Where " + target->point + " is pulled to: drag moves it.";
    const ik::LinkPoint* const point = picked(part.linkage().points, pick, linkage_pick(0));
    std::string name = point != nullptr ? point->name : "";
    const bool stays = point != nullptr && point->link == ik::ground_link;
    if (part.tool != LinkageTool::Move)
        return (point != nullptr ? name + ". " : name) + linkage_tools.help(part.tool);
    if (point == nullptr) return {};
    const std::string speed =
        point_speed_text(part, name, workspace.runtimes.of<LinkageRuntime>(linkage_lab));
    if (!speed.empty()) name += ", " + speed;
    const bool named = kind_of(part.shape->mechanism) != nullptr;
    return name + (stays && named ? ": pinned where the mechanism's lengths put it. Click selects it."
                   : stays        ? ": drag moves it, and its bars change their lengths. Click selects it."
                                  : ": drag moves the linkage. Click selects it and draws its path.");
}

Bounds LinkageLab::bounds(const Workspace& workspace, bool) const {
    return linkage_bounds(workspace);
}

std::vector<Shortcut> LinkageLab::shortcuts() const {
    return {delete_shortcut("linkage.remove_selected")};
}

std::vector<MouseHelp> LinkageLab::mouse_help() const {
    return {{"Left drag on a joint", "moves the linkage; drivers follow"},
            {"Left drag with Draw", "draws a bar, from joint to joint or to a new one"},
            {"Left click with Draw", "adds a joint, on a bar or beside it"},
            {"Left click with Pin, Motor", "pins a joint; puts a motor at one"}};
}

std::vector<CommandCall> LinkageLab::opening() const {
    return {{"linkage.motor", {{"joint", "crank"}, {"deg_per_s", 60.0f}}}};
}

std::vector<CommandCall> LinkageLab::calm() const {
    return {{"linkage.release", {{"joint", "crank"}}}};
}

Json linkage_state(const LinkagePart& part) {
    const LinkageResult& result = part.result;
    Json points = Json::object(), drivers = Json::object(), active = Json::array(), open = Json::array(),
         targets = Json::object(), jumped = nullptr;
    for (std::size_t i = 0; i < part.linkage().points.size(); ++i)
        points[part.linkage().points[i].name] = dpoint(part.at(i));
    for (const LinkageDrive& each : part.drives)
        drivers[each.joint] = in_degrees(part, each.joint, part.value_of(each.joint));
    for (const std::size_t each : result.active) active.push_back(part.linkage().links[each].name);
    for (const std::size_t each : result.open_closures) open.push_back(part.linkage().closures[each].name);
    for (const LinkageTarget& each : part.targets) {
        Json& target = targets[each.point] = save_fields(each);
        target["residual"] = glm::distance(each.to, part.at(*part.linkage().find_point(each.point)));
    }
    if (const LinkageTarget* const target = jumped_target(part))
        jumped = {{"point", target->point}, {"distance", result.report.jump}};
    const ik::LinkageFreedom freedom = freedom_of(part);
    LinkageRuntime fresh;
    return Json{{"points", std::move(points)},
                {"closed_to", result.report.closed_to},
                {"freedom", freedom.actual},
                {"gruebler", freedom.counted},
                {"status", ik::name(result.report.status)},
                {"verdict", linkage_verdict(part, fresh).text},
                {"drivers", std::move(drivers)},
                {"targets", std::move(targets)},
                {"active", std::move(active)},
                {"open_closures", std::move(open)},
                {"jumped", std::move(jumped)}};
}

Json LinkageLab::state(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    const double transmission = transmission_angle(part);
    LinkageRuntime fresh;  // depends only on the pose, to the bit
    const LinkageTurn& turn = fresh.turn(part);
    Json worst;
    if (const auto found = worst_transmission(part, turn)) {
        const std::string& joint = part.linkage().links[turn.joint].name;
        worst = {{"degrees", found->degrees}, {"at", shown_value(part, joint, found->value).value}};
    }
    Json state = Lab::state(workspace);
    Json motors = std::move(state["drivers"]);  // `drivers` has only their angles
    state["motors"] = std::move(motors);
    state.update(linkage_state(part));
    state.update({{"transmission_angle", std::isfinite(transmission) ? Json(transmission) : Json(nullptr)},
                  {"transmission_minimum", std::move(worst)},
                  {"seconds", part.time},
                  {"past", past_state(workspace, linkage_past())}});
    return state;
}

// Export: the linkage as a C++ program that uses the library.

/// A complete program: builds the linkage with the library, runs its motors for a second and prints its
/// points.
std::string LinkageLab::code(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    std::string text =
        "// A linkage, exported from Tendril.\n//\n"
        "// CMake: find_package(tendril REQUIRED)\n"
        "//        target_link_libraries(your_program PRIVATE tendril::core)\n"
        "#include <cstdio>\n"
        "#include <tendril/ik/linkage.hpp>\n"
        "#include <tendril/ik/mechanisms.hpp>\n"
        "#include <vector>\n\n"
        "using namespace tendril;\n\n"
        "int main() {\n";
    const Mechanism& mechanism = part.shape->mechanism;
    const bool drawn = kind_of(mechanism) == nullptr, plane = part.shape->in_plane();
    if (drawn)
        text += "    const ik::LinkageSketch sketch" + struct_text(part.shape->sketch, "        ") + ";\n";
    if (!drawn && plane) text += expected_text("LinkageSketch", "sketch", call_text(mechanism));
    const std::string sketch = drawn ? "ik::linkage_from(sketch)" : "ik::linkage_from(*sketch)";
    text += expected_text("Linkage", "linkage", plane ? sketch : call_text(mechanism));
    text += ranges_text(part);
    text +=
        "    Expected<ik::LinkageSolver> made = ik::LinkageSolver::make(*linkage);\n"
        "    if (!made) return std::puts(made.message()), 1;\n"
        "    ik::LinkageSolver& solver = *made;\n"
        "    // All that it remembers: copy it to save it.\n"
        "    ik::LinkageState state = solver.initial_state();\n";
    text += "    state = " + struct_text(part.state, "        ") + ";\n";
    if (!part.copies.empty())
        text +=
            "    // One of the twelve legs. The others are the same linkage, each with a state of its own, "
            "its\n"
            "    // motor a sixth of a turn further from pair to pair; half of them are mirrored.\n";
    text +=
        "\n    for (int frame = 0; frame <= 60; ++frame) {\n"
        "        std::vector<ik::LinkDriver> drivers;\n";
    LinkageRuntime runtime;
    const bool moves = part.targets.empty() && part.result.freedom.actual == 1;  // a motor at rest counts too
    if (moves && !part.drives.empty() && std::ranges::none_of(part.drives, is_running))
        text += "        // The motor is at rest in the lab; here it runs.\n";
    for (const LinkageDrive& each : moves ? moving_drives(part, runtime) : part.drives) {
        if (!each.held) continue;
        text += "        drivers.push_back({*linkage->find_link(" + string_text(each.joint) + "), " +
                double_text(each.value);
        if (each.rate != 0.0) text += " + frame / 60.0 * " + double_text(each.rate);
        text += "});\n";
    }
    text += "        std::vector<ik::LinkTarget> targets;\n";
    for (const LinkageTarget& each : part.targets)
        text += "        targets.push_back({*linkage->find_point(" + string_text(each.point) + "), " +
                braced(each.to) + ", " + double_text(each.weight) + (each.exact ? ", true" : "") + "});\n";
    text +=
        "        const ik::LinkageReport report = solver.solve(state, {drivers, targets});\n"
        "        std::printf(\"%d %s\", frame, ik::name(report.status));\n"
        "        for (std::size_t i = 0; i < linkage->points.size(); ++i) {\n"
        "            const glm::dvec3 at = solver.point(i);\n"
        "            std::printf(\" %s %.6f %.6f %.6f\", linkage->points[i].name.c_str(), at.x, at.y, "
        "at.z);\n"
        "        }\n"
        "        std::puts(\"\");\n"
        "    }\n"
        "}\n";
    return text;
}

}  // namespace tendril::app
