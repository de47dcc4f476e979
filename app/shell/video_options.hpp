// What the dialog asks about a video beside its name: format, size, which seconds, how smooth and how fast.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

#include "app/document/argument_list.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

class VideoOptions {
  public:
    static constexpr float rows = 8.0f;  ///< that frame() writes

    /// When the dialog opens. What was chosen before stays, but for the seconds.
    void start(const Workspace& workspace);
    void frame();
    /// A name without an ending gets that of the format.
    std::filesystem::path with_ending(std::filesystem::path path) const;
    /// Of view.video.
    ArgumentList arguments(const std::filesystem::path& path) const;

  private:
    bool mp4() const { return format_ == 1; }

    int format_ = 0, smooth_ = 0;
    float remembered_ = 0.0f;  ///< seconds
    float from_ = 0.0f, to_ = 0.0f, speed_ = 1.0f;
    glm::ivec2 view_{0}, size_{0};  ///< pixels; of size_ 0 where it is the view's
    bool transparent_ = false;
    std::string why_no_mp4_;
};

/// A name for a new video beside the scene, without an ending: "arm-1".
std::string video_name(const Workspace& workspace, const std::filesystem::path& folder);

}  // namespace tendril::app
