// The Rope lab in a scene file, and its --state.
#include <algorithm>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <tendril/magnitude.hpp>
#include <utility>
#include <vector>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/kit/named_world.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace {

constexpr double max_value = std::numeric_limits<float>::max(), max_count = 1e9;

}  // namespace

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeReport>() noexcept {
    using app::RopeReport;
    static constexpr Field rows[] = {
        field<&RopeReport::inside>("inside", {0, max_count}),
        field<&RopeReport::unconverged>("unconverged", {0, max_count}),
        field<&RopeReport::suspended>("suspended", {0, max_count}),
        field<&RopeReport::substeps>("substeps", {0, max_count}),
        field<&RopeReport::dropped>("dropped", {0, max_count}),
        field<&RopeReport::torn>("torn", {0, max_count}),
        field<&RopeReport::contact_loss>("contact_loss", {-max_value, max_value}, "J")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeSample>() noexcept {
    using app::RopeSample;
    static constexpr Field rows[] = {field<&RopeSample::stretch>("stretch", {-max_value, max_value}),
                                     field<&RopeSample::error>("error", {-max_value, max_value}),
                                     field<&RopeSample::energy>("energy", {-max_value, max_value}, "J"),
                                     field<&RopeSample::frame>("frame", {0, max_value}, "ms")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Swing>() noexcept {
    using app::Swing;
    constexpr FieldRange anywhere{-max_magnitude, max_magnitude};
    static constexpr Field rows[] = {
        field<&Swing::collider>("collider").needed(), field<&Swing::middle>("middle", anywhere, "m").needed(),
        field<&Swing::swing>("swing", anywhere, "m").needed(),
        field<&Swing::period>("period", {app::min_period, app::max_period}, "s").needed()};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Jitter>() noexcept {
    using app::Jitter;
    static constexpr Field rows[] = {
        field<&Jitter::rate>("rate", {1.0 / app::max_jitter_frame, 1.0 / app::min_jitter_frame}, "Hz"),
        field<&Jitter::dial>("dial").needed(), field<&Jitter::frames>("frames", {0.0, 4294967295.0}).needed(),
        field<&Jitter::pending>("owed", {0.0, 10.0}, "s").needed(),
        field<&Jitter::frame>("frame", {0.0, app::max_jitter_frame}, "s").needed()};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Hold>() noexcept {
    using app::Hold, app::max_lab_particles;
    static constexpr Field rows[] = {field<&Hold::body>("rope").needed(),
                                     list<&Hold::particles>("particles", {0.0, max_lab_particles - 1})
                                         .up_to(max_lab_particles, 1)
                                         .needed()};
    return rows;
}

/// The fields that do not depend on the world.
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopePart>() noexcept {
    using app::RopePart;
    static constexpr auto tools = app::rope_tools.name_array();
    static constexpr Field rows[] = {
        field<&RopePart::time>("time", {0.0, 1e9}, "s").needed(),
        field<&RopePart::tool>("tool", tools).needed(),
        nested<&RopePart::view>("view").needed(),
        nested<&RopePart::jitter>("jitter").needed(),
        list<&RopePart::swings>("swings").up_to(app::max_lab_colliders).needed(),
        field<&RopePart::quiet_ticks>("quiet_ticks", {0.0, std::numeric_limits<int>::max()})};
    return rows;
}

namespace tendril::app {
namespace {

void check_found(const JsonPlace& name, const char* what, const void* found) {
    if (found == nullptr) name.fail(std::string("there is no ") + what + ' ' + json_summary(name.json()));
}

void check_swings(const std::vector<Swing>& swings, const JsonPlace& place, const NamedWorld& world) {
    for (std::size_t i = 0; i < swings.size(); ++i) {
        check_found(place.element(i)["collider"], "collider", world.find_collider(swings[i].collider));
        try {
            require(swings[i]);
        } catch (const std::invalid_argument& error) {
            place.element(i).fail(error.what());
        }
    }
}

Json save_selection(const std::optional<RopeSelection>& selection) {
    if (!selection) return nullptr;
    if (!selection->collider.empty()) return Json{{"collider", selection->collider}};
    if (!selection->tie.empty()) return Json{{"tie", selection->tie}};
    return Json{{"rope", selection->body}, {"particle", selection->particles.save()}};
}

std::optional<RopeSelection> load_selection(const JsonPlace& place, const NamedWorld& world) {
    if (place.json().is_null()) return std::nullopt;
    RopeSelection selection;
    if (place.has("collider")) {
        selection.collider = place["collider"].text();
        check_found(place["collider"], "collider", world.find_collider(selection.collider));
        return selection;
    }
    if (place.has("tie")) {
        selection.tie = place["tie"].text();
        check_found(place["tie"], "tie", world.find_tie(selection.tie));
        return selection;
    }
    selection.body = place["rope"].text();
    const rope::Body* body = world.find(selection.body);
    check_found(place["rope"], "rope", body);
    if (body->count == 0) return std::nullopt;
    selection.particles = Selection::load(place["particle"], body->count);
    if (selection.particles.empty()) place["particle"].fail("no particle is selected");
    return selection;
}

/// A racer's data besides its world: held particles, and the last ten seconds as a column for each number
/// except the cost, which depends on the computer.
void save_racer(Json& json, const RopeRacer& racer) {
    if (racer.hold) json["held"] = save_fields(*racer.hold);
    for (const RopeSample& each : racer.samples) {
        Json row = save_fields(each);
        row.update(save_fields(each.report));
        for (const auto& [name, value] : row.items()) json["samples"][name].push_back(value);
    }
}

std::optional<Hold> load_hold(const JsonPlace& place, const NamedWorld& world) {
    Hold hold;
    load_all_fields(place, hold);
    const rope::Body* const body = world.find(hold.body);
    check_found(place["rope"], "rope", body);
    const JsonPlace list = place["particles"];
    for (std::size_t i = 0; i < hold.particles.size(); ++i)
        if (hold.particles[i] >= body->count)
            list.element(i).fail("there is no such particle");
        else if (!world.pinned(body->first + hold.particles[i]))
            list.element(i).fail("it is not pinned, so not held");
    if (std::ranges::adjacent_find(hold.particles, std::greater_equal<>()) != hold.particles.end())
        list.fail("expected ascending particles");
    return hold;
}

std::vector<RopeSample> load_samples(const JsonPlace& place) {
    std::vector<RopeSample> samples(place["error"].list_size("samples", max_rope_samples));
    for (const auto& [name, column] : place.json().items())
        place[name.c_str()].check_size(samples.size(), "numbers, one for each sample");
    for (std::size_t i = 0; i < samples.size(); ++i) {
        Json row = Json::object();
        for (const auto& [name, column] : place.json().items()) row[name] = column[i];
        const JsonPlace at(row, place.where() + "." + std::to_string(i));
        load_all_fields(at, samples[i]);
        static constexpr std::string_view newer[] = {"torn"};
        load_all_fields(at, samples[i].report, newer);
    }
    return samples;
}

void load_racer(const JsonPlace& place, RopeRacer& racer) {
    if (const auto held = place.optional("held")) racer.hold = load_hold(*held, *racer.world);
    if (const auto columns = place.optional("samples")) racer.samples = load_samples(*columns);
}

}  // namespace

Json RopePart::save() const {
    Json json = save_sparse_fields(*this);
    json["selected"] = save_selection(selection);
    json["world"] = save_world(*world);
    save_racer(json, *this);
    for (const RopeRacer& rival : rivals)
        save_racer(json["rivals"].emplace_back(save_world(*rival.world)), rival);
    if (walker.figure) json["character"] = save_walker(walker);
    return json;
}

void RopePart::upgrade(Json& json, int version) const {
    if (version >= 2 || !json.is_object()) return;
    const auto renamed = [](Json& in, const char* from, const char* to) {
        if (!in.is_object() || !in.contains(from)) return;
        in[to] = std::move(in[from]);
        in.erase(from);
    };
    renamed(json, "torture", "jitter");                                    // version 1
    if (json.contains("view")) renamed(json["view"], "stress", "strain");  // version 1
    if (!json.contains("world") || !json["world"].is_object() || !json["world"].contains("bodies")) return;
    for (Json& body : json["world"]["bodies"])
        if (body.is_object() && body.contains("kind"))
            for (const auto& [from, to] : {std::pair("sheet", "cloth"), {"lock", "hair"}})  // version 1
                if (body["kind"] == from) body["kind"] = to;
}

std::shared_ptr<Part> RopePart::load(const Json& json, const std::string& where) const {
    const std::vector<std::string_view> racing_too{"held", "samples"};
    const JsonPlace place(json, where);
    auto part = std::make_shared<RopePart>();
    load_known_fields(place, *part, {"selected", "world", "held", "samples", "rivals", "character"});
    const auto read_world = [](const JsonPlace& at, std::span<const std::string_view> besides = {}) {
        try {
            auto read = std::make_shared<const NamedWorld>(load_world(at, besides));
            check_work(*read);
            return read;
        } catch (const std::logic_error& error) {  // the library's message, with the JSON path
            at.fail(error.what());
        }
    };
    part->world = read_world(place["world"]);
    part->usual = part->world->settings();
    if (const auto racing = place.optional("rivals"))
        racing->for_each("rivals", 2, [&](const JsonPlace& each) {
            RopeRacer rival;
            rival.world = read_world(each, racing_too);
            for (const RopeRacer& racer : rope_racers(*part))
                if (racer.solver() == rival.solver()) each.fail("its solver races already");
            load_racer(each, rival);
            part->rivals.push_back(std::move(rival));
        });
    load_racer(place, *part);
    check_swings(part->swings, place["swings"], *part->world);
    if (const auto character = place.optional("character")) part->walker = load_walker(*character);
    part->selection = load_selection(place["selected"], *part->world);
    return part;
}

// The Rope lab's --state.

namespace {

/// `pose`: of all particles, as in the picture.
Json body_state(const NamedWorld& world, const rope::Body& body, const std::vector<glm::dvec3>& pose) {
    Json particles = Json::array();
    for (std::size_t i = body.first; i < body.first + body.count; ++i)
        particles.push_back({{"position", dpoint(pose[i])}, {"pinned", world.pinned(i)}});
    const BodySettings settings = settings_of(world, body);
    const std::vector<Field> rows = body_fields(settings);
    Json json = save_fields({rows, &settings});
    json.update({{"name", world.name(body)},
                 {"particles", std::move(particles)},
                 {"as_solved", number(body.stretch)},
                 {"length_error", world.length_error(body)},
                 {"energy", world.energy(body)}});
    if (body.kind != rope::Body::Kind::Rope) json["row"] = body.row;
    if (!body.cells.empty()) json["cells"] = body.cells;
    return json;
}

Json collider_state(const RopePart& part, const rope::Collider& collider) {
    rope::Collider shown = collider;
    shown.shape = part.world->shape(collider);
    Json json = save_sparse_fields(shown);
    json.update({{"name", part.world->name(collider)}, {"centre", point(rope::centre(shown.shape))}});
    for (const Swing& swing : part.swings)
        if (swing.collider == part.world->name(collider)) json["swing"] = save_fields(swing);
    return json;
}

Json tie_state(const NamedWorld& world, const rope::Tie& tie, const std::vector<OverPulled>& pulled) {
    Json json = save_fields(tie);
    const auto tension = measured_tension(tie, pulled);
    json.update({{"name", world.name(tie)}, {"tension", tension ? Json(number(*tension)) : Json(nullptr)}});
    const auto end = [&](const char* body, const char* index, std::size_t particle) {
        const ParticlePlace place = *picked_particle(world, particle_pick(particle));
        json[body] = world.name(*place.body);
        json[index] = place.index;
    };
    end("a", "a_particle", tie.a);
    end("b", "b_particle", tie.b);
    return json;
}

Json selection_state(const std::optional<RopeSelection>& selection) {
    Json json = save_selection(selection);
    if (!selection || !selection->of_particles()) return json;
    json["particle"] = selection->particle();
    json["particles"] = selection->particles.all();
    return json;
}

}  // namespace

Json RopeLab::state(const Workspace& workspace) const {
    const RopePart& part = rope_part(workspace);
    const NamedWorld& world = *part.world;
    const rope::State& now = world.state();
    std::vector<glm::dvec3> pose(world.size());
    world.world().pose(pose);
    Json ropes = Json::array(), cloths = Json::array(), hair = Json::array(), colliders = Json::array();
    Json* const lists[] = {&ropes, &cloths, &hair};
    for (const rope::Body& body : now.bodies)
        lists[static_cast<std::size_t>(body.kind)]->push_back(body_state(world, body, pose));
    for (const rope::Collider& collider : now.colliders) colliders.push_back(collider_state(part, collider));
    Json ties = Json::array();
    const std::vector<OverPulled> pulled = over_pulled(world);
    for (const rope::Tie& tie : now.ties) ties.push_back(tie_state(world, tie, pulled));
    Json collisions = Json::array();
    // In the order of the bodies: opening a scene assigns new slots.
    std::set<std::pair<const rope::Body*, const rope::Body*>> pairs;
    for (const rope::Collision& each : now.collisions)
        pairs.insert(std::minmax(world.world().find(each.a), world.world().find(each.b)));
    for (const auto& [a, b] : pairs) collisions.push_back({world.name(*a), world.name(*b)});
    Json held = nullptr;
    if (part.hold) {
        held = save_fields(*part.hold);
        held["particle"] = part.hold->particles.front();
    }
    Json race = nullptr;
    if (!part.rivals.empty())
        for (const RopeRacer& racer : rope_racers(part)) {
            const RopeSample last = last_sample(racer);
            race.push_back({{"solver", rope_solvers.name(racer.solver())},
                            {"length_error", number(last.error)},
                            {"as_solved", number(last.stretch)},
                            {"energy", number(last.energy)}});
        }
    const Verdict verdict = rope_verdict(part);
    const RopeReport report = last_second(part.samples);
    return Json{{"lab", rope_lab},
                {"verdict", verdict.text},
                {"why", verdict.why},
                {"last_second", save_fields(report)},
                {"ropes", std::move(ropes)},
                {"cloths", std::move(cloths)},
                {"hair", std::move(hair)},
                {"colliders", std::move(colliders)},
                {"ties", std::move(ties)},
                {"collisions", std::move(collisions)},
                {"contacts", now.contacts.size()},
                {"character", save_walker(part.walker)},
                {"substeps", now.substeps},
                {"substeps_dropped", now.dropped},
                {"settings", save_fields(now.settings)},
                {"view", save_fields(part.view)},
                {"seconds", part.time},
                {"speed", number(workspace.clock.speed)},
                {"tool", rope_tools.name(part.tool)},
                {"selected", selection_state(part.selection)},
                {"held", std::move(held)},
                {"jitter", number(part.jitter.dial)},
                {"frame_rate", number(part.jitter.rate)},
                {"frame_ms", part.samples.empty() ? Json(nullptr) : number(part.samples.back().frame)},
                {"race", std::move(race)},
                {"moving", moving(workspace)},
                {"past", past_state(workspace, rope_past())}};
}

}  // namespace tendril::app
