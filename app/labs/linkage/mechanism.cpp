#include "app/labs/linkage/linkage_part.hpp"

#include <algorithm>

#include "app/document/names.hpp"

namespace tendril::app {
namespace {

constexpr FieldText length_row(const char* name, const char* label, const char* help, bool more = false) {
    return {
        .name = name, .label = label, .help = help, .decimals = 3, .ends = {"along", "beside"}, .more = more};
}
constexpr FieldText jansen_row(const char* name, const char* help) {
    return length_row(name, name, help, true);
}
constexpr FieldText half_angle(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .step = 0.2f, .decimals = 1, .more = true};
}

/// In the order of rows in the panel.
using Texts = std::vector<FieldText>;

template <class Of, class Table = Of>
MechanismKind kind(const char* name, const char* title, const char* help, const char* traced, Texts texts,
                   const char* drivers = "") {
    return {name,   title,  help, [] { return Mechanism(Of{}); }, fields<Table>(), std::move(texts),
            traced, drivers};
}

Texts jansen_texts() {
    return {length_row("m", "m", "The crank."),
            jansen_row("a", "From the crank's pin to the other, sideways."),
            jansen_row("l", "From the crank's pin to the other, down."),
            jansen_row("j", "From the crank to the upper knee."),
            jansen_row("b", "From the pin to the upper knee."),
            jansen_row("e", "From the upper knee to the back joint."),
            jansen_row("d", "From the pin to the back joint."),
            jansen_row("k", "From the crank to the lower knee."),
            jansen_row("c", "From the pin to the lower knee."),
            jansen_row("f", "From the back joint to the shin."),
            jansen_row("g", "From the lower knee to the shin."),
            jansen_row("h", "From the shin's joint to the foot."),
            jansen_row("i", "From the lower knee to the foot.")};
}

}  // namespace

JansenWalker::JansenWalker() {
    for (const Field& field : fields<ik::Jansen>())
        field.set_number(static_cast<ik::Jansen*>(this), 0.01 * field.number(static_cast<ik::Jansen*>(this)));
}

const std::vector<MechanismKind>& mechanism_kinds() {
    static const std::vector<MechanismKind> list{
        kind<ik::FourBar>(
            "four_bar", "Four-bar", "A crank turns, a rocker swings, and P draws a coupler curve.", "P",
            {length_row("ground", "ground", "Between the two pins."),
             length_row("crank", "crank", "The bar on the first pin, which the motor turns."),
             length_row("coupler", "coupler", "The bar between crank and rocker. It carries P."),
             length_row("rocker", "rocker", "The bar on the second pin."),
             length_row("coupler_point", "P",
                        "Where P is on the coupler: along it from B, and to its left.")}),
        kind<ik::SliderCrank>(
            "slider_crank", "Slider-crank", "A crank pushes a slider, as in an engine.", "S",
            {length_row("crank", "crank", "The bar that the motor turns."),
             length_row("rod", "rod", "The bar from the crank to the slider."),
             length_row("offset", "offset", "How far the slider's line is above the crank's pin.")}),
        kind<ik::Peaucellier>("peaucellier", "Peaucellier",
                              "Bars and hinges alone lead P along an exact straight line.", "P",
                              {length_row("long_bar", "long bars", "The two from O."),
                               length_row("short_bar", "short bars", "The four sides of the rhombus."),
                               length_row("crank", "crank", "The bar that keeps C on a circle through O.")}),
        kind<ik::Pantograph>(
            "pantograph", "Pantograph", "Drag T: P draws the same, larger.", "P",
            {length_row("arm", "arm", "From O to the elbow, and from there to P."),
             {.name = "scale", .label = "scale", .help = "How much larger P draws what T traces."}}),
        kind<ik::ScissorLift>(
            "scissor_lift", "Scissor lift", "Crosses on top of one another, with one degree of freedom.", "",
            {{.name = "stages", .label = "stages", .help = "Crosses on top of one another."},
             length_row("bar", "bar", "The length of every bar."),
             {.name = "angle",
              .label = "angle",
              .help = "Of the bars from the ground, as it is made.",
              .step = 0.5f,
              .decimals = 1}}),
        kind<ik::Jansen>("jansen", "Jansen's leg", "A crank makes a foot walk, by eleven lengths.", "foot",
                         jansen_texts()),
        kind<JansenWalker, ik::Jansen>("walker", "Twelve legs",
                                       "Twelve of Jansen's legs on one crank, walking.", "foot",
                                       jansen_texts()),
        kind<ik::Delta>(
            "delta", "Delta robot", "Drag the platform: three motors follow.", "platform",
            {length_row("base_radius", "base radius", "From the middle of the base to its motors."),
             length_row("platform_radius", "platform radius",
                        "From the middle of the platform to its joints."),
             length_row("upper_arm", "upper arm", "The arm that a motor turns."),
             length_row("forearm", "forearm", "The pair of bars from each arm to the platform."),
             length_row("width", "width", "Between the two bars of a forearm.", true)},
            "motor_"),
        kind<ik::Stewart>(
            "stewart", "Stewart platform", "Drag the platform: six legs follow.", "platform",
            {length_row("base_radius", "base radius", "From the middle of the base to the legs' feet."),
             length_row("platform_radius", "platform radius",
                        "From the middle of the platform to its joints."),
             length_row("height", "height", "Of the platform, as it is made."),
             length_row("minimum", "shortest leg", "No leg gets shorter than this."),
             length_row("maximum", "longest leg", "No leg gets longer than this."),
             half_angle("base_angle", "base angle", "Half the angle between the two feet of a pair."),
             half_angle("platform_angle", "top angle",
                        "Half the angle between the two joints of a pair on the platform.")},
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
    const FieldsIn in = mechanism_fields(const_cast<Mechanism&>(mechanism));
    return {in.table, in.object};
}

FieldsIn mechanism_fields(Mechanism& mechanism) {
    const MechanismKind* const kind = kind_of(mechanism);
    void* const lengths = std::visit([](auto& each) -> void* { return &each; }, mechanism);
    return {kind != nullptr ? kind->fields : std::span<const Field>(), lengths};
}

}  // namespace tendril::app
