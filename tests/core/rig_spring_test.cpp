// Springs as units: parameters out of range, and when springs move.
#include <gtest/gtest.h>

#include "rig_rigs.hpp"

namespace tendril::rig {
namespace {

/// Parameters from controls may have any value.
TEST(RigSpring, ASpringsParametersAreClampedWithAWarning) {
    Definition definition;
    definition.elements = {
        {.name = "dial", .kind = ElementKind::Control, .control = Control{.kind = ControlKind::Float}},
        {.name = "turn", .kind = ElementKind::Control, .control = Control{.kind = ControlKind::Rotation}}};
    const FromElement dial{.element = "dial", .of = Of::ControlValue};
    definition.units = {
        {.name = "spring",
         .operation = SpringInterpolate{.target = FromElement{.element = "turn", .of = Of::ControlValue},
                                        .strength = 2.0,
                                        .critical_damping = dial}}};
    Held rig(definition);
    ASSERT_TRUE(rig.control("dial", -0.5));
    const glm::dquat turned = glm::angleAxis(1.0, glm::dvec3(0, 1, 0));
    rig.solve(0.01);
    EXPECT_EQ(rig.unit("spring").warning, Warning::ParameterOutOfRange);
    ASSERT_TRUE(rig.control("turn", turned));
    for (int i = 0; i < 10; ++i) rig.solve(0.01);
    const auto clamped = std::get<glm::dquat>(rig.unit("spring").outputs[0]);
    EXPECT_NEAR(glm::length(clamped), 1.0, 1e-12);
    Held undamped(definition);
    undamped.solve(0.01);
    ASSERT_TRUE(undamped.control("turn", turned));
    for (int i = 0; i < 10; ++i) undamped.solve(0.01);
    EXPECT_EQ(undamped.unit("spring").warning, Warning::None);
    EXPECT_EQ(std::get<glm::dquat>(undamped.unit("spring").outputs[0]), clamped) << "it swings as with 0";
}

TEST(RigSpring, AForceWithoutASpringMovesWithTime) {
    Definition definition;
    definition.units = {{.name = "drift",
                         .operation = SpringInterpolate{
                             .target = Value(0.0), .strength = 0.0, .force = Input<Value>(Value(2.0))}}};
    Held rig(definition);
    EXPECT_TRUE(rig.solve(0.01)) << "it starts at rest, and does not stay so";
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(rig.solve(0.01));
    EXPECT_NEAR(std::get<double>(rig.unit("drift").outputs[1]), 2.0, 1e-9);
}

TEST(RigSpring, ASpringThatTurnsRoundMovesOn) {
    Definition definition;
    definition.elements = {
        {.name = "dial", .kind = ElementKind::Control, .control = Control{.kind = ControlKind::Float}}};
    definition.units = {
        {.name = "swing",
         .operation = SpringInterpolate{.target = FromElement{.element = "dial", .of = Of::ControlValue},
                                        .strength = 1.0,
                                        .critical_damping = 0.0}}};
    Held rig(definition);
    rig.solve(0.25);
    ASSERT_TRUE(rig.control("dial", 1.0));
    // Each step is a quarter of a swing: every second one ends at a turning point, at rest.
    for (int i = 0; i < 12; ++i) EXPECT_TRUE(rig.solve(0.25)) << i;
}

}  // namespace
}  // namespace tendril::rig
