// The Rope lab in scene files: bit for bit, and faults with their position.
#include "tests/app/labs/rope_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeFile : public RopeTest {};

/// Also in a race, where each world holds its own particles.
TEST_F(RopeFile, ADraggedParticleIsStillHeldAfterLoading) {
    single_rope();
    run("rope.race");
    run("rope.hold", {{"rope", "rope"}, {"particle", 4}, {"at", {0.5, 2.2, 0}}});
    const auto loaded = std::dynamic_pointer_cast<RopePart>(part().load(part().save(), ""));
    EXPECT_EQ(loaded->hold, part().hold);
    EXPECT_EQ(loaded->rivals[1].hold, part().hold);
    EXPECT_TRUE(loaded->world->pinned(4));
    expect_scene_refused("/held/rope", "x", "labs.rope.held.rope: there is no rope \"x\"");
    expect_scene_refused("/held/particles", {4, 4}, "labs.rope.held.particles: expected ascending");
    expect_scene_refused("/held/particles/0", 3, "labs.rope.held.particles.0: it is not pinned");
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

TEST_F(RopeFile, AFaultHasItsPath) {
    const std::tuple<const char*, Json, const char*> all[] = {
        {"/world/drift", nullptr, "labs.rope.world.drift"},
        {"/world/colliders/1/kind", "blob", "labs.rope.world.colliders.1.kind"},
        {"/world/colliders/1/name", "ground", "labs.rope.world.colliders.1.name"},
        {"/world/bodies/0/kind", "chain", "labs.rope.world.bodies.0.kind"},
        {"/world/collisions", Json::parse(R"([["rope", "x"]])"),
         "labs.rope.world.collisions.0.1: there is no body \"x\""},
        {"/world/collisions", Json::parse("[[7]]"), "labs.rope.world.collisions.0: expected a list of 2"},
        {"/world/bodies/0/colour", "red", "labs.rope.world.bodies.0.colour"},
        {"/world/pins/0/collider", "x", "labs.rope.world.pins.0.collider: there is no collider \"x\""},
        {"/world/pins/0/particle", 99'999, "labs.rope.world: "},
        {"/world/substeps", -1, "labs.rope.world.substeps"},
        {"/jitter/frames", 4294967296.0, "labs.rope.jitter.frames"}};
    for (const auto& [pointer, value, place] : all) expect_scene_refused(pointer, value, place);
}

TEST_F(RopeFile, SizesAreRefusedWithTheLimit) {
    const Json row = Json::array({0.0, 0.0, 0.0, 1.0}), collider = saved()["world"]["colliders"][0];
    EXPECT_TRUE(test::says(opened_with("/world/particles", Json(100'001, row)),
                           "labs.rope.world.particles 100001 particles 100000"));
    EXPECT_TRUE(test::says(opened_with("/world/colliders", Json(1001, collider)),
                           "labs.rope.world.colliders 1001 colliders 1000"));
}

}  // namespace
}  // namespace tendril::app
