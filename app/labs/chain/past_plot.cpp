// A joint's angle, or how far the tip is from its target, over the last ten seconds.
#include <imgui.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/panels.hpp"
#include "app/labs/kit/past_strip.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/plot.hpp"

namespace tendril::app {
namespace {

constexpr float plot_height = 130.0f;  ///< pixels at scale 1
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

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

float value_of(PastPlot what, const ChainPart& part, std::size_t joint) {
    if (what == PastPlot::Swing) return swing_of(part, joint);
    if (what == PastPlot::Twist) return twist_of(part, joint);
    if (part.chain.empty()) return nothing;
    return glm::distance(part.chain.position(part.chain.size() - 1), part.target);
}

/// "Swing of joint 2"
std::string title_of(PastPlot what, std::size_t joint) {
    if (what == PastPlot::Error) return "tip to target";
    return (what == PastPlot::Swing ? "swing of joint " : "twist of joint ") + std::to_string(joint);
}

}  // namespace

LabSetting past_plot_setting() {
    return {.key = "chain plot",
            .command = "view.chain_plot",
            .title = "Plot the chain's last ten seconds",
            .argument = "of",
            .help = "Plots something of the last ten seconds of the Chain lab below the scene",
            .choices = {{"nothing", "nothing"},
                        {"error", "tip to target"},
                        {"swing", "swing of a joint"},
                        {"twist", "twist of a joint"}}};
}

PastPlot past_plot(const Settings& settings) {
    return static_cast<PastPlot>(past_plot_setting().chosen(settings));
}

float ChainLab::timeline_height(const Workspace& workspace) const {
    const bool plots = past_plot(workspace.settings) != PastPlot::Nothing &&
                       chain_part(workspace).study.kind != Study::Kind::Microscope;
    return strip_height + (plots ? plot_height : 0.0f);
}

void past_plot_rows(const Workspace& workspace) {
    const PastPlot what = past_plot(workspace.settings);
    if (what == PastPlot::Nothing) return;
    const ChainPart& now = chain_part(workspace);
    const Palette& colours = palette(workspace.settings.theme);
    const Rewind& past = workspace.rewind;
    // An angle is that of the joint that is selected, or else of the one after the root: an arm's elbow.
    const std::size_t joint = now.selection.active().value_or(1);
    const std::uint64_t first = past.empty() ? workspace.moment : past.oldest();
    const auto seconds = [&](std::uint64_t tick) {
        return static_cast<float>(static_cast<double>(tick - first) * tick_seconds);
    };
    Curve curve{.name = title_of(what, joint), .colour = colours.accent, .points = {}, .marks = false};
    const auto add = [&](std::uint64_t tick, const ChainPart& part) {
        const float value = value_of(what, part, joint);
        if (std::isfinite(value)) curve.points.emplace_back(seconds(tick), value);
    };
    for (const Rewind::Moment& moment : past.moments())
        add(moment.tick, dynamic_cast<const ChainPart&>(*moment.part));
    if (past.empty() || workspace.moment > past.newest()) add(workspace.moment, now);
    if (curve.points.empty()) {
        note(what == PastPlot::Twist ? "Twist is known within limits only: give a joint one."
                                     : "Select a joint with a bone after it.");
        return;
    }
    std::vector<Curve> curves{std::move(curve)};
    for (const Incident& incident : past.incidents()) {
        if (incident.kind != Incident::Kind::Flip || incident.tick + 1 < first) continue;
        const float at = seconds(incident.tick + 1), value = value_at(curves.front(), at);
        if (!std::isfinite(value)) continue;
        curves.push_back({.name = "flip", .colour = colours.limit, .points = {{at, value}}, .width = 1.5f});
    }
    const bool angle = what != PastPlot::Error;
    plot("past", curves,
         {.x = "time",
          .x_unit = "s",
          .y = curves.front().name.c_str(),
          .y_unit = angle ? "deg" : "m",
          .min_y = 0.0f,
          .min_x = 10.0f,
          .low_y = 0.0f,
          .high_y = angle ? 10.0f : 0.01f * std::max(now.chain.reach(), 1e-3f),
          .at_x = seconds(std::max(workspace.moment, first))},
         ImGui::GetContentRegionAvail().y / ImGui::GetTextLineHeight() - 0.2f);
}

}  // namespace tendril::app
