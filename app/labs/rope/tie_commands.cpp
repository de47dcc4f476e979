// Ties and collisions between bodies: their commands, and their rows in the inspector and the panel.
#include <string>
#include <vector>

#include "app/fields/field_rows.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/numbers.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

void add_tie(RopeEdit& edit, const Arguments& given) {
    const NamedWorld& world = edit.seen();
    if (world.state().ties.size() >= max_lab_ties)
        throw Refused("there are " + std::to_string(max_lab_ties) + " ties already, the maximum");
    rope::TieShape shape;
    set_fields(given, shape);
    if (const std::string other = given.text("b"); world.find_collider(other) != nullptr)
        throw Refused("\"" + other +
                      "\" is a collider, which nothing carries: give the particle a mass instead");
    const std::size_t a = named_particle(world, given, "a", "a_particle").particle;
    const std::size_t b = named_particle(world, given, "b", "b_particle").particle;
    if (a == b) throw Refused("a particle cannot be tied to itself");
    edit.world().tie(given.has("name") ? given.text("name") : std::string(), a, b, shape);
}

void set_tie(RopeEdit& edit, const Arguments& given) {
    const rope::Tie& tie = tie_of(edit.seen(), given.text("name"));
    rope::TieShape shape{.length = tie.length, .strength = tie.strength};
    set_fields(given, shape);
    if (shape.length != tie.length || shape.strength != tie.strength)
        edit.world().change(given.text("name"), &rope::World::set_tie, shape);
}

constexpr const char* all_bodies = "all";

/// The ropes and cloths that an argument names.
std::vector<std::string> bodies_given(const NamedWorld& world, const std::string& name) {
    if (name != all_bodies || world.find(name) != nullptr) return {world.name(body_of(world, name))};
    std::vector<std::string> bodies;
    for (const rope::Body& body : world.state().bodies)
        if (body.kind != rope::Body::Kind::Hair) bodies.push_back(world.name(body));
    return bodies;
}

void collide(RopeEdit& edit, const Arguments& given) {
    const bool on = given.boolean("on");
    const std::vector<std::string> first = bodies_given(edit.seen(), given.text("a")),
                                   second = bodies_given(edit.seen(), given.text("b"));
    for (const std::string& a : first)
        for (const std::string& b : second)
            if (edit.seen().collides(a, b) != on || !on) edit.world().set_collides(a, b, on);
}

/// True if a body collides with itself and all others.
bool collides_with_all(const NamedWorld& world, const std::string& name) {
    for (const std::string& other : bodies_given(world, all_bodies))
        if (!world.collides(name, other)) return false;
    return true;
}

}  // namespace

void add_tie_commands(CommandTable& table) {
    std::vector<Argument> arguments{body_argument("a", true, "a rope, cloth or hair"),
                                    index_argument("a_particle", true, "of a", max_lab_particles),
                                    body_argument("b", true, "another, or the same"),
                                    index_argument("b_particle", true, "of b", max_lab_particles)};
    const std::vector<Argument> shape = field_arguments<rope::TieShape>();
    arguments.insert(arguments.end(), shape.begin(), shape.end());
    arguments.push_back(text_argument("name", false, "default: \"tie\", \"tie 2\", ..."));
    table.add(rope_command("rope.tie", "Tie two particles", std::move(arguments),
                           "Ties two particles; those too far apart are drawn together", add_tie));
    std::vector<Argument> changed = shape;
    changed.insert(changed.begin(), tie_argument("name", true, "which"));
    table.add(rope_command("rope.tie.set", "Change a tie", std::move(changed),
                           "Changes the length or strength of a tie", set_tie));
    table.add(rope_command("rope.untie", "Remove a tie", {tie_argument("name", true, "which")},
                           "Removes a tie", remove_named<tie_of, &rope::World::untie>));
}

void tie_rows(const RopePart& part, const rope::Tie& tie, Emit& emit) {
    const NamedWorld& world = *part.world;
    const std::string& name = world.name(tie);
    const auto end = [&](const char* label, std::size_t particle) {
        const ParticlePlace place = *picked_particle(world, particle_pick(particle));
        reading(label, "%s, particle %zu", world.name(*place.body).c_str(), place.index);
    };
    reading("tie", "%s", name.c_str());
    end("from", tie.a);
    end("to", tie.b);
    reading("tension", "%s", tension_text(world, tie).c_str());
    explain("Its tension, once its ends are together. Without limit: pins are too far apart for it.");
    const rope::TieShape shape{.length = tie.length, .strength = tie.strength};
    FieldRows(shape, "rope.tie.set", emit, {{"name", name}}).rows("length", "strength");
    if (row_button("Remove", 3, true, "Removes the tie")) emit("rope.untie", {{"name", name}});
    end_row();
}

// Collisions between bodies: their command, and the panel's buttons for a body.

void add_collision_commands(CommandTable& table) {
    Argument on = switch_argument("on", "false: they pass through each other again");
    on.required = true;
    table.add(rope_command("rope.collide", "Make bodies collide",
                           {body_argument("a", true, "a rope or cloth, or all"),
                            body_argument("b", true, "another one, the same for itself, or all"), on},
                           "Makes ropes and cloths collide with each other, or one with itself", collide));
}

void collision_rows(const NamedWorld& world, const rope::Body& body, Emit& emit) {
    if (body.kind == rope::Body::Kind::Hair) return;
    const std::string& name = world.name(body);
    const auto button = [&](const char* title, const char* other, bool on, const char* help) {
        if (row_option(title, 2, on, help)) emit("rope.collide", {{"a", name}, {"b", other}, {"on", !on}});
    };
    button("Hits itself", name.c_str(), world.collides(name, name),
           "It collides with itself: a rope can be knotted, a cloth folded. Costs time where parts of it are "
           "close.");
    button("Hits all", all_bodies, collides_with_all(world, name),
           "It collides with itself and with every present rope and cloth.");
    end_row();
}

}  // namespace tendril::app
