// Export: a chain, how it follows its target and with what, as a program against tendril::core.
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

/// A whole C++ program. It makes the very chain that is here (while a solve is studied: the one that every
/// solve starts from), does once what moving the target does, and prints where each segment came to lie, in
/// digits that read back as the same floats.
std::string chain_code(const ChainPart& part);

// Numbers, points and limits as C++ has them; what code.cpp is built of.

/// More values than this stand in a table of plain numbers: less to read, and compiled in no time.
inline constexpr std::size_t max_listed = 64;

/// "22.5"
std::string degrees_text(float radians);
/// "SvdDls", "BallAndSocket"
std::string enumerator(ik::Method method);
std::string enumerator(ik::JointKind kind);

/// The statement that gives `name` this limit, its angles told in degrees beside it. Each line begins with
/// `margin`; ends with a newline.
std::string readable(const std::string& name, const ik::Limit& limit, const std::string& margin);

/// "static const float NAME[] = {...};", four numbers a line.
std::string number_table(const char* name, const std::vector<float>& numbers);
std::vector<float> segment_numbers(const Chain& chain);
std::vector<float> rotation_numbers(const std::vector<glm::quat>& rotations);
/// A type JointLimit {joint, limit} and the table joint_limits of those that are not free.
std::string limit_table(const std::vector<ik::Limit>& limits);

}  // namespace tendril::app
