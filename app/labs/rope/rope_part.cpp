#include "app/labs/rope/rope_part.hpp"

#include "app/labs/rope/race.hpp"
#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/scenes.hpp"

namespace tendril::app {
namespace {

/// Counts the lists of the state, not the world's caches.
std::size_t bytes_of(const rope::State& state) {
    constexpr std::size_t particle = 3 * sizeof(glm::dvec3) + sizeof(double);
    std::size_t cells = 0;
    for (const rope::Body& body : state.bodies) cells += body.cells.size() * sizeof(body.cells[0]);
    return cells + state.position.size() * particle + state.links.size() * sizeof(rope::Link) +
           state.bodies.size() * sizeof(rope::Body) + state.pins.size() * sizeof(rope::Pin) +
           state.colliders.size() * sizeof(rope::Collider) + state.ties.size() * sizeof(rope::Tie) +
           state.collisions.size() * sizeof(rope::Collision) +
           state.contacts.size() * sizeof(rope::BodyContact);
}

}  // namespace

RopePart first_ropes() {
    RopePart part;
    RopeScene scene = make_rope_scene(rope_scenes().front());
    part.world = std::make_shared<const NamedWorld>(std::move(scene.world));
    part.usual = part.world->settings();
    part.swings = std::move(scene.swings);
    return part;
}

std::shared_ptr<const Part> RopePart::after_undo() const {
    if (!holds(*this)) return nullptr;
    auto part = std::make_shared<RopePart>(*this);
    let_go(*part);
    return part;
}

/// Keeps the current selection, view, tool and simulation settings. Releases a drag held at that moment,
/// because none holds it now.
std::shared_ptr<const Part> RopePart::at_moment(std::shared_ptr<const Part> then) const {
    auto part = std::make_shared<RopePart>(dynamic_cast<const RopePart&>(*then));
    let_go(*part);
    part->usual = usual;
    part->tool = tool;
    part->view = view;
    part->selection = selection;
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
    const std::size_t selected = selection ? selection->particles.all().size() * sizeof(std::size_t) : 0;
    const auto bytes_in = [](const NamedWorld& in, const std::vector<RopeSample>& of,
                             const std::optional<Hold>& held) {
        return sizeof(NamedWorld) + bytes_of(in.state()) + of.size() * sizeof(RopeSample) +
               (held ? held->particles.size() * sizeof(std::size_t) : 0);
    };
    std::size_t worlds = bytes_in(*world, samples, hold);
    for (const Rival& rival : rivals)
        worlds += sizeof(Rival) + bytes_in(*rival.world, rival.samples, rival.hold);
    return sizeof(*this) + worlds + swings.size() * sizeof(Swing) + selected;
}

}  // namespace tendril::app
