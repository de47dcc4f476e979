#include "app/labs/rope/body_commands.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {

RopeEdit::RopeEdit(RopePart& changed, const Clock& clock, rope::Workspace& workspace)
    : part(changed),
      workspace_(workspace),
      seconds_(clock.playing
                   ? changed.world->world().pending() + tick_seconds * static_cast<double>(clock.speed)
                   : 0.0) {}

NamedWorld& RopeEdit::world() {
    if (!copy_ || copy_ != part.world) {
        copy_ = std::make_shared<NamedWorld>(*part.world);
        part.world = copy_;
    }
    return *copy_;
}

void RopeEdit::move_pins(const std::vector<rope::PinPlace>& pins) {
    if (seconds_ > 0.0) {
        for (const rope::PinPlace& each : pins) world().pin(each.particle, each.to, seconds_);
        return;
    }
    world().drag_pins(workspace_, pins);
    dragged();
}

void RopeEdit::move_collider(const std::string& name, const glm::vec3& to) {
    if (seconds_ > 0.0) return world().change(name, &rope::World::move_collider, to, seconds_);
    world().drag_collider(workspace_, name, to);
    dragged();
}

void RopeEdit::set_collider(const std::string& name, const rope::Shape& shape) {
    if (seconds_ > 0.0) return world().change(name, &rope::World::set_collider, shape);
    world().drag_collider(workspace_, name, shape);
    dragged();
}

/// Updates the last point of the curves to the current world.
void RopeEdit::dragged() {
    if (part.samples.empty()) return;
    RopeSample& last = part.samples.back();
    const float cost = last.cost;
    last = sample_of(part, last.report);
    last.cost = cost;
}

Command rope_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                     void (*change)(RopeEdit&, const Arguments&), Effect effect) {
    return part_command<RopePart>(
        rope_lab, name, title, std::move(arguments), help, effect,
        [change](Workspace& workspace, RopePart& part, const RopePart& old, const Arguments& given) {
            auto& runtime = workspace.runtimes.of<RopeRuntime>(rope_lab);
            RopeEdit edit(part, workspace.clock, runtime.workspace);
            change(edit, given);
            if (!edit.said.empty()) workspace.toast(std::move(edit.said));
            if (part.world != old.world) {
                check_work(*part.world);
                change_rivals(part, old, [&](RopePart& rival) {
                    RopeEdit same(rival, workspace.clock, runtime.workspace);
                    change(same, given);
                });
            }
            if (part.world == old.world && part.swings == old.swings && part.walker == old.walker) return;
            part.quiet_ticks = 0;
            if (!holds(old) && !holds(part)) part.start.reset();  // a whole drag is one change
        });
}

bool operator==(const RopePart& a, const RopePart& b) {
    return a.world == b.world && a.swings == b.swings && a.walker == b.walker && a.time == b.time &&
           a.tool == b.tool && a.selection == b.selection && a.hold == b.hold && a.jitter == b.jitter &&
           a.view == b.view &&
           std::ranges::equal(a.rivals, b.rivals, {}, &RopeRacer::world, &RopeRacer::world);
}

static void check_count(std::size_t all, std::size_t most, const char* what) {
    if (all > most) throw Refused("that would make " + std::to_string(all) + what + std::to_string(most));
}
void check_particle_count(const NamedWorld& world, std::size_t more) {
    check_count(world.size() + more, max_lab_particles, " particles; the maximum is ");
}
void check_collider_count(const NamedWorld& world) {
    check_count(world.state().colliders.size() + 1, max_lab_colliders, " colliders; the maximum is ");
}

void check_work(const NamedWorld& world) {
    const std::uint64_t work = work_of_substep(world);
    if (work <= max_lab_work) return;
    throw std::length_error("a substep of " + std::to_string(world.state().links.size()) + " links and " +
                            std::to_string(world.settings().iterations) + " iterations would take " +
                            std::to_string(work) + " steps; the maximum is " + std::to_string(max_lab_work));
}

const rope::Body& body_of(const NamedWorld& world, std::string_view name) {
    const rope::Body* body = world.find(name);
    if (body == nullptr) throw Refused("there is no rope \"" + std::string(name) + "\"");
    return *body;
}

const rope::Collider& collider_of(const NamedWorld& world, std::string_view name) {
    const rope::Collider* collider = world.find_collider(name);
    if (collider == nullptr) throw Refused("there is no collider \"" + std::string(name) + "\"");
    return *collider;
}

const rope::Tie& tie_of(const NamedWorld& world, std::string_view name) {
    const rope::Tie* tie = world.find_tie(name);
    if (tie == nullptr) throw Refused("there is no tie \"" + std::string(name) + "\"");
    return *tie;
}

