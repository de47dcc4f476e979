// Editing the material of ropes, cloth and hair while they hang.
#include "app/document/json_place.hpp"
#include "app/labs/kit/world_file.hpp"
#include "app/labs/rope/code.hpp"
#include "app/labs/rope/rope_fields.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/panel_text.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RopeSet : public LabTest {
  protected:
    RopeSet() : LabTest(rope_lab) {
        run("rope.clear");
        run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", 16}, {"pin_start", true}});
        run("rope.cloth.add", {{"corner", {3, 2, 0}},
                               {"along", {1, 0, 0}},
                               {"down", {0, -1, 0}},
                               {"columns", 8},
                               {"rows", 8},
                               {"pins", "corners"}});
        run("rope.hair.add", {{"centre", {6, 2, 0}}, {"strands", 3}, {"segments", 8}});
        tick(120);
    }
    const NamedWorld& world() const { return *rope_part(workspace).world; }
    BodySettings made_of(const char* body) const { return settings_of(world(), *world().find(body)); }
    double lowest() const {
        double low = 10.0;
        for (const glm::dvec3& each : world().state().position) low = std::min(low, each.y);
        return low;
    }
    void tick(int count) {
        for (int i = 0; i < count; ++i) lab().step(workspace);
    }
};

TEST_F(RopeSet, ChangesWhatABodyIsMadeOf) {
    run("rope.set", {{"rope", "rope"}, {"length", 1.5}, {"mass", 4}, {"radius", 0.1}, {"stretch", 1e-4}});
    BodySettings rope = made_of("rope");
    EXPECT_NEAR(rope.length, 1.5f, 1e-6f);
    EXPECT_NEAR(rope.mass, 4.0, 1e-12);
    EXPECT_EQ(rope.radius, 0.1f);
    EXPECT_NEAR(rope.stretch, 1e-4, 1e-9);
    run("rope.set", {{"rope", "cloth"}, {"shear", 0.5}, {"bend", 0.25}, {"tear", 2}});
    EXPECT_EQ(made_of("cloth").shear, 0.5f);
    EXPECT_EQ(made_of("cloth").bend, 0.25f);
    EXPECT_EQ(made_of("cloth").tear, 2.0f);
    run("rope.set", {{"rope", "hair"}, {"bend", 2}});
    EXPECT_EQ(made_of("hair").bend, 2.0f);
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_NEAR(made_of("rope").length, 1.0f, 1e-6f);
    EXPECT_EQ(made_of("hair").bend, rope::HairShape().bend);
}

/// A rope that is pinned by its first two particles stands out like a rod; a limp one hangs. Its file, its
/// copy in code and its past have the stiffness too.
TEST_F(RopeSet, ARopeResistsBending) {
    run("rope.clear");
    run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", 16}, {"pin_start", true}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 1}});
    EXPECT_EQ(made_of("rope").bending, 0.0f);
    run("rope.set", {{"rope", "rope"}, {"bending", 50}});
    EXPECT_EQ(made_of("rope").bending, 50.0f);
    tick(60);
    EXPECT_GT(lowest(), 1.9);
    run("rope.select", {{"rope", "rope"}});
    EXPECT_TRUE(test::says(test::PanelReader().inspector(lab(), workspace), "bending 50.0000 N"));
    const NamedWorld again = load_world(JsonPlace(save_world(world()), "world"));
    EXPECT_EQ(again.state().bodies.front().bending, 50.0f);
    EXPECT_TRUE(test::says(rope_code(rope_part(workspace)), ".bending"));
    run("rope.set", {{"rope", "rope"}, {"bending", 0}});
    EXPECT_EQ(made_of("rope").bending, 0.0f);
    tick(60);
    EXPECT_LT(lowest(), 1.5);
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"bending", -1}}), "rope.set bending -1"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"bend", 1}}), "rope.set rope bend"));
}

/// Mass follows length at constant density, and stretch is the material's.
TEST_F(RopeSet, TheMaterialStaysAsABodyGrows) {
    run("rope.set", {{"rope", "rope"}, {"density", 2}, {"stretch", 1e-3}});
    const double mass = made_of("rope").mass;
    run("rope.set", {{"rope", "rope"}, {"length", 3}, {"segments", 24}});
    const BodySettings rope = made_of("rope");
    EXPECT_NEAR(*rope.density, 2.0, 1e-6);
    EXPECT_NEAR(rope.mass, 3.0 * mass, 0.15 * mass);
    EXPECT_NEAR(rope.stretch, 1e-3, 1e-9);
    EXPECT_EQ(rope.segments, 24);
    EXPECT_EQ(rope.width.has_value() || rope.columns.has_value(), false);
    run("rope.set", {{"rope", "cloth"}, {"length", 2}, {"width", 0.5}, {"columns", 12}, {"rows", 5}});
    const BodySettings cloth = made_of("cloth");
    EXPECT_NEAR(cloth.length, 2.0, 1e-6);
    EXPECT_NEAR(*cloth.width, 0.5, 1e-6);
    EXPECT_EQ(cloth.columns, 12);
    EXPECT_EQ(cloth.rows, 5);
    EXPECT_NEAR(cloth.mass, 0.2, 1e-6);
    EXPECT_FALSE(cloth.segments);
    EXPECT_TRUE(world().pinned(world().find("cloth")->first + 11));
    for (int i = 0; i < 3; ++i) run("undo");
    EXPECT_EQ(made_of("cloth").columns, 8);
    EXPECT_NEAR(*made_of("rope").density, 1.0, 1e-6);
}

