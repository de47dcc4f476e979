// Where attachments sit on a body, and how large they are.
#pragma once

#include "app/labs/humanoid/attachments/attachments.hpp"

namespace tendril::app {

inline constexpr double flare = 0.7;  ///< by this part of its width a cloth is wider below

std::size_t particles_of(AttachmentKind kind, const AttachmentShape& shape);

/// Whether a ball at a point is in the body at rest, or touches it.
bool is_in_body(const Wearer& wearer, const glm::dvec3& point, double radius);

/// Points of a cloth's first row as the character rests: from side to side, so that its front is seen from
/// behind the character; each brought backwards until it is off the body. `middle`: of the row.
std::vector<glm::dvec3> cloth_row(const Wearer& wearer, const AttachmentShape& shape,
                                  const glm::dvec3& middle);

}  // namespace tendril::app
