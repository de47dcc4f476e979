// The selected joint in degrees: how it is turned, and how far an adult's goes and the clips take it.
#include <imgui.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "app/document/units.hpp"
#include "app/labs/humanoid/limits/draw_limits.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

std::string degrees(float radians) {
    return fixed_text(static_cast<double>(glm::degrees(radians)), 0);
}

std::string range_text(float low, float high) {
    return degrees(low) + " .. " + degrees(high);
}

struct Range {
    float low, high;
};

/// One way in which a joint turns. Titles are about the person's body: the axes of limits.hpp are.
struct Way {
    const char* title;
    const char* help;
    float ik::JointAngles::*angle;
    Range (*range)(const ik::Limit&);
};

Range bend(const ik::Limit& limit) {
    return {limit.min, limit.max};
}
Range first_swing(const ik::Limit& limit) {
    return {-limit.down, limit.up};
}
Range second_swing(const ik::Limit& limit) {
    return {-limit.right, limit.left};
}
Range twist(const ik::Limit& limit) {
    return {limit.twist_min, limit.twist_max};
}

bool is_arm(Bone bone) {
    return (bone >= Bone::LeftShoulder && bone <= Bone::LeftHand) ||
           (bone >= Bone::RightShoulder && bone <= Bone::RightHand);
}

std::vector<Way> ways_of(Bone bone, const ik::Limit& limit) {
    if (limit.kind == ik::JointKind::Hinge)
        return {{"bend", "About the joint's one axis.", &ik::JointAngles::up, bend}};
    const bool right = bone >= Bone::RightShoulder && bone <= Bone::RightHand;
    const bool foot = bone == Bone::LeftFoot || bone == Bone::RightFoot;
    const char* const first = is_arm(bone) || foot ? "up" : "forward";
    const char* second = "left";  // of a leg: seen by the character
    if (is_arm(bone)) second = right ? "forward" : "back";
    if (bone <= Bone::Head) second = "right";
    return {{first, "From the T-pose; the other way is negative.", &ik::JointAngles::up, first_swing},
            {second, "From the T-pose; the other way is negative.", &ik::JointAngles::left, second_swing},
            {"twist", "About the bone itself.", &ik::JointAngles::twist, twist}};
}

void cell(const std::string& text, glm::vec3 colour) {
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, {colour.r, colour.g, colour.b, 1.0f});
    text_flush_right(text);
    ImGui::PopStyleColor();
}

/// The head of a column, with the colour that its range has in the picture.
void head(const char* title, glm::vec3 colour, const char* help) {
    cell(title, colour);
    explain(help);
}

void table(const HumanoidPanel& panel, Bone bone, const JointNow& joint) {
    const Palette& colours = panel.colours;
    ImGui::PushFont(small_font());
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(3.0f, 2.0f));
    if (ImGui::BeginTable("limits", 4, ImGuiTableFlags_NoPadOuterX)) {
        for (const float share : {0.95f, 0.75f, 1.25f, 1.25f})
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, share);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextDisabled("degrees");
        head("now", colours.text_dim, "From the T-pose.");
        head("adult", adult_colour(colours), "As far as an adult's joint turns.");
        head("clips", clips_colour(colours), "As far as the character's clips turn it, and a degree more.");
        for (const Way& way : ways_of(bone, *joint.adult)) {
            const float now = joint.angles.*way.angle;
            bool beyond = false;
            if (joint.in_force != nullptr) {
                const Range allowed = way.range(*joint.in_force);
                constexpr float near = 0.01f;
                beyond = now > allowed.high - near || now < allowed.low + near;
            }
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(way.title);
            explain(way.help);
            cell(degrees(now), beyond ? colours.limit : colours.text);
            const auto range = [&](const ik::Limit* limit) {
                const Range ends = limit != nullptr ? way.range(*limit) : Range{};
                cell(limit != nullptr ? range_text(ends.low, ends.high) : "-",
                     limit != nullptr && limit == joint.in_force ? colours.text : colours.text_dim);
            };
            range(joint.adult);
            range(joint.clips);
        }
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

std::string in_words(const JointNow& joint) {
    if (joint.in_force == nullptr) return "Nothing limits it: joint limits are off.";
    std::string text = joint.in_force == joint.clips ? "The clips' range holds" : "An adult's range holds";
    if (joint.from == LimitsFrom::Motion && joint.clips == nullptr) text += ", as no clip turns it";
    if (joint.excess > glm::radians(0.5f))
        return text + "; it is " + fixed_text(static_cast<double>(glm::degrees(joint.excess)), 1) +
               "° beyond.";
    return text + (joint.held ? "; it is at its limit." : ".");
}

}  // namespace

void limit_inspector(const HumanoidPanel& panel) {
    const HumanoidPart& part = panel.part;
    const auto node = part.skeleton().find(part.selected);
    const auto bone = node ? part.bone_of(*node) : std::nullopt;
    if (!bone) return;
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    const auto joint = joint_now(part, panel.runtime.solvers, shown, *bone);
    if (!joint) return;
    section(("Limits of " + std::string(humanoid::name(*bone))).c_str());
    table(panel, *bone, *joint);
    note(in_words(*joint));
    const auto take = [&](LimitsFrom from) {
        panel.emit("humanoid.limits", {{"from", limits_from.name(from)}, {"bone", humanoid::name(*bone)}});
    };
    const bool by_clips = joint->in_force != nullptr && joint->in_force == joint->clips;
    if (by_clips) {
        if (row_button("Use an adult's range", 1, true, "For this joint alone")) take(LimitsFrom::Defaults);
    } else if (row_button("Use the clips' range", 1, joint->clips != nullptr,
                          joint->clips != nullptr ? "For this joint alone" : "No clip turns this joint")) {
        take(LimitsFrom::Motion);
    }
    end_row();
}

void limit_rows(const HumanoidPanel& panel) {
    const IkSettings& ik = panel.part.ik;
    int from = static_cast<int>(ik.limits);
    const auto titles = limits_from.titles();
    const char* why_not[]{nullptr, panel.part.loaded->clips().empty() ? "no clips" : nullptr, nullptr};
    if (choice_field("joint limits", from, titles.data(), static_cast<int>(titles.size()), why_not))
        panel.emit("humanoid.limits", {{"from", limits_from.name(static_cast<LimitsFrom>(from))}});
    explain(limits_from.help(ik.limits));
    if (ik.joint_limits.empty()) return;
    note(count_text(ik.joint_limits.size(), "joint") +
         (ik.joint_limits.size() == 1 ? " has a range of its own." : " have ranges of their own."));
    if (row_button("All joints alike", 1, true, "They go by the choice above again"))
        panel.emit("humanoid.limits", {{"from", limits_from.name(ik.limits)}});
    end_row();
}

}  // namespace tendril::app
