#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/kit/arguments.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

/// Starts the release if an effector lost its target or grip and has neither now. `settings` and `pose` are
/// those before the change. Toggling hand IK takes effect at once: its curves and view cone already ease.
void let_go(Workspace& workspace, const IkSettings& settings, const std::vector<rig::Transform>& pose) {
    const HumanoidPart& part = humanoid_part(workspace);
    const auto free = [](const IkSettings& ik, humanoid::Effector each) {
        return !ik.target(each) && !(ik.hold && ik.hold->holds(each));
    };
    const bool loses = std::ranges::any_of(
        all_effectors, [&](humanoid::Effector each) { return !free(settings, each) && free(part.ik, each); });
    const bool plays = workspace.clock.playing && goes_on(part.playback, *part.loaded);
    if (!loses || !(plays || part.ik.hold || part.ik.has_targets())) return;
    const auto set = [&](Release release) {
        workspace.document.edit<HumanoidPart>(humanoid_lab).ik_state.release = std::move(release);
    };
    set({.left = release_seconds});
    if (!plays) return;
    Release release = release_between(pose, shown_pose(workspace).before_springs,
                                      humanoid_part(workspace).node_of(humanoid::Bone::Hips));
    // The other hand may have taken the object in the same change: it is on its grip at once.
    const HumanoidPart& now = humanoid_part(workspace);
    for (const humanoid::Effector hand : both_hands)
        if (holds(now, hand) && !(settings.hold && settings.hold->holds(hand)))
            forget_on_the_way_to(release, now.skeleton(), *now.node_of(humanoid::bone_of(hand)));
    set(std::move(release));
}

}  // namespace

Command ik_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                   void (*change)(const IkNow&, HumanoidPart&, const Arguments&)) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = Effect::Edit,
            .apply = [change](Workspace& workspace, const Arguments& given) {
                const IkNow now{shown_pose(workspace), humanoid_runtime(workspace).solvers};
                const IkSettings settings = humanoid_part(workspace).ik;
                const std::vector<rig::Transform> pose = now.shown.before_springs;
                change_part<HumanoidPart>(workspace, humanoid_lab,
                                          [&](HumanoidPart& part, const HumanoidPart& old) {
                                              change(now, part, given);
                                              if (!(part == old)) part.quiet_ticks = 0;
                                          });
                solve_now(workspace);
                let_go(workspace, settings, pose);
            }};
}

