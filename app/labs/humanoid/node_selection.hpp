// Which nodes of a skeleton are selected. Files and commands have them by name: another skeleton may have the
// same.
#pragma once

#include <string>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/labs/kit/selection.hpp"

namespace tendril::app {

/// Of all that are selected, in the skeleton's order.
std::vector<std::string> names_of(const Selection& selection, const humanoid::Skeleton& skeleton);
/// Of the active one; empty: nothing is selected.
std::string active_name(const Selection& selection, const humanoid::Skeleton& skeleton);

/// The nodes of the same names; what has none is not selected.
Selection selection_in(const humanoid::Skeleton& skeleton, const Selection& selection,
                       const humanoid::Skeleton& before);

/// A name, empty where nothing is selected, or {"active", "all"}.
Json save_selection(const Selection& selection, const humanoid::Skeleton& skeleton);
/// Without nodes that the skeleton does not have. Throws std::runtime_error that begins with the place.
Selection load_selection(const JsonPlace& place, const humanoid::Skeleton& skeleton);

}  // namespace tendril::app
