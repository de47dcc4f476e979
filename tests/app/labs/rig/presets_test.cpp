// The five presets: each solves without a warning and does what its documentation says.
#include <array>
#include <glm/trigonometric.hpp>

#include "app/labs/kit/past.hpp"
#include "app/labs/rig/presets.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/view/palette.hpp"
#include "rig_support.hpp"
#include "tests/app/labs/rig/rig_support.hpp"
#include "tests/app/support/random_numbers.hpp"

namespace tendril::app {
namespace {

std::string numbered(const char* name, int number) {
    std::string result(name);
    result += ' ';
    result += std::to_string(number);
    return result;
}

class RigPresets : public RigTest {
  protected:
    void open(const char* name) { run("rig.preset", {{"name", name}}); }
    /// Sets an input of a unit, or of the first unit in its body, as if edited in the file.
    void switch_input(std::size_t unit, const char* input, bool on) {
        Json scene = save_scene(workspace);
        Json* at = &scene.at("labs").at(rig_lab).at("units").at(unit);
        if (!at->contains(input)) at = &at->at("body").at(0);
        (*at)[input] = on;
        load_scene(workspace, scene);
    }
    void expect_no_warning() const {
        for (const Json& each : list("units")) {
            EXPECT_EQ(each.at("warning"), "") << each.at("name");
            if (!each.contains("body")) continue;
            for (const Json& inner : each.at("body")) EXPECT_EQ(inner.at("warning"), "") << inner.at("name");
        }
    }
};

TEST_F(RigPresets, AllSolveWithoutWarningsAndComeToRest) {
    ASSERT_EQ(rig_presets().size(), 5u);
    for (const RigPreset& each : rig_presets()) {
        SCOPED_TRACE(each.name);
        open(each.name.c_str());
        expect_no_warning();
        tick(2);
        expect_no_warning();
        EXPECT_FALSE(lab().moving(workspace)) << "nothing has been touched";
        const Json scene = saved();
        solve();
        EXPECT_EQ(saved(), scene);
    }
}

TEST_F(RigPresets, TheHeadLooksAtItsControlInBothForms) {
    open("aim");
    for (const Json& look : {Json{0.8, -0.6}, Json{-1, 1}, Json{5, 0}}) {
        set("look", look);
        set("tilt", {0.4, 0.6, 0.1});
        set("math form", false);
        solve();
        expect_no_warning();
        const glm::dvec3 head = translation("head"), to = glm::normalize(translation("look") - head);
        EXPECT_NEAR(glm::dot(rotation("head") * glm::dvec3(0, 0, 1), to), 1.0, 1e-12);
        // Up is towards the tilt as far as the aim permits.
        const glm::dvec3 side = glm::cross(to, translation("tilt") - head);
        EXPECT_NEAR(glm::dot(rotation("head") * glm::dvec3(0, 1, 0), glm::normalize(side)), 0.0, 1e-12);
        const Json bone_form = named("elements", "head");
        set("math form", true);
        solve();
        expect_no_warning();
        EXPECT_EQ(named("elements", "head"), bone_form) << "the two forms agree to the bit";
        EXPECT_NE(output("aim math"), output("bone form"));
    }
    EXPECT_EQ(named("elements", "look").at("value"), (Json{1.0, 0.0})) << "it stops at its rectangle";
}

TEST_F(RigPresets, TheTiltMovesWithItsSpace) {
    open("aim");
    const glm::dvec3 before = translation("tilt");
    set("look", {0.5, 0.25});
    solve();
    EXPECT_LE(glm::length(translation("tilt") - before - glm::dvec3(0.5, 0.25, 0)), 1e-12);
}

TEST_F(RigPresets, TheTentacleFollowsItsControls) {
    open("fk");
    const glm::dvec3 off(0, 0, -0.25);  // offset of a bone from its control at rest
    set("dial", 0.6);
    set("control 3", {0, 0.3, 0, 0.95});
    solve();
    expect_no_warning();
    for (int i = 1; i <= 6; ++i) {
        const glm::dvec3 wanted =
            translation(numbered("control", i)) + rotation(numbered("control", i)) * off;
        EXPECT_LE(glm::length(translation(numbered("bone", i)) - wanted), 1e-9) << i;
    }
    EXPECT_GT(glm::length(translation("bone 6") - glm::dvec3(0, 2.2, 0)), 0.5) << "it has curled";
}

TEST_F(RigPresets, TheArmsCurlOrTheirJointsTurnInPlace) {
    open("loop");
    const glm::dvec3 straight = translation("arm 2 joint 6");
    set("dial", 1);
    solve();
    expect_no_warning();
    EXPECT_EQ(output("curl"), 30.0) << "five arms of six joints";
    EXPECT_GT(glm::length(translation("arm 2 joint 6") - straight), 1.0);
    // All arms are alike, each rotated about the middle.
    const glm::dquat by = glm::angleAxis(glm::radians(72.0), glm::dvec3(0, 1, 0));
    for (const char* joint : {"", " joint 3", " joint 6"}) {
        const glm::dvec3 one = translation(std::string("arm 1") + joint);
        EXPECT_LE(glm::length(translation(std::string("arm 2") + joint) - by * one), 1e-9) << joint;
    }
    switch_input(0, "propagate", false);
    solve();
    EXPECT_LE(glm::length(translation("arm 2 joint 6") - straight), 1e-9) << "where it was";
    const double turned = glm::degrees(2.0 * std::acos(std::min(1.0, std::abs(rotation("arm 5 joint 4").w))));
    EXPECT_NEAR(turned, 30.0, 1e-6);
}

TEST_F(RigPresets, WeightsAndColourFollowTheirControlsThroughCurves) {
    open("morph");
    set("shape", {1, 0});
    solve();
    Json curves = state().at("curves");
    EXPECT_NEAR(curves.at("stretch").get<double>(), 1.0, 1e-12);
    EXPECT_NEAR(curves.at("bulge").get<double>(), 0.0, 1e-12);
    set("shape", {0.25, 0.5});
    set("colour", 0.4);
    solve();
    curves = state().at("curves");
    EXPECT_NEAR(curves.at("stretch").get<double>(), 0.15625, 1e-12) << "smooth: 3 t^2 - 2 t^3";
    EXPECT_NEAR(curves.at("bulge").get<double>(), 0.1, 1e-12);
    EXPECT_NEAR(curves.at("hue").get<double>(), 0.35, 1e-12);
    expect_no_warning();
}

/// The difference between frame rates is small beside the springs' motion, but visible.
TEST_F(RigPresets, TheAntennaeTrailAboutEquallyAtEveryFrameRate) {
    open("secondary");
    tick(1);
    const auto antenna = [&] { return translation("right 6") - translation("head"); };
    const glm::dvec3 rest = antenna();
    run("rig.motion", {{"name", "head"}, {"path", "circle"}});
    tick(300);
    const double trails = glm::length(antenna() - rest);
    EXPECT_GT(trails, 0.15);
    run("rig.rates");
    const Json rates = state().at("rates");
    EXPECT_GT(rates.at("mm"), 20.0);
    EXPECT_LT(rates.at("mm"), 0.5 * 1e3 * trails);
    EXPECT_LT(rates.at("degrees"), 20.0);
}

TEST_F(RigPresets, TheAntennaeTrailTheHeadTheirTipsMost) {
    open("secondary");
    tick(2);
    std::vector<glm::dvec3> rest;
    for (int i = 1; i <= 6; ++i) rest.push_back(translation(numbered("left", i)));
    const glm::dvec3 step(0.4, 0, 0);
    set("head", {{"translation", {0.4, 1, 0}}});
    std::array<double, 6> most{};  // distance from where a stiff antenna would be
    for (int ticks = 0; ticks < 40; ++ticks) {
        tick();
        expect_no_warning();
        EXPECT_EQ(translation("skull"), translation("head")) << "the head itself goes along at once";
        for (int i = 1; i <= 6; ++i) {
            const auto at = static_cast<std::size_t>(i - 1);
            const glm::dvec3 now = translation(numbered("left", i));
            most[at] = std::max(most[at], glm::length(now - rest[at] - step));
            if (i == 1) continue;
            EXPECT_NEAR(glm::length(now - translation(numbered("left", i - 1))), 0.16, 1e-9);
        }
    }
    EXPECT_LE(most[0], 1e-12);
    for (std::size_t i = 1; i < most.size(); ++i) EXPECT_GT(most[i], most[i - 1]) << i;
    EXPECT_GT(most[5], 0.2);
    int ticks = 0;
    for (; lab().moving(workspace) && ticks < 2000; ++ticks) tick();
    EXPECT_LT(ticks, 2000);
    for (int i = 1; i <= 6; ++i)
        EXPECT_LE(
            glm::length(translation(numbered("left", i)) - rest[static_cast<std::size_t>(i - 1)] - step),
            1e-6)
            << i;
}

// An element's rotation at each remembered moment, against an independent computation.

class RigPast : public RigTest, protected test::RandomNumbers {
  protected:
    RigPast() : RandomNumbers(23) {}

