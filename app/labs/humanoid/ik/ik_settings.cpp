#include "app/labs/humanoid/ik/ik_settings.hpp"

#include <algorithm>

#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/shown_pose.hpp"

namespace tendril::app {

bool IkSettings::has_targets() const {
    return std::ranges::any_of(targets, [](const auto& target) { return target.has_value(); });
}

LimitsFrom IkSettings::limits_of(humanoid::Bone bone) const {
    const auto own = joint_limits.find(bone);
    return own == joint_limits.end() ? limits : own->second;
}

const humanoid::BodyTarget* IkSettings::hand_target(std::size_t hand) const {
    const std::optional<humanoid::BodyTarget>& wanted = target(both_hands[hand]);
    return hand_ik.on && wanted ? &*wanted : nullptr;
}

std::string title(humanoid::Effector effector) {
    std::string text = humanoid::name(effector);
    std::ranges::replace(text, '_', ' ');
    return text;
}

// IK in a scene file: its settings, and its state between ticks.

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
        static_cast<void>((*held)["hands"]);  // required: not a newer member
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

// Fields and texts of the settings of ground, feet, hands and gaze.

namespace tendril {

template <>
std::span<const Field> fields<app::GroundSetting>() noexcept {
    using namespace app;
    static constexpr auto kinds = ground_kinds.name_array();
    static constexpr Field rows[] = {
        field<&GroundSetting::kind>("kind", kinds),
        field<&GroundSetting::angle_deg>("angle_deg", {-steepest_deg, steepest_deg}, "deg"),
        field<&GroundSetting::step_height>("step_height", {-highest_step, highest_step}, "m"),
        field<&GroundSetting::step_depth>("step_depth", {shortest_step, longest_step}, "m")};
    return rows;
}

template <>
std::span<const Field> fields<app::BalanceSetting>() noexcept {
    using namespace app;
    using Setting = BalanceSetting;
    static const Field rows[] = {
        field_in<&Setting::body, &humanoid::BodyOptions::balance>("on"),
        field_in<&Setting::body, &humanoid::BodyOptions::reserve>(), field<&Setting::steps>("steps"),
        field_in<&Setting::footsteps, &humanoid::FootstepOptions::seconds>("step_seconds")};
    return rows;
}

template <>
std::span<const Field> fields<app::FootIkSetting>() noexcept {
    using namespace app;
    using Setting = FootIkSetting;
    static const Field rows[] = {field<&Setting::on>("on"),
                                 field_in<&Setting::options, &humanoid::FeetOptions::enter_speed>(),
                                 field_in<&Setting::options, &humanoid::FeetOptions::leave_speed>(),
                                 field_in<&Setting::options, &humanoid::FeetOptions::max_turn>("max_angle")};
    return rows;
}

template <>
std::span<const Field> fields<app::HandCurve>() noexcept {
    using app::HandCurve;
    constexpr FieldRange times{0.0, 1e4};
    static constexpr Field rows[] = {
        field<&HandCurve::begin>("begin", times, "s"), field<&HandCurve::full>("full", times, "s"),
        field<&HandCurve::until>("until", times, "s"), field<&HandCurve::end>("end", times, "s")};
    return rows;
}

template <>
std::span<const Field> fields<app::HandIkSetting>() noexcept {
    using namespace app;
    static const Field rows[] = {field<&HandIkSetting::on>("on"),
                                 field_in<&HandIkSetting::options, &humanoid::HandsOptions::view>()};
    return rows;
}

template <>
std::span<const Field> fields<app::LookAtSetting>() noexcept {
    using namespace app;
    using Setting = LookAtSetting;
    static const Field rows[] = {field<&Setting::on>("on"), field<&Setting::placed>("placed"),
                                 field_in<&Setting::options, &humanoid::LookAtOptions::target>(),
                                 field_in<&Setting::options, &humanoid::LookAtOptions::weight>(),
                                 field_in<&Setting::options, &humanoid::LookAtOptions::view>()};
    return rows;
}

template <>
std::span<const Field> fields<app::IkSettings>() noexcept {
    using app::IkSettings;
    static constexpr auto sources = app::limits_from.name_array();
    static constexpr Field rows[] = {field<&IkSettings::limits>("limits", sources),
                                     nested<&IkSettings::foot_ik>("foot_ik"),
                                     field<&IkSettings::self_collision>("self_collision"),
                                     nested<&IkSettings::balance>("balance"),
                                     nested<&IkSettings::look_at>("look_at"),
                                     nested<&IkSettings::hold>("hold")};
    return rows;
}

template <>
std::span<const Field> fields<app::IkState>() noexcept {
    using app::IkState;
    static constexpr Field rows[] = {nested<&IkState::hold>("held"), nested<&IkState::hands>("hands"),
                                     nested<&IkState::look>("look"), nested<&IkState::steps>("steps"),
                                     nested<&IkState::body>("body")};
    return rows;
}

namespace app {
namespace {

constexpr FieldText view_text(const char* label) {
    return {.name = "view",
            .label = label,
            .help = "Half the angle of the cone in which targets are followed.",
            .step = 0.5f,
            .decimals = 0};
}

}  // namespace

template <>
std::span<const FieldText> field_texts<GroundSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "kind",
         .label = "ground",
         .help = "The ground that the character walks on.",
         .listed = true,
         .choices = ground_kinds.rows},
        {.name = "angle_deg",
         .label = "angle",
         .help = "Angle of the slope, which rises along +Z, starting at 0.",
         .step = 0.1f,
         .decimals = 1},
        {.name = "step_height",
         .label = "step height",
         .help = "How high each stair rises above the one before; negative: stairs go down.",
         .step = 0.1f,
         .decimals = 1,
         .scale = 100.0,
         .unit = "cm"},
        {.name = "step_depth",
         .label = "step depth",
         .help = "How long each stair is, along +Z.",
         .step = 0.1f,
         .decimals = 1,
         .scale = 100.0,
         .unit = "cm"}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<BalanceSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "on",
         .label = "Balance",
         .help = "Hips and trunk move so that the centre of mass stays over the feet. If that is not enough, "
                 "a foot steps while the simulation runs, or the hand stops short. Hands moved by hand IK "
                 "take no part."},
        {.name = "reserve",
         .label = "reserve",
         .help = "How far the centre of mass stays from the edge of the feet. 0: it may come to the edge. "
                 "90 %: it stays in the middle.",
         .step = 0.5f,
         .decimals = 0,
         .scale = 100.0,
         .unit = "%",
         .more = true},
        {.name = "steps",
         .label = "Steps",
         .help = "If moving the hips is not enough, a foot steps to catch the body, unless the clip lifts "
                 "the other foot.",
         .more = true},
        {.name = "step_seconds",
         .label = "step time",
         .help = "How long a foot takes to step.",
         .more = true}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<FootIkSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "on",
         .label = "Foot IK",
         .help =
             "Plants the feet and aligns them with the ground; knees bend, and the hips follow its height."},
        {.name = "enter_speed",
         .label = "plant below",
         .help = "A foot near the ground that moves slower than this is planted.",
         .more = true},
        {.name = "leave_speed",
         .label = "release above",
         .help = "A planted foot is released when the clip moves it faster than this.",
         .more = true},
        {.name = "max_angle",
         .label = "foot angle",
         .help = "The maximum angle by which the ground tilts a foot.",
         .step = 0.1f,
         .decimals = 0,
         .more = true}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<HandCurve>() {
    static constexpr FieldText texts[] = {
        {.name = "begin",
         .label = "from",
         .help = "Until this time in the clip the hand follows it.",
         .step = 0.005f},
        {.name = "full",
         .label = "full from",
         .help = "From this time on the hand is on its target.",
         .step = 0.005f},
        {.name = "until",
         .label = "full to",
         .help = "Until this time the hand is on its target; then it returns to the clip.",
         .step = 0.005f},
        {.name = "end",
         .label = "to",
         .help = "From this time on the hand follows the clip.",
         .step = 0.005f}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<HandIkSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "on",
         .label = "Hand IK",
         .help = "Hand targets move only the arm, blended from the clip to the target by a weight."},
        view_text("hand view")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<LookAtSetting>() {
    static constexpr FieldText texts[] = {
        {.name = "on", .label = "Look at", .help = "Spine, neck and head turn to look at an orange ball."},
        {.name = "weight",
         .label = "gaze weight",
         .help = "How far spine, neck and head turn to the orange ball. 0: as in the clip. 1: all the way."},
        view_text("gaze view")};
    return texts;
}

}  // namespace app
}  // namespace tendril
