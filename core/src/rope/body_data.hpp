// A body taken out of its world to be edited, and put back. Not installed.
#pragma once

#include <cstddef>
#include <vector>

#include "tendril/rope/state.hpp"

namespace tendril::rope::detail {

/// Particles are numbered from 0.
struct BodyData {
    std::size_t row = 1;
    std::vector<std::uint32_t> cells{};  ///< as in Body
    std::vector<glm::dvec3> position{}, displacement{};
    std::vector<double> mass{};
    std::vector<Link> links{};
    std::vector<Pin> pins{};  ///< sorted by particle
};

/// Replaces a body by its edited form. `becomes`: the new particle of each old one.
void replace_body(State& state, BodyId id, const BodyData& data, const std::vector<std::size_t>& becomes);

/// Leaves out rows and columns without particles, and the cells of a grid without gaps.
void crop(Body& body);

void measure_stretch(const State& state, Body& body) noexcept;

}  // namespace tendril::rope::detail
