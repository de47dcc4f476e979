// A video of the last seconds while it is being written. It has a copy of all that it shows: what goes on in
// the window meanwhile is another matter.
#pragma once

#include <memory>

#include "app/document/video_request.hpp"
#include "app/document/workspace.hpp"
#include "app/io/video_file.hpp"
#include "app/labs/lab.hpp"
#include "app/view/renderer.hpp"

namespace tendril::app {

/// How a picture shows the view. Lines are as thick against what they show as they are in the window.
struct PictureView {
    CameraPose pose;
    glm::ivec2 size{0};  ///< pixels
    float scale = 1.0f;
};

/// What the view shows, without what the mouse is over, labels and panels. Throws std::runtime_error.
Image picture_of(const Workspace& workspace, const Lab& lab, Renderer& renderer, const PictureView& view,
                 bool transparent);

/// How many frames of that size, in pixels, a tick has time for. A count and not a time, so that a recording
/// of what a person did comes out the same.
int frames_a_tick(glm::ivec2 size);

/// What throws does so with std::runtime_error. Unless it is done when it is destroyed, no file is left.
class VideoTake {
  public:
    /// `lab` and `renderer` must outlive it. The workspace must remember something.
    VideoTake(const VideoRequest& wanted, const Workspace& workspace, const Lab& lab, Renderer& renderer,
              const PictureView& view, int frames_a_tick);
    /// Writes the next frames, as many as a tick has time for.
    void work();
    bool has_all_frames() const { return written_ == wanted_.frames(); }
    bool by_another_program() const { return file_->by_another_program(); }
    /// After the last frame: whether that program still writes what it was given.
    bool waits() const { return file_->waits(); }
    /// After the last frame. Waits for that program.
    void finish() { file_->finish(); }
    VideoProgress progress() const;
    const VideoRequest& wanted() const { return wanted_; }

  private:
    VideoRequest wanted_;
    Workspace workspace_;
    const Lab& lab_;
    Renderer& renderer_;
    PictureView view_;
    std::unique_ptr<VideoFile> file_;
    int frames_a_tick_ = 1;
    int written_ = 0;
};

}  // namespace tendril::app
