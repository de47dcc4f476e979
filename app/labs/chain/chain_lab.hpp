// The Chain lab: drag the target and see a chain follow, in five modes.
#pragma once

#include "app/labs/chain/chain_part.hpp"
#include "app/labs/lab.hpp"

namespace tendril::app {

inline constexpr PickId target_pick = 0;
inline constexpr PickId pole_pick = static_cast<PickId>(max_segments) + 1;
// Pick ids: limit ends, two per bone, in a plane; in mode Curve, control points and the strokes of the curve.
inline constexpr PickId first_limit_pick = pole_pick + 1;
inline constexpr PickId first_control_pick = first_limit_pick + 2 * static_cast<PickId>(max_segments);
inline constexpr PickId first_curve_pick = first_control_pick + static_cast<PickId>(max_control_points);
inline PickId control_pick(std::size_t index) {
    return first_control_pick + static_cast<PickId>(index);
}
/// One end of a limit in the plane, for the bone that starts at this joint.
struct LimitEnd {
    std::size_t joint = 0;
    bool max = false;
};
inline PickId limit_pick(const LimitEnd& end) {
    return first_limit_pick + 2 * static_cast<PickId>(end.joint) + (end.max ? 1 : 0);
}
inline std::optional<LimitEnd> picked_limit(PickId pick) {
    if (pick < first_limit_pick || pick >= first_control_pick) return std::nullopt;
    const auto index = static_cast<std::size_t>(pick - first_limit_pick);
    return LimitEnd{index / 2, index % 2 == 1};
}
/// The control point with that pick, if any.
inline std::optional<std::size_t> picked_control(PickId pick) {
    if (pick < first_control_pick || pick >= first_curve_pick) return std::nullopt;
    return static_cast<std::size_t>(pick - first_control_pick);
}
/// The middle of the picked stroke of the curve, if any, as parameter `at` of ik::curve_point().
std::optional<float> picked_on_curve(const ChainPart& part, PickId pick);
inline PickId segment_pick(std::size_t index) {
    return static_cast<PickId>(index) + 1;
}
inline std::size_t picked_segment(PickId pick) {
    return static_cast<std::size_t>(pick) - 1;
}

const Past& chain_past();

class ChainLab final : public Lab {
  public:
    std::string name() const override { return chain_lab; }
    std::string title() const override { return "Chain"; }
    std::shared_ptr<Part> blank() const override;
    CameraPose first_view() const override;
    std::string invitation(const Workspace& workspace) const override;
    void add_commands(CommandTable& table) const override;

    bool moving(const Workspace& workspace) const override;
    void step(Workspace& workspace) const override;
    bool working(const Workspace& workspace) const override;
    void work(Workspace& workspace) const override;
    std::uint64_t tick_work(const Workspace& workspace) const override;
    const Past* past() const override { return &chain_past(); }
    void draw(const View& view, DrawList& list) const override;

    std::vector<PaneTitle> panes(const Workspace& workspace) const override;
    std::vector<LegendRow> legend(const Workspace& workspace) const override;
    bool labels_pictures(const Workspace& workspace) const override;
    std::function<void()> picture_plot(const Workspace&, const Palette&) const override;
    std::vector<Handle> handles(const Workspace& workspace) const override;
    std::optional<Handle> handle(const Workspace& workspace, PickId pick) const override;
    void drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const override;
    void click_more(const Workspace& workspace, PickId pick, Emit& emit) const override;
    bool selects_by_box() const override { return true; }
    std::vector<Handle> selectable(const Workspace& workspace, std::size_t pane) const override;
    void select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                Emit& emit) const override;
    std::optional<Handle> gizmo(const Workspace& workspace) const override;
    Together together(const Workspace& workspace, Drag what) const override;
    void drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                       Emit& emit) const override;
    void click(const Workspace& workspace, PickId pick, Emit& emit) const override;
    std::string hint(const Workspace& workspace, PickId pick) const override;

    Bounds bounds(const Workspace& workspace, bool selection_only) const override;
    std::vector<FileKind> files() const override;
    TakenText takes_text(const std::string& text) const override;
    void panel(const Workspace& workspace, Emit& emit) const override;
    void inspector(const Workspace& workspace, Emit& emit) const override;
    bool analyses(const Workspace& workspace) const override;
    float timeline_height(const Workspace& workspace) const override;
    void timeline(const Workspace& workspace, Emit& emit) const override;
    std::vector<MouseHelp> mouse_help() const override;
    std::vector<Shortcut> shortcuts() const override;
    std::vector<LabSetting> settings() const override;
    std::vector<CommandCall> opening() const override;
    std::vector<CommandCall> calm() const override;
    std::string code(const Workspace& workspace) const override;
    Json state(const Workspace& workspace) const override;
};

/// The lab's part of a workspace.
inline const ChainPart& chain_part(const Workspace& workspace) {
    return workspace.document.get<ChainPart>(chain_lab);
}

}  // namespace tendril::app
