// A rope world in a scene file and in --state.
#pragma once

#include <span>
#include <string_view>

#include "app/document/json.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

class JsonPlace;

/// The complete state of the world, bit for bit.
Json save_world(const NamedWorld& world);
/// Throws std::runtime_error with the JSON path and the fault, or std::invalid_argument if the parts do not
/// fit together. `besides`: other members, which the caller reads.
NamedWorld load_world(const JsonPlace& place, std::span<const std::string_view> besides = {});

/// The fields of the kind of shape that a collider has.
FieldsOf shape_fields(const rope::Collider& collider);

}  // namespace tendril::app
