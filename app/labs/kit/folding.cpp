#include "app/labs/kit/folding.hpp"

#include "app/widgets/fields.hpp"

namespace tendril::app {

bool folding_section(const Workspace& workspace, const char* title, Emit& emit, bool open_at_first) {
    const std::string section = workspace.lab + ": " + title;
    const auto& choices = workspace.settings.choices;
    const auto chosen = choices.find(fold_key(section));
    const bool open = chosen == choices.end() ? open_at_first : chosen->second != "folded";
    if (section_button(title, open)) emit("view.fold", {{"section", section}, {"folded", open}});
    return open;
}

}  // namespace tendril::app
