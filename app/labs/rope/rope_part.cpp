#include "app/labs/rope/rope_part.hpp"

#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

/// Counts the lists of the state, not the world's caches.
std::size_t bytes_of(const RopeRacer& racer) {
    const rope::State& state = racer.world->state();
    std::size_t all = sizeof(RopeRacer) + sizeof(NamedWorld) + bytes_in(racer.samples);
    for (const rope::Body& body : state.bodies) all += bytes_in(body.cells);
    if (racer.hold) all += bytes_in(racer.hold->particles);
    return all + bytes_in(state.position, state.displacement, state.mass, state.links, state.bodies,
                          state.pins, state.colliders, state.ties, state.collisions, state.contacts);
}

}  // namespace

std::shared_ptr<const Part> RopePart::after_undo() const {
    if (!holds(*this)) return nullptr;
    auto part = std::make_shared<RopePart>(*this);
    let_go(*part);
    return part;
}

/// Keeps the current selection, view, tool and simulation settings. Releases a drag of that moment.
std::shared_ptr<const Part> RopePart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<RopePart>(dynamic_cast<const RopePart&>(*then));
    let_go(*part);
    part->usual = usual;
    part->tool = tool;
    part->view = view;
    part->selection = selection;
    part->jitter.rate = jitter.rate;
    part->jitter.dial = jitter.dial;
    take_settings(*part, world->settings());
    if (rivals.empty())
        part->rivals.clear();
    else if (part->rivals.empty())
        begin_race(*part);
    forget_missing(*part);
    return part;
}

std::vector<std::filesystem::path> RopePart::files() const {
    if (!walker.figure || walker.figure->path.empty()) return {};
    return {walker.figure->path};
}

std::size_t RopePart::bytes() const {
    std::size_t all = sizeof(*this) + bytes_of(*this) + bytes_in(swings);
    for (const RopeRacer& rival : rivals) all += bytes_of(rival);
    if (start) all += start->bytes();
    return selection ? all + bytes_in(selection->particles.all()) : all;
}

}  // namespace tendril::app