NamedParticle named_particle(const NamedWorld& world, const Arguments& given, const char* rope,
                             const char* particle) {
    const rope::Body& body = body_of(world, given.text(rope));
    const auto index = static_cast<std::size_t>(given.integer(particle));
    if (index >= body.count) {
        throw Refused("particle " + std::to_string(index) + " is out of range, \"" + given.text(rope) +
                      "\" has " + std::to_string(body.count));
    }
    return {given.text(rope), index, body.first + index};
}

std::vector<NamedParticle> named_particles(const NamedWorld& world, const Arguments& given) {
    if (gives_one(given, "particle", "particles")) return {named_particle(world, given)};
    const std::string name = given.text("rope");
    const rope::Body& body = body_of(world, name);
    std::vector<NamedParticle> named;
    for (const std::size_t index : index_list(given, "particles", body.count))
        named.push_back({name, index, body.first + index});
    if (named.empty()) throw Refused("particles is empty");
    return named;
}

std::vector<rope::PinPlace> pin_places(const Arguments& given, const std::vector<NamedParticle>& named,
                                       const char* one, const char* each) {
    std::vector<rope::PinPlace> places;
    if (given.has("particle")) {
        places.push_back({named.front().particle, glm::dvec3(given.point(one))});
        return places;
    }
    const JsonPlace points = each_list(given, each, "particles", named.size());
    for (const NamedParticle& at : named)
        places.push_back({at.particle, glm::dvec3(points.element(places.size()).point())});
    std::ranges::sort(places, {}, &rope::PinPlace::particle);
    const auto twice = std::ranges::adjacent_find(places, {}, &rope::PinPlace::particle);
    if (twice != places.end())
        throw Refused(
            "particles: " + std::to_string(twice->particle - named.front().particle + named.front().index) +
            " is listed twice");
    return places;
}

std::size_t body_with(const rope::State& state, std::size_t particle, std::size_t near) {
    while (particle < state.bodies[near].first) --near;
    while (particle - state.bodies[near].first >= state.bodies[near].count) ++near;
    return near;
}

std::vector<std::size_t> held_particles(const RopeRacer& racer) {
    std::vector<std::size_t> held;
    const rope::Body* body = racer.hold ? racer.world->find(racer.hold->body) : nullptr;
    if (body == nullptr) return held;
    for (const std::size_t each : racer.hold->particles)
        if (each < body->count && racer.world->pinned(body->first + each)) held.push_back(body->first + each);
    return held;
}

bool is_held(const RopeRacer& racer, std::size_t particle) {
    return std::ranges::binary_search(held_particles(racer), particle);
}

void forget_held(RopePart& part, const NamedParticle& named) {
    if (!part.hold || part.hold->body != named.body) return;
    std::erase(part.hold->particles, named.index);
    if (part.hold->particles.empty()) part.hold.reset();
}

bool holds(const RopePart& part) {
    return part.hold ||
           std::ranges::any_of(part.rivals, [](const RopeRacer& each) { return each.hold.has_value(); });
}

void let_go(RopePart& part) {
    const auto release = [](RopeRacer& racer) {
        racer.world = released(racer);
        racer.hold.reset();
    };
    release(part);
    std::ranges::for_each(part.rivals, release);
}

std::shared_ptr<const NamedWorld> released(const RopeRacer& racer) {
    const std::vector<std::size_t> held = held_particles(racer);
    if (held.empty()) return racer.world;
    auto free = std::make_shared<NamedWorld>(*racer.world);
    for (const std::size_t each : held) free->unpin(each);
    return free;
}

void follow_particles(RopePart& part, NamedWorld& world, const std::string& body, const Became& became) {
    const std::size_t first = world.find(body)->first;
    const auto number_of = [&](std::size_t was) { return first + became.particles[was]; };
    /// The indices of `all` that are in the same body as `one`; sets `name` to that body's name.
    const auto together = [&](std::size_t one, const std::vector<std::size_t>& all, std::string& name) {
        name = body;
        for (const std::string& each : became.pieces)
            if (world.find(each)->first <= number_of(one)) name = each;
        const rope::Body& of = *world.find(name);
        std::vector<std::size_t> inside;
        for (const std::size_t each : all)
            if (number_of(each) - of.first < of.count) inside.push_back(number_of(each) - of.first);
        return inside;
    };
    if (part.hold && part.hold->body == body) {
        const std::vector<std::size_t> was = part.hold->particles;
        std::vector<std::size_t> now = together(was.front(), was, part.hold->body);
        std::ranges::sort(now);
        if (now.size() < was.size()) {
            for (const std::size_t each : was) world.unpin(number_of(each));
            part.hold.reset();
        } else {
            part.hold->particles = std::move(now);
        }
    }
    if (!part.selection || !part.selection->of_particles() || part.selection->body != body) return;
    Selection& particles = part.selection->particles;
    const std::size_t active = part.selection->particle();
    const bool whole = particles.all().size() == became.particles.size();  // a whole body stays selected
    std::vector<std::size_t> now = together(active, particles.all(), part.selection->body);
    const rope::Body& of = *world.find(part.selection->body);
    if (whole) {
        now.resize(of.count);
        std::iota(now.begin(), now.end(), std::size_t{0});
    }
    now.push_back(number_of(active) - of.first);
    particles.take(now, false);
}