glm::dvec3 exact_point(const Json& json) {
    return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

void require_body(const IkNow& now, const HumanoidPart& part) {
    const std::string& why = now.solvers.why_no_body(part);
    if (!why.empty()) throw std::invalid_argument("full-body IK is off: " + why);
}

// Commands on targets, limits, ground and feet.

namespace {

using humanoid::Effector;

/// The effectors given by "effector" or "effectors". Refuses duplicates.
std::vector<Effector> effectors_named(const Arguments& given) {
    if (gives_one(given, "effector", "effectors")) return {*humanoid::effector_named(given.text("effector"))};
    std::vector<Effector> effectors;
    for (const std::string& name : name_list(given, "effectors")) {
        const auto effector = humanoid::effector_named(name);
        if (!effector) throw Refused("effectors: there is no effector " + json_summary(name));
        if (std::find(effectors.begin(), effectors.end(), *effector) != effectors.end())
            throw Refused("effectors: " + json_summary(name) + " is listed twice");
        effectors.push_back(*effector);
    }
    if (effectors.empty()) throw Refused("effectors: [] is empty");
    return effectors;
}

/// The effector's target; creates one at its current position if needed.
humanoid::BodyTarget& target_begun(const IkNow& now, HumanoidPart& part, Effector effector) {
    std::optional<humanoid::BodyTarget>& target = part.ik.target(effector);
    if (holds(part, effector))
        throw std::invalid_argument(std::string(humanoid::name(effector)) + " holds the " +
                                    held_kinds.title(part.ik.hold->kind) + ": move that, or release it");
    if (!target) {
        const std::size_t node = *part.node_of(humanoid::bone_of(effector));
        target = humanoid::BodyTarget{.effector = effector, .position = now.shown.placed[node].position};
        forget_on_the_way_to(part.ik_state.release, part.skeleton(), node);
    }
    return *target;
}

void set_targets(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    const std::vector<Effector> effectors = effectors_named(given);
    std::optional<JsonPlace> points, rotations;
    if (given.has("points")) points = each_list(given, "points", "effectors", effectors.size());
    if (given.has("rotations")) rotations = each_list(given, "rotations", "effectors", effectors.size());
    if (given.has("to") && given.has("effectors"))
        throw Refused("to is for one effector; points has one for each of effectors");
    if (given.has("rotation") && rotations) throw Refused("needs either rotation or rotations");
    const bool lets_go = given.has("weight") && given.real("weight") <= 0.0;
    if (!lets_go) require_body(now, part);
    for (std::size_t i = 0; i < effectors.size(); ++i) {
        if (lets_go) {
            part.ik.target(effectors[i]).reset();
            continue;
        }
        humanoid::BodyTarget& target = target_begun(now, part, effectors[i]);
        if (given.has("to")) target.position = exact_point(given.json("to"));
        if (points) target.position = points->element(i).dpoint();
        if (given.has("rotation")) target.rotation = glm::dquat(given.rotation("rotation"));
        if (rotations) target.rotation = glm::dquat(rotations->element(i).rotation());
        if (given.has("weight")) target.weight = given.real("weight");
    }
}

/// The joints given by "bone" or "bones".
std::vector<std::string> joints_named(const Arguments& given) {
    if (gives_one(given, "bone", "bones")) return {given.text("bone")};
    std::vector<std::string> joints = name_list(given, "bones");
    if (joints.empty()) throw Refused("bones is empty");
    return joints;
}

void set_joint_limits(const IkNow& now, HumanoidPart& part, const std::string& name, LimitsFrom from) {
    const auto bone = humanoid::bone_named(name);
    if (!bone) throw std::invalid_argument("there is no bone \"" + name + "\"");
    const LimitRanges& ranges = now.solvers.limits(part);
    if (!part.node_of(*bone)) throw std::invalid_argument("the character has no " + name);
    if (ranges.adult(*bone) == nullptr) throw std::invalid_argument("the " + name + " joint has no limits");
    if (from == LimitsFrom::Motion && ranges.clips(*bone) == nullptr)
        throw std::invalid_argument("no clip turns the " + name + " joint");
    part.ik.joint_limits.erase(*bone);
    if (from != part.ik.limits) part.ik.joint_limits[*bone] = from;
}

void set_limits(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    const LimitsFrom from = limits_from.value(given.text("from"));
    if (from == LimitsFrom::Motion && part.loaded->clips().empty())
        throw std::invalid_argument("the character has no clips to learn limits from");
    part.ik_state.body = {};  // the body only moves as far as its targets, so new limits need a fresh start
    if (!given.has("bone") && !given.has("bones")) {
        part.ik.limits = from;
        part.ik.joint_limits.clear();
        return;
    }
    for (const std::string& name : joints_named(given)) set_joint_limits(now, part, name, from);
}

void set_ground(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    GroundSetting& ground = part.ik.ground;
    const humanoid::GroundKind before = ground.kind;
    set_fields(given, ground);
    if (given.has("path")) {
        ground.mesh = read_ground_mesh(given.text("path"));
        if (!given.has("kind")) ground.kind = humanoid::GroundKind::Mesh;
    }
    if (ground.kind == humanoid::GroundKind::Mesh && !ground.mesh)
        throw std::invalid_argument("path is missing: the file with the mesh");
    make_ground(ground);
    // Rising ground would bury a character that has walked far or has no foot IK.
    const bool level = ground.kind == humanoid::GroundKind::None || ground.kind == humanoid::GroundKind::Flat;
    if (ground.kind == before || level) return;
    const Playback playback = part.playback;
    part.playback.rounds = 0;
    carry_targets(part, playback);
    if (now.solvers.feet(part) != nullptr) part.ik.foot_ik.on = true;
}

/// Turns the camera to the side: ground that rises ahead of the character would hide it from the front.
void look_from_aside(Workspace& workspace) {
    if (workspace.lab == humanoid_lab && math::cosine(workspace.camera.yaw) > 0.5f)
        workspace.camera.yaw = glm::radians(62.0f);
}

void set_foot_ik(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    FootIkSetting& setting = part.ik.foot_ik;
    set_fields(given, setting);
    // If only one of the two speeds is given, the other follows.
    auto &enter = setting.options.enter_speed, &leave = setting.options.leave_speed;
    if (!given.has("leave_speed")) leave = std::max(leave, enter);
    if (!given.has("enter_speed")) enter = std::min(leave, enter);
    if (const Result bad = check(setting.options); !bad) throw std::invalid_argument(bad.message());
    if (setting.on && now.solvers.feet(part) == nullptr)
        throw std::invalid_argument("foot IK is not possible: " + now.solvers.why_no_feet(part));
}

std::vector<std::string> effector_names() {
    return names(all_effectors, [](Effector each) { return humanoid::name(each); });
}

}  // namespace

void add_ik_commands(CommandTable& table) {
    const FieldRange weights = field_of<&humanoid::BodyTarget::weight>().range;
    table.add(ik_command(
        "humanoid.target", "Set an effector's target",
        {choice_argument("effector", false, "which", effector_names()),
         name_list_argument("effectors", "effector"),
         point_argument("to", false, "metres; if omitted, where the effector is"),
         each_argument("points", "effectors"),
         {.name = "rotation",
          .type = ArgumentType::Rotation,
          .required = false,
          .help = "of the bone; free if never given"},
         each_argument("rotations", "effectors"),
         number_argument("weight", "relative to other targets; 0 removes it", weights.low, weights.high)},
        "Gives effectors targets, or removes them", set_targets));
    std::vector<Argument> ground_arguments = field_arguments<GroundSetting>();
    ground_arguments.push_back(text_argument("path", false, "of the mesh: a .gltf or .glb file"));
    Command ground = ik_command("humanoid.ground", "Choose the ground", std::move(ground_arguments),
                                "Sets the ground; omitted settings are kept. Slopes, stairs, terrain and "
                                "meshes turn foot IK on and restart the walk",
                                set_ground);
    ground.apply = [set = ground.apply](Workspace& workspace, const Arguments& given) {
        const glm::vec3 before = followed_at(workspace);
        set(workspace, given);
        workspace.camera.target += followed_at(workspace) - before;
        using humanoid::GroundKind;
        const GroundKind kind = humanoid_part(workspace).ik.ground.kind;
        if (given.has("kind") && (kind == GroundKind::Slope || kind == GroundKind::Stairs))
            look_from_aside(workspace);
    };
    table.add(std::move(ground));
    table.add(ik_command("humanoid.foot_ik", "Set foot IK", field_arguments<FootIkSetting>(),
                         "Brings the feet to the ground; omitted settings are kept", set_foot_ik));
    add_hand_commands(table);
    add_hold_commands(table);
    table.add(
        ik_command("humanoid.limits", "Choose where joint limits come from",
                   {choice_argument("from", true, "which", limits_from.names()),
                    choice_argument("bone", false, "of that joint alone; of all joints if both are omitted",
                                    bone_names()),
                    name_list_argument("bones", "bone")},
                   "Sets where the limits of the joints come from", set_limits));
}

// Commands on hand IK, self-collision, balance and look-at.

namespace {

/// The default curve, made for a punch of 1.2 s, stretched to the clip's length.
HandCurve curve_over(const humanoid::Clip* clip) {
    if (clip == nullptr) return {};
    const HandCurve usual;
    // In whole hundredths, as in the panel.
    const auto at = [&](double time) { return std::round(100.0 * time / 1.2 * clip->duration) / 100.0; };
    return {at(usual.begin), at(usual.full), at(usual.until), at(usual.end)};
}

/// Times that are not given move along, so the four may be typed in any order.
HandCurve with_times(HandCurve curve, const Arguments& given) {
    set_fields(given, curve);
    for (const Field& time : fields<HandCurve>())
        for (const Field& other : fields<HandCurve>()) {
            if (!given.has(time.name) || given.has(other.name)) continue;
            const double set = time.number(&curve), moves = other.number(&curve);
            other.set_number(&curve, &other < &time ? std::min(moves, set) : std::max(moves, set));
        }
    if (curve.begin > curve.full || curve.full > curve.until || curve.until > curve.end)
        throw std::invalid_argument(
            "from (begin), full from (full), full to (until) and to (end) must be in ascending order");
    return curve;
}

/// Sets the curve of a hand.
void set_curve(HumanoidPart& part, std::size_t hand, const Arguments& given) {
    std::optional<HandCurve>& curve = part.ik.hand_ik.curves[hand];
    if (given.has("curve") && !given.boolean("curve")) {
        curve.reset();
        return;
    }
    const bool times =
        std::ranges::any_of(fields<HandCurve>(), [&](const Field& each) { return given.has(each.name); });
    if (times || given.has("curve")) curve = with_times(curve.value_or(curve_over(part.clip())), given);
}

void set_hand_ik(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    HandIkSetting& setting = part.ik.hand_ik;
    set_fields(given, setting);
    if (setting.on) require_body(now, part);
    const std::string hand = given.has("hand") ? given.text("hand") : "both";
    if (hand != "right") set_curve(part, 0, given);
    if (hand != "left") set_curve(part, 1, given);
}

/// A position in front of the head, for a look-at without one.
glm::dvec3 ahead_of_head(const IkNow& now, const HumanoidPart& part) {
    const glm::dvec3 forward = humanoid::facing(part.skeleton(), *part.map).forward;
    const std::size_t head = *part.node_of(humanoid::Bone::Head);
    const std::size_t hips = *part.node_of(humanoid::Bone::Hips);
    const auto& rest = part.loaded->rest;
    return now.shown.placed[head].position +
           2.5 * glm::distance(rest[head].position, rest[hips].position) * forward;
}

void set_look_at(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    LookAtSetting& setting = part.ik.look_at;
    set_fields(given, setting);
    if (setting.on) require_body(now, part);
    if (setting.on && !setting.placed) {
        setting.options.target = ahead_of_head(now, part);
        setting.placed = true;
    }
    if (given.has("to")) {
        setting.options.target = exact_point(given.json("to"));
        setting.placed = true;
    }
}

void set_self_collision(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    const bool on = given.boolean("on");
    if (on) require_body(now, part);
    part.ik.self_collision = on;
    part.ik_state.body = {};
}

void set_balance(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    set_fields(given, part.ik.balance);
    const bool on = part.ik.balance.body.balance;
    if (on) require_body(now, part);
    if (on && now.solvers.masses(part) == nullptr)
        throw std::invalid_argument("balance is not possible: " + now.solvers.why_no_feet(part));
    part.ik_state.body = {};  // the body only moves as far as its targets
}

}  // namespace

void add_hand_commands(CommandTable& table) {
    std::vector<Argument> hands = field_arguments<HandIkSetting>();
    hands.push_back(
        choice_argument("hand", false, "which hand's curve; both if omitted", {"left", "right", "both"}));
    hands.push_back(switch_argument("curve", "the weight follows the clip's time"));
    for (Argument& each : field_arguments<HandCurve>()) hands.push_back(std::move(each));
    table.add(ik_command("humanoid.hand_ik", "Set hand IK", std::move(hands),
                         "Blends the hands from the clip to their targets; omitted settings are kept",
                         set_hand_ik));
    table.add(ik_command("humanoid.self_collision", "Keep hands out of the body",
                         {{.name = "on", .type = ArgumentType::Boolean, .help = "false: turns it off"}},
                         "Keeps hands and lower arms out of the body while it reaches", set_self_collision));
    table.add(
        ik_command("humanoid.balance", "Keep the body's balance", field_arguments<BalanceSetting>(),
                   "Keeps the centre of mass over the feet while the body reaches; omitted settings are kept",
                   set_balance));
    std::vector<Argument> gaze = field_arguments<LookAtSetting>();
    gaze.push_back(point_argument("to", false, "metres; ahead of the head if never given"));
    table.add(ik_command("humanoid.look_at", "Look at a point", std::move(gaze),
                         "Turns spine, neck and head to look at a point; omitted settings are kept",
                         set_look_at));
}

}  // namespace tendril::app
