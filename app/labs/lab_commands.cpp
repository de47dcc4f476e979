#include "app/labs/lab_commands.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "app/document/command.hpp"
#include "app/document/picture_arguments.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/film.hpp"
#include "app/labs/labs.hpp"

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
    return number_argument(name, "degrees", low, high);
}

/// Turns the camera to look from one of six sides.
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
            .help = "Turns and shifts the view with the mouse as in the chosen program",
            .choices = {{"tendril", "Tendril"}, {"blender", "Blender"}, {"maya", "Maya, Unreal"}}};
}

LabSetting scroll_setting() {
    return {.key = "scroll",
            .command = "view.scroll",
            .title = "Choose what scrolling does",
            .argument = "does",
            .help =
                "What the wheel, or two fingers on a touchpad, do in the view: zoom, or shift it. If they "
                "shift "
                "it, Ctrl makes them zoom; some systems send a pinch as Ctrl with the wheel",
            .choices = {{"zoom", "zooms"}, {"pan", "shifts the view"}}};
}

void add_camera_commands(CommandTable& table, const Labs& labs) {
    table.add("camera.set", "Place or turn the camera",
              {point_argument("target", false, "the point it turns about"), angle("yaw_deg", -1e6, 1e6),
               angle("pitch_deg", -90.0, 90.0),
               number_argument("distance", "metres", camera_range::nearest, camera_range::farthest),
               angle("field_of_view_deg", glm::degrees(camera_range::narrowest),
                     glm::degrees(camera_range::widest)),
               switch_argument("orthographic", "without perspective")},
              "Places the camera; omitted values stay", Effect::Look, set_pose);
    table.add("camera.frame", "Frame everything or the selection",
              {choice_argument("what", true, "what to bring into view", {"all", "selection"})},
              "Brings everything, or the selection, into view", Effect::Look,
              [&labs](Workspace& w, const Arguments& a) {
                  const Bounds bounds = labs.find(w.lab)->bounds(w, a.text("what") == "selection");
                  w.camera = framed(w.camera, {{0.0f, 0.0f}, w.ui.view_size}, bounds.centre, bounds.radius);
              });
    table.add(
        "camera.view", "Look from front, side or top",
        {choice_argument("name", true, "where from", {"front", "side", "top", "back", "left", "bottom"})},
        "Looks from the front, the side (right), the top, or the opposite of one of them", Effect::Look,
        [](Workspace& w, const Arguments& a) { look_from(w, a.text("name")); });
    table.add(setting_command(mouse_setting()));
    table.add(setting_command(scroll_setting()));
    table.add("camera.orthographic", "Switch perspective off or on", {}, "Turns perspective off, or on again",
              Effect::Look,
              [](Workspace& w, const Arguments&) { w.camera.orthographic = !w.camera.orthographic; });
}

namespace {

/// Clears the selection by the lab's own commands. They have Effect::Look, so none adds an undo entry.
void select_nothing(Workspace& workspace, const Lab& lab) {
    Emit emit;
    lab.deselect(workspace, emit);
    CommandTable own;
    lab.add_commands(own);
    for (const Emitted& each : emit.take()) own.find(each.name)->apply(workspace, Arguments(*each.arguments));
}

}  // namespace

void add_closing_command(CommandTable& table, const Labs& labs) {
    table.add("view.close", "Close, cancel or select nothing", {},
              "Closes the palette, help, settings or dialog; where none is open, selects nothing",
              Effect::Look, [&labs](Workspace& w, const Arguments&) {
                  if (!w.ui.covered()) select_nothing(w, *labs.find(w.lab));
                  w.ui.help = w.ui.palette = w.ui.settings = false;
                  w.close_file_dialog();
                  w.ui.asks_to_quit = false;
                  w.ui.toasts.clear();
              });
}

// The view as a video of the last seconds, or as a picture on the clipboard. Requests are checked here; the
// frame (app/app_video.cpp) draws them.

