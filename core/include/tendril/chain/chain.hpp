// A chain: a row of points, each at a fixed distance from the previous one. Move one point and the others
// follow. For tentacles, tails, short ropes, cranes and arms.
//
// Index 0 is the head, the last index the tail. Every call maintains this invariant:
//
//     | |position(i) - position(i-1)| - length(i) |  <=  1e-4 * max(1, length(i))     for every i >= 1
//
// while the chain lies within 1e3 m of the origin. Every coordinate is finite, at any distance.
//
// Method: a pull puts one point on the target, then walks away from it. Each point moves along the line
// through its already placed neighbour and its own old position until the distance is right again. That is
// one half of a FABRIK iteration: A. Aristidou, J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse
// Kinematics problem", Graphical Models 73(5), 2011, pp. 243-260.
//
// Cost: a pull is one pass, O(n), with one square root and one division per segment. It does not allocate.
// `add(length)` is O(1) amortised; every other edit recalculates the chain, O(n).
//
// Degenerate cases. If two points of a step coincide (squared distance under FLT_EPSILON, so closer than 0.35
// mm), the step goes along default_direction(). A new segment whose position coincides with *any* point of
// the chain has no direction of its own; it is placed as if only its length had been given. So n segments
// added at the same point make a straight chain, not a zigzag.
//
// Errors: InvalidArgument for a number that is NaN, infinite or out of range, OutOfRange for a bad index; the
// message names the operation, the argument and its value. Arguments are checked before anything changes: a
// call that fails leaves the chain bit for bit as it was, even if it runs out of memory.
//
// Units are metres. Input coordinates may be at most max_magnitude (1e9) in magnitude, lengths 0 to 1e9. The
// same calls give the same bits under every compiler and optimisation that keeps IEEE arithmetic.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tendril/chain/segment.hpp"
#include "tendril/fields.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril {

/// The four modes of a chain, for programs that let the user choose.
enum class Mode {
    Forward,   ///< the head moves to the target, the rest trails
    Backward,  ///< the tail moves to the target, the rest trails
    Fixed,     ///< the head reaches for the target, the tail stays
    WithIndex  ///< a chosen segment moves to the target, both sides trail
};

/// Stopping criteria of Chain::fixed.
struct FixedOptions {
    int iterations = 1;       ///< maximum, 1 to 100 000
    float tolerance = 1e-5f;  ///< metres, 0 to 1e9: stops once the head is this close to the target
};

struct FixedResult {
    int iterations = 0;     ///< iterations used; 0 for a chain of fewer than two segments
    float residual = 0.0f;  ///< metres from the head to the target; 0 for an empty chain
    Result accepted{};      ///< success, or why nothing moved
};

class Chain {
  public:
    /// An empty chain whose default direction is +X.
    Chain() = default;

    /// Loads many segments at once, in O(n), for example a saved chain. Positions are kept bit for bit up to
    /// the first segment that is not at its length from the previous one; from there on they are
    /// recalculated. (The allowed error is the invariant's plus, beyond 1e3 m, the spacing of floats there,
    /// so every chain that this class made is restored exactly.) In the recalculated part, a segment given at
    /// its predecessor's position has no direction of its own and continues straight on, as in add(length).
    /// InvalidArgument for a bad length, coordinate or direction.
    static Expected<Chain> from_segments(std::vector<Segment> segments,
                                         glm::vec3 default_direction = {1.0f, 0.0f, 0.0f});

    // ---- Reading

    std::size_t size() const noexcept { return segments_.size(); }
    bool empty() const noexcept { return segments_.empty(); }
    /// All segments, head first; valid until the next edit.
    std::span<const Segment> segments() const noexcept { return segments_; }
    /// Metres from segment `index - 1`. The head's is stored but has no effect. A bad index behaves as in
    /// std::vector::at: std::out_of_range, or the program ends if it was built without exceptions.
    float length(std::size_t index) const { return segments_.at(index).length; }
    /// Metres. A bad index behaves as in length().
    glm::vec3 position(std::size_t index) const { return segments_.at(index).position; }
    /// Maximum distance from head to tail, in metres: the sum of all lengths but the first. O(n).
    float reach() const noexcept;
    glm::vec3 default_direction() const noexcept { return default_direction_; }
    bool operator==(const Chain&) const = default;

    // ---- Editing

    /// Sets the direction of segments that have none of their own; moves nothing. InvalidArgument unless it
    /// is finite and its length within 1e-3 of 1; it is then normalised.
    Result set_default_direction(glm::vec3 direction);

    /// Appends a segment straight on: in the direction of the last bone, or default_direction() if that bone
    /// has none. The first segment is placed at the origin. InvalidArgument.
    Result add(float length);
    /// Appends a segment from the tail towards `segment.position`, at distance `segment.length`. The first
    /// segment is placed exactly there. InvalidArgument.
    Result add(const Segment& segment);

    /// Inserts a segment before `index`, 0 <= index < size(), and recalculates. The new point is placed from
    /// its predecessor towards `segment.position`. A new head is placed exactly there, and the old head's
    /// length becomes its distance from the new one. OutOfRange (always when empty: use add),
    /// InvalidArgument.
    Result insert(std::size_t index, const Segment& segment);
    /// Inserts a segment before `index` and keeps the shape. The new point lies on the line from `index - 1`
    /// to `index`, and all later points move along that line by `length`. A new head (index 0) lies beyond
    /// the old one, in line with the first bone, at the old head's length from it; nothing else moves.
    /// OutOfRange, InvalidArgument.
    Result insert(std::size_t index, float length);

    /// Removes a segment and recalculates from the (new) head. OutOfRange.
    Result remove(std::size_t index);
    /// Changes a length and recalculates. OutOfRange, InvalidArgument.
    Result set_length(std::size_t index, float length);
    /// A forward pull to the head's current position. Every operation maintains the invariant, so this moves
    /// nothing by more than rounding, except that bones shorter than 0.35 mm turn to default_direction(), as
    /// in any pull.
    void recalculate() noexcept;
    /// Sets a pose calculated elsewhere, one position per segment. As in from_segments, positions are kept
    /// bit for bit up to the first that is not at its length. InvalidArgument for a bad coordinate or if
    /// there are not size() positions. Does not allocate.
    Result set_positions(std::span<const glm::vec3> positions);

    // ---- The four modes. Each does nothing to an empty chain. Targets are in metres; a bad one is
    // ---- InvalidArgument. The pinned point is bitwise equal to its target.

    /// Moves the head to the target; the rest follows.
    Result forward(glm::vec3 target);
    /// Moves the tail to the target; the rest follows.
    Result backward(glm::vec3 target);
    /// The head reaches for the target while the tail stays exactly where it is: a forward pull to the
    /// target, then a backward pull to the tail's old position, repeated until the options stop it. A single
    /// segment does not move.
    [[nodiscard]] FixedResult fixed(glm::vec3 target, const FixedOptions& options = {});
    /// Moves segment `index` to the target; both sides follow. Also OutOfRange, unless empty.
    Result with_index(std::size_t index, glm::vec3 target);

  private:
    bool has_point_at(glm::vec3 position) const noexcept;
    glm::vec3 bone_direction(std::size_t from, std::size_t to) const noexcept;

    std::vector<Segment> segments_;
    glm::vec3 default_direction_{1.0f, 0.0f, 0.0f};
};

}  // namespace tendril

template <>
std::span<const tendril::Field> tendril::fields<tendril::Segment>() noexcept;
template <>
std::span<const tendril::Field> tendril::fields<tendril::FixedOptions>() noexcept;
