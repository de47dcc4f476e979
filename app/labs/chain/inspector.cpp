#include <imgui.h>
#include <algorithm>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/kit/past.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/fonts.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

using Joints = std::vector<glm::vec3>;

void chain_rows(const ShownChain& shown, const Joints& joints) {
    const PanelSection ids("Chain");
    const ChainPart& part = shown.part;
    const Chain& chain = part.chain;
    reading("size", "%s, %s", count_text(chain.size(), "joint").c_str(),
            count_text(chain.empty() ? 0 : chain.size() - 1, "bone").c_str());
    if (chain.empty()) return;
    reading("reach", "%.3f m", static_cast<double>(chain.reach()));
    const bool reaches = part.mode == ChainMode::Reach;  // the report already shows "tip to target"
    if (part.reach.plane)
        reading("target off plane", "%.3f m", static_cast<double>(off_plane(chain, part.reach, part.target)));
    const auto to_target = [&](std::size_t joint, double metres) {
        reading((std::string(end_name(part, joint)) + " to target").c_str(), "%.3f m", metres);
    };
    to_target(0, static_cast<double>(glm::distance(joints.front(), part.target)));
    if (!reaches && chain.size() > 1)
        to_target(chain.size() - 1, static_cast<double>(shown_residual(part, joints)));
    reading("length error", "%s", error_text(static_cast<double>(worst_error(shown, joints))).c_str());
    explain("The largest difference of a bone from its length; none: less than 0.01 mm.");
}

void joint_row(const ShownChain& shown, const Joints& joints, std::size_t i, Emit& emit) {
    const ShownSegment segment = shown_segment(shown, joints, i);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    char id[24];
    std::snprintf(id, sizeof id, "%zu", i);
    if (ImGui::Selectable(id, shown.part.selection.has(i), ImGuiSelectableFlags_SpanAllColumns)) {
        emit("chain.select", {{"index", i}, {"add", ImGui::GetIO().KeyShift}});
    }
    if (ImGui::IsItemHovered())
        tooltip(i == 0 ? "Click selects the first joint, Shift+click adds it"
                       : "Click selects this joint. bone: the length of the bone that leads to it; "
                         "error: its difference from the stored length");
    const auto column = [](const std::string& text) {
        ImGui::TableNextColumn();
        text_flush_right(text);
    };
    for (int axis = 0; axis < 3; ++axis) column(fixed_text(static_cast<double>(segment.position[axis]), 2));
    column(fixed_text(static_cast<double>(segment.length), 3));
    column(error_text(static_cast<double>(segment.error)));
}

/// `fixed`: columns as wide as their numbers, scrolled sideways, for panels that are too narrow.
void header_row(bool fixed) {
    struct Column {
        const char* name;
        float share;
    };
    constexpr Column columns[] = {{"#", 0.7f}, {"x", 1.0f},     {"y", 1.0f},
                                  {"z", 1.0f}, {"bone", 1.05f}, {"error", 1.4f}};
    for (const Column& column : columns) {
        const float width = fixed ? 3.6f * column.share * ImGui::GetFontSize() : column.share;
        ImGui::TableSetupColumn(column.name,
                                fixed ? ImGuiTableColumnFlags_WidthFixed : ImGuiTableColumnFlags_WidthStretch,
                                width);
    }
    ImGui::TableSetupScrollFreeze(fixed ? 1 : 0, 1);
    ImGui::TableNextRow();
    for (const Column& column : columns) {
        ImGui::TableNextColumn();
        if (column.name[0] == '#')
            ImGui::TextDisabled("%s", column.name);
        else
            text_flush_right(column.name, true);
    }
}

/// Call inside the table: scrolls once to a row that was selected elsewhere.
void follow_selection(const ChainPart& part, float row_height) {
    int& followed = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("followed"), -1);
    const int selected = part.selection.active() ? static_cast<int>(*part.selection.active()) : -1;
    if (std::exchange(followed, selected) == selected || selected < 0) return;
    const float top = static_cast<float>(selected) * row_height;
    const float visible =
        ImGui::GetWindowHeight() - 2.0f * row_height;  // below the header, minus the row itself
    if (top < ImGui::GetScrollY() || top > ImGui::GetScrollY() + visible)
        ImGui::SetScrollY(top - 0.5f * visible);
}

