// What is selected, held and shown. But for what a drag does to a rope, it leaves no step to undo.
#include <algorithm>

#include "app/labs/kit/index_list.hpp"
#include "app/labs/rope/rope_commands.hpp"
#include "app/labs/rope/rope_names.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept {
    using app::RopeView;
    static constexpr Field rows[] = {field<&RopeView::particles>("particles"),
                                     field<&RopeView::strain>("strain"),
                                     field<&RopeView::sides>("sides", {app::min_sides, app::max_sides})};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<RopeView>() {
    static constexpr FieldText texts[] = {
        {.name = "strain",
         .label = "Strain as colour",
         .help = "Colours each rope by how far its segments are from their lengths."},
        {.name = "particles", .label = "Particles", .help = "Draws the particles that ropes are made of."},
        {.name = "sides",
         .label = "sides",
         .help = "How many sides ropes have in the picture. More look rounder and take longer to draw."}};
    return texts;
}

namespace {

void select(RopeEdit& edit, const Arguments& given) {
    const bool particle = given.has("rope") || given.has("particle") || given.has("particles");
    const bool add = given.has("add") && given.boolean("add");
    if (particle && given.has("collider"))
        throw Refused("a particle or a collider can be selected, not both");
    if (given.has("collider")) {
        collider_of(edit.seen(), given.text("collider"));
        edit.part.selection = RopeSelection{{}, {}, given.text("collider")};
    } else if (particle) {
        if (!given.has("rope")) throw Refused("rope is missing (a text)");
        if (!given.has("particle") && !given.has("particles"))
            throw Refused("particle is missing (a whole number)");
        std::vector<std::size_t> chosen;
        for (const NamedParticle& each : named_particles(edit.seen(), given)) chosen.push_back(each.index);
        const std::string rope = given.text("rope");
        const auto& before = edit.part.selection;
        RopeSelection selection{rope, {}, {}};
        if (add && before && before->body == rope) selection = *before;
        if (add && given.has("particle"))
            selection.particles.toggle(chosen.front());
        else
            selection.particles.take(chosen, add);
        edit.part.selection = std::move(selection);
        if (edit.part.selection->particles.empty()) edit.part.selection.reset();
    } else if (!add) {
        edit.part.selection.reset();
    }
}

void hold(RopeEdit& edit, const Arguments& given) {
    const std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    for (const char* point : {"at", "points"})
        if (given.has(point) == given.has(point[0] == 'a' ? "particles" : "particle"))
            throw Refused("needs particle and at, or particles and points");
    const std::vector<rope::PinPlace> places = pin_places(given, all, "at", "points");
    const std::vector<std::size_t> held = held_particles(edit.part);
    Hold wanted{all.front().body, {}};
    for (const NamedParticle& each : all)
        if (!edit.seen().pinned(each.particle) || std::ranges::binary_search(held, each.particle))
            wanted.particles.push_back(each.index);
    std::sort(wanted.particles.begin(), wanted.particles.end());
    if (wanted.particles.empty())
        throw Refused("particle " + std::to_string(all.front().index) + " of \"" + all.front().body +
                      "\" is pinned; rope.pin moves it");
    if (edit.part.hold != wanted) let_go(edit.part);
    edit.move_pins(places);
    edit.part.hold = wanted;
}

void set_view(RopeEdit& edit, const Arguments& given) {
    set_fields(given, edit.part.view);
}

}  // namespace

void add_look_commands(CommandTable& table) {
    table.add(
        rope_command("rope.select", "Select particles or a collider",
                     {rope_argument(false, "of the particle"), particle_argument(false, "which"),
                      collider_argument("collider", false, "instead of a particle"), particles_argument(),
                      switch_argument("add", "true: adds particles of the same rope, or takes one out")},
                     "Selects particles or a collider; nothing when all is left out", select, Effect::Look));
    table.add(rope_command(
        "rope.hold", "Hold particles",
        {rope_argument(true, "which"), particle_argument(false, "which; one of them a free one"),
         particles_argument(), point_argument("at", false, "metres"), each_argument("points", "particles")},
        "Holds free particles until rope.let_go, as a drag does, and moves pinned ones along", hold));
    table.add(rope_command(
        "rope.let_go", "Let go of held particles", {}, "Releases what rope.hold holds",
        [](RopeEdit& edit, const Arguments&) { let_go(edit.part); }, Effect::Look));
    table.add(rope_command(
        "rope.tool", "Choose the click action", {choice_argument("name", true, "which", rope_tools.names())},
        "Sets what a click in the scene does",
        [](RopeEdit& edit, const Arguments& given) { edit.part.tool = rope_tools.value(given.text("name")); },
        Effect::Look));
    table.add(rope_command("rope.view", "Set how ropes are shown", field_arguments<RopeView>(),
                           "Sets how ropes are shown; what is left out stays", set_view, Effect::Look));
}

}  // namespace tendril::app
