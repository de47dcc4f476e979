#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
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
        load_known_fields(place[name.c_str()],
                          {{ik.target(*effector).emplace(), MissingField::Refused, {"rotation", "weight"}}});
        ik.target(*effector)->effector = *effector;
    }
}

Json release_json(const Release& release, const humanoid::Skeleton& skeleton) {
    Json turns = Json::object();
    for (const auto& [node, turn] : release.turns) turns[skeleton[node].name] = dquaternion(turn);
    return Json{{"left", release.left}, {"shift", dpoint(release.shift)}, {"turns", std::move(turns)}};
}

Release read_release(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    check_members(place, {"left", "shift", "turns"});
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
    load_known_fields(place, ground, {"file", "path", "crc32"});
    if (place.has("path")) ground.mesh = read_outside_file(place, read_ground_mesh);
    if (ground.kind == humanoid::GroundKind::Mesh && !ground.mesh) place.fail("a mesh needs its path");
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
    load_known_fields(place, setting, {"left_hand", "right_hand"});
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
    Json json{{"targets", targets_json(part.ik)}};
    json.update(save_fields(part.ik));
    if (!part.ik.hold) json.erase("hold");
    if (!part.ik.joint_limits.empty()) json["joint_limits"] = joint_limits_json(part.ik);
    json["ground"] = ground_json(part.ik.ground);
    json["hand_ik"] = hand_ik_json(part.ik.hand_ik);
    json.update(save_sparse_fields(part.ik_state));
    if (!(part.ik_state.release == Release()))
        json["release"] = release_json(part.ik_state.release, part.skeleton());
    return json;
}

void read_ik(const JsonPlace& place, HumanoidPart& part) {
    IkSettings& ik = part.ik;
    load_known_fields(
        place,
        {{ik},
         {part.ik_state,
          MissingField::Refused,
          {"held", "hands", "look", "steps", "body", "weights", "outside"}}},
        {"targets", "joint_limits", "ground", "hand_ik", "release", "feet"});  // older files: "feet"
    if (const auto held = place.optional("held"))
        static_cast<void>((*held)["hands"]);  // of its own, not newer
    if (const Result bad = check(ik.foot_ik.options); !bad) place["foot_ik"].fail(bad.message());
    if (const auto targets = place.optional("targets")) read_targets(*targets, ik);
    if (const auto joints = place.optional("joint_limits")) read_joint_limits(*joints, ik);
    if (const auto ground = place.optional("ground")) read_ground(*ground, ik.ground);
    if (const auto hand_ik = place.optional("hand_ik")) read_hand_ik(*hand_ik, ik.hand_ik);
    if (!ik.hold) part.ik_state.hold = {};
    for (const humanoid::Effector hand : both_hands)
        if (ik.hold && ik.hold->holds(hand) && ik.target(hand))
            place["targets"][humanoid::name(hand)].fail("this hand holds the object: remove its target");
    if (const auto release = place.optional("release"))
        part.ik_state.release = read_release(*release, part.skeleton());
}

}  // namespace tendril::app
