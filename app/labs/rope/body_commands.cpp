#include "app/labs/rope/body_commands.hpp"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vector_relational.hpp>
#include <string>
#include <utility>

#include "app/io/json_complete.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fields.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {

// Commands that add, remove, pin and cut ropes, cloth and hair, and the panel's rows that add them.

namespace {

constexpr double max_particles = static_cast<double>(max_lab_particles);

std::size_t count_of(int particles) {
    return static_cast<std::size_t>(particles);
}

void add_rope(RopeEdit& edit, const Arguments& given) {
    rope::RopeShape shape;
    set_fields(given, shape);
    check_particle_count(edit.seen(), count_of(shape.segments) + 1);
    edit.world().add_rope(text_or_none(given, "name"), shape);
}

void add_cloth(RopeEdit& edit, const Arguments& given) {
    rope::ClothShape shape;
    if (given.has("material")) {
        const auto* const material =
            std::ranges::find(rope::cloth_materials, given.text("material"), &rope::ClothMaterial::name);
        shape.density = material->density;
        shape.shear = material->shear;
        shape.bend = material->bend;
    }
    set_fields(given, shape);
    check_particle_count(edit.seen(), count_of(shape.columns) * count_of(shape.rows));
    edit.world().add_cloth(text_or_none(given, "name"), shape);
}

void add_hair(RopeEdit& edit, const Arguments& given) {
    rope::HairShape shape;
    rope::HairPatch patch;
    std::string attach;
    set_fields(given, shape);
    set_fields(given, patch);
    check_particle_count(edit.seen(), count_of(patch.strands) * (count_of(shape.segments) + 1));
    if (given.has("attach")) {
        if (given.has("centre"))
            throw Refused("centre cannot be given for hair that is attached to a collider");
        const rope::Collider& collider = collider_of(edit.seen(), given.text("attach"));
        attach = given.text("attach");
        shape.roots = require_value(rope::roots_on(collider.shape, patch, shape.radius));
    } else {
        if (!given.has("centre"))
            throw Refused("centre is missing; or give attach, a collider to attach the hair to");
        shape.roots = require_value(rope::roots_around(patch));
    }
    edit.world().add_hair(text_or_none(given, "name"), std::move(shape), attach);
}

/// `hold` keeps a body without pins from falling until rope.let_go, as a drag does.
void move_body(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("rope");
    body_of(edit.seen(), name);
    if (given.point("by") != glm::vec3(0.0f))
        edit.world().change(name, &rope::World::move, given.point("by"));
    if (!given.has("hold") || !given.boolean("hold") || !edit.running()) return;
    const rope::Body moved = body_of(edit.seen(), name);
    const auto inside = [&](const rope::Pin& pin) { return pin.particle - moved.first < moved.count; };
    if (std::ranges::any_of(edit.seen().state().pins, inside)) return;
    let_go(edit.part);
    Hold held{name, {}};
    for (std::size_t i = 0; i < moved.count; ++i) {
        held.particles.push_back(i);
        edit.world().pin(moved.first + i, edit.seen().state().position[moved.first + i]);
    }
    edit.part.hold = std::move(held);
}

void remove_selected(RopeEdit& edit, const Arguments&) {
    const std::optional<RopeSelection> selection = edit.part.selection;
    if (!selection) throw Refused("nothing is selected");
    if (!selection->tie.empty())
        edit.world().change(selection->tie, &rope::World::untie);
    else if (!selection->collider.empty())
        edit.world().change(selection->collider, &rope::World::remove_collider);
    else
        edit.world().change(selection->body, &rope::World::remove);
    forget_missing(edit.part);
}

void pin(RopeEdit& edit, const Arguments& given) {
    if (given.has("at") && given.has("particles"))
        throw Refused("at is for one particle; several need points, one for each");
    if (given.has("points") && !given.has("particles")) throw Refused("points needs particles");
    const std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    for (const NamedParticle& named : all) forget_held(edit.part, named);  // it is pinned now
    if (given.has("at") || given.has("points")) return edit.move_pins(pin_places(given, all, "at", "points"));
    for (const NamedParticle& named : all)
        edit.world().pin(named.particle, edit.seen().position(named.particle));
}

void weigh(RopeEdit& edit, const Arguments& given) {
    rope::State state = edit.seen().state();
    for (const NamedParticle& named : named_particles(edit.seen(), given))
        state.mass[named.particle] = given.real("mass");
    edit.world().put(std::move(state));
}

void unpin(RopeEdit& edit, const Arguments& given) {
    std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    // Unpin from the end: removing the last element moves no other.
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.particle > b.particle; });
    for (const NamedParticle& named : all) {
        if (!edit.seen().pinned(named.particle)) continue;
        forget_held(edit.part, named);
        edit.world().unpin(named.particle);
    }
}

