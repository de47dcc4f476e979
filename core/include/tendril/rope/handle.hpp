// The handles of a rope world.
#pragma once

#include "tendril/handle.hpp"

namespace tendril::rope {

using BodyId = Handle<struct BodyKind>;
using ColliderId = Handle<struct ColliderKind>;
using TieId = Handle<struct TieKind>;

}  // namespace tendril::rope
