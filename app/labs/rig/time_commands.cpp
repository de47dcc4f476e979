// Time in the lab: controls that walk, going to any tick, clips, frame rates.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/kit/name_list.hpp"
#include "app/labs/kit/part_command.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rates.hpp"
#include "app/labs/rig/rig_commands.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/labs/rig/walk.hpp"

namespace tendril::app {
namespace {

constexpr double max_clip = static_cast<double>(max_clip_frames) * tick_seconds;

RigRuntime& runtime_of(const Workspace& workspace) {
    return workspace.runtimes.of<RigRuntime>(rig_lab);
}

glm::vec3 place_of(const rig::Value& value) {
    const auto* pose = std::get_if<rig::Transform>(&value);
    return glm::vec3(pose ? pose->translation : std::get<glm::dvec3>(value));
}

/// The tick of `to` that is as far around as `ticks` after the start of `from` is.
std::uint32_t phase_of(const Motion& from, std::uint32_t ticks, const Motion& to) {
    const std::uint64_t round = ticks_per_round(from), at = (std::uint64_t{from.ticks} + ticks) % round;
    return static_cast<std::uint32_t>(at * ticks_per_round(to) / round);
}

/// The path starts where the control is, so setting it going never makes it jump; unless its centre is given.
/// One that follows the same path already goes on around the same centre. `old`: null where it does not walk.
RigWalk walk_given(const RigPart& part, std::size_t at, const RigWalk* old, const Arguments& given) {
    const rig::Element& element = part.rig.definition().elements[at];
    if (!element.control) throw std::invalid_argument("\"" + element.name + "\" is no control");
    if (!can_walk(element.control->kind))
        throw std::invalid_argument("only a transform or position control can follow a path; \"" +
                                    element.name + "\" is a " + control_title(element.control->kind));
    RigWalk walk = old != nullptr ? *old : RigWalk{element.name, {.radius = 0.5f}, false};
    walk.motion.path = motion_paths.value(given.text("path"));
    if (given.has("radius")) walk.motion.radius = given.number("radius");
    if (given.has("period")) walk.motion.period = given.number("period");
    if (given.has("turn")) walk.turn = given.boolean("turn");
    if (walk.turn && element.control->kind != rig::ControlKind::Transform)
        throw std::invalid_argument("only a transform control turns along its path");
    const bool goes_on = old != nullptr && walk.motion.path == old->motion.path;
    walk.motion.ticks = goes_on ? phase_of(old->motion, part.take.tick, walk.motion) : 0;
    if (given.has("centre")) {
        walk.motion.centre = given.point("centre");
    } else if (!goes_on) {
        walk.motion.centre = glm::vec3(0.0f);
        walk.motion.centre = place_of(part.state.controls[at]) - glm::vec3(walk_point(walk.motion, 0.0));
    }
    check_path(walk.motion.centre, glm::vec3(walk.motion.radius), "the control's path");
    return walk;
}

void set_motions(RigPart& part, const Arguments& given) {
    const std::vector<std::size_t> controls = elements_given(part, given);
    std::vector<const RigWalk*> old(part.state.controls.size());
    for (const RigWalk& each : part.walks) old[element_named(part, each.control)] = &each;
    std::vector<RigWalk> walks;
    for (const std::size_t at : controls) walks.push_back(walk_given(part, at, old[at], given));
    std::erase_if(part.walks, [&](const RigWalk& each) {
        return std::ranges::binary_search(controls, element_named(part, each.control));
    });
    part.moving = true;
    part.rates.reset();
    begin_take(part);
    for (RigWalk& each : walks)
        if (each.motion.path != Motion::Path::Still) part.walks.push_back(std::move(each));
}

void go(Workspace& workspace, const Arguments& given) {
    if (given.has("tick") == given.has("seconds"))
        throw std::invalid_argument("give either a tick or seconds");
    const RigTake& take = rig_part(workspace).take;
    const double wanted =
        given.has("tick") ? given.integer("tick") : std::round(given.real("seconds") / tick_seconds);
    const double tick = wanted - static_cast<double>(take.began);
    const auto said = [](double ticks) { return std::to_string(static_cast<std::int64_t>(ticks)); };
    if (tick < 0.0)
        throw std::invalid_argument("the take begins at tick " + std::to_string(take.began) +
                                    ", after tick " + said(wanted));
    if (tick > max_take_ticks)
        throw std::invalid_argument("the take can be " + std::to_string(max_take_ticks) +
                                    " ticks long, which ends before tick " + said(wanted));
    const bool modified = workspace.modified();
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    go_to(part, static_cast<std::uint32_t>(tick), runtime_of(workspace));
    workspace.clock.playing = workspace.clock.replaying = false;
    workspace.ui.incident.reset();
    if (!modified) workspace.saved = workspace.document;  // time does not mark the scene as modified
}

/// What was played, or ten seconds of what would walk by itself.
std::uint32_t ticks_worth_looking_at(const RigPart& part) {
    if (part.take.last > 0) return part.take.last;
    if (part.walks.empty()) throw std::invalid_argument("nothing has been played yet: play, or say how long");
    return 600;
}

void record(Workspace& workspace, const Arguments& given) {
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart&) {
        const std::size_t frames =
            given.has("seconds") ? static_cast<std::size_t>(std::lround(given.real("seconds") / tick_seconds))
                                 : std::min<std::size_t>(ticks_worth_looking_at(part), max_clip_frames);
        RigClip clip = record_clip(part, frames, runtime_of(workspace).workspace(part.rig));
        part.clip = std::make_shared<const RigClip>(std::move(clip));
        part.clip_left.reset();
    });
}

