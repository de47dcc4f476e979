#include "app/labs/rig/presets.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "app/document/names.hpp"

namespace tendril::app {
namespace {

using namespace rig;

CameraPose view(glm::vec3 target, float yaw, float pitch, float distance) {
    return {.target = target, .yaw = glm::radians(yaw), .pitch = glm::radians(pitch), .distance = distance};
}

Transform at(double x, double y, double z) {
    return {.translation = {x, y, z}};
}
Transform turned(double degrees, const glm::dvec3& axis) {
    return {.rotation = glm::angleAxis(glm::radians(degrees), axis)};
}

Element bone(std::string name, std::string parent, const Transform& initial) {
    return {.name = std::move(name), .parent = std::move(parent), .initial = initial};
}
Element control(std::string name, std::string parent, const Transform& initial, const Control& settings) {
    return {.name = std::move(name),
            .kind = ElementKind::Control,
            .parent = std::move(parent),
            .initial = initial,
            .control = settings};
}
Control dial() {
    return {.kind = ControlKind::Float, .minimum = glm::dvec3(0.0), .maximum = glm::dvec3(1, 0, 0)};
}
FromElement value_of(const char* name) {
    return {.element = name, .of = Of::ControlValue};
}
FromElement each_transform() {
    return {.element = ThisElement(), .of = Of::Transform};
}

std::string numbered(const char* name, int number) {
    std::string result(name);
    result += ' ';
    result += std::to_string(number);
    return result;
}

/// A head looks at one control; a second one, parented to the first, sets the up direction.
Definition aim_scene() {
    const AimInputs primary{.axis = glm::dvec3(0, 0, 1), .target = FromElement{"look"}};
    const AimInputs secondary{.axis = glm::dvec3(0, 1, 0), .target = FromElement{"tilt"}};
    const Control square{
        .kind = ControlKind::Vector2d, .minimum = glm::dvec3(-1, -1, 0), .maximum = glm::dvec3(1, 1, 0)};
    const Control above{.kind = ControlKind::Position,
                        .minimum = glm::dvec3(-0.8, 0.2, -0.5),
                        .maximum = glm::dvec3(0.8, 1.2, 0.5)};
    Definition rig;
    rig.elements = {bone("neck", "", at(0, 0.5, 0)),
                    bone("head", "neck", at(0, 0.7, 0)),
                    bone("nose", "head", at(0, 0, 0.45)),
                    bone("crown", "head", at(0, 0.45, 0)),
                    control("look", "", at(0, 1.2, 1.6), square),
                    control("tilt", "look", at(0, 0.8, 0), above),
                    control("math form", "", at(-1, 0.2, 0), {.kind = ControlKind::Bool})};
    // A unit's switch has no "not", but its weight takes a number: 1 while the bool is off.
    rig.units = {{.name = "bone form",
                  .operation = AlphaInterpolate{.value = value_of("math form"), .scale = -1.0, .bias = 1.0}},
                 {.name = "aim",
                  .operation = Aim{.item = "head", .primary = primary, .secondary = secondary},
                  .weight = FromUnit{"bone form"}},
                 {.name = "aim math",
                  .operation = AimMath{.transform = FromElement{.element = "head", .of = Of::Transform},
                                       .primary = primary,
                                       .secondary = secondary},
                  .when = value_of("math form")},
                 {.name = "set head",
                  .operation = SetTransform{.item = "head", .transform = FromUnit{"aim math"}},
                  .when = value_of("math form")}};
    return rig;
}

/// A tentacle of controls, rotated by a dial and by hand. Each bone follows one of them at some distance,
/// which shows that the offset is maintained.
Definition fk_scene() {
    constexpr int count = 6;
    Definition rig;
    rig.elements.push_back(control("dial", "", at(-1.2, 0.2, 0), dial()));
    for (int i = 1; i <= count; ++i) {
        const bool first = i == 1;
        rig.elements.push_back(control(numbered("control", i), first ? "" : numbered("control", i - 1),
                                       at(0, first ? 0.2 : 0.4, first ? 0.25 : 0.0),
                                       {.kind = ControlKind::Rotation}));
    }
    for (int i = 1; i <= count; ++i)
        rig.elements.push_back(
            bone(numbered("bone", i), i == 1 ? "" : numbered("bone", i - 1), at(0, i == 1 ? 0.2 : 0.4, 0)));
    rig.units.push_back(
        {.name = "curl",
         .operation = ForEach{
             .roots = {"control 1"},
             .body = {{.name = "turn",
                       .operation = OffsetTransform{.item = ThisElement(), .offset = turned(25, {0, 0, 1})},
                       .weight = value_of("dial")}}}});
    for (int i = 1; i <= count; ++i)
        rig.units.push_back({.name = numbered("follow", i),
                             .operation = ParentConstraint{.item = numbered("bone", i),
                                                           .parents = {{.item = numbered("control", i)}}}});
    return rig;
}

/// Five arms around a centre, all curled by one dial.
Definition loop_scene() {
    constexpr int arms = 5, joints = 6;
    Definition rig;
    rig.elements.push_back(control("dial", "", at(0, 1.4, 0), dial()));
    rig.elements.push_back({.name = "middle", .kind = ElementKind::Null, .initial = at(0, 0.5, 0)});
    ForEach curl{
        .body = {{.name = "turn",
                  .operation = OffsetTransform{.item = ThisElement(), .offset = turned(30, {0, 0, 1})},
                  .weight = value_of("dial")}}};
    for (int arm = 1; arm <= arms; ++arm) {
        const std::string name = numbered("arm", arm);
        Transform root = turned(360.0 / arms * arm, {0, 1, 0});
        root.translation = root.rotation * glm::dvec3(0.3, 0, 0);
        rig.elements.push_back(bone(name, "middle", root));
        std::string parent = name;
        for (int joint = 2; joint <= joints; ++joint) {
            const std::string next = numbered((name + " joint").c_str(), joint);
            rig.elements.push_back(bone(next, parent, at(0.3, 0, 0)));
            parent = next;
        }
        curl.roots.push_back(name);
    }
    rig.units.push_back({.name = "curl", .operation = std::move(curl)});
    return rig;
}

signal::Curve curve(std::vector<signal::CurveKey> keys, double low = 0.0, double high = 1.0) {
    signal::Curve curve{.keys = std::move(keys), .target_min = low, .target_max = high};
    signal::set_smooth_tangents(curve);
    return curve;
}

/// A blob with two shapes and a hue, each driven by a control through its own curve.
Definition morph_scene() {
    using enum signal::Piece;
    const Control square{
        .kind = ControlKind::Vector2d, .minimum = glm::dvec3(0.0), .maximum = glm::dvec3(1, 1, 0)};
    Definition rig;
    rig.elements = {{.name = "blob", .kind = ElementKind::Null, .initial = at(0, 0.9, 0)},
                    {.name = "board", .kind = ElementKind::Null, .initial = at(0.9, 0.4, 0)},
                    control("shape", "board", {}, square),
                    control("colour", "", at(-1.1, 0.4, 0), dial())};
    rig.curves = {{.name = "stretch"}, {.name = "bulge"}, {.name = "hue"}};
    // The control lies at the origin of its space, so its local coordinates are its value.
    const auto along = [](Of axis) {
        return FromElement{.element = "shape", .of = axis, .space = Space::Local};
    };
    const signal::Curve ease = curve({{.time = 0, .value = 0, .piece = Cubic}, {.time = 1, .value = 1}});
    const signal::Curve late = curve({{.time = 0, .value = 0, .piece = Cubic},
                                      {.time = 0.5, .value = 0.1, .piece = Cubic},
                                      {.time = 1, .value = 1}});
    const signal::Curve bands =
        curve({{.time = 0, .value = 0.55}, {.time = 0.4, .value = 0.35}, {.time = 1, .value = 0.02}});
    rig.units = {
        {.name = "ease", .operation = EvaluateCurve{.value = along(Of::X), .curve = ease}},
        {.name = "set stretch", .operation = SetCurve{.curve = "stretch", .value = FromUnit{"ease"}}},
        {.name = "late", .operation = EvaluateCurve{.value = along(Of::Y), .curve = late}},
        {.name = "set bulge", .operation = SetCurve{.curve = "bulge", .value = FromUnit{"late"}}},
        {.name = "bands", .operation = EvaluateCurve{.value = value_of("colour"), .curve = bands}},
        {.name = "set hue", .operation = SetCurve{.curve = "hue", .value = FromUnit{"bands"}}}};
    return rig;
}

/// Two antennae trail the head: each bone points at a spring that follows its rest tip.
Definition secondary_scene() {
    constexpr int joints = 6;
    constexpr double length = 0.16;
    Definition rig;
    rig.elements = {control("head", "", at(0, 1, 0), {.kind = ControlKind::Transform}),
                    bone("skull", "head", {})};
    ForEach trail;
    for (const auto& [name, side] : {std::pair{"left", 1.0}, std::pair{"right", -1.0}}) {
        Transform root = turned(-25.0 * side, {0, 0, 1});
        root.translation = {0.12 * side, 0.2, 0};
        std::string parent = "skull";
        for (int joint = 1; joint <= joints; ++joint) {
            const std::string next = numbered(name, joint);
            rig.elements.push_back(bone(next, parent, joint == 1 ? root : at(0, length, 0)));
            parent = next;
        }
        trail.roots.push_back(numbered(name, 1));
    }
    const signal::Curve line;
    signal::Curve softer = line, more = line;
    // A spring reads its target at the end of a frame, on average half a frame early, and these errors add up
    // over the joints. With stiff, barely damped springs a comparison of frame rates would show nothing else.
    softer.target_min = 2.0;  // Hz at the root
    softer.target_max = 1.2;
    more.target_min = 0.1;
    more.target_max = 0.4;
    trail.body = {
        {.name = "tip",
         .operation = TransformLocation{.transform = each_transform(), .location = glm::dvec3(0, length, 0)}},
        {.name = "strength", .operation = EvaluateCurve{.value = Each::Ratio, .curve = softer}},
        {.name = "spring",
         .operation =
             SpringInterpolate{
                 .target = FromUnit{"tip"}, .strength = FromUnit{"strength"}, .critical_damping = 0.5}},
        {.name = "share", .operation = EvaluateCurve{.value = Each::Ratio, .curve = more}},
        {.name = "bend",
         .operation = Aim{.item = ThisElement(),
                          .primary = {.axis = glm::dvec3(0, 1, 0), .target = FromUnit{"spring"}}},
         .weight = FromUnit{"share"}}};
    rig.units = {{.name = "trail", .operation = std::move(trail)}};
    return rig;
}

}  // namespace

const std::vector<RigPreset>& rig_presets() {
    static const std::vector<RigPreset> list{
        {"aim", "Aim", aim_scene, view({0.1f, 1.15f, 0.7f}, -24.0f, 12.0f, 5.8f)},
        {"fk", "FK", fk_scene, view({0.0f, 1.2f, 0.0f}, -30.0f, 12.0f, 5.4f)},
        {"loop", "Loop", loop_scene, view({0.0f, 0.8f, 0.0f}, -30.0f, 24.0f, 5.8f)},
        {"morph", "Morph", morph_scene, view({0.0f, 0.8f, 0.0f}, -16.0f, 10.0f, 4.8f)},
        {"secondary", "Secondary", secondary_scene, view({0.0f, 1.3f, 0.0f}, -16.0f, 8.0f, 3.3f)}};
    return list;
}

const RigPreset& rig_preset(std::string_view name) {
    return named(
        rig_presets(), [](const RigPreset& each) { return each.name; }, name, "preset");
}

}  // namespace tendril::app
