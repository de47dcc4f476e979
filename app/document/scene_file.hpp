// Scenes on disk: versioned JSON holding every lab's part, which lab was open, and the camera.
//
//   {"tendril_scene": 2, "lab": "chain", "camera": {...}, "paused": false, "labs": {"chain": {...}}}
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
    bool whole = true;               ///< a lab that cannot be read refuses the scene, unless it names files
};

/// Converts a workspace's document, lab, camera and pause to JSON and back. Loading resets time and makes
/// blank any lab that the scene does not mention. It throws std::runtime_error with the path and the reason
/// (a newer version, an unknown lab, a value out of range) and then leaves the workspace unchanged.
///
/// A part names each file that it reads in an object with "file", as it was given, and "path", which is
/// absolute. One that is not at its path is looked for beside the scene. Where it is missing, or the lab
/// cannot be read with what it now holds, the lab starts blank and its JSON is kept (Part::unread): the
/// messages that load_scene() returns say so, one for each such lab.
Json save_scene(const Workspace& workspace);
std::vector<std::string> load_scene(Workspace& workspace, const Json& scene,
                                    const SceneLoading& loading = {});

/// The same through a file; both keep `workspace.path` and `workspace.saved` up to date. Saving never
/// overwrites a file with a scene that would not open again; under a new name it does save it, with a
/// warning. Toasts say which labs of a scene start blank.
void save_scene_file(Workspace& workspace, const std::filesystem::path& path);
void load_scene_file(Workspace& workspace, const std::filesystem::path& path);

}  // namespace tendril::app
