#include <imgui.h>

#include "app/labs/chain/panels.hpp"
#include "app/labs/chain/verdict.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void coloured_note(const std::string& text, glm::vec3 colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, {colour.r, colour.g, colour.b, 1.0f});
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str(), text.c_str() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

}  // namespace

void report_rows(const ShownChain& shown, const std::vector<glm::vec3>& joints, const Palette& palette) {
    const ChainPart& part = shown.part;
    if (!shows_end(shown)) {
        verdict("On its way", palette.text);
        reading("tip to target", "%.4f m", static_cast<double>(shown_residual(part, joints)));
        note("A step of the solve; its report comes with the last one.");
        return;
    }
    show_verdict(chain_verdict(part), palette);
    if (part.mode != ChainMode::Reach) {
        note(chain_modes.help(part.mode));
        return;
    }
    if (!part.result) {
        note("The tip then reaches for it.");
        return;
    }
    const ReachResult& result = *part.result;
    if (result.active_limit) coloured_note(active_limit_text(*result.active_limit) + ".", palette.limit);
    note(std::string(ik::name(result.report.status)) + ": " + status_help(result.report.status));
    note(ran_text(result.method, result.report, !part.reach.limits.empty()) + ".");
    reading("iterations", "%d", result.report.iterations);
    reading("tip to target", "%.4f m", static_cast<double>(shown_residual(part, joints)));
}

}  // namespace tendril::app
