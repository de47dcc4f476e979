#include "app/labs/kit/verdict.hpp"

#include <imgui.h>

#include <algorithm>

#include "app/widgets/fields.hpp"

namespace tendril::app {

void show_verdict(const Verdict& said, const Palette& palette) {
    verdict(said.text, said.kind == Verdict::Kind::Bad ? palette.limit : palette.text);
    if (said.why.empty()) return;
    // As high for one line as for two, so that nothing below moves when the words change.
    const float from = ImGui::GetCursorPosY();
    note(said.why);
    const float two = 2.0f * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
    ImGui::SetCursorPosY(std::max(from + two, ImGui::GetCursorPosY()));
}

}  // namespace tendril::app
