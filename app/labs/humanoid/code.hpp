// The character and its IK as a C++ program that uses the library.
#pragma once

#include <string>

namespace tendril::app {

struct HumanoidPart;
class Solvers;

/// A whole program: skeleton, bone map and this moment's pose as data, then feet, targets, gaze, hands and
/// springs as they are set, in the lab's order. Prints where every node is, the same numbers as the lab's.
/// Left out: ropes on the character, the fading after a target is released, and the triangles of a ground
/// mesh.
std::string humanoid_code(const HumanoidPart& part, Solvers& solvers);

}  // namespace tendril::app
