#include "app/labs/camera_commands.hpp"

#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "app/document/command.hpp"

namespace tendril::app {
namespace {

void set_pose(Workspace& workspace, const Arguments& given) {
    CameraPose& pose = workspace.camera;
    if (given.has("target")) {
        pose.target = glm::clamp(given.point("target"), -camera_range::target, camera_range::target);
    }
    if (given.has("yaw_deg")) pose.yaw = glm::radians(given.number("yaw_deg"));
    if (given.has("pitch_deg")) pose.pitch = glm::radians(given.number("pitch_deg"));
    if (given.has("distance")) pose.distance = given.number("distance");
    if (given.has("field_of_view_deg")) pose.field_of_view = glm::radians(given.number("field_of_view_deg"));
    if (given.has("orthographic")) pose.orthographic = given.boolean("orthographic");
}

Argument angle(const char* name, double low, double high) {
    return {.name = name, .required = false, .help = "degrees", .low = low, .high = high};
}

/// As one looks from one of six sides.
void look_from(Workspace& workspace, const std::string& name) {
    CameraPose& pose = workspace.camera;
    const bool side = name == "side" || name == "left", high = name == "top" || name == "bottom";
    pose = turned_to(pose, side ? FixedView::Side : high ? FixedView::Top : FixedView::Front);
    if (name == "left") pose.yaw = -pose.yaw;
    if (name == "bottom") pose.pitch = -pose.pitch;
    if (name == "back") pose.yaw = glm::pi<float>();
}

}  // namespace

LabSetting mouse_setting() {
    return {.key = "mouse",
            .command = "view.mouse",
            .title = "Choose the mouse preset",
            .argument = "like",
            .help = "Turns and shifts the view with the mouse as this program does",
            .choices = {{"tendril", "Tendril"}, {"blender", "Blender"}, {"maya", "Maya, Unreal"}}};
}

LabSetting scroll_setting() {
    return {.key = "scroll",
            .command = "view.scroll",
            .title = "Choose what scrolling does",
            .argument = "does",
            .help =
                "What the wheel, or two fingers on a touchpad, do in the view: zoom, or shift it. Where they "
                "shift "
                "it, they zoom while Ctrl is held; some systems send a pinch as just that",
            .choices = {{"zoom", "zooms"}, {"pan", "shifts the view"}}};
}

void add_camera_commands(CommandTable& table, const Labs& labs) {
    table.add({.name = "camera.set",
               .title = "Place or turn the camera",
               .arguments = {{.name = "target",
                              .type = ArgumentType::Point,
                              .required = false,
                              .help = "what it turns about"},
                             angle("yaw_deg", -1e6, 1e6),
                             angle("pitch_deg", -90.0, 90.0),
                             {.name = "distance",
                              .required = false,
                              .help = "metres",
                              .low = camera_range::nearest,
                              .high = camera_range::farthest},
                             angle("field_of_view_deg", glm::degrees(camera_range::narrowest),
                                   glm::degrees(camera_range::widest)),
                             {.name = "orthographic",
                              .type = ArgumentType::Boolean,
                              .required = false,
                              .help = "without perspective"}},
               .help = "Places the camera; what is left out stays",
               .effect = Effect::Look,
               .apply = set_pose});
    table.add({.name = "camera.frame",
               .title = "Frame everything or the selection",
               .arguments = {{.name = "what",
                              .type = ArgumentType::Text,
                              .help = "what to bring into view",
                              .choices = {"all", "selection"}}},
               .help = "Brings everything, or the selection, into view",
               .effect = Effect::Look,
               .apply = [&labs](Workspace& w, const Arguments& a) {
                   const Bounds bounds = labs.find(w.lab)->bounds(w, a.text("what") == "selection");
                   w.camera = framed(w.camera, {{0.0f, 0.0f}, w.ui.view_size}, bounds.centre, bounds.radius);
               }});
    table.add({.name = "camera.view",
               .title = "Look from front, side or top",
               .arguments = {{.name = "name",
                              .type = ArgumentType::Text,
                              .help = "where from",
                              .choices = {"front", "side", "top", "back", "left", "bottom"}}},
               .help = "Looks from the front, the side (right), the top, or from opposite one of them",
               .effect = Effect::Look,
               .apply = [](Workspace& w, const Arguments& a) { look_from(w, a.text("name")); }});
    table.add(setting_command(mouse_setting()));
    table.add(setting_command(scroll_setting()));
    table.add(
        {.name = "camera.orthographic",
         .title = "Switch perspective off or on",
         .arguments = {},
         .help = "Turns perspective off, or on again",
         .effect = Effect::Look,
         .apply = [](Workspace& w, const Arguments&) { w.camera.orthographic = !w.camera.orthographic; }});
}

}  // namespace tendril::app
