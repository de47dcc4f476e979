// A video while it is being written. It copies everything it shows, so work in the window can continue.
#pragma once

#include <memory>

#include "app/document/workspace.hpp"
#include "app/io/image.hpp"
#include "app/io/video_file.hpp"
#include "app/labs/lab.hpp"
#include "app/shell/picture_text.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// The size and scale of a picture. The scale keeps lines as thick relative to the scene as in the window.
struct PictureView {
    glm::ivec2 size{0};  ///< pixels
    float scale = 1.0f;
};

/// The text of such a picture, or null if `look` and the lab want none.
std::unique_ptr<PictureText> picture_text(const Workspace& workspace, const Lab& lab, const PictureView& view,
                                          const PictureLook& look);

/// Draws the view without hover highlights and panels, in the colours of the workspace's theme, and with
/// labels if `text` is not null. Throws std::runtime_error.
Image picture_of(const Workspace& workspace, const Lab& lab, Renderer& renderer, const PictureView& view,
                 const PictureLook& look, PictureText* text);

/// The number of frames of that size, in pixels, drawn per tick. A count instead of a measured time, so that
/// recordings replay identically.
int frames_a_tick(glm::ivec2 size);

/// Errors are std::runtime_error. Leaves no file if destroyed before commit().
class VideoTake {
  public:
    /// `lab` and `renderer` must outlive it. The workspace's rewind must not be empty, unless the request
    /// shows frames of its own.
    VideoTake(const VideoRequest& wanted, const Workspace& workspace, const Lab& lab, Renderer& renderer,
              const PictureView& view, int frames_a_tick);
    /// Writes one tick's frames.
    void work();
    bool has_all_frames() const { return written_ == wanted_.frames(); }
    bool by_another_program() const { return file_->by_another_program(); }
    /// After the last frame: whether the other program is still writing.
    bool waits() const { return file_->waits(); }
    /// Call after the last frame. Waits for the other program.
    void finish() { file_->finish(); }
    /// VideoFile::commit().
    void commit(const std::filesystem::path& other = {}) { file_->commit(other); }
    VideoProgress progress() const;
    const VideoRequest& wanted() const { return wanted_; }

  private:
    void find_room();

    VideoRequest wanted_;
    Workspace workspace_;
    const Lab& lab_;
    Renderer& renderer_;
    PictureView view_;
    std::unique_ptr<PictureText> text_;
    std::unique_ptr<VideoFile> file_;
    Image frame_;  ///< the last one written
    int frames_a_tick_ = 1;
    int written_ = 0;
};

}  // namespace tendril::app