void part_torn(RopePart& part, NamedWorld& world, const NamedWorld& before) {
    const rope::State& state = world.state();
    if (state.links.size() == before.state().links.size()) return;
    const auto links_of = [](const rope::State& of) {
        std::vector<std::size_t> links(of.bodies.size(), 0);
        std::size_t b = 0;
        for (const rope::Link& link : of.links) {
            b = body_with(of, link.a, b);
            ++links[b];
        }
        return links;
    };
    const std::vector<std::size_t> now = links_of(state), then = links_of(before.state());
    std::vector<std::string> torn;
    for (std::size_t b = 0; b < now.size(); ++b)
        if (now[b] < then[b] && state.bodies[b].kind != rope::Body::Kind::Hair)
            torn.push_back(world.name(state.bodies[b]));
    for (const std::string& each : torn) follow_particles(part, world, each, world.part_body(each));
}

void resample_body(RopeEdit& edit, const std::string& body, const rope::Resolution& to) {
    const std::size_t now = body_of(edit.seen(), body).count, then = to.columns * to.rows;
    if (then > now) check_particle_count(edit.seen(), then - now);
    if (edit.part.hold && edit.part.hold->body == body) let_go(edit.part);
    const Became became = edit.world().resample(body, to);
    follow_particles(edit.part, edit.world(), body, became);
}

void reverse_rope(RopeEdit& edit, const std::string& rope) {
    body_of(edit.seen(), rope);
    if (edit.part.hold && edit.part.hold->body == rope) let_go(edit.part);
    const Became became = edit.world().reverse(rope);
    follow_particles(edit.part, edit.world(), rope, became);
}

void rename_body(RopeEdit& edit, const std::string& body, const std::string& name) {
    edit.world().rename(body, name);
    if (edit.part.hold && edit.part.hold->body == body) edit.part.hold->body = name;
    if (edit.part.selection && edit.part.selection->body == body) edit.part.selection->body = name;
    for (RopeTear& each : edit.part.tears)
        if (each.body == body) each.body = name;
}

void forget_missing(RopePart& part) {
    const NamedWorld& world = *part.world;
    const auto there = [&](const std::string& name, std::size_t particle) {
        const rope::Body* body = world.find(name);
        return body != nullptr && particle < body->count;
    };
    if (part.hold) {
        std::erase_if(part.hold->particles, [&](std::size_t each) { return !there(part.hold->body, each); });
        if (part.hold->particles.empty()) part.hold.reset();
    }
    if (part.selection) {
        RopeSelection& selection = *part.selection;
        const rope::Body* body = world.find(selection.body);
        selection.particles.keep_below(body != nullptr ? body->count : 0);
        const bool stays = !selection.tie.empty()        ? world.find_tie(selection.tie) != nullptr
                           : !selection.collider.empty() ? world.find_collider(selection.collider) != nullptr
                                                         : !selection.particles.empty();
        if (!stays) part.selection.reset();
    }
    if (part.walker.figure) {
        const auto capsules = walker_capsules(part.walker, part.time);
        const auto is_there = [&](const WalkerCapsule& each) {
            return world.find_collider(each.name) != nullptr;
        };
        if (std::ranges::none_of(capsules, is_there)) part.walker = {};
    }
    std::erase_if(part.tears, [&](const RopeTear& each) { return world.find(each.body) == nullptr; });
    std::erase_if(part.swings,
                  [&](const Swing& swing) { return world.find_collider(swing.collider) == nullptr; });
}

namespace {

/// An argument that names an element of one of the lists.
template <class Row>
Argument naming(std::vector<Row> rope::State::*list, const char* name, bool required, const char* help) {
    return offering(text_argument(name, required, help), [list](const Workspace& w) {
        const NamedWorld& world = *rope_part(w).world;
        return names(world.state().*list, [&](const Row& each) { return world.name(each); });
    });
}

}  // namespace

Argument body_argument(const char* name, bool required, const char* help) {
    return naming(&rope::State::bodies, name, required, help);
}

Argument collider_argument(const char* name, bool required, const char* help) {
    return naming(&rope::State::colliders, name, required, help);
}

Argument tie_argument(const char* name, bool required, const char* help) {
    return naming(&rope::State::ties, name, required, help);
}

Argument rope_argument(bool required, const char* help) {
    return body_argument("rope", required, help);
}

Argument particles_argument() {
    return index_list_argument("particles", "particle");
}

Argument particle_argument(bool required, const char* help) {
    return index_argument("particle", required, help, max_lab_particles);
}

}  // namespace tendril::app
