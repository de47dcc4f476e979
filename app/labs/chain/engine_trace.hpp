// A trace from an engine as the Chain lab's past: each frame becomes a moment of the strip, with what was
// found in it, and beside it as a ghost what the lab's solver makes of the same input.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/view/draw_list.hpp"

namespace tendril::app {

struct View;

/// Whether a file's text begins like a trace, for Lab::files().
bool begins_like_trace(std::string_view text);

/// Whether pasted text is one: two frames or more, or a pose with a target.
bool holds_trace(const std::string& text);

/// The ghost's joints, while the chain shows a frame of a trace; else null.
const std::vector<glm::vec3>* traced_ghost(const ChainPart& part);
void draw_traced_ghost(const View& view, const ChainPart& part, DrawList& list);

void add_trace_commands(CommandTable& table);

}  // namespace tendril::app
