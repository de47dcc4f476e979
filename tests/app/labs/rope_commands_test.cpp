// The Rope lab's commands: their effects, and --state.
#include <array>

#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeCommands : public RopeTest {};

TEST_F(RopeCommands, AddMakesARopeStraightOrHanging) {
    run("rope.clear");
    run("rope.add", {{"from", {0, 1, 0}}, {"to", {2, 1, 0}}});
    Json slack{{"segments", 10}, {"length", 1.5}, {"radius", 0.05}, {"pin_start", true}, {"pin_end", true}};
    add_rope("slack", {0, 1, 1}, {1, 1, 1}, slack);
    const Json ropes = state().at("ropes");
    ASSERT_EQ(ropes.size(), 2u);
    EXPECT_EQ(ropes[0]["name"], "rope");
    EXPECT_EQ(ropes[0]["particles"].size(), 33u);
    EXPECT_NEAR(ropes[0]["length"].get<double>(), 2.0, 1e-6);
    EXPECT_EQ(ropes[0]["particles"][16]["position"], Json::array({1.0, 1.0, 0.0}));
    EXPECT_EQ(ropes[0]["particles"][0]["pinned"], false);
    EXPECT_EQ(ropes[1]["name"], "slack");
    EXPECT_EQ(ropes[1]["particles"][0]["pinned"], true);
    EXPECT_EQ(ropes[1]["particles"][5]["pinned"], false);
    EXPECT_EQ(ropes[1]["particles"][10]["pinned"], true);
    EXPECT_NEAR(ropes[1]["length"].get<double>(), 1.5, 1e-5);
    EXPECT_LT(ropes[1]["particles"][5]["position"][1].get<double>(), 0.6);
    EXPECT_EQ(world().find("slack")->radius, 0.05f);
    EXPECT_TRUE(ropes[0].contains("energy"));
    EXPECT_EQ(ropes[0]["stretch"], 0.0) << "the material's; as_solved is measured";
}

TEST_F(RopeCommands, PinMovesAParticleInOneTickAndUnpinLetsItFall) {
    single_rope();
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 8}, {"at", {0.9, 2.1, 0}}});
    EXPECT_NEAR(world().position(8).x, 1.0f, 1e-6f) << "it goes there while time passes";
    wait(1);
    EXPECT_NEAR(glm::distance(world().position(8), {0.9f, 2.1f, 0}), 0.0f, 1e-6f);
    wait(60);
    EXPECT_NEAR(glm::distance(world().position(0), {0, 2, 0}), 0.0f, 1e-6f);
    run("rope.unpin", {{"rope", "rope"}, {"particle", 8}});
    wait(30);
    EXPECT_LT(world().position(8).y, 1.9f);
    const std::size_t history = workspace.history.size();
    run("rope.unpin", {{"rope", "rope"}, {"particle", 8}});
    EXPECT_EQ(workspace.history.size(), history) << "what changes nothing leaves no step";
}

TEST_F(RopeCommands, CutSplitsARopeAndTheSelectionFollows) {
    single_rope(10);
    run("rope.select", {{"rope", "rope"}, {"particle", 7}});
    run("rope.cut", {{"rope", "rope"}, {"segment", 4}});
    ASSERT_EQ(state().at("ropes").size(), 2u);
    EXPECT_EQ(state().at("ropes")[0]["particles"].size(), 5u);
    EXPECT_EQ(state().at("ropes")[1]["particles"].size(), 6u);
    const Json chosen{{"rope", "rope 2"}, {"particle", 2}, {"particles", {2}}};
    EXPECT_EQ(state().at("selected"), chosen);
    run("rope.remove", {{"name", "rope 2"}});
    EXPECT_EQ(state().at("selected"), nullptr);
    EXPECT_EQ(state().at("ropes").size(), 1u);
}