void clear_clip(RigPart& part, const Arguments&) {
    part.clip.reset();
    part.clip_left.reset();
}

void solve_clip(RigPart& part, const Arguments&) {
    start_clip_solve(part);
}

/// What is done stays.
void cancel_clip(RigPart& part, const Arguments&) {
    if (!part.clip_left || !part.clip_left->running)
        throw std::invalid_argument("no backward solve of a clip goes on");
    ClipSolve stopped = *part.clip_left;
    stopped.running = false;
    part.clip_left = std::make_shared<const ClipSolve>(std::move(stopped));
}

void compare_rates(Workspace& workspace, const Arguments& given) {
    change_part<RigPart>(workspace, rig_lab, [&](RigPart& part, const RigPart&) {
        const double ticks = given.has("seconds") ? std::round(given.real("seconds") / tick_seconds)
                                                  : std::min(600u, ticks_worth_looking_at(part));
        start_rates(part, static_cast<std::uint32_t>(ticks));
    });
}

/// For who does not wait for ticks.
void finish_rates(Workspace& workspace) {
    RigPart& part = workspace.document.edit<RigPart>(rig_lab);
    for (RatesWork work; part.rates && part.rates->running;) work.advance(part);
}

void set_flips(RigPart& part, const Arguments& given) {
    set_flip_rule(part.flips, given);
}

void cancel_rates(RigPart& part, const Arguments&) {
    if (!part.rates || !part.rates->running) throw std::invalid_argument("no frame rates are being compared");
    part.rates.reset();
}

void add_clip_commands(CommandTable& table) {
    table.add(
        {.name = "rig.clip.record",
         .title = "Record the take as a clip",
         .arguments = {number_argument("seconds", "from the take's start; where left out, what was played",
                                       tick_seconds, max_clip)},
         .help = "Records the bones of the take as a clip, a pose a frame, 60 a second",
         .effect = Effect::Edit,
         .apply = record});
    table.add(rig_command("rig.clip.clear", "Remove the clip", {}, "Removes the clip", clear_clip));
    table.add(rig_command("rig.clip.solve", "Solve the clip backward", {},
                          "Solves the clip backward, frame by frame, and shows on the timeline what the rig "
                          "cannot express; some frames a tick",
                          solve_clip));
    table.add(rig_command("rig.clip.cancel", "Stop the backward solve", {},
                          "Stops the backward solve of the clip", cancel_clip));
}

}  // namespace

void add_time_commands(CommandTable& table) {
    table.add(rig_command(
        "rig.motion", "Move controls along a path",
        {control_argument("name", false, "of a transform or position control"),
         name_list_argument("names", "name"),
         choice_argument("path", true, "the path, flat on the ground", motion_paths.names()),
         point_argument("centre", false,
                        "within the control's space; where left out, the path starts at the control"),
         number_argument("radius", "metres", 0, static_cast<double>(max_motion_radius)),
         number_argument("period", "seconds per round", shortest_decimal(min_period),
                         shortest_decimal(max_period)),
         switch_argument("turn", "a transform control looks along the path, with its z axis")},
        "Moves controls along a path while the simulation runs", set_motions));
    table.add({.name = "rig.time",
               .title = "Show a moment of the take",
               .arguments = {number_argument("seconds", "as the clock shows them", 0, 1e9),
                             integer_argument("tick", "of 1/60 s, instead of seconds", 0, 1e9)},
               .help = "Pauses and goes to a moment of the take, earlier or later: what playing there shows, "
                       "to the bit",
               .effect = Effect::Look,
               .apply = go});
    table.add(
        {.name = "rig.rates",
         .title = "Compare frame rates",
         .arguments = {number_argument("seconds",
                                       "from the take's start; where left out, what was played, "
                                       "ten seconds at most",
                                       tick_seconds, max_rate_seconds)},
         .help = "Compares the take at 15, 30, 60, 144 Hz and at uneven frames: how far apart its bones come",
         .effect = Effect::Edit,
         .apply = compare_rates,
         .finish = finish_rates});
    table.add(rig_command("rig.rates.cancel", "Stop comparing frame rates", {},
                          "Stops the comparison of frame rates", cancel_rates));
    table.add(rig_command("rig.flips", "Set the rule for bone flips", flip_arguments(rig_flip_words),
                          "Sets what counts as a flip of a bone, from the next solve on", set_flips));
    add_clip_commands(table);
}

}  // namespace tendril::app
