// Tables of structs that the library itself only passes: other languages need their members' names and types
// too.
#pragma once

#include "tendril/fields.hpp"
#include "tendril/ik/two_bone.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBone>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::TwoBoneResult>() noexcept;
