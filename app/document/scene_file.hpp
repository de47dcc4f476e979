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
    std::filesystem::path folder{};  ///< the scene's, searched for files that have moved with it
    bool whole = true;          ///< a wrong value refuses the whole scene instead of starting that lab blank
    bool tells_changes = true;  ///< reports changed files; reads each of them once more
};

/// A message on an opened lab: a file that its part of the scene names is missing, unreadable or changed.
struct LabNote {
    std::string lab;
    std::string text;    ///< "w.bvh has changed since the scene was saved."; or stand_in_note()
    bool whole = false;  ///< the whole part was read
};
/// Why a part stands in for one that could not be read, and what saving does; empty for any other part.
/// "hero.glb is missing, at ... The humanoid lab is blank; saving keeps ..."
std::string stand_in_note(const std::string& lab, const Part& part);

/// Converts a workspace's document, lab, camera and pause to JSON and back. Loading resets time and blanks
/// any lab that the scene does not mention. It throws std::runtime_error with the path and the reason (a
/// newer version, an unknown lab, a value out of range) and then leaves the workspace unchanged.
///
/// Files that a part names (outside_file.hpp) are looked for beside the scene if they are not at their path.
/// If one is missing, unreadable, or changed so that the lab cannot be read with it, the lab starts blank and
/// its JSON is kept (Part::unread). Once the lab is edited, the scene stores both: that JSON in "labs" and
/// the edited lab in "stand_ins", which opens while the JSON still cannot be read. load_scene() returns a
/// note on each such lab, and on each lab whose file has changed.
Json save_scene(const Workspace& workspace);
std::vector<LabNote> load_scene(Workspace& workspace, const Json& scene, const SceneLoading& loading = {});

/// The same through a file; both keep `workspace.path` and `workspace.saved` up to date. Saving never
/// overwrites a file with a scene that would not open again; under a new name it does save it, with a
/// warning. Saving over the scene's own file asks first (Outputs::confirm()) and then
/// keeps only the edited lab.
void save_scene_file(Workspace& workspace, const std::filesystem::path& path);
std::vector<LabNote> load_scene_file(Workspace& workspace, const std::filesystem::path& path);
/// Shows toasts; without a window also prints to stderr.
void tell(Workspace& workspace, const std::vector<LabNote>& notes);

}  // namespace tendril::app
