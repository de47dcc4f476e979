// Reads animated PNG, strictly as the specification has it: what is wrong with a file throws.
#pragma once

#include <string_view>
#include <vector>

#include "app/io/image.hpp"

namespace tendril::test {

struct ApngFrame {
    app::Image image;                         ///< the whole picture while it is shown
    unsigned numerator = 0, denominator = 0;  ///< of the seconds that it is shown
    glm::ivec2 changed{0};                    ///< size of the part that the file has of it
};

struct Apng {
    glm::ivec2 size{0};
    unsigned plays = 0;  ///< 0: for ever
    std::vector<ApngFrame> frames;
};

/// Throws std::runtime_error.
Apng read_apng(std::string_view bytes);

}  // namespace tendril::test
