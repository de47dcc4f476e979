// What the Rope lab's commands refuse, in which words, and that nothing changes then.
#include <cmath>

#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeRefusals : public RopeTest {};

const Json origin = Json::array({0, 0, 0}), right = Json::array({1, 0, 0});

TEST_F(RopeRefusals, SayWhyInOneLine) {
    single_rope(8);
    EXPECT_EQ(refused("rope.add", {{"from", origin}}), "rope.add: to is missing (a point [x, y, z])");
    EXPECT_EQ(refused("rope.pin", {{"rope", "rope"}, {"particle", 9}}),
              "rope.pin: particle 9 is out of range, \"rope\" has 9");
    EXPECT_EQ(refused("rope.pin", {{"rope", "line"}, {"particle", 0}}),
              "rope.pin: there is no rope \"line\"");
    EXPECT_EQ(refused("rope.unpin", {{"rope", "rope"}, {"particle", -1}}),
              "rope.unpin: particle must be 0 to 99999, got -1");
    EXPECT_EQ(refused("rope.cut", {{"rope", "rope"}, {"segment", 8}}),
              "rope.cut: segment 8 is out of range, \"rope\" has 8");
    EXPECT_EQ(refused("rope.remove", {{"name", "x"}}), "rope.remove: there is no rope \"x\"");
    EXPECT_EQ(refused("rope.collider.move", {{"name", "x"}, {"to", origin}}),
              "rope.collider.move: there is no collider \"x\"");
    EXPECT_EQ(refused("rope.collider.remove", {{"name", "x"}}),
              "rope.collider.remove: there is no collider \"x\"");
    EXPECT_EQ(refused("rope.collider.swing", {{"name", "x"}, {"by", right}}),
              "rope.collider.swing: there is no collider \"x\"");
    EXPECT_EQ(refused("rope.settings", {{"solver", "magic"}}),
              "rope.settings: solver must be one of relaxation, xpbd, direct, got \"magic\"");
    EXPECT_EQ(refused("rope.settings", {{"substep", 0}}),
              "rope.settings: substep must be 1e-05 to 0.1, got 0");
    EXPECT_EQ(refused("rope.settings", {{"gravity", "down"}}),
              "rope.settings: gravity must be a number or a point [x, y, z], got \"down\"");
    EXPECT_EQ(refused("rope.jitter", {{"dial", 1.5}}), "rope.jitter: dial must be 0 to 1, got 1.5");
    EXPECT_EQ(refused("rope.view", {{"sides", 2}}), "rope.view: sides must be 3 to 64, got 2");
    EXPECT_EQ(refused("rope.tool", {{"name", "glue"}}),
              "rope.tool: name must be one of move, pin, cut, got \"glue\"");
    EXPECT_EQ(refused("rope.preset", {{"name", "anchor"}}).substr(0, 41),
              "rope.preset: name must be one of drape, b");
}

TEST_F(RopeRefusals, AKindOfColliderTakesWhatItHas) {
    EXPECT_EQ(refused("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}}),
              "rope.collider.add: radius is missing; a sphere needs it");
    EXPECT_EQ(
        refused("rope.collider.add",
                {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}, {"normal", right}}),
        "rope.collider.add: a sphere has no normal");
    EXPECT_EQ(
        refused("rope.collider.add", {{"name", "s"}, {"kind", "capsule"}, {"a", origin}, {"radius", 1}}),
        "rope.collider.add: b is missing; a capsule needs it");
    EXPECT_EQ(refused("rope.collider.add", {{"name", "s"}, {"kind", "plane"}, {"normal", right}}),
              "rope.collider.add: point is missing; a plane needs it");
    EXPECT_EQ(refused("rope.collider.add", {{"name", "s"}, {"kind", "box"}, {"centre", origin}}),
              "rope.collider.add: half_extents is missing; a box needs it");
    EXPECT_EQ(refused("rope.collider.add", {{"name", "s"},
                                            {"kind", "box"},
                                            {"centre", origin},
                                            {"half_extents", right},
                                            {"rotation", {1, 1, 1, 1}}}),
              "rope.collider.add: rotation must be a quaternion [x, y, z, w] of length 1, got [1,1,1,1]");
    EXPECT_NE(refused("rope.collider.add",
                      {{"name", "ground"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}})
                  .find("no other collider"),
              std::string::npos);
    EXPECT_EQ(
        refused("rope.collider.add", {{"name", ""}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}}),
        "rope.collider.add: name must not be empty");
    refused("rope.collider.add", {{"name", "p"}, {"kind", "plane"}, {"point", origin}, {"normal", origin}});
    refused("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", -1}});
    refused("rope.collider.add", {{"name", "s"}, {"kind", "torus"}});
}

TEST_F(RopeRefusals, AColliderIsGivenWhatItsKindHas) {
    run("rope.preset", {{"name", "drape"}});
    EXPECT_EQ(refused("rope.collider.set", {{"name", "x"}, {"radius", 1}}),
              "rope.collider.set: there is no collider \"x\"");
    EXPECT_EQ(refused("rope.collider.set", {{"name", "ball"}, {"half_extents", right}}),
              "rope.collider.set: a sphere has no half_extents");
    refused("rope.collider.set", {{"name", "ball"}, {"radius", -0.5}});
    refused("rope.collider.set", {{"name", "ground"}, {"normal", origin}});
}

