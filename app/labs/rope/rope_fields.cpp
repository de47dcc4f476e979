#include "app/labs/rope/rope_part.hpp"

#include <algorithm>
#include <tendril/magnitude.hpp>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/rope/rope_edit.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept {
    using app::BodySettings;
    using rope::Body, rope::ClothShape, rope::HairShape, rope::RopeShape;
    static constexpr auto colours = app::body_colours.name_array();
    static const Field rows[] = {app::field_like<&BodySettings::length, &HairShape::length>(),
                                 app::field_like<&BodySettings::width, &HairShape::length>("width"),
                                 app::field_like<&BodySettings::segments, &RopeShape::segments>(),
                                 app::field_like<&BodySettings::columns, &ClothShape::columns>(),
                                 app::field_like<&BodySettings::rows, &ClothShape::rows>(),
                                 field<&BodySettings::mass>("mass", {1e-9, max_magnitude}, "kg"),
                                 app::field_like<&BodySettings::density, &RopeShape::density>(),
                                 app::field_in<&BodySettings::body, &Body::radius>(),
                                 app::field_in<&BodySettings::body, &Body::friction>(),
                                 field<&BodySettings::stretch>("stretch", {0.0, max_magnitude}, "1/N"),
                                 app::field_in<&BodySettings::body, &Body::bending>(),
                                 app::field_like<&BodySettings::shear, &ClothShape::shear>(),
                                 app::field_like<&BodySettings::bend, &ClothShape::bend>(),
                                 app::field_in<&BodySettings::body, &Body::tear>(),
                                 field<&BodySettings::colour>("colour", colours)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept {
    using app::RopeView;
    static constexpr auto colours = app::body_colours.name_array();
    static constexpr Field rows[] = {field<&RopeView::strain>("strain"),
                                     field<&RopeView::particles>("particles"),
                                     field<&RopeView::sides>("sides", {app::min_sides, app::max_sides}),
                                     field<&RopeView::thickness>("thickness", {0.1, 20.0}),
                                     field<&RopeView::ropes>("ropes", colours),
                                     field<&RopeView::hair>("hair", colours),
                                     field<&RopeView::cloths>("cloths", colours)};
    return rows;
}

namespace tendril::app {

namespace {

// Rows that bodies and ties share.

/// In millimetres or grams.
constexpr FieldText fine_row(const char* name, const char* help) {
    return {.name = name, .label = name, .help = help, .step = 0.005f, .decimals = 3};
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
constexpr FieldText kind_colour(const char* name, const char* help) {
    return {.name = name,
            .label = name,
            .help = help,
            .more = true,
            .listed = true,
            .choices = body_colours.rows};
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
        {.name = "from", .help = "A rope's first particle."},
        {.name = "to", .help = "A rope's last particle."},
        {.name = "corner", .help = "The first particle of a cloth's first row."},
        {.name = "along", .help = "From the corner to the other end of the first row."},
        {.name = "down", .help = "From the corner to the last row."},
        fine_row("length",
                 "How long a rope, a row of a cloth or a strand of hair is. All its segments change in "
                 "proportion, and its mass with them; a weight on a particle stays. Default for a rope: the "
                 "distance of its ends."),
        fine_row("width", "Width of a cloth, across its rows."),
        {.name = "segments",
         .label = "segments",
         .help = "Segments of a rope or a strand of hair. A change keeps shape, motion and material; pins "
                 "and ties stay in place."},
        {.name = "columns",
         .label = "columns",
         .help = "Particles in a row of a cloth. A change keeps shape, motion and material."},
        {.name = "rows",
         .label = "rows",
         .help = "Rows of particles of a cloth. A change keeps shape, motion and material."},
        fine_row("mass", "Total mass of the body."),
        fine_row("density", "Mass of a metre of a rope or strand, or of a square metre of cloth."),
        {.name = "radius",
         .label = "radius",
         .help = "Half its thickness: how far its particles keep from colliders.",
         .step = 0.0005f,
         .decimals = 4},
        {.name = "friction",
         .label = "friction",
         .help = "Coulomb's coefficient between it and colliders. Set it to the world's to follow the world "
                 "again."},
        {.name = "stretch",
         .label = "stretch",
         .help =
             "The fraction of its length that a rope or strand stretches per newton, or a strip of cloth a "
             "metre wide, in addition to the world's compliance. Relaxation uses only this.",
         .decimals = 4,
         .scale = 100.0,
         .unit = "%/N",
         .at_zero = "none"},
        {.name = "bending",
         .label = "bending",
         .help = "How hard a rope is to bend: Young's modulus times the second moment of its cross-section. "
                 "A shoelace has 1e-5, a garden hose 0.1, a steel wire of 3 mm 0.8. Direct solver only.",
         .step = 0.001f,
         .decimals = 4,
         .at_zero = "limp"},
        compliance_row("shear", 1,
                       "How easily a cloth shears across its threads. Higher values drape more softly."),
        compliance_row("bend", 1,
                       "How easily a cloth or a hair bends. Higher values are limper: a limp cloth crumples "
                       "at its free edge unless it collides with itself."),
        tears_row(
            "tear", true,
            "The strain at which a cloth or rope tears: at 10 %, in commands 0.1, it is a tenth longer. A "
            "rope needs some stretch to tear under a load: with 0.1 %/N it tears at 100 N. At 0, never."),
        {.name = "colour",
         .label = "colour",
         .help = "Its colour in the picture and the legend. By its kind: ropes, cloth and hair differ. "
                 "Hidden while strain is shown as colour.",
         .listed = true,
         .choices = body_colours.rows},
        {.name = "pin_start", .help = "Pins a rope's first particle."},
        {.name = "pin_end", .help = "Pins a rope's last particle."},
        {.name = "pins", .help = "Which part of a cloth's first row is pinned; default: none"},
        {.name = "centre", .help = "The middle of the patch that hair grows from."},
        {.name = "direction", .help = "Direction of growth; default: down, or outwards from a collider."},
        {.name = "strands", .help = "Strands of hair in the patch."},
        {.name = "spread", .help = "The radius of the patch."}};
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
         .more = true},
        {.name = "thickness",
         .label = "thickness",
         .help =
             "Draws ropes and hair this many times thicker, so that thin ones are easier to see and grab. "
             "Collisions do not change.",
         .step = 0.02f,
         .decimals = 1,
         .unit = "times",
         .more = true},
        kind_colour("ropes", "The colour of ropes that have none of their own."),
        kind_colour("hair", "The colour of hair that has none of its own."),
        kind_colour("cloths", "The colour of the fronts of cloths that have none of their own.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<rope::TieShape>() {
    static constexpr FieldText texts[] = {
        fine_row("length", "How far apart it keeps its two particles; 0: in one place."),
        tears_row("strength", false, "The force at which it tears; 0: never.")};
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
         .help = "Half the size of a box along its own axes: from its middle to its faces.",
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
    static constexpr FieldText texts[] = {{.name = "velocity",
                                           .label = "moves at",
                                           .help = "A steady velocity; bodies on it move along. A plane "
                                                   "stays in place, and its surface moves: a conveyor belt.",
                                           .step = 0.02f,
                                           .in_line = true},
                                          {.name = "axis",
                                           .label = "turns about",
                                           .help = "The axis through its centre that it turns about.",
                                           .in_line = true},
                                          {.name = "spin",
                                           .label = "turns by",
                                           .help = "How fast it turns; bodies on it turn with it.",
                                           .step = 0.5f,
                                           .decimals = 1}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<Swing>() {
    static constexpr FieldText texts[] = {{.name = "period",
                                           .label = "period",
                                           .help = "How long it takes to swing there and back.",
                                           .step = 0.02f}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<Jitter>() {
    static constexpr FieldText texts[] = {
        {.name = "rate",
         .label = "frame rate",
         .help = "How many frames a second has. At any rate the simulation stays the same.",
         .step = 1.0f,
         .decimals = 0,
         .more = true},
        {.name = "dial",
         .label = "frame-time jitter",
         .help =
             "How uneven frames are. 0: all alike; 100 % (1 in commands): 1 to 250 ms. The picture stutters, "
             "the simulation stays the same.",
         .step = 0.5f,
         .decimals = 0,
         .scale = 100.0,
         .unit = "%",
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
    BodySettings settings{.body = body,
                          .length = static_cast<float>(world.length(body)),
                          .mass = world.world().mass(body),
                          .stretch = compliance(Kind::Stretch),
                          .colour = world.colour(body)};
    if (const double density = world.world().density(body); density > 0.0) settings.density = density;
    if (body.kind != rope::Body::Kind::Rope) settings.bend = compliance(Kind::Bend);
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

std::vector<Field> body_fields(const BodySettings& of) {
    using Kind = rope::Body::Kind;
    std::vector<Field> rows;
    for (const Field& field : fields<BodySettings>()) {
        const std::string_view name = field.name;
        const bool lacks = name == "bending" ? of.body.kind != Kind::Rope
                           : name == "tear"  ? of.body.kind == Kind::Hair
                                             : name != "friction" && field.empty(&of);
        if (lacks) continue;
        rows.push_back(field);
        if (name == "density" && of.body.kind == Kind::Cloth)
            rows.back().unit = field_of<&rope::ClothShape::density>().unit;
    }
    return rows;
}

void set_body(RopeEdit& edit, const std::string& name, const Arguments& given) {
    using Kind = rope::Link::Kind;
    using rope::World;
    const rope::Body& body = body_of(edit.seen(), name);
    const BodySettings now = settings_of(edit.seen(), body);
    const std::vector<Field> rows = body_fields(now);
    for (const Field& field : fields<BodySettings>())
        if (given.has(field.name) && find_field(rows, field.name) == nullptr)
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
    if (wanted.body.radius != now.body.radius) world.change(name, &World::set_radius, wanted.body.radius);
    if (given.has("friction")) {
        const bool own = wanted.body.friction != world.settings().friction;
        world.change(name, &World::set_friction, own ? wanted.body.friction : std::nullopt);
    }
    if (wanted.stretch != now.stretch)
        world.change(name, &World::set_compliance, Kind::Stretch, *wanted.stretch);
    if (wanted.body.bending != now.body.bending) world.change(name, &World::set_bending, wanted.body.bending);
    if (wanted.shear != now.shear) world.change(name, &World::set_compliance, Kind::Shear, *wanted.shear);
    if (wanted.bend != now.bend) world.change(name, &World::set_compliance, Kind::Bend, *wanted.bend);
    if (wanted.body.tear != now.body.tear) world.change(name, &World::set_tear, wanted.body.tear);
    if (wanted.colour != now.colour) world.set_colour(name, wanted.colour);
    if (!edit.running() && (wanted.length != now.length || wanted.width != now.width)) {
        std::vector<rope::PinPlace> kept;
        for (const rope::Pin& pin : world.state().pins)
            if (!pin.collider) kept.push_back({pin.particle, pin.goal});
        edit.move_pins(kept);
    }
    if (given.has("name")) rename_body(edit, name, given.text("name"));
}

}  // namespace tendril::app
