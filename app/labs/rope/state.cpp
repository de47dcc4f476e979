// What --state writes of the Rope lab.
#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/panels.hpp"
#include "app/labs/rope/past.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_names.hpp"

namespace tendril::app {
namespace {

Json body_state(const NamedWorld& world, const rope::Body& body, const std::vector<bool>& pinned) {
    Json particles = Json::array();
    for (std::size_t i = body.first; i < body.first + body.count; ++i)
        particles.push_back({{"position", dpoint(world.state().position[i])}, {"pinned", bool(pinned[i])}});
    Json json{{"name", world.name(body)},        {"length", world.length(body)},
              {"radius", number(body.radius)},   {"particles", std::move(particles)},
              {"stretch", number(body.stretch)}, {"length_error", world.length_error(body)},
              {"energy", world.energy(body)}};
    if (body.kind != rope::Body::Kind::Rope) json["row"] = body.row;
    return json;
}

Json collider_state(const RopePart& part, const rope::Collider& collider) {
    const std::string& name = part.world->name(collider);
    Json json{{"name", name}};
    const Json shape = save_shape(collider.shape);
    for (const auto& [key, value] : shape.items()) json[key] = value;
    json["centre"] = point(rope::centre(collider.shape));
    for (const Swing& swing : part.swings) {
        if (swing.collider == name)
            json["swing"] = {{"by", point(swing.swing)},
                             {"middle", point(swing.middle)},
                             {"period", number(swing.period)}};
    }
    return json;
}

Json report_state(const RopeReport& report) {
    return {{"inside", report.inside},
            {"unconverged", report.unconverged},
            {"suspended", report.suspended},
            {"contact_loss", number(report.contact_loss)}};
}

Json selection_state(const std::optional<RopeSelection>& selection) {
    if (!selection) return nullptr;
    if (!selection->collider.empty()) return Json{{"collider", selection->collider}};
    return Json{{"rope", selection->body},
                {"particle", selection->particle()},
                {"particles", selection->particles.all()}};
}

}  // namespace

Json RopeLab::state(const Workspace& workspace) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = *part.world;
    const rope::State& now = world.state();
    std::vector<bool> pinned(world.size());
    for (const rope::Pin& pin : now.pins) pinned[pin.particle] = true;
    Json ropes = Json::array(), cloths = Json::array(), hair = Json::array(), colliders = Json::array();
    for (const rope::Body& body : now.bodies) {
        Json& list = body.kind == rope::Body::Kind::Rope    ? ropes
                     : body.kind == rope::Body::Kind::Cloth ? cloths
                                                            : hair;
        list.push_back(body_state(world, body, pinned));
    }
    for (const rope::Collider& collider : now.colliders) colliders.push_back(collider_state(part, collider));
    Json held = nullptr;
    if (part.hold)
        held = {{"rope", part.hold->body},
                {"particle", part.hold->particles.front()},
                {"particles", part.hold->particles}};
    const Verdict verdict = rope_verdict(part);
    return Json{{"lab", rope_lab},
                {"verdict", verdict.text},
                {"why", verdict.why},
                {"last_second", report_state(last_second(part.samples))},
                {"ropes", std::move(ropes)},
                {"cloths", std::move(cloths)},
                {"hair", std::move(hair)},
                {"colliders", std::move(colliders)},
                {"substeps", now.substeps},
                {"substeps_dropped", now.dropped},
                {"settings", save_fields(now.settings)},
                {"seconds", part.time},
                {"speed", number(workspace.clock.speed)},
                {"tool", rope_tools.name(part.tool)},
                {"selected", selection_state(part.selection)},
                {"held", std::move(held)},
                {"jitter", number(part.jitter.dial)},
                {"frame_ms", part.samples.empty() ? Json(nullptr) : number(part.samples.back().frame)},
                {"moving", moving(workspace)},
                {"past", past_view_state(workspace, rope_past(), rope_past_curve(workspace))}};
}

}  // namespace tendril::app
