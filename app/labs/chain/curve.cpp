#include "app/labs/chain/curve.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/fields/field_in.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/kit/arguments.hpp"

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
                       .help = "Where the upper side of the bones faces at the curve's beginning.",
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

/// Five of the chain's joints, evenly spread; all joints of a shorter chain.
std::vector<glm::vec3> points_through(const Chain& chain) {
    const std::size_t bones = chain.size() - 1, spans = std::min<std::size_t>(bones, 4);
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i <= spans; ++i) points.push_back(chain.position(i * bones / spans));
    return points;
}

/// Whether only control points changed, so that a joint that moves further than the curve has jumped.
bool only_points_moved(const ChainPart& before, const ChainPart& after) {
    const ik::CurveOptions &was = before.curve.options, &is = after.curve.options;
    return before.mode == ChainMode::Curve && before.along.given == after.along.given &&
           was.kind == is.kind && was.fit == is.fit && was.max_factor == is.max_factor;
}

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
               ? "the curve turns back here before it is " + bone + "; the joint went on to where it is"
               : "the curve is " + bone + " earlier than before; the joint went back to there";
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

}  // namespace tendril::app
