#include "app/labs/chain/curve.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/kit/arguments.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::CurveSettings>() noexcept {
    using app::CurveSettings;
    static constexpr auto kinds = app::curve_kinds.name_array();
    static constexpr Field rows[] = {
        field<&CurveSettings::kind>("kind", kinds),
        field<&CurveSettings::fit>("fit"),
        field<&CurveSettings::max_factor>("max_factor", {1.001, 100.0}),
        field<&CurveSettings::weight>("weight"),
        field<&CurveSettings::falloff>("falloff", {-1.0, 1.0}),
        field<&CurveSettings::up>("up", {-max_magnitude, max_magnitude}),
        field<&CurveSettings::roll_start_deg>("roll_start_deg", {-3600.0, 3600.0}, "deg"),
        field<&CurveSettings::roll_end_deg>("roll_end_deg", {-3600.0, 3600.0}, "deg")};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<CurveSettings>() {
    static constexpr FieldText texts[] = {
        {.name = "kind",
         .label = "curve",
         .help = "How the curve passes its control points.",
         .listed = true,
         .choices = curve_kinds.rows},
        {.name = "fit",
         .label = "fit to the curve",
         .help = "Scales all bones by one factor, so that the tip lies on the last control point."},
        {.name = "max_factor",
         .label = "at most",
         .help = "The largest factor of the fit; its inverse is the smallest.",
         .more = true},
        {.name = "weight",
         .label = "weight",
         .help = "How far the bones turn from the pose that the chain had before to the curve.",
         .step = 0.005f},
        {.name = "falloff",
         .label = "falloff",
         .help = "How much less the first bones follow the curve than the last; below 0, the last bones than "
                 "the first.",
         .step = 0.005f,
         .more = true},
        {.name = "roll_start_deg",
         .label = "roll at the root",
         .help = "How far the first bone is rolled about itself.",
         .step = 0.5f,
         .decimals = 0},
        {.name = "roll_end_deg",
         .label = "roll at the tip",
         .help = "How far the last bone is rolled; between them the roll is spread by length.",
         .step = 0.5f,
         .decimals = 0},
        {.name = "up",
         .label = "up",
         .help = "Where the upper side of the bones faces at the curve's beginning.",
         .in_line = true,
         .more = true}};
    return texts;
}

const Chain& own_chain(const ChainPart& part) {
    return part.mode == ChainMode::Curve ? part.along.given : part.chain;
}

std::vector<float> curve_weights(const CurveSettings& settings, std::size_t bones) {
    std::vector<float> weights;
    if (settings.falloff == 0.0f || bones < 2) return weights;
    for (std::size_t i = 0; i < bones; ++i) {
        const float along = static_cast<float>(i) / static_cast<float>(bones - 1);
        weights.push_back(
            1.0f - (settings.falloff > 0.0f ? settings.falloff * (1.0f - along) : -settings.falloff * along));
    }
    return weights;
}

ik::CurveOptions curve_options(const CurveSettings& settings, std::span<const float> weights) {
    return {.kind = settings.kind,
            .fit = settings.fit,
            .max_factor = settings.max_factor,
            .up = settings.up,
            .roll_start = glm::radians(settings.roll_start_deg),
            .roll_end = glm::radians(settings.roll_end_deg),
            .weight = settings.weight,
            .weights = weights};
}

namespace {

/// Five joints of the chain, evenly spread, or all of a shorter one.
std::vector<glm::vec3> points_through(const Chain& chain) {
    const std::size_t bones = chain.size() - 1, spans = std::min<std::size_t>(bones, 4);
    std::vector<glm::vec3> points;
    for (std::size_t i = 0; i <= spans; ++i) points.push_back(chain.position(i * bones / spans));
    return points;
}

/// Whether a joint that moves further than the curve has jumped: the control points alone differ.
bool only_points_moved(const ChainPart& before, const ChainPart& after) {
    const CurveSettings &was = before.curve, &is = after.curve;
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
    const ik::CurveOptions options = curve_options(curve, weights);
    std::vector<glm::vec3> joints = positions(along.given);
    part.reach.state = ik::State(bones);
    if (along.memory.joints.size() != joints.size()) along.memory = ik::CurveMemory(bones);
    along.report =
        ik::place_along(curve.points, {lengths, rest}, joints, part.reach.state, along.memory, options);
    if (along.report->status == ik::Status::InvalidInput)
        throw std::invalid_argument("the chain cannot be placed along this curve");

    std::vector<Segment> segments{{joints.front(), along.given.length(0)}};
    for (std::size_t i = 0; i < bones; ++i) {
        const float weight = curve.weight * (weights.empty() ? 1.0f : weights[i]);
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

std::vector<glm::vec3> with_point_at(const CurveSettings& settings, float at) {
    std::vector<glm::vec3> points = settings.points;
    const auto before = static_cast<std::ptrdiff_t>(at);
    points.insert(points.begin() + before + 1, ik::curve_point(settings.points, settings.kind, at));
    return points;
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

std::vector<glm::vec3> read_control_points(const JsonPlace& list) {
    std::vector<glm::vec3> points;
    const std::size_t size = list.list_size("control points", max_control_points);
    for (std::size_t i = 0; i < size; ++i) points.push_back(list.element(i).point());
    return points;
}

void set_curve(ChainPart& part, const Arguments& given) {
    if (given.has("points")) {
        part.curve.points = read_control_points(JsonPlace(given.json("points"), "points"));
        if (part.curve.points.size() < 2) throw Refused("points: a curve needs two control points");
    }
    set_fields(given, part.curve);
}

}  // namespace

Json points_json(const std::vector<glm::vec3>& points) {
    Json list = Json::array();
    for (const glm::vec3& each : points) list.push_back(point(each));
    return list;
}

Json save_curve(const CurveSettings& settings) {
    Json json = save_fields(settings);
    json["points"] = points_json(settings.points);
    return json;
}

CurveSettings load_curve(const JsonPlace& place) {
    CurveSettings settings;
    load_fields(place, settings);
    settings.points = read_control_points(place["points"]);
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
