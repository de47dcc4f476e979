// The held object in the picture, under the mouse and in the panel.
#include <imgui.h>

#include "app/document/json_complete.hpp"
#include "app/fields/field_rows.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/lists.hpp"

namespace tendril::app {

Handle hold_handle(const HoldSetting& setting, const ShownPose& shown) {
    const humanoid::ObjectPose asked = setting.asked(shown.hips);
    return {"object",
            hold_pick,
            {glm::vec3(asked.position), glm::quat(asked.rotation)},
            Drag::Position | Drag::Rotation};
}

void drag_hold(const HoldSetting& setting, const ShownPose& shown, const Handle::Frame& to, Emit& emit) {
    const Handle::Frame from = hold_handle(setting, shown).frame;
    ArgumentList arguments;
    if (to.position != from.position) arguments.push_back({"to", to.position});
    if (to.rotation != from.rotation) arguments.push_back({"rotation", to.rotation});
    if (!arguments.empty()) emit.continuously("humanoid.hold_move", arguments);
}

void draw_hold(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown) {
    if (!part.ik.hold || !shown.hold) return;
    const HoldSetting& setting = *part.ik.hold;
    const humanoid::HoldReport& report = *shown.hold;
    const auto px = [&](float pixels) { return pixels * view.scale; };
    const bool marks = view.dragged == hold_pick || view.hovered == hold_pick;
    const std::vector<HeldBar> shape = held_shape(setting, part.loaded->height());
    const auto placed = [](const humanoid::ObjectPose& at, const glm::dvec3& point) {
        return glm::vec3(at.position + at.rotation * point);
    };
    const glm::vec3 own = glm::mix(view.palette.neutral, view.palette.text, 0.35f);
    const glm::vec4 paint(marks ? glm::mix(own, view.palette.accent, 0.6f) : own, 1.0f);
    for (const HeldBar& bar : shape) {
        const auto radius = static_cast<float>(bar.radius);
        Stroke& stroke =
            list.bone(placed(report.object, bar.from), placed(report.object, bar.to), radius, radius, paint);
        stroke.pick = hold_pick;
        stroke.shadow = true;
    }
    const humanoid::ObjectPose asked = setting.asked(shown.hips);
    if (gives_way(report)) {
        for (const HeldBar& bar : shape)
            list.line(placed(asked, bar.from), placed(asked, bar.to), px(1.2f),
                      faded(view.palette, view.palette.target, 0.7f));
        list.line(glm::vec3(report.object.position), glm::vec3(asked.position), px(1.6f),
                  glm::vec4(view.palette.limit, 1.0f))
            .layer = Layer::Overlay;
    }
    if (!view.handles) return;
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const humanoid::GripReport& grip = report.grips[hand];
        if (!grip.holds) continue;
        const glm::vec3 wrist = shown.point(*part.node_of(humanoid::bone_of(both_hands[hand])));
        list.ring(wrist, px(8.0f), px(1.8f),
                  glm::vec4(is_closed(grip) ? view.palette.tail : view.palette.limit, 1.0f))
            .layer = Layer::Overlay;
    }
    Stroke& ball = list.sphere(glm::vec3(asked.position), px(marks ? 9.5f : 8.0f), Unit::Pixels,
                               glm::vec4(view.palette.target, 1.0f));
    ball.pick = hold_pick;
    ball.rank = 5;
    ball.layer = Layer::Overlay;
    if (marks)
        list.labels.push_back({.at = glm::vec3(asked.position),
                               .clearance = px(16.0f),
                               .text = held_kinds.title(setting.kind),
                               .colour = view.palette.text,
                               .rank = 3});
}

void hold_rows(const HumanoidPanel& panel) {
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    const auto& hold = panel.part.ik.hold;
    if (!hold) {
        if (!why.empty()) return note("Full-body IK is off: " + why + ".");
        std::vector<const char*> titles{"nothing"};
        for (const char* each : held_kinds.titles()) titles.push_back(each);
        int chosen = 0;
        if (choice_field("object", chosen, titles.data(), static_cast<int>(titles.size())) && chosen > 0)
            panel.emit("humanoid.hold", {{"kind", held_kinds.name(static_cast<HeldKind>(chosen - 1))}});
        explain("What both hands hold.");
        return;
    }
    FieldRows(*hold, "humanoid.hold", panel.emit).rows("kind", "size", "hands", "with_body");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    std::string told = why.empty() ? shown.refused : "Full-body IK is off: " + why + ".";
    if (shown.hold) {
        const Verdict verdict = hold_verdict(*hold, *shown.hold);
        told = verdict.text + ". " + verdict.why;
    }
    kept_note("held", told, 3);
    if (row_button("Let go", 1, true, "Takes the hands off the object")) panel.emit("humanoid.release");
    end_row();
}

}  // namespace tendril::app
