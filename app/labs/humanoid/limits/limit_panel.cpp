// Inspector and drawing of joint limits. The table shows the active joint in degrees: its rotation, an
// adult's range and the clips' range. The range to use is set on all selected joints.
#include "app/labs/humanoid/draw.hpp"

#include <imgui.h>
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/limit_shape.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/tooltip.hpp"

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

/// A direction in which a joint turns. Titles are from the user's view; angles are those of limits.hpp.
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
        return {{"bend", "About the joint's only axis.", &ik::JointAngles::up, bend}};
    const bool right = bone >= Bone::RightShoulder && bone <= Bone::RightHand;
    const bool foot = bone == Bone::LeftFoot || bone == Bone::RightFoot;
    const char* const first = is_arm(bone) || foot ? "up" : "forward";
    const char* second = "left";  // on a leg: from the character's view
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

/// The head of a column, in the colour that its range has in the scene.
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
        ImGui::TextDisabled("deg");
        head("now", colours.text_dim, "From the T-pose.");
        // Yellow letters would be too faint on white.
        const float dark = colours.theme == Theme::Light ? 0.55f : 0.0f;
        head("adult", glm::mix(adult_colour(colours), colours.text, dark), "How far an adult's joint turns.");
        head("clips", clips_colour(colours), "How far the character's clips turn it, plus a degree.");
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
    std::string text =
        joint.in_force == joint.clips ? "The clips' range applies" : "An adult's range applies";
    if (joint.from == LimitsFrom::Motion && joint.clips == nullptr) text += ", as no clip turns it";
    if (joint.excess > glm::radians(0.5f))
        return text + "; it is " + fixed_text(static_cast<double>(glm::degrees(joint.excess)), 1) +
               "° beyond.";
    return text + (joint.held ? "; it is at its limit." : ".");
}

using Joints = std::vector<Bone>;

/// Arguments of a command that sets where joints take their limits from.
ArgumentList taking(LimitsFrom from, const Joints& joints) {
    return {{"from", limits_from.name(from)},
            one_or_list("bone", "bones", names(joints, [](Bone each) { return humanoid::name(each); }))};
}

/// Chooses the source of the limits. Each joint uses its own range from that source, about its own axes.
void source_row(const HumanoidPanel& panel, const Joints& joints, LimitsFrom shown) {
    const LimitRanges& ranges = panel.runtime.solvers.limits(panel.part);
    Joints turned;
    for (const Bone bone : joints)
        if (ranges.clips(bone) != nullptr) turned.push_back(bone);
    int from = static_cast<int>(shown);
    const auto titles = limits_from.titles();
    const char* why_not[]{nullptr, turned.empty() ? "no clip turns it" : nullptr, nullptr};
    if (choice_field("range", from, titles.data(), static_cast<int>(titles.size()), why_not)) {
        const auto chosen = static_cast<LimitsFrom>(from);
        panel.emit("humanoid.limits", taking(chosen, chosen == LimitsFrom::Motion ? turned : joints));
    }
    explain(joints.size() == 1 ? "How far this joint may turn; the others do not change."
                               : "How far each of these joints may turn, about its own axes.");
    if (const std::size_t still = joints.size() - turned.size(); still > 0 && !turned.empty())
        note("No clip turns " + std::to_string(still) + " of them: they cannot take the clips' range.");
}

void several_note(const HumanoidPanel& panel, const SelectedJoints& joints) {
    const std::size_t others = panel.part.selection.all().size() - joints.all.size();
    if (others > 0)
        note(count_text(others, "selected node") + (others == 1 ? " has" : " have") + " no limits.");
    if (joints.all.size() < 2) return;
    const LimitsFrom shown = panel.part.ik.limits_of(*joints.shown);
    const bool alike =
        std::ranges::all_of(joints.all, [&](Bone bone) { return panel.part.ik.limits_of(bone) == shown; });
    note((alike ? "Showing " : "They differ. Showing ") + std::string(humanoid::name(*joints.shown)) +
         "; changes apply to all.");
}

}  // namespace

void limit_inspector(const HumanoidPanel& panel) {
    const HumanoidPart& part = panel.part;
    const SelectedJoints joints = selected_joints(part, panel.runtime.solvers);
    if (!joints.shown) return;
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    const auto joint = joint_now(part, panel.runtime.solvers, shown, *joints.shown);
    if (!joint) return;
    const PanelSection ids(joints.all.size() == 1
                               ? ("Limits of " + std::string(humanoid::name(*joints.shown))).c_str()
                               : ("Limits of " + count_text(joints.all.size(), "joint")).c_str());
    several_note(panel, joints);
    table(panel, *joints.shown, *joint);
    note(in_words(*joint));
    source_row(panel, joints.all, joint->from);
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
    if (row_button("All joints alike", 1, true, "Sets every joint to the choice above"))
        panel.emit("humanoid.limits", {{"from", limits_from.name(ik.limits)}});
    end_row();
}

namespace {

bool held(const ShownPose& shown, Bone bone) {
    return shown.body && shown.body->at_limit[static_cast<std::size_t>(bone)];
}

class LimitDrawing {
  public:
    LimitDrawing(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown)
        : view_(view),
          list_(list),
          part_(part),
          shown_(shown),
          solvers_(humanoid_runtime(view.workspace).solvers),
          body_(body_nodes(part)) {}

