#include "app/labs/humanoid/humanoid_part.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/gtc/quaternion.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <stdexcept>
#include <tendril/humanoid/lint.hpp>
#include <tendril/magnitude.hpp>

#include "app/labs/humanoid/draw.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/panel.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/past.hpp"
#include "app/widgets/icons.hpp"
#include "app/widgets/timeline.hpp"
#include "app/widgets/tooltip.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// A point on the ground, or a rotation about the vertical, as z + i x; angles run from +Z to +X.
using Complex = std::complex<double>;

struct OnGround {
    Complex at{0.0, 0.0};
    double angle = 0.0;
};

std::vector<rig::Transform> sampled(const humanoid::Clip& clip, const humanoid::Skeleton& skeleton,
                                    double time) {
    std::vector<rig::Transform> pose(skeleton.size());
    humanoid::sample(clip, skeleton, time, pose);
    return pose;
}

OnGround hips_at(const humanoid::Skeleton& skeleton, const std::vector<rig::Transform>& pose,
                 std::size_t hips) {
    std::vector<humanoid::Placement> placed(skeleton.size());
    humanoid::place(skeleton, pose, placed);
    const glm::dquat rotation = placed[hips].rotation();
    return {{placed[hips].position.z, placed[hips].position.x},
            2.0 * math::arctangent(rotation.y, rotation.w)};
}

/// The motion from the first round to the current one: z -> turn * z + move.
struct RoundTurn {
    Complex turn{1.0, 0.0}, move{0.0, 0.0};
};

RoundTurn of_rounds(const OnGround& first, const OnGround& last, double rounds) {
    const double angle = std::remainder(last.angle - first.angle, 2.0 * 3.14159265358979323846);
    const Complex once = std::polar(1.0, angle), move = last.at - once * first.at;
    if (std::abs(angle) < 1e-9) return {Complex(1.0, 0.0), rounds * move};
    const Complex all = std::polar(1.0, angle * rounds);
    return {all, move * (all - 1.0) / (once - 1.0)};
}

rig::Transform transform(const RoundTurn& ground) {
    const double half = 0.5 * std::arg(ground.turn);
    return {.translation = {ground.move.imag(), 0.0, ground.move.real()},
            .rotation = {math::cosine(half), 0.0, math::sine(half), 0.0}};
}

/// Displacement due to the pace after `time` in a round.
Complex along(const Playback& playback, double time) {
    return {playback.pace.z * time, playback.pace.x * time};
}

/// The hips at the end of a round, with the pace.
OnGround end_of_round(const Playback& playback, const humanoid::Clip& clip,
                      const humanoid::Skeleton& skeleton, std::size_t hips) {
    OnGround end = hips_at(skeleton, sampled(clip, skeleton, clip.duration), hips);
    end.at += along(playback, clip.duration);
    return end;
}

double duration_of(const Playback& playback, const LoadedCharacter& character) {
    return playback.clip ? character.clips()[*playback.clip].duration : 0.0;
}

}  // namespace

bool goes_on(const Playback& playback, const LoadedCharacter& character) {
    return playback.playing && playback.speed > 0.0 && duration_of(playback, character) > 0.0;
}

void advance(Playback& playback, const LoadedCharacter& character, double seconds) {
    if (!goes_on(playback, character)) return;
    const double duration = duration_of(playback, character);
    playback.time += playback.speed * seconds;
    if (playback.time <= duration) return;
    if (!playback.loop) {
        playback.time = duration;
        playback.playing = false;
        return;
    }
    const double whole = std::ceil(playback.time / duration) - 1.0;
    playback.time = std::clamp(playback.time - whole * duration, 0.0, duration);
    playback.rounds = std::min(playback.rounds + static_cast<std::int64_t>(std::min(whole, 1e6)), max_rounds);
}

void go_to(Playback& playback, const LoadedCharacter& character, double seconds) {
    const double duration = duration_of(playback, character);
    playback.rounds = 0;
    playback.time = std::clamp(seconds, 0.0, duration);
    if (!playback.loop || !(seconds > duration) || !(duration > 0.0)) return;
    const double whole = std::min(std::ceil(seconds / duration) - 1.0, static_cast<double>(max_rounds));
    playback.rounds = static_cast<std::int64_t>(whole);
    playback.time = std::clamp(seconds - whole * duration, 0.0, duration);
}

