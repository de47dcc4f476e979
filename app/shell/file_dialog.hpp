// Asks for a scene's path: the folders and scenes there are, and a field to type in.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

class FileDialog {
  public:
    void frame(const Workspace& workspace, glm::vec2 screen, float scale, Emit& emit);

  private:
    struct Entry {
        std::string name;
        bool folder;
    };
    void start(const Workspace& workspace, bool saving);
    void go_to(const std::filesystem::path& folder);
    /// The folders and scenes; true once a scene is chosen for good.
    bool list();
    /// `mine` is the scene's own file, which it may replace unasked.
    void take(bool saving, const std::filesystem::path& mine, Emit& emit);

    std::filesystem::path folder_, confirmed_;
    std::vector<Entry> entries_;
    std::array<char, 1024> name_{};
    std::string complaint_;
    UiState::FileDialog shown_ = UiState::FileDialog::None;
};

}  // namespace tendril::app