/// The selection stays on its particles, or the nearest to them.
TEST_F(RopeSet, TheSelectionFollowsItsParticles) {
    const auto selected = [&] { return rope_part(workspace).selection->particles.all(); };
    const auto active = [&] { return rope_part(workspace).selection->particle(); };
    run("rope.select", {{"rope", "rope"}, {"particles", {4, 12}}});
    run("rope.set", {{"rope", "rope"}, {"segments", 32}});
    EXPECT_EQ(selected(), (std::vector<std::size_t>{8, 24}));
    EXPECT_EQ(active(), 24u);
    run("rope.reverse", {{"rope", "rope"}});
    EXPECT_EQ(selected(), (std::vector<std::size_t>{8, 24}));
    EXPECT_EQ(active(), 8u);
    run("rope.select", {{"rope", "rope"}});
    run("rope.merge", {{"rope", "rope"}});
    EXPECT_EQ(made_of("rope").segments, 16);
    EXPECT_EQ(selected().size(), 17u);  // still all of it
    run("rope.subdivide", {{"rope", "rope"}});
    EXPECT_EQ(selected().size(), 33u);
    run("rope.subdivide", {{"rope", "cloth"}});
    EXPECT_EQ(made_of("cloth").columns, 15);
    run("rope.merge", {{"rope", "cloth"}});
    EXPECT_EQ(made_of("cloth").rows, 8);
    run("rope.subdivide", {{"rope", "hair"}});
    EXPECT_EQ(made_of("hair").segments, 16);
}

/// While a drag holds it too.
TEST_F(RopeSet, AHeldRopeIsDividedAndLetGo) {
    workspace.clock.playing = true;
    run("rope.hold", {{"rope", "rope"}, {"particle", 16}, {"at", {1, 2.2, 0}}});
    tick(10);
    run("rope.set", {{"rope", "rope"}, {"segments", 40}});
    run("rope.let_go");
    EXPECT_FALSE(world().pinned(40));
    EXPECT_TRUE(world().pinned(0));
}

/// Saved and copied as C++; set to the world's, it follows that again.
TEST_F(RopeSet, ABodyHasAFrictionOfItsOwn) {
    run("rope.settings", {{"friction", 0.25}});
    EXPECT_EQ(made_of("rope").friction, 0.25f);
    run("rope.set", {{"rope", "rope"}, {"friction", 0.75}});
    run("rope.settings", {{"friction", 0.5}});
    EXPECT_EQ(made_of("rope").friction, 0.75f);
    EXPECT_EQ(made_of("cloth").friction, 0.5f);
    run("rope.copy");
    EXPECT_NE(workspace.ui.copied.value().find(".friction = 0.75f"), std::string::npos);
    load_scene(workspace, save_scene(workspace));
    EXPECT_EQ(made_of("rope").friction, 0.75f);
    run("rope.set", {{"rope", "rope"}, {"friction", 0.5}});
    run("rope.settings", {{"friction", 0.125}});
    EXPECT_EQ(made_of("rope").friction, 0.125f);
}

TEST_F(RopeSet, RenamesABody) {
    run("rope.select", {{"rope", "rope"}, {"particle", 3}});
    run("rope.set", {{"rope", "rope"}, {"name", "line"}});
    EXPECT_EQ(rope_part(workspace).selection->body, "line");
    EXPECT_EQ(world().find("rope"), nullptr);
    EXPECT_TRUE(
        test::says(refused("rope.set", {{"rope", "line"}, {"name", "cloth"}}), "rope.set name cloth"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "line"}, {"name", ""}}), "rope.set name"));
    run("rope.set", {{"rope", "line"}, {"name", "line"}, {"radius", 0.1}});
    EXPECT_EQ(made_of("line").radius, 0.1f);
}

/// It continues from its pose, no particle moves further than its share of the change, and none is thrown.
TEST_F(RopeSet, ALongerRopeSinksToItsNewLength) {
    const double before = lowest();
    const std::vector<glm::dvec3> was = world().state().position;
    run("rope.set", {{"rope", "rope"}, {"length", 1.3}});
    EXPECT_EQ(world().state().position, was);
    tick(1);
    for (std::size_t i = 0; i <= 16; ++i) {
        EXPECT_LT(glm::distance(world().state().position[i], was[i]),
                  0.3 * static_cast<double>(i) / 16 + 0.01);
        EXPECT_LT(glm::length(world().velocity(i)), 2.5f) << i;
    }
    tick(600);
    EXPECT_NEAR(lowest(), before - 0.3, 0.02);
    EXPECT_LT(world().length_error(), 0.02);
}

TEST_F(RopeSet, RefusesWhatABodyDoesNotHave) {
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"bend", 1}}), "rope.set rope bend"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "hair"}, {"tear", 1}}), "rope.set hair tear"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "hair"}, {"shear", 1}}), "rope.set hair shear"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "line"}, {"mass", 1}}), "rope.set line"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"mass", 0}}), "rope.set mass 0"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"radius", -1}}), "rope.set radius -1"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"mass", 1}}), "rope.set rope missing"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"width", 1}}), "rope.set rope width"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"rows", 9}}), "rope.set rope rows"));
    EXPECT_TRUE(
        test::says(refused("rope.set", {{"rope", "cloth"}, {"segments", 9}}), "rope.set cloth segments"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"mass", 1}, {"density", 1}}),
                           "rope.set mass density"));
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "cloth"}, {"columns", 50000}}), "rope.set maximum"));
    EXPECT_TRUE(test::says(refused("rope.reverse", {{"rope", "cloth"}}), "rope.reverse only ropes"));
    EXPECT_TRUE(test::says(refused("rope.subdivide", {{"rope", "line"}}), "rope.subdivide line"));
    run("rope.pin", {{"rope", "rope"}, {"particle", 7}});
    EXPECT_TRUE(test::says(refused("rope.set", {{"rope", "rope"}, {"segments", 1}}), "rope.set 2 segments"));
}

}  // namespace
}  // namespace tendril::app
