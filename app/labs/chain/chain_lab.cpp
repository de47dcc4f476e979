#include "app/labs/chain/chain_lab.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/chain/commands.hpp"

namespace tendril::app {

std::shared_ptr<Part> ChainLab::blank() const {
    return std::make_shared<ChainPart>(first_chain());
}

CameraPose ChainLab::first_view() const {
    return {.target = {3.5f, 0.7f, 0.0f},
            .yaw = glm::radians(-20.0f),
            .pitch = glm::radians(20.0f),
            .distance = 12.5f};
}

void ChainLab::add_commands(CommandTable& table) const {
    add_chain_commands(table);
}

bool ChainLab::moving(const Workspace& workspace) const {
    return chain_part(workspace).motion.path != Motion::Path::Still;
}

void ChainLab::step(Workspace& workspace) const {
    const Document before = workspace.document;
    auto& part = workspace.document.edit<ChainPart>(chain_lab);
    try {
        part.motion.ticks = (part.motion.ticks + 1) % ticks_per_round(part.motion);
        reach_for(part, motion_point(part.motion, part.motion.ticks));
        check_range(part);
    } catch (const std::logic_error& error) {  // a chain dragged to the end of the world stops there
        workspace.document = before;
        workspace.document.edit<ChainPart>(chain_lab).motion.path = Motion::Path::Still;
        workspace.toast(error.what(), ToastKind::Refusal);
    }
}

std::vector<Handle> ChainLab::handles(const Workspace& workspace) const {
    const ChainPart& part = chain_part(workspace);
    std::vector<Handle> handles{{"target", part.target}};
    if (part.mode == ChainMode::Reach && part.reach.pole) handles.push_back({"pole", *part.reach.pole});
    for (std::size_t i = 0; i < part.chain.size(); ++i) {
        handles.push_back({"segment." + std::to_string(i), part.chain.segments()[i].position});
    }
    return handles;
}

glm::vec3 ChainLab::position_of(const Workspace& workspace, PickId pick) const {
    const ChainPart& part = chain_part(workspace);
    if (pick == pole_pick) return part.reach.pole.value_or(part.target);
    if (pick == target_pick || part.chain.empty()) return part.target;
    return part.chain.position(std::min(picked_segment(pick), part.chain.size() - 1));
}

void ChainLab::drag(const Workspace& workspace, PickId pick, glm::vec3 to, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    const bool moves_target = pick != pole_pick;
    if (moves_target && part.motion.path != Motion::Path::Still)
        emit.continuously("chain.motion", {{"path", "still"}});
    if (pick == target_pick) {
        emit.continuously("chain.target", {{"to", point(to)}});
    } else if (pick == pole_pick) {
        emit.continuously("chain.pole", {{"to", point(to)}});
    } else if (!part.study.open()) {
        emit.continuously("chain.pull", {{"index", picked_segment(pick)}, {"to", point(to)}});
    }
}

void ChainLab::click(const Workspace& workspace, PickId pick, Emit& emit) const {
    if (pick == no_pick) {
        if (chain_part(workspace).selected) emit("chain.select");
        return;
    }
    if (pick == target_pick || pick == pole_pick) return;
    const std::size_t index = picked_segment(pick);
    emit("chain.select", {{"index", index}});
    const ChainPart& part = chain_part(workspace);
    if (part.mode == ChainMode::WithIndex && part.index != index) {
        emit("chain.mode", {{"mode", mode_name(part.mode)}, {"index", index}});
    }
}

std::string ChainLab::hint(const Workspace& workspace, PickId pick) const {
    const ChainPart& part = chain_part(workspace);
    if (pick == no_pick) return {};
    if (pick == target_pick) {
        return std::string("Target: drag to reach for it (") + mode_title(part.mode) +
               "). Hold X, Y or Z for one axis, "
               "Shift for the ground plane.";
    }
    if (pick == pole_pick)
        return "Pole: the bend faces it. Drag to turn the chain about its line to the target.";
    const std::size_t index = picked_segment(pick);
    const char* role = index == 0 ? " (head)" : index + 1 == part.chain.size() ? " (tail)" : "";
    const char* drag = part.study.open() ? "." : ", drag pulls it.";
    return "Segment " + std::to_string(index) + role + ": click selects it" + drag;
}

Bounds ChainLab::bounds(const Workspace& workspace, bool selection_only) const {
    const ChainPart& part = chain_part(workspace);
    if (selection_only && part.selected) {
        return {part.chain.position(*part.selected),
                std::max(1.5f * part.chain.length(*part.selected), 0.5f)};
    }
    glm::vec3 low = part.target, high = part.target;
    for (const Segment& segment : part.chain.segments()) {
        low = glm::min(low, segment.position);
        high = glm::max(high, segment.position);
    }
    return {0.5f * (low + high), std::max(0.5f * glm::distance(low, high), 0.5f)};
}

bool ChainLab::has_timeline(const Workspace& workspace) const {
    return moving(workspace) || chain_part(workspace).study.kind == Study::Kind::Microscope;
}

}  // namespace tendril::app
