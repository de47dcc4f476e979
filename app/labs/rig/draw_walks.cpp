#include "app/labs/rig/draw_walks.hpp"

#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/walk.hpp"

namespace tendril::app {

void draw_walks(const View& view, DrawList& list) {
    const RigPart& part = rig_part(view.workspace);
    const rig::Hierarchy& elements = view.workspace.runtimes.of<RigRuntime>(rig_lab).resolved(view.workspace);
    for (const RigWalk& walk : part.walks) {
        const rig::ElementId parent = elements.parent(part.rig.id(*part.rig.element(walk.control)));
        const rig::Transform space = parent ? *elements.known(parent, rig::Space::Global) : rig::Transform();
        constexpr int sides = 96;
        const auto at = [&](int side) {
            const double ticks = static_cast<double>(ticks_per_round(walk.motion)) * side / sides;
            const rig::Transform point{.translation = walk_point(walk.motion, ticks)};
            return glm::vec3(rig::compose(space, point).translation);
        };
        for (int side = 0; side < sides; ++side)
            list.line(at(side), at(side + 1), 1.5f * view.scale, glm::vec4(view.palette.target, 0.3f));
    }
}

}  // namespace tendril::app