    void selected(Bone bone, bool active) {
        const auto joint = joint_now(part_, solvers_, shown_, bone);
        if (!joint) return;
        const LimitRanges& ranges = solvers_.limits(part_);
        const LimitShape adult = ranges.shape(bone, *joint->adult, shown_);
        const float radius = radius_of(bone, 0.95f, 160.0f);
        const bool beyond = joint->held || joint->excess > slack;
        const auto range = [&](const ik::Limit& limit, glm::vec3 colour, float dial) {
            const bool in_force = joint->in_force == &limit;
            const LimitShape shape = ranges.shape(bone, limit, shown_);
            const LimitPen pen =
                pen_of(bone, radius, beyond && in_force ? view_.palette.limit : colour,
                       (in_force ? 1.0f : 0.7f) * (active ? 1.0f : 0.5f), in_force && active);
            if (active) pen.fill(shape);
            pen.outline(shape);
            if (active) pen.dial(shape, joint->angles, 0.62f, dial);
        };
        range(*joint->adult, adult_colour(view_.palette), 0.3f);
        if (joint->clips != nullptr) range(*joint->clips, clips_colour(view_.palette), 0.24f);
        const LimitPen now =
            pen_of(bone, radius, beyond ? view_.palette.limit : view_.palette.text, 1.0f, true);
        now.rest(adult);
        now.needle(adult, joint->angles);
        if (joint->held)
            list_
                .ring(centre(bone), 13.0f * view_.scale, 3.0f * view_.scale,
                      glm::vec4(view_.palette.limit, 1.0f))
                .layer = Layer::Overlay;
    }

    /// Draws only the limit in force: learning the clips' limits takes a while the first time.
    void held_back(Bone bone) {
        const LimitRanges& ranges = solvers_.limits(part_);
        const ik::Limit limit = ranges.in_force(part_.ik)[static_cast<std::size_t>(bone)];
        if (ranges.adult(bone) == nullptr || limit.kind == ik::JointKind::Free) return;
        outline(bone, ranges, limit, view_.palette.limit);
    }

    void discreet(Bone bone) {
        const auto joint = joint_now(part_, solvers_, shown_, bone);
        if (!joint) return;
        const LimitRanges& ranges = solvers_.limits(part_);
        outline(bone, ranges, *joint->adult, adult_colour(view_.palette));
        if (joint->clips != nullptr) outline(bone, ranges, *joint->clips, clips_colour(view_.palette));
    }

  private:
    static constexpr float slack = 0.002f;  // radians; solvers stop this close to a limit

    void outline(Bone bone, const LimitRanges& ranges, const ik::Limit& limit, glm::vec3 colour) {
        const LimitShape shape = ranges.shape(bone, limit, shown_);
        const LimitPen pen = pen_of(bone, radius_of(bone, 0.75f, 55.0f), colour, 0.6f, false);
        pen.outline(shape);
        pen.dot(shape, ranges.angles(bone, shown_));
    }

    glm::vec3 centre(Bone bone) const { return shown_.point(*part_.node_of(bone)); }
    LimitPen pen_of(Bone bone, float radius, glm::vec3 colour, float strength, bool spokes) const {
        return {view_,
                list_,
                {.centre = centre(bone),
                 .radius = radius,
                 .colour = colour,
                 .strength = strength,
                 .spokes = spokes}};
    }
    /// `share` of the bone's length, but at most `pixels` on the screen.
    float radius_of(Bone bone, float share, float pixels) const {
        const std::size_t node = *part_.node_of(bone);
        float length = 0.0f;
        for (const std::int32_t each : part_.skeleton().children(node))
            if (const auto child = static_cast<std::size_t>(each); body_[child])
                length = std::max(length, glm::distance(shown_.point(node), shown_.point(child)));
        if (!(length > 1e-5f))
            length =
                glm::distance(shown_.point(node), glm::vec3(shown_.placed[node].apply(end_of(part_, node))));
        return std::min(share * length, pixels * view_.scale * view_.camera.metres_per_pixel(centre(bone)));
    }

    const View& view_;
    DrawList& list_;
    const HumanoidPart& part_;
    const ShownPose& shown_;
    Solvers& solvers_;
    std::vector<bool> body_;
};

}  // namespace

glm::vec3 adult_colour(const Palette& palette) {
    return palette.selection;
}

glm::vec3 clips_colour(const Palette& palette) {
    return palette.head;
}

void draw_limits(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown) {
    if (part.view.limits == LimitsShown::None ||
        humanoid_runtime(view.workspace).solvers.body(part) == nullptr)
        return;
    LimitDrawing drawing(view, list, part, shown);
    const SelectedJoints chosen = selected_joints(part, humanoid_runtime(view.workspace).solvers);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (!part.node_of(bone) || (view.handles && chosen.has(bone))) continue;
        if (held(shown, bone))
            drawing.held_back(bone);
        else if (part.view.limits == LimitsShown::All)
            drawing.discreet(bone);
    }
    if (!view.handles) return;
    for (const Bone bone : chosen.all)
        if (bone != chosen.shown) drawing.selected(bone, false);
    if (chosen.shown) drawing.selected(*chosen.shown, true);
}

std::vector<LegendRow> limits_legend(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    if (part.view.limits == LimitsShown::None || solvers.body(part) == nullptr) return {};
    const SelectedJoints chosen = selected_joints(part, solvers);
    bool adult = false, clips = false;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (part.view.limits != LimitsShown::All && !chosen.has(bone)) continue;
        adult = adult || solvers.limits(part).adult(bone) != nullptr;
        clips = clips || solvers.limits(part).clips(bone) != nullptr;
    }
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows;
    const bool handle = part.view.limits != LimitsShown::All;  // only of selected joints
    if (adult)
        rows.push_back({.name = "an adult's range", .colour = adult_colour(colours), .handle = handle});
    if (clips)
        rows.push_back({.name = "the clips' range", .colour = clips_colour(colours), .handle = handle});
    return rows;
}

}  // namespace tendril::app
