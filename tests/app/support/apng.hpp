// A strict reader of animated PNG: throws at any deviation from the specification.
#pragma once

#include "app/io/image.hpp"

namespace tendril::test {

struct ApngFrame {
    app::Image image;                         ///< the complete picture
    unsigned numerator = 0, denominator = 0;  ///< duration in seconds
    glm::ivec2 changed{0};                    ///< size of the part stored in the file
};

struct Apng {
    glm::ivec2 size{0};
    unsigned plays = 0;  ///< 0: forever
    std::vector<ApngFrame> frames;
};

/// Throws std::runtime_error.
Apng read_apng(std::string_view bytes);

}  // namespace tendril::test
