// All labs, in one explicit table; the commands for the view of any lab; and the lab that opens a file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/labs/lab.hpp"

namespace tendril::app {

class Labs {
  public:
    Labs();
    /// Appends a lab; its name must be new. Throws std::logic_error otherwise.
    void add(std::unique_ptr<Lab> lab);
    const std::vector<std::unique_ptr<Lab>>& all() const { return labs_; }
    /// Null if there is no lab of that name.
    const Lab* find(std::string_view name) const;

  private:
    std::vector<std::unique_ptr<Lab>> labs_;
};

/// A workspace with every lab blank and the first one open, in its first view.
Workspace make_blank_workspace(const Labs& labs);

/// All commands: the workspace's, the camera's and every lab's.
CommandTable make_command_table(const Labs& labs);

// Commands for the view of any lab: the camera, view.close, and pictures and videos of the view.

/// The mouse preset for orbiting and panning the view.
LabSetting mouse_setting();
/// The effect of the wheel, or two fingers on a touchpad, in the view.
LabSetting scroll_setting();

/// `labs` must outlive the table.
void add_camera_commands(CommandTable& table, const Labs& labs);

/// view.close, for Esc: closes overlays or, if there are none, clears the selection. `labs` must outlive the
/// table.
void add_closing_command(CommandTable& table, const Labs& labs);

/// Pictures and videos of the view, and their dialogs. `labs` must outlive the table.
void add_video_commands(CommandTable& table, const Labs& labs);

/// Finds the lab that opens a file. Each lab lists its kinds of file (Lab::files()); file.open finds the lab
/// by the file's ending, or by its text if that does not decide, and opens the file there.
struct FileRoute {
    const Lab* lab = nullptr;  ///< null: a scene, which names the open lab itself
    FileKind kind;
};

/// Scenes first, then the files that each lab reads.
std::vector<FileRoute> file_routes(const Labs& labs);

bool has_ending(const FileKind& kind, const std::filesystem::path& file);
/// "motions (bvh)"
std::string kind_text(const FileKind& kind);

/// The route that opens the file. Throws Refused with a list of the supported kinds if no lab reads it.
FileRoute file_route(const Labs& labs, const std::filesystem::path& file);

/// file.open
void add_file_command(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
