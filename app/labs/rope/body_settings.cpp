#include "app/labs/rope/body_settings.hpp"

#include <cmath>
#include <tendril/magnitude.hpp>

#include "app/document/argument.hpp"
#include "app/document/refused.hpp"
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/rope_edit.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept {
    using app::BodySettings;
    constexpr FieldRange any{0.0, max_magnitude};
    static constexpr Field rows[] = {field<&BodySettings::length>("length", {1e-6, max_magnitude}, "m"),
                                     field<&BodySettings::mass>("mass", {1e-9, max_magnitude}, "kg"),
                                     field<&BodySettings::radius>("radius", any, "m"),
                                     field<&BodySettings::stretch>("stretch", any, "m/N"),
                                     field<&BodySettings::shear>("shear", any, "m/N"),
                                     field<&BodySettings::bend>("bend", any, "m/N"),
                                     field<&BodySettings::tear>("tear", any)};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<BodySettings>() {
    static constexpr FieldText texts[] = {
        {.name = "length",
         .label = "length",
         .help = "Of a rope, a row of a cloth or a strand of hair: all of its segments change in proportion.",
         .step = 0.005f,
         .decimals = 3},
        {.name = "mass", .label = "mass", .help = "Total mass of the body.", .step = 0.005f, .decimals = 3},
        {.name = "radius",
         .label = "radius",
         .help = "Half its thickness: how far its particles keep from colliders.",
         .step = 0.0005f,
         .decimals = 4},
        {.name = "stretch",
         .label = "stretch",
         .help = "How much longer a segment gets under a newton, in addition to the world's compliance. "
                 "Relaxation counts this alone.",
         .step = 1e-5f,
         .decimals = 5},
        {.name = "shear",
         .label = "shear",
         .help = "How easily a cloth shears across its threads. Higher values drape more softly.",
         .step = 0.001f,
         .decimals = 4},
        {.name = "bend",
         .label = "bend",
         .help = "How easily a cloth or a hair bends. More is limper.",
         .step = 0.001f,
         .decimals = 4},
        {.name = "tear",
         .label = "tears at",
         .help = "The strain at which a cloth tears, 0.1 for a tenth over its length; 0: never."}};
    return texts;
}

namespace {

/// Of its links of that kind, which it has.
float compliance_of(const NamedWorld& world, const rope::Body& body, rope::Link::Kind kind) {
    for (const rope::Link& link : world.state().links)
        if (link.kind == kind && link.a >= body.first && link.a < body.first + body.count)
            return link.compliance;
    return 0.0f;
}

}  // namespace

BodySettings settings_of(const NamedWorld& world, const rope::Body& body) {
    using Kind = rope::Link::Kind;
    BodySettings settings{.length = static_cast<float>(world.length(body)),
                          .mass = world.world().mass(body),
                          .radius = body.radius,
                          .stretch = compliance_of(world, body, Kind::Stretch)};
    if (body.kind != rope::Body::Kind::Rope) settings.bend = compliance_of(world, body, Kind::Bend);
    if (body.kind != rope::Body::Kind::Cloth) return settings;
    settings.shear = compliance_of(world, body, Kind::Shear);
    settings.tear = body.tear;
    return settings;
}

void set_body(NamedWorld& world, const std::string& name, const Arguments& given) {
    using Kind = rope::Link::Kind;
    const rope::Body& body = body_of(world, name);
    const BodySettings now = settings_of(world, body);
    for (const Field& field : fields<BodySettings>())
        if (given.has(field.name) && field.optional && std::isnan(field.get(&now)[0]))
            throw Refused("\"" + name + "\" is a " + body_kind_name(body.kind) + "; it has no " + field.name);
    BodySettings wanted = now;
    set_fields(given, wanted);
    if (wanted.length != now.length) world.set_length(name, wanted.length);
    if (wanted.mass != now.mass) world.set_mass(name, wanted.mass);
    if (wanted.radius != now.radius) world.set_radius(name, wanted.radius);
    if (wanted.stretch != now.stretch) world.set_compliance(name, Kind::Stretch, wanted.stretch);
    if (wanted.shear != now.shear) world.set_compliance(name, Kind::Shear, *wanted.shear);
    if (wanted.bend != now.bend) world.set_compliance(name, Kind::Bend, *wanted.bend);
    if (wanted.tear != now.tear) world.set_tear(name, *wanted.tear);
}

}  // namespace tendril::app