TEST_F(RopeRefusals, WhatWouldTakeTooLongIsRefusedWithItsSize) {
    single_rope(8000);
    EXPECT_EQ(refused("rope.settings", {{"iterations", 10'000}}),
              "rope.settings: a substep of 8000 links and 10000 iterations would take 80008001 steps; the "
              "most is 50000000");
    run("rope.settings", {{"iterations", 6000}});
    refused("rope.add", {{"from", origin}, {"to", right}, {"segments", 1000}});
}

TEST_F(RopeRefusals, TooManyAreRefusedWithTheNumberAndTheLimit) {
    single_rope(8);
    EXPECT_EQ(refused("rope.add", {{"from", origin}, {"to", right}, {"segments", 10'000'000}}),
              "rope.add: segments must be 1 to 99999, got 10000000");
    EXPECT_EQ(refused("rope.add", {{"from", origin}, {"to", right}, {"segments", 99'999}}),
              "rope.add: that would make 100009 particles; the most is 100000");
    EXPECT_EQ(refused("rope.cloth.add", {{"corner", origin},
                                         {"along", right},
                                         {"down", {0, 1, 0}},
                                         {"columns", 100'000},
                                         {"rows", 100'000}}),
              "rope.cloth.add: that would make 10000000009 particles; the most is 100000");
    EXPECT_EQ(refused("rope.hair.add", {{"centre", origin}, {"strands", 10'000}, {"segments", 9}}),
              "rope.hair.add: that would make 100009 particles; the most is 100000");
    run("rope.clear");
    for (std::size_t i = 0; i < max_lab_colliders; ++i)
        run("rope.collider.add",
            {{"name", std::to_string(i)}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}});
    EXPECT_EQ(
        refused("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}}),
        "rope.collider.add: that would make 1001 colliders; the most is 1000");
}

TEST_F(RopeRefusals, WhatDoesNotGoTogether) {
    single_rope(8);
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    EXPECT_EQ(refused("rope.hold", {{"rope", "rope"}, {"particle", 0}, {"at", origin}}),
              "rope.hold: particle 0 of \"rope\" is pinned; rope.pin moves it");
    EXPECT_EQ(refused("rope.select", {{"rope", "rope"}}),
              "rope.select: particle is missing (a whole number)");
    EXPECT_EQ(refused("rope.select", {{"particle", 0}}), "rope.select: rope is missing (a text)");
    EXPECT_EQ(refused("rope.select", {{"rope", "rope"}, {"particle", 0}, {"collider", "x"}}),
              "rope.select: a particle or a collider can be selected, not both");
    EXPECT_EQ(refused("rope.hair.add"),
              "rope.hair.add: centre is missing, or a collider to attach the hair to");
    EXPECT_EQ(refused("rope.hair.add", {{"attach", "x"}}), "rope.hair.add: there is no collider \"x\"");
    EXPECT_EQ(refused("rope.hair.add", {{"centre", origin}, {"direction", origin}}),
              "rope.hair.add: hair: direction must be of some finite length, got 0");
    refused("rope.add", {{"from", origin}, {"to", right}, {"name", "rope"}});
    run("rope.cloth.add",
        {{"corner", origin}, {"along", right}, {"down", {0, 1, 0}}, {"columns", 3}, {"rows", 3}});
    refused("rope.cut", {{"rope", "cloth"}, {"segment", 0}});
    run("rope.collider.add", {{"name", "far"}, {"kind", "sphere"}, {"centre", {9e8, 0, 0}}, {"radius", 1}});
    EXPECT_EQ(refused("rope.collider.swing", {{"name", "far"}, {"by", {9e8, 0, 0}}}),
              "rope.collider.swing: its swing would reach farther than 1e9 m");
    refused("rope.collider.swing", {{"name", "far"}, {"by", right}, {"period", 0}});
}

TEST_F(RopeRefusals, NumbersThatAreNone) {
    single_rope(8);
    const double nan = std::nan(""), inf = HUGE_VAL;
    for (const double bad : {nan, inf, -inf, 1e10}) {
        refused("rope.add", {{"from", {0, bad, 0}}, {"to", right}});
        refused("rope.add", {{"from", origin}, {"to", right}, {"length", bad}});
        refused("rope.add", {{"from", origin}, {"to", right}, {"radius", bad}});
        refused("rope.pin", {{"rope", "rope"}, {"particle", bad}});
        refused("rope.pin", {{"rope", "rope"}, {"particle", 0}, {"at", {bad, 0, 0}}});
        refused("rope.hold", {{"rope", "rope"}, {"particle", 0}, {"at", {bad, 0, 0}}});
        refused("rope.collider.add",
                {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", bad}});
        refused("rope.collider.add", {{"name", "s"},
                                      {"kind", "box"},
                                      {"centre", origin},
                                      {"half_extents", right},
                                      {"rotation", {bad, 0, 0}}});
        for (const char* setting :
             {"substep", "iterations", "damping", "gravity", "gravity_scale", "compliance", "friction"})
            refused("rope.settings", {{setting, bad}});
        refused("rope.settings", {{"gravity", {0, bad, 0}}});
        refused("rope.settings", {{"external", {0, bad, 0}}});
        refused("rope.jitter", {{"dial", bad}});
        refused("time.speed", {{"factor", bad}});
    }
    for (const Json& bad : {Json(1.5), Json("0"), Json(nullptr), Json::array(), Json(true)}) {
        refused("rope.pin", {{"rope", "rope"}, {"particle", bad}});
        refused("rope.cut", {{"rope", "rope"}, {"segment", bad}});
    }
}

}  // namespace
}  // namespace tendril::app
