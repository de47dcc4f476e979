// Export: the chain, its mode and its options as a C++ program that uses tendril::core.
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <tendril/chain/chain.hpp>
#include <tendril/ik/limit.hpp>
#include <tendril/ik/method.hpp>
#include <vector>

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/kit/code_text.hpp"

namespace tendril::app {

/// A complete C++ program. It builds the chain (while a study is open, its start), moves it once to the
/// target as the lab does, and prints the position of each segment exactly.
std::string chain_code(const ChainPart& part);

// Numbers, points and limits as C++ source, for code.cpp.

/// Longer lists are written as tables of plain numbers: shorter, and fast to compile.
inline constexpr std::size_t max_listed = 64;

/// "SvdDls", "BallAndSocket"
std::string enumerator(ik::Method method);
std::string enumerator(ik::JointKind kind);

/// "static const float NAME[] = {...};", four numbers per line.
std::string number_table(const char* name, const std::vector<float>& numbers);
std::vector<float> segment_numbers(const Chain& chain);
std::vector<float> rotation_numbers(const std::vector<glm::quat>& rotations);
/// A type JointLimit {joint, limit} and a table joint_limits of the limits that are not free.
std::string limit_table(const std::vector<ik::Limit>& limits);

}  // namespace tendril::app
