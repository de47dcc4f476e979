// The view as a video of the last seconds, or as a picture on the clipboard. What is asked for is checked
// here; the frame (app/app_video.cpp) draws it.
#include "app/labs/video_commands.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "app/document/atomic_file.hpp"
#include "app/document/command.hpp"
#include "app/document/units.hpp"
#include "app/io/video_file.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {
namespace {

constexpr double longest = static_cast<double>(Rewind::max_ticks) * tick_seconds;

Argument pixels(const char* name, const char* help) {
    return {.name = name,
            .type = ArgumentType::Integer,
            .required = false,
            .help = help,
            .low = min_picture,
            .high = max_picture};
}

Argument seconds_back(const char* name, const char* help) {
    return {.name = name, .required = false, .help = help, .low = 0.0, .high = longest};
}

std::string seconds_text(int ticks) {
    return fixed_text(ticks * tick_seconds, 2) + " s";
}

/// From the oldest moment that is remembered to the last one, the present among them.
int remembered_ticks(const Workspace& w) {
    const Rewind& past = w.rewind;
    if (past.empty()) return 0;
    const std::uint64_t now = std::max(past.newest(), w.moment);
    return static_cast<int>(std::min(now - past.oldest(), Rewind::max_ticks));
}

void set_range(VideoRequest& wanted, const Workspace& w, const Arguments& given) {
    const int remembered = remembered_ticks(w);
    if (remembered == 0) throw Refused("nothing has moved yet that a video could show");
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

VideoRequest video_request(const Workspace& w, const Arguments& given) {
    VideoRequest wanted{.path = given.text("path")};
    if (const std::string why = why_no_video(wanted.path); !why.empty()) throw Refused(why);
    if (given.has("width")) wanted.size.x = given.integer("width");
    if (given.has("height")) wanted.size.y = given.integer("height");
    if (given.has("every")) wanted.every = given.integer("every");
    if (given.has("speed")) wanted.speed = given.real("speed");
    wanted.transparent = given.has("transparent") && given.boolean("transparent");
    const bool mp4 = wanted.path.extension() == ".mp4";
    if (mp4 && wanted.transparent) throw Refused("transparent: MP4 has no transparency, animated PNG has");
    for (const char* side : {"width", "height"})
        if (mp4 && given.has(side) && given.integer(side) % 2 != 0)
            throw Refused(std::string(side) + " of an MP4 must be even, got " +
                          std::to_string(given.integer(side)));
    constexpr double max_per_second = 60.0;
    if (!mp4 && wanted.speed * max_per_second > max_per_second * wanted.every + 1e-6)
        throw Refused("speed of an animated PNG with every " + std::to_string(wanted.every) +
                      " must be at most " + std::to_string(wanted.every) + ", got " +
                      fixed_text(wanted.speed, 2) +
                      ": programs that show it slow down over 60 frames a second");
    set_range(wanted, w, given);
    check_writable(wanted.path);
    return wanted;
}

void require_view(const Workspace& w, const Labs& labs) {
    if (labs.find(w.lab)->canvas_share(w) > 0.0f)
        throw Refused("this lab's picture is more than a view of a scene");
}

void add_recording(CommandTable& table, const Labs& labs) {
    table.add(
        {.name = "view.video",
         .title = "Write a video of the past",
         .arguments =
             {{.name = "path",
               .type = ArgumentType::Text,
               .help = "a .png file, which is animated, or .mp4 where ffmpeg is installed"},
              pixels("width", "pixels, even for MP4; the view's when left out"),
              pixels("height", "pixels, even for MP4; the view's when left out"),
              seconds_back("from", "seconds back from the last moment; all that is remembered when left out"),
              seconds_back("to", "seconds back from the last moment; 0 when left out"),
              {.name = "every",
               .type = ArgumentType::Integer,
               .required = false,
               .help = "ticks of 1/60 s from frame to frame; 2, which is 30 frames a second, when left out",
               .low = 1,
               .high = 60},
              {.name = "speed",
               .required = false,
               .help = "1 is real time, also when left out; below 1 is slow motion",
               .low = slowest,
               .high = fastest},
              {.name = "transparent",
               .type = ArgumentType::Boolean,
               .required = false,
               .help = "with a transparent background; PNG only"}},
         .help = "Writes a video of the last ten seconds as the view shows them now, without labels and "
                 "panels",
         .effect = Effect::Look,
         .apply = [&labs](Workspace& w, const Arguments& a) {
             if (w.ui.filming)
                 throw Refused(w.ui.filming->name + " is still being written; view.end_video cancels it");
             require_view(w, labs);
             w.ui.video = video_request(w, a);
         }});
    table.add({.name = "view.end_video",
               .title = "Stop recording the video",
               .arguments = {},
               .help = "Cancels the video that is being written; no file is left",
               .effect = Effect::Look,
               .apply = [](Workspace& w, const Arguments&) {
                   if (!w.ui.filming) throw Refused("no video is being written");
                   w.ui.ends_filming = true;
               }});
    table.add({.name = "view.video_dialog",
               .title = "Record a video",
               .arguments = {},
               .help = "Pauses, and shows a dialog to record the last seconds as a video",
               .effect = Effect::Look,
               .apply = [&labs](Workspace& w, const Arguments&) {
                   require_view(w, labs);
                   if (remembered_ticks(w) == 0)
                       throw Refused("nothing has moved yet that a video could show");
                   // Or what one has just seen would slip out of the last ten seconds meanwhile.
                   w.clock.playing = w.clock.replaying = false;
                   w.ui.file_dialog = UiState::FileDialog::Video;
               }});
}

void add_copying(CommandTable& table, const Labs& labs) {
    table.add({.name = "view.copy_picture",
               .title = "Copy the picture",
               .arguments = {pixels("width", "pixels; the view's when left out"),
                             pixels("height", "pixels; the view's when left out"),
                             {.name = "transparent",
                              .type = ArgumentType::Boolean,
                              .required = false,
                              .help = "with a transparent background"}},
               .help = "Puts a picture of the scene in the view on the clipboard; needs xclip or wl-copy",
               .effect = Effect::Look,
               .apply = [&labs](Workspace& w, const Arguments& a) {
                   require_view(w, labs);
                   PictureRequest wanted;
                   if (a.has("width")) wanted.size.x = a.integer("width");
                   if (a.has("height")) wanted.size.y = a.integer("height");
                   wanted.transparent = a.has("transparent") && a.boolean("transparent");
                   w.ui.picture = std::move(wanted);
               }});
}

}  // namespace

void add_video_commands(CommandTable& table, const Labs& labs) {
    add_recording(table, labs);
    add_copying(table, labs);
}

}  // namespace tendril::app