std::vector<rig::Transform> animated_pose(const Playback& playback, const LoadedCharacter& character,
                                          std::optional<std::size_t> hips, bool unfixed) {
    const humanoid::Skeleton& skeleton = character.skeleton();
    if (!playback.clip) return humanoid::rest_pose(skeleton);
    const humanoid::Clip& clip = character.clips()[*playback.clip];
    std::vector<rig::Transform> pose =
        sampled(unfixed ? character.clip_unfixed(*playback.clip) : clip, skeleton, playback.time);
    const bool paces = playback.pace != glm::dvec3(0.0);
    if (!hips || (playback.rounds == 0 && !playback.in_place && !paces)) return pose;
    const OnGround first = hips_at(skeleton, sampled(clip, skeleton, 0.0), *hips);
    RoundTurn ground;
    if (playback.in_place) {
        ground.move = first.at - hips_at(skeleton, pose, *hips).at;
    } else {
        ground = of_rounds(first, end_of_round(playback, clip, skeleton, *hips),
                           static_cast<double>(playback.rounds));
        ground.move += ground.turn * along(playback, playback.time);
    }
    for (std::size_t i = 0; i < pose.size(); ++i)
        if (skeleton[i].parent < 0) pose[i] = rig::compose(transform(ground), pose[i]);
    return pose;
}

glm::dvec3 pace_of(const HumanoidPart& part, std::size_t clip) {
    return -humanoid::lint(part.skeleton(), *part.map, part.loaded->clips()[clip]).treadmill;
}

void measure_pace(HumanoidPart& part) {
    Playback& playback = part.playback;
    playback.pace = playback.travel && playback.clip ? pace_of(part, *playback.clip) : glm::dvec3(0.0);
}

void carry_targets(HumanoidPart& part, const Playback& before) {
    const Playback& now = part.playback;
    const auto hips = part.node_of(humanoid::Bone::Hips);
    if (now.in_place || !now.targets_travel || !hips || !now.clip || now.clip != before.clip ||
        !(part.ik.has_targets() || (part.ik.hold && !part.ik.hold->with_body)))
        return;
    const humanoid::Skeleton& skeleton = part.skeleton();
    const humanoid::Clip& clip = *part.clip();
    if (!(clip.duration > 0.0)) return;
    const double rounds =
        static_cast<double>(now.rounds - before.rounds) + (now.time - before.time) / clip.duration;
    if (rounds == 0.0) return;
    const rig::Transform along = transform(of_rounds(hips_at(skeleton, sampled(clip, skeleton, 0.0), *hips),
                                                     end_of_round(now, clip, skeleton, *hips), rounds));
    const auto carried = [&](glm::dvec3& position) {
        const glm::dvec3 at = along.translation + along.rotation * position;
        constexpr auto most = static_cast<double>(max_magnitude);
        if (glm::any(glm::greaterThan(glm::abs(at), glm::dvec3(most)))) return false;
        position = at;
        return true;
    };
    for (std::optional<humanoid::BodyTarget>& target : part.ik.targets)
        if (target && carried(target->position) && target->rotation)
            target->rotation = rig::normalised(along.rotation * *target->rotation);
    if (part.ik.hold && !part.ik.hold->with_body && carried(part.ik.hold->position))
        part.ik.hold->rotation = rig::normalised(along.rotation * part.ik.hold->rotation);
}

glm::dvec3 missing_velocity(const Playback& playback, const LoadedCharacter& character,
                            std::optional<std::size_t> hips) {
    if (!playback.clip || !playback.in_place || !hips) return glm::dvec3(0.0);
    const humanoid::Clip& clip = character.clips()[*playback.clip];
    const double from = std::max(0.0, playback.time - 1.0 / 120.0),
                 to = std::min(clip.duration, playback.time + 1.0 / 120.0);
    if (!(to > from)) return glm::dvec3(0.0);
    const humanoid::Skeleton& skeleton = character.skeleton();
    const auto at = [&](double time) { return hips_at(skeleton, sampled(clip, skeleton, time), *hips).at; };
    const Complex velocity = (at(to) - at(from)) / (to - from);
    return glm::dvec3(velocity.imag(), 0.0, velocity.real()) + playback.pace;
}

// The strip below the scene: the clip with buttons to play and step it, or the last ten seconds.

bool shows_lint_marks(const Workspace& workspace) {
    HumanoidRuntime& runtime = humanoid_runtime(workspace);
    const HumanoidPart& part = humanoid_part(workspace);
    if (part.clip() == nullptr || runtime.panel.past) return false;
    const humanoid::LintReport* const report = runtime.lint.report(part, runtime.solvers);
    return report != nullptr && !report->findings.empty();
}

