// Places in the Chain lab's panel that tests click, at 1280 by 720 pixels, with every section unfolded.
#pragma once

#include "app/io/json_complete.hpp"

namespace tendril::test::chain_panel {

/// The arguments of view.fold that unfold every section.
inline app::Json unfolded() {
    return {{"section", "chain"}, {"folded", false}};
}

inline constexpr glm::vec2 forward{60.0f, 274.0f};
inline constexpr glm::vec2 target_y{173.0f, 668.0f};  ///< in the four trailing modes
// In mode Reach:
inline constexpr glm::vec2 iterations{173.0f, 523.0f};
inline constexpr glm::vec2 soft_zone{173.0f, 651.0f};

}  // namespace tendril::test::chain_panel
