// Unfolds the sections that hide the rows of a card's step or a palette's command.
#pragma once

#include "app/labs/card.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

struct ShellFrame;

class Unfolding {
  public:
    /// Unfolds once for each step, so that the user can fold it again.
    void for_step(const ShellFrame& frame, const CardStep* step, Emit& emit);
    void for_command(const ShellFrame& frame, const Emitted& command, Emit& emit);

  private:
    const CardStep* step_ = nullptr;
};

}  // namespace tendril::app