namespace {

/// Seconds since the first round started.
double since_begin(const Playback& playback, double duration, double time) {
    return static_cast<double>(playback.rounds) * duration + time;
}

void step(const HumanoidPanel& panel, int ticks) {
    const Playback& playback = panel.part.playback;
    const double duration = panel.part.clip()->duration;
    const double now = since_begin(playback, duration, playback.time),
                 to = std::max(0.0, now + ticks * tick_seconds);
    panel.emit("humanoid.clip", {{"time", playback.loop ? to : std::min(to, duration)}, {"play", false}});
}

void buttons(const HumanoidPanel& panel) {
    const bool plays = panel.part.playback.playing && panel.workspace.clock.playing;
    if (icon_button("back", Icon::ChevronLeft, "One frame back")) step(panel, -1);
    ImGui::SameLine();
    if (icon_button("play", plays ? Icon::Pause : Icon::Play, plays ? "Pauses the clip" : "Plays the clip")) {
        panel.emit("humanoid.play", {{"on", !plays}});
        if (!plays && !panel.workspace.clock.playing) panel.emit("time.play");
    }
    ImGui::SameLine();
    if (icon_button("forward", Icon::ChevronRight, "One frame forward")) step(panel, 1);
    ImGui::SameLine();
}

/// Marks of the lint: low bars over the duration of a finding, a full one at its worst frame.
std::vector<TimeBar> lint_marks(const HumanoidPanel& panel, int ticks) {
    if (!shows_lint_marks(panel.workspace)) return {};
    const humanoid::LintReport* const report = panel.runtime.lint.report(panel.part, panel.runtime.solvers);
    std::vector<TimeBar> bars(static_cast<std::size_t>(ticks) + 1);
    const auto tick_of = [&](std::size_t frame) {
        const double tick = static_cast<double>(frame) / report->rate / tick_seconds;
        return static_cast<std::size_t>(std::clamp(std::lround(tick), 0l, static_cast<long>(ticks)));
    };
    const auto mark = [&](std::size_t tick, float height) {
        bars[tick] = {panel.colours.limit, std::max(bars[tick].height, height)};
    };
    for (const humanoid::Finding& each : report->findings) {
        // A finding over the whole clip says nothing about any one moment.
        const bool whole = each.first == 0 && each.last + 1 >= report->frames;
        for (std::size_t i = tick_of(each.first); !whole && i <= tick_of(each.last); ++i) mark(i, 0.35f);
        mark(tick_of(each.frame), 1.0f);
    }
    return bars;
}

void clip_strip(const HumanoidPanel& panel) {
    const Playback& playback = panel.part.playback;
    const double duration = panel.part.clip()->duration;
    const int ticks = std::max(1, static_cast<int>(std::ceil(duration / tick_seconds - 1e-6)));
    int tick = std::clamp(static_cast<int>(std::lround(playback.time / tick_seconds)), 0, ticks);
    const TimeStrip strip{
        .ticks = ticks, .seconds = tick_seconds, .known = ticks, .bars = lint_marks(panel, ticks)};
    const TimeStripUse use = time_strip("clip", tick, strip);
    if (use.hovered >= 0 && !ImGui::IsItemActive())
        tooltip("The clip. Drag to see it at that time; the marks are the faults that Motion lint found.");
    if (use.moved) {
        const double time = std::min(tick * tick_seconds, duration);
        panel.emit.continuously("humanoid.clip",
                                {{"time", since_begin(playback, duration, time)}, {"play", false}});
    }
}

/// Returns the line of the last ten seconds if the strip shows it.
std::optional<StripLine> strip(const HumanoidPanel& panel) {
    if (panel.part.clip() == nullptr) return past_strip(panel.workspace, panel.emit);
    bool& past = panel.runtime.panel.past;
    buttons(panel);
    if (other_strip_button(past, "clip")) past = !past;
    if (past) return past_strip(panel.workspace, panel.emit);
    clip_strip(panel);
    return std::nullopt;
}

}  // namespace

void HumanoidLab::timeline(const Workspace& workspace, Emit& emit) const {
    const std::optional<StripLine> past = strip(humanoid_panel(workspace, emit));
    past_plot(workspace, humanoid_past(), past, emit);
    forget_past_poses(workspace);
}

}  // namespace tendril::app

