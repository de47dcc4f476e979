// Names and ranges that files, commands and panels of this lab share.
#pragma once

#include <string>

#include "app/labs/kit/motion.hpp"
#include "app/labs/kit/names.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

inline constexpr int fewest_sides = 3, most_sides = 64;
inline constexpr double shortest_jitter_frame = 0.001, longest_jitter_frame = 0.25;  ///< seconds

inline constexpr RopeTool all_tools[] = {RopeTool::Move, RopeTool::Pin, RopeTool::Cut};

inline const char* tool_name(RopeTool tool) {
    constexpr const char* tool_names[] = {"move", "pin", "cut"};
    return tool_names[static_cast<std::size_t>(tool)];
}

/// Throws std::invalid_argument for an unknown name.
inline RopeTool tool_from_name(const std::string& name) {
    return named(all_tools, tool_name, name, "tool");
}

}  // namespace tendril::app
