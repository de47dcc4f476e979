// The Chain lab in scene files and in --state.
#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "app/fields/solver_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/past.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ChainPart>() noexcept {
    using app::ChainPart;
    static constexpr auto modes = app::chain_modes.name_array();
    constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
    static constexpr Field rows[] = {
        field<&ChainPart::mode>("mode", modes),
        field<&ChainPart::index>("index", {0.0, app::max_segments - 1}),
        list<&ChainPart::iterations>("iterations", {1.0, app::max_iterations})
            .with_names(std::span(modes).first<4>()),
        field<&ChainPart::tolerance>("tolerance", {0.0, max_magnitude}, "m"),
        field<&ChainPart::target>("target", anywhere, "m"),
        field<&ChainPart::reach_target>("reach_target", anywhere, "m").sparsely(),
        nested<&ChainPart::motion>("motion"),
        nested<&ChainPart::flips>("flips")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::ReachResult>() noexcept {
    using app::ReachResult;
    static const Field rows[] = {field<&ReachResult::method>("solver", app::solver_names()),
                                 nested<&ReachResult::report>("report"),
                                 nested<&ReachResult::active_limit>("active_limit")};
    return rows;
}

namespace tendril::app {
namespace {

Json save_reach(const ReachSettings& settings, const Chain& chain) {
    Json json = save_fields(settings);
    if (settings.plane) {
        Json& plane = json["plane"] = {{"normal", point(settings.plane->normal)},
                                       {"bend", bend_sides.name(settings.plane->bend)}};
        for (const ik::AngleLimit& limit : settings.plane->limits)
            plane["limits"].push_back(save_fields(limit));
        for (const ik::Limit& limit : settings.plane->aside) plane["aside"].push_back(limit_json(limit));
    }
    for (const ik::Limit& limit : settings.limits) json["limits"].push_back(limit_json(limit));
    save_state(json, settings.state, positions(chain));
    return json;
}

/// Writes the crossings of the curve that the joints are at, and the joint that jumped to one.
Json save_crossings(const AlongCurve& along) {
    Json json{{"at", along.memory.at}};
    if (along.report && along.report->jumped) json["jumped"] = *along.report->jumped;
    return json;
}

/// Places the given chain along the curve at its saved crossings.
void load_crossings(const JsonPlace& place, ChainPart& part) {
    AlongCurve& along = part.along;
    along.memory.points = part.curve.points.size();
    // Values beyond the curve's end are valid.
    place["at"].for_each("crossings", along.given.size(),
                         [&](const JsonPlace& each) { along.memory.at.push_back(each.real()); });
    follow_curve(part);
    if (const auto jumped = place.optional("jumped"); jumped && along.report)
        along.report->jumped = jumped->index(along.given.size() - 1);
}

/// Replaces the solver's state in the saved settings, `json`, by the last report.
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

Json ChainPart::save() const {
    Json segments = Json::array();
    for (const Segment& segment : own_chain(*this).segments()) segments.push_back(save_fields(segment));
    Json json = save_fields(*this);
    json["selected"] = chosen_point ? Json(chain_points.name(*chosen_point)) : selection.save();
    json["default_direction"] = point(chain.default_direction());
    json["segments"] = std::move(segments);
    json["reach"] = save_reach(reach, chain);
    json["curve"] = save_curve(curve);
    if (mode == ChainMode::Curve) {
        json["selected_controls"] = along.selection.save();
        json["crossings"] = save_crossings(along);
    }
    if (study.open()) json["study"] = save_study(study);
    if (result) {
        json["result"] = save_fields(*result);
        if (!study.last_start.empty()) json["before"] = save_start(study.last_start, study.last_state);
    }
    return json;
}

namespace {

std::vector<Segment> load_segments(const JsonPlace& place) {
    std::vector<Segment> segments;
    place.for_each("segments", max_segments,
                   [&](const JsonPlace& each) { load_known_fields(each, segments.emplace_back()); });
    return segments;
}

/// Converts the rotations of version 1, [w, x, y, z], to [x, y, z, w] in a solver state of member `owner`.
void upgrade_rotations(Json& part, const char* owner) {
    if (!part.is_object() || !part.contains(owner) || !part[owner].is_object()) return;
    const auto found = part[owner].find("rotations");
    if (found == part[owner].end()) return;
    Json rotations = std::move(*found);
    part[owner].erase(found);
    if (rotations.is_array()) {
        for (Json& rotation : rotations) {
            if (!rotation.is_array() || rotation.size() != 4) continue;
            rotation = Json::array({rotation[1], rotation[2], rotation[3], rotation[0]});
        }
    }
    part[owner]["state"] = {{"rotations", std::move(rotations)}};
}

}  // namespace

void ChainPart::upgrade(Json& json, int version) const {
    if (version >= 2) return;
    upgrade_rotations(json, "reach");
    upgrade_rotations(json, "study");
}

std::shared_ptr<Part> ChainPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    auto part = std::make_shared<ChainPart>();
    try {
        static constexpr std::string_view newer[] = {"reach_target", "flips"};
        load_all_fields(place, *part, newer);
        // Some older scenes have one in mode Reach too.
        if (part->mode == ChainMode::Reach) part->reach_target.reset();
        part->motion = load_motion(place["motion"]);
        part->chain = require_value(
            Chain::from_segments(load_segments(place["segments"]), place["default_direction"].point()));

        const int last = std::max(0, static_cast<int>(part->chain.size()) - 1);
        static_cast<void>(place["index"].integer(0, last));
        // Scenes older than mode Reach lack this member.
        if (place.has("reach")) part->reach = load_reach(place["reach"], part->chain);
        if (const auto drawn = place.optional("curve")) part->curve = load_curve(*drawn);
        if (part->mode == ChainMode::Curve) {
            std::swap(part->chain, part->along.given);
            if (const auto crossings = place.optional("crossings"))
                load_crossings(*crossings, *part);
            else
                follow_curve(*part);
            if (const auto selected = place.optional("selected_controls"))
                part->along.selection = Selection::load(*selected, part->curve.points.size());
        }
        if (place.has("study")) {
            if (part->mode != ChainMode::Reach)
                place["study"].fail(std::string("is for mode reach, not ") + chain_modes.name(part->mode));
            part->study = load_study(place["study"], part->chain);
        }
        if (const auto solved = place.optional("result")) {
            if (part->mode != ChainMode::Reach) solved->fail("is for mode reach");
            static constexpr std::string_view not_always[] = {"active_limit"};
            load_all_fields(*solved, part->result.emplace(), not_always);
            const auto& limit = part->result->active_limit;
            if (limit && limit->joint >= part->chain.size())
                (*solved)["active_limit"]["joint"].fail("there is no such joint");
            if (const auto before = place.optional("before"))
                load_start(*before, part->chain, part->study.last_start, part->study.last_state);
        }
        ChainRuntime runtime;  // the part belongs to no workspace yet
        keep_step(*part, runtime);
        check_range(*part);
        if (const auto selected = place.optional("selected")) {
            if (selected->json().is_string()) {
                part->chosen_point = selected->choice(chain_points);
                if (part->chosen_point == ChainPoint::Pole && !part->reach.options.pole)
                    selected->fail("there is no pole target to select");
            } else {
                part->selection = Selection::load(*selected, part->chain.size());
            }
        }
    } catch (const std::logic_error& error) {  // the core's message, with its position in the file
        place.fail(error.what());
    }
    return part;
}

// Mode Reach.

namespace {

/// A list with one entry per bone; none if it is missing or empty.
std::optional<JsonPlace> bone_list(const JsonPlace& owner, const char* key, const Chain& chain) {
    std::optional<JsonPlace> list = owner.optional(key);
    if (!list || (list->json().is_array() && list->json().empty())) return std::nullopt;
    list->check_size(chain.size() < 2 ? 0 : chain.size() - 1, "values, one for each bone");
    return list;
}

std::vector<ik::Limit> load_limits(const JsonPlace& owner, const char* key, const Chain& chain) {
    std::vector<ik::Limit> limits;
    const auto load = [&](const JsonPlace& each) {
        limits.push_back(limit_from_json(each.json(), each.where()));
        if (const char* why = ik::fault(limits.back(), chain.default_direction())) each.fail(why);
    };
    if (const auto list = bone_list(owner, key, chain)) list->for_each("limits", chain.size(), load);
    return limits;
}

ChainPlane load_plane(const JsonPlace& place, const Chain& chain) {
    ChainPlane plane;
    plane.normal = place["normal"].point();
    if (!(glm::length(plane.normal) > 1e-6f)) place["normal"].fail("must be longer than 1e-6");
    if (const auto bend = place.optional("bend")) plane.bend = bend->choice(bend_sides);
    const auto load = [&](const JsonPlace& each) {
        load_fields(each, plane.limits.emplace_back());
        if (const char* why = ik::fault(plane.limits.back())) each.fail(why);
    };
    if (const auto limits = bone_list(place, "limits", chain)) limits->for_each("limits", chain.size(), load);
    plane.aside = load_limits(place, "aside", chain);
    return plane;
}

}  // namespace

void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints) {
    // Ignore the state of another chain: the next solve would discard it.
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    if (state.bones() == 0 || !ik::check(state, bones)) return;
    Json& saved = json["state"] = save_ik_state(state);
    const auto turned = [](const glm::quat& q) { return q != glm::quat(1, 0, 0, 0); };
    if (std::none_of(state.rotations.begin(), state.rotations.end(), turned)) saved.erase("rotations");
    if (state.pole.valid && state.pole.joints == from_root(joints)) saved["pole"].erase("joints");
}

ik::State load_state(const JsonPlace& owner, const std::vector<glm::vec3>& joints) {
    const auto saved = owner.optional("state");
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    return saved ? load_ik_state(*saved, bones, from_root(joints)) : ik::State();
}

ReachSettings load_reach(const JsonPlace& place, const Chain& chain) {
    ReachSettings settings;
    load_fields(place, settings);
    if (const auto plane = place.optional("plane")) settings.plane = load_plane(*plane, chain);
    if (settings.plane && place.has("limits")) place["limits"].fail("a chain in a plane has the plane's");
    settings.limits = load_limits(place, "limits", chain);
    settings.state = load_state(place, positions(chain));
    return settings;
}

// The Chain lab's part of --state.

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
