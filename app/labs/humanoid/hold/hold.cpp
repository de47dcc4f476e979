#include "app/labs/humanoid/hold/hold.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "app/fields/field_rows.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/kit/panel_rows.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {

using humanoid::Bone;
using humanoid::Effector;

Expected<humanoid::HoldReport> solve_hold(const HumanoidPart& part, humanoid::Body& body, ShownPose& shown,
                                          std::span<const humanoid::BodyTarget> targets,
                                          const humanoid::BodyOptions& options, IkState& state) {
    const std::vector<humanoid::Grip> grips = held_grips(*part.ik.hold, body, part.loaded->height());
    return humanoid::hold(body, shown.local, targets, {grips, part.ik.hold->asked(shown.hips)}, state.body,
                          state.hold, {.body = options});
}

// The hold in words and in --state.

namespace {

/// Smaller amounts are not reported; metres and radians.
constexpr double min_reported_offset = 5e-4, min_reported_rotation = 9e-3;

/// "left upper arm"
std::string bone_words(Bone bone) {
    std::string words;
    for (const char* c = humanoid::name(bone); *c != '\0'; ++c) {
        if (*c >= 'A' && *c <= 'Z' && !words.empty()) words += ' ';
        words += *c;
    }
    return lower_case(words);
}

/// "the left arm is straight; the left shoulder and left hand are at their limits"; for hands with a grip.
std::string hold_reason_text(const humanoid::HoldReport& report) {
    std::string text;
    const auto add = [&](const std::string& reason) { text += (text.empty() ? "" : "; ") + reason; };
    if (report.grips[0].straight && report.grips[1].straight)
        add("both arms are straight");
    else
        for (std::size_t hand = 0; hand < 2; ++hand)
            if (report.grips[hand].straight) add(std::string("the ") + side_name(hand) + " arm is straight");
    std::vector<std::string> joints;
    for (std::size_t hand = 0; hand < 2; ++hand) {
        if (!report.grips[hand].holds) continue;
        const auto first = static_cast<std::size_t>(hand == 0 ? Bone::LeftShoulder : Bone::RightShoulder);
        const auto last = static_cast<std::size_t>(hand == 0 ? Bone::LeftHand : Bone::RightHand);
        for (std::size_t i = first; i <= last; ++i)
            if (report.body.at_limit[i]) joints.push_back(bone_words(static_cast<Bone>(i)));
    }
    std::string named;
    for (std::size_t i = 0; i < joints.size(); ++i)
        named += (i == 0 ? "" : i + 1 < joints.size() ? ", " : " and ") + joints[i];
    if (!joints.empty())
        add("the " + named + (joints.size() == 1 ? " is at its limit" : " are at their limits"));
    if (report.jumped) add("an arm has jumped to another pose");
    return text.empty() ? text : capitalised(text) + '.';
}

bool is_closed(const humanoid::GripReport& grip) {
    return grip.gap <= min_reported_offset && grip.off <= min_reported_rotation;
}

}  // namespace

bool gives_way(const humanoid::HoldReport& report) {
    return report.moved > min_reported_offset || report.turned > min_reported_rotation;
}

Verdict hold_verdict(const HoldSetting& setting, const humanoid::HoldReport& report) {
    const std::string name = held_kinds.title(setting.kind);
    const auto open = [&](std::size_t hand) {
        return report.grips[hand].holds && !is_closed(report.grips[hand]);
    };
    if (open(0) || open(1)) {
        const bool both = open(0) && open(1);
        const std::string hands =
            both ? "Hands" : std::string("The ") + side_name(open(0) ? 0 : 1) + " hand is";
        const double gap = std::max(report.grips[0].gap, report.grips[1].gap);
        const std::string text = gap > min_reported_offset
                                     ? hands + ' ' + rounded_length_text(gap) + " short of the " + name
                                 : both ? "Hands turned off their grips"
                                        : hands + " turned off its grip";
        return {text, Verdict::Kind::Bad, hold_reason_text(report)};
    }
    if (!gives_way(report)) return {"Holds the " + name, Verdict::Kind::Good};
    std::string by = report.moved > min_reported_offset ? rounded_length_text(report.moved) : "";
    if (report.turned > min_reported_rotation) {
        const auto degrees = static_cast<std::size_t>(std::lround(glm::degrees(report.turned)));
        by += (by.empty() ? "" : " and ") + count_text(degrees, "degree");
    }
    return {"The " + name + " gives way by " + by, Verdict::Kind::Bad, hold_reason_text(report)};
}

