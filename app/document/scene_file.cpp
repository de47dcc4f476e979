#include "app/document/scene_file.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/document/outside_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace fs = std::filesystem;
namespace {

const Json* optional_member(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

/// The scene's version. Throws if this program cannot read it.
int read_version(const Json& scene) {
    if (!scene.is_object() || !scene.contains("tendril_scene"))
        throw std::runtime_error("not a Tendril scene");
    const Json& version = scene["tendril_scene"];
    if (version.is_number() && version.get<double>() > scene_version)
        throw std::runtime_error("tendril_scene: version " + version.dump() +
                                 " is newer than this program, which reads " + std::to_string(scene_version));
    return json_integer(version, "tendril_scene", 1, scene_version);
}

/// Calls `call`, and converts any exception to std::runtime_error.
template <class Call>
auto converted(const std::string& where, const Call& call) {
    try {
        return call();
    } catch (const std::runtime_error&) {
        throw;
    } catch (const std::exception& error) {
        throw std::runtime_error(where + ": " + reason_of(error));
    }
}

/// Reads the lab's part from the JSON at `where`. If that fails, returns `stand_in` (the lab as edited since)
/// or a blank part, which keeps the JSON and the reason (`unread_why`).
std::shared_ptr<const Part> load_part(const Part& blank, const Json& json, const Json* stand_in,
                                      const std::string& where, int version, const SceneLoading& loading,
                                      std::vector<LabNote>& notes) {
    const std::string lab = where.substr(where.find('.') + 1);
    auto saved = std::make_shared<Json>(json);
    if (version != scene_version) converted(where, [&] { blank.upgrade(*saved, version); });
    Json found = *saved;
    find_moved_files(found, loading.folder);
    std::string changed = loading.tells_changes ? changed_files_text(found) : "", why;
    try {
        std::shared_ptr<const Part> part = converted(where, [&] { return blank.load(found, where); });
        if (!changed.empty()) notes.push_back({lab, changed + '.', true});
        if (stand_in != nullptr)
            notes.push_back({lab,
                             "The " + lab +
                                 " lab is loaded from its last save with all files. Changes made while files "
                                 "were missing are left out.",
                             true});
        return part;
    } catch (const OutsideFileError& error) {
        why = error.what();
    } catch (const std::runtime_error& error) {
        if (!loading.tells_changes) changed = changed_files_text(found);
        if (loading.whole && changed.empty()) throw;
        why = changed.empty() ? error.what() : changed + " (" + error.what() + ')';
    }
    std::shared_ptr<const Part> instead;
    if (stand_in != nullptr)
        instead = load_part(blank, *stand_in, nullptr, "stand_ins." + lab, version, loading, notes);
    const std::shared_ptr<Part> part = (instead ? *instead : blank).clone();
    part->unread_stand_in = part->unread;
    part->unread = std::move(saved);
    part->unread_why = why;
    part->replaces_unread = stand_in != nullptr;
    notes.push_back({lab, stand_in_note(lab, *part)});
    return part;
}

Document load_document(const Document& blank, const Json& labs, const Json* stand_ins, int version,
                       const SceneLoading& loading, std::vector<LabNote>& notes) {
    Document document = blank;
    for (const auto& [name, json] : labs.items()) {
        const auto known = blank.parts().find(name);
        if (known == blank.parts().end())
            throw std::runtime_error("labs: there is no lab " + json_summary(Json(name)));
        const Json* stand_in = stand_ins != nullptr ? optional_member(*stand_ins, name.c_str()) : nullptr;
        document.set(name,
                     load_part(*known->second, json, stand_in, "labs." + name, version, loading, notes));
    }
    return document;
}

/// `document`, but sharing the workspace's parts where both would be saved identically: reading the same part
/// again is no change and creates no undo entry. A recording's first line depends on it.
Document sharing_equal_parts(const Document& document, const Document& present) {
    Document result = document;
    for (const auto& [lab, part] : document.parts()) {
        const auto now = present.parts().find(lab);
        if (now != present.parts().end() && now->second != part && !now->second->unread && !part->unread &&
            now->second->save() == part->save())
            result.set(lab, now->second);
    }
    return result;
}

/// "line 12: " if the message begins with a path that the text contains; else empty.
std::string line_prefix(std::string_view text, std::string_view message) {
    const int line = json_line(text, message.substr(0, message.find_first_of(": ")));
    return line > 0 ? "line " + std::to_string(line) + ": " : std::string();
}

}  // namespace

Json save_camera(const CameraPose& pose) {
    return Json{{"target", point(pose.target)},
                {"yaw_deg", degrees(pose.yaw)},
                {"pitch_deg", degrees(pose.pitch)},
                {"distance", number(pose.distance)},
                {"field_of_view_deg", degrees(pose.field_of_view)},
                {"orthographic", pose.orthographic}};
}

CameraPose load_camera(const Json& json, const std::string& where) {
    if (!json.is_object())
        throw std::runtime_error(where + ": expected an object, found " + json_summary(json));
    CameraPose pose;
    const auto place = [&](const char* key) { return where.empty() ? key : where + "." + key; };
    const auto angle = [&](const char* key, float& value, float low, float high) {
        const Json* found = optional_member(json, key);
        if (!found) return;
        value = json_degrees(*found, place(key));
        if (!(value >= low && value <= high))
            throw std::runtime_error(place(key) + ": expected " + degrees(low).dump() + " to " +
                                     degrees(high).dump() + " degrees, found " + json_summary(*found));
    };
    if (const Json* found = optional_member(json, "target"))
        pose.target =
            glm::clamp(json_point(*found, place("target")), -camera_range::target, camera_range::target);
    angle("yaw_deg", pose.yaw, -1e9f, 1e9f);
    angle("pitch_deg", pose.pitch, -camera_range::pitch, camera_range::pitch);
    if (const Json* found = optional_member(json, "distance"))
        pose.distance = json_number(*found, place("distance"), static_cast<float>(camera_range::nearest),
                                    static_cast<float>(camera_range::farthest));
    angle("field_of_view_deg", pose.field_of_view, camera_range::narrowest, camera_range::widest);
    if (const Json* found = optional_member(json, "orthographic"))
        pose.orthographic = json_bool(*found, place("orthographic"));
    return pose;
}

std::string stand_in_note(const std::string& lab, const Part& part) {
    if (!part.unread) return {};
    return part.unread_why + ". " +
           (part.replaces_unread && !part.unread_stand_in
                ? "Saving replaces the scene's old contents of the " + lab + " lab; undo restores them."
                : "The " + lab +
                      " lab is blank; saving keeps its old contents until you change it. Put the file back "
                      "and open the scene again.");
}

namespace {

Json save_scene(const Workspace& workspace, const Document& document) {
    Json labs = Json::object(), stand_ins = Json::object();
    for (const auto& [name, part] : document.parts()) {
        if (name != workspace.lab && workspace.openings.contains(name)) continue;
        labs[name] = part->unread ? *part->unread : part->save();
        if (part->replaces_unread)
            stand_ins[name] = part->unread_stand_in ? *part->unread_stand_in : part->save();
    }
    Json scene{{"tendril_scene", scene_version},
               {"lab", workspace.lab},
               {"camera", save_camera(workspace.camera)},
               {"paused", !workspace.clock.playing && !workspace.ui.plays_after_dialog},
               {"speed", workspace.clock.speed},
               {"labs", std::move(labs)}};
    if (!stand_ins.empty()) scene["stand_ins"] = std::move(stand_ins);
    return scene;
}

}  // namespace

Json save_scene(const Workspace& workspace) {
    return save_scene(workspace, workspace.document);
}

namespace {

/// The document to save to that file. Over the scene's own file it drops, after asking, the old contents of
/// labs that could not be read and were edited since; any other file gets both.
Document as_saved(Workspace& workspace, const fs::path& path) {
    Document saved = workspace.document;
    std::string lost;
    std::error_code none;
    if (fs::equivalent(path, workspace.path, none))
        for (const auto& [lab, part] : workspace.document.parts()) {
            if (!part->replaces_unread || part->unread_stand_in) continue;
            lost += (lost.empty() ? "" : "; ") + ("the " + lab + " lab, which could not be read: ") +
                    part->unread_why;
            const std::shared_ptr<Part> own = part->clone();
            own->unread = nullptr;
            own->replaces_unread = false;
            saved.set(lab, own);
        }
    workspace.outputs.confirm(lost.empty() ? ""
                                           : shown_path(path) + " still has the old contents of " + lost);
    return saved;
}

struct Scene {
    Document document;
    std::string lab;
    CameraPose camera;
    std::vector<LabNote> notes;
    std::optional<bool> paused;  ///< older scenes do not store it
    std::optional<float> speed;
};

/// Throws as load_scene() does.
Scene read_scene(const Workspace& workspace, const Json& json, const SceneLoading& loading) {
    const int version = read_version(json);
    const std::string whole;
    const Json& labs = json_member(json, "labs", whole);
    if (!labs.is_object()) throw std::runtime_error("labs: expected an object, found " + json_summary(labs));
    const Json* stand_ins = optional_member(json, "stand_ins");
    if (stand_ins != nullptr && !stand_ins->is_object())
        throw std::runtime_error("stand_ins: expected an object, found " + json_summary(*stand_ins));
    Scene scene{{}, workspace.lab, {}, {}, {}, {}};
    scene.document = load_document(workspace.blank, labs, stand_ins, version, loading, scene.notes);
    if (const Json* found = optional_member(json, "paused")) scene.paused = json_bool(*found, "paused");
    if (const Json* found = optional_member(json, "speed"))
        scene.speed = json_number(*found, "speed", static_cast<float>(slowest), static_cast<float>(fastest));
    if (const Json* found = optional_member(json, "lab")) {
        scene.lab = json_text(*found, "lab");
        if (!scene.document.parts().contains(scene.lab))
            throw std::runtime_error("lab: there is no lab " + json_summary(*found));
    }
    const Json* camera = optional_member(json, "camera");
    scene.camera = camera ? load_camera(*camera, "camera") : workspace.first_view_of(scene.lab);
    return scene;
}

/// Why a saved scene would not open; empty if it would. Missing files that it names do not count.
std::string loading_fault(const Workspace& workspace, const std::string& text) {
    try {
        read_scene(workspace, parse_json(text), {.tells_changes = false});
        return {};
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace

std::vector<LabNote> load_scene(Workspace& workspace, const Json& json, const SceneLoading& loading) {
    Scene scene = read_scene(workspace, json, loading);
    scene.document = sharing_equal_parts(scene.document, workspace.document);

    // Nothing below throws.
    workspace.document = std::move(scene.document);
    workspace.lab = std::move(scene.lab);
    workspace.camera = scene.camera;
    workspace.start_anew();
    if (scene.paused) {
        workspace.clock.playing = !*scene.paused;
        workspace.clock.held = *scene.paused;
        workspace.clock.looks_back = workspace.ui.plays_after_dialog = false;
    }
    if (scene.speed) workspace.clock.speed = *scene.speed;
    return std::move(scene.notes);
}

void tell(Workspace& workspace, const std::vector<LabNote>& notes) {
    for (const LabNote& each : notes) {
        workspace.toast(each.text, each.whole ? ToastKind::Info : ToastKind::Refusal);
        if (!workspace.outputs.in_window) complain(each.text);
    }
}

void save_scene_file(Workspace& workspace, const std::filesystem::path& path) {
    Document saved = as_saved(workspace, path);
    const std::string text = json_to_text(save_scene(workspace, saved));
    if (text.size() > max_file_bytes)
        throw std::runtime_error(
            "the scene would be too large to open again: " + std::to_string(text.size()) + " bytes");
    const std::string fault = loading_fault(workspace, text);
    std::error_code ignored;
    if (!fault.empty() && std::filesystem::exists(path, ignored))
        throw std::runtime_error(path.filename().string() +
                                 " was not overwritten, because the scene would not open again: " + fault +
                                 ". Save it under another name");
    remove_torn_files(path.has_parent_path() ? path.parent_path() : fs::path("."));
    workspace.writes().write(path, OutputKind::Scene, text);
    workspace.document = std::move(saved);
    workspace.path = path;
    workspace.saved = workspace.document;
    if (!fault.empty()) workspace.toast("Saved, but the file does not open: " + fault, ToastKind::Refusal);
}

std::vector<LabNote> load_scene_file(Workspace& workspace, const std::filesystem::path& path) {
    const FileStamp stamp = file_stamp(path);  // before reading: later changes are noticed
    const std::string text = read_text_file(path);
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::vector<LabNote> notes;
    try {
        notes = load_scene(workspace, parse_json(text), {.folder = folder});
    } catch (const ParseError& error) {
        throw std::runtime_error(path.string() + ": " + error.what());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(path.string() + ": " + line_prefix(text, error.what()) + error.what());
    }
    remove_torn_files(folder);
    workspace.outputs.own(path, stamp);
    workspace.path = path;
    workspace.saved = workspace.document;
    tell(workspace, notes);
    return notes;
}

}  // namespace tendril::app