/// Divides a row of n segments into f(n), and a column of a cloth likewise.
template <class Divide>
void divide_body(RopeEdit& edit, const Arguments& given, Divide f) {
    const rope::Body& body = body_of(edit.seen(), given.text("rope"));
    rope::Resolution to = rope::resolution(body);
    to.columns = f(to.columns - 1) + 1;
    if (body.kind == rope::Body::Kind::Cloth) to.rows = f(to.rows - 1) + 1;
    resample_body(edit, given.text("rope"), to);
}

void subdivide(RopeEdit& edit, const Arguments& given) {
    divide_body(edit, given, [](std::size_t segments) { return 2 * segments; });
}

void merge(RopeEdit& edit, const Arguments& given) {
    divide_body(edit, given, [](std::size_t segments) { return (segments + 1) / 2; });
}

void cut(RopeEdit& edit, const Arguments& given) {
    const std::string name = given.text("rope");
    body_of(edit.seen(), name);
    const Became became = edit.world().cut(name, static_cast<std::size_t>(given.integer("segment")));
    follow_particles(edit.part, edit.world(), name, became);
    forget_missing(edit.part);
}

void cut_cloth(RopeEdit& edit, const Arguments& given) {
    constexpr std::size_t named = 3;
    std::size_t left = 1000;  // points
    const std::string name = given.text("rope");
    body_of(edit.seen(), name);
    std::vector<rope::ClothLine> lines;
    const auto read = [&](const JsonPlace& points) {
        rope::ClothLine& line = lines.emplace_back();
        points.for_each("points", left, [&](const JsonPlace& each) {
            each.check_size(2, "numbers, a column and a row");
            line.emplace_back(each.element(0).number(), each.element(1).number());
        });
        left -= line.size();
    };
    if (gives_one(given, "points", "lines"))
        read({given.json("points"), "points"});
    else
        JsonPlace(given.json("lines"), "lines").for_each("lines", left, read);
    const Became became = edit.world().cut_cloth(name, lines);
    follow_particles(edit.part, edit.world(), name, became);
    if (became.pieces.empty()) return;
    const std::size_t off = became.pieces.size(), shown = std::min(named, off);
    edit.said = "\"" + name + "\" is now in " + std::to_string(off + 1) + " pieces; ";
    for (std::size_t i = 0; i < shown; ++i) {
        if (i > 0) edit.said += i + 1 == off ? " and " : ", ";
        edit.said += "\"" + became.pieces[i] + "\"";
    }
    edit.said += off > named ? " and " + std::to_string(off - named) + " more came off" : " came off";
}

/// The fields of `Shapes`, with their defaults, and a name.
template <class... Shapes>
std::vector<Argument> adding_arguments(const char* otherwise) {
    std::vector<Argument> all;
    const FieldsOf fresh[] = {{fields<Shapes>(), tendril::detail::fresh<Shapes>()}...};
    for (const FieldsOf& shape : fresh) {
        const Json usual = save_fields(shape);
        for (Argument& each : field_arguments(shape.table, field_texts<BodySettings>())) {
            const Json& value = usual.at(each.name);
            if (value.is_number()) each.help += " Default: " + value.dump() + '.';
            all.push_back(std::move(each));
        }
    }
    all.push_back(text_argument("name", false, otherwise));
    return all;
}

void require_arguments(std::vector<Argument>& arguments, std::initializer_list<std::string_view> names) {
    for (Argument& each : arguments) each.required = std::ranges::count(names, each.name) != 0;
}

void add_adding_commands(CommandTable& table) {
    std::vector<Argument> of_rope = adding_arguments<rope::RopeShape>("default: \"rope\", \"rope 2\", ...");
    require_arguments(of_rope, {"from", "to"});
    table.add(rope_command("rope.add", "Add a rope", std::move(of_rope),
                           "Adds a rope: straight, or hanging if it is longer than the distance", add_rope));
    std::vector<Argument> of_cloth =
        adding_arguments<rope::ClothShape>("default: \"cloth\", \"cloth 2\", ...");
    of_cloth.push_back(choice_argument("material", false, "sets density, shear and bend; default: cotton",
                                       names(rope::cloth_materials, [](const rope::ClothMaterial& each) {
                                           return std::string(each.name);
                                       })));
    require_arguments(of_cloth, {"corner", "along", "down"});
    table.add(rope_command("rope.cloth.add", "Add a cloth", std::move(of_cloth), "Adds a cloth", add_cloth));
    std::vector<Argument> of_hair =
        adding_arguments<rope::HairShape, rope::HairPatch>("default: \"hair\", \"hair 2\", ...");
    of_hair.push_back(
        collider_argument("attach", false, "a collider that it grows from, instead of a centre"));
    table.add(rope_command("rope.hair.add", "Add hair", std::move(of_hair),
                           "Adds strands of hair, pinned at their roots", add_hair));
}

}  // namespace

