// Collisions between bodies: their command, and the panel's buttons for a body.
#include <string>
#include <vector>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/body_commands.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

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

/// Whether a body collides with itself and all others.
bool collides_with_all(const NamedWorld& world, const std::string& name) {
    for (const std::string& other : bodies_given(world, all_bodies))
        if (!world.collides(name, other)) return false;
    return true;
}

}  // namespace

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
           "It collides with itself and with every rope and cloth that there is now.");
    end_row();
}

}  // namespace tendril::app
