// The links of each kind of body, in the order in which it is built and solved. Not installed.
#pragma once

#include "tendril/rope/body.hpp"

namespace tendril::rope::detail {

/// Calls link(a, b, kind) for every link of `rows` rows of `columns` particles, numbered from 0: of a rope (a
/// single row), of a cloth, or of strands of hair.
template <class Visit>
void each_link(Body::Kind of, std::uint32_t columns, std::uint32_t rows, Visit link) {
    const auto at = [&](std::uint32_t c, std::uint32_t r) { return r * columns + c; };
    const auto along = [&](std::uint32_t step, Link::Kind kind) {
        for (std::uint32_t r = 0; r < rows; ++r)
            for (std::uint32_t c = 0; c + step < columns; ++c) link(at(c, r), at(c + step, r), kind);
    };
    const auto down = [&](std::uint32_t step, Link::Kind kind) {
        for (std::uint32_t c = 0; c < columns; ++c)
            for (std::uint32_t r = 0; r + step < rows; ++r) link(at(c, r), at(c, r + step), kind);
    };
    along(1, Link::Kind::Stretch);
    if (of == Body::Kind::Cloth) {
        down(1, Link::Kind::Stretch);
        for (std::uint32_t r = 0; r + 1 < rows; ++r)
            for (std::uint32_t c = 0; c + 1 < columns; ++c) {
                link(at(c, r), at(c + 1, r + 1), Link::Kind::Shear);
                link(at(c + 1, r), at(c, r + 1), Link::Kind::Shear);
            }
    }
    if (of != Body::Kind::Rope) along(2, Link::Kind::Bend);
    if (of == Body::Kind::Cloth) down(2, Link::Kind::Bend);
}

}  // namespace tendril::rope::detail
