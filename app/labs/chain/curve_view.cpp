// Mode Curve in the scene and in the panels.
#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/document/units.hpp"
#include "app/fields/field_rows.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/chain/presets.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

class CurveDrawing {
  public:
    CurveDrawing(const View& view, const ChainPart& part, DrawList& list)
        : view_(view), part_(part), curve_(part.curve), list_(list) {}

    void run() {
        const CurvePen pen(view_, curve_.points, curve_.options.kind, first_curve_pick, view_.palette.target,
                           2, list_);
        pen.line();
        const Selection& selection = part_.along.selection;
        for (std::size_t i = 0; i < curve_.points.size(); ++i)  // over the joints: the first is on the root
            pen.control(i, control_pick(i), selection.has(i), selection.active() == i);
        if (curve_frames().chosen(view_.workspace.settings) == 1) frames();
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }

    /// Draws each bone's frame at its middle: the directions up and right.
    void frames() {
        const auto& rotations = part_.reach.state.rotations;
        const glm::vec3 rest = part_.chain.default_direction();
        glm::vec3 side = glm::cross(curve_.options.up, rest);
        if (!(glm::length(side) > 1e-6f * glm::length(curve_.options.up)))
            side = glm::cross(std::abs(rest.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), rest);
        const glm::vec3 right = glm::normalize(side), upper = glm::cross(rest, right);
        for (std::size_t i = 0; i < rotations.size() && i + 1 < part_.chain.size(); ++i) {
            const glm::vec3 at = 0.5f * (part_.chain.position(i) + part_.chain.position(i + 1));
            const float most = px(42.0f) * view_.camera.metres_per_pixel(at);
            const float length = std::min(std::max(0.8f * part_.chain.length(i + 1), 0.5f * most), most);
            list_.line(at, at + length * (rotations[i] * upper), px(2.5f),
                       glm::vec4(view_.palette.axis_y, 1.0f));
            list_.line(at, at + 0.6f * length * (rotations[i] * right), px(2.0f),
                       glm::vec4(view_.palette.axis_z, 1.0f));
        }
    }

    const View& view_;
    const ChainPart& part_;
    const CurveSettings& curve_;
    DrawList& list_;
};

}  // namespace

std::optional<float> picked_on_curve(const ChainPart& part, PickId pick) {
    if (pick < first_curve_pick) return std::nullopt;
    return CurvePen::place(static_cast<std::size_t>(pick - first_curve_pick), part.curve.points.size());
}

void draw_curve(const View& view, const ChainPart& part, DrawList& list) {
    if (part.curve.points.size() >= 2) CurveDrawing(view, part, list).run();
}

LabSetting curve_frames() {
    return {.key = "curve frames",
            .command = "view.curve_frames",
            .title = "Show or hide the bones' frames",
            .argument = "show",
            .help = "Shows how each bone is rolled, in mode curve",
            .choices = {{"off", "hidden"}, {"on", "shown"}}};
}

// The panels.

void curve_rows(const ChainPart& part, MoreRows& more, Emit& emit) {
    for (const Preset& preset : presets())
        if (preset.curved()) preset_button(preset, 3, emit);
    end_row();
    FieldRows(part.curve, "chain.curve", emit)
        .under(more)
        .rows("kind", "weight", "roll_start", "roll_end", "fit", "max_factor", "falloff", "up");
}

Verdict curve_verdict(const ChainPart& part) {
    if (!part.along.report) return {"One joint", Verdict::Kind::Open};
    const ik::CurveReport& report = *part.along.report;
    if (report.collapsed) return {"All points coincide", Verdict::Kind::Bad};
    if (report.status == ik::Status::Stretched)
        return {"Past the end: " + distance_text(report.past_end), Verdict::Kind::Bad};
    if (part.curve.options.weight < 1.0f || part.curve.falloff != 0.0f)
        return {"Between pose and curve", Verdict::Kind::Open};
    return {"On the curve", Verdict::Kind::Good};
}

void curve_report_rows(const ChainPart& part, const Palette& palette, Emit& emit) {
    show_verdict(curve_verdict(part), palette, emit, {.verdict = 1, .notes = 3, .paragraphs = 2},
                 [&part, &emit] {
                     if (!part.along.report) return note("A chain needs two joints to lie on a curve.");
                     const ik::CurveReport& report = *part.along.report;
                     const std::size_t past = report.bones_past_end;
                     note(report.collapsed ? "The curve has no direction: drag a control point away."
                          : past == 0      ? "Every joint lies on the curve."
                                           : count_text(past, "bone") + (past == 1 ? " goes" : " go") +
                                            " on straight past its last point.");
                     if (past == 0 || part.curve.options.fit) return;
                     cure_line("",
                               Cure{"Fit",
                                    "Runs chain.curve: scales the bones so that the tip is on the last "
                                    "control point",
                                    {{"chain.curve", {{"fit", true}}}}},
                               emit);
                 });
    if (!part.along.report) return;
    if (part.curve.options.fit)
        reading("bones scaled by", "%.4f", static_cast<double>(part.along.report->factor));
}

void control_rows(const ChainPart& part, Emit& emit) {
    const std::vector<std::size_t>& all = part.along.selection.all();
    if (all.size() > 1) return reading("control points", "%zu", all.size());
    reading("control point", "%zu", all.front());
    std::vector<glm::vec3> points = part.curve.points;
    if (point_field("at", points[all.front()], 0.01f)) emit_points(part, std::move(points), emit);
    explain("Where the control point is. It can be dragged in the scene too.");
}

}  // namespace tendril::app
