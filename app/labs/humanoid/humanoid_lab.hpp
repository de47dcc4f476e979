// The Humanoid lab: a character from a file, with its bones, clips and IK targets.
#pragma once

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

const Past& humanoid_past();

class HumanoidLab final : public Lab {
  public:
    std::string name() const override { return humanoid_lab; }
    std::string title() const override { return "Humanoid"; }
    std::shared_ptr<Part> blank() const override { return std::make_shared<HumanoidPart>(); }
    CameraPose first_view() const override;
    std::string invitation(const Workspace&) const override { return "Drag an orange ball."; }
    void add_commands(CommandTable& table) const override;

    bool moving(const Workspace& workspace) const override;
    void step(Workspace& workspace) const override;
    const Past* past() const override { return &humanoid_past(); }
    bool working(const Workspace& workspace) const override;
    void work(Workspace& workspace) const override;
    void timeline(const Workspace& workspace, Emit& emit) const override;

    void draw(const View& view, DrawList& list) const override;
    std::vector<LegendRow> legend(const Workspace& workspace) const override;
    std::vector<LabSetting> settings() const override;

    std::vector<Handle> handles(const Workspace& workspace) const override;
    std::optional<Handle> handle(const Workspace& workspace, PickId pick) const override;
    std::optional<Handle> gizmo(const Workspace& workspace) const override;
    void drag(const Workspace& workspace, PickId pick, const Handle::Frame& to, Emit& emit) const override;
    Together together(const Workspace& workspace, Drag what) const override;
    void drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                       Emit& emit) const override;
    void double_click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    std::vector<MouseHelp> mouse_help() const override;
    void click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void deselect(const Workspace& workspace, Emit& emit) const override;
    void click_more(const Workspace& workspace, PickId pick, Emit& emit) const override;
    bool selects_by_box() const override { return true; }
    std::vector<Handle> selectable(const Workspace& workspace, std::size_t pane) const override;
    void select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                Emit& emit) const override;
    std::string hint(const Workspace& workspace, PickId pick) const override;
    Bounds bounds(const Workspace& workspace, bool selection_only) const override;
    std::vector<FileKind> files() const override;
    std::vector<FileWay> file_ways(const Workspace& workspace,
                                   const std::filesystem::path& file) const override;

    void panel(const Workspace& workspace, Emit& emit) const override;
    void inspector(const Workspace& workspace, Emit& emit) const override;

    Json state(const Workspace& workspace) const override;
    std::string code(const Workspace& workspace) const override;
    std::vector<CommandCall> opening() const override;
};

/// Bones tapered, or as lines and spheres; nodes that are not bones shown or hidden.
LabSetting bones_setting();
LabSetting helpers_setting();

}  // namespace tendril::app
