// Ropes, cloth and hair: adding, removing, pinning, cutting.
#include <algorithm>
#include <tendril/rope/hair_roots.hpp>
#include <utility>

#include "app/labs/kit/index_list.hpp"
#include "app/labs/kit/require.hpp"
#include "app/labs/rope/body_settings.hpp"
#include "app/labs/rope/rope_commands.hpp"

namespace tendril::app {
namespace {

constexpr double max_particles = static_cast<double>(max_lab_particles);
constexpr const char* pins_names[] = {"none", "corners", "row"};

std::string name_of(const Arguments& given) {
    return given.has("name") ? given.text("name") : std::string();
}

std::size_t count_of(int particles) {
    return static_cast<std::size_t>(particles);
}

void add_rope(RopeEdit& edit, const Arguments& given) {
    rope::RopeShape shape{.from = given.point("from"), .to = given.point("to")};
    if (given.has("segments")) shape.segments = given.integer("segments");
    if (given.has("length")) shape.length = given.number("length");
    if (given.has("radius")) shape.radius = given.number("radius");
    if (given.has("pin_start")) shape.pin_start = given.boolean("pin_start");
    if (given.has("pin_end")) shape.pin_end = given.boolean("pin_end");
    check_particle_count(edit.seen(), count_of(shape.segments) + 1);
    edit.world().add_rope(name_of(given), shape);
}

void add_cloth(RopeEdit& edit, const Arguments& given) {
    rope::ClothShape shape{
        .corner = given.point("corner"), .along = given.point("along"), .down = given.point("down")};
    if (given.has("columns")) shape.columns = given.integer("columns");
    if (given.has("rows")) shape.rows = given.integer("rows");
    if (given.has("radius")) shape.radius = given.number("radius");
    if (given.has("material")) {
        const auto* const material =
            std::ranges::find(rope::cloth_materials, given.text("material"), &rope::ClothMaterial::name);
        shape.density = material->density;
        shape.shear = material->shear;
        shape.bend = material->bend;
    }
    if (given.has("density")) shape.density = given.number("density");
    if (given.has("shear")) shape.shear = given.number("shear");
    if (given.has("bend")) shape.bend = given.number("bend");
    if (given.has("tear")) shape.tear = given.number("tear");
    if (given.has("pins")) {
        const auto* const pins = std::find(std::begin(pins_names), std::end(pins_names), given.text("pins"));
        shape.pins = static_cast<rope::ClothShape::Pins>(pins - std::begin(pins_names));
    }
    check_particle_count(edit.seen(), count_of(shape.columns) * count_of(shape.rows));
    edit.world().add_cloth(name_of(given), shape);
}

void add_hair(RopeEdit& edit, const Arguments& given) {
    rope::HairShape shape;
    std::string attach;
    if (given.has("length")) shape.length = given.number("length");
    if (given.has("segments")) shape.segments = given.integer("segments");
    if (given.has("radius")) shape.radius = given.number("radius");
    if (given.has("density")) shape.density = given.number("density");
    if (given.has("bend")) shape.bend = given.number("bend");
    rope::HairPatch patch;
    if (given.has("direction")) patch.direction = given.point("direction");
    if (given.has("strands")) patch.strands = given.integer("strands");
    if (given.has("spread")) patch.radius = given.number("spread");
    check_particle_count(edit.seen(), count_of(patch.strands) * (count_of(shape.segments) + 1));
    if (given.has("attach")) {
        if (given.has("centre")) throw Refused("centre is not for hair that is attached to a collider");
        const rope::Collider& collider = collider_of(edit.seen(), given.text("attach"));
        attach = given.text("attach");
        shape.roots = require_value(rope::roots_on(collider.shape, patch, shape.radius));
    } else {
        if (!given.has("centre")) throw Refused("centre is missing, or a collider to attach the hair to");
        patch.centre = given.point("centre");
        shape.roots = require_value(rope::roots_around(patch));
    }
    edit.world().add_hair(name_of(given), std::move(shape), attach);
}

void remove_body(RopeEdit& edit, const Arguments& given) {
    body_of(edit.seen(), given.text("name"));
    edit.world().remove(given.text("name"));
    forget_missing(edit.part);
}

void remove_selected(RopeEdit& edit, const Arguments&) {
    const std::optional<RopeSelection> selection = edit.part.selection;
    if (!selection) throw Refused("nothing is selected");
    if (selection->collider.empty())
        edit.world().remove(selection->body);
    else
        edit.world().remove_collider(selection->collider);
    forget_missing(edit.part);
}

void pin(RopeEdit& edit, const Arguments& given) {
    if (given.has("at") && given.has("particles"))
        throw Refused("at is for one particle: pinned to one point, several would be on top of each other");
    if (given.has("points") && !given.has("particles")) throw Refused("points is for particles");
    const std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    for (const NamedParticle& named : all) forget_held(edit.part, named);  // now it is held for good
    if (given.has("at") || given.has("points")) return edit.move_pins(pin_places(given, all, "at", "points"));
    for (const NamedParticle& named : all)
        edit.world().pin(named.particle, edit.seen().position(named.particle));
}

void unpin(RopeEdit& edit, const Arguments& given) {
    std::vector<NamedParticle> all = named_particles(edit.seen(), given);
    // From the last: what is taken from the end of a list moves nothing.
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.particle > b.particle; });
    for (const NamedParticle& named : all) {
        if (!edit.seen().pinned(named.particle)) continue;
        forget_held(edit.part, named);
        edit.world().unpin(named.particle);
    }
}

