#include "app/labs/rope/body_commands.hpp"

#include <imgui.h>
#include <algorithm>
#include <glm/geometric.hpp>
#include <string>
#include <tendril/rope/hair_roots.hpp>
#include <utility>

#include "app/labs/kit/arguments.hpp"
#include "app/labs/rope/body_settings.hpp"
#include "app/labs/rope/panel.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

// Ropes, cloth and hair: adding, removing, pinning, cutting.

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

// What the Rope lab's panel adds: where there is free space, and selected at once.

namespace {

/// "ball", "ball 2", ...: the first name that is not taken.
template <class Taken>
std::string free_name(const std::string& kind, Taken taken) {
    std::string name = kind;
    for (int i = 2; taken(name); ++i) name = kind + " " + std::to_string(i);
    return name;
}

/// The middle of the view, or as near to it as nothing is in the way: to the right of it and nearer, one
/// after the other.
glm::vec3 free_place(const Workspace& workspace) {
    constexpr float apart = 0.35f;  // metres
    const rope::State& state = rope_part(workspace).world->state();
    const auto taken = [&](glm::vec3 at) {
        const auto near = [&](glm::vec3 other) { return glm::distance(at, other) < apart; };
        return std::any_of(state.colliders.begin(), state.colliders.end(),
                           [&](const rope::Collider& each) { return near(rope::centre(each.shape)); }) ||
               std::any_of(state.bodies.begin(), state.bodies.end(), [&](const rope::Body& body) {
                   return near(glm::vec3(state.position[body.first + body.count / 2]));
               });
    };
    const glm::vec3 middle = workspace.camera.target;
    for (int ring = 0; ring < 40; ++ring) {
        for (int side = 0; side <= ring; ++side) {
            const float right = static_cast<float>(ring - side), nearer = static_cast<float>(side);
            const glm::vec3 at = middle + 2.0f * apart * glm::vec3(right, 0.0f, nearer);
            if (!taken(at)) return at;
        }
    }
    return middle;
}

class Adding {
  public:
    Adding(const Workspace& workspace, Emit& emit)
        : workspace_(workspace), part_(rope_part(workspace)), emit_(emit) {}

    void bodies() {
        if (row_button("Rope", 3, true, "A rope that hangs between two pins")) {
            const glm::vec3 at = free_place(workspace_);
            body("rope.add", "rope",
                 {{"from", at + glm::vec3(-0.6f, 0.6f, 0.0f)},
                  {"to", at + glm::vec3(0.6f, 0.6f, 0.0f)},
                  {"length", 1.7f},
                  {"segments", 48},
                  {"pin_start", true},
                  {"pin_end", true}});
        }
        if (row_button("Cloth", 3, true, "A cloth that hangs by two corners")) {
            const glm::vec3 at = free_place(workspace_);
            body("rope.cloth.add", "cloth",
                 {{"corner", at + glm::vec3(-0.5f, 0.8f, 0.0f)},
                  {"along", glm::vec3(1, 0, 0)},
                  {"down", glm::vec3(0.0f, -0.6f, 0.8f)},
                  {"pins", "corners"}});
        }
        const bool on_collider = part_.selection && !part_.selection->collider.empty();
        if (row_button("Hair", 3, true, "Strands of hair: on the selected collider, or from a point")) {
            ArgumentList arguments{{"strands", 48}, {"length", 0.6f}};
            if (on_collider)
                arguments.push_back({"attach", part_.selection->collider});
            else
                arguments.push_back({"centre", free_place(workspace_) + glm::vec3(0.0f, 0.5f, 0.0f)});
            body("rope.hair.add", "hair", std::move(arguments));
        }
        end_row();
    }

    void colliders() {
        using Shape = ArgumentList (*)(glm::vec3);
        const auto row = [&](const char* title, const char* name, const char* kind, Shape shape) {
            const bool plane = std::string(kind) == "plane";
            const char* const tip =
                plane ? "A plane at the height of the grid" : "A collider near the middle of the view";
            if (row_button(title, 4, true, tip)) collider(name, kind, shape(free_place(workspace_)));
        };
        row("Ball", "ball", "sphere", [](glm::vec3 at) {
            return ArgumentList{{"centre", at}, {"radius", 0.25f}};
        });
        row("Bar", "bar", "capsule", [](glm::vec3 at) {
            const glm::vec3 half(0.0f, 0.0f, 0.5f);
            return ArgumentList{{"a", at - half}, {"b", at + half}, {"radius", 0.1f}};
        });
        row("Box", "box", "box", [](glm::vec3 at) {
            return ArgumentList{{"centre", at}, {"half_extents", glm::vec3(0.25f)}};
        });
        row("Floor", "floor", "plane", [](glm::vec3) {
            return ArgumentList{{"point", glm::vec3(0.0f)}, {"normal", glm::vec3(0, 1, 0)}};
        });
        end_row();
    }

  private:
    void body(const char* command, const char* kind, ArgumentList arguments) {
        const auto taken = [&](const std::string& n) { return part_.world->find(n) != nullptr; };
        const std::string name = free_name(kind, taken);
        arguments.push_back({"name", name});
        emit_(command, arguments);
        emit_("rope.select", {{"rope", name}, {"particle", 0}});
    }
    void collider(const char* name, const char* kind, const ArgumentList& shape) {
        const auto taken = [&](const std::string& n) { return part_.world->find_collider(n) != nullptr; };
        const std::string free = free_name(name, taken);
        ArgumentList arguments{{"name", free}, {"kind", kind}};
        arguments.insert(arguments.end(), shape.begin(), shape.end());
        emit_("rope.collider.add", arguments);
        emit_("rope.select", {{"collider", free}});
    }

    const Workspace& workspace_;
    const RopePart& part_;
    Emit& emit_;
};

}  // namespace

void adding_rows(const Workspace& workspace, Emit& emit) {
    ImGui::PushID("add");  // a scene and a button of this section may have the same title
    Adding adding(workspace, emit);
    adding.bodies();
    adding.colliders();
    ImGui::PopID();
}

}  // namespace tendril::app
