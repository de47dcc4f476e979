#include "app/labs/humanoid/attachments/draw_attachments.hpp"

#include <algorithm>

#include "app/labs/kit/world_drawing.hpp"

namespace tendril::app {

glm::vec3 attached_colour(const Palette& palette) {
    return cloth_front(palette);
}

void draw_attachments(const View& view, DrawList& list, const Attachments& attachments) {
    constexpr int sides = 16;
    const NamedWorld& world = *attachments.world;
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < world.size(); ++i) positions.push_back(world.position(i));
    std::vector<glm::vec3> colours = particle_colours(world, view.palette, false);
    for (const rope::Body& body : world.state().bodies)
        if (body.kind == rope::Body::Kind::Rope)  // a tail is no third leg
            std::fill_n(colours.begin() + static_cast<std::ptrdiff_t>(body.first), body.count,
                        attached_colour(view.palette));
    for (const rope::Body& body : world.state().bodies) {
        if (body.kind == rope::Body::Kind::Cloth)
            draw_cloth(list, view.camera, world, body, positions, {}, view.palette);
        else
            draw_strands(list, view.camera, body, positions, colours, sides);
    }
}

}  // namespace tendril::app
