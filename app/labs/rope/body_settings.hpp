// What a rope, cloth or hair is made of, as a person changes it while it hangs: it goes on from where it is.
#pragma once

#include <optional>

#include "app/fields/fields.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

class Arguments;

/// Optional fields are empty if the body has no such links or cannot tear.
struct BodySettings {
    float length = 1.0f;   ///< metres; of a row of a cloth, of a strand of hair
    double mass = 1.0;     ///< kilograms, of the whole body
    float radius = 0.02f;  ///< metres: half of its thickness
    /// Compliance of its links, m/N.
    float stretch = 0.0f;
    std::optional<float> shear{}, bend{};
    std::optional<float> tear{};  ///< strain at which its links tear; 0: never
    bool operator==(const BodySettings&) const = default;
};

BodySettings settings_of(const NamedWorld& world, const rope::Body& body);

/// Applies the given fields to the body. Throws Refused for a field that the body lacks,
/// std::invalid_argument if the library refuses.
void set_body(NamedWorld& world, const std::string& body, const Arguments& given);

}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::BodySettings>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::BodySettings>();
