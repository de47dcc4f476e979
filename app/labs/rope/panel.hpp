// The sections that make up the panels of the Rope lab.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/palette.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

/// A box along the axes, metres.
struct Space {
    glm::vec3 low{1e30f}, high{-1e30f};

    bool meets(const Space& other) const {
        return glm::all(glm::lessThan(low, other.high)) && glm::all(glm::lessThan(other.low, high));
    }
    Space moved(glm::vec3 by) const { return {low + by, high + by}; }
};

/// The centre of the view or, if `needed` is not free there, the nearest free place to the right, left or
/// behind. Never in front of existing objects.
glm::vec3 free_place(const Workspace& workspace, const Space& needed);
/// Buttons that add ropes, cloths, hair and colliders.
void adding_rows(const Workspace& workspace, Emit& emit);
/// The verdict on how well lengths are kept.
Verdict rope_verdict(const RopePart& part);
/// The same verdict, or the simulation speed if the machine is too slow for the ropes.
Verdict paced_verdict(Verdict said, const Workspace& workspace);
/// Buttons for the bodies that a rope collides with.
void collision_rows(const NamedWorld& world, const rope::Body& body, Emit& emit);
/// Rows of a selected tie.
void tie_rows(const RopePart& part, const rope::Tie& tie, Emit& emit);
/// The selection, and actions on it.
void selection_rows(const Workspace& workspace, Emit& emit);
/// Simulation statistics, and curves of the last ten seconds.
void number_rows(const Workspace& workspace, const Palette& palette, Emit& emit);

}  // namespace tendril::app
