// The fields of ropes, cloth, hair and colliders as users see them, and the settings of a body that hangs.
#pragma once

#include <optional>
#include <tendril/rope/hair_roots.hpp>

#include "app/fields/fields.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

class Arguments;

/// Optional fields are empty if the body has no such links or cannot tear.
struct BodySettings {
    float length = 1.0f;                   ///< metres; a row's of a cloth, a strand's of hair
    std::optional<float> width{};          ///< metres, across the rows of a cloth
    std::optional<int> segments{};         ///< segments of a rope or of each strand
    std::optional<int> columns{}, rows{};  ///< particles of a cloth
    double mass = 1.0;                     ///< kilograms, of the whole body
    std::optional<double> density{};       ///< kg/m, for cloth kg/m^2; none for a body without length
    float radius = 0.02f;                  ///< metres: half of its thickness
    float friction = 0.0f;                 ///< the world's, unless the body has its own
    /// Strain per newton, for a rope, a strand, or a strip of cloth a metre wide.
    std::optional<float> stretch{};
    std::optional<float> bending{};  ///< bending stiffness of a rope, N m^2
    /// Compliance of its links, m/N.
    std::optional<float> shear{}, bend{};
    std::optional<float> tear{};  ///< strain at which its links tear; 0: never
    BodyColour colour{};
    bool operator==(const BodySettings&) const = default;
};

BodySettings settings_of(const NamedWorld& world, const rope::Body& body);

class RopeEdit;

/// Applies the given fields to the body. Throws Refused for a field that the body lacks,
/// std::invalid_argument if the library refuses.
void set_body(RopeEdit& edit, const std::string& body, const Arguments& given);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept;

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<BodySettings>();
template <>
std::span<const FieldText> field_texts<rope::Settings>();
template <>
std::span<const FieldText> field_texts<rope::RopeShape>();
template <>
std::span<const FieldText> field_texts<rope::ClothShape>();
template <>
std::span<const FieldText> field_texts<rope::TieShape>();
template <>
std::span<const FieldText> field_texts<rope::HairShape>();
template <>
std::span<const FieldText> field_texts<rope::HairPatch>();
/// For all kinds of collider.
template <>
std::span<const FieldText> field_texts<rope::Shape>();
template <>
std::span<const FieldText> field_texts<rope::Drive>();

}  // namespace tendril::app
