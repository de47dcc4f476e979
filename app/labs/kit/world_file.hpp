// A rope world in a scene file and in --state.
#pragma once

#include <string>

#include "app/document/json.hpp"
#include "app/labs/kit/named_world.hpp"

namespace tendril::app {

class JsonPlace;

/// Everything that a world remembers, bit for bit.
Json save_world(const NamedWorld& world);
/// Throws std::runtime_error with the place and what is wrong there, std::invalid_argument where its parts do
/// not fit together.
NamedWorld load_world(const JsonPlace& place);

/// {"kind": "sphere", "centre": ..., "radius": ...}
Json save_shape(const rope::Shape& shape);

const char* body_kind_name(rope::Body::Kind kind);

}  // namespace tendril::app