// Commands on clips: choosing one, its moment, and how it plays.

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::Playback>() noexcept {
    using app::Playback;
    static constexpr Field rows[] = {field<&Playback::playing>("playing"),
                                     field<&Playback::time>("time", {0.0, app::longest_playback}, "s"),
                                     field<&Playback::rounds>("rounds", {0.0, app::max_rounds}),
                                     field<&Playback::speed>("speed", {0.0, app::fastest_clip}),
                                     field<&Playback::loop>("loop"),
                                     field<&Playback::in_place>("in_place"),
                                     field<&Playback::travel>("travel"),
                                     field<&Playback::targets_travel>("targets_travel")};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<Playback>() {
    static constexpr FieldText texts[] = {
        {.name = "speed",
         .label = "speed",
         .help = "How fast the clip plays. 1, or 100 %, is the recorded speed.",
         .step = 0.5f,
         .decimals = 0,
         .scale = 100.0,
         .unit = "%",
         .more = true},
        {.name = "loop",
         .label = "Loop",
         .help = "Loops the clip; a walk continues from where it ended. Off: stops at the end.",
         .more = true},
        {.name = "in_place",
         .label = "In place",
         .help = "The hips stay above the point where the clip begins.",
         .more = true},
        {.name = "travel",
         .label = "Travel",
         .help = "A clip that walks in place travels at its standing foot's speed, so that it can climb "
                 "stairs and slopes. A clip that already travels does not change.",
         .more = true},
        {.name = "targets_travel",
         .label = "Targets travel",
         .help = "Targets move with a walk. Off: they stay in place in the world.",
         .more = true}};
    return texts;
}

namespace {

std::size_t chosen_clip(const LoadedCharacter& character, const Arguments& given) {
    const std::vector<humanoid::Clip>& clips = character.clips();
    if (clips.empty()) throw std::invalid_argument("the character has no clips");
    if (given.has("index")) {
        const auto index = static_cast<std::size_t>(given.integer("index"));
        if (index < clips.size()) return index;
        throw std::invalid_argument("index must be 0 to " + std::to_string(clips.size() - 1) + ", got " +
                                    std::to_string(index));
    }
    return character.clip_called(given.text("name"));
}

glm::vec3 hips_at(const Workspace& workspace) {
    return shown_pose(workspace).point(humanoid_part(workspace).node_of(humanoid::Bone::Hips).value_or(0));
}

void choose(Playback& playback, std::optional<std::size_t> clip) {
    if (playback.clip == clip) return;
    playback.clip = clip;
    playback.time = 0.0;
    playback.rounds = 0;
    if (!clip) playback.playing = false;
}

/// Playing from the end restarts.
void set_playing(HumanoidPart& part, bool on) {
    Playback& playback = part.playback;
    playback.playing = on;
    if (on && !playback.loop && playback.time >= part.clip()->duration) go_to(playback, *part.loaded, 0.0);
}

void play(HumanoidPart& part, const Arguments& given) {
    if (!part.playback.clip) throw std::invalid_argument("no clip is chosen");
    const Playback before = part.playback;
    set_playing(part, given.boolean("on"));
    if (!(part.playback == before)) part.quiet_ticks = 0;
}

void set_clip(HumanoidPart& part, const Arguments& given) {
    Playback& playback = part.playback;
    const Playback before = playback;
    if (given.has("name") && given.has("index"))
        throw std::invalid_argument("give either a name or an index");
    const bool none = given.has("name") && given.text("name").empty();
    if (none)
        choose(playback, std::nullopt);
    else if (given.has("name") || given.has("index"))
        choose(playback, chosen_clip(*part.loaded, given));
    set_fields(given, playback);
    if (playback.clip != before.clip || playback.travel != before.travel) measure_pace(part);
    const bool play = given.has("play") && given.boolean("play");
    if (!playback.clip && (play || given.has("time"))) throw std::invalid_argument("no clip is chosen");
    if (given.has("time")) go_to(playback, *part.loaded, given.real("time"));
    if (play && !given.has("time"))
        set_playing(part, true);
    else if (given.has("play"))
        playback.playing = play;
    carry_targets(part, before);
    if (!(playback == before)) part.quiet_ticks = 0;
}

}  // namespace

Command followed(Command command) {
    command.apply = [apply = command.apply](Workspace& workspace, const Arguments& given) {
        const glm::vec3 before = hips_at(workspace);
        apply(workspace, given);
        if (workspace.lab != humanoid_lab || !humanoid_part(workspace).view.follow) return;
        glm::vec3 way = hips_at(workspace) - before;
        // Ignores small changes of height, so that a crouching figure stays in place in the view. Large ones
        // count: the hips of captured figures rest at the origin.
        if (std::abs(way.y) < 0.3f) way.y = 0.0f;
        workspace.camera.target += way;
    };
    return command;
}

void add_clip_commands(CommandTable& table) {
    std::vector<Argument> arguments{
        clip_argument("name", "which clip; empty: the rest pose"),
        integer_argument("index", "instead of the name, counted from 0", 0, 1e6),
        switch_argument("play", "false: pauses"),
        number_argument("time", "seconds from its start; beyond its duration, in a later round", 0.0,
                        longest_playback)};
    for (Argument& each : field_arguments<Playback>()) arguments.push_back(std::move(each));
    Command clip = part_command<HumanoidPart>(
        humanoid_lab, "humanoid.clip", "Choose and play a clip", std::move(arguments),
        "Chooses a clip, its time and how it plays; omitted settings are kept", set_clip);
    table.add(followed(std::move(clip)));
    table.add(part_command<HumanoidPart>(
        humanoid_lab, "humanoid.play", "Play or pause the clip",
        {{.name = "on", .type = ArgumentType::Boolean, .help = "false: pauses"}},
        "Plays the chosen clip or pauses it; no step to undo", play, Effect::Look));
}

}  // namespace tendril::app
