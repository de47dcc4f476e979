#include "app/labs/humanoid/clip/clip_lint.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "app/fields/field_rows.hpp"
#include "app/io/character/bake.hpp"
#include "app/io/character/export.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/attachments/attachment_motion.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/tooltip.hpp"

namespace tendril::app {
namespace {

using humanoid::BodyLimits;
using humanoid::Clip;
using humanoid::Finding;
using humanoid::LintReport;

/// Number of frames times nodes that takes a tick or two to judge.
constexpr double max_quick_work = 60'000.0;
/// How much longer judging the result takes, since every frame is solved.
constexpr double result_cost_factor = 10.0;

std::optional<BodyLimits> limits_for(const HumanoidPart& part) {
    if (part.ik.limits == LimitsFrom::Defaults || !part.map->is_usable()) return std::nullopt;
    if (part.ik.limits == LimitsFrom::None) return humanoid::no_limits();
    return humanoid::learned_limits(part.skeleton(), *part.map, part.loaded->clips(),
                                    humanoid::default_limits(part.skeleton(), *part.map));
}

LintReport lint_of(const HumanoidPart& part, const Clip& clip, const humanoid::Ground* ground = nullptr,
                   double rate = 0.0) {
    const std::optional<BodyLimits> limits = limits_for(part);
    return lint(part.skeleton(), *part.map, clip,
                {.rate = rate, .limits = limits ? &*limits : nullptr, .ground = ground});
}

/// Lints the clip as shown. A cure changes the clip as read, so only faults that it has too can be cured.
LintReport lint_of_result(const HumanoidPart& part, Solvers& solvers) {
    const double rate = humanoid::frame_rate(*part.clip());
    const LintReport before = lint_of(part, *part.clip());
    LintReport report = lint_of(part, clip_as_shown(part, solvers, *part.playback.clip, rate),
                                ground_of_feet(part, solvers), rate);
    const std::vector<Finding> made = new_findings(before, report);
    for (Finding& each : report.findings)
        if (std::ranges::find(made, each.text, &Finding::text) != made.end()) each.has_cure = false;
    return report;
}

/// Why a finding has no cure or, if it has one, why that was refused.
std::string why_no_fix(const HumanoidPart& part, const Finding& finding, JudgedClip judged) {
    using enum humanoid::Fault;
    if (finding.has_cure) return "its fix would make a new fault";
    if (judged == JudgedClip::Result)
        return finding.unit == std::string_view("mm") && part.ik.foot_ik.on
                   ? "not in the clip: foot IK makes it on this ground; gentler ground or a slower clip helps"
                   : "not in the clip: IK, curves or springs make it";
    return finding.fault == Limit   ? "the pose may be meant; wider limits accept it"
           : finding.fault == Scale ? "the skeleton is that size; the file's unit corrects it"
                                    : "changing a few keys does not fix it";
}

bool is_meant(const Finding& finding, const ClipCure& cure, const humanoid::Skeleton& skeleton) {
    if (cure.fault && finding.fault != *cure.fault) return false;
    if (cure.frame && !(finding.first <= *cure.frame && *cure.frame <= finding.last)) return false;
    if (cure.node.empty()) return true;
    return finding.node >= 0 && skeleton[static_cast<std::size_t>(finding.node)].name == cure.node;
}

}  // namespace

Clip clip_as_shown(HumanoidPart part, Solvers& solvers, std::size_t clip, double rate, Wardrobe* wardrobe) {
    const Playback was = part.playback;
    part.playback = {.clip = clip,
                     .loop = false,
                     .travel = was.travel,
                     .targets_travel = was.targets_travel,
                     .pace = was.clip == clip ? was.pace : glm::dvec3(0.0)};
    if (was.clip != clip) measure_pace(part);
    carry_targets(part, was);
    IkState state;
    const Clip& before = part.loaded->clips()[clip];
    std::optional<WornMotion> motion;
    if (wardrobe) {
        IkState start = state;
        motion.emplace(part, solvers, solve_pose(part, solvers, 0.0, start), wardrobe->ropes);
        wardrobe->worn = motion->worn();
    }
    const humanoid::Skeleton skeleton = wardrobe ? wardrobe->worn.dressed(part.skeleton()) : part.skeleton();
    return baked(skeleton, before, rate, [&](std::span<rig::Transform> pose, double time, double dt) {
        // Steps of a tick, as in playback, even at a lower rate: springs depend on the step's length.
        const int steps = std::max(1, static_cast<int>(std::ceil(dt / tick_seconds - 1e-6)));
        for (int i = 1; i <= steps; ++i) {
            const Playback last = part.playback;
            part.playback.time = time - dt * (1.0 - static_cast<double>(i) / steps);
            carry_targets(part, last);
            const ShownPose shown = solve_pose(part, solvers, dt / steps, state);
            if (motion) motion->advance(part, solvers, shown, dt / steps);
            if (i < steps) continue;
            std::ranges::copy(shown.local, pose.begin());
            if (motion) motion->pose(shown, pose.subspan(shown.local.size()));
        }
    });
}

const humanoid::Ground* ground_of_feet(const HumanoidPart& part, Solvers& solvers) {
    return part.ik.foot_ik.on && solvers.feet(part) != nullptr ? &solvers.ground(part) : nullptr;
}

ClipLint::Judged ClipLint::wanted(const HumanoidPart& part) {
    Judged judged{part.loaded, part.map, {.clip = part.playback.clip}, part.ik.limits};
    if (part.view.judged != JudgedClip::Result) return judged;
    // The targets at the clip's start, whichever moment is shown; rounded, because moving them there rounds.
    HumanoidPart start = part;
    start.playback.time = 0.0;
    start.playback.rounds = 0;
    carry_targets(start, part.playback);
    const auto rounded = [](double value) { return std::round(1e6 * value) * 1e-6; };
    for (std::optional<humanoid::BodyTarget>& target : start.ik.targets) {
        if (!target) continue;
        for (int i = 0; i < 3; ++i) target->position[i] = rounded(target->position[i]);
        for (int i = 0; i < 4 && target->rotation; ++i)
            (*target->rotation)[i] = rounded((*target->rotation)[i]);
    }
    judged.playback.travel = part.playback.travel;
    judged.playback.targets_travel = part.playback.targets_travel;
    judged.playback.pace = part.playback.pace;
    judged.ik = std::move(start.ik);
    judged.springs = part.springs;
    judged.curves = part.curves;
    return judged;
}

bool judged_soon(const HumanoidPart& part) {
    const Clip* const clip = part.clip();
    const double frames = clip ? clip->duration * humanoid::frame_rate(*clip) : 0.0,
                 each = part.view.judged == JudgedClip::Result ? result_cost_factor : 1.0;
    return each * frames * static_cast<double>(part.skeleton().size()) <= max_quick_work;
}

const LintReport* ClipLint::report(const HumanoidPart& part, Solvers& solvers) {
    const Clip* const clip = part.clip();
    if (!clip) return nullptr;
    if (report_ && judged_ == wanted(part)) return &*report_;
    return judged_soon(part) ? judge(part, solvers) : nullptr;
}

const LintReport* ClipLint::judge(const HumanoidPart& part, Solvers& solvers) {
    const Clip* const clip = part.clip();
    if (!clip) return nullptr;
    if (!report_ || !(judged_ == wanted(part))) {
        report_ =
            part.view.judged == JudgedClip::Result ? lint_of_result(part, solvers) : lint_of(part, *clip);
        judged_ = wanted(part);
    }
    return &*report_;
}

namespace {

/// `left`: all remaining findings. Names those that were to be fixed, with the reason.
std::string cured_text(const HumanoidPart& part, JudgedClip judged, const std::string& clip, std::size_t done,
                       std::size_t left, const std::vector<Finding>& meant) {
    const std::size_t listed = std::min<std::size_t>(meant.size(), 3);
    std::string text = clip + ": " + count_text(done, "fault") + " fixed, " +
                       (left == 0 ? std::string("none") : std::to_string(left)) + " left";
    for (std::size_t i = 0; i < listed; ++i) {
        const std::string why = why_no_fix(part, meant[i], judged);
        text += (i == 0 ? ": " : "; ") + meant[i].text;
        if (i + 1 == listed || why_no_fix(part, meant[i + 1], judged) != why) text += ": no fix, " + why;
    }
    if (meant.size() > listed) text += "; and " + std::to_string(meant.size() - listed) + " more";
    return text;
}

}  // namespace

void require_cure_in_clip(const HumanoidPart& part, const ClipCure& cure, const LintReport& result) {
    std::vector<Finding> meant = result.findings;
    std::erase_if(meant, [&](const Finding& each) { return !is_meant(each, cure, part.skeleton()); });
    if (!meant.empty() && std::ranges::none_of(meant, &Finding::has_cure))
        throw std::invalid_argument(
            cured_text(part, JudgedClip::Result, cure.clip, 0, result.findings.size(), meant));
}

CuredClip cured(const HumanoidPart& part, const ClipCure& cure, LoadProgress* progress) {
    const Clip& place = part.loaded->clips()[part.loaded->clip_called(cure.clip)];
    Clip clip = place;
    const std::optional<BodyLimits> limits = limits_for(part);
    humanoid::LintSettings settings{.rate = humanoid::frame_rate(clip),
                                    .limits = limits ? &*limits : nullptr};
    // A cure may end other findings, or make one curable that was refused: until a round leaves as many as
    // the one before.
    std::vector<Finding> left;
    std::size_t before = 0;
    for (std::size_t last = SIZE_MAX; true; last = left.size()) {
        const LintReport judged = lint(part.skeleton(), *part.map, clip, settings);
        left = judged.findings;
        before = std::max(before, left.size());
        if (left.size() >= last) break;
        std::size_t tried = before - left.size();
        for (const Finding& each : left) {
            report(progress, static_cast<double>(tried++) / static_cast<double>(before + 1));
            if (!each.has_cure || !is_meant(each, cure, part.skeleton())) continue;
            Expected<Clip> mended = humanoid::cure(part.skeleton(), *part.map, clip, each, settings, &judged);
            if (mended) clip = std::move(mended).value();
        }
    }
    const std::size_t now = left.size();
    std::erase_if(left, [&](const Finding& each) { return !is_meant(each, cure, part.skeleton()); });
    if (clip == place) {
        if (left.empty()) throw std::invalid_argument("clip " + cure.clip + " has no such fault");
        throw std::invalid_argument(cured_text(part, JudgedClip::Clip, cure.clip, 0, now, left));
    }
    return {edited(part.loaded, {cure, reading_of(part), std::make_shared<const Clip>(std::move(clip))}),
            cured_text(part, JudgedClip::Clip, cure.clip, before - now, now, left)};
}

// The panel's rows: the findings of the lint with their cures, and where maps and clips are saved.

namespace {

constexpr std::size_t max_rows = 20;

const char* fault_title(humanoid::Fault fault) {
    constexpr const char* titles[] = {
        "skates",           "floats", "sinks",      "knee pops",       "rotation key goes the long way round",
        "beyond its limit", "jumps",  "wrong size", "lies on its side"};
    return titles[static_cast<std::size_t>(fault)];
}

std::string amount(const Finding& finding) {
    const std::string unit = finding.unit;
    const double value = finding.amount;
    if (unit == "mm" && std::abs(value) >= 1000.0) return length_text(1e-3 * value);
    const std::string number = fixed_text(value, std::abs(value) < 9.5 ? 1 : 0);
    return unit == "deg" ? number + "°" : number + (unit == "times" ? " x" : " " + unit);
}

/// The node's name; empty for the whole figure.
std::string node_of(const HumanoidPanel& panel, const Finding& finding) {
    return finding.node < 0 ? std::string()
                            : panel.part.skeleton()[static_cast<std::size_t>(finding.node)].name;
}

void go_to_finding(const HumanoidPanel& panel, const Finding& finding) {
    panel.emit("humanoid.clip", {{"time", finding.time}, {"play", false}});
    if (finding.node >= 0) panel.emit("humanoid.select", {{"node", node_of(panel, finding)}});
}

void cure(const HumanoidPanel& panel, const Finding& finding) {
    ArgumentList arguments{{"kind", humanoid::name(finding.fault)}};
    if (finding.node >= 0) arguments.push_back({"node", node_of(panel, finding)});
    if (finding.fault != humanoid::Fault::SignFlip) arguments.push_back({"frame", finding.frame});
    panel.emit("humanoid.cure", arguments);
}

/// The fault and its amount; below them its time in the clip, and the button that fixes it.
void finding_row(const HumanoidPanel& panel, const Finding& finding, int id) {
    const float em = ImGui::GetFontSize(), line = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float mend = finding.has_cure
                           ? ImGui::CalcTextSize("Fix").x + 2.0f * ImGui::GetStyle().FramePadding.x
                           : ImGui::CalcTextSize("no fix").x;
    std::string where = "frame " + std::to_string(finding.frame);
    if (finding.node >= 0) where += ", " + panel.part.called(static_cast<std::size_t>(finding.node));
    ImGui::PushID(id);
    if (ImGui::Selectable("##finding", false, ImGuiSelectableFlags_AllowItemOverlap, {width, 2.2f * line}))
        go_to_finding(panel, finding);
    const std::string why =
        finding.has_cure ? "" : ". No fix: " + why_no_fix(panel.part, finding, panel.part.view.judged) + '.';
    const std::string place = elided(where, width - mend - 0.4f * em);
    explain(((place == where ? "" : where + ": ") + finding.text + why).c_str());
    const ImVec2 after = ImGui::GetCursorPos();
    const std::string value = amount(finding);
    ImGui::SetCursorPos(at);
    const float amount_width = ImGui::CalcTextSize(value.c_str()).x;
    ImGui::TextUnformatted(elided(fault_title(finding.fault), width - amount_width - 0.4f * em).c_str());
    ImGui::SetCursorPos({at.x + width - amount_width, at.y});
    ImGui::TextUnformatted(value.c_str());
    ImGui::SetCursorPos({at.x, at.y + 1.1f * line});
    ImGui::TextDisabled("%s", place.c_str());
    if (!finding.has_cure) {
        ImGui::SetCursorPos({at.x + width - ImGui::CalcTextSize("no fix").x, at.y + 1.1f * line});
        ImGui::TextDisabled("no fix");
    } else {
        ImGui::SetCursorPos({at.x + width - mend, at.y + 1.1f * line});
        if (ImGui::SmallButton("Fix")) cure(panel, finding);
        explain("Changes the keys around it and leaves the rest of the motion alone.");
    }
    ImGui::SetCursorPos(after);
    ImGui::PopID();
}

}  // namespace

void progress_row(const HumanoidPanel& panel, const char* command) {
    const Loading& loading = panel.runtime.loading;
    if (!loading.running() || loading.work().command != command) return;
    note(loading.work().what + " ...");
    ImGui::ProgressBar(loading.part(), {-1.0f, 0.0f}, "");
    if (row_button("Cancel", 1, true, "The current character stays")) panel.emit("humanoid.load.cancel");
    end_row();
}

static void findings_rows(const HumanoidPanel& panel) {
    if (!panel.part.clip()) return note("Choose a clip to see its faults.");
    FieldRows(panel.part.view, "humanoid.view", panel.emit).rows("judged");
    const humanoid::LintReport* report = panel.runtime.lint.report(panel.part, panel.runtime.solvers);
    if (!report) {
        if (row_button("Check this clip", 1, true, "It is long: this takes a few seconds"))
            panel.runtime.lint.judge(panel.part, panel.runtime.solvers);
        end_row();
        return;
    }
    const std::vector<Finding>& findings = report->findings;
    if (findings.empty()) return note("No faults found.");
    note(std::to_string(findings.size()) + (findings.size() == 1 ? " finding" : " findings") + ", at " +
         fixed_text(report->rate, report->rate == std::floor(report->rate) ? 0 : 2) + " fps");
    const bool any = std::ranges::any_of(findings, &Finding::has_cure);
    if (row_button("Fix all", 1, any,
                   any ? "Fixes every fault that has a fix, in one undo step; says why the rest have none"
                       : "None has a fix; each one's tooltip says why"))
        panel.emit("humanoid.cure", {});
    end_row();
    progress_row(panel, "humanoid.cure");
    for (std::size_t i = 0; i < std::min(findings.size(), max_rows); ++i)
        finding_row(panel, findings[i], static_cast<int>(i));
    if (findings.size() > max_rows) note("and " + std::to_string(findings.size() - max_rows) + " more");
}

void lint_rows(const HumanoidPanel& panel) {
    const FoldingSection open(panel.workspace, "Motion lint", panel.emit, false);
    if (!open) return;
    const float top = ImGui::GetCursorPosY();
    findings_rows(panel);
    keep_room("findings", top);
}

void export_rows(const HumanoidPanel& panel) {
    const FoldingSection open(panel.workspace, "Export", panel.emit, false);
    if (!open) return;
    if (row_button("Copy as C++", 1, true,
                   "Copies the character and its IK as a C++ program that uses the library"))
        panel.emit("humanoid.copy");
    end_row();
    picture_rows(panel.emit);
    if (panel.part.loaded->clips().empty()) return note("The character has no clips.");
    std::string& path = panel.runtime.panel.export_to;
    const LoadedCharacter& loaded = *panel.part.loaded;
    const std::vector<Clip>& clips = loaded.clips();
    const std::size_t clip = panel.part.playback.clip.value_or(0);
    const std::string stem = std::filesystem::path(loaded.file).stem().string(),
                      any = path.empty() ? (stem.empty() ? "figure" : stem) + ".glb" : path,
                      one = path.empty() ? paths_of_clips(loaded.character, any)[clip].string() : path;
    text_field("write to", path, one.c_str());
    explain(
        "A .gltf, .glb or .bvh file for the chosen clip, or the first, after IK. glTF also stores ropes, "
        "hair, cloth and the held object, as bones with a mesh; BVH stores none of them.");
    const int buttons = clips.size() > 1 ? 2 : 1;
    if (row_button("Export clip", buttons, true, "Asks before it replaces a file"))
        panel.emit("humanoid.export", {{"path", one}});
    if (buttons == 2 &&
        row_button("Export all", 2, true, "Each clip to its own file: its name is added to the file's name"))
        panel.emit("humanoid.export", {{"path", any}, {"all", true}});
    end_row();
    const std::string which = one_of_clips_text(loaded.character, clips[clip].name);
    if (!which.empty()) note(which + '.');
}

void map_rows(const HumanoidPanel& panel) {
    auto& state = panel.runtime.panel;
    text_field("map file", state.map_file, "bones.json");
    explain("A bone map file to save to. It fits every character with the same node names.");
    if (row_button("Save map", 2, !state.map_file.empty(), "Saves to the file; asks before it replaces one"))
        panel.emit("humanoid.map.save", {{"path", state.map_file}});
    if (row_button("Load map", 2, true, "Chooses a file, and loads it"))
        panel.emit("scene.open_dialog", {{"by", "humanoid.map.load"}});
    end_row();
}

}  // namespace tendril::app
