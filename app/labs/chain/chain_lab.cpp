#include "app/labs/chain/chain_lab.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/labs/chain/commands.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

/// What the mouse would do to a joint in Reach.
std::string joint_hint(const ChainPart& part, std::size_t index) {
    const bool root = index == 0, tip = index + 1 == part.chain.size();
    const std::string joint = "Joint " + std::to_string(index) + (root ? " (root)" : tip ? " (tip)" : "");
    if (part.study.open()) return joint + ": click selects it.";
    return joint + ": click selects it, drag moves it; " +
           (root ? "the tip keeps reaching for the target." : "root and target stay.");
}

}  // namespace

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
        for (int due = workspace.clock.whole_ticks(); due > 0; --due) {
            part.motion.ticks = (part.motion.ticks + 1) % ticks_per_round(part.motion);
            reach_for(part, motion_point(part.motion, part.motion.ticks));
            check_range(part);
        }
        part.study.refresh(part.chain, part.reach, part.target);
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
    const std::vector<glm::vec3> joints = shown_joints(part);
    for (std::size_t i = 0; i < joints.size(); ++i)
        handles.push_back({"segment." + std::to_string(i), joints[i]});
    return handles;
}

glm::vec3 ChainLab::position_of(const Workspace& workspace, PickId pick) const {
    const ChainPart& part = chain_part(workspace);
    if (pick == pole_pick) return part.reach.pole.value_or(part.target);
    if (pick == target_pick || part.chain.empty()) return part.target;
    const std::size_t index = std::min(picked_segment(pick), part.chain.size() - 1);
    return part.study.trace ? shown_joints(part)[index] : part.chain.position(index);
}

void ChainLab::drag(const Workspace& workspace, PickId pick, glm::vec3 to, Emit& emit) const {
    const ChainPart& part = chain_part(workspace);
    // A target that moves by itself would take out of the hand what is dragged.
    if (pick != pole_pick && part.motion.path != Motion::Path::Still)
        emit.continuously("chain.motion", {{"path", "still"}});
    if (pick == target_pick) {
        emit.continuously("chain.target", {{"to", to}});
    } else if (pick == pole_pick) {
        emit.continuously("chain.pole", {{"to", to}});
    } else if (!part.study.open()) {
        emit.continuously("chain.pull", {{"index", picked_segment(pick)}, {"to", to}});
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
    if (part.mode == ChainMode::Reach) return joint_hint(part, index);
    const char* role = index == 0 ? " (head)" : index + 1 == part.chain.size() ? " (tail)" : "";
    return "Segment " + std::to_string(index) + role + ": click selects it, drag pulls it.";
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
    for (const glm::vec3& joint : part.study.start) low = glm::min(low, joint), high = glm::max(high, joint);
    if (part.mode == ChainMode::Reach && part.reach.pole) {
        low = glm::min(low, *part.reach.pole);
        high = glm::max(high, *part.reach.pole);
    }
    if (part.study.race) {
        const glm::vec3 lanes = race_lane(part.study) * static_cast<float>(part.study.race->racers.size());
        high += glm::max(lanes - glm::abs(race_lane(part.study)), 0.0f);
    }
    return {0.5f * (low + high), std::max(0.5f * glm::distance(low, high), 0.5f)};
}

std::vector<LegendRow> ChainLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    const ChainPart& part = chain_part(workspace);
    std::vector<LegendRow> rows;
    if (part.study.race) {
        for (const Racer& racer : part.study.race->racers) {
            rows.push_back(
                {solver_title(racer.method), colours.racers[static_cast<std::size_t>(racer.method)]});
        }
        rows.push_back({"start", colours.ghost});
        rows.push_back({"target", colours.target});
        return rows;
    }
    rows = {{"head", colours.head},
            {"tail", colours.tail},
            {"target", colours.target},
            {"selection", colours.selection, true}};
    if (part.study.trace) rows.push_back({"this step", colours.accent, true});
    if (part.study.trace) rows.push_back({"start, earlier iterations", colours.ghost});
    if (part.mode != ChainMode::Reach) return rows;
    if (part.reach.pole) rows.push_back({"pole", colours.pole});
    if (!part.reach.limits.empty()) rows.push_back({"limit", colours.ghost, true});
    if (!part.reach.limits.empty()) rows.push_back({"limit that holds", colours.limit, true});
    return rows;
}

bool ChainLab::has_timeline(const Workspace& workspace) const {
    return moving(workspace) || chain_part(workspace).study.kind == Study::Kind::Microscope;
}

}  // namespace tendril::app
