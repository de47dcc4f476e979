// The members of what IK remembers, listed once for scene files and exported code: each_number(state, visit)
// calls visit(name, member) for each, in the order of their declaration. `left` and `right` are the two
// elements of an array.
#pragma once

#include <tendril/humanoid/feet.hpp>
#include <tendril/humanoid/footsteps.hpp>
#include <tendril/humanoid/hands.hpp>
#include <tendril/humanoid/look_at.hpp>

namespace tendril::app {

void each_number(auto& spring, auto visit) requires requires {
    spring.previous_target;
}
{
    visit("value", spring.value);
    visit("velocity", spring.velocity);
    visit("previous", spring.previous_target);
    visit("started", spring.started);
}

void each_number(auto& foot, auto visit) requires requires {
    foot.lock_x;
}
{
    visit("locked", foot.locked);
    visit("speed_known", foot.speed_known);
    visit("standing", foot.standing);
    visit("heel", foot.heel);
    visit("toe", foot.toe);
    visit("velocity", foot.velocity);
    visit("lock_x", foot.lock_x);
    visit("lock_z", foot.lock_z);
    visit("shift_x", foot.shift_x);
    visit("shift_z", foot.shift_z);
    visit("edges_known", foot.edges_known);
    visit("offset_x", foot.offset_x);
    visit("offset_z", foot.offset_z);
    visit("lift", foot.lift);
    visit("goal", foot.goal);
    visit("ease", foot.ease);
    visit("knee", foot.knee);
    visit("planting", foot.planting);
    visit("turn", foot.turn);
    visit("alone", foot.alone);
}

void each_number(auto& feet, auto visit) requires requires {
    feet.pelvis;
}
{
    visit("started", feet.started);
    visit("hips", feet.hips);
    visit("base", feet.base);
    visit("drop", feet.drop);
    visit("root", feet.root);
    visit("pelvis", feet.pelvis);
    visit("left", feet.feet[0]);
    visit("right", feet.feet[1]);
}

void each_number(auto& step, auto visit) requires requires {
    step.part;
}
{
    visit("from", step.from);
    visit("to", step.to);
    visit("part", step.part);
}

void each_number(auto& steps, auto visit) requires requires {
    steps.stepping();
}
{
    visit("left", steps.feet[0]);
    visit("right", steps.feet[1]);
}

void each_number(auto& hand, auto visit) requires(
    requires { hand.in_view; } && !requires { hand.gaze; }) {
    visit("in_view", hand.in_view);
    visit("view", hand.view);
}

void each_number(auto& hands, auto visit) requires requires {
    hands.hands;
}
{
    visit("left", hands.hands[0]);
    visit("right", hands.hands[1]);
}

void each_number(auto& look, auto visit) requires requires {
    look.gaze;
}
{
    visit("in_view", look.in_view);
    visit("view", look.view);
    visit("gaze", look.gaze);
}

}  // namespace tendril::app
