#include "app/labs/humanoid/ik/ik_settings.hpp"

#include <algorithm>

#include "app/fields/field_in.hpp"

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
         .help = "What the character walks on.",
         .listed = true,
         .choices = ground_kinds.rows},
        {.name = "angle_deg",
         .label = "angle",
         .help = "Of the slope, which rises along +Z, starting at 0.",
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
         .help =
             "Hips and trunk move so that the centre of mass stays over the feet. Where that is not "
             "enough a foot steps, while the simulation runs, or the hand stops short. Hands that hand IK "
             "moves take no part."},
        {.name = "reserve",
         .label = "reserve",
         .help = "How far the centre of mass keeps from the edge of the feet. 0: it may come to the edge. "
                 "90 %: it stays in the middle.",
         .step = 0.5f,
         .decimals = 0,
         .scale = 100.0,
         .unit = "%",
         .more = true},
        {.name = "steps",
         .label = "Steps",
         .help =
             "A foot steps to where it catches the body when moving the hips is not enough, unless the clip "
             "lifts the other one.",
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
         .label = "let go above",
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
         .help = "Until then, in the clip, the hand follows it.",
         .step = 0.005f},
        {.name = "full",
         .label = "full from",
         .help = "From then on the hand is on its target.",
         .step = 0.005f},
        {.name = "until",
         .label = "full to",
         .help = "Until then the hand is on its target; afterwards it goes back to the clip.",
         .step = 0.005f},
        {.name = "end", .label = "to", .help = "From then on the hand follows the clip.", .step = 0.005f}};
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
