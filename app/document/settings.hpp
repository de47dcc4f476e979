// A person's preferences: kept by name in the user's config folder, apart from any document. What the
// window shows for the moment (an open palette, a toast) is UiState in workspace.hpp and is not kept.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/document/json.hpp"

namespace tendril::app {

enum class Theme { Dark, Light };
enum class LabelMode { Hover, Always };

struct Settings {
    Theme theme = Theme::Dark;
    LabelMode labels = LabelMode::Hover;
    float text_scale = 1.0f;  ///< on top of the window's own scale; 0.5 to 3
    bool left_open = true;
    bool right_open = true;
    float left_width = 272.0f;  ///< unscaled window coordinates; 180 to 520
    float right_width = 272.0f;
    bool hint_seen = false;  ///< the first drag has happened
    /// What is chosen of what labs leave to choose, by name; what is not there is as the lab has it first.
    std::map<std::string, std::string> choices{};
    bool operator==(const Settings&) const = default;
};

/// Under which name of `choices` it is kept whether a section of a panel is folded.
inline std::string fold_key(const std::string& section) {
    return "section " + section;
}

Json save_settings(const Settings& settings);
/// A text under a name that is none of these is kept as a choice of some lab's; other unknown names are
/// ignored, and a value that does not fit keeps its default, so that an old or edited file never stops the
/// program; each such value is named in `complaints`.
Settings load_settings(const Json& json, std::vector<std::string>& complaints);

/// $XDG_CONFIG_HOME/tendril, else ~/.config/tendril; empty where neither is known.
std::filesystem::path config_folder();

}  // namespace tendril::app
