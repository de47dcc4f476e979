#include <imgui.h>

#include <algorithm>

#include "app/fields/field_rows.hpp"
#include "app/labs/chain/panels.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// Why the method does not honour an option, as its row says; empty where it does.
std::string why_unused(const ReachSettings& reach, ik::Option option) {
    const bool limited = !reach.limits.empty();
    if (ik::honours(reach.method, option, limited)) return {};
    const bool otherwise = ik::honours(reach.method, option, !limited);
    const char* const when = !otherwise ? "" : limited ? " within limits" : " without joint limits";
    return std::string(solver_title(reach.method)) + " does not use this" + when + ".";
}

FieldRows solver_settings(const ReachSettings& reach, Emit& emit) {
    return FieldRows(reach, "chain.solver", emit);
}

void stop_rows(const ReachSettings& reach, float length, Emit& emit) {
    const FieldRows rows = solver_settings(reach, emit);
    rows.row("iterations", {.why_not = why_unused(reach, ik::Option::MaxIterations)});
    rows.row("tolerance", {.otherwise = reach_tolerance(reach, length)});
    if (row_button("Default tolerance", 1, reach.tolerance.has_value(), "A thousandth of the reach"))
        emit("chain.solver", {{"default_tolerance", true}});
}

void option_rows(const ReachSettings& reach, Emit& emit) {
    const FieldRows rows = solver_settings(reach, emit);
    const auto why_not = [&](ik::Option option) { return why_unused(reach, option); };
    rows.row("snap_back", {.why_not = why_not(ik::Option::SnapBack)});
    rows.row("soft_zone", {.why_not = why_not(ik::Option::SoftZone)});
    rows.row("damping", {.why_not = why_not(ik::Option::Damping)});
    rows.row("twist_deg", {.why_not = why_not(ik::Option::Twist)});
    const std::string unused = why_not(ik::Option::Restarts);
    rows.row("restarts", {.otherwise = default_restarts, .why_not = unused});
    ImGui::BeginDisabled(!unused.empty());
    if (row_button("Default restarts", 1, reach.restarts.has_value(),
                   "8, but none while the target is dragged"))
        emit("chain.solver", {{"default_restarts", true}});
    ImGui::EndDisabled();
}

/// A pole begins above the middle of the line from head to target, clear of the chain.
glm::vec3 first_pole(const ChainPart& part) {
    const glm::vec3 middle = 0.5f * (part.chain.segments().front().position + part.target);
    return middle + glm::vec3(0.0f, 0.6f * std::max(1.0f, part.chain.reach()), 0.0f);
}

void pole_rows(const ChainPart& part, Emit& emit) {
    if (part.chain.empty()) return;
    bool on = part.reach.pole.has_value();
    if (ImGui::Checkbox("Pole target: the elbow points at it", &on)) {
        emit("chain.pole", on ? ArgumentList{{"to", first_pole(part)}} : ArgumentList{{"off", true}});
    }
    explain("Turns the chain about the line from root to tip until it bends towards a point that you place.");
    if (!part.reach.pole) return;
    glm::vec3 pole = *part.reach.pole;
    if (point_field("pole", pole, 0.01f)) emit.continuously("chain.pole", {{"to", pole}});
    explain("Where the pole target is: what the elbow or knee points at.");
    solver_settings(part.reach, emit)
        .row("pole_turn", {.why_not = why_unused(part.reach, ik::Option::PoleTurn)});
}

}  // namespace

void solver_rows(const ChainPart& part, Emit& emit) {
    std::array<const char*, ik::all_methods.size()> titles{};
    std::transform(ik::all_methods.begin(), ik::all_methods.end(), titles.begin(), solver_title);
    int method = static_cast<int>(part.reach.method);
    std::array<const char*, ik::all_methods.size()> why_not{};
    std::transform(ik::all_methods.begin(), ik::all_methods.end(), why_not.begin(),
                   [&](ik::Method each) { return takes(each, part.chain) ? nullptr : needs_two_bones; });
    if (choice_field("##solver", method, titles.data(), static_cast<int>(titles.size()), why_not.data())) {
        emit("chain.solver", {{"name", ik::name(ik::all_methods[static_cast<std::size_t>(method)])}});
    }
    explain("The solver that brings the tip to the target. Race, below, compares them on this chain.");
    std::vector<std::string> notes;
    for (const ik::Method each : ik::all_methods) notes.emplace_back(solver_help(each));
    notes.push_back(why_not_taken(part.reach.method, part.chain) + ".");
    const bool taken = takes(part.reach.method, part.chain);
    note_of(notes, taken ? static_cast<std::size_t>(part.reach.method) : notes.size() - 1);
    stop_rows(part.reach, part.chain.reach(), emit);
    option_rows(part.reach, emit);
    pole_rows(part, emit);
}

}  // namespace tendril::app
