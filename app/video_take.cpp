#include "app/video_take.hpp"

#include <algorithm>
#include <cstdint>

#include "app/io/picture.hpp"

namespace tendril::app {

int frames_a_tick(glm::ivec2 size) {
    constexpr std::int64_t pixels_a_tick = 1'000'000, most = 4;
    const std::int64_t pixels = std::max<std::int64_t>(1, static_cast<std::int64_t>(size.x) * size.y);
    return static_cast<int>(std::clamp<std::int64_t>(pixels_a_tick / pixels, 1, most));
}

Image picture_of(const Workspace& workspace, const Lab& lab, Renderer& renderer, const PictureView& view,
                 bool transparent) {
    const std::size_t count = lab.panes(workspace).size();
    const auto draw = [&](const Palette& colours) {
        std::vector<Pane> panes;
        for (const Rect& rect : tiled({{0.0f, 0.0f}, glm::vec2(view.size)}, count, pane_gap)) {
            panes.push_back({rect});
            const Camera camera(view.pose, rect);
            lab.draw({workspace, camera, colours, no_pick, no_pick, view.scale, panes.size() - 1},
                     panes.back().drawn);
        }
        return panes;
    };
    return draw_picture(renderer, draw, view.pose, view.size, palette(workspace.settings.theme), transparent);
}

VideoTake::VideoTake(const VideoRequest& wanted, const Workspace& workspace, const Lab& lab,
                     Renderer& renderer, const PictureView& view, int frames_a_tick)
    : wanted_(wanted),
      workspace_(workspace),
      lab_(lab),
      renderer_(renderer),
      view_(view),
      file_(open_video(wanted.path, {.size = view.size,
                                     .frames = wanted.frames(),
                                     .every = wanted.every,
                                     .speed = wanted.speed,
                                     .transparent = wanted.transparent})),
      frames_a_tick_(frames_a_tick) {
    workspace_.history.clear();  // unused here
    workspace_.ui.incident.reset();
    workspace_.clock.replaying = false;
    workspace_.pass_change();
}

void VideoTake::work() {
    for (int i = frames_a_tick_; i > 0 && written_ < wanted_.frames(); --i) {
        workspace_.go_to_moment(static_cast<std::uint64_t>(wanted_.from - written_ * wanted_.every));
        file_->add(picture_of(workspace_, lab_, renderer_, view_, wanted_.transparent));
        ++written_;
    }
}

VideoProgress VideoTake::progress() const {
    return {wanted_.path.filename().string(), written_, wanted_.frames()};
}

}  // namespace tendril::app