/// Fills the panel except for `below`, the height of the rows that follow.
void joint_table(const ShownChain& shown, const Joints& joints, float below, Emit& emit) {
    ImGui::PushFont(small_font());
    const bool narrow = ImGui::GetContentRegionAvail().x < 16.0f * ImGui::GetFontSize();
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                                  ImGuiTableFlags_NoPadOuterX |
                                  (narrow ? ImGuiTableFlags_ScrollX : ImGuiTableFlags_None);
    const float min_height = 8.0f * ImGui::GetTextLineHeightWithSpacing();
    const float height = std::max(min_height, ImGui::GetContentRegionAvail().y - below);
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(3.0f, 2.0f));
    if (ImGui::BeginTable("joints", 6, flags, {0.0f, height})) {
        header_row(narrow);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(joints.size()));
        while (clipper.Step()) {
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                joint_row(shown, joints, static_cast<std::size_t>(i), emit);
            }
        }
        follow_selection(shown.part, clipper.ItemsHeight);
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::PopFont();
}

}  // namespace

void ChainLab::inspector(const Workspace& workspace, Emit& emit) const {
    const ShownChain shown = shown_chain(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const bool reaches = shown.part.mode == ChainMode::Reach;
    if (shown.trace) microscope_rows(shown, colours, emit);
    if (shown.race) race_rows(shown, colours, emit);
    const Joints joints = shown_joints(shown);
    report_rows(shown, joints, colours, emit);
    selection_rows(shown, joints, emit);
    if (reaches) limit_rows(shown.part, joints, emit);
    chain_rows(shown, joints);
    // Do not keep references into the storage: the rows below add to it, which moves its elements.
    ImGuiStorage& kept = *ImGui::GetStateStorage();
    const ImGuiID below = ImGui::GetID("below the table");
    if (const FoldingSection open(workspace, "Joints, in metres", emit, false); open)
        joint_table(shown, joints, kept.GetFloat(below), emit);
    const float from = ImGui::GetCursorPosY();
    incident_rows(workspace, colours, emit);  // last, so that fields stay put when one is added
    kept.SetFloat(below, ImGui::GetCursorPosY() - from);
}

// The selected joints. The active one is shown; edits apply to all.

namespace {

/// Arguments of a command: the joints, and the values to set on them.
ArgumentList of_joints(const std::vector<std::size_t>& joints, ArgumentList values = {}) {
    values.insert(values.begin(), joints.size() == 1 ? NamedArgument{"index", joints.front()}
                                                     : NamedArgument{"joints", SharedJson(Json(joints))});
    return values;
}

/// "1, 2, 5", with "..." for joints after the eighth.
std::string list_text(const std::vector<std::size_t>& joints) {
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, joints.size()); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(joints[i]);
    return joints.size() > most ? text + " ..." : text;
}

/// Under the microscope a joint is read-only: it shows the pose of the step.
void joint_in_step(const ShownChain& chain, const Joints& joints, std::size_t i) {
    const ShownSegment shown = shown_segment(chain, joints, i);
    reading("x", "%.3f m", static_cast<double>(shown.position.x));
    reading("y", "%.3f m", static_cast<double>(shown.position.y));
    reading("z", "%.3f m", static_cast<double>(shown.position.z));
    reading("bone in this step", "%.3f m", static_cast<double>(shown.length));
    reading("to the target", "%.3f m", static_cast<double>(glm::distance(shown.position, chain.part.target)));
}

void one_joint(const ShownChain& shown, const Joints& joints, std::size_t i, Emit& emit) {
    const ChainPart& part = shown.part;
    const std::string end = end_name(part, i);
    reading("joint", "%zu%s", i, end.empty() ? "" : (" (" + end + ")").c_str());
    if (shown.trace) return joint_in_step(shown, joints, i);
    glm::vec3 to = joints[i];
    ImGui::BeginDisabled(part.mode == ChainMode::Curve);
    if (point_field("at", to, 0.01f)) emit.continuously("chain.pull", {{"index", i}, {"to", to}});
    ImGui::EndDisabled();
    explain(part.mode == ChainMode::Curve
                ? "The joint's position. It follows the curve: drag the curve."
                : "The joint's position. A change pulls it there, and the chain follows.");
    length_field(i == 0 ? "length" : "bone length", part, emit);
    if (i == 0) note("No bone leads to this joint: the length applies once a joint is inserted before it.");
    reading("to the target", "%.3f m", static_cast<double>(glm::distance(joints[i], part.target)));
}

void several_joints(const ShownChain& shown, Emit& emit) {
    const ChainPart& part = shown.part;
    const std::vector<std::size_t>& all = part.selection.all();
    reading("joints", "%zu", all.size());
    note(list_text(all));
    if (!shown.trace) length_field("bone lengths", part, emit);
}

void axis_row(const ik::Limit& limit, const std::vector<std::size_t>& joints, Emit& emit) {
    static constexpr const char* axes[] = {"X", "Y", "Z", "other"};
    const glm::mat3 units(1.0f);
    int axis = 0;
    while (axis < 3 && limit.axis != units[axis]) ++axis;
    if (choice_field("axis", axis, axes, axis == 3 ? 4 : 3) && axis < 3)
        emit("chain.limit", of_joints(joints, {{"axis", units[axis]}}));
    explain(
        "The axis of upward rotation, in world axes with the chain straight; a hinge turns only about this "
        "axis.");
}

/// "Joint 2 is at 43°; straight is 0°."
std::string angle_text(const ChainPart& part, const Joints& joints, const ik::Limit& limit,
                       std::size_t joint) {
    const glm::vec3 rest = part.chain.default_direction();
    const auto turns = rotations_at(joints, part.reach.state.rotations, rest);
    const glm::quat parent = joint == 0 ? glm::quat(1, 0, 0, 0) : turns[joint - 1];
    const float up = ik::measure(limit, rest, glm::conjugate(parent) * turns[joint]).up;
    return "Joint " + std::to_string(joint) + " is at " +
           fixed_text(glm::degrees(static_cast<double>(up)), 0) + "\xc2\xb0; straight is 0\xc2\xb0.";
}

bool same_limits(const ReachSettings& reach, const std::vector<std::size_t>& joints) {
    return std::all_of(joints.begin(), joints.end(), [&](std::size_t joint) {
        if (reach.plane)
            return angle_limit_of(*reach.plane, joint) == angle_limit_of(*reach.plane, joints.front());
        return limit_of(reach, joint) == limit_of(reach, joints.front());
    });
}

}  // namespace

