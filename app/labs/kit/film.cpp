#include "app/labs/kit/film.hpp"

#include <iterator>
#include <string>
#include <utility>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/io/text.hpp"
#include "app/io/video_file.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {

std::vector<Argument> film_arguments(std::vector<Argument> more, bool may_name) {
    const std::string help = "a .png file (animated), or .gif or .mp4 if ffmpeg is installed";
    std::vector<Argument> all = picture_arguments({text_argument(
        "path", !may_name, help + (may_name ? "; default, in a window: a new .png beside the scene" : ""))});
    std::move(more.begin(), more.end(), std::back_inserter(all));
    return all;
}

std::string no_transparency(const VideoKind& kind) {
    return std::string(kind.title) + " has no transparency, animated PNG has";
}

VideoRequest film_request(Workspace& workspace, const Arguments& given, const std::string& what) {
    const auto& filming = workspace.ui.filming;
    if (filming) throw Refused(filming->name + " is still being written; view.end_video cancels it");
    VideoRequest wanted;
    wanted.path = given.has("path") ? std::filesystem::path(given.text("path")) : new_file(workspace, what);
    if (const std::string why = why_no_video(wanted.path); !why.empty()) throw Refused(why);
    set_look(given, wanted);
    if (given.has("every")) wanted.every = given.integer("every");
    if (given.has("speed")) wanted.speed = given.real("speed");
    const VideoKind& kind = *video_kind(wanted.path);
    if (wanted.transparent && !kind.transparent) throw Refused("transparent: " + no_transparency(kind));
    for (const char* side : {"width", "height"})
        if (kind.even && given.has(side) && given.integer(side) % 2 != 0)
            throw Refused(std::string(side) + " of an MP4 must be even, got " +
                          std::to_string(given.integer(side)));
    if (const double most = kind.max_rate * wanted.every * tick_seconds; wanted.speed > most + 1e-6)
        throw Refused("speed with every " + std::to_string(wanted.every) + " must be at most " +
                      fixed_text(most, 2) + ", got " + fixed_text(wanted.speed, 2) + ": viewers of " +
                      kind.title + " slow down above " + fixed_text(kind.max_rate, 0) + " frames a second");
    workspace.writes().check({wanted.path}, OutputKind::Video);
    check_writable(wanted.path);
    return wanted;
}

}  // namespace tendril::app
