// Whether two pictures look the same to a person.
//
// Two measures, in CIELAB, where a difference of about 2.3 is just noticeable. Each has a limit; a picture
// differs when more pixels are beyond one of them than `max_pixels`.
//
// Colour: how far a pixel lies outside the range of colours that the other picture has within one pixel of it
// (both ways), as a mean over 3 x 3. An edge that is smoothed a little differently, or lies a fraction of a
// pixel elsewhere, stays within that range; a surface of another colour, or something missing, does not.
// Shape: how far the pictures, blurred by 1 4 6 4 1, are apart. Sees what the first forgives in busy places:
// a letter that became another one.
//
// Noise of two levels of 255 passes, and so do two versions of a rasteriser. A colour off by some eight
// levels on a joint's ball, a missing segment, and a label moved by 3 px do not (compare_test.cpp proves
// each).
#pragma once

#include <string>

#include "app/io/image.hpp"

namespace tendril::test {

struct Tolerance {
    float colour = 2.0f;
    float shape = 9.0f;
    int max_pixels = 16;  ///< a lone pixel that fell the other way spoils thirteen
};

struct Difference {
    bool same = true;
    int pixels = 0;       ///< beyond a limit
    float colour = 0.0f;  ///< the largest found of either measure
    float shape = 0.0f;
    glm::ivec2 worst{0};  ///< where
    app::Image picture;   ///< the expected one, dim, with what differs in red; empty for equal pictures

    /// One line for a failed test.
    std::string text() const;
};

Difference compare(const app::Image& expected, const app::Image& actual, const Tolerance& tolerance = {});

}  // namespace tendril::test