TEST_F(RopeCommands, AColliderIsChangedInPlace) {
    run("rope.clear");
    run("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", {5, 5, 5}}, {"radius", 0.25}});
    run("rope.collider.set", {{"name", "s"}, {"radius", 0.5}});
    const auto now = [&] { return state().at("colliders")[0]; };
    EXPECT_EQ(now()["radius"], 0.5);
    EXPECT_EQ(now()["centre"], Json::array({5.0, 5.0, 5.0}));
    const std::size_t steps = workspace.history.size();
    run("rope.collider.set", {{"name", "s"}, {"radius", 0.5}});
    EXPECT_EQ(workspace.history.size(), steps) << "nothing changed";
    run("rope.collider.swing", {{"name", "s"}, {"by", {1, 0, 0}}});
    run("rope.collider.set", {{"name", "s"}, {"centre", {0, 3, 0}}});
    EXPECT_EQ(part().swings[0].middle, glm::vec3(0, 3, 0)) << "it swings on about the new place";
    run("rope.collider.add",
        {{"name", "b"}, {"kind", "box"}, {"centre", {0, 1, 0}}, {"half_extents", {1, 2, 3}}});
    run("rope.collider.set", {{"name", "b"}, {"rotation", {0, 0, 90}}});
    EXPECT_NEAR(std::get<rope::Box>(world().find_collider("b")->shape).rotation.z, std::sqrt(0.5f), 1e-6f);
    run("rope.collider.remove", {{"name", "b"}});
    EXPECT_EQ(state().at("colliders").size(), 1u);
}

TEST_F(RopeCommands, AColliderSwingsAboutItsMiddleAndNeverJumps) {
    run("rope.clear");
    run("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", {1, 2, 0}}, {"radius", 0.2}});
    const auto centre = [&] { return rope::centre(world().find_collider("s")->shape); };
    wait(7);
    run("rope.collider.swing", {{"name", "s"}, {"by", {0.5, 0, 0}}, {"period", 1}});
    glm::vec3 last = centre();
    float low = 9.0f, high = -9.0f;
    for (int i = 0; i < 240; ++i) {
        if (i == 100) run("rope.collider.swing", {{"name", "s"}, {"by", {0.3, 0, 0}}});
        wait(1);
        EXPECT_LT(glm::distance(centre(), last), 0.07f) << i;
        last = centre();
        if (i < 60) low = std::min(low, last.x), high = std::max(high, last.x);
    }
    EXPECT_NEAR(high - low, 1.0f, 0.01f);
    EXPECT_NEAR(part().swings[0].period, 1.0f, 0.0f) << "kept when left out";
    run("rope.collider.move", {{"name", "s"}, {"to", {5, 2, 0}}});
    wait(1);
    EXPECT_LT(glm::distance(centre(), {5, 2, 0}), 0.05f);
    run("rope.collider.swing", {{"name", "s"}, {"by", {0, 0, 0}}});
    EXPECT_TRUE(part().swings.empty());
    wait(2);
    last = centre();
    wait(30);
    EXPECT_EQ(centre(), last);
}

TEST_F(RopeCommands, AClothHasAMaterial) {
    run("rope.clear");
    const auto add = [&](Json more) {
        more.update(
            {{"corner", {0, 2, 0}}, {"along", {1, 0, 0}}, {"down", {0, -1, 0}}, {"columns", 4}, {"rows", 4}});
        run("rope.cloth.add", more);
        const rope::State& now = world().state();
        float shear = 0.0f, bend = 0.0f;
        for (const rope::Link& link : now.links) {
            if (link.a < now.bodies.back().first) continue;
            if (link.kind == rope::Link::Kind::Shear) shear = link.compliance;
            if (link.kind == rope::Link::Kind::Bend) bend = link.compliance;
        }
        return std::array<double, 3>{now.mass[now.bodies.back().first], static_cast<double>(shear),
                                     static_cast<double>(bend)};
    };
    const auto plain = add({}), cotton = add({{"material", "cotton"}}), silk = add({{"material", "silk"}}),
               stiff = add({{"material", "silk"}, {"shear", 0.01}});
    EXPECT_EQ(plain, cotton) << "what it is of when left out";
    EXPECT_LT(silk[0], cotton[0]);
    EXPECT_GT(silk[1], cotton[1]);
    EXPECT_GT(silk[2], cotton[2]);
    EXPECT_FLOAT_EQ(static_cast<float>(stiff[1]), 0.01f) << "what is given counts";
    EXPECT_EQ(stiff[0], silk[0]);
}

