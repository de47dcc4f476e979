// Asks for the path of a file to open, or of a scene, a picture or a video to write, with a list of folders
// and files and a text field.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/document/workspace.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/picture_options.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

class FileDialog {
  public:
    void frame(const Workspace& workspace, const Labs& labs, glm::vec2 screen, float scale, Emit& emit);

  private:
    struct Entry {
        std::string name;
        bool folder;
    };
    void start(const Workspace& workspace, const Labs& labs);
    void open_folder(const std::filesystem::path& folder);
    bool is_listed(const std::filesystem::path& file) const;
    /// Chooses the kind of files to list.
    void show_filter();
    /// The folders and files; true once a file is double-clicked.
    bool list();
    /// The message for a folder without any file that can be opened.
    std::string empty_message() const;
    void take(Emit& emit);
    void send(const std::filesystem::path& path, Emit& emit);

    bool saving() const { return shown_ != UiState::FileDialog::Open; }
    bool filming() const { return shown_ == UiState::FileDialog::Video; }
    bool picturing() const { return filming() || shown_ == UiState::FileDialog::Picture; }
    const char* action() const { return filming() ? "Record" : saving() ? "Save" : "Open"; }
    const char* title() const {
        return filming()     ? "Record a video"
               : picturing() ? "Save a picture"
               : saving()    ? "Save scene as"
                             : "Open a file";
    }

    std::filesystem::path folder_;
    std::filesystem::path home_;    ///< of the scene, or where the program was started
    std::filesystem::path opened_;  ///< where the last opened file lies: the next is likely there too
    std::vector<Entry> entries_;
    std::vector<FileKind> kinds_;  ///< kinds that can be opened
    std::string by_;               ///< UiState::browses_for
    int filter_ = 0;               ///< 0: all kinds; else the index of one, plus 1
    std::array<char, 1024> name_{};
    std::string error_;
    PictureOptions picture_;
    UiState::FileDialog shown_ = UiState::FileDialog::None;
};

}  // namespace tendril::app
