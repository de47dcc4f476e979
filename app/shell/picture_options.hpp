// The dialog's options for a picture or a video: size, background, labels; and for a video its format,
// moments and speed.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/argument_list.hpp"
#include "app/document/workspace.hpp"
#include "app/io/video_file.hpp"

namespace tendril::app {

class PictureOptions {
  public:
    /// The number of rows that frame() writes.
    float rows() const { return video_ ? 13.0f : 7.0f; }

    /// Call when the dialog opens. Keeps earlier choices, except for seconds and labels. `labels`: whether
    /// the lab wants labels. `loop`: the last ticks that loop, shown at first; 0: all that is remembered.
    void start(const Workspace& workspace, bool labels, bool video, int loop);
    void frame();
    /// The chosen format's ending.
    const char* ending() const { return kind().ending; }
    /// The chosen format wins, even if a file of another kind was clicked in the list.
    std::filesystem::path with_ending(std::filesystem::path path) const;
    const char* command() const {
        return !video_ ? "view.picture" : turns() ? "view.turntable" : "view.video";
    }
    /// The command's arguments, or with an empty path those of view.copy_picture.
    ArgumentList arguments(const std::filesystem::path& path) const;

  private:
    enum Background { OnScreen, White, Transparent };
    const VideoKind& kind() const { return video_kinds[video_ ? static_cast<std::size_t>(format_) : 0]; }
    bool turns() const { return shows_ == 1 || remembered_ == 0.0f; }
    int background() const {
        return background_ == Transparent && !kind().transparent ? OnScreen : background_;
    }
    bool paper() const { return background() == White || (background() == Transparent && paper_); }
    /// Ticks from frame to frame.
    int every() const;
    void take_loop();
    void video_rows();
    void size_rows();
    void look_rows();

    bool video_ = false;
    int format_ = 0, shows_ = 0, smooth_ = 0, background_ = OnScreen, turn_frames_ = 120;
    int loop_ = 0;             ///< ticks that loop; 0: none, or the seconds were edited
    float remembered_ = 0.0f;  ///< seconds
    float from_ = 0.0f, to_ = 0.0f, speed_ = 1.0f;
    glm::ivec2 view_{0}, size_{0};  ///< pixels; 0 in size_: the view's
    bool keeps_proportions_ = true, labels_ = false, paper_ = false, handles_ = false;
    std::array<std::string, video_kinds.size()> why_not_;
};

/// A name for a new picture or video in the folder, without an ending: "arm-1".
std::string picture_name(const Workspace& workspace, const std::filesystem::path& folder);

}  // namespace tendril::app
