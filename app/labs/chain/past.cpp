// The past of the Chain lab: a joint's swing or twist, or the distance from tip to target; poses; incidents
// and their causes. It can be saved as a trace.
#include "app/labs/kit/past.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <utility>

#include "app/document/argument.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/flips.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace {

/// Degrees between a joint's bone and the one before it; at the root, from the rest direction.
double swing_of(const ChainPart& part, std::size_t joint) {
    const auto segments = part.chain.segments();
    if (joint + 1 >= segments.size()) return no_value;
    const glm::vec3 bone = segments[joint + 1].position - segments[joint].position;
    const glm::vec3 parent =
        joint > 0 ? segments[joint].position - segments[joint - 1].position : part.chain.default_direction();
    return glm::degrees(ik::angle_between(parent, bone));
}

/// Degrees about the bone. Known only along a curve and with limits; otherwise the solver keeps no rotations.
double twist_of(const ChainPart& part, std::size_t joint) {
    const auto& rotations = part.reach.state.rotations;
    const bool kept = part.mode == ChainMode::Curve || !part.reach.limits.empty();
    if (!kept || joint >= rotations.size()) return no_value;
    const glm::quat parent = joint > 0 ? rotations[joint - 1] : glm::quat(1, 0, 0, 0);
    return glm::degrees(ik::measure(limit_of(part.reach, joint), part.chain.default_direction(),
                                    glm::conjugate(parent) * rotations[joint])
                            .twist);
}

PastCurve error_curve(const Workspace& workspace) {
    return {.name = "tip to target",
            .unit = "m",
            .lowest_range = 0.01f * std::max(chain_part(workspace).chain.reach(), 1e-3f),
            .missing = "The chain has no joint: add one.",
            .value = [](const SharedPart& part) -> double {
                const ChainPart& then = part_as<ChainPart>(part);
                if (then.chain.empty()) return no_value;
                return glm::distance(then.chain.position(then.chain.size() - 1), then.target);
            }};
}

/// Plots the selected joint, or joint 1: an arm's elbow.
PastCurve joint_curve(const Workspace& workspace, const char* what, const char* missing,
                      double (*value)(const ChainPart&, std::size_t)) {
    const std::size_t joint = chain_part(workspace).selection.active().value_or(1);
    return {.name = what + std::to_string(joint), .missing = missing, .value = [=](const SharedPart& part) {
                return value(part_as<ChainPart>(part), joint);
            }};
}

/// The same number of joints, and bones of the same lengths within an engine log's rounding.
bool same_joints(const Part& then, const Part& now) {
    const auto a = own_chain(part_as<ChainPart>(then)).segments(),
               b = own_chain(part_as<ChainPart>(now)).segments();
    return std::ranges::equal(a, b, [&](const Segment& x, const Segment& y) {
        return &x == &a.front() || std::abs(x.length - y.length) <= 0.01f * y.length;
    });
}

/// One line for each bone; none for long chains.
PoseLines lines_of(const Workspace&, const SharedPart& part) {
    const auto segments = part_as<ChainPart>(part).chain.segments();
    PoseLines lines;
    if (segments.size() > max_studied_segments) return lines;
    for (std::size_t i = 1; i < segments.size(); ++i)
        lines.emplace_back(segments[i - 1].position, segments[i].position);
    return lines;
}

/// The end of its range that each angle of a joint is at: -1, 0 (between), 1.
using Sides = std::array<int, 3>;

int side_of(float angle, float low, float high) {
    constexpr float at = 0.035f;  // radians: two degrees from the end count as at it
    if (high - low <= 2.0f * at) return 0;
    return angle <= low + at ? -1 : angle >= high - at ? 1 : 0;
}

Sides sides_of(const ChainPart& part, std::size_t bone) {
    const ik::Limit& limit = part.reach.limits[bone];
    const auto& rotations = part.reach.state.rotations;
    if (limit.kind == ik::JointKind::Free || bone >= rotations.size()) return {};
    const glm::quat parent = bone > 0 ? rotations[bone - 1] : glm::quat(1, 0, 0, 0);
    const ik::JointAngles angles =
        ik::measure(limit, part.chain.default_direction(), glm::conjugate(parent) * rotations[bone]);
    if (limit.kind == ik::JointKind::Hinge) return {side_of(angles.up, limit.min, limit.max)};
    return {side_of(angles.up, -limit.down, limit.up), side_of(angles.left, -limit.right, limit.left),
            side_of(angles.twist, limit.twist_min, limit.twist_max)};
}