    glm::dquat rotation() {
        const double w = uniform(-1, 1), x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
        return glm::normalize(glm::dquat(w, x, y, z + 1e-3));
    }
    glm::dvec3 point() {
        const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
        return {x, y, z};
    }

    /// A tree of bones and nulls, each below a random earlier one.
    rig::Definition tree(std::size_t count) {
        rig::Definition definition;
        for (std::size_t i = 0; i < count; ++i) {
            rig::Element each{.name = "e" + std::to_string(i)};
            each.kind = random() % 5 == 0 ? rig::ElementKind::Null : rig::ElementKind::Bone;
            if (i > 0) each.parent = "e" + std::to_string(random() % i);
            each.initial.translation = point();
            each.initial.rotation = rotation();
            definition.elements.push_back(each);
        }
        return definition;
    }
    void plot(const std::string& what, const std::string& element) {
        run("view.rig_plot", {{"of", what}});
        run("rig.select", {{"element", element}});
    }
    std::vector<PastValue> values() const {
        return past_values(workspace, rig_past(), *rig_past().curve(workspace));
    }
};

/// Degrees: swing of the bone's direction, and twist after undoing the swing by the shortest rotation.
struct Counted {
    double swing, twist;
};
Counted count(const glm::dquat& turn, const glm::dvec3& along) {
    const glm::dvec3 bone = glm::normalize(along), went = turn * bone;
    const glm::dvec3 axis = glm::cross(went, bone);
    const double sine = glm::length(axis), cosine = glm::dot(went, bone);
    const glm::dquat back =
        sine > 1e-12 ? glm::angleAxis(std::atan2(sine, cosine), axis / sine) : glm::dquat(1, 0, 0, 0);
    const glm::dvec3 other = std::abs(bone.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 side = glm::normalize(glm::cross(bone, other)), turned = back * (turn * side);
    return {glm::degrees(std::atan2(sine, cosine)),
            glm::degrees(std::atan2(glm::dot(glm::cross(side, turned), bone), glm::dot(side, turned)))};
}

TEST_F(RigPast, ValuesEqualThePoseAtEachTick) {
    for (int round = 0; round < 20; ++round) {
        run("rig.clear");
        workspace.rewind.clear();
        const rig::Definition definition = tree(3 + random() % 12);
        workspace.document.edit<RigPart>(rig_lab) = RigPart(definition);
        const std::size_t chosen = random() % definition.elements.size();
        const rig::Element& element = definition.elements[chosen];
        std::vector<glm::dquat> turns;
        for (int moment = 0; moment < 30; ++moment) {
            auto& part = workspace.document.edit<RigPart>(rig_lab);
            for (int i = 0; i < 3; ++i) {
                rig::Transform to;
                to.translation = point();
                to.rotation = rotation();
                const auto space = random() % 2 == 0 ? rig::Space::Local : rig::Space::Global;
                const auto down = random() % 2 == 0 ? rig::Propagate::Yes : rig::Propagate::No;
                const rig::ElementId id = part.rig.id(random() % definition.elements.size());
                ASSERT_TRUE(part.state.edit().elements.set(id, space, to, down));
            }
            rig::Hierarchy resolved = part.state->elements;
            turns.push_back(glm::conjugate(element.initial.rotation) *
                            resolved.get(part.rig.id(chosen), rig::Space::Local).rotation);
            remember();
        }
        glm::dvec3 along(0.0);
        for (const rig::Element& each : definition.elements)
            if (each.parent == element.name && each.kind == rig::ElementKind::Bone)
                along += each.initial.translation;
        const bool leaf = glm::length(along) < 1e-9;
        const auto is_led = [&](const rig::Element& each) {
            return each.name == element.parent && each.kind == rig::ElementKind::Bone;
        };
        const bool led = std::any_of(definition.elements.begin(), definition.elements.end(), is_led);
        if (leaf) along = led ? element.initial.translation : glm::dvec3(0, 1, 0);
        for (const char* const what : {"swing", "twist", "angle"}) {
            plot(what, element.name);
            const std::vector<PastValue> told = values();
            const bool known = element.kind == rig::ElementKind::Bone || what[0] == 'a';
            ASSERT_EQ(told.size() >= turns.size(), known);
            for (std::size_t i = 0; known && i < turns.size(); ++i) {
                const Counted counted = count(turns[i], along);
                const double angle = 2.0 * glm::degrees(std::acos(std::min(1.0, std::abs(turns[i].w))));
                const double expected = what[0] == 's'   ? counted.swing
                                        : what[0] == 't' ? counted.twist
                                                         : angle;
                EXPECT_NEAR(static_cast<double>(told[i].value), expected, 1e-3) << what << " at " << i;
            }
        }
    }
}

TEST_F(RigPast, AnElementIsFoundByNameInThePast) {
    element("arm");
    element("hand", "arm", transform(0, 1, 0));
    remember();
    run("rig.element.add", {{"name", "base"}, {"kind", "bone"}});
    remember();
    plot("angle", "base");
    EXPECT_EQ(values().size(), 2u) << "of the moment without it there is none; the present is one more";
    plot("angle", "hand");
    EXPECT_EQ(values().size(), 3u);
}

TEST_F(RigPast, WithoutASelectionItIsTheFirstBoneBelowAnother) {
    run("view.rig_plot", {{"of", "swing"}});
    EXPECT_TRUE(test::says(rig_past().curve(workspace)->missing, "rig elements"));
    control("look", "position");
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of look");
    element("arm");
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of arm");
    element("hand", "arm", transform(0, 1, 0));
    EXPECT_EQ(rig_past().curve(workspace)->name, "swing of hand");
    run("rig.select", {{"element", "look"}});
    EXPECT_TRUE(values().empty());
    EXPECT_TRUE(test::says(rig_past().curve(workspace)->missing, "look swing twist bone"));
}

TEST_F(RigPast, GhostsAreThePastBones) {
    element("arm", "", transform(1, 0, 0));
    element("hand", "arm", transform(0, 1, 0));
    const PoseLines lines = rig_past().pose(workspace, now());
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].first, glm::vec3(1, 0, 0));
    EXPECT_EQ(lines[0].second, glm::vec3(1, 1, 0));
    EXPECT_EQ(lines[1].first, glm::vec3(1, 1, 0));
}

// Bones below a control that is not at rest: a solve starts with the bones where the control has moved them,
// for commands, gizmos and ghosts alike.

const glm::dvec3 arm_start(0, 2, -1), hand_start(0, 2, -2);

class RigBelowControl : public RigTest {
  protected:
    /// `mover` has moved up and turned by 90 degrees about y: its x axis is now -z. A unit moves the arm.
    RigBelowControl() {
        control("mover", "transform");
        element("arm", "mover", transform(1, 0, 0));
        element("hand", "arm", transform(1, 0, 0));
        unit({{"unit", "offset_transform"},
              {"name", "move on"},
              {"item", "arm"},
              {"offset", transform(0, 0.5, 0)}});
        const double half = std::sqrt(0.5);
        set("mover", {{"translation", {0, 2, 0}}, {"rotation", {0, half, 0, half}}});
        tick(2);
    }
    void set_global(const char* name, const Json& to) {
        run("rig.element.set", {{"name", name}, {"space", "global"}, {"transform", to}});
    }
    void switch_unit_off() {
        run("rig.unit.enable", {{"name", "move on"}, {"on", false}});
        tick();
    }
    void drag_to(const Handle& handle, glm::vec3 position) {
        HandleFrame to = handle.frame;
        to.position = position;
        Emit emit;
        lab().drag(workspace, handle.pick, to, emit);
        for (const Emitted& each : emit.take()) run(each.name.c_str(), *each.arguments);
    }
};

TEST_F(RigBelowControl, OmittedPartsOfAGlobalPoseStayWhereTheControlPutsThem) {
    set_global("arm", {{"rotation", {0, 0, 0, 1}}});
    switch_unit_off();
    expect_near(translation("arm"), arm_start);
    expect_near(translation("hand"), arm_start + glm::dvec3(1, 0, 0));
    EXPECT_NEAR(std::abs(rotation("arm").w), 1.0, 1e-12);
    set("mover", {{"translation", {0, 3, 0}}});
    tick();
    expect_near(translation("arm"), arm_start + glm::dvec3(0, 1, 0));  // it follows the control
}

TEST_F(RigBelowControl, TheGizmoIsWhereASolveStartsTheBone) {
    run("rig.select", {{"element", "arm"}});
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    expect_near(glm::dvec3(gizmo->frame.position), arm_start, 1e-6);
    drag_to(*gizmo, gizmo->frame.position + glm::vec3(0, 0.25f, 0));
    switch_unit_off();
    expect_near(translation("arm"), arm_start + glm::dvec3(0, 0.25, 0), 1e-6);
}

TEST_F(RigBelowControl, TheGizmoOfAControlThere) {
    control("grip", "transform", {{"space", "hand"}, {"local", transform(1, 0, 0)}});
    tick();
    run("rig.select", {{"element", "grip"}});
    const auto gizmo = lab().gizmo(workspace);
    ASSERT_TRUE(gizmo);
    const glm::dvec3 is = translation("grip");
    expect_near(is, hand_start + glm::dvec3(0, 0.5, -1), 1e-6);
    expect_near(glm::dvec3(gizmo->frame.position), is, 1e-6);
    drag_to(*gizmo, {1, 1, 1});
    tick();
    expect_near(translation("grip"), {1, 1, 1}, 1e-6);
}

TEST_F(RigBelowControl, GhostsShowThePoseThatASolveStartsWith) {
    run("rig.select", {{"element", "arm"}});
    const Camera camera({}, {{0.0f, 0.0f}, {800.0f, 600.0f}});
    const Palette& colours = palette(Theme::Dark);
    DrawList list;
    lab().draw({.workspace = workspace, .camera = camera, .palette = colours}, list);
    std::size_t arms = 0, hands = 0;
    for (const Stroke& each : list.strokes) {
        if (glm::vec3(each.colour) != colours.ghost) continue;
        const bool at_arm = glm::distance(glm::dvec3(each.a), arm_start) < 1e-5;
        const bool at_hand = glm::distance(glm::dvec3(each.b), hand_start) < 1e-5;
        EXPECT_TRUE(at_arm || at_hand) << each.a.x << ' ' << each.a.y << ' ' << each.a.z;
        arms += at_arm;
        hands += at_hand;
    }
    EXPECT_GE(arms, 2u) << "its joint, and the bone to the hand";
    EXPECT_GE(hands, 2u);
}

}  // namespace
}  // namespace tendril::app
