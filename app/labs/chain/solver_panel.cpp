#include <imgui.h>

#include <algorithm>

#include "app/labs/chain/panels.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void with(Emit& emit, const char* name, ArgumentValue value) {
    emit.continuously("chain.solver", {{name, std::move(value)}});
}

/// A row of an option, and what it does; grey, with the reason, where the method does not honour it.
template <class Row>
void option_row(const ReachSettings& reach, ik::Option option, const std::string& help, const Row& row) {
    const bool limited = !reach.limits.empty();
    const bool honoured = ik::honours(reach.method, option, limited);
    ImGui::BeginDisabled(!honoured);
    row();
    ImGui::EndDisabled();
    if (honoured) return explain(help.c_str());
    const std::string why =
        help + ' ' + std::string(solver_title(reach.method)) + " does not use this" +
        (ik::honours(reach.method, option, !limited) ? limited ? " within limits" : " without joint limits"
                                                     : "");
    explain((why + ".").c_str());
}

void stop_rows(const ReachSettings& reach, float length, Emit& emit) {
    option_row(reach, ik::Option::MaxIterations,
               "The maximum of iterations in a solve. More come nearer to the target and cost more.", [&] {
                   int iterations = reach.iterations;
                   if (integer_field("iterations", iterations, 1, max_iterations))
                       with(emit, "iterations", iterations);
               });
    float tolerance = reach_tolerance(reach, length);
    if (number_field("tolerance", tolerance, 0.0002f, 0.0f, 10.0f, "%.4f m"))
        with(emit, "tolerance", tolerance);
    explain("How far from the target the tip may be when the solver stops. Less takes more iterations.");
    if (row_button("Default tolerance", 1, reach.tolerance.has_value(), "A thousandth of the reach"))
        emit("chain.solver", {{"default_tolerance", true}});
}

void option_rows(const ReachSettings& reach, Emit& emit) {
    const auto number_row = [&](ik::Option option, const char* title, const char* name, float value,
                                float speed, float low, float high, const char* format, const char* help) {
        option_row(reach, option, help, [&] {
            if (number_field(title, value, speed, low, high, format)) with(emit, name, value);
        });
    };
    number_row(
        ik::Option::SnapBack, "rest blend", "snap_back", reach.snap_back, 0.005f, 0.0f, 1.0f, "%.2f",
        "Snap-back: before a solve each joint is blended this far towards its rest direction. More keeps the "
        "chain nearer to its rest pose.");
    number_row(ik::Option::SoftZone, "soft zone", "soft_zone", reach.soft_zone, 0.002f, 0.0f, 1.0f,
               "%.3f of reach",
               "The zone before full reach in which the chain eases off instead of snapping straight.");
    number_row(ik::Option::Damping, "damping", "damping", reach.damping, 0.001f, min_damping, max_damping,
               "%.3f of reach",
               "Damping of the two damped solvers. More is calmer near a singularity, and slower.");
    number_row(ik::Option::Twist, "twist", "twist_deg", reach.twist_deg, 0.5f, -180.0f, 180.0f, "%.0f deg",
               "Turns the bend of the two bones about the line from root to tip.");
    option_row(
        reach, ik::Option::Restarts,
        "Within joint limits: from how many other poses the solver restarts where it ends short of the "
        "target. More reach it more often; the chain may jump.",
        [&] {
            int restarts = reach.restarts.value_or(default_restarts);
            if (integer_field("restarts", restarts, 0, max_restarts)) with(emit, "restarts", restarts);
        });
    ImGui::BeginDisabled(!ik::honours(reach.method, ik::Option::Restarts, !reach.limits.empty()));
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
    option_row(
        part.reach, ik::Option::PoleTurn,
        "How the chain turns to its pole target: all joints at once, which is smooth, or each between "
        "its neighbours.",
        [&] {
            const auto titles = pole_turns.titles();
            int turn = static_cast<int>(part.reach.pole_turn);
            if (choice_field("turns", turn, titles.data(), static_cast<int>(titles.size())))
                emit("chain.solver", {{"pole_turn", pole_turns.name(static_cast<ik::PoleTurn>(turn))}});
        });
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