/// True if an angle went from one end of its range to the other.
bool limit_switched(const ChainPart& before, const ChainPart& after) {
    for (std::size_t bone = 0; bone < after.reach.limits.size(); ++bone) {
        const Sides was = sides_of(before, bone), is = sides_of(after, bone);
        if (std::inner_product(was.begin(), was.end(), is.begin(), false, std::logical_or<>(),
                               [](int a, int b) { return a * b < 0; }))
            return true;
    }
    return false;
}

ik::ReachPose reach_pose(const ChainPart& part) {
    ik::ReachPose pose{.target = part.target, .pole = part.reach.options.pole};
    for (const Segment& segment : part.chain.segments()) pose.joints.push_back(segment.position);
    return pose;
}

/// Why a chain flipped: by what the poses show or, failing that, by what the solver did.
struct FlipReason {
    std::string cause;
    FlipAdvice advice;
};

FlipReason reason_of(const ChainPart& before, const ChainPart& after, const ik::ReachPose& was,
                     const ik::ReachPose& is) {
    using enum ik::FlipCause;
    const ik::FlipCause seen = ik::flip_cause(was, is);
    if (seen != ThroughRoot && seen != PassedPole) {
        if (after.result->report.restarts > 0)
            return {"the solver restarted from another pose",
                    {"Without restarts the solver continues from its current pose.", FlipCure::NoRestarts}};
        if (limit_switched(before, after))
            return {"a limit switched sides", {"Narrow that limit: both its ends are equally good here."}};
    }
    const FlipAdvice advice = flip_advice(seen, after.reach.options.pole.has_value());
    if (seen == Unexplained) return {"the solver switched to another pose that the target allows", advice};
    return {ik::text(seen), advice};
}

std::optional<Incident> flip(const ChainPart& before, const ChainPart& after) {
    const ik::ReachPose was = reach_pose(before), is = reach_pose(after);
    const auto turn = ik::find_flip(was, is, after.flips);
    if (!turn) return std::nullopt;
    const FlipReason reason = reason_of(before, after, was, is);
    Incident incident{.kind = Incident::Kind::Flip,
                      .joint = turn->joint,
                      .degrees = glm::degrees(turn->radians),
                      .cause = reason.cause,
                      .cure = reason.advice.cure};
    if (auto cure = flip_cure(reason.advice.button, before, after))
        incident.buttons.push_back(std::move(*cure));
    return incident;
}

/// "Out of reach: the target is out of reach, ...": the verdict and the meaning of its status.
std::string status_cause(const ChainPart& part) {
    const std::string verdict = chain_verdict(part).text;
    return verdict.substr(0, verdict.find(':')) + ": " + status_text(part);
}

/// True if only target and pole target differ: the same chain, with the same settings.
bool comparable(const ChainPart& before, const ChainPart& after) {
    const Chain &a = before.chain, &b = after.chain;
    if (before.mode != ChainMode::Reach || after.mode != ChainMode::Reach) return false;
    if (before.study.open() || after.study.open() || !after.result) return false;
    if (a.size() != b.size() || a.size() < 2 || a.position(0) != b.position(0)) return false;
    const ik::Options &was = before.reach.options, &is = after.reach.options;
    if (before.reach.method != after.reach.method || before.reach.limits != after.reach.limits ||
        was.pole_turn != is.pole_turn || was.twist != is.twist || was.pole.has_value() != is.pole.has_value())
        return false;
    if (before.target == after.target && was.pole == is.pole) return false;
    return std::equal(a.segments().begin(), a.segments().end(), b.segments().begin(),
                      [](const Segment& x, const Segment& y) { return x.length == y.length; });
}

std::vector<Incident> jumps(const ChainPart& before, const ChainPart& after) {
    const auto& report = after.along.report;
    if (before.mode != ChainMode::Curve || before.curve == after.curve || !report || !report->jumped)
        return {};
    return {{.kind = Incident::Kind::Jump,
             .joint = *report->jumped,
             .cause = jump_cause(before, after),
             .cure = "Open that bend, or use shorter bones there."}};
}

