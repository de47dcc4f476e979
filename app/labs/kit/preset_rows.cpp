#include "app/labs/kit/preset_rows.hpp"

#include <utility>

#include "app/widgets/fields.hpp"

namespace tendril::app {

bool preset_rows(const std::string& lab, const std::vector<PresetButton>& presets, const char* clears,
                 Emit& emit, int of) {
    bool opened = false;
    int in_row = 0;
    for (const PresetButton& preset : presets) {
        const char* const tooltip = preset.tooltip.empty() ? nullptr : preset.tooltip.c_str();
        const int wanted = preset.of > 0 ? preset.of : of;
        if (std::exchange(in_row, wanted) != wanted) end_row();  // they are of another width
        if (!row_button(preset.title.c_str(), wanted, true, tooltip)) continue;
        emit(lab + ".preset", {{"name", preset.name}});
        opened = true;
    }
    end_row();
    if (row_button("Empty", 2, true, clears)) emit(lab + ".clear");
    if (row_button("Reset", 2, true, "Resets this lab to its first state; undo restores it"))
        emit(lab + ".reset");
    end_row();
    return opened;
}

}  // namespace tendril::app
