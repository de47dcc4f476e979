// Writes pictures and videos of the view.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "app/app.hpp"
#include "app/document/refused.hpp"
#include "app/system/atomic_file.hpp"
#include "app/system/environment.hpp"
#include "app/system/file.hpp"
#include "app/video_take.hpp"

namespace tendril::app {

PictureView App::picture_view(glm::ivec2 wanted) const {
    const float ratio =
        static_cast<float>(window_.framebuffer_size().x) / static_cast<float>(std::max(1, window_.size().x));
    const glm::vec2 own =
        glm::clamp(glm::round(layout_.view.size() * ratio), glm::vec2(min_picture), glm::vec2(max_picture));
    const auto side = [&](int i) {  // a missing one keeps the view's proportions
        const float other = static_cast<float>(wanted[1 - i]);
        if (wanted[i] > 0) return static_cast<float>(wanted[i]);
        return other > 0.0f ? std::clamp(std::round(own[i] * other / own[1 - i]),
                                         static_cast<float>(min_picture), static_cast<float>(max_picture))
                            : own[i];
    };
    const glm::vec2 size(side(0), side(1));
    const Camera camera(workspace_.camera, tiled({{0.0f, 0.0f}, size}, panes_.size(), pane_gap).front()),
        seen = panes_.front().camera(workspace_.camera);
    const glm::vec3 target = workspace_.camera.target;
    return {glm::ivec2(size),
            layout_.scale * seen.metres_per_pixel(target) / camera.metres_per_pixel(target)};
}

void App::take_picture(const PictureRequest& wanted) {
    const bool copies = wanted.path.empty();
    const std::string command = copies ? "view.copy_picture" : "view.picture";
    const Theme theme = workspace_.settings.theme;
    if (wanted.paper) workspace_.settings.theme = Theme::Light;
    try {
        const PictureView view = picture_view(wanted.size);
        const auto text = picture_text(workspace_, lab(), view, wanted);
        const Image image = picture_of(workspace_, lab(), renderer_, view, wanted, text.get());
        if (copies)
            copy_png(encode_png(image));
        else  // a script draws it again
            workspace_.writes().write(wanted.path, OutputKind::Picture, encode_png(image),
                                      !workspace_.outputs.in_window);
    } catch (const std::exception& error) {
        workspace_.settings.theme = theme;
        throw Refused(command, error.what());
    }
    workspace_.settings.theme = theme;
    workspace_.close_file_dialog();
    workspace_.toast(copies ? "Copied the picture" : written_text(wanted.path));
}

void App::begin_video(const VideoRequest& wanted) {
    PictureView view = picture_view(wanted.size);
    // MP4 stores colour at half resolution: round the size down to even numbers.
    if (const glm::ivec2 size = view.size; video_kind(wanted.path)->even && size % 2 != glm::ivec2(0))
        view = picture_view(size - size % 2);
    try {
        // In window coordinates, which a recording reproduces, so that frames are drawn at the same ticks.
        const glm::ivec2 counted =
            wanted.size.x > 0 && wanted.size.y > 0 ? wanted.size : glm::ivec2(layout_.view.size());
        video_ =
            std::make_unique<VideoTake>(wanted, workspace_, lab(), renderer_, view, frames_a_tick(counted));
    } catch (const std::exception& error) {
        throw Refused(wanted.command, error.what());
    }
    workspace_.ui.filming = video_->progress();
    workspace_.close_file_dialog();
}

void App::take_pictures() {
    UiState& ui = workspace_.ui;
    if (const auto wanted = std::exchange(ui.picture, std::nullopt)) take_picture(*wanted);
    if (const auto wanted = std::exchange(ui.video, std::nullopt)) begin_video(*wanted);
    if (!std::exchange(ui.ends_filming, false) || !video_) return;
    workspace_.toast("Cancelled: " + ui.filming->name + " was not written");
    drop_video();
}

void App::write_video(bool ends) {
    try {
        video_->work();
        workspace_.ui.filming = video_->progress();
        if (!ends || !video_->has_all_frames()) return;
        video_->finish();
        const auto [path, refusal] =
            workspace_.writes().place_at_end(video_->wanted().path, OutputKind::Video);
        video_->commit(path);
        workspace_.outputs.own(path, file_stamp(path));
        if (!refusal.empty()) throw std::runtime_error(refusal + ". The video is " + shown_path(path));
        workspace_.toast(written_text(path));
        drop_video();
    } catch (const std::exception& error) {
        const std::string command = video_->wanted().command;
        drop_video();
        throw Refused(command, error.what());
    }
}

void App::drop_video() {
    video_.reset();
    workspace_.ui.filming.reset();
}

bool App::video_ended() const {
    return video_ && video_->has_all_frames() && !video_->waits();
}

/// The time when an encoder ends is not deterministic, so in a window, and when replaying a recording made in
/// one, its end is an event. Other scripts wait for the file.
void App::pass_video(bool ended) {
    if (!video_) return;
    const bool by_event = video_->by_another_program() && (workspace_.clock.measured || replays_);
    try {
        write_video(ended || !by_event);
    } catch (const Refused& refusal) {
        refuse(refusal.reason());
    }
}

}  // namespace tendril::app
