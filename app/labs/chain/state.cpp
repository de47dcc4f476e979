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

Json reach_state(const ChainPart& part) {
    Json json = save_reach(part.reach, part.chain);
    json.erase("state");
    json["report"] = nullptr;
    json["active_limit"] = nullptr;
    json["explanation"] = nullptr;
    if (!part.result) return json;
    json["report"] = report_json(part.result->method, part.result->report);
    if (part.result->active_limit) {
        json["active_limit"] = save_fields(*part.result->active_limit);
        json["explanation"] = active_limit_text(*part.result->active_limit);
    }
    return json;
}

Json curve_state(const ChainPart& part) {
    Json json = save_curve(part.curve);
    json["selected"] = part.along.selection.all();
    json["rotations"] = Json::array();
    for (const glm::quat& each : part.reach.state.rotations) json["rotations"].push_back(quaternion(each));
    const auto& report = part.along.report;
    if (!report) return json;
    json["status"] = ik::name(report->status);
    json["bones_past_end"] = report->bones_past_end;
    json["past_end"] = number(report->past_end);
    json["short_of_end"] = number(report->short_of_end);
    json["factor"] = number(report->factor);
    json["jumped"] = report->jumped ? Json(*report->jumped) : Json(nullptr);
    json["collapsed"] = report->collapsed;
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
    for (std::size_t i = 0; i < joints.size(); ++i) {
        json["positions"].push_back(point(joints[i]));
        json["lengths"].push_back(number(shown_segment(shown, joints, i).length));
    }
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
        for (const glm::vec3& joint : racer.joints) each["positions"].push_back(point(joint));
        const RacerAt at = racer_at(racer, shown.step());
        Json positions = Json::array();
        for (const glm::vec3& joint : at.joints) positions.push_back(point(joint));
        each["shown"] = {{"iteration", at.iteration},
                         {"finished", at.finished},
                         {"residual", number(at.error)},
                         {"positions", std::move(positions)}};
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
    Json list = Json::array();
    for (const Segment& segment : segments) {
        list.push_back({{"position", point(segment.position)}, {"length", number(segment.length)}});
    }
    const float tolerance =
        part.mode == ChainMode::Reach ? reach_tolerance(part.reach, part.chain.reach()) : part.tolerance;
    Json json{{"lab", chain_lab},
              {"mode", chain_modes.name(part.mode)},
              {"index", part.index},
              {"iterations", iterations_of(part, part.mode)},
              {"tolerance", number(tolerance)},
              {"target", point(part.target)},
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
              {"segments", std::move(list)}};
    if (part.reach.plane) {
        json["plane"] = {{"normal", point(glm::normalize(part.reach.plane->normal))}};
        json["off_plane"] = number(off_plane(part.chain, part.reach, part.target));
        json["side"] = ik::name(part.reach.state.side);
    }
    if (part.mode == ChainMode::Reach) json["solve"] = reach_state(part);
    if (part.mode == ChainMode::Curve) json["curve"] = curve_state(part);
    const ShownChain shown = shown_chain(workspace);
    if (shown.trace) json["microscope"] = microscope_state(shown);
    if (!shown.race) return json;
    json["race"] = race_state(shown);
    json["race_shown"] = {
        {"iteration", shown.step()}, {"iterations", shown.last()}, {"playing", part.study.pace > 0.0f}};
    return json;
}

}  // namespace tendril::app
