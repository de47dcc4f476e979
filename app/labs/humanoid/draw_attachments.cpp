#include "app/labs/humanoid/draw_attachments.hpp"

#include "app/labs/kit/world_drawing.hpp"

namespace tendril::app {

void draw_attachments(const View& view, DrawList& list, const Attachments& attachments) {
    constexpr int sides = 16;
    const NamedWorld& world = *attachments.world;
    std::vector<glm::vec3> positions;
    for (std::size_t i = 0; i < world.size(); ++i) positions.push_back(world.position(i));
    const std::vector<glm::vec3> colours = particle_colours(world, view.palette, false);
    for (const rope::Body& body : world.state().bodies) {
        if (body.kind == rope::Body::Kind::Cloth)
            draw_cloth(list, view.camera, world, body, positions, {}, view.palette);
        else
            draw_strands(list, view.camera, body, positions, colours, sides);
    }
}

}  // namespace tendril::app
