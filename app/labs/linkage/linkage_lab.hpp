// The Linkage lab: bars, joints, pins and motors, to draw, drag and run.
#pragma once

#include "app/labs/kit/panel_rows.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/linkage/linkage_part.hpp"

namespace tendril::app {

/// The linkage's state for --state and `tendril solve`: hinges in degrees, everything else in metres.
Json linkage_state(const LinkagePart& part);
/// The state of the linkage, or the next step: the inspector's first text. `playing`: the simulation runs.
Verdict linkage_verdict(const LinkagePart& part, LinkageRuntime& runtime, bool playing = true);
/// The label of the motor button: "Run", "Stop", "Continue" if the simulation is paused, "Stopped at 43.0
/// degrees: turn back".
std::string motor_button(const LinkagePart& part, bool playing = true);
/// Rows for the ends of a joint's range, or a button that adds a range around its present value.
void linkage_range_rows(const LinkagePart& part, const std::string& joint, Emit& emit);

const Past& linkage_past();

class LinkageLab final : public Lab {
  public:
    std::string name() const override { return linkage_lab; }
    std::string title() const override { return "Linkage"; }
    std::shared_ptr<Part> blank() const override;
    CameraPose first_view() const override;
    std::string invitation(const Workspace& workspace) const override;
    void add_commands(CommandTable& table) const override;

    bool moving(const Workspace& workspace) const override;
    void step(Workspace& workspace) const override;
    double seconds(const Workspace& workspace) const override { return linkage_part(workspace).time; }
    int loop_ticks(const Workspace& workspace) const override;
    const Past* past() const override { return &linkage_past(); }

    void draw(const View& view, DrawList& list) const override;
    std::vector<LegendRow> legend(const Workspace& workspace) const override;

    std::vector<Handle> handles(const Workspace& workspace) const override;
    void drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const override;
    void drop(const Workspace& workspace, PickId pick, Emit& emit) const override;
    void click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    bool takes_strokes(const Workspace& workspace) const override {
        return linkage_part(workspace).tool == LinkageTool::Draw;
    }
    void stroke(const Workspace& workspace, std::size_t pane, const Camera& camera, glm::vec2 from,
                glm::vec2 to, Emit& emit) const override;
    std::string hint(const Workspace& workspace, PickId pick) const override;

    Bounds bounds(const Workspace& workspace, bool selection_only) const override;
    void panel(const Workspace& workspace, Emit& emit) const override;
    void inspector(const Workspace& workspace, Emit& emit) const override;
    void timeline(const Workspace& workspace, Emit& emit) const override;

    std::vector<Shortcut> shortcuts() const override;
    std::vector<MouseHelp> mouse_help() const override;
    std::vector<CommandCall> opening() const override;
    std::vector<CommandCall> calm() const override;
    std::string code(const Workspace& workspace) const override;
    Json state(const Workspace& workspace) const override;
};

}  // namespace tendril::app
