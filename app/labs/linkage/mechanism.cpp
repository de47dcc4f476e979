#include "app/labs/linkage/mechanism.hpp"

#include <algorithm>

#include "app/document/names.hpp"

namespace tendril::app {
namespace {

constexpr FieldRange extent_range{1e-6, 1e6}, any_range{-1e6, 1e6};

constexpr FieldText length_text(const char* name, const char* label, const char* help, bool more = false) {
    return {.name = name, .label = label, .help = help, .step = 0.01f, .decimals = 3, .more = more};
}

}  // namespace
}  // namespace tendril::app

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::FourBar>() noexcept {
    using ik::FourBar;
    static constexpr Field rows[] = {field<&FourBar::ground>("ground", app::extent_range, "m"),
                                     field<&FourBar::crank>("crank", app::extent_range, "m"),
                                     field<&FourBar::coupler>("coupler", app::extent_range, "m"),
                                     field<&FourBar::rocker>("rocker", app::extent_range, "m"),
                                     field<&FourBar::coupler_point>("coupler_point", app::any_range, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::SliderCrank>() noexcept {
    using ik::SliderCrank;
    static constexpr Field rows[] = {field<&SliderCrank::crank>("crank", app::extent_range, "m"),
                                     field<&SliderCrank::rod>("rod", app::extent_range, "m"),
                                     field<&SliderCrank::offset>("offset", app::any_range, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Peaucellier>() noexcept {
    using ik::Peaucellier;
    static constexpr Field rows[] = {field<&Peaucellier::long_bar>("long_bar", app::extent_range, "m"),
                                     field<&Peaucellier::short_bar>("short_bar", app::extent_range, "m"),
                                     field<&Peaucellier::crank>("crank", app::extent_range, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Pantograph>() noexcept {
    using ik::Pantograph;
    static constexpr Field rows[] = {field<&Pantograph::arm>("arm", app::extent_range, "m"),
                                     field<&Pantograph::scale>("scale", {1.01, 100.0})};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::ScissorLift>() noexcept {
    using ik::ScissorLift;
    static constexpr Field rows[] = {field<&ScissorLift::stages>("stages", {1.0, 32.0}),
                                     field<&ScissorLift::bar>("bar", app::extent_range, "m"),
                                     field<&ScissorLift::angle>("angle", {0.05, 1.5}, "rad")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Jansen>() noexcept {
    using ik::Jansen;
    static constexpr Field rows[] = {
        field<&Jansen::a>("a", app::extent_range, "m"), field<&Jansen::b>("b", app::extent_range, "m"),
        field<&Jansen::c>("c", app::extent_range, "m"), field<&Jansen::d>("d", app::extent_range, "m"),
        field<&Jansen::e>("e", app::extent_range, "m"), field<&Jansen::f>("f", app::extent_range, "m"),
        field<&Jansen::g>("g", app::extent_range, "m"), field<&Jansen::h>("h", app::extent_range, "m"),
        field<&Jansen::i>("i", app::extent_range, "m"), field<&Jansen::j>("j", app::extent_range, "m"),
        field<&Jansen::k>("k", app::extent_range, "m"), field<&Jansen::l>("l", app::any_range, "m"),
        field<&Jansen::m>("m", app::extent_range, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Delta>() noexcept {
    using ik::Delta;
    static constexpr Field rows[] = {
        field<&Delta::base_radius>("base_radius", app::extent_range, "m"),
        field<&Delta::platform_radius>("platform_radius", app::extent_range, "m"),
        field<&Delta::upper_arm>("upper_arm", app::extent_range, "m"),
        field<&Delta::forearm>("forearm", app::extent_range, "m"),
        field<&Delta::width>("width", app::extent_range, "m")};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::Stewart>() noexcept {
    using ik::Stewart;
    static constexpr Field rows[] = {
        field<&Stewart::base_radius>("base_radius", app::extent_range, "m"),
        field<&Stewart::platform_radius>("platform_radius", app::extent_range, "m"),
        field<&Stewart::height>("height", app::extent_range, "m"),
        field<&Stewart::base_angle>("base_angle", {0.01, 1.0}, "rad"),
        field<&Stewart::platform_angle>("platform_angle", {0.01, 1.0}, "rad"),
        field<&Stewart::minimum>("minimum", app::extent_range, "m"),
        field<&Stewart::maximum>("maximum", app::extent_range, "m")};
    return rows;
}

namespace tendril::app {

template <>
std::span<const FieldText> field_texts<ik::FourBar>() {
    static constexpr FieldText texts[] = {
        length_text("ground", "ground", "Between the two pins."),
        length_text("crank", "crank", "The bar on the first pin, which the motor turns."),
        length_text("coupler", "coupler", "The bar between crank and rocker. It carries P."),
        length_text("rocker", "rocker", "The bar on the second pin."),
        length_text("coupler_point", "P", "Where P is on the coupler: along it from B, and to its left.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::SliderCrank>() {
    static constexpr FieldText texts[] = {
        length_text("crank", "crank", "The bar that the motor turns."),
        length_text("rod", "rod", "The bar from the crank to the slider."),
        length_text("offset", "offset", "How far the slider's line is above the crank's pin.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Peaucellier>() {
    static constexpr FieldText texts[] = {
        length_text("long_bar", "long bars", "The two from O."),
        length_text("short_bar", "short bars", "The four sides of the rhombus."),
        length_text("crank", "crank", "The bar that keeps C on a circle through O.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Pantograph>() {
    static constexpr FieldText texts[] = {
        length_text("arm", "arm", "From O to the elbow, and from there to P."),
        {.name = "scale", .label = "scale", .help = "How much larger P draws what T traces.", .decimals = 2}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::ScissorLift>() {
    static constexpr FieldText texts[] = {
        {.name = "stages", .label = "stages", .help = "Crosses on top of one another.", .step = 0.1f},
        length_text("bar", "bar", "The length of every bar."),
        {.name = "angle",
         .label = "angle",
         .help = "Of the bars from the ground, as it is made.",
         .step = 0.5f,
         .decimals = 1}};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Jansen>() {
    constexpr auto row = [](const char* name, const char* help, bool more = true) {
        return length_text(name, name, help, more);
    };
    static constexpr FieldText texts[] = {row("m", "The crank.", false),
                                          row("a", "From the crank's pin to the other, sideways."),
                                          row("l", "From the crank's pin to the other, down."),
                                          row("j", "From the crank to the upper knee."),
                                          row("b", "From the pin to the upper knee."),
                                          row("e", "From the upper knee to the back joint."),
                                          row("d", "From the pin to the back joint."),
                                          row("k", "From the crank to the lower knee."),
                                          row("c", "From the pin to the lower knee."),
                                          row("f", "From the back joint to the shin."),
                                          row("g", "From the lower knee to the shin."),
                                          row("h", "From the shin's joint to the foot."),
                                          row("i", "From the lower knee to the foot.")};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Delta>() {
    static constexpr FieldText texts[] = {
        length_text("base_radius", "base radius", "From the middle of the base to its motors."),
        length_text("platform_radius", "platform radius", "From the middle of the platform to its joints."),
        length_text("upper_arm", "upper arm", "The arm that a motor turns."),
        length_text("forearm", "forearm", "The pair of bars from each arm to the platform."),
        length_text("width", "width", "Between the two bars of a forearm.", true)};
    return texts;
}

template <>
std::span<const FieldText> field_texts<ik::Stewart>() {
    static constexpr FieldText texts[] = {
        length_text("base_radius", "base radius", "From the middle of the base to the legs' feet."),
        length_text("platform_radius", "platform radius", "From the middle of the platform to its joints."),
        length_text("height", "height", "Of the platform, as it is made."),
        length_text("minimum", "shortest leg", "No leg gets shorter than this."),
        length_text("maximum", "longest leg", "No leg gets longer than this."),
        {.name = "base_angle",
         .label = "base angle",
         .help = "Half the angle between the two feet of a pair.",
         .step = 0.2f,
         .decimals = 1,
         .more = true},
        {.name = "platform_angle",
         .label = "top angle",
         .help = "Half the angle between the two joints of a pair on the platform.",
         .step = 0.2f,
         .decimals = 1,
         .more = true}};
    return texts;
}

namespace {

template <class Of, class Table = Of>
MechanismKind kind(const char* name, const char* title, const char* help, const char* traced,
                   const char* drivers = "") {
    return {name,   title,  help, [] { return Mechanism(Of{}); }, fields<Table>(), field_texts<Table>(),
            traced, drivers};
}

}  // namespace

JansenWalker::JansenWalker() {
    for (const Field& field : fields<ik::Jansen>())
        field.set_number(static_cast<ik::Jansen*>(this), 0.01 * field.number(static_cast<ik::Jansen*>(this)));
}

const std::vector<MechanismKind>& mechanism_kinds() {
    static const std::vector<MechanismKind> list{
        kind<ik::FourBar>("four_bar", "Four-bar",
                          "A crank turns, a rocker swings, and P draws a coupler curve.", "P"),
        kind<ik::SliderCrank>("slider_crank", "Slider-crank", "A crank pushes a slider, as in an engine.",
                              "S"),
        kind<ik::Peaucellier>("peaucellier", "Peaucellier",
                              "Bars and hinges alone lead P along an exact straight line.", "P"),
        kind<ik::Pantograph>("pantograph", "Pantograph", "Drag T: P draws the same, larger.", "P"),
        kind<ik::ScissorLift>("scissor_lift", "Scissor lift",
                              "Crosses on top of one another, with one degree of freedom.", ""),
        kind<ik::Jansen>("jansen", "Jansen's leg", "A crank makes a foot walk, by eleven lengths.", "foot"),
        kind<JansenWalker, ik::Jansen>("walker", "Twelve legs",
                                       "Twelve of Jansen's legs on one crank, walking.", "foot"),
        kind<ik::Delta>("delta", "Delta robot", "Drag the platform: three motors follow.", "platform",
                        "motor_"),
        kind<ik::Stewart>("stewart", "Stewart platform", "Drag the platform: six legs follow.", "platform",
                          "leg_")};
    return list;
}

const MechanismKind& mechanism_kind(std::string_view name) {
    return named(
        mechanism_kinds(), [](const MechanismKind& each) { return each.name; }, name, "mechanism");
}

const MechanismKind* kind_of(const Mechanism& mechanism) {
    return mechanism.index() == 0 ? nullptr : &mechanism_kinds()[mechanism.index() - 1];
}

FieldsOf mechanism_fields(const Mechanism& mechanism) {
    const MechanismKind* const kind = kind_of(mechanism);
    const void* const lengths = std::visit([](const auto& each) -> const void* { return &each; }, mechanism);
    return {kind != nullptr ? kind->fields : std::span<const Field>(), lengths};
}

FieldsIn mechanism_fields(Mechanism& mechanism) {
    const MechanismKind* const kind = kind_of(mechanism);
    void* const lengths = std::visit([](auto& each) -> void* { return &each; }, mechanism);
    return {kind != nullptr ? kind->fields : std::span<const Field>(), lengths};
}

}  // namespace tendril::app
