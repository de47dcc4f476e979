#include "app/labs/kit/race.hpp"

#include <imgui.h>

#include <array>

#include "app/labs/kit/arguments.hpp"
#include "app/system/atomic_file.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

using RacerColours = std::array<glm::vec3, max_racers>;

constexpr RacerColours on_dark{rgb(0xF2F5F8), rgb(0x3F8FE0), rgb(0xCC79A7), rgb(0xA9792B),
                               rgb(0x35C3A5), rgb(0xB9A6F2), rgb(0x8FA33B)};
constexpr RacerColours on_light{rgb(0x1E252E), rgb(0x1D6FC4), rgb(0xB2558A), rgb(0x8A5D10),
                                rgb(0x00886C), rgb(0x7A5FD0), rgb(0x66791A)};

}  // namespace

glm::vec3 racer_colour(const Palette& palette, std::size_t racer) {
    return (palette.theme == Theme::Light ? on_light : on_dark)[racer];
}

void small_right(const std::string& text) {
    ImGui::PushFont(small_font());
    text_flush_right(elided(text, ImGui::GetContentRegionAvail().x), true);
    ImGui::PopFont();
}

void add_race_csv_commands(CommandTable& table, const RaceCsv& csv) {
    table.add({.name = csv.race + ".copy",
               .title = "Copy " + csv.title,
               .arguments = {},
               .help = "Puts " + csv.holds + " on the clipboard, as CSV",
               .effect = Effect::Look,
               .apply = [text = csv.text](Workspace& workspace, const Arguments&) {
                   workspace.ui.copied = text(workspace);
                   workspace.toast("The race is on the clipboard, as CSV.");
               }});
    table.add({.name = csv.race + ".save",
               .title = "Save " + csv.title,
               .arguments = {text_argument("path", true, "a CSV file to write")},
               .help = "Writes " + csv.holds + " as CSV",
               .effect = Effect::Look,
               .apply = [text = csv.text](Workspace& workspace, const Arguments& given) {
                   workspace.writes().write(given.text("path"), OutputKind::Csv, text(workspace));
                   workspace.toast(written_text(given.text("path")));
               }});
}

}  // namespace tendril::app
