// The step that makes FABRIK fast near full reach, and wherever else it crawls. Not installed.
//
// A pass hands a bend on from joint to joint and takes little of it away; so a chain whose tip falls short by
// one in a thousand needs hundreds of passes to straighten that much. Here the shape that the passes found is
// preserved and its bend as a whole made less or more. With u a bone's direction and l that of the line from
// root to tip, every bone is given the direction of
//
//     l + t (u - l)
//
// with one t for all: at 0 the chain is straight, at 1 it is as it was, over 1 it bends more. The span from
// root to tip is nearly linear in t^2, so two tries come near to the t where the span is the target's
// distance (regula falsi: between 0 and 1 there always is one where the chain falls short). Then the chain is
// turned as a whole towards the target.
//
// Where bending cannot bring the ends near enough to each other, the longest bone stays and the others do the
// same with what is left of the way to the target; or, where they are too short for that, they fold back
// along the longest.
//
// Cost: O(n), as a rule one or two square roots a bone, none of which waits for the one before it as those of
// a pass do: about as much as the passes.
#pragma once

#include "ik/solve/problem.hpp"

namespace tendril::ik::detail {

/// After a pair of passes that left the tip `residual` from the target. Moves nothing unless that gets less.
template <class Watch>
void accelerate(Problem& problem, float residual, Watch watch) noexcept;

}  // namespace tendril::ik::detail
