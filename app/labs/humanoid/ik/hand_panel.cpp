// The panel's rows of hands that a clip moves, and of what the head looks at.
#include <imgui.h>

#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/panels.hpp"
#include "app/labs/kit/folding.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

const char* hand_name(std::size_t hand) {
    return hand == 0 ? "left" : "right";
}

void curve_fields(const HumanoidPanel& panel, std::size_t hand, const HandCurve& curve) {
    const std::string side = hand_name(hand);
    const auto set = [&](const char* argument, float value) {
        panel.emit.continuously("humanoid.hand_ik", {{"hand", side}, {argument, value}});
    };
    constexpr auto far = static_cast<float>(max_curve);
    auto begin = static_cast<float>(curve.begin), full = static_cast<float>(curve.full),
         until = static_cast<float>(curve.until), end = static_cast<float>(curve.end);
    if (number_field((side + " from").c_str(), begin, 0.005f, 0.0f, full, "%.2f s")) set("begin", begin);
    explain("Until then the hand is the clip's.");
    if (number_field((side + " full from").c_str(), full, 0.005f, begin, until, "%.2f s")) set("full", full);
    explain("From then on the hand is on its target.");
    if (number_field((side + " full to").c_str(), until, 0.005f, full, end, "%.2f s")) set("until", until);
    explain("Until then the hand is on its target; afterwards it goes back to the clip.");
    if (number_field((side + " to").c_str(), end, 0.005f, until, far, "%.2f s")) set("end", end);
    explain("From then on the hand is the clip's.");
}

void hand_row(const HumanoidPanel& panel, std::size_t hand) {
    const TargetSetting* const target = panel.part.ik.hand_target(hand);
    if (target == nullptr) return;
    const std::optional<HandCurve>& curve = panel.part.ik.hand_ik.curves[hand];
    bool timed = curve.has_value();
    const std::string side = hand_name(hand), title = "Weight over the clip, " + side;
    if (ImGui::Checkbox(title.c_str(), &timed))
        panel.emit("humanoid.hand_ik", {{"hand", side}, {"curve", timed}});
    explain("The hand goes to its target and back over the clip's time.");
    if (curve) curve_fields(panel, hand, *curve);
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (!shown.hands) return;
    const humanoid::HandReport& report = shown.hands->hands[hand];
    reading((side + " weight").c_str(), "%.2f%s", report.weight, report.in_view ? "" : ", out of view");
}

}  // namespace

void hand_rows(const HumanoidPanel& panel) {
    if (!folding_section(panel.workspace, "Hands and gaze", panel.emit)) return;
    const IkSettings& ik = panel.part.ik;
    const bool body = panel.runtime.solvers.body(panel.part) != nullptr;
    const std::string no_body =
        "The body solve is off: " + panel.runtime.solvers.why_no_body(panel.part) + ".";
    const FieldRows hands(ik.hand_ik, "humanoid.hand_ik", panel.emit);
    hands.row("on", {.why_not = ik.hand_ik.on || body ? std::string() : no_body});
    if (ik.hand_ik.on) {
        hands.row("view_deg");
        for (std::size_t hand = 0; hand < 2; ++hand) hand_row(panel, hand);
        if (ik.hand_target(0) == nullptr && ik.hand_target(1) == nullptr)
            note("Drag the orange ball of a hand.");
    }
    const FieldRows gaze(ik.look_at, "humanoid.look_at", panel.emit);
    gaze.row("on", {.why_not = ik.look_at.on || body ? std::string() : no_body});
    if (!ik.look_at.on) return;
    gaze.rows("weight", "view_deg");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    if (shown.look && !shown.look->in_view) note("It is out of the cone of view.");
}

}  // namespace tendril::app