TEST_F(RopeCommands, SheetsAndLocks) {
    run("rope.clear");
    add_cloth("cloth", {0, 2, 0}, {1, 0, 0}, {0, -1, 0}, 5, 4, "corners");
    run("rope.collider.add", {{"name", "head"}, {"kind", "sphere"}, {"centre", {5, 2, 0}}, {"radius", 0.5}});
    run("rope.hair.add", {{"attach", "head"}, {"strands", 20}, {"segments", 6}, {"spread", 0.6}});
    run("rope.hair.add", {{"name", "tuft"}, {"centre", {9, 2, 0}}, {"strands", 3}, {"segments", 4}});
    ASSERT_EQ(state().at("cloths").size(), 1u);
    EXPECT_EQ(state().at("cloths")[0]["particles"].size(), 20u);
    EXPECT_EQ(state().at("cloths")[0]["particles"][4]["pinned"], true);
    ASSERT_EQ(state().at("hair").size(), 2u);
    EXPECT_EQ(state().at("hair")[0]["particles"].size(), 140u);
    for (int strand = 0; strand < 20; ++strand) {
        const glm::vec3 root =
            world().position(world().particle("hair", static_cast<std::size_t>(7 * strand)));
        EXPECT_NEAR(glm::distance(root, {5, 2, 0}), 0.504f, 1e-4f);
        EXPECT_GT(root.y, 2.0f) << "it grows on top";
    }
    run("rope.collider.move", {{"name", "head"}, {"to", {6, 2, 0}}});
    wait(2);
    EXPECT_NEAR(glm::distance(world().position(world().particle("hair", 0)), {6, 2, 0}), 0.504f, 1e-3f);
}

TEST_F(RopeCommands, ReleaseLetsGoAndADragIsOneStep) {
    single_rope();
    const std::size_t history = workspace.history.size();
    const glm::vec3 was = world().position(4);
    run("rope.hold", {{"rope", "rope"}, {"particle", 4}, {"at", {0.5, 2.2, 0}}}, 7);
    wait(1);
    EXPECT_NEAR(glm::distance(world().position(4), {0.5f, 2.2f, 0}), 0.0f, 1e-6f);
    run("rope.hold", {{"rope", "rope"}, {"particle", 5}, {"at", {0.6, 2.2, 0}}}, 7);
    EXPECT_FALSE(world().pinned(4)) << "one hand holds one particle";
    EXPECT_TRUE(world().pinned(5));
    EXPECT_EQ(state().at("held")["particle"], 5);
    run("rope.let_go");
    EXPECT_FALSE(world().pinned(5));
    run("rope.let_go");
    EXPECT_EQ(workspace.history.size(), history + 1) << "letting go is none";
    run("undo");
    EXPECT_EQ(world().position(4), was);
    run("rope.hold", {{"rope", "rope"}, {"particle", 4}, {"at", {0.5, 2.2, 0}}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 4}});
    run("rope.let_go");
    EXPECT_TRUE(world().pinned(4)) << "pinned meanwhile, it stays so";
}

TEST_F(RopeCommands, WhilePausedARopeFollowsADrag) {
    single_rope(20);
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    wait(30);
    run("time.pause");
    const double length_error = world().length_error();
    const glm::vec3 fast = world().velocity(12);
    const std::uint64_t substeps = world().state().substeps;
    run("rope.hold", {{"rope", "rope"}, {"particle", 20}, {"at", {0.3, 2.5, 0.2}}});
    EXPECT_NEAR(glm::distance(world().position(20), {0.3f, 2.5f, 0.2f}), 0.0f, 1e-6f);
    EXPECT_LT(world().length_error(), std::max(length_error, 0.01)) << "all of it came along";
    EXPECT_EQ(world().velocity(12), fast) << "and none of it was set in motion";
    EXPECT_EQ(world().state().substeps, substeps);
    EXPECT_NEAR(static_cast<double>(part().samples.back().error), world().length_error(), 1e-6);

    run("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", {0, 5, 0}}, {"radius", 0.2}});
    run("rope.collider.move", {{"name", "s"}, {"to", point(world().position(10))}});
    for (std::size_t i = 1; i < 20; ++i)
        EXPECT_GT(
            rope::surface_distance(world().find_collider("s")->shape, world().state().position[i]).distance,
            0.019)
            << i;
}

