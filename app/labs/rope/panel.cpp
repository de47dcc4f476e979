// The Rope lab's panels, as plain as can be.
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/rope/rope_names.hpp"
#include "app/labs/rope/scenes.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

void RopeLab::panel(const Workspace& workspace, Emit& emit) const {
    const RopePart& part = rope_part(workspace);
    section("Scene");
    for (const RopeSceneEntry& scene : rope_scenes())
        if (row_button(scene.title, 2)) emit("rope.preset", {{"name", scene.name}});
    end_row();
    section("A click");
    static constexpr const char* titles[] = {"Selects", "Pins and lets go", "Cuts"};
    for (const RopeTool tool : all_tools) {
        if (option_button(titles[static_cast<std::size_t>(tool)], part.tool == tool))
            emit("rope.tool", {{"name", tool_name(tool)}});
    }
}

void RopeLab::inspector(const Workspace& workspace, Emit&) const {
    const RopePart& part = rope_part(workspace);
    section("World");
    reading("particles", "%zu", part.world->size());
    reading("substeps dropped", "%llu", static_cast<unsigned long long>(part.world->state().dropped));
}

}  // namespace tendril::app
