// Names and ranges that files, commands and panels of this lab share.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

inline constexpr float shortest_swing = 0.1f, longest_swing = 600.0f;  ///< periods, seconds
inline constexpr int fewest_sides = 3, most_sides = 64;
inline constexpr double shortest_jitter_frame = 0.001, longest_jitter_frame = 0.25;  ///< seconds

inline constexpr RopeTool all_tools[] = {RopeTool::Move, RopeTool::Pin, RopeTool::Cut};

inline const char* tool_name(RopeTool tool) {
    constexpr const char* tool_names[] = {"move", "pin", "cut"};
    return tool_names[static_cast<std::size_t>(tool)];
}

/// Throws std::invalid_argument for an unknown name.
inline RopeTool tool_from_name(const std::string& name) {
    for (const RopeTool tool : all_tools)
        if (name == tool_name(tool)) return tool;
    throw std::invalid_argument("unknown tool \"" + name + "\"");
}

}  // namespace tendril::app