/// The incidents between two states of a chain, one solve apart. A flip: only the target or pole target
/// moved, and little (FlipRule), but a bone turned by more than the rule allows. Also changes in the solver's
/// report. None outside mode Reach, nor while a study is open, since its solves start elsewhere.
///
/// A flip's joint is whichever end of the bone that turned furthest moved further: an arm's elbow.
std::vector<Incident> incidents_of(const Workspace&, const Part& was, const Part& is) {
    const auto &before = part_as<ChainPart>(was), &after = part_as<ChainPart>(is);
    if (after.mode == ChainMode::Curve) return jumps(before, after);
    if (!comparable(before, after)) return {};
    std::vector<Incident> incidents;
    const ik::Report& report = after.result->report;
    if (auto jumped = flip(before, after)) {
        incidents.push_back(std::move(*jumped));
    } else if (report.restarts > 0 && before.result && before.result->report.restarts == 0) {
        incidents.push_back({.kind = Incident::Kind::Restart,
                             .joint = after.chain.size() - 1,
                             .cause = "the solver restarted from " +
                                      count_text(static_cast<std::size_t>(report.restarts), "other pose")});
    }
    const auto& limit = after.result->active_limit;
    const auto joint_before = before.result && before.result->active_limit
                                  ? std::optional(before.result->active_limit->joint)
                                  : std::nullopt;
    if (limit && joint_before != limit->joint) {
        incidents.push_back({.kind = Incident::Kind::Limit,
                             .joint = limit->joint,
                             .degrees = glm::degrees(limit->limit),
                             .cause = active_limit_text(*limit)});
    } else if (before.result && before.result->report.status != report.status) {
        incidents.push_back(
            {.kind = Incident::Kind::Status, .joint = after.chain.size() - 1, .cause = status_cause(after)});
    }
    return incidents;
}

/// The strip's moments as a trace, from the moment when the chain got its present number of joints.
std::string trace_of_strip(const Workspace& workspace) {
    const ChainPart& now = chain_part(workspace);
    if (now.chain.size() < 2) throw Refused("the chain has no bone");
    const bool reaches = now.mode == ChainMode::Reach;
    std::string text = Json{{"tendril", "trace"},
                            {"up", "y"},
                            {"handed", "right"},
                            {"unit", "m"},
                            {"fps", 1.0 / tick_seconds}}
                           .dump() +
                       '\n';
    const auto write = [&](const ChainPart& part, std::uint64_t tick) {
        if (part.chain.size() != now.chain.size()) return;
        Json frame{{"t", static_cast<double>(tick) * tick_seconds}};
        for (const Segment& each : part.chain.segments()) frame["joints"].push_back(point(each.position));
        if (reaches) frame["target"] = point(part.target);
        if (reaches && part.reach.options.pole) frame["pole"] = point(*part.reach.options.pole);
        text += frame.dump() + '\n';
    };
    for (const Rewind::Moment& each : workspace.rewind.moments())
        write(dynamic_cast<const ChainPart&>(*each.part), each.tick);
    if (workspace.later_ticks() == 0 &&
        (workspace.rewind.empty() || workspace.rewind.newest() < workspace.moment))
        write(now, workspace.moment);
    return text;
}

}  // namespace

const Past& chain_past() {
    static const Past past{
        .lab = chain_lab,
        .what = "chain",
        .probes = {{"error", "tip to target", error_curve},
                   {"swing", "swing of a joint",
                    [](const Workspace& w) {
                        return joint_curve(w, "swing of joint ", "Select a joint with a bone after it.",
                                           swing_of);
                    }},
                   {"twist", "twist of a joint",
                    [](const Workspace& w) {
                        return joint_curve(w, "twist of joint ",
                                           "Twist is only known along a curve and within limits.", twist_of);
                    }}},
        .plot_help = "Plotted below the scene over the last ten seconds; angles are at the selected joint",
        .ghosts_help = "Shows the chain's pose at every half second",
        .pose = lines_of,
        .same_joints = same_joints,
        .incidents = incidents_of};
    return past;
}

void add_save_trace_command(CommandTable& table) {
    table.add("chain.save_trace", "Save the strip as a trace",
              {text_argument("path", false, "a JSON Lines file; default: beside the scene")},
              "Writes the last ten seconds of the chain, frame by frame, as tendril trace reads them",
              Effect::Look, [](Workspace& workspace, const Arguments& given) {
                  const std::string path = given.has("path")
                                               ? given.text("path")
                                               : new_file(workspace, "trace", ".jsonl").string();
                  workspace.writes().write(path, OutputKind::Trace, trace_of_strip(workspace));
                  workspace.toast(written_text(path));
              });
}

}  // namespace tendril::app