void add_body_commands(CommandTable& table) {
    add_adding_commands(table);
    std::vector<Argument> made_of = field_arguments<BodySettings>();
    made_of.insert(made_of.begin(), body_argument("rope", true, "of a rope, cloth or hair"));
    made_of.push_back(text_argument("name", false, "its new name"));
    table.add(rope_command(
        "rope.set", "Change a rope, cloth or hair", std::move(made_of),
        "Changes the properties of a rope, cloth or hair; omitted ones are kept",
        [](RopeEdit& edit, const Arguments& given) { set_body(edit, given.text("rope"), given); }));
    table.add(rope_command("rope.subdivide", "Subdivide a rope, cloth or hair",
                           {body_argument("rope", true, "of a rope, cloth or hair")},
                           "Halves each segment; it keeps its shape, motion and material", subdivide));
    table.add(rope_command("rope.merge", "Merge segments in pairs",
                           {body_argument("rope", true, "of a rope, cloth or hair")},
                           "Merges its segments in pairs; it keeps its shape, motion and material", merge));
    table.add(
        rope_command("rope.reverse", "Reverse a rope", {rope_argument(true, "which")},
                     "Swaps the ends of a rope; pins, ties and motion do not change",
                     [](RopeEdit& edit, const Arguments& given) { reverse_rope(edit, given.text("rope")); }));
    table.add(rope_command(
        "rope.move", "Move a rope, cloth or hair",
        {body_argument("rope", true, "of a rope, cloth or hair"), point_argument("by", true, "metres"),
         switch_argument("hold", "true: a body without pins does not fall until rope.let_go")},
        "Moves a rope, cloth or hair with its pins; shape and motion do not change", move_body));
    table.add(rope_command("rope.remove", "Remove a rope, cloth or hair",
                           {body_argument("name", true, "of a rope, cloth or hair")},
                           "Removes a rope, cloth or hair", remove_named<body_of, &rope::World::remove>));
    table.add(rope_command("rope.remove_selected", "Delete selection", {}, "Deletes the selection",
                           remove_selected));
    table.add(
        rope_command("rope.pin", "Pin particles",
                     {rope_argument(true, "which"), particle_argument(false, "which"), particles_argument(),
                      point_argument("at", false, "metres; default: its present position"),
                      each_argument("points", "particles")},
                     "Pins particles in place, or at given points", pin));
    table.add(
        rope_command("rope.unpin", "Unpin particles",
                     {rope_argument(true, "which"), particle_argument(false, "which"), particles_argument()},
                     "Unpins particles", unpin));
    table.add(rope_command("rope.weight", "Hang a weight on particles",
                           {rope_argument(true, "which"),
                            particle_argument(false, "which"),
                            particles_argument(),
                            {.name = "mass", .help = "kg, of each", .low = 1e-9, .high = 1e6}},
                           "Sets the mass of particles; the rest of the body keeps its own", weigh));
    table.add(rope_command("rope.cut", "Cut a rope",
                           {rope_argument(true, "which"),
                            {.name = "segment",
                             .type = ArgumentType::Integer,
                             .help = "the one to remove",
                             .low = 0,
                             .high = max_particles - 1}},
                           "Cuts a rope in two", cut));
    table.add(
        rope_command("rope.cloth.cut", "Cut a cloth along lines",
                     {rope_argument(true, "a cloth"),
                      {.name = "points",
                       .type = ArgumentType::List,
                       .required = false,
                       .help = "of the line, each [column, row] of the cloth, from 0; between particles too"},
                      {.name = "lines",
                       .type = ArgumentType::List,
                       .required = false,
                       .help = "several at once, each a list of points"}},
                     "Cuts a cloth along lines through its own columns and rows", cut_cloth));
}

// The panel's rows that add objects, at a free position, and select them.

namespace {

/// The space taken by bodies and colliders, except planes; a swinging collider takes its whole path.
std::vector<Space> filled_spaces(const RopePart& part) {
    constexpr float apart = 0.1f;  // metres
    const NamedWorld& world = *part.world;
    std::vector<Space> all;
    for (const rope::Body& body : world.state().bodies) {
        Space space;
        for (std::size_t i = body.first; i < body.first + body.count; ++i) {
            space.low = glm::min(space.low, world.position(i));
            space.high = glm::max(space.high, world.position(i));
        }
        all.push_back({space.low - apart, space.high + apart});
    }
    for (const rope::Collider& collider : world.state().colliders) {
        Space space;
        include_shape(collider.shape, space.low, space.high);
        if (space.low.x > space.high.x) continue;
        glm::vec3 way(0.0f);
        for (const Swing& swing : part.swings)
            if (swing.collider == world.name(collider)) way = 2.0f * glm::abs(swing.swing);
        all.push_back({space.low - apart - way, space.high + apart + way});
    }
    return all;
}

}  // namespace

