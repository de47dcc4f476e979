// What the mouse does in the Chain lab: drags, clicks, boxes, and the gizmo of what is selected.
#include "app/document/json_complete.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/shown.hpp"

namespace tendril::app {
namespace {

/// A target that moves by itself would take out of the hand what is dragged.
void keep_target_still(const ChainPart& part, Emit& emit) {
    if (part.motion.path != Motion::Path::Still) emit.continuously("chain.motion", {{"path", "still"}});
}

}  // namespace

void ChainLab::drag(const Workspace& workspace, PickId pick, const Handle::Frame& frame, Emit& emit) const {
    const glm::vec3 to = frame.position;
    const ChainPart& part = chain_part(workspace);
    if (pick != pole_pick) keep_target_still(part, emit);
    if (pick == target_pick) {
        emit.continuously("chain.target", {{"to", to}});
    } else if (pick == pole_pick) {
        emit.continuously("chain.pole", {{"to", to}});
    } else {
        emit.continuously("chain.pull", {{"index", picked_segment(pick)}, {"to", to}});
    }
}

void ChainLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    if (pick == no_pick) {
        const ChainPart& part = chain_part(workspace);
        if (!part.selection.empty() || part.chosen_point) emit("chain.select");
        return;
    }
    if (pick == target_pick || pick == pole_pick) {
        const ChainPoint point = pick == target_pick ? ChainPoint::Target : ChainPoint::Pole;
        emit("chain.select", {{"point", chain_points.name(point)}});
        return;
    }
    const std::size_t index = picked_segment(pick);
    emit("chain.select", {{"index", index}});
    const ChainPart& part = chain_part(workspace);
    if (part.mode == ChainMode::WithIndex && part.index != index) {
        emit("chain.mode", {{"mode", chain_modes.name(part.mode)}, {"index", index}});
    }
}

void ChainLab::click_more(const Workspace& workspace, PickId pick, Emit& emit) const {
    if (pick == no_pick) return;
    if (pick == target_pick || pick == pole_pick) return click(workspace, pick, emit);
    emit("chain.select", {{"index", picked_segment(pick)}, {"add", true}});
}

/// In a race nobody sees the joints of the chain itself.
std::vector<Handle> ChainLab::selectable(const Workspace& workspace) const {
    std::vector<Handle> joints = handles(workspace);
    const bool racing = chain_part(workspace).study.kind == Study::Kind::Race;
    std::erase_if(joints, [&](const Handle& each) { return racing || each.pick < segment_pick(0); });
    return joints;
}

void ChainLab::select(const Workspace& workspace, const std::vector<PickId>& picks, bool add,
                      Emit& emit) const {
    Json joints = Json::array();
    for (const PickId pick : picks) joints.push_back(picked_segment(pick));
    if (!joints.empty()) {
        emit("chain.select", {{"joints", SharedJson(std::move(joints))}, {"add", add}});
    } else if (!add) {
        click(workspace, no_pick, emit);
    }
}

/// Of what is selected, and can be moved. Several are turned about the active one too.
std::optional<Handle> ChainLab::gizmo(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    if (part.chosen_point == ChainPoint::Target) return handle(workspace, target_pick);
    if (part.chosen_point == ChainPoint::Pole)
        return part.mode == ChainMode::Reach ? handle(workspace, pole_pick) : std::nullopt;
    if (!part.selection.active() || part.study.open()) return std::nullopt;
    auto shown = handle(workspace, segment_pick(*part.selection.active()));
    if (shown && part.selection.several()) shown->drag = Drag::Position | Drag::Rotation;
    return shown;
}

Together ChainLab::together(const Workspace& workspace, Drag) const {
    const ChainPart& part = chain_part(workspace);
    Together together;
    if (part.chosen_point || !part.selection.several()) return together;
    for (const std::size_t i : part.selection.all())
        together.handles.push_back(*handle(workspace, segment_pick(i)));
    return together;
}

void ChainLab::drag_together(const Workspace& workspace, const std::vector<Handle>& handles,
                             Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    Json joints = Json::array(), points = Json::array();
    for (const Handle& each : handles) {
        if (picked_segment(each.pick) >= part.chain.size()) continue;  // what was caught may have gone since
        joints.push_back(picked_segment(each.pick));
        points.push_back(point(each.frame.position));
    }
    if (joints.empty()) return;
    keep_target_still(part, emit);
    emit.continuously("chain.pull",
                      {{"joints", SharedJson(std::move(joints))}, {"points", SharedJson(std::move(points))}});
}

}  // namespace tendril::app
