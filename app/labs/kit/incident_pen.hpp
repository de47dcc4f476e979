// Marks in the picture of what an incident did: how far something turned, and where.
#pragma once

#include <glm/vec3.hpp>

#include "app/labs/lab.hpp"

namespace tendril::app {

/// The way that the end of a bone went which turned about its start, on the shorter way round.
void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list);

/// A ring around what it happened to and, for a flip, how far it turned.
void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list);

}  // namespace tendril::app
