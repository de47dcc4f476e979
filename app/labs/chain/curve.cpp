#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "app/fields/field_rows.hpp"
#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/widgets/fields.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept {
    static const std::vector<Field> rows = [] {
        const std::span<const Field> shape = fields<app::CurveShape>();
        std::vector<Field> all(shape.begin(), shape.end());
        all.push_back(app::field_in<&app::CurveShape::options, &ik::CurveOptions::up>());
        return all;
    }();
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<CurveSettings>() {
    static const std::vector<FieldText> texts = [] {
        const std::span<const FieldText> shape = field_texts<CurveShape>();
        std::vector<FieldText> all(shape.begin(), shape.end());
        all.push_back({.name = "up",
                       .label = "up",
                       .help = "The direction of the bones' upper side at the curve's beginning.",
                       .in_line = true,
                       .more = true});
        return all;
    }();
    return texts;
}

const Chain& own_chain(const ChainPart& part) {
    return part.mode == ChainMode::Curve ? part.along.given : part.chain;
}

namespace {

/// Five of the chain's joints, evenly spread; all joints if it has fewer.
std::vector<glm::vec3> points_through(const Chain& chain) {
    const std::size_t bones = chain.size() - 1, spans = std::min<std::size_t>(bones, 4);
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i <= spans; ++i) points.push_back(chain.position(i * bones / spans));
    return points;
}

/// True if only control points changed. If so, a joint that moves further than the curve has jumped.
bool only_points_moved(const ChainPart& before, const ChainPart& after) {
    const ik::CurveOptions &was = before.curve.options, &is = after.curve.options;
    return before.mode == ChainMode::Curve && before.along.given == after.along.given &&
           was.kind == is.kind && was.fit == is.fit && was.max_factor == is.max_factor;
}

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

void follow_curve(ChainPart& part) {
    const CurveSettings& curve = part.curve;
    AlongCurve& along = part.along;
    part.chain = along.given;
    along.report.reset();
    if (along.given.size() < 2) return;
    if (curve.points.empty()) part.curve.points = points_through(along.given);

    const std::size_t bones = along.given.size() - 1;
    std::vector<float> lengths;
    for (const Segment& each : along.given.segments().subspan(1)) lengths.push_back(each.length);
    const std::vector<glm::vec3> rest(bones, along.given.default_direction());
    const std::vector<float> weights = curve_weights(curve, bones);
    std::vector<glm::vec3> joints = positions(along.given);
    part.reach.state = ik::State(bones);
    if (along.memory.at.size() != joints.size()) along.memory = ik::CurveMemory(bones);
    along.report = ik::place_along(curve.points, {lengths, rest}, joints, part.reach.state, along.memory,
                                   curve.with(weights));
    if (along.report->status == ik::Status::InvalidInput)
        throw std::invalid_argument("the chain cannot be placed along this curve");

    std::vector<Segment> segments{{joints.front(), along.given.length(0)}};
    for (std::size_t i = 0; i < bones; ++i) {
        const float weight = curve.options.weight * (weights.empty() ? 1.0f : weights[i]);
        segments.push_back({joints[i + 1], lengths[i] * (1.0f + weight * (along.report->factor - 1.0f))});
    }
    part.chain = require_value(Chain::from_segments(std::move(segments), along.given.default_direction()));
    part.target = curve.points.back();
}

void keep_on_curve(ChainPart& part, const ChainPart& before) {
    if (part.mode != ChainMode::Curve) {
        part.along = {};
        return;
    }
    part.along.given = part.chain;
    if (!only_points_moved(before, part)) {
        part.along.memory = {};
    } else if (part.curve == before.curve && part.reach.state == before.reach.state) {
        part.chain = before.chain;
        return;
    }
    follow_curve(part);
    part.along.selection.keep_below(part.curve.points.size());
}

void remove_selected_points(ChainPart& part) {
    std::vector<glm::vec3> left;
    for (std::size_t i = 0; i < part.curve.points.size(); ++i)
        if (!part.along.selection.has(i)) left.push_back(part.curve.points[i]);
    if (left.size() < 2) throw Refused("a curve needs two control points");
    part.curve.points = std::move(left);
    part.along.selection.clear();
}

std::string jump_cause(const ChainPart& before, const ChainPart& after) {
    const std::size_t joint = *after.along.report->jumped;
    const std::string bone = "bone " + std::to_string(joint - 1) + "'s length away";
    return after.along.memory.at[joint] > before.along.memory.at[joint]
               ? "the curve turns back here before it is " + bone + "; the joint jumped to the next crossing"
               : "the curve is " + bone + " earlier than before; the joint jumped back to that crossing";
}

// The command and the file.

namespace {

void set_curve(ChainPart& part, const Arguments& given) {
    if (given.has("points")) {
        part.curve.points =
            read_control_points(JsonPlace(given.json("points"), "points"), max_control_points);
        if (part.curve.points.size() < 2) throw Refused("points: a curve needs two control points");
    }
    set_fields(given, part.curve);
}

}  // namespace

Json save_curve(const CurveSettings& settings) {
    Json json = save_fields(settings);
    json["points"] = points_json(settings.points);
    return json;
}

CurveSettings load_curve(const JsonPlace& place) {
    CurveSettings settings;
    load_fields(place, settings);
    settings.points = read_control_points(place["points"], max_control_points);
    if (settings.points.size() == 1) place["points"].fail("a curve needs two control points");
    return settings;
}

void add_curve_command(CommandTable& table) {
    std::vector<Argument> arguments = field_arguments<CurveSettings>();
    arguments.insert(arguments.begin(), {.name = "points",
                                         .type = ArgumentType::List,
                                         .required = false,
                                         .help = "its control points, in metres; at least two"});
    table.add(chain_command("chain.curve", "Set the curve", std::move(arguments),
                            "Sets the curve that the chain follows in mode curve", set_curve));
}

// Mode Curve in the scene and in the panels.

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
    explain("The control point's position. It can be dragged in the scene too.");
}

}  // namespace tendril::app
