// Names and ranges that files, commands and panels of this lab share.
#pragma once

#include <string>

#include "app/document/names.hpp"
#include "app/fields/fields.hpp"
#include "app/labs/kit/motion.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

inline constexpr int min_sides = 3, max_sides = 64;
inline constexpr double min_jitter_frame = 0.001, max_jitter_frame = 0.25;  ///< seconds

inline constexpr EnumNames<RopeTool, 3> rope_tools{
    "tool", {{"move", "Select"}, {"pin", "Pin or unpin"}, {"cut", "Cut"}}};

}  // namespace tendril::app

template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::rope::Settings>();
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RopeView>() noexcept;
template <>
std::span<const tendril::app::FieldText> tendril::app::field_texts<tendril::app::RopeView>();
