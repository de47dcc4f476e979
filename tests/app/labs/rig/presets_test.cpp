// The five presets: each solves without a warning and does what its documentation says.
#include <array>
#include <glm/gtc/quaternion.hpp>

#include "app/labs/rig/presets.hpp"
#include "rig_support.hpp"

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

}  // namespace
}  // namespace tendril::app