void selection_rows(const ShownChain& shown, const Joints& joints, Emit& emit) {
    const PanelSection ids("Selection");
    const ChainPart& part = shown.part;
    if (!part.along.selection.empty()) return control_rows(part, emit);
    if (part.selection.several()) return several_joints(shown, emit);
    if (part.selection.active()) return one_joint(shown, joints, *part.selection.active(), emit);
    if (!part.chosen_point) return note("Nothing is selected.");
    reading("selected", "%s", chain_points.title(*part.chosen_point));
    note("Drag an arrow to move it along one axis, a square to keep it in a plane.");
}

void length_field(const char* name, const ChainPart& part, Emit& emit) {
    const std::vector<std::size_t>& joints = part.selection.all();
    const std::size_t shown = *part.selection.active();
    float length = own_chain(part).length(shown);
    if (number_field(name, length, 0.01f, 0.0f, 1000.0f, "%.3f m"))
        emit.continuously("chain.set_length", of_joints(joints, {{"length", length}}));
    explain(joints.size() > 1
                ? "The length of the bones that lead to the selected joints: one is shown, all are set."
            : shown == 0 ? "The length of the bone that leads here once a joint is inserted before this one."
                         : "The length of the bone that leads to this joint.");
}

void limit_rows(const ChainPart& part, const Joints& pose, Emit& emit) {
    // No bone starts at the tail.
    std::vector<std::size_t> joints = part.selection.all();
    if (!joints.empty() && joints.back() + 1 == part.chain.size()) joints.pop_back();
    if (joints.empty()) return;
    const std::size_t joint = std::binary_search(joints.begin(), joints.end(), *part.selection.active())
                                  ? *part.selection.active()
                                  : joints.back();
    const bool several = joints.size() > 1;
    const PanelSection ids(several ? "Limit of these joints" : "Limit of this joint");
    if (several && !same_limits(part.reach, joints))
        note("They differ. Showing joint " + std::to_string(joint) + "; changes apply to all.");
    if (part.reach.plane) {
        const ik::AngleLimit limit = angle_limit_of(*part.reach.plane, joint);
        FieldRows(limit, field_texts<ik::AngleLimit>(), "chain.angle_limit", emit, of_joints(joints))
            .rows("min", "max", "from");
        return;
    }
    const ik::Limit limit = limit_of(part.reach, joint);
    const FieldRows rows({ik::limit_fields(limit.kind), &limit}, field_texts<ik::Limit>(), "chain.limit",
                         emit, of_joints(joints));
    rows.row("kind");
    if (limit.kind == ik::JointKind::Free) note("Turns freely.");
    for (const Field& field : ik::limit_fields(limit.kind))
        if (field.name != std::string_view("kind") && field.name != std::string_view("axis"))
            rows.row(field.name);
    if (limit.kind == ik::JointKind::Free) return;
    axis_row(limit, joints, emit);
    note(limit.kind == ik::JointKind::Hinge ? angle_text(part, pose, limit, joint)
                                            : "A straight chain has all angles 0.");
}

}  // namespace tendril::app
