// The Chain lab's part of --state.
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/past.hpp"

namespace tendril::app {
namespace {

/// `json` is how the settings are saved.
Json reach_state(const ChainPart& part, Json json) {
    json.erase("state");
    json.update({{"report", nullptr}, {"active_limit", nullptr}, {"explanation", nullptr}});
    if (!part.result) return json;
    json["report"] = report_json(part.result->method, part.result->report);
    if (part.result->active_limit) {
        json["active_limit"] = save_fields(*part.result->active_limit);
        json["explanation"] = active_limit_text(*part.result->active_limit);
    }
    return json;
}

Json curve_state(const ChainPart& part, Json json) {
    json["selected"] = part.along.selection.all();
    json["rotations"] = Json::array();
    for (const glm::quat& each : part.reach.state.rotations) json["rotations"].push_back(quaternion(each));
    const auto& report = part.along.report;
    if (!report) return json;
    json.update({{"status", ik::name(report->status)},
                 {"bones_past_end", report->bones_past_end},
                 {"past_end", number(report->past_end)},
                 {"short_of_end", number(report->short_of_end)},
                 {"factor", number(report->factor)},
                 {"jumped", report->jumped ? Json(*report->jumped) : Json(nullptr)},
                 {"collapsed", report->collapsed}});
    return json;
}

/// The step under the microscope.
Json microscope_state(const ShownChain& shown) {
    const ChainPart& part = shown.part;
    const Study& study = part.study;
    const Trace& trace = *shown.trace;
    Json json{{"step", study.step}, {"steps", trace.frames()}, {"iteration", trace.iteration(study.step)}};
    json["report"] = report_json(trace.method, trace.report);
    json["moves"] = Json::array();
    for (const ik::Step& step : trace.frame(study.step)) {
        const bool alone = step.neighbour == ik::no_joint;
        json["moves"].push_back({{"phase", ik::name(step.phase)},
                                 {"joint", step.joint},
                                 {"neighbour", alone ? Json(nullptr) : Json(step.neighbour)},
                                 {"from", point(step.from)},
                                 {"to", point(step.to)}});
    }
    const std::vector<glm::vec3> joints = shown_joints(shown);
    json["residual"] = number(shown_residual(part, joints));
    json["positions"] = points_json(joints);
    for (std::size_t i = 0; i < joints.size(); ++i)
        json["lengths"].push_back(number(shown_segment(shown, joints, i).length));
    for (const float residual : trace.residuals) json["residuals"].push_back(number(residual));
    return json;
}

Json race_state(const ShownChain& shown) {
    const Race& race = *shown.race;
    Json json = Json::array();
    for (const Racer& racer : race.racers) {
        Json each = report_json(racer.method, racer.report);
        each["ends_with"] = number(racer.residuals.back());
        each["restored"] = racer.restored;
        each["positions"] = points_json(racer.joints);
        const RacerAt at = racer_at(racer, shown.step());
        each["shown"] = {{"iteration", at.iteration},
                         {"finished", at.finished},
                         {"residual", number(at.error)},
                         {"positions", points_json(at.joints)}};
        json.push_back(std::move(each));
    }
    return json;
}

}  // namespace

Json ChainLab::state(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    const auto segments = part.chain.segments();
    const auto end = [&](bool tail) {
        return segments.empty() ? Json(nullptr)
                                : point(tail ? segments.back().position : segments.front().position);
    };
    const float tolerance =
        part.mode == ChainMode::Reach ? reach_tolerance(part.reach, part.chain.reach()) : part.tolerance;
    Json json = Lab::state(workspace);
    Json list = Json::array(), solve = std::move(json["reach"]), curve = std::move(json["curve"]);
    for (const Segment& segment : segments) list.push_back(save_fields(segment));
    for (const char* const shown_otherwise : {"result", "before", "study", "crossings", "curve"})
        json.erase(shown_otherwise);
    json.update({{"iterations", iterations_of(part, part.mode)},
                 {"tolerance", number(tolerance)},
                 {"head", end(false)},
                 {"tail", end(true)},
                 {"selected", part.chosen_point         ? Json(chain_points.name(*part.chosen_point))
                              : part.selection.active() ? Json(*part.selection.active())
                                                        : Json(nullptr)},
                 {"selection", part.selection.all()},
                 {"reach", number(part.chain.reach())},
                 {"verdict", chain_verdict(part).text},
                 {"motion", motion_paths.name(part.motion.path)},
                 {"past", past_state(workspace, chain_past())},
                 {"segments", std::move(list)}});
    if (part.reach.plane) {
        json["plane"] = {{"normal", point(glm::normalize(part.reach.plane->normal))}};
        json["off_plane"] = number(off_plane(part.chain, part.reach, part.target));
        json["side"] = ik::name(part.reach.state.side);
    }
    if (part.mode == ChainMode::Reach) json["solve"] = reach_state(part, std::move(solve));
    if (part.mode == ChainMode::Curve) json["curve"] = curve_state(part, std::move(curve));
    const ShownChain shown = shown_chain(workspace);
    if (shown.trace) json["microscope"] = microscope_state(shown);
    if (!shown.race) return json;
    json["race"] = race_state(shown);
    json["race_shown"] = {
        {"iteration", shown.step()}, {"iterations", shown.last()}, {"playing", part.study.pace > 0.0f}};
    return json;
}

}  // namespace tendril::app
