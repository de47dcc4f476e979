// Hand IK, self-collision and look-at.
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/labs/humanoid/ik/ik_command.hpp"
#include "app/labs/kit/arguments.hpp"

namespace tendril::app {
namespace {

/// The curve of one hand, or of both.
void set_curve(HandIkSetting& setting, std::size_t hand, const Arguments& given) {
    std::optional<HandCurve>& curve = setting.curves[hand];
    if (given.has("curve") && !given.boolean("curve")) {
        curve.reset();
        return;
    }
    const bool times = given.has("begin") || given.has("full") || given.has("until") || given.has("end");
    if (!times && !given.has("curve")) return;
    HandCurve set = curve.value_or(HandCurve());
    if (given.has("begin")) set.begin = given.real("begin");
    if (given.has("full")) set.full = given.real("full");
    if (given.has("until")) set.until = given.real("until");
    if (given.has("end")) set.end = given.real("end");
    if (!(set.begin <= set.full && set.full <= set.until && set.until <= set.end))
        throw std::invalid_argument("begin, full, until and end must follow one another");
    curve = set;
}

void set_hand_ik(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    HandIkSetting& setting = part.ik.hand_ik;
    set_fields(given, setting);
    if (setting.on) require_body(now, part);
    const std::string hand = given.has("hand") ? given.text("hand") : "both";
    if (hand != "right") set_curve(setting, 0, given);
    if (hand != "left") set_curve(setting, 1, given);
}

/// Ahead of the head, where nothing was looked at yet.
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
        setting.target = ahead_of_head(now, part);
        setting.placed = true;
    }
    if (given.has("to")) {
        setting.target = exact_point(given.json("to"));
        setting.placed = true;
    }
}

void set_self_collision(const IkNow& now, HumanoidPart& part, const Arguments& given) {
    const bool on = given.boolean("on");
    if (on) require_body(now, part);
    part.ik.self_collision = on;
    part.ik_state.body = {};
}

}  // namespace

void add_hand_commands(CommandTable& table) {
    const auto seconds = [](const char* name, const char* help) {
        return number_argument(name, help, 0.0, max_curve);
    };
    std::vector<Argument> hands = field_arguments<HandIkSetting>();
    for (Argument& each : std::vector<Argument>{
             choice_argument("hand", false, "whose curve; both when left out", {"left", "right", "both"}),
             switch_argument("curve", "the weight follows the clip's time"),
             seconds("begin", "of the clip: 0 until then"), seconds("full", "1 from then"),
             seconds("until", "1 until then"), seconds("end", "0 from then")})
        hands.push_back(std::move(each));
    table.add(ik_command("humanoid.hand_ik", "Set hand IK", std::move(hands),
                         "Blends the hands from the clip to their targets; what is left out stays",
                         set_hand_ik));
    table.add(ik_command("humanoid.self_collision", "Keep hands out of the body",
                         {{.name = "on", .type = ArgumentType::Boolean, .help = "or off"}},
                         "Keeps hands and lower arms out of the body while it reaches", set_self_collision));
    std::vector<Argument> gaze = field_arguments<LookAtSetting>();
    gaze.push_back(point_argument("to", false, "metres; ahead of the head when it was never given"));
    table.add(ik_command("humanoid.look_at", "Look at a point", std::move(gaze),
                         "Turns spine, neck and head to look at a point; what is left out stays",
                         set_look_at));
}

}  // namespace tendril::app
