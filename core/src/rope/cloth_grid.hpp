// A cloth as a grid: its links and particles in the layout of a GridSystem, and that system for one substep.
// Not installed.
//
// A step minimises, with x0 the position of a particle without forces, m its mass and h the substep,
//
//     sum of m |x - x0|^2 / (2 h^2)  +  sum over links of k (length - rest)^2 / 2
//
// This is the backward Euler method (D. Baraff, A. Witkin, "Large Steps in Cloth Simulation", 1998). One step
// of Newton's method from x0 comes close enough. With f = k (length - rest), n the direction of a link and g
// = max(f, 0) / length, the block of a link is (k - g) n n^T + g I. The sideways stiffness of tension keeps a
// taut cloth smooth; compression's negative stiffness is left out, so the system stays positive definite.
//
// Stiffness and force are in units of m / h^2, with m the mean mass of the cloth: numbers stay in range at
// any scale.
#pragma once

#include <array>
#include <vector>

#include "rope/grid_system.hpp"

namespace tendril::rope::detail {

/// Stretch links are the first of grid_steps.
inline constexpr std::size_t stretch_steps = 2;

/// Arrays in the layout of the finest level.
struct ClothArrays {
    std::array<float*, fine_steps> rest{}, stiffness{};  ///< per link, by the cell it begins in; 0: no link
    std::array<float*, fine_steps> pull{};               ///< force over length
    GridVector position{};                               ///< relative to any particle of the cloth, metres
    GridVector rounding{};                               ///< what `position` lacks to double precision
    GridVector lag{};                                    ///< x0 - x
    float* mass = nullptr;
};

/// Results over dot_cells cells.
struct ClothPart {
    float strain = 0.0f;     ///< maximum of their stretch links
    double potential = 0.0;  ///< twice the potential of inertia and links
};

/// The data of one cloth's solve.
struct Cloth {
    GridSystem system;
    ClothArrays arrays;
    std::vector<ClothPart> parts;
    std::vector<double> sums;  ///< partial sums over links
    /// Results of the last solve: the approximate length, metres; the energy in links and its gain, joules.
    struct {
        double length = 0.0, elastic = 0.0, gained = 0.0;
    } energy;

    void resize(std::size_t columns, std::size_t rows);
};

/// Compiled for each vector unit.
struct ClothUnit {
    /// Computes the blocks and the pull of links, without contacts, and the parts. Their strain counts only
    /// links of this stiffness.
    void (*links)(const GridLevel&, const ClothArrays&, float stiffness, ClothPart*,
                  GridRange cells) = nullptr;
    /// Computes the diagonal and the right side.
    void (*cells)(const GridLevel&, const ClothArrays&, GridRange cells) = nullptr;
};
/// Selected by name like vector_unit().
ClothUnit cloth_unit(std::string_view name) noexcept;

}  // namespace tendril::rope::detail
