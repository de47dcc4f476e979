// The dialog's options for a video: format, size, seconds, smoothness and speed.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/argument_list.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

class VideoOptions {
  public:
    static constexpr float rows = 9.0f;  ///< rows that frame() writes

    /// Call when the dialog opens. Keeps earlier choices, except for seconds and labels. `labels`: whether
    /// the lab wants labels.
    void start(const Workspace& workspace, bool labels);
    void frame();
    /// Adds the format's extension to a name without one.
    std::filesystem::path with_ending(std::filesystem::path path) const;
    /// The arguments of view.video.
    ArgumentList arguments(const std::filesystem::path& path) const;

  private:
    bool mp4() const { return format_ == 1; }

    int format_ = 0, smooth_ = 0;
    float remembered_ = 0.0f;  ///< seconds
    float from_ = 0.0f, to_ = 0.0f, speed_ = 1.0f;
    glm::ivec2 view_{0}, size_{0};  ///< pixels; 0 in size_: the view's
    bool transparent_ = false, labels_ = false;
    std::string why_no_mp4_;
};

/// A name for a new video in the folder, without an extension: "arm-1".
std::string video_name(const Workspace& workspace, const std::filesystem::path& folder);

}  // namespace tendril::app
