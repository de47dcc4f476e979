// The Rope lab: ropes, cloth and hair among colliders, to drag, pin and cut.
//
// Commands change a copy of the world (rope_edit.hpp), and so does step(). The world of a part is never
// changed in place, so undo, rewind and copies of the document share it.
#pragma once

#include "app/labs/lab.hpp"
#include "app/labs/rope/rope_part.hpp"

namespace tendril::app {

/// Pick ids: particles by their index in the world; colliders, ties and whole bodies by their index in its
/// lists. Valid per frame. In a race, ids in a rival's pane refer to the rival's world.
inline PickId particle_pick(std::size_t particle) {
    return static_cast<PickId>(particle);
}
inline PickId collider_pick(std::size_t index) {
    return static_cast<PickId>(max_lab_particles + index);
}
inline PickId tie_pick(std::size_t index) {
    return static_cast<PickId>(max_lab_particles + max_lab_colliders + index);
}
inline PickId body_pick(std::size_t index) {
    return static_cast<PickId>(max_lab_particles + max_lab_colliders + max_lab_ties + index);
}
inline constexpr PickId picks_in_pane = 2 * max_lab_particles + max_lab_colliders + max_lab_ties;
inline PickId pick_in(std::size_t pane, PickId pick) {
    return static_cast<PickId>(pane) * picks_in_pane + pick;
}
struct ParticlePlace {
    const rope::Body* body = nullptr;
    std::size_t index = 0;  ///< in the body
};
/// None if something else was picked, or the world has changed since.
std::optional<ParticlePlace> picked_particle(const NamedWorld& world, PickId pick);

/// The point by which a whole body is moved: the middle of its pins, which stay where they are put, or of its
/// particles.
glm::vec3 grip_of(const NamedWorld& world, const rope::Body& body);
/// True if the body moves with a collider.
bool is_attached(const NamedWorld& world, const rope::Body& body);

/// Extends a box by a collider, except for planes, which are infinite.
void include_shape(const rope::Shape& shape, glm::vec3& low, glm::vec3& high);

const Past& rope_past();
/// Restores everything to its place after the last change.
Cure restart_cure();
/// The same, if the ropes had more links and ties then.
std::optional<Cure> restart_of_torn(const RopePart& part);

class RopeLab final : public Lab {
  public:
    std::string name() const override { return rope_lab; }
    std::string title() const override { return "Rope"; }
    std::shared_ptr<Part> blank() const override;
    CameraPose first_view() const override;
    std::string invitation(const Workspace&) const override { return "Drag a rope or a collider."; }
    void add_commands(CommandTable& table) const override;

    bool moving(const Workspace& workspace) const override;
    void step(Workspace& workspace) const override;
    std::uint64_t tick_work(const Workspace& workspace) const override;
    double seconds(const Workspace& workspace) const override { return rope_part(workspace).time; }
    const Past* past() const override { return &rope_past(); }

    void draw(const View& view, DrawList& list) const override;
    std::vector<LegendRow> legend(const Workspace& workspace) const override;
    std::vector<PaneTitle> panes(const Workspace& workspace) const override;

    std::vector<Handle> handles(const Workspace& workspace) const override;
    std::optional<Handle> handle(const Workspace& workspace, PickId pick) const override;
    std::optional<Handle> gizmo(const Workspace& workspace) const override;
    void drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const override;
    Together together(const Workspace& workspace, Drag what) const override;
    void drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                       Emit& emit) const override;
    void drop(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void deselect(const Workspace& workspace, Emit& emit) const override;
    void double_click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void click_more(const Workspace& workspace, PickId pick, Emit& emit) const override;
    bool selects_by_box() const override { return true; }
    bool takes_strokes(const Workspace& workspace) const override {
        return rope_part(workspace).tool == RopeTool::Cut;
    }
    void stroke(const Workspace& workspace, std::size_t pane, const Camera& camera, glm::vec2 from,
                glm::vec2 to, Emit& emit) const override;
    std::vector<Handle> selectable(const Workspace& workspace, std::size_t pane) const override;
    void select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                Emit& emit) const override;
    std::string hint(const Workspace& workspace, PickId pick) const override;

    Bounds bounds(const Workspace& workspace, bool selection_only) const override;
    void panel(const Workspace& workspace, Emit& emit) const override;
    void inspector(const Workspace& workspace, Emit& emit) const override;
    std::vector<Shortcut> shortcuts() const override;
    std::vector<MouseHelp> mouse_help() const override;
    std::vector<CommandCall> opening() const override;
    std::vector<CommandCall> calm() const override;
    std::string code(const Workspace& workspace) const override;
    Json state(const Workspace& workspace) const override;
};

}  // namespace tendril::app
