#include "app/labs/rope/rope_fields.hpp"

#include <algorithm>
#include <cmath>
#include <tendril/magnitude.hpp>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/rope_edit.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept {
    using app::BodySettings;
    constexpr FieldRange any{0.0, max_magnitude}, extent{1e-6, max_magnitude};
    constexpr double most = app::max_lab_particles;
    static constexpr auto colours = app::body_colours.name_array();
    static constexpr Field rows[] = {
        field<&BodySettings::length>("length", extent, "m"),
        field<&BodySettings::width>("width", extent, "m"),
        field<&BodySettings::segments>("segments", {1.0, most - 1.0}),
        field<&BodySettings::columns>("columns", {2.0, most / 2.0}),
        field<&BodySettings::rows>("rows", {2.0, most / 2.0}),
        field<&BodySettings::mass>("mass", {1e-9, max_magnitude}, "kg"),
        field<&BodySettings::density>("density", {rope::min_density, max_magnitude}, "kg/m"),
        field<&BodySettings::radius>("radius", any, "m"),
        field<&BodySettings::friction>("friction", {0.0, rope::max_friction}),
        field<&BodySettings::stretch>("stretch", any, "1/N"),
        field<&BodySettings::bending>("bending", any, "N m^2"),
        field<&BodySettings::shear>("shear", any, "m/N"),
        field<&BodySettings::bend>("bend", any, "m/N"),
        field<&BodySettings::tear>("tear", any),
        field<&BodySettings::colour>("colour", colours)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept {
    using app::RopeView;
    static constexpr Field rows[] = {field<&RopeView::particles>("particles"),
                                     field<&RopeView::strain>("strain"),
                                     field<&RopeView::sides>("sides", {app::min_sides, app::max_sides})};
    return rows;
}

namespace tendril::app {

namespace {

// Rows that bodies and ties share.

constexpr FieldText length_row(const char* help) {
    return {.name = "length", .label = "length", .help = help, .step = 0.005f, .decimals = 3};
}
constexpr FieldText compliance_row(const char* name, int decimals, const char* help) {
    return {.name = name,
            .label = name,
            .help = help,
            .step = decimals > 1 ? 0.01f : 1.0f,
            .decimals = decimals,
            .scale = 1000.0,
            .unit = "mm/N"};
}
/// `percent`: shown as a fraction of a length, instead of in the field's unit.
constexpr FieldText tears_row(const char* name, bool percent, const char* help) {
    return {.name = name,
            .label = "tears at",
            .help = help,
            .step = 0.5f,
            .decimals = 1,
            .scale = percent ? 100.0 : 1.0,
            .unit = percent ? "%" : nullptr,
            .at_zero = "never"};
}

}  // namespace

template <>
std::span<const FieldText> field_texts<BodySettings>() {
    static constexpr FieldText texts[] = {
        length_row(
            "Of a rope, a row of a cloth or a strand of hair: all of its segments change in proportion, and "
            "its mass with them."),
        {.name = "width",
         .label = "width",
         .help = "Of a cloth, across its rows.",
         .step = 0.005f,
         .decimals = 3},
        {.name = "segments",
         .label = "segments",
         .help = "Of a rope or a strand of hair. It keeps its shape, motion and material; pins and ties stay "
                 "where they are."},
        {.name = "columns",
         .label = "columns",
         .help = "Particles in a row of a cloth. It keeps its shape, motion and material."},
        {.name = "rows",
         .label = "rows",
         .help = "Rows of particles of a cloth. It keeps its shape, motion and material."},
        {.name = "mass", .label = "mass", .help = "Total mass of the body.", .step = 0.005f, .decimals = 3},
        {.name = "density",
         .label = "density",
         .help = "Mass of a metre of a rope or strand, or of a square metre of cloth.",
         .step = 0.005f,
         .decimals = 3},
        {.name = "radius",
         .label = "radius",
         .help = "Half its thickness: how far its particles keep from colliders.",
         .step = 0.0005f,
         .decimals = 4},
        {.name = "friction",
         .label = "friction",
         .help =
             "Coulomb's coefficient between it and colliders. Set to the world's, it follows that again."},
        {.name = "stretch",
         .label = "stretch",
         .help =
             "The fraction of its length that a rope or strand stretches per newton, or a strip of cloth a "
             "metre wide, in addition to the world's compliance. Relaxation uses only this.",
         .scale = 100.0,
         .unit = "%/N"},
        {.name = "bending",
         .label = "bending",
         .help = "How hard a rope is to bend: Young's modulus times the second moment of its cross-section. "
                 "A shoelace has 1e-5, a garden hose 0.1, a steel wire of 3 mm 0.8. Only the direct solver "
                 "bends.",
         .step = 0.001f,
         .decimals = 4,
         .at_zero = "limp"},
        compliance_row("shear", 1,
                       "How easily a cloth shears across its threads. Higher values drape more softly."),
        compliance_row("bend", 1,
                       "How easily a cloth or a hair bends. Higher values are limper: a limp cloth crumples "
                       "at its free edge unless it collides with itself."),
        tears_row("tear", true,
                  "The strain at which a cloth or rope tears: at 10 %, in commands 0.1, it is a tenth "
                  "longer. 0: never."),
        {.name = "colour",
         .label = "colour",
         .help =
             "Its colour in the picture and the legend. By its kind, ropes, cloth and hair differ. Strain "
             "shown as colour hides it.",
         .listed = true,
         .choices = body_colours.rows}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<RopeView>() {
    static constexpr FieldText texts[] = {
        {.name = "strain",
         .label = "Strain as colour",
         .help = "Colours each rope by how much its segments are stretched or squeezed."},
        {.name = "particles", .label = "Particles", .help = "Draws the particles that ropes are made of."},
        {.name = "sides",
         .label = "sides",
         .help = "How many sides ropes have in the picture. More look rounder and take longer to draw.",
         .more = true}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::RopeShape>() {
    static constexpr FieldText texts[] = {{.name = "from", .help = "Its first particle."},
                                          {.name = "to", .help = "Its last particle."},
                                          {.name = "segments", .help = "Default: 32."},
                                          {.name = "length", .help = "Default: the distance."},
                                          {.name = "radius", .help = "Half its thickness; default: 0.02."},
                                          {.name = "density", .help = "Default: 1."},
                                          {.name = "bending", .help = "Its bending stiffness; default: 0."},
                                          {.name = "pin_start", .help = "Pins its first particle."},
                                          {.name = "pin_end", .help = "Pins its last particle."}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::ClothShape>() {
    static constexpr FieldText texts[] = {
        {.name = "corner", .help = "The first particle of the first row."},
        {.name = "along", .help = "From the corner to the other end of the first row."},
        {.name = "down", .help = "From the corner to the last row."},
        {.name = "columns", .help = "Particles in a row; default: 24."},
        {.name = "rows", .help = "Default: 24."},
        {.name = "radius", .help = "Half its thickness; default: 0.01."},
        {.name = "density", .help = "Default: the material's."},
        {.name = "shear", .help = "Compliance; default: the material's."},
        {.name = "bend", .help = "Compliance; default: the material's."},
        {.name = "tear", .help = "The strain at which links tear; 0: never."},
        {.name = "pins", .help = "Which part of its first row is pinned"}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::TieShape>() {
    static constexpr FieldText texts[] = {
        length_row("How far apart it keeps its two particles; 0: in one place."),
        tears_row("strength", false, "The force at which it tears; 0: never.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::HairShape>() {
    static constexpr FieldText texts[] = {
        {.name = "length", .help = "Of a strand; default: 0.5."},
        {.name = "segments", .help = "Of a strand; default: 16."},
        {.name = "radius", .help = "Half the thickness of a strand; default: 0.004."},
        {.name = "density", .help = "Default: 0.05."},
        {.name = "bend", .help = "Compliance; default: 0.1."}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::HairPatch>() {
    static constexpr FieldText texts[] = {
        {.name = "centre", .help = "The middle of the patch that it grows from."},
        {.name = "direction", .help = "Of growth; default: down, or outwards from a collider."},
        {.name = "strands", .help = "Default: 32."},
        {.name = "spread", .help = "The radius of the patch; default: 0.1."}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::Shape>() {
    static constexpr FieldText texts[] = {
        {.name = "centre", .help = "The middle of a sphere or box."},
        {.name = "radius",
         .label = "radius",
         .help = "From the middle of a sphere or capsule to its surface.",
         .step = 0.002f,
         .decimals = 3},
        {.name = "a", .label = "one end", .help = "The middle of one of a capsule's round ends."},
        {.name = "b", .label = "other end", .help = "The middle of its other round end."},
        {.name = "point", .help = "A point on a plane."},
        {.name = "normal",
         .label = "normal",
         .help = "The direction out of a plane: ropes stay on this side. Its length does not matter.",
         .decimals = 3},
        {.name = "half_extents",
         .label = "half extents",
         .help = "From the middle of a box to its faces, along its own axes: half its size.",
         .step = 0.005f,
         .decimals = 3},
        {.name = "rotation",
         .label = "rotation",
         .help = "Turns a box: [x, y, z, w], or degrees about X, Y and Z. In the panel: about its own axes.",
         .step = 0.5f,
         .decimals = 1}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::Drive>() {
    static constexpr FieldText texts[] = {
        {.name = "velocity",
         .label = "moves at",
         .help = "A steady velocity; what lies on it goes along. A plane stays, and its surface moves: a "
                 "conveyor belt.",
         .step = 0.02f,
         .in_line = true},
        {.name = "axis",
         .label = "turns about",
         .help = "The axis through its centre that it turns about.",
         .in_line = true},
        {.name = "spin",
         .label = "turns by",
         .help = "How fast it turns; what lies on it turns along.",
         .step = 0.5f,
         .decimals = 1}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::Settings>() {
    static constexpr EnumRow solvers[] = {rope_solvers.row(rope::Solver::Direct),
                                          rope_solvers.row(rope::Solver::Xpbd),
                                          rope_solvers.row(rope::Solver::Relaxation)};
    static constexpr FieldText texts[] = {
        {.name = "substep",  // the panel has a row of substeps per second
         .help = "The length of the equal steps that the simulation takes. Shorter ones follow fast motion "
                 "better and cost more."},
        {.name = "iterations",
         .label = "iterations",
         .help = "The maximum number of passes per substep. Direct stops as soon as it has converged; with "
                 "the others, more passes stretch a rope less and cost more.",
         .more = true},
        {.name = "solver",
         .label = "solver",
         .help = "How the lengths of ropes are kept.",
         .listed = true,
         .choices = solvers},
        {.name = "damping",
         .label = "damping",
         .help = "How fast motion dies away. Raise it if ropes swing for too long.",
         .more = true},
        {.name = "gravity",
         .label = "gravity",
         .help = "The acceleration due to gravity, along each axis; Y points up. On Earth it is 0, -9.81, 0.",
         .step = 0.05f,
         .more = true},
        {.name = "gravity_scale", .label = "gravity scale", .help = "Multiplies gravity.", .more = true},
        {.name = "external",
         .label = "push",
         .help = "A steady acceleration of everything that moves, in addition to gravity.",
         .step = 0.05f,
         .more = true},
        {.name = "wind",
         .label = "wind",
         .help = "The velocity of the air along each axis. It pushes cloth, ropes and hair, and makes a flag "
                 "flutter. At 0 there is no air, unless still air resists.",
         .step = 0.05f,
         .decimals = 1,
         .in_line = true},
        {.name = "gusts",
         .label = "gusts",
         .help = "How much the wind varies, relative to its speed. At 0 it is steady.",
         .more = true},
        {.name = "still_air",
         .label = "still air resists",
         .help = "Whether air resists without wind too: cloth then falls slowly, and swings less and less.",
         .more = true},
        {.name = "compliance",
         .label = "compliance",
         .help = "How elastic ropes are: the fraction of its length that a rope stretches per newton. 0 does "
                 "not stretch; relaxation ignores it.",
         .scale = 100.0,
         .unit = "%/N",
         .more = true},
        {.name = "friction",
         .label = "friction",
         .help = "Coulomb's coefficient between ropes and colliders. At 0 ropes slide off; more holds "
                 "them.",
         .more = true},
        {.name = "longest_frame",
         .label = "longest frame",
         .help = "The most time that a frame simulates; the rest is dropped, so that a slow frame does not "
                 "make the next one slower.",
         .step = 1.0f,
         .decimals = 0,
         .scale = 1000.0,
         .unit = "ms",
         .more = true}};
    return texts;
}

BodySettings settings_of(const NamedWorld& world, const rope::Body& body) {
    using Kind = rope::Link::Kind;
    const auto compliance = [&](Kind kind) -> std::optional<float> {
        const auto its = [&](const rope::Link& link) {
            return link.kind == kind && link.a - body.first < body.count;
        };
        if (std::ranges::none_of(world.state().links, its)) return std::nullopt;
        return static_cast<float>(world.world().compliance(body, kind));
    };
    const rope::Resolution now = rope::resolution(body);
    BodySettings settings{.length = static_cast<float>(world.length(body)),
                          .mass = world.world().mass(body),
                          .radius = body.radius,
                          .friction = body.friction.value_or(world.settings().friction),
                          .stretch = compliance(Kind::Stretch),
                          .colour = world.colour(body)};
    if (const double density = world.world().density(body); density > 0.0) settings.density = density;
    if (body.kind == rope::Body::Kind::Rope) settings.bending = body.bending;
    if (body.kind != rope::Body::Kind::Rope) settings.bend = compliance(Kind::Bend);
    if (body.kind != rope::Body::Kind::Hair) settings.tear = body.tear;
    if (body.kind != rope::Body::Kind::Cloth) {
        settings.segments = static_cast<int>(now.columns) - 1;
        return settings;
    }
    settings.width = static_cast<float>(world.world().width(body));
    settings.columns = static_cast<int>(now.columns);
    settings.rows = static_cast<int>(now.rows);
    settings.shear = compliance(Kind::Shear);
    return settings;
}

void set_body(RopeEdit& edit, const std::string& name, const Arguments& given) {
    using Kind = rope::Link::Kind;
    using rope::World;
    const rope::Body& body = body_of(edit.seen(), name);
    const BodySettings now = settings_of(edit.seen(), body);
    for (const Field& field : fields<BodySettings>())
        if (given.has(field.name) && field.optional && std::isnan(field.get(&now)[0]))
            throw Refused("\"" + name + "\" is a " + rope::body_kinds[static_cast<std::size_t>(body.kind)] +
                          "; it has no " + field.name);
    if (given.has("mass") && given.has("density"))
        throw Refused("give mass or density, not both: each follows from the other");
    BodySettings wanted = now;
    set_fields(given, wanted);
    if (wanted.segments != now.segments)
        resample_body(edit, name,
                      {static_cast<std::size_t>(*wanted.segments) + 1, rope::resolution(body).rows});
    if (wanted.columns != now.columns || wanted.rows != now.rows)
        resample_body(edit, name,
                      {static_cast<std::size_t>(*wanted.columns), static_cast<std::size_t>(*wanted.rows)});
    NamedWorld& world = edit.world();
    if (wanted.length != now.length) world.change(name, &World::set_length, wanted.length);
    if (wanted.width != now.width) world.change(name, &World::set_width, *wanted.width);
    if (given.has("mass")) world.change(name, &World::set_mass, wanted.mass);
    if (given.has("density")) world.change(name, &World::set_density, *wanted.density);
    if (wanted.radius != now.radius) world.change(name, &World::set_radius, wanted.radius);
    if (given.has("friction")) {
        const bool own = wanted.friction != world.settings().friction;
        world.change(name, &World::set_friction, own ? std::optional(wanted.friction) : std::nullopt);
    }
    if (wanted.stretch != now.stretch)
        world.change(name, &World::set_compliance, Kind::Stretch, *wanted.stretch);
    if (wanted.bending != now.bending) world.change(name, &World::set_bending, *wanted.bending);
    if (wanted.shear != now.shear) world.change(name, &World::set_compliance, Kind::Shear, *wanted.shear);
    if (wanted.bend != now.bend) world.change(name, &World::set_compliance, Kind::Bend, *wanted.bend);
    if (wanted.tear != now.tear) world.change(name, &World::set_tear, *wanted.tear);
    if (wanted.colour != now.colour) world.set_colour(name, wanted.colour);
    if (given.has("name")) rename_body(edit, name, given.text("name"));
}

}  // namespace tendril::app