Json hold_state(const HumanoidPart& part, const ShownPose& shown) {
    if (!part.ik.hold) return nullptr;
    Json json = save_fields(*part.ik.hold);
    const humanoid::ObjectPose asked = part.ik.hold->asked(shown.hips);
    json["position"] = dpoint(asked.position);
    json["rotation"] = dquaternion(asked.rotation);
    if (!shown.hold) return json;
    const humanoid::HoldReport& report = *shown.hold;
    const Verdict verdict = hold_verdict(*part.ik.hold, report);
    json["held_at"] = {{"position", dpoint(report.object.position)},
                       {"rotation", dquaternion(report.object.rotation)}};
    json["moved"] = report.moved;
    json["turned_deg"] = glm::degrees(report.turned);
    json["closed"] = report.closed();
    json["jumped"] = report.jumped;
    json["text"] = verdict.text;
    json["why"] = verdict.why;
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const humanoid::GripReport& grip = report.grips[hand];
        if (grip.holds)
            json["grips"][side_name(hand)] = {
                {"gap", grip.gap}, {"off_deg", glm::degrees(grip.off)}, {"straight", grip.straight}};
    }
    return json;
}

// Commands.

namespace {

/// A pose in front of the chest, within reach of bent arms.
humanoid::ObjectPose before_chest(const IkNow& now, const HumanoidPart& part, HeldKind kind) {
    const humanoid::Facing facing = humanoid::facing(part.skeleton(), *part.map);
    const auto at = [&](Bone bone) { return now.shown.placed[*part.node_of(bone)].position; };
    const auto rest = [&](Bone bone) { return part.loaded->rest[*part.node_of(bone)]; };
    const double arm = glm::distance(rest(Bone::LeftUpperArm).position, rest(Bone::LeftLowerArm).position) +
                       glm::distance(rest(Bone::LeftLowerArm).position, rest(Bone::LeftHand).position);
    glm::dvec3 ahead = now.shown.hips.rotation * facing.forward;
    ahead.y = 0.0;
    ahead = glm::length(ahead) > 1e-6 ? glm::normalize(ahead) : facing.forward;
    const glm::dvec3 left = glm::cross(facing.up, ahead);
    // A rifle's stock is beside the chest, not inside it.
    const glm::dvec3 aside = kind == HeldKind::Rifle ? 0.09 * facing.up - 0.25 * left : glm::dvec3(0.0);
    return {0.5 * (at(Bone::LeftUpperArm) + at(Bone::RightUpperArm)) +
                arm * (0.68 * ahead - 0.32 * facing.up + aside),
            rig::normalised(glm::quat_cast(glm::dmat3(left, facing.up, ahead)))};
}

void place_as_given(const Arguments& given, humanoid::ObjectPose& asked) {
    if (given.has("to")) asked.position = exact_point(given.json("to"));
    if (given.has("rotation")) asked.rotation = rig::normalised(glm::dquat(given.rotation("rotation")));
}

void set_hold(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    require_body(now, part);
    HoldSetting setting = part.ik.hold.value_or(HoldSetting());
    const bool with_body = setting.with_body;
    humanoid::ObjectPose asked = setting.asked(now.shown.hips);
    set_fields(given, setting, "rotation");  // the rotation is in the character's space
    if (!part.ik.hold) asked = before_chest(now, part, setting.kind);
    place_as_given(given, asked);
    if (!part.ik.hold || setting.with_body != with_body || given.has("to") || given.has("rotation"))
        setting.ask(asked, now.shown.hips);
    if (held_grips(setting, *now.solvers.body(part), part.loaded->height()).empty())
        throw std::invalid_argument("the hands point up or down in the T-pose, so their palms are not known");
    for (const Effector hand : both_hands)
        if (setting.holds(hand)) {
            part.ik.target(hand).reset();
            forget_on_the_way_to(part.ik_state.release, part.skeleton(),
                                 *part.node_of(humanoid::bone_of(hand)));
        }
    part.ik.hold = setting;
    part.ik_state.hold = {};
}

void move_hold(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    if (!part.ik.hold) throw std::invalid_argument("the hands hold nothing: use humanoid.hold first");
    humanoid::ObjectPose asked = part.ik.hold->asked(now.shown.hips);
    place_as_given(given, asked);
    part.ik.hold->ask(asked, now.shown.hips);
}

void release_hold(const IkNow&, HumanoidPart& part, const Arguments&) {
    if (!part.ik.hold) throw std::invalid_argument("the hands hold nothing");
    part.ik.hold.reset();
    part.ik_state.hold = {};
}

}  // namespace

void add_hold_commands(CommandTable& table) {
    const Argument to =
        point_argument("to", false, "metres, of its middle; in front of the chest if never given");
    const Argument rotation{.name = "rotation",
                            .type = ArgumentType::Rotation,
                            .required = false,
                            .help = "of the object: X is left, Y up, Z forward"};
    std::vector<Argument> arguments = field_arguments<HoldSetting>();
    arguments.push_back(to);
    arguments.push_back(rotation);
    table.add(ik_command("humanoid.hold", "Hold an object", std::move(arguments),
                         "Puts the hands on an object; omitted settings are kept", set_hold));
    table.add(ik_command("humanoid.hold_move", "Move the held object", {to, rotation},
                         "Sets the requested pose of the held object; it yields where the arms cannot follow",
                         move_hold));
    table.add(
        ik_command("humanoid.release", "Let go of the object", {}, "Releases the object", release_hold));
}

