// The fields of ropes, cloth, hair and colliders as users see them, and the settings of a body that hangs.
#pragma once

#include <optional>
#include <tendril/rope/hair_roots.hpp>

#include "app/fields/fields.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

class Arguments;

/// The settings of rope.set: the library's body, and quantities computed from its particles and links.
/// Those are empty if the body has no such particles or links.
struct BodySettings {
    rope::Body body;                       ///< its radius, friction, bending and tear
    float length = 1.0f;                   ///< metres; a row's of a cloth, a strand's of hair
    std::optional<float> width{};          ///< metres, across the rows of a cloth
    std::optional<int> segments{};         ///< segments of a rope or of each strand
    std::optional<int> columns{}, rows{};  ///< particles of a cloth
    double mass = 1.0;                     ///< kilograms, of the whole body
    std::optional<double> density{};       ///< kg/m, for cloth kg/m^2; none for a body without length
    std::optional<float> stretch{};        ///< 1/N, for a rope, a strand, or a metre's width of cloth
    std::optional<float> shear{}, bend{};  ///< compliance of its links, m/N
    BodyColour colour = BodyColour::ByKind;
};

BodySettings settings_of(const NamedWorld& world, const rope::Body& body);
/// The rows that the body has: a cloth has no bending.
std::vector<Field> body_fields(const BodySettings& of);

class RopeEdit;

/// Applies the given fields to the body. Throws Refused for a field that the body lacks,
/// std::invalid_argument if the library refuses.
void set_body(RopeEdit& edit, const std::string& body, const Arguments& given);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept;

namespace tendril::app {

/// Also for the shapes that make bodies, and for patches of hair.
template <>
std::span<const FieldText> field_texts<BodySettings>();
template <>
std::span<const FieldText> field_texts<rope::TieShape>();
/// For all kinds of collider.
template <>
std::span<const FieldText> field_texts<rope::Shape>();
template <>
std::span<const FieldText> field_texts<rope::Drive>();
template <>
std::span<const FieldText> field_texts<Swing>();
template <>
std::span<const FieldText> field_texts<Jitter>();

}  // namespace tendril::app
