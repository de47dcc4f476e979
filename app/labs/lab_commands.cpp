
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "app/document/argument.hpp"
#include "app/document/command.hpp"
#include "app/io/text.hpp"
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
            .help = "Sets the mouse actions that turn and shift the view to those of a program",
            .choices = {{"tendril", "Tendril"}, {"blender", "Blender"}, {"maya", "Maya, Unreal"}}};
}

LabSetting scroll_setting() {
    return {.key = "scroll",
            .command = "view.scroll",
            .title = "Choose what scrolling does",
            .argument = "does",
            .help =
                "Whether the wheel, or two fingers on a touchpad, zoom or shift the view. If they shift it, "
                "Ctrl makes them zoom; some systems send a pinch as Ctrl with the wheel",
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
              "Closes the palette, help, settings or dialog; where none is open, selects nothing and hides "
              "the gizmo",
              Effect::Look, [&labs](Workspace& w, const Arguments&) {
                  if (!w.ui.covered()) {
                      const Lab& lab = *labs.find(w.lab);
                      select_nothing(w, lab);
                      if (const auto gizmo = lab.gizmo(w)) w.ui.hidden_gizmo = gizmo->name;
                  }
                  w.ui.help = w.ui.palette = w.ui.settings = false;
                  w.close_file_dialog();
                  w.ui.asks_to_quit = false;
                  w.ui.toasts.clear();
              });
}

// The view as a video of the last seconds, or as a picture on the clipboard. Requests are checked here; the
// frame (app/app_video.cpp) draws them.

namespace {

constexpr int turn_frames = 120, max_turn_frames = 3600;
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
    set_range(wanted, w, given);
    return wanted;
}

/// A full turn of the camera about its target with the simulation paused.
VideoRequest turn_request(Workspace& w, const Arguments& given) {
    VideoRequest wanted = film_request(w, given, "turn");
    wanted.command = "view.turntable";
    wanted.shown_frames = given.has("frames") ? given.integer("frames") : turn_frames;
    wanted.show = [yaw = w.camera.yaw, count = wanted.shown_frames](Workspace& shown, int frame) {
        shown.camera.yaw = yaw + glm::two_pi<float>() * static_cast<float>(frame) / static_cast<float>(count);
        return true;
    };
    return wanted;
}

void require_view(const Workspace& w, const Labs& labs) {
    if (labs.find(w.lab)->canvas_share(w) > 0.0f)
        throw Refused("this lab's picture is more than a view of a scene; use --screenshot");
}

Argument every_argument() {
    return integer_argument(
        "every", "ticks of 1/60 s from frame to frame; default: 2, which is 30 frames a second", 1, 60);
}

/// A command that opens a dialog for a picture or a video. It pauses, so that the moment seen is not lost.
Command dialog(const char* name, const char* title, const char* help, UiState::FileDialog which,
               const Labs& labs) {
    return {.name = name,
            .title = title,
            .arguments = {},
            .help = help,
            .effect = Effect::Look,
            .apply = [&labs, which](Workspace& w, const Arguments&) {
                require_view(w, labs);
                w.ui.plays_after_dialog = w.ui.plays_after_dialog || w.clock.playing;
                w.clock.playing = w.clock.replaying = false;
                w.ui.file_dialog = which;
            }};
}

void add_recording(CommandTable& table, const Labs& labs) {
    table.add(
        "view.video", "Write a video of the past",
        film_arguments(
            {seconds_back("from", "seconds back from the latest moment; default: all that is remembered"),
             seconds_back("to", "seconds back from the latest moment; default: 0"), every_argument(),
             number_argument("speed", "1 is real time, the default; below 1 is slow motion", slowest,
                             fastest)}),
        "Writes a video of the last ten seconds as the view shows them now, without panels; "
        "labels are optional",
        Effect::Look, [&labs](Workspace& w, const Arguments& a) {
            require_view(w, labs);
            w.ui.video = video_request(w, a);
        });
    table.add(
        "view.turntable", "Write a turntable video",
        film_arguments({integer_argument("frames", "of the whole turn; default: 120", 2, max_turn_frames),
                        every_argument()},
                       true),
        "Writes a video of the view as the camera turns once about its target, with the simulation paused",
        Effect::Look, [&labs](Workspace& w, const Arguments& a) {
            require_view(w, labs);
            w.ui.video = turn_request(w, a);
        });
    table.add("view.end_video", "Stop recording the video", {},
              "Cancels the video that is being written; no file is left", Effect::Look,
              [](Workspace& w, const Arguments&) {
                  if (!w.ui.filming) throw Refused("no video is being written");
                  w.ui.ends_filming = true;
              });
    table.add(dialog(
        "view.picture_dialog", "Save a picture",
        "Shows a dialog to save or copy a picture of the view; the simulation pauses until it is closed",
        UiState::FileDialog::Picture, labs));
    table.add(
        dialog("view.video_dialog", "Record a video",
               "Shows a dialog to record the last seconds or a turn of the camera; the simulation pauses "
               "until it is closed",
               UiState::FileDialog::Video, labs));
}

/// A picture to a file or, if `copies`, to the clipboard.
Command picturing(const char* name, const char* title, const char* help, std::vector<Argument> arguments,
                  bool copies, const Labs& labs) {
    return {.name = name,
            .title = title,
            .arguments = picture_arguments(std::move(arguments)),
            .help = help,
            .effect = Effect::Look,
            .apply = [&labs, copies](Workspace& w, const Arguments& a) {
                require_view(w, labs);
                PictureRequest wanted;
                if (!copies)
                    wanted.path = a.has("path") ? std::filesystem::path(a.text("path")) : new_file(w);
                if (!copies && wanted.path.extension() != ".png")
                    throw Refused("path must end in .png, got " + wanted.path.string());
                set_look(a, wanted);
                w.ui.picture = std::move(wanted);
            }};
}

}  // namespace

void add_video_commands(CommandTable& table, const Labs& labs) {
    add_recording(table, labs);
    table.add(picturing(
        "view.picture", "Write a picture of the view",
        "Writes a picture of the scene in the view without panels, with or without its labels",
        {text_argument("path", false, "a PNG file; default, in a window: a new one beside the scene")}, false,
        labs));
    table.add(picturing("view.copy_picture", "Copy the picture",
                        "Puts a picture of the scene in the view on the clipboard; needs xclip or wl-copy",
                        {}, true, labs));
}

}  // namespace tendril::app