// The held object in the picture, the mouse and the panel.

Handle hold_handle(const HoldSetting& setting, const ShownPose& shown) {
    const humanoid::ObjectPose asked = setting.asked(shown.hips);
    return {"object",
            hold_pick,
            {glm::vec3(asked.position), glm::quat(asked.rotation)},
            Drag::Position | Drag::Rotation};
}

void drag_hold(const HoldSetting& setting, const ShownPose& shown, const Handle::Frame& to, Emit& emit) {
    const Handle::Frame from = hold_handle(setting, shown).frame;
    ArgumentList arguments;
    if (to.position != from.position) arguments.push_back({"to", to.position});
    if (to.rotation != from.rotation) arguments.push_back({"rotation", to.rotation});
    if (!arguments.empty()) emit.continuously("humanoid.hold_move", arguments);
}

void draw_hold(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown) {
    if (!part.ik.hold || !shown.hold) return;
    const HoldSetting& setting = *part.ik.hold;
    const humanoid::HoldReport& report = *shown.hold;
    const auto px = [&](float pixels) { return pixels * view.scale; };
    const bool marks = view.dragged == hold_pick || view.hovered == hold_pick;
    const std::vector<HeldBar> shape = held_shape(setting, part.loaded->height());
    const auto placed = [](const humanoid::ObjectPose& at, const glm::dvec3& point) {
        return glm::vec3(at.position + at.rotation * point);
    };
    const glm::vec3 own = glm::mix(view.palette.neutral, view.palette.text, 0.35f);
    const glm::vec4 paint(marks ? glm::mix(own, view.palette.accent, 0.6f) : own, 1.0f);
    for (const HeldBar& bar : shape) {
        const auto radius = static_cast<float>(bar.radius);
        Stroke& stroke =
            list.bone(placed(report.object, bar.from), placed(report.object, bar.to), radius, radius, paint);
        stroke.pick = hold_pick;
        stroke.shadow = true;
    }
    const humanoid::ObjectPose asked = setting.asked(shown.hips);
    if (gives_way(report)) {
        for (const HeldBar& bar : shape)
            list.line(placed(asked, bar.from), placed(asked, bar.to), px(1.2f),
                      faded(view.palette, view.palette.target, 0.7f));
        list.line(glm::vec3(report.object.position), glm::vec3(asked.position), px(1.6f),
                  glm::vec4(view.palette.limit, 1.0f))
            .layer = Layer::Overlay;
    }
    if (!view.handles) return;
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const humanoid::GripReport& grip = report.grips[hand];
        if (!grip.holds) continue;
        const glm::vec3 wrist = shown.point(*part.node_of(humanoid::bone_of(both_hands[hand])));
        list.ring(wrist, px(8.0f), px(1.8f),
                  glm::vec4(is_closed(grip) ? view.palette.tail : view.palette.limit, 1.0f))
            .layer = Layer::Overlay;
    }
    Stroke& ball = list.sphere(glm::vec3(asked.position), px(marks ? 9.5f : 8.0f), Unit::Pixels,
                               glm::vec4(view.palette.target, 1.0f));
    ball.pick = hold_pick;
    ball.rank = 5;
    ball.layer = Layer::Overlay;
    if (marks)
        list.labels.push_back({.at = glm::vec3(asked.position),
                               .clearance = px(16.0f),
                               .text = held_kinds.title(setting.kind),
                               .colour = view.palette.text,
                               .rank = 3});
}

void hold_rows(const HumanoidPanel& panel) {
    const std::string& why = panel.runtime.solvers.why_no_body(panel.part);
    const auto& hold = panel.part.ik.hold;
    if (!hold) {
        if (!why.empty()) return note("Full-body IK is off: " + why + ".");
        std::vector<const char*> titles{"nothing"};
        for (const char* each : held_kinds.titles()) titles.push_back(each);
        int chosen = 0;
        if (choice_field("object", chosen, titles.data(), static_cast<int>(titles.size())) && chosen > 0)
            panel.emit("humanoid.hold", {{"kind", held_kinds.name(static_cast<HeldKind>(chosen - 1))}});
        explain("The object for both hands to hold.");
        return;
    }
    FieldRows(*hold, "humanoid.hold", panel.emit).rows("kind", "size", "hands", "with_body");
    const ShownPose& shown = panel.runtime.shown(panel.workspace);
    std::string message = why.empty() ? shown.refused : "Full-body IK is off: " + why + ".";
    if (shown.hold) {
        const Verdict verdict = hold_verdict(*hold, *shown.hold);
        message = verdict.text + ". " + verdict.why;
    }
    kept_note("held", message, 3);
    if (row_button("Let go", 1, true, "Releases the object")) panel.emit("humanoid.release");
    end_row();
}

}  // namespace tendril::app
