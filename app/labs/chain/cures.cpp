#include "app/labs/chain/panel.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <tendril/ik/options.hpp>
#include <utility>
#include <vector>

#include "app/io/solver_text.hpp"

namespace tendril::app {
namespace {

/// Changes a setting of the solver and solves again.
Cure solve_with(const ChainPart& part, std::string title, std::string help, NamedArgument setting) {
    return {std::move(title),
            std::move(help),
            {{"chain.solver", {std::move(setting)}}, {"chain.target", {{"to", part.target}}}}};
}

Cure add_pole(const ChainPart& part) {
    return {"Add a pole target",
            "Runs chain.pole: a pink ball beside the chain. The chain bends towards it.",
            {{"chain.pole", {{"to", first_pole(part)}}}}};
}

/// Moves the pole target out of the plane in which the target moved, further to its present side.
std::optional<Cure> move_pole(const ChainPart& before, const ChainPart& after) {
    const glm::vec3 root = after.chain.position(0), pole = *after.reach.options.pole;
    const glm::vec3 normal = glm::cross(before.target - root, after.target - root);
    if (!(glm::length(normal) > 1e-6f * after.chain.reach() * after.chain.reach())) return std::nullopt;
    const glm::vec3 out = glm::normalize(normal);
    const float side = glm::dot(pole - root, out);
    const float by = std::max(0.0f, 0.5f * after.chain.reach() - std::abs(side));
    return Cure{"Move the pole",
                "Runs chain.pole: moves the pole target out of the plane in which the target moves",
                {{"chain.pole", {{"to", pole + std::copysign(by, side) * out}}}}};
}

}  // namespace

glm::vec3 first_pole(const ChainPart& part) {
    const std::vector<glm::vec3> joints = positions(part.chain);
    const glm::vec3 head = joints.front(), line = joints.back() - head;
    const float length = glm::length(line);
    glm::vec3 furthest{0.0f};
    for (const glm::vec3 joint : joints) {
        const glm::vec3 from_head = joint - head;
        const glm::vec3 off =
            length > 0.0f ? from_head - line * (glm::dot(from_head, line) / (length * length)) : from_head;
        if (glm::length(off) > glm::length(furthest)) furthest = off;
    }
    const float bend = glm::length(furthest);
    const glm::vec3 side = bend > 0.02f * part.chain.reach() ? furthest / bend : glm::vec3(0.0f, 1.0f, 0.0f);
    return head + 0.5f * line + 0.4f * part.chain.reach() * side;
}

bool in_line_with_target(const ChainPart& part) {
    const glm::vec3 root = part.chain.position(0), way = part.target - root;
    const float within = 1e-4f * part.chain.reach();
    if (!(glm::length(way) > within)) return false;
    const glm::vec3 along = glm::normalize(way);
    const std::vector<glm::vec3> joints = positions(part.chain);
    return std::all_of(joints.begin(), joints.end(), [&](const glm::vec3& joint) {
        return glm::length(glm::cross(joint - root, along)) <= within;
    });
}

std::optional<Cure> reach_cure(const ChainPart& part) {
    if (part.mode != ChainMode::Reach || !part.result) return std::nullopt;
    const ReachSettings& reach = part.reach;
    const bool limited = is_limited(reach);
    const ik::Status status = part.result->report.status;
    if (status == ik::Status::IterationLimit && reach.options.max_iterations < max_iterations) {
        const int more = std::min(2 * reach.options.max_iterations, max_iterations);
        return solve_with(part, "More iterations", "Runs chain.solver: up to " + std::to_string(more),
                          {"iterations", more});
    }
    if (status != ik::Status::Stalled) return std::nullopt;
    if (!limited && in_line_with_target(part))
        return reach.options.pole ? std::nullopt : std::optional(add_pole(part));
    if (part.result->method != ik::Method::Fabrik)
        return solve_with(part, "Another solver",
                          std::string("Runs chain.solver: ") + solver_title(ik::Method::Fabrik),
                          {"name", ik::name(ik::Method::Fabrik)});
    const int restarts = reach.options.restarts.value_or(default_restarts);
    const Field& row = field_of<&ik::Options::restarts>();
    const int max_restarts = static_cast<int>(row.range.high);
    if (!ik::honours(reach.method, row, limited) || restarts >= max_restarts) return std::nullopt;
    const int more = std::clamp(2 * restarts, default_restarts, max_restarts);
    return solve_with(part, "More restarts", "Runs chain.solver: up to " + std::to_string(more),
                      {"restarts", more});
}

std::optional<Cure> flip_cure(FlipCure cure, const ChainPart& before, const ChainPart& after) {
    switch (cure) {
        case FlipCure::ByHand:
            break;
        case FlipCure::AddPole:
            if (!after.reach.options.pole) return add_pole(before);
            break;
        case FlipCure::MovePole:
            if (after.reach.options.pole) return move_pole(before, after);
            break;
        case FlipCure::NoRestarts:
            return Cure{"No restarts",
                        "Runs chain.solver: the solver continues from its current pose",
                        {{"chain.solver", {{"restarts", 0}}}}};
    }
    return std::nullopt;
}

}  // namespace tendril::app