/// What pointed behind the cut points at the same particle of the new rope.
void follow_cut(std::string& body, std::size_t& particle, const std::string& cut_rope, std::size_t segment,
                const std::string& rest) {
    if (body != cut_rope || particle <= segment) return;
    body = rest;
    particle -= segment + 1;
}

/// The selection goes with its active particle.
void follow_cut(RopeSelection& selection, const std::string& cut_rope, std::size_t segment,
                const std::string& rest) {
    if (selection.body != cut_rope) return;
    std::size_t active = selection.particle();
    const bool behind = active > segment;
    follow_cut(selection.body, active, cut_rope, segment, rest);
    std::vector<std::size_t> stay;
    for (const std::size_t each : selection.particles.all())
        if ((each > segment) == behind) stay.push_back(behind ? each - segment - 1 : each);
    stay.push_back(active);
    selection.particles.take(stay, false);
}

/// All that is held is on one side of the cut.
void follow_cut(Hold& hold, const std::string& cut_rope, std::size_t segment, const std::string& rest) {
    std::string body = hold.body;
    for (std::size_t& each : hold.particles) {
        body = hold.body;
        follow_cut(body, each, cut_rope, segment, rest);
    }
    hold.body = body;
}

void cut(RopeEdit& edit, const Arguments& given) {
    const rope::Body& body = body_of(edit.seen(), given.text("rope"));
    const std::string name = given.text("rope");
    const auto segment = static_cast<std::size_t>(given.integer("segment"));
    if (body.kind == rope::Body::Kind::Rope && segment + 1 >= body.count) {
        throw Refused("segment " + std::to_string(segment) + " is out of range, \"" + name + "\" has " +
                      std::to_string(body.count == 0 ? 0 : body.count - 1));
    }
    RopePart& part = edit.part;
    if (part.hold && part.hold->body == name && part.hold->particles.front() <= segment &&
        part.hold->particles.back() > segment)
        let_go(part);
    const std::string rest = edit.world().cut(name, segment);
    if (part.selection) follow_cut(*part.selection, name, segment, rest);
    if (part.hold) follow_cut(*part.hold, name, segment, rest);
    forget_missing(part);
}

Argument own_name(const char* otherwise) {
    return text_argument("name", false, otherwise);
}

