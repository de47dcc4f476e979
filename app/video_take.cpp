#include "app/video_take.hpp"

#include <algorithm>
#include <cstdint>

#include "app/view/picture.hpp"

namespace tendril::app {

int frames_a_tick(glm::ivec2 size) {
    constexpr std::int64_t pixels_a_tick = 1'000'000, most = 4;
    const std::int64_t pixels = std::max<std::int64_t>(1, static_cast<std::int64_t>(size.x) * size.y);
    return static_cast<int>(std::clamp<std::int64_t>(pixels_a_tick / pixels, 1, most));
}

std::unique_ptr<PictureText> picture_text(const Workspace& workspace, const Lab& lab, const PictureView& view,
                                          const PictureLook& look) {
    if (!look.labels.value_or(lab.labels_pictures(workspace))) return nullptr;
    return std::make_unique<PictureText>(view.size);
}

namespace {

std::vector<Pane> drawn_panes(const Workspace& workspace, const Lab& lab, const PictureView& view,
                              bool handles, const Palette& colours) {
    std::vector<Pane> panes;
    const std::size_t count = lab.panes(workspace).size();
    for (const Rect& rect : tiled({{0.0f, 0.0f}, glm::vec2(view.size)}, count, pane_gap)) {
        panes.push_back({rect});
        const Camera camera(workspace.camera, rect);
        lab.draw({workspace, camera, colours, no_pick, no_pick, view.scale, panes.size() - 1, handles},
                 panes.back().drawn);
    }
    return panes;
}

std::vector<LegendRow> drawn_legend(const Workspace& workspace, const Lab& lab, bool handles) {
    std::vector<LegendRow> rows = lab.legend(workspace);
    std::erase_if(rows, [&](const LegendRow& row) { return row.handle && !handles; });
    return rows;
}

}  // namespace

Image picture_of(const Workspace& workspace, const Lab& lab, Renderer& renderer, const PictureView& view,
                 const PictureLook& look, PictureText* text) {
    const auto draw = [&](const Palette& colours) {
        return drawn_panes(workspace, lab, view, look.handles, colours);
    };
    DrawOver over;
    if (text != nullptr)
        over = [&](const std::vector<Pane>& panes, const Palette& colours) {
            text->draw(panes, workspace.camera, lab.panes(workspace),
                       drawn_legend(workspace, lab, look.handles), colours,
                       lab.picture_plot(workspace, colours));
        };
    const Background background = look.transparent ? Background::Transparent
                                  : look.paper     ? Background::White
                                                   : Background::Scene;
    return draw_picture(renderer, draw, workspace.camera, view.size, palette(workspace.settings.theme),
                        background, over);
}

VideoTake::VideoTake(const VideoRequest& wanted, const Workspace& workspace, const Lab& lab,
                     Renderer& renderer, const PictureView& view, int frames_a_tick)
    : wanted_(wanted),
      workspace_(workspace),
      lab_(lab),
      renderer_(renderer),
      view_(view),
      text_(picture_text(workspace, lab, view, wanted)),
      file_(open_video(wanted.path, {.size = view.size,
                                     .frames = wanted.frames(),
                                     .every = wanted.every,
                                     .speed = wanted.speed,
                                     .transparent = wanted.transparent})),
      frames_a_tick_(frames_a_tick) {
    workspace_.history.clear();  // unused here
    if (wanted.paper) workspace_.settings.theme = Theme::Light;
    workspace_.ui.incident.reset();
    workspace_.clock.replaying = false;
    workspace_.pass_change();
    if (text_) find_room();
}

/// Shows a frame; false if it is the one before.
static bool show(const VideoRequest& wanted, Workspace& workspace, int frame) {
    if (wanted.show) return wanted.show(workspace, frame);
    workspace.go_to_moment(static_cast<std::uint64_t>(wanted.from - frame * wanted.every));
    return true;
}

/// Finds a corner for the legend that nothing moves into later.
void VideoTake::find_room() {
    constexpr int max_looks = 16;
    Workspace ahead = workspace_;
    const VideoRequest again = wanted_;  // with a state of its own
    const int frames = wanted_.frames(), looks = std::min(frames, max_looks);
    const Palette& colours = palette(workspace_.settings.theme);
    for (int i = 0; i < looks; ++i) {
        const int frame = looks > 1 ? i * (frames - 1) / (looks - 1) : 0;
        show(again, ahead, frame);
        text_->look_at(drawn_panes(ahead, lab_, view_, wanted_.handles, colours), ahead.camera,
                       drawn_legend(ahead, lab_, wanted_.handles));
    }
}

void VideoTake::work() {
    for (int i = frames_a_tick_; i > 0 && written_ < wanted_.frames(); --i) {
        if (show(wanted_, workspace_, written_) || written_ == 0)
            frame_ = picture_of(workspace_, lab_, renderer_, view_, wanted_, text_.get());
        file_->add(frame_);
        ++written_;
    }
}

VideoProgress VideoTake::progress() const {
    return {wanted_.path.filename().string(), written_, wanted_.frames()};
}

}  // namespace tendril::app
