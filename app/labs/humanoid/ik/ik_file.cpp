#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"

namespace tendril::app {

// IK in a scene file: its settings, and what it remembers between ticks.

namespace {

Json targets_json(const IkSettings& ik) {
    Json targets = Json::object();
    for (const humanoid::Effector effector : all_effectors) {
        const auto& target = ik.target(effector);
        if (target) targets[humanoid::name(effector)] = save_fields(*target);
    }
    return targets;
}

void read_targets(const JsonPlace& place, IkSettings& ik) {
    if (!place.json().is_object()) place.fail("expected an object of effectors");
    for (const auto& [name, value] : place.json().items()) {
        const auto effector = humanoid::effector_named(name);
        if (!effector) place.fail("there is no effector \"" + name + "\"");
        constexpr std::string_view newer[] = {"rotation", "weight"};
        load_all_fields(place[name.c_str()], ik.target(*effector).emplace(), newer);
        ik.target(*effector)->effector = *effector;
    }
}

Json release_json(const Release& release, const humanoid::Skeleton& skeleton) {
    Json turns = Json::object();
    for (const auto& [node, turn] : release.turns) turns[skeleton[node].name] = dquaternion(turn);
    return Json{{"left", release.left}, {"shift", dpoint(release.shift)}, {"turns", std::move(turns)}};
}

Release read_release(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    Release release{.left = place["left"].real(0.0, release_seconds), .shift = place["shift"].dpoint()};
    const JsonPlace turns = place["turns"];
    if (!turns.json().is_object()) turns.fail("expected an object of nodes");
    for (const auto& [name, value] : turns.json().items()) {
        const auto node = skeleton.find(name);
        if (!node) turns.fail("there is no node \"" + name + "\"");
        release.turns[*node] = turns[name.c_str()].drotation();
    }
    return release;
}

Json ground_json(const GroundSetting& ground) {
    Json json = save_fields(ground);
    if (ground.mesh) json.update(save_outside_file(*ground.mesh));
    return json;
}

void read_ground(const JsonPlace& place, GroundSetting& ground) {
    load_fields(place, ground);
    if (place.has("path")) ground.mesh = read_outside_file(place, read_ground_mesh);
    if (ground.kind == humanoid::GroundKind::Mesh && !ground.mesh) place.fail("a mesh needs its path");
}

void read_foot_ik(const JsonPlace& place, FootIkSetting& setting) {
    load_fields(place, setting);
    if (const Result bad = check(setting.options); !bad) place.fail(bad.message());
}

Json hand_ik_json(const HandIkSetting& setting) {
    Json json = save_fields(setting);
    for (std::size_t hand = 0; hand < 2; ++hand)
        if (const auto& curve = setting.curves[hand])
            for (const Field& time : fields<HandCurve>())
                json[humanoid::name(both_hands[hand])].push_back(time.number(&*curve));
    return json;
}

void read_hand_ik(const JsonPlace& place, HandIkSetting& setting) {
    load_fields(place, setting);
    for (std::size_t hand = 0; hand < 2; ++hand) {
        const auto times = place.optional(humanoid::name(both_hands[hand]));
        if (!times) continue;
        times->check_size(4, "times in ascending order");
        double before = 0.0;
        for (const Field& time : fields<HandCurve>()) {
            const auto i = static_cast<std::size_t>(&time - fields<HandCurve>().data());
            before = times->element(i).real(before, time.range.high);
            time.set_number(i == 0 ? &setting.curves[hand].emplace() : &*setting.curves[hand], before);
        }
    }
}

Json joint_limits_json(const IkSettings& ik) {
    Json json = Json::object();
    for (const auto& [bone, from] : ik.joint_limits) json[humanoid::name(bone)] = limits_from.name(from);
    return json;
}

void read_joint_limits(const JsonPlace& place, IkSettings& ik) {
    if (!place.json().is_object()) place.fail("expected an object of bones");
    for (const auto& [name, value] : place.json().items()) {
        const auto bone = humanoid::bone_named(name);
        if (!bone) place.fail("there is no bone \"" + name + "\"");
        ik.joint_limits[*bone] = place[name.c_str()].choice(limits_from);
    }
}

}  // namespace

Json ik_json(const HumanoidPart& part) {
    Json json{{"targets", targets_json(part.ik)}, {"limits", limits_from.name(part.ik.limits)}};
    if (!part.ik.joint_limits.empty()) json["joint_limits"] = joint_limits_json(part.ik);
    json["ground"] = ground_json(part.ik.ground);
    json["foot_ik"] = save_fields(part.ik.foot_ik);
    json["self_collision"] = part.ik.self_collision;
    json["balance"] = save_fields(part.ik.balance);
    json["hand_ik"] = hand_ik_json(part.ik.hand_ik);
    json["look_at"] = save_fields(part.ik.look_at);
    if (part.ik.hold) json["hold"] = save_fields(*part.ik.hold);
    if (part.ik_state.hold != humanoid::HoldState()) json["held"] = save_fields(part.ik_state.hold);
    if (!(part.ik_state.hands == humanoid::HandsState())) json["hands"] = save_fields(part.ik_state.hands);
    if (!(part.ik_state.look == humanoid::LookAtState())) json["look"] = save_fields(part.ik_state.look);
    if (part.ik_state.steps.away()) json["steps"] = save_fields(part.ik_state.steps);
    if (!(part.ik_state.release == Release()))
        json["release"] = release_json(part.ik_state.release, part.skeleton());
    if (!(part.ik_state.body == humanoid::BodyState())) json["body"] = save_fields(part.ik_state.body);
    return json;
}

void read_ik(const JsonPlace& place, HumanoidPart& part) {
    if (!place.json().is_object()) place.fail("expected an object, found " + json_summary(place.json()));
    if (const auto targets = place.optional("targets")) read_targets(*targets, part.ik);
    if (const auto limits = place.optional("limits")) part.ik.limits = limits->choice(limits_from);
    if (const auto joints = place.optional("joint_limits")) read_joint_limits(*joints, part.ik);
    if (const auto ground = place.optional("ground")) read_ground(*ground, part.ik.ground);
    if (const auto foot_ik = place.optional("foot_ik")) read_foot_ik(*foot_ik, part.ik.foot_ik);
    if (const auto on = place.optional("self_collision")) part.ik.self_collision = on->flag();
    if (const auto balance = place.optional("balance")) load_fields(*balance, part.ik.balance);
    if (const auto hand_ik = place.optional("hand_ik")) read_hand_ik(*hand_ik, part.ik.hand_ik);
    if (const auto look_at = place.optional("look_at")) load_fields(*look_at, part.ik.look_at);
    if (const auto hold = place.optional("hold")) {
        load_fields(*hold, part.ik.hold.emplace());
        for (const humanoid::Effector hand : both_hands)
            if (part.ik.hold->holds(hand) && part.ik.target(hand))
                place["targets"][humanoid::name(hand)].fail("this hand holds the object: remove its target");
        if (const auto held = place.optional("held")) load_all_fields(*held, part.ik_state.hold);
    }
    if (const auto hands = place.optional("hands")) load_all_fields(*hands, part.ik_state.hands);
    if (const auto look = place.optional("look")) load_all_fields(*look, part.ik_state.look);
    if (const auto steps = place.optional("steps")) load_all_fields(*steps, part.ik_state.steps);
    if (const auto release = place.optional("release"))
        part.ik_state.release = read_release(*release, part.skeleton());
    constexpr std::string_view newer[] = {"weights", "outside"};
    if (const auto body = place.optional("body")) load_all_fields(*body, part.ik_state.body, newer);
}

}  // namespace tendril::app