void add_adding_commands(CommandTable& table) {
    table.add(rope_command("rope.add", "Add a rope",
                           {point_argument("from", true, "metres"), point_argument("to", true, "metres"),
                            own_name("\"rope\", \"rope 2\", ... when left out"),
                            integer_argument("segments", "32 when left out", 1, max_particles - 1),
                            number_argument("length", "metres; the distance when left out", 0.0, 1e9),
                            number_argument("radius", "metres; 0.02 when left out", 0.0, 1e9),
                            switch_argument("pin_start", "pins its first particle"),
                            switch_argument("pin_end", "pins its last particle")},
                           "Adds a rope: straight, or hanging where it is longer than the distance",
                           add_rope));
    table.add(rope_command(
        "rope.cloth.add", "Add a cloth",
        {point_argument("corner", true, "metres"),
         point_argument("along", true, "from the corner to the other end of the first row"),
         point_argument("down", true, "from the corner to the last row"),
         own_name("\"cloth\", \"cloth 2\", ... when left out"),
         integer_argument("columns", "particles; 24 when left out", 2, max_particles),
         integer_argument("rows", "particles; 24 when left out", 2, max_particles),
         number_argument("radius", "metres; 0.01 when left out", 0.0, 1e9),
         choice_argument("material", false, "its density, shear and bend; cotton when left out",
                         names(rope::cloth_materials,
                               [](const rope::ClothMaterial& each) { return std::string(each.name); })),
         number_argument("density", "kg/m^2; the material's when left out", 0.0, 1e9),
         number_argument("shear", "compliance, m/N; the material's when left out", 0.0, 1e9),
         number_argument("bend", "compliance, m/N; the material's when left out", 0.0, 1e9),
         number_argument("tear", "strain at which links tear; 0: never", 0.0, 1e9),
         choice_argument("pins", false, "of its first row",
                         names(pins_names, [](const char* name) { return name; }))},
        "Adds a cloth", add_cloth));
    table.add(rope_command(
        "rope.hair.add", "Add hair",
        {own_name("\"hair\", \"hair 2\", ... when left out"),
         point_argument("centre", false, "of the patch that it grows from"),
         collider_argument("attach", false, "a collider that it grows from, instead of a centre"),
         point_argument("direction", false, "of growth; down, or outwards from a collider"),
         integer_argument("strands", "32 when left out", 1, max_particles),
         number_argument("spread", "the patch's radius, metres; 0.1 when left out", 0.0, 1e9),
         number_argument("length", "metres; 0.5 when left out", 0.0, 1e9),
         integer_argument("segments", "of a strand; 16 when left out", 2, max_particles - 1),
         number_argument("radius", "metres; 0.004 when left out", 0.0, 1e9),
         number_argument("density", "kg/m; 0.05 when left out", 0.0, 1e9),
         number_argument("bend", "compliance, m/N", 0.0, 1e9)},
        "Adds strands of hair, pinned at their roots", add_hair));
}

}  // namespace

void add_body_commands(CommandTable& table) {
    add_adding_commands(table);
    std::vector<Argument> made_of = field_arguments<BodySettings>();
    made_of.insert(made_of.begin(), body_argument("rope", true, "of a rope, cloth or hair"));
    table.add(rope_command(
        "rope.set", "Change a rope, cloth or hair", std::move(made_of),
        "Changes what a body is made of while it hangs; what is left out stays",
        [](RopeEdit& edit, const Arguments& given) { set_body(edit.world(), given.text("rope"), given); }));
    table.add(rope_command("rope.remove", "Remove a rope, cloth or hair",
                           {body_argument("name", true, "of a rope, cloth or hair")},
                           "Removes a rope, cloth or hair", remove_body));
    table.add(rope_command("rope.remove_selected", "Delete selection", {}, "Deletes the selection",
                           remove_selected));
    table.add(
        rope_command("rope.pin", "Pin particles",
                     {rope_argument(true, "which"), particle_argument(false, "which"), particles_argument(),
                      point_argument("at", false, "metres; where it is when left out"),
                      each_argument("points", "particles")},
                     "Pins particles to where they are, or to points", pin));
    table.add(
        rope_command("rope.unpin", "Unpin particles",
                     {rope_argument(true, "which"), particle_argument(false, "which"), particles_argument()},
                     "Unpins particles", unpin));
    table.add(rope_command("rope.cut", "Cut a rope",
                           {rope_argument(true, "which"),
                            {.name = "segment",
                             .type = ArgumentType::Integer,
                             .help = "the one to remove",
                             .low = 0,
                             .high = max_particles - 1}},
                           "Cuts a rope in two", cut));
}

}  // namespace tendril::app
