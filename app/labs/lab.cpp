#include "app/labs/lab.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/past.hpp"

namespace tendril::app {

Bounds bounds_of(glm::vec3 low, glm::vec3 high, float smallest) {
    return {0.5f * (low + high), std::max(0.5f * glm::distance(low, high), smallest)};
}

void frame_unless_seen(Workspace& workspace, const Bounds& bounds) {
    constexpr float smallest = 0.25f;  // fraction of the view
    const Rect view{{0.0f, 0.0f}, workspace.ui.view_size};
    const Camera camera(workspace.camera, view);
    const auto at = camera.project(bounds.centre);
    const float pixels = 2.0f * bounds.radius / camera.metres_per_pixel(bounds.centre);
    if (at && view.contains(*at) && pixels >= smallest * std::min(view.size().x, view.size().y)) return;
    workspace.camera = framed(workspace.camera, view, bounds.centre, bounds.radius);
}

std::optional<Handle> Lab::handle(const Workspace& workspace, PickId pick) const {
    const std::vector<Handle> all = handles(workspace);
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Handle& handle) { return handle.pick == pick; });
    return found == all.end() ? std::nullopt : std::optional(*found);
}

Bounds Lab::bounds(const Workspace& workspace, bool) const {
    const std::vector<Handle> all = handles(workspace);
    if (all.empty()) return {};
    glm::vec3 low = all.front().frame.position, high = low;
    for (const Handle& handle : all) {
        low = glm::min(low, handle.frame.position);
        high = glm::max(high, handle.frame.position);
    }
    return bounds_of(low, high);
}

std::vector<Incident> Lab::review(const Workspace& workspace, const Part& before, const Part& after) const {
    const Past* const table = past();
    return table && table->incidents ? table->incidents(workspace, before, after) : std::vector<Incident>();
}

bool Lab::same_joints(const Part& before, const Part& after) const {
    const Past* const table = past();
    return !table || !table->incidents || table->same_joints(before, after);
}

float Lab::timeline_height(const Workspace& workspace) const {
    return past() ? strip_height + past_plot_height(workspace.settings, *past()) : 0.0f;
}

void Lab::timeline(const Workspace& workspace, Emit& emit) const {
    if (past()) past_plot(workspace, *past(), past_strip(workspace, emit), emit);
}

std::vector<LabSetting> Lab::all_settings() const {
    std::vector<LabSetting> all = settings();
    if (const Past* const table = past()) all.insert(all.end(), {table->plot(), table->ghosts()});
    return all;
}

Json Lab::state(const Workspace& workspace) const {
    Json state{{"lab", name()}};
    state.update(workspace.document.parts().at(name())->save());
    return state;
}

}  // namespace tendril::app
