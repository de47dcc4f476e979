// A joint's angle, or how far the tip is from its target, over the last ten seconds; and the poses of them.
#include "app/labs/chain/past.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/shown.hpp"

namespace tendril::app {
namespace {

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

enum class Number { Error, Swing, Twist };  // in the order of chain_past()

/// Degrees between a joint's bone and the one before it, or of the root's and where bones point at rest.
float swing_of(const ChainPart& part, std::size_t joint) {
    const auto segments = part.chain.segments();
    if (joint + 1 >= segments.size()) return nothing;
    const glm::vec3 bone = segments[joint + 1].position - segments[joint].position;
    const glm::vec3 parent =
        joint > 0 ? segments[joint].position - segments[joint - 1].position : part.chain.default_direction();
    return glm::degrees(std::atan2(glm::length(glm::cross(parent, bone)), glm::dot(parent, bone)));
}

/// Degrees about the bone. Known where the solver keeps rotations, which is within limits.
float twist_of(const ChainPart& part, std::size_t joint) {
    const auto& rotations = part.reach.state.rotations;
    if (part.reach.limits.empty() || joint >= rotations.size()) return nothing;
    const glm::quat parent = joint > 0 ? rotations[joint - 1] : glm::quat(1, 0, 0, 0);
    return glm::degrees(ik::measure(limit_of(part.reach, joint), part.chain.default_direction(),
                                    glm::conjugate(parent) * rotations[joint])
                            .twist);
}

float value_of(Number what, const ChainPart& part, std::size_t joint) {
    if (what == Number::Swing) return swing_of(part, joint);
    if (what == Number::Twist) return twist_of(part, joint);
    if (part.chain.empty()) return nothing;
    return glm::distance(part.chain.position(part.chain.size() - 1), part.target);
}

const ChainPart& chain_of(const SharedPart& part) {
    return dynamic_cast<const ChainPart&>(*part);
}

/// And bones of the same lengths between them.
bool same_joints(const Part& then, const Part& now) {
    const auto a = dynamic_cast<const ChainPart&>(then).chain.segments(),
               b = dynamic_cast<const ChainPart&>(now).chain.segments();
    if (a.size() != b.size()) return false;
    for (std::size_t i = 1; i < a.size(); ++i)
        if (a[i].length != b[i].length) return false;
    return true;
}

}  // namespace

PastView chain_past() {
    return past_view(
        chain_lab, "chain",
        {{"error", "tip to target"}, {"swing", "swing of a joint"}, {"twist", "twist of a joint"}},
        same_joints);
}

std::optional<PastCurve> chain_past_curve(const Workspace& workspace) {
    const PastView view = chain_past();
    const ChainPart& now = chain_part(workspace);
    if (!view.plots(workspace.settings)) return std::nullopt;
    const auto what = static_cast<Number>(view.chosen(workspace.settings));
    if (what == Number::Error)
        return PastCurve{
            .name = "tip to target",
            .of = "error",
            .unit = "m",
            .lowest_range = 0.01f * std::max(now.chain.reach(), 1e-3f),
            .missing = "The chain has no joint: add one.",
            .value = [](const SharedPart& part) { return value_of(Number::Error, chain_of(part), 0); }};
    const std::size_t joint = now.selection.active().value_or(1);
    const std::string name =
        (what == Number::Swing ? "swing of joint " : "twist of joint ") + std::to_string(joint);
    return PastCurve{
        .name = name,
        .of = name,
        .missing = what == Number::Twist ? "Twist is known within limits only: give a joint one."
                                         : "Select a joint with a bone after it.",
        .value = [what, joint](const SharedPart& part) { return value_of(what, chain_of(part), joint); }};
}

PoseLines chain_lines(const SharedPart& part) {
    const auto segments = chain_of(part).chain.segments();
    PoseLines lines;
    if (segments.size() > max_studied_segments) return lines;
    for (std::size_t i = 1; i < segments.size(); ++i)
        lines.emplace_back(segments[i - 1].position, segments[i].position);
    return lines;
}

}  // namespace tendril::app