glm::vec3 free_place(const Workspace& workspace, const Space& needed) {
    constexpr float step = 0.2f;  // metres
    constexpr int most = 100;
    const std::vector<Space> filled = filled_spaces(rope_part(workspace));
    const auto is_free = [&](glm::vec3 at) {
        return std::ranges::none_of(filled, [&](const Space& each) { return each.meets(needed.moved(at)); });
    };
    // Search along the nearest axes of the grid, so that scenes stay tidy.
    const float yaw = glm::half_pi<float>() * std::round(workspace.camera.yaw / glm::half_pi<float>());
    const glm::vec3 right(std::round(math::cosine(yaw)), 0.0f, -std::round(math::sine(yaw)));
    const glm::vec3 behind(right.z, 0.0f, -right.x);
    const glm::vec3 middle = workspace.camera.target;
    for (int i = 0; i < most; ++i) {
        const float by = step * static_cast<float>(i);
        for (const glm::vec3& way : {right, -right, behind})
            if (is_free(middle + by * way)) return middle + by * way;
    }
    return middle;
}

void adding_rows(const Workspace& workspace, Emit& emit) {
    const RopePart& part = rope_part(workspace);
    /// Adds it under a free name, and selects it.
    const auto add = [&](bool body, const char* command, const char* stem, ArgumentList arguments) {
        const std::string name = free_name(stem, [&](const std::string& each) {
            return body ? part.world->find(each) != nullptr : part.world->find_collider(each) != nullptr;
        });
        arguments.push_back({"name", name});
        emit(command, arguments);
        emit("rope.select",
             body ? ArgumentList{{"rope", name}, {"particle", 0}} : ArgumentList{{"collider", name}});
    };
    if (row_button("Rope", 3, true, "A rope between two pins; set its length in the inspector")) {
        const glm::vec3 at = free_place(workspace, {{-0.6f, -0.1f, -0.1f}, {0.6f, 0.6f, 0.1f}});
        add(true, "rope.add", "rope",
            {{"from", at + glm::vec3(-0.6f, 0.6f, 0.0f)},
             {"to", at + glm::vec3(0.6f, 0.6f, 0.0f)},
             {"length", 1.7f},
             {"segments", 48},
             {"pin_start", true},
             {"pin_end", true}});
    }
    if (row_button("Cloth", 3, true, "A cloth that hangs by two corners")) {
        const glm::vec3 at = free_place(workspace, {{-0.5f, -0.2f, -0.3f}, {0.5f, 0.8f, 0.3f}});
        add(true, "rope.cloth.add", "cloth",
            {{"corner", at + glm::vec3(-0.5f, 0.8f, 0.0f)},
             {"along", glm::vec3(1, 0, 0)},
             {"down", glm::vec3(0.0f, -0.96f, 0.28f)},
             {"pins", "corners"}});
    }
    if (row_button("Hair", 3, true, "Strands of hair: on the selected collider, or from a point")) {
        ArgumentList arguments{{"strands", 48}, {"length", 0.6f}};
        if (part.selection && !part.selection->collider.empty())
            arguments.push_back({"attach", part.selection->collider});
        else
            arguments.push_back(
                {"centre", free_place(workspace, {{-0.2f, -0.2f, -0.2f}, {0.2f, 0.6f, 0.2f}}) +
                               glm::vec3(0.0f, 0.5f, 0.0f)});
        add(true, "rope.hair.add", "hair", std::move(arguments));
    }
    end_row();
    /// A free position for a collider with these half extents, if its button was pressed.
    const auto place = [&](const char* title, glm::vec3 half) -> std::optional<glm::vec3> {
        if (!row_button(title, 4, true, "A collider near the middle of the view")) return std::nullopt;
        return free_place(workspace, {-half, half});
    };
    const char* const command = "rope.collider.add";
    if (const auto at = place("Ball", glm::vec3(0.25f)))
        add(false, command, "ball", {{"kind", "sphere"}, {"centre", *at}, {"radius", 0.25f}});
    const glm::vec3 half(0.0f, 0.0f, 0.5f);
    if (const auto at = place("Bar", half + 0.1f))
        add(false, command, "bar",
            {{"kind", "capsule"}, {"a", *at - half}, {"b", *at + half}, {"radius", 0.1f}});
    if (const auto at = place("Box", glm::vec3(0.25f)))
        add(false, command, "box", {{"kind", "box"}, {"centre", *at}, {"half_extents", glm::vec3(0.25f)}});
    if (row_button("Floor", 4, true, "A plane at the height of the grid"))
        add(false, command, "floor",
            {{"kind", "plane"}, {"point", glm::vec3(0.0f)}, {"normal", glm::vec3(0, 1, 0)}});
    end_row();
}

}  // namespace tendril::app
