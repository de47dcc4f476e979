// A rope world in a scene file and in --state.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/document/json.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

class JsonPlace;

/// The complete state of the world, bit for bit.
Json save_world(const NamedWorld& world);
/// Throws std::runtime_error with the JSON path and the fault, or std::invalid_argument if the parts do not
/// fit together.
NamedWorld load_world(const JsonPlace& place);

/// A shape of each kind; null for an unknown one.
std::span<const rope::Shape> blank_shapes();
const rope::Shape* blank_shape(std::string_view kind);
/// The shape of a kind, for reading and writing by its table.
FieldsOf shape_fields_of(const rope::Shape& shape);
FieldsIn shape_fields_in(rope::Shape& shape);
/// {"kind": "sphere", "centre": ..., "radius": ...}
Json save_shape(const rope::Shape& shape);

const char* body_kind_name(rope::Body::Kind kind);

}  // namespace tendril::app
