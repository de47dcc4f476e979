// A chain: points in a row, each at a fixed distance from the one before, and four ways to pull it by one of
// them. For tentacles, tails, short ropes, cranes and arms: one point is moved and the others follow.
//
// Index 0 is the head, the last index the tail. The invariant that every call maintains:
//
//     | |position(i) - position(i-1)| - length(i) |  <=  1e-4 * max(1, length(i))     for every i >= 1
//
// while the chain lies within 1e3 m of the origin, and every coordinate is finite wherever it lies.
//
// Method: one pull puts a point on the target, then walks away from it, moving each point along the line from
// its already placed neighbour through its own old place until the distance is right again. That is the half
// step of FABRIK: A. Aristidou, J. Lasenby, "FABRIK: A fast, iterative solver for the Inverse Kinematics
// problem", Graphical Models 73(5), 2011, pp. 243-260.
//
// Cost: a pull is one pass, O(n), one square root and one division per segment, and allocates nothing.
// `add(length)` is O(1) amortised; every other edit recalculates the chain, O(n).
//
// Degenerate cases. Where two points of a step coincide (squared distance under FLT_EPSILON, so nearer than
// 0.35 mm) the step goes along default_direction(). A segment that is given at a point where the chain
// already has one, *any* one, has no direction of its own; it is placed as by the overload that takes only a
// length. So n segments added at the same point make a straight chain, not a zigzag.
//
// Errors: InvalidArgument for a number that is NaN, infinite or out of its range, OutOfRange for a bad index;
// the message names the operation, the argument and its value. Arguments are checked before anything moves: a
// chain that refuses is bit for bit what it was, and so it is where there is no memory left for a segment.
//
// Units are metres. Coordinates that come in may be at most max_magnitude (1e9) in magnitude, lengths 0 to
// 1e9. The same calls give the same bits under every compiler and optimisation that keeps IEEE arithmetic.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tendril/chain/segment.hpp"
#include "tendril/result.hpp"
#include "tendril/vec3.hpp"

namespace tendril {

/// The four modes of a chain, for programs that let a person select one.
enum class Mode {
    Forward,   ///< the head goes to the target, the rest trails
    Backward,  ///< the tail goes to the target, the rest trails
    Fixed,     ///< the head reaches for the target, the tail stays
    WithIndex  ///< a chosen segment goes to the target, both sides trail
};

/// How long Chain::fixed goes on.
struct FixedOptions {
    int iterations = 1;       ///< how often it reaches at most, 1 to 100 000
    float tolerance = 1e-5f;  ///< metres, 0 to 1e9: it stops once the head is this near to the target
};

/// What Chain::fixed did.
struct FixedResult {
    int iterations = 0;     ///< how often it reached; 0 for a chain of fewer than two segments
    float residual = 0.0f;  ///< metres from the head to the target; 0 for an empty chain
    Result outcome{};       ///< fine, or why nothing has moved
};

class Chain {
  public:
    /// An empty chain whose default direction is +X.
    Chain() = default;

    /// A chain of many segments at once, in O(n): what loads a saved one. Every position that lies at its
    /// length from the one before is kept bit for bit, up to the first that does not; from there on the
    /// positions are recalculated. (The distance may be off by what the invariant allows and, further out
    /// than 1e3 m, by the spacing of floats there, so every chain that this class made is restored exactly.)
    /// In the recalculated part a segment at the same point as the one given before it has no direction of
    /// its own and goes straight on, as in add(length). InvalidArgument for a bad length, coordinate or
    /// direction.
    static Expected<Chain> from_segments(std::vector<Segment> segments,
                                         glm::vec3 default_direction = {1.0f, 0.0f, 0.0f});

    // ---- Reading

    std::size_t size() const noexcept { return segments_.size(); }
    bool empty() const noexcept { return segments_.empty(); }
    /// All segments, head first; valid until the next edit.
    std::span<const Segment> segments() const noexcept { return segments_; }
    /// Metres from segment `index - 1`; that of index 0 is stored but has no effect. A bad index does what it
    /// does in std::vector::at: std::out_of_range, or the end of a program built without exceptions.
    float length(std::size_t index) const { return segments_.at(index).length; }
    /// Metres; a bad index as above.
    glm::vec3 position(std::size_t index) const { return segments_.at(index).position; }
    /// How far the tail can get from the head, in metres: the sum of all lengths but the first. O(n).
    float reach() const noexcept;
    glm::vec3 default_direction() const noexcept { return default_direction_; }
    /// Same segments, same default direction.
    bool operator==(const Chain&) const = default;

    // ---- Editing

    /// The direction of segments that have none of their own; moves nothing. InvalidArgument unless it is
    /// finite and its length within 1e-3 of 1; it is then normalised.
    Result set_default_direction(glm::vec3 direction);

    /// Appends a segment straight on: along the direction of the last one, or along default_direction where
    /// that has none; the first one at the origin. InvalidArgument.
    Result add(float length);
    /// Appends a segment that lies from the tail towards `segment.position`, at `segment.length` (the first
    /// one right there). InvalidArgument.
    Result add(const Segment& segment);

    /// Puts a segment before `index`, 0 <= index < size(), and recalculates. The new point lies from its
    /// predecessor towards `segment.position`; a new head lies right there, and the old head's length becomes
    /// its distance from the new one. OutOfRange (always when empty: an empty chain takes `add` only),
    /// InvalidArgument.
    Result insert(std::size_t index, const Segment& segment);
    /// Puts a segment before `index` and keeps the shape. The new point lies on the line from `index - 1` to
    /// `index`, and all later points move along that line by `length`. A new head (index 0) lies beyond
    /// the old one, in line with the first bone, at the distance given by the old head's length; nothing else
    /// moves. OutOfRange, InvalidArgument.
    Result insert(std::size_t index, float length);

    /// Removes a segment and recalculates from the (new) head. OutOfRange.
    Result remove(std::size_t index);
    /// Changes a length and recalculates. OutOfRange, InvalidArgument.
    Result set_length(std::size_t index, float length);
    /// A forward pull with the head on its own place. Every operation maintains the invariant, so this moves
    /// nothing by more than rounding, except that bones shorter than 0.35 mm turn to default_direction, as in
    /// any pull.
    void recalculate() noexcept;
    /// Sets a pose that was calculated elsewhere, one position a segment, as from_segments does: kept bit for
    /// bit up to the first that is not at its length. InvalidArgument for a bad coordinate or another
    /// number than size(); allocates nothing.
    Result set_positions(std::span<const glm::vec3> positions);

    // ---- The four modes. Each does nothing to an empty chain; targets are in metres.
    // ---- A bad target is InvalidArgument. The pinned point is bitwise what it was pinned to.

    /// The head goes to the target, the rest follows it.
    Result forward(glm::vec3 target);
    /// The tail goes to the target, the rest follows it.
    Result backward(glm::vec3 target);
    /// The head reaches for the target while the tail stays exactly where it is: forward to the target,
    /// backward to where the tail was, and so on until one of the options ends it. A single segment stays
    /// where it is.
    [[nodiscard]] FixedResult fixed(glm::vec3 target, const FixedOptions& options = {});
    /// Segment `index` goes to the target, both sides follow. OutOfRange too (not when empty).
    Result with_index(std::size_t index, glm::vec3 target);

  private:
    bool has_point_at(glm::vec3 position) const noexcept;
    glm::vec3 bone_direction(std::size_t from, std::size_t to) const noexcept;

    std::vector<Segment> segments_;
    glm::vec3 default_direction_{1.0f, 0.0f, 0.0f};
};

}  // namespace tendril
