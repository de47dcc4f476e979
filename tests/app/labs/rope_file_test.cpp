// The Rope lab in scene files: bit for bit, and faults with their position.
#include <bit>
#include <random>

#include "app/document/json_complete.hpp"
#include "app/labs/rope/scenes.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/program.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::message_of;

class RopeFile : public RopeTest {
  protected:
    /// Loads a part and returns the message of the fault.
    std::string wrong(const Json& json) const {
        return message_of([&] { part().load(json, "labs.rope"); });
    }
    /// The saved part with one value changed.
    std::string wrong_with(const char* place, const Json& value) const {
        Json json = part().save();
        json[Json::json_pointer(place)] = value;
        return wrong(json);
    }
};

/// Of a race too, where each world holds particles of its own.
TEST_F(RopeFile, WhatADragHoldsIsHeldAfterwards) {
    single_rope();
    run("rope.race");
    run("rope.hold", {{"rope", "rope"}, {"particle", 4}, {"at", {0.5, 2.2, 0}}});
    const auto loaded = std::dynamic_pointer_cast<RopePart>(part().load(part().save(), ""));
    EXPECT_EQ(loaded->hold, part().hold);
    EXPECT_EQ(loaded->rivals[1].hold, part().hold);
    EXPECT_TRUE(loaded->world->pinned(4));
    EXPECT_TRUE(has(wrong_with("/held/rope", "x"), "labs.rope.held.rope: there is no rope \"x\""));
    EXPECT_TRUE(has(wrong_with("/held/particles", {4, 4}), "labs.rope.held.particles: expected ascending"));
    EXPECT_TRUE(has(wrong_with("/held/particles/0", 3), "labs.rope.held.particles.0: it is not pinned"));
}

TEST_F(RopeFile, ParticlesAreCompactRows) {
    single_rope(2);
    EXPECT_EQ(part().save()["world"]["particles"][1].size(), 4u) << "what never moved is short";
    run("rope.reset");
    wait(3);
    const std::string text = json_to_text(save_scene(workspace));
    std::size_t longest = 0, line = 0;
    for (const char c : text) longest = std::max(longest, line = c == '\n' ? 0 : line + 1);
    EXPECT_GT(longest, 100u) << "a row stands on one line";
}

TEST_F(RopeFile, SizesAreRefusedWithTheLimit) {
    Json json = part().save();
    const Json row = Json::array({0.0, 0.0, 0.0, 1.0});
    json["world"]["particles"] = Json(100'001, row);
    EXPECT_TRUE(test::says(wrong(json), "labs.rope.world.particles 100001 particles 100000"));
    json = part().save();
    json["world"]["colliders"] = Json(1001, json["world"]["colliders"][0]);
    EXPECT_TRUE(test::says(wrong(json), "labs.rope.world.colliders 1001 colliders 1000"));
}

TEST_F(RopeFile, WhatIsWrongIsToldWithItsPlace) {
    single_rope(4);
    run("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", {0, 0, 0}}, {"radius", 1}});
    run("rope.collider.swing", {{"name", "s"}, {"by", {2e8, 0, 0}}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    EXPECT_EQ(wrong(part().save()), "");
    EXPECT_TRUE(test::says(wrong(Json::array()), "labs.rope object []"));
    const std::vector<std::tuple<const char*, Json, const char*>> bad{
        {"/time", -1, "labs.rope.time: expected a number from 0 to 1000000000, found -1"},
        {"/tool", "glue", "labs.rope.tool: unknown tool \"glue\""},
        {"/view/sides", 2, "labs.rope.view.sides: expected a whole number from 3 to 64, found 2"},
        {"/jitter/dial", 2, "labs.rope.jitter.dial: expected a number from 0 to 1, found 2"},
        {"/jitter/frames", -1, "labs.rope.jitter.frames: expected a whole number from 0 to"},
        {"/selected", {{"collider", "x"}}, "labs.rope.selected.collider: there is no collider \"x\""},
        {"/selected", {{"rope", "x"}, {"particle", 0}}, "labs.rope.selected.rope: there is no rope \"x\""},
        {"/selected", {{"rope", "rope"}, {"particle", 5}}, "labs.rope.selected.particle: expected a whole"},
        {"/swings/0/collider", "x", "labs.rope.swings.0.collider: there is no collider \"x\""},
        {"/swings/0/period", 0, "labs.rope.swings.0.period: expected a number from 0.1 to 600, found 0"},
        {"/swings/0/middle", {9e8, 0, 0}, "labs.rope.swings.0: its swing would reach farther than 1e9 m"},
        {"/world/particles/2", {1, 2, 3}, "labs.rope.world.particles.2: expected a row of 4 or 7 numbers"},
        {"/world/particles/2/1", "y", "labs.rope.world.particles.2: expected a number, found \"y\""},
        {"/world/particles/2/3", 0, "labs.rope.world: World: mass[2] must be over 0"},
        {"/world/links/1/0", 5, "labs.rope.world.links.1: expected a whole number from 0 to 4, found 5"},
        {"/world/links/1/3", "glue", "labs.rope.world.links.1: unknown kind \"glue\""},
        {"/world/bodies/0/kind", "goo", "labs.rope.world.bodies.0.kind: unknown kind \"goo\""},
        {"/world/bodies/0/count", 4, "labs.rope.world: World: "},
        {"/world/pins/0/particle", 5, "labs.rope.world.pins.0.particle: expected a whole number"},
        {"/world/pins/0/goal", 5, "labs.rope.world.pins.0.goal: expected a point"},
        {"/world/colliders/0/kind", "blob", "labs.rope.world.colliders.0.kind: unknown kind \"blob\""},
        {"/world/colliders/0/radius", -1, "labs.rope.world.colliders.0.radius: expected a number"},
        {"/world/settings/substep", 1, "labs.rope.world.settings.substep: expected a number"},
        {"/world/remainder", -1, "labs.rope.world.remainder: expected a number from 0 to 10"},
        {"/world/substeps", 1.5, "labs.rope.world.substeps: expected a whole number from 0 to"},
    };
    for (const auto& [place, value, reason] : bad)
        EXPECT_TRUE(has(wrong_with(place, value), reason)) << place << ": " << wrong_with(place, value);
}

}  // namespace
}  // namespace tendril::app
