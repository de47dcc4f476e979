// Scenes on disk: versioned JSON holding every lab's part, which lab was open, and the camera.
//
//   {"tendril_scene": 2, "lab": "chain", "camera": {...}, "paused": false, "speed": 1,
//    "labs": {"chain": {...}}}
//
// Version 2 writes every rotation as [x, y, z, w]; version 1 wrote the chain's as [w, x, y, z]. Part::upgrade
// converts older versions.
#pragma once

#include <filesystem>

#include "app/document/workspace.hpp"

namespace tendril::app {

inline constexpr int scene_version = 2;

Json save_camera(const CameraPose& pose);
CameraPose load_camera(const Json& json, const std::string& where);

struct SceneLoading {
    std::filesystem::path folder{};  ///< the scene's: files that have moved with it are found there
    bool whole = true;  ///< a wrong value refuses the whole scene instead of starting that lab blank
};

/// What a person should know of a lab that was opened, because of a file that its part of the scene names.
struct LabNote {
    std::string lab;
    std::string text;    ///< "w.bvh has changed since the scene was saved."; or stand_in_note()
    bool whole = false;  ///< the lab has all that the scene has of it
};
/// While a part stands in for what could not be read: why, and what saving does; else empty. "hero.glb is
/// missing, at ... The humanoid lab is blank; saving keeps ..."
std::string stand_in_note(const std::string& lab, const Part& part);

/// Converts a workspace's document, lab, camera and pause to JSON and back. Loading resets time and makes
/// blank any lab that the scene does not mention. It throws std::runtime_error with the path and the reason
/// (a newer version, an unknown lab, a value out of range) and then leaves the workspace unchanged.
///
/// Files that a part names (outside_file.hpp) are looked for beside the scene, if they are not at their path.
/// Where one is missing or unreadable, or has changed so that the lab cannot be read with it, the lab starts
/// blank and its JSON is kept (Part::unread). Once it is edited the scene has both: "labs" what could not be
/// read, and "stand_ins" the lab as it is now, which opens as long as the other does not. load_scene()
/// returns a note on each such lab, and on one whose file has changed.
Json save_scene(const Workspace& workspace);
std::vector<LabNote> load_scene(Workspace& workspace, const Json& scene, const SceneLoading& loading = {});

/// The same through a file; both keep `workspace.path` and `workspace.saved` up to date. Saving never
/// overwrites a file with a scene that would not open again; under a new name it does save it, with a
/// warning. Saved over its own file, a scene has only what an edited lab is now: it asks first
/// (Outputs::confirm()).
void save_scene_file(Workspace& workspace, const std::filesystem::path& path);
std::vector<LabNote> load_scene_file(Workspace& workspace, const std::filesystem::path& path);
/// Toasts, and lines on stderr where there is no window.
void tell(Workspace& workspace, const std::vector<LabNote>& notes);

}  // namespace tendril::app
