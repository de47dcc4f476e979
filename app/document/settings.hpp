// The user's preferences, saved by name in the config folder, apart from any document. Transient window state
// (an open palette, a toast) is UiState in workspace.hpp and is not saved.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/io/json.hpp"

namespace tendril::app {

enum class Theme { Dark, Light };
enum class LabelMode { Hover, Always };

struct Settings {
    Theme theme = Theme::Dark;
    LabelMode labels = LabelMode::Hover;
    float text_scale = 1.0f;  ///< multiplies the window's own scale; 0.5 to 3
    bool left_open = true;
    bool right_open = true;
    float left_width = 272.0f;  ///< unscaled window coordinates; 180 to 520
    float right_width = 272.0f;
    bool hint_seen = false;  ///< the first drag has happened
    /// The labs' own options, by name. A missing one has the lab's default.
    std::map<std::string, std::string> choices{};
    bool operator==(const Settings&) const = default;
};

/// The key in `choices` for whether a section is folded ("chain: Target"), or, for a lab ("chain"), every
/// section that was not folded or unfolded since.
inline std::string fold_key(const std::string& section) {
    return "section " + section;
}
bool is_folded(const Settings& settings, const std::string& section, bool at_first);
void set_folded(Settings& settings, const std::string& section, bool folded);

Json save_settings(const Settings& settings);
/// Never fails, so that an old or edited file cannot stop the program: an invalid value keeps its default and
/// is reported in `complaints`. A string under an unknown name is kept in `choices`; other unknown members
/// are ignored.
Settings load_settings(const Json& json, std::vector<std::string>& complaints);

}  // namespace tendril::app
