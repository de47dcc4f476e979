// Asks for the path of a file to open, or of a scene, a picture or a video to write, with a list of folders
// and files, a text field, and the options of pictures and videos.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "app/document/argument_list.hpp"
#include "app/document/workspace.hpp"
#include "app/io/video_file.hpp"
#include "app/labs/labs.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// The dialog's options for a picture or a video: size, background, labels; and for a video its format,
/// moments and speed.
class PictureOptions {
  public:
    /// The number of rows that frame() writes.
    float rows() const { return video_ ? 13.0f : 7.0f; }

    /// Call when the dialog opens. Keeps earlier choices, except for seconds and labels. `labels`: whether
    /// the lab wants labels. `loop`: the last ticks that make one loop, chosen at first; 0: everything.
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
    std::filesystem::path opened_;  ///< folder of the last opened file, where the next one is likely to be
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
