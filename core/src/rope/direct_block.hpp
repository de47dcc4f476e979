// Several chains side by side in memory, one per lane, for the direct solver. Not installed.
#pragma once

#include <cstddef>
#include <string_view>

namespace tendril::rope::detail {

/// Rows of a node. A node is a particle of a chain; its link leads to the next node.
enum Row : std::size_t {
    X,
    Y,
    Z,  ///< current position
    BaseX,
    BaseY,
    BaseZ,  ///< position without any tension
    OldX,
    OldY,
    OldZ,        ///< position one substep before the last; later its link's direction then, unit
    Weight,      ///< inverse mass; 0: pinned
    Rest,        ///< rest length of its link
    Compliance,  ///< of its link, m/N, over h^2
    Multiplier,  ///< tension times h^2
    DirectionX,
    DirectionY,
    DirectionZ,  ///< direction in which its tension acts
    Upper,
    Right,  ///< rows of the tridiagonal system
    rows
};

inline constexpr std::size_t max_lanes = 8;

/// Chains of `links` links each, in `lanes` lanes. Lanes without a chain repeat the last one.
struct Block {
    double* data = nullptr;  ///< aligned to 64 bytes
    std::size_t links = 0;
    std::size_t lanes = 1;

    double* at(std::size_t node, std::size_t row) const { return data + (node * rows + row) * lanes; }
    static std::size_t doubles(std::size_t links, std::size_t lanes) { return (links + 1) * rows * lanes; }
};

/// A block's solve. Outputs have one value per lane.
struct SolveJob {
    bool implicit = false;  ///< first apply the existing tension implicitly
    /// 0: tension acts along the mean of the link's directions before and after; 1: along the one after.
    double backward[max_lanes] = {};
    double passes[max_lanes] = {};  ///< maximum
    double damping = 1e-9;          ///< relative to the system's diagonal
    double tolerance = 1e-7;        ///< relative length error at which a lane is done
    double worst[max_lanes];        ///< out: the largest relative length error
    int passes_taken = 0;           ///< out: passes taken
};

using SolveBlock = void(const Block& block, SolveJob& job);

struct VectorUnit {
    SolveBlock* solve = nullptr;   ///< `lanes` at a time
    SolveBlock* single = nullptr;  ///< one lane
    std::size_t lanes = 1;
};
/// The unit of that name as in ik::vector_units(), or the widest if the name is empty; null functions for an
/// unknown name.
VectorUnit vector_unit(std::string_view name) noexcept;

}  // namespace tendril::rope::detail
