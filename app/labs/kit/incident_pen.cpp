#include "app/labs/kit/incident_pen.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/document/units.hpp"

namespace tendril::app {

void draw_turn(const View& view, glm::vec3 from, glm::vec3 to, glm::vec3 about, DrawList& list) {
    constexpr int sides = 24;
    const glm::vec4 colour(view.palette.limit, 1.0f);
    const float radius_from = glm::distance(from, about), radius_to = glm::distance(to, about);
    glm::vec3 last = from;
    for (int i = 1; i <= sides; ++i) {
        const float t = static_cast<float>(i) / sides;
        const glm::vec3 chord = glm::mix(from, to, t) - about;
        const float length = glm::length(chord), radius = glm::mix(radius_from, radius_to, t);
        // A half turn has no shorter way: it goes straight.
        const glm::vec3 next = length > 0.05f * radius ? about + chord * (radius / length) : about + chord;
        list.line(last, next, 2.0f * view.scale, colour).layer = Layer::Overlay;
        last = next;
    }
}

void draw_incident_mark(const View& view, const Incident& incident, glm::vec3 at, DrawList& list) {
    list.ring(at, 14.0f * view.scale, 2.5f * view.scale, glm::vec4(view.palette.limit, 1.0f)).layer =
        Layer::Overlay;
    if (incident.kind != Incident::Kind::Flip) return;
    list.labels.push_back({.at = at,
                           .clearance = 18.0f * view.scale,
                           .text = fixed_text(static_cast<double>(incident.degrees), 0) + " degrees",
                           .colour = view.palette.text,
                           .rank = 4});
}

}  // namespace tendril::app
