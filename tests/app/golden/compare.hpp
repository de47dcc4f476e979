// Decides whether two pictures look the same to a viewer.
//
// Two measures in CIELAB, where a difference of about 2.3 is just noticeable. Pictures differ if more than
// `max_pixels` pixels exceed the limit of either measure.
//
// Colour: the distance of a pixel from the range of colours within one pixel of it in the other picture (both
// ways), averaged over 3 x 3. An edge that is smoothed slightly differently, or shifted by a fraction of a
// pixel, stays within that range; a surface of another colour, or a missing object, does not. Shape: the
// difference of the pictures blurred by 1 4 6 4 1. Finds a changed letter in a busy area.
//
// Noise of two levels of 255 passes, and so do two versions of a rasteriser. A colour off by about eight
// levels on a joint's ball, a missing segment, and a label moved by 3 px do not (compare_test.cpp proves
// each).
#pragma once

#include "app/io/image.hpp"

namespace tendril::test {

struct Tolerance {
    float colour = 2.0f;
    float shape = 9.0f;
    int max_pixels = 16;  ///< a single flipped pixel affects thirteen
};

struct Difference {
    bool same = true;
    int pixels = 0;       ///< beyond a limit
    float colour = 0.0f;  ///< the maximum of either measure
    float shape = 0.0f;
    glm::ivec2 worst{0};  ///< its position
    app::Image picture;   ///< the expected one, dimmed, with differences in red; empty if equal

    /// One line for the message of a failed test.
    std::string text() const;
};

Difference compare(const app::Image& expected, const app::Image& actual, const Tolerance& tolerance = {});

}  // namespace tendril::test