namespace {

constexpr double longest = static_cast<double>(Rewind::max_ticks) * tick_seconds;

Argument seconds_back(const char* name, const char* help) {
    return number_argument(name, help, 0.0, longest);
}

std::string seconds_text(int ticks) {
    return fixed_text(ticks * tick_seconds, 2) + " s";
}

/// Ticks from the oldest remembered moment to the newest, including the present.
int remembered_ticks(const Workspace& w) {
    const Rewind& past = w.rewind;
    if (past.empty()) return 0;
    const std::uint64_t now = std::max(past.newest(), w.moment);
    return static_cast<int>(std::min(now - past.oldest(), Rewind::max_ticks));
}

void set_range(VideoRequest& wanted, const Workspace& w, const Arguments& given) {
    const int remembered = remembered_ticks(w);
    if (remembered == 0) throw Refused("nothing has moved yet, so there is nothing to record");
    const auto ticks = [&](const char* name, int otherwise) {
        return given.has(name) ? static_cast<int>(std::lround(given.real(name) / tick_seconds)) : otherwise;
    };
    wanted.from = ticks("from", remembered);
    wanted.to = ticks("to", 0);
    if (wanted.from > remembered)
        throw Refused("from must be at most " + seconds_text(remembered) + ", which is all that is " +
                      "remembered, got " + seconds_text(wanted.from));
    if (wanted.from <= wanted.to)
        throw Refused("from must be further back than to, which is " + seconds_text(wanted.to) + ", got " +
                      seconds_text(wanted.from));
}

VideoRequest video_request(Workspace& w, const Arguments& given) {
    VideoRequest wanted = film_request(w, given);
    if (given.has("every")) wanted.every = given.integer("every");
    if (given.has("speed")) wanted.speed = given.real("speed");
    const bool mp4 = wanted.path.extension() == ".mp4";
    constexpr double max_per_second = 60.0;
    if (!mp4 && wanted.speed * max_per_second > max_per_second * wanted.every + 1e-6)
        throw Refused("speed of an animated PNG with every " + std::to_string(wanted.every) +
                      " must be at most " + std::to_string(wanted.every) + ", got " +
                      fixed_text(wanted.speed, 2) + ": viewers slow down above 60 frames a second");
    set_range(wanted, w, given);
    return wanted;
}

void require_view(const Workspace& w, const Labs& labs) {
    if (labs.find(w.lab)->canvas_share(w) > 0.0f)
        throw Refused("this lab's picture is more than a view of a scene");
}

void add_recording(CommandTable& table, const Labs& labs) {
    table.add(
        "view.video", "Write a video of the past",
        film_arguments(
            {seconds_back("from", "seconds back from the latest moment; default: all that is remembered"),
             seconds_back("to", "seconds back from the latest moment; default: 0"),
             integer_argument("every",
                              "ticks of 1/60 s from frame to frame; default: 2, which is 30 frames a second",
                              1, 60),
             number_argument("speed", "1 is real time, the default; below 1 is slow motion", slowest,
                             fastest)}),
        "Writes a video of the last ten seconds as the view shows them now, without panels; "
        "labels are optional",
        Effect::Look, [&labs](Workspace& w, const Arguments& a) {
            require_view(w, labs);
            w.ui.video = video_request(w, a);
        });
    table.add("view.end_video", "Stop recording the video", {},
              "Cancels the video that is being written; no file is left", Effect::Look,
              [](Workspace& w, const Arguments&) {
                  if (!w.ui.filming) throw Refused("no video is being written");
                  w.ui.ends_filming = true;
              });
    table.add(
        {.name = "view.video_dialog",
         .title = "Record a video",
         .arguments = {},
         .help =
             "Shows a dialog to record the last seconds as a video; the simulation pauses until it is closed",
         .effect = Effect::Look,
         .apply = [&labs](Workspace& w, const Arguments&) {
             require_view(w, labs);
             if (remembered_ticks(w) == 0)
                 throw Refused("nothing has moved yet, so there is nothing to record");
             // Pause, so that the moments just seen do not drop out of the last ten seconds.
             w.ui.plays_after_dialog = w.ui.plays_after_dialog || w.clock.playing;
             w.clock.playing = w.clock.replaying = false;
             w.ui.file_dialog = UiState::FileDialog::Video;
         }});
}

void add_copying(CommandTable& table, const Labs& labs) {
    table.add("view.copy_picture", "Copy the picture", picture_arguments(),
              "Puts a picture of the scene in the view on the clipboard; needs xclip or wl-copy",
              Effect::Look, [&labs](Workspace& w, const Arguments& a) {
                  require_view(w, labs);
                  PictureRequest wanted;
                  set_look(a, wanted);
                  w.ui.picture = std::move(wanted);
              });
}

}  // namespace

void add_video_commands(CommandTable& table, const Labs& labs) {
    add_recording(table, labs);
    add_copying(table, labs);
}

}  // namespace tendril::app
