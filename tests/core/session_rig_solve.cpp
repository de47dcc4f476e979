// One rig with every unit, solved with moving controls.
#include "fnv.hpp"
#include "random.hpp"
#include "session.hpp"
#include "tendril/rig/backward.hpp"

namespace tendril::test {
namespace {

using namespace tendril::rig;

Transform at(double x, double y, double z) {
    Transform made{.translation = {x, y, z}};
    return made;
}

Definition every_unit() {
    Definition made;
    made.elements = {
        {.name = "a", .initial = at(0, 0, 0)},
        {.name = "b", .parent = "a", .initial = at(0, 1, 0)},
        {.name = "c", .parent = "b", .initial = at(0.25, 1, 0)},
        {.name = "d", .parent = "c", .initial = at(0, 1, 0.5)},
        {.name = "look", .kind = ElementKind::Control, .initial = at(0, 1, 4)},
        {.name = "dial",
         .kind = ElementKind::Control,
         .control =
             Control{.kind = ControlKind::Float, .minimum = glm::dvec3(0.0), .maximum = glm::dvec3(1.0)}},
        {.name = "hand", .kind = ElementKind::Null, .initial = at(2, 0, 0)}};
    made.curves = {{.name = "smile"}};
    const FromElement dial{.element = "dial", .of = Of::ControlValue};
    const AimInputs at_look{.axis = glm::dvec3(0, 0, 1), .target = FromElement{"look"}};
    Transform bend = at(0, 0.125, 0);
    bend.rotation = {0.96875, 0.0, 0.25, 0.0};
    made.units = {
        {.name = "aim", .operation = Aim{.item = "a", .primary = at_look, .max_speed = 90.0}, .weight = dial},
        {.name = "math", .operation = AimMath{.transform = at(1, 2, 3), .primary = at_look}},
        {.name = "follow",
         .operation = ParentConstraint{.item = "hand",
                                       .parents = {{.item = "look"}, {.item = "b", .weight = dial}},
                                       .filter = {.rotation = {true, false, true}}}},
        {.name = "loop",
         .operation =
             ForEach{.roots = {"a"},
                     .body = {{.name = "offset",
                               .operation = OffsetTransform{.item = ThisElement(), .offset = bend},
                               .weight = Each::Ratio},
                              {.name = "trail",
                               .operation = SpringInterpolate{.target = FromElement{.element = ThisElement(),
                                                                                    .of = Of::Rotation},
                                                              .critical_damping = Each::Ratio}},
                              {.name = "turn",
                               .operation = SetRotation{.item = ThisElement(),
                                                        .rotation = FromUnit{"trail"},
                                                        .propagate = false}}}}},
        {.name = "vectors",
         .operation = FromTwoVectors{.from = glm::dvec3(1, 0, 0), .to = FromElement{"look"}}},
        {.name = "project",
         .operation = ProjectToParent{.child = "d", .old_parent = "a", .new_parent = "look"}},
        {.name = "place",
         .operation = SetTransform{.item = "hand", .transform = FromUnit{"project"}},
         .weight = 0.25},
        {.name = "point",
         .operation = TransformLocation{.transform = FromUnit{"math"}, .location = FromElement{"d"}}},
        {.name = "way",
         .operation = TransformDirection{.transform = FromUnit{"math"}, .direction = FromUnit{"point"}}},
        {.name = "ease", .operation = AlphaInterpolate{.value = dial, .scale = 2.0, .interp = true}},
        {.name = "curve", .operation = EvaluateCurve{.value = FromUnit{"ease"}}},
        {.name = "smile", .operation = SetCurve{.curve = "smile", .value = FromUnit{"curve"}}, .weight = 0.5},
        {.name = "reach",
         .operation = Fabrik{.root = "a", .tip = "d", .target = FromElement{"hand"}},
         .weight = 0.75},
        {.name = "bend",
         .operation = TwoBone{.root = "b",
                              .tip = "d",
                              .target = FromElement{"look"},
                              .pole_target = FromElement{"hand"}},
         .weight = 0.5},
        {.name = "lay",
         .operation = Spline{.root = "b", .tip = "d", .points = {"b", "hand", "look"}, .fit = true},
         .weight = 0.5}};
    return made;
}

void add(Fnv& hash, const Transform& pose) {
    for (int axis = 0; axis < 3; ++axis) hash.add(pose.translation[axis]);
    for (const double part : {pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z})
        hash.add(part);
    for (int axis = 0; axis < 3; ++axis) hash.add(pose.scale[axis]);
}

void add(Fnv& hash, const Rig& rig, State& state) {
    for (std::size_t i = 0; i < rig.definition().elements.size(); ++i)
        add(hash, state.elements.get(rig.id(i), Space::Global));
    for (const double curve : state.curves) hash.add(curve);
}

}  // namespace

std::uint64_t rig_solve_hash() {
    Random random(20261122);
    Fnv hash;
    const Rig rig = Rig::make(every_unit()).value();
    State state = rig.initial_state();
    Workspace workspace(rig);
    for (int tick = 0; tick < 200; ++tick) {
        const double x = static_cast<double>(random.around(4.0f)),
                     y = static_cast<double>(random.around(4.0f));
        if (random.chance(8))
            static_cast<void>(rig.set_control(state, *rig.element("look"), at(x, y, 3)).ok());
        if (random.chance(8)) static_cast<void>(rig.set_control(state, *rig.element("dial"), 0.25 * x).ok());
        rig.solve(state, 0.015625, workspace);
        add(hash, rig, state);
    }
    const BackwardReport report = solve_backward(rig, state, workspace, {.max_iterations = 5});
    add(hash, rig, state);
    for (const Residual& left : report.elements) hash.add(left.metres);
    return hash.value();
}

}  // namespace tendril::test
