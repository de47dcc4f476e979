// The body of the built-in figure: a smooth mannequin, computed from the bones.
//
// Rounded cones along the bones are blended into one distance field (I. Quilez, "Smooth minimum"), whose
// surface becomes triangles by surface nets (S. Gibson, "Constrained elastic surface nets", MICCAI 1998). It
// is bound with the arms half lowered, so that shoulders keep their shape in a T-pose and beside the body.
#pragma once

#include <tendril/humanoid/bone_map.hpp>
#include <tendril/humanoid/skeleton.hpp>

#include "app/io/character/skin.hpp"

namespace tendril::app {

/// A closed surface that follows the mapped bones, for a figure that stands in T-pose facing +Z, Y up. No
/// mesh unless all bones are mapped and have a length.
Skin figure_body(const humanoid::Skeleton& skeleton, const humanoid::BoneMap& map);

}  // namespace tendril::app
