// What ropes cannot enter.
#include <algorithm>
#include <string_view>

#include "app/labs/rope/rope_commands.hpp"
#include "app/labs/rope/rope_names.hpp"
#include "app/labs/rope/rope_time.hpp"

namespace tendril::app {
namespace {

struct Kind {
    const char* name;
    rope::Shape shape;
    std::vector<std::string_view> needs, takes;
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> list{{"sphere", rope::Sphere{}, {"centre", "radius"}, {}},
                                        {"capsule", rope::Capsule{}, {"a", "b", "radius"}, {}},
                                        {"plane", rope::Plane{}, {"point", "normal"}, {}},
                                        {"box", rope::Box{}, {"centre", "half_extents"}, {"rotation"}}};
    return list;
}

const Kind& kind_of(std::string_view name) {
    return *std::find_if(kinds().begin(), kinds().end(), [&](const Kind& kind) { return name == kind.name; });
}

bool has(const std::vector<std::string_view>& list, std::string_view name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

void check_needs(const Kind& kind, const Arguments& given) {
    for (const std::string_view name : kind.needs) {
        if (!given.has(std::string(name).c_str()))
            throw Refused(std::string(name) + " is missing; a " + kind.name + " needs it");
    }
}

/// A shape of that kind with what is given in place of what it had. Refuses what the kind does not have.
rope::Shape changed(rope::Shape shape, const Kind& kind, const Arguments& given) {
    for (const char* name : {"centre", "radius", "a", "b", "point", "normal", "half_extents", "rotation"}) {
        if (!has(kind.needs, name) && !has(kind.takes, name) && given.has(name))
            throw Refused(std::string("a ") + kind.name + " has no " + name);
    }
    const auto take = [&](const char* name, glm::vec3& value) {
        if (given.has(name)) value = given.point(name);
    };
    if (auto* sphere = std::get_if<rope::Sphere>(&shape)) {
        take("centre", sphere->centre);
        if (given.has("radius")) sphere->radius = given.number("radius");
    } else if (auto* capsule = std::get_if<rope::Capsule>(&shape)) {
        take("a", capsule->a);
        take("b", capsule->b);
        if (given.has("radius")) capsule->radius = given.number("radius");
    } else if (auto* plane = std::get_if<rope::Plane>(&shape)) {
        take("point", plane->point);
        take("normal", plane->normal);
    } else if (auto* box = std::get_if<rope::Box>(&shape)) {
        take("centre", box->centre);
        take("half_extents", box->half_extents);
        if (given.has("rotation")) box->rotation = given.rotation("rotation");
    }
    return shape;
}

Swing* swing_of(RopePart& part, const std::string& collider) {
    const auto found = std::find_if(part.swings.begin(), part.swings.end(),
                                    [&](const Swing& swing) { return swing.collider == collider; });
    return found == part.swings.end() ? nullptr : &*found;
}

/// A swing whose centre is `at` at this moment.
void centre_on(Swing& swing, glm::vec3 at, double time) {
    swing.middle = glm::vec3(0.0f);
    swing.middle = at - swing_point(swing, time);
    require(swing);
}

void add_collider(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    if (name.empty()) throw Refused("name must not be empty");
    const Kind& kind = kind_of(given.text("kind"));
    check_needs(kind, given);
    const rope::Shape shape = changed(kind.shape, kind, given);
    check_collider_count(edit.seen());
    edit.world().add_collider(name, shape);
}

void set(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const rope::Shape shape = changed(collider.shape, kind_of(rope::kind(collider.shape)), given);
    if (shape == collider.shape) return;
    Swing* const swing = swing_of(edit.part, given.text("name"));
    if (swing != nullptr && rope::centre(shape) != rope::centre(collider.shape))
        centre_on(*swing, rope::centre(shape), edit.part.time);
    edit.set_collider(given.text("name"), shape);
}

void move(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("name");
    collider_of(edit.seen(), name);
    const glm::vec3 to = given.point("to");
    if (Swing* swing = swing_of(edit.part, name)) centre_on(*swing, to, edit.part.time);
    edit.move_collider(name, to);
}

void remove_collider(RopeEdit& edit, const Arguments& given) {
    collider_of(edit.seen(), given.text("name"));
    edit.world().remove_collider(given.text("name"));
    forget_missing(edit.part);
}

/// It swings on from where it is: to change how far or how fast never makes it jump.
void set_swing(RopeEdit& edit, const Arguments& given) {
    const rope::Collider& collider = collider_of(edit.seen(), given.text("name"));
    const glm::vec3 by = given.point("by");
    const std::string name = given.text("name");
    Swing* swing = swing_of(edit.part, name);
    if (by == glm::vec3(0.0f)) {
        std::erase_if(edit.part.swings, [&](const Swing& s) { return s.collider == name; });
        return;
    }
    Swing wanted = swing ? *swing : Swing{.collider = name};
    const glm::vec3 at = swing ? swing_point(*swing, edit.part.time) : rope::centre(collider.shape);
    wanted.swing = by;
    if (given.has("period")) wanted.period = given.number("period");
    if (swing && wanted == *swing) return;
    centre_on(wanted, at, edit.part.time);
    if (swing)
        *swing = wanted;
    else
        edit.part.swings.push_back(wanted);
}

Argument name_argument() {
    return collider_argument("name", true, "which");
}

}  // namespace

void add_collider_commands(CommandTable& table) {
    const auto with_shape = [](std::vector<Argument> arguments) {
        for (const Argument& argument :
             {point_argument("centre", false, "of a sphere or box"),
              number_argument("radius", "of a sphere or capsule, metres", 0.0, 1e9),
              point_argument("a", false, "a capsule's end"), point_argument("b", false, "its other end"),
              point_argument("point", false, "on a plane"),
              point_argument("normal", false, "of a plane, outwards"),
              point_argument("half_extents", false, "of a box, metres"),
              Argument{.name = "rotation",
              .type = ArgumentType::Rotation,
              .required = false,
              .help = "of a box: [x, y, z, w], or degrees about X, Y and Z"}})
            arguments.push_back(argument);
        return arguments;
    };
    table.add(
        rope_command("rope.collider.add", "Add a collider",
                     with_shape({text_argument("name", true, "a new one"),
                                 choice_argument("kind", true,
                                                 "sphere: centre, radius; capsule: a, b, radius; "
                                                 "plane: point, normal; box: centre, half_extents, rotation",
                                                 names(kinds(), [](const Kind& k) { return k.name; }))}),
                     "Adds a body that ropes cannot enter", add_collider));
    table.add(rope_command("rope.collider.set", "Change a collider", with_shape({name_argument()}),
                           "Sets the place, size or rotation of a collider", set));
    table.add(rope_command("rope.collider.move", "Move a collider",
                           {name_argument(), point_argument("to", true, "where its centre goes, metres")},
                           "Moves a collider; it pushes what it meets", move));
    table.add(rope_command("rope.collider.remove", "Remove a collider", {name_argument()},
                           "Removes a collider", remove_collider));
    table.add(rope_command(
        "rope.collider.swing", "Swing a collider",
        {name_argument(), point_argument("by", true, "metres to each side; 0: off"),
         number_argument("period", "seconds", shortest_decimal(min_period), shortest_decimal(max_period))},
        "Makes a collider swing to and fro", set_swing));
}

}  // namespace tendril::app
