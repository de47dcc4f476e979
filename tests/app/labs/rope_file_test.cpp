// The Rope lab in scene files: bit for bit, and faults with their position.
#include "app/fields/fields.hpp"
#include "tests/app/labs/rope_support.hpp"

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

// Refusals of the Rope lab's commands: their messages, and that nothing changes.

class RopeRefusals : public RopeTest {};

const Json origin = Json::array({0, 0, 0}), right = Json::array({1, 0, 0});

TEST_F(RopeRefusals, AColliderTakesTheArgumentsOfItsKindAndNeedsThem) {
    run("rope.clear");
    const Field& shape = fields<rope::Collider>().front();
    std::vector<Json> usual;
    for (const FieldKind& kind : shape.kinds) usual.push_back(save_fields({kind.table(), kind.fresh()}));
    for (std::size_t i = 0; i < usual.size(); ++i) {
        const std::string kind = shape.choices[i];
        Json made{{"name", kind}, {"kind", kind}};
        made.update(usual[i]);
        for (const Field& field : shape.kinds[i].table()) {
            Json without = made;
            without.erase(field.name);
            if (field.required)
                refuses("rope.collider.add", without,
                        "rope.collider.add " + std::string(field.name) + " missing " + kind);
        }
        run("rope.collider.add", made);
        refuses("rope.collider.add", made, "rope.collider.add no other collider " + kind);
        for (const Json& other : usual)
            for (const auto& [name, value] : other.items())
                if (!usual[i].contains(name))
                    refuses("rope.collider.set", {{"name", kind}, {name, value}},
                            "rope.collider.set " + kind + " no " + name);
    }
    refuses("rope.collider.add", {{"name", ""}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
            "rope.collider.add name empty");
    refuses("rope.collider.set", {{"name", "x"}, {"radius", 1}}, "rope.collider.set no collider x");
    refused("rope.collider.set", {{"name", "plane"}, {"normal", origin}});
}

TEST_F(RopeRefusals, ScenesThatWouldTakeTooLongAreRefusedWithTheirSize) {
    single_rope(8000);
    refuses("rope.settings", {{"iterations", 10'000}},
            "rope.settings 8000 links 10000 iterations 80008001 50000000");
    run("rope.settings", {{"iterations", 6000}});
    refused("rope.add", {{"from", origin}, {"to", right}, {"segments", 1000}});
}

TEST_F(RopeRefusals, TooManyAreRefusedWithTheNumberAndTheLimit) {
    single_rope(8);
    refuses("rope.add", {{"from", origin}, {"to", right}, {"segments", 99'999}},
            "rope.add 100009 particles 100000");
    refuses(
        "rope.cloth.add",
        {{"corner", origin}, {"along", right}, {"down", {0, 1, 0}}, {"columns", 100'000}, {"rows", 100'000}},
        "rope.cloth.add 10000000009 particles 100000");
    refuses("rope.hair.add", {{"centre", origin}, {"strands", 10'000}, {"segments", 9}},
            "rope.hair.add 100009 particles 100000");
    run("rope.clear");
    for (std::size_t i = 0; i < max_lab_colliders; ++i)
        run("rope.collider.add",
            {{"name", std::to_string(i)}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}});
    refuses("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", origin}, {"radius", 1}},
            "rope.collider.add 1001 colliders 1000");
}

TEST_F(RopeRefusals, IncompatibleArguments) {
    single_rope(8);
    refuses("rope.select", {{"particle", 0}}, "rope.select rope missing text");
    refuses("rope.select", {{"rope", "rope"}, {"particle", 0}, {"collider", "x"}},
            "rope.select particle collider both");
    refuses("rope.hair.add", Json::object(), "rope.hair.add centre missing collider");
    refuses("rope.hair.add", {{"attach", "x"}}, "rope.hair.add no collider x");
    refuses("rope.hair.add", {{"centre", origin}, {"direction", origin}},
            "rope.hair.add direction finite length 0");
    refused("rope.add", {{"from", origin}, {"to", right}, {"name", "rope"}});
    add_cloth("cloth", origin, right, {0, 1, 0}, 3, 3);
    refused("rope.cut", {{"rope", "cloth"}, {"segment", 0}});
    run("rope.collider.add", {{"name", "far"}, {"kind", "sphere"}, {"centre", {9e8, 0, 0}}, {"radius", 1}});
    refuses("rope.collider.swing", {{"name", "far"}, {"by", {9e8, 0, 0}}}, "rope.collider.swing 1e9 m");
}

}  // namespace
}  // namespace tendril::app
