#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/io/solver_json.hpp"
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

struct AngleRow {
    const char* title;
    const char* key;
    const char* help;
    float low;  ///< degrees; the highest is 180
};

std::vector<AngleRow> angle_rows(ik::JointKind kind) {
    if (kind == ik::JointKind::Free) return {};
    if (kind == ik::JointKind::Hinge)
        return {{"minimum", "min_deg", "The smallest angle about the axis; 0 is straight.", -180.0f},
                {"maximum", "max_deg", "The largest angle about the axis; 0 is straight.", -180.0f}};
    constexpr const char* cone = "How far the bone may turn this way from straight: a side of its cone.";
    return {{"up", "up_deg", cone, 0.0f},
            {"down", "down_deg", cone, 0.0f},
            {"left", "left_deg", cone, 0.0f},
            {"right", "right_deg", cone, 0.0f},
            {"twist from", "twist_min_deg", "How far the bone may turn about itself, one way.", -180.0f},
            {"twist to", "twist_max_deg", "How far the bone may turn about itself, the other way.", -180.0f}};
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
    const Verdict said = chain_verdict(part);
    verdict(said.text, said.kind == Verdict::Kind::Bad ? palette.limit : palette.text);
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

void limit_rows(const ChainPart& part, Emit& emit) {
    if (!part.selected || *part.selected + 1 >= part.chain.size()) return;
    const std::size_t joint = *part.selected;
    section("Limit of this joint");
    const ik::Limit limit = limit_of(part.reach, joint);
    std::array<const char*, all_joint_kinds.size()> titles{};
    std::transform(all_joint_kinds.begin(), all_joint_kinds.end(), titles.begin(), kind_title);
    int kind = static_cast<int>(limit.kind);
    if (choice_field("kind", kind, titles.data(), static_cast<int>(titles.size()))) {
        emit("chain.limit",
             {{"index", joint}, {"kind", ik::name(all_joint_kinds[static_cast<std::size_t>(kind)])}});
    }
    explain(
        "How the bone after this joint may turn: a hinge about one axis, the others within a cone and about "
        "the bone. Each begins with the angles that people usually have.");
    if (limit.kind == ik::JointKind::Free) {
        note("Turns freely.");
        return;
    }
    const Json json = limit_json(limit);
    for (const AngleRow& row : angle_rows(limit.kind)) {
        if (!json.contains(row.key)) continue;
        float angle = json.at(row.key).get<float>();
        if (number_field(row.title, angle, 0.5f, row.low, 180.0f, "%.1f deg")) {
            emit.continuously("chain.limit", {{"index", joint}, {row.key, angle}});
        }
        explain(row.help);
    }
    static constexpr const char* axes[] = {"X", "Y", "Z", "another"};
    int axis = 3;
    for (int i = 0; i < 3; ++i) {
        glm::vec3 unit(0.0f);
        unit[i] = 1.0f;
        if (limit.axis == unit) axis = i;
    }
    if (choice_field("axis", axis, axes, axis == 3 ? 4 : 3) && axis < 3) {
        glm::vec3 unit(0.0f);
        unit[axis] = 1.0f;
        emit("chain.limit", {{"index", joint}, {"axis", unit}});
    }
    explain("About which axis a turn is called up; a hinge turns about it alone.");
    note(
        "Axis of upward rotation, in world axes with the chain straight. A straight chain has all angles 0.");
}

}  // namespace tendril::app