TEST_F(RopeCommands, WhilePausedOnlyDraggedThingsMove) {
    run("rope.preset", {{"name", "drape"}});
    run("rope.settings", {{"solver", "xpbd"}, {"compliance", 0.01}});
    run("rope.collider.swing", {{"name", "bar"}, {"by", {0, 0, 0.5}}});
    wait(50);
    run("rope.collider.move", {{"name", "ball"}, {"to", {-0.6, 1.2, 0}}});
    run("time.pause");
    const rope::State was = world().state();
    EXPECT_GT(world().length_error(), 0.01) << "it is stretched";
    run("rope.hold", {{"rope", "short 1"}, {"particle", 36}, {"at", {1.6, 1.5, -0.5}}});
    const rope::State& now = world().state();
    const rope::Body& dragged = *world().find("short 1");
    for (std::size_t i = 0; i < world().size(); ++i) {
        if (i >= dragged.first && i < dragged.first + dragged.count) continue;
        ASSERT_LT(glm::distance(now.position[i], was.position[i]), 1e-5) << i;
    }
    for (std::size_t i = 0; i < was.colliders.size(); ++i) {
        EXPECT_EQ(now.colliders[i].shape, was.colliders[i].shape);
        EXPECT_EQ(now.colliders[i].goal, was.colliders[i].goal);
        EXPECT_EQ(now.colliders[i].seconds, was.colliders[i].seconds);
    }
    ASSERT_EQ(now.links.size(), was.links.size());
    for (std::size_t i = 0; i < was.links.size(); ++i) EXPECT_EQ(now.links[i].rest, was.links[i].rest);
    EXPECT_EQ(now.settings, was.settings);

    run("rope.collider.set", {{"name", "ball"}, {"radius", 0.5}});
    const rope::Shape& ball = world().find_collider("ball")->shape;
    for (std::size_t i = 1; i < 80; ++i)
        EXPECT_GT(rope::surface_distance(ball, world().state().position[i]).distance, 0.019) << i;
}

TEST_F(RopeCommands, TheSelectionIsRemoved) {
    single_rope();
    EXPECT_EQ(refused("rope.remove_selected"), "rope.remove_selected: nothing is selected");
    run("rope.collider.add", {{"name", "s"}, {"kind", "sphere"}, {"centre", {0, 5, 0}}, {"radius", 0.2}});
    run("rope.select", {{"collider", "s"}});
    run("rope.remove_selected");
    EXPECT_EQ(world().find_collider("s"), nullptr);
    EXPECT_FALSE(part().selection);
    run("rope.select", {{"rope", "rope"}, {"particle", 3}});
    run("rope.remove_selected");
    EXPECT_EQ(world().size(), 0u);
}

TEST_F(RopeCommands, ViewSettingsAreNoUndoStepsAndAreKept) {
    run("rope.tool", {{"name", "cut"}});
    run("rope.view", {{"strain", true}, {"sides", 24}});
    run("rope.view", {{"particles", true}});
    run("rope.select", {{"collider", "ball"}});
    EXPECT_EQ(workspace.history.size(), 0u);
    EXPECT_FALSE(workspace.modified());
    EXPECT_EQ(part().tool, RopeTool::Cut);
    EXPECT_EQ(part().view, (RopeView{.particles = true, .strain = true, .sides = 24}));
    EXPECT_EQ(state().at("selected"), (Json{{"collider", "ball"}}));
    run("rope.select");
    EXPECT_EQ(state().at("selected"), nullptr);
    run("rope.preset", {{"name", "cloth"}});
    EXPECT_EQ(part().view.sides, 24);
    run("rope.reset");
    EXPECT_EQ(part().view, RopeView{});
    EXPECT_EQ(state().at("ropes").size(), 4u);
}

}  // namespace
}  // namespace tendril::app
