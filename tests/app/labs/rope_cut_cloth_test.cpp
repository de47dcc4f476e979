// Cutting cloth: by the command, by clicks and by a stroke, and the resulting pieces.
#include <glm/vec2.hpp>

#include "app/labs/rope/rope_edit.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "app/view/camera.hpp"
#include "app/widgets/emit.hpp"
#include "tests/app/labs/rope_support.hpp"
#include "tests/app/support/panel_text.hpp"

namespace tendril::app {
namespace {

class RopeCutCloth : public RopeTest {
  protected:
    RopeCutCloth() {
        run("rope.clear");
        add_cloth();
        wait(60);
    }
    void cut(const char* name, const Json& points) {
        run("rope.cloth.cut", {{"rope", name}, {"points", points}});
    }
    /// A stroke between two points of the plane of the cloth, seen from the front.
    void stroke(glm::vec2 from, glm::vec2 to, std::size_t pane = 0) {
        const Camera camera({.target = {3.5f, 1.5f, 0.0f}, .yaw = 0.0f, .pitch = 0.0f, .distance = 4.0f},
                            {{0, 0}, {800, 600}});
        Emit emit;
        lab().stroke(workspace, pane, camera, *camera.project(glm::vec3(from, 0.0f)),
                     *camera.project(glm::vec3(to, 0.0f)), emit);
        for (const Emitted& each : emit.take()) {
            EXPECT_TRUE(each.continuous);
            run(each.name.c_str(), *each.arguments, 7);
        }
    }
    const rope::Body& body(const char* name) const { return *world().find(name); }
    std::size_t links() const { return world().state().links.size(); }
};

TEST_F(RopeCutCloth, APieceIsAClothOfItsOwn) {
    const std::size_t whole = links();
    run("rope.select", {{"rope", "cloth"}, {"particle", 60}});
    const glm::vec3 at = world().position(body("cloth").first + 60);
    cut("cloth", {{-0.5, 3.5}, {7.5, 3.5}});
    ASSERT_NE(world().find("cloth 2"), nullptr);
    EXPECT_TRUE(test::says(workspace.ui.toasts.back().text, "cloth is now in 2 pieces; cloth 2 came off"));
    EXPECT_EQ(body("cloth").count, 32u);
    EXPECT_EQ(body("cloth 2").count, 32u);
    EXPECT_EQ(part().selection->body, "cloth 2");
    EXPECT_EQ(world().position(body("cloth 2").first + part().selection->particle()), at);
    EXPECT_EQ(state()["cloths"].size(), 2u);
    wait(60);
    EXPECT_LT(world().position(body("cloth 2").first).y, world().position(body("cloth").first).y - 2.0f);
    run("rope.set", {{"rope", "cloth 2"}, {"mass", 3}, {"bend", 0.1}});
    EXPECT_NEAR(world().world().mass(body("cloth 2")), 3.0, 1e-6);
    run("rope.subdivide", {{"rope", "cloth 2"}});
    cut("cloth 2", {{7.5, -1}, {7.5, 7}});
    EXPECT_NE(world().find("cloth 3"), nullptr);
    run("rope.remove", {{"name", "cloth 2"}});
    EXPECT_EQ(world().state().bodies.size(), 2u);
    for (int i = 0; i < 5; ++i) run("undo");
    EXPECT_EQ(links(), whole);
    EXPECT_EQ(part().selection->body, "cloth");
    run("redo");
    EXPECT_NE(world().find("cloth 2"), nullptr);
}

TEST_F(RopeCutCloth, ClicksCutFromEachToTheNext) {
    run("rope.tool", {{"name", "cut"}});
    EXPECT_TRUE(test::says(lab().hint(workspace, no_pick), "Drag across to cut"));
    const std::size_t whole = links();
    const glm::vec3 last = world().position(body("cloth").first + 39);
    for (const std::size_t at : {24u, 27u, 39u})
        emit([&](Emit& to) { lab().click(workspace, particle_pick(body("cloth").first + at), to); });
    EXPECT_LT(links(), whole);
    const RopeSelection& selection = *part().selection;
    EXPECT_EQ(world().position(world().find(selection.body)->first + selection.particle()), last);
    EXPECT_TRUE(test::says(lab().hint(workspace, particle_pick(40)), "cuts from the selected"));
}

TEST_F(RopeCutCloth, AStrokeCutsAcross) {
    add_rope("line", {3.5, 2.2, 0.2}, {3.5, 0, 0.2}, {{"pin_start", true}});
    const std::size_t whole = links();
    stroke({2.8f, 1.75f}, {4.2f, 1.25f});
    ASSERT_NE(world().find("cloth 2"), nullptr);
    EXPECT_NE(world().find("line 2"), nullptr);
    EXPECT_EQ(world().state().bodies.size(), 4u);
    const auto mean = [&](const char* name) {
        double y = 0.0;
        for (std::size_t i = 0; i < body(name).count; ++i)
            y += world().state().position[body(name).first + i].y;
        return y / static_cast<double>(body(name).count);
    };
    EXPECT_GT(mean("cloth"), mean("cloth 2") + 0.3);
    for (const rope::Link& link : world().state().links) EXPECT_NE(link.a, link.b);
    run("undo");
    EXPECT_EQ(links(), whole);
    // A stroke that ends inside makes a slit, and one beside the cloth cuts nothing.
    stroke({2.8f, 1.5f}, {3.5f, 1.5f});
    EXPECT_LT(links(), whole);
    EXPECT_EQ(world().find("cloth 2"), nullptr);
    const std::size_t slit = links();
    stroke({2.8f, 2.5f}, {4.2f, 2.6f});
    EXPECT_EQ(links(), slit);
    // Cutting the rest separates it.
    stroke({3.3f, 1.5f}, {4.2f, 1.5f});
    EXPECT_NE(world().find("cloth 2"), nullptr);
}

TEST_F(RopeCutCloth, AStrokeCutsTheClothOfItsPane) {
    race_aside();
    stroke({4.8f, 1.5f}, {6.2f, 1.5f});
    EXPECT_EQ(world().find("cloth 2"), nullptr);
    stroke({4.8f, 1.5f}, {6.2f, 1.5f}, 1);
    EXPECT_NE(world().find("cloth 2"), nullptr);
}

TEST_F(RopeCutCloth, TheMessageCountsAllPieces) {
    cut("cloth",
        Json::parse("[[-1, 0.5], [8, 0.5], [8, 1.5], [-1, 1.5], [-1, 2.5], [8, 2.5], [8, 3.5], [-1, 3.5], "
                    "[-1, 4.5], [8, 4.5]]"));
    EXPECT_TRUE(test::says(workspace.ui.toasts.back().text,
                           "is now in 6 pieces; cloth 2 cloth 3 cloth 4 and 2 more came off"));
}

/// Over a bar, a stroke below it cuts the parts that hang in front and behind, and not the part on the bar.
TEST_F(RopeCutCloth, AStrokeCutsAllLayers) {
    run("rope.clear");
    run("rope.collider.add",
        {{"name", "bar"}, {"kind", "capsule"}, {"a", {2.7, 1.8, 0}}, {"b", {4.3, 1.8, 0}}, {"radius", 0.1}});
    add_cloth("cloth", {3, 1.95, -0.8}, {1, 0, 0}, {0, 0, 1.6}, 11, 17);
    wait(90);
    stroke({2.8f, 1.5f}, {4.2f, 1.5f});
    EXPECT_EQ(world().state().bodies.size(), 3u);
}

/// Folded in two, seen from the front. Only the cloth under the stroke is cut, in both layers; the part
/// between the stroke's two crossings is not.
TEST_F(RopeCutCloth, AStrokeCutsEachLayerWhereItCrosses) {
    run("rope.clear");
    add_cloth("cloth", {3, 2, 0}, {1, 0, 0}, {0, -2, 0}, 9, 17);
    auto folded = std::make_shared<NamedWorld>(world());
    rope::State state = folded->state();
    for (glm::dvec3& at : state.position)
        if (at.y < 1.0) at = {at.x, 2.0 - at.y, -0.01};
    folded->put(std::move(state));
    workspace.document.edit<RopePart>(rope_lab).world = folded;
    const rope::State before = folded->state();
    const glm::dvec2 from(3.18, 1.55), to(3.69, 1.58);
    stroke(from, to);
    EXPECT_EQ(world().state().bodies.size(), 1u);
    const auto is_under = [&](const rope::Link& link) {
        const auto side = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
            return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
        };
        const glm::dvec2 a(before.position[link.a]), b(before.position[link.b]);
        return side(from, to, a) != side(from, to, b) && side(a, b, from) != side(a, b, to);
    };
    std::vector<rope::Link> rest = before.links;
    EXPECT_EQ(std::erase_if(rest, is_under), 40u);
    const auto ends = [](const rope::Link& link) { return std::pair(link.a, link.b); };
    EXPECT_TRUE(std::ranges::equal(world().state().links, rest, {}, ends, ends));
    run("undo");
    EXPECT_EQ(links(), before.links.size());
}

/// A thread of a torn cloth without an adjacent triangle shows no surface, but still holds.
TEST_F(RopeCutCloth, AStrokeCutsBareThreads) {
    run("rope.cloth.cut",
        {{"rope", "cloth"},
         {"lines", {{{-1, 3.5}, {2.5, 3.5}, {2.5, 4.5}}, {{3.5, 2.5}, {3.5, 3.5}, {8, 3.5}}}}});
    ASSERT_EQ(world().find("cloth 2"), nullptr);
    stroke({2.8f, 1.5f}, {4.2f, 1.5f});
    ASSERT_NE(world().find("cloth 2"), nullptr);
    EXPECT_EQ(body("cloth").count + body("cloth 2").count, 64u);
}

TEST_F(RopeCutCloth, TornClothSeparates) {
    run("rope.set",
        {{"rope", "cloth"}, {"tear", 0.05}, {"bend", 0.25}, {"friction", 0.75}, {"colour", "teal"}});
    run("rope.select", {{"rope", "cloth"}, {"particle", 60}});
    for (int c = 0; c < 8; ++c)
        for (const int r : {0, 7})
            run("rope.pin", {{"rope", "cloth"},
                             {"particle", r * 8 + c},
                             {"at", {3.0 + c / 7.0, r == 0 ? 2.0 : -1.0, 0}}});
    for (int i = 0; i < 120; ++i) {
        wait(1);
        const rope::State& now = world().state();
        ASSERT_LT(part().selection->particle(), world().find(part().selection->body)->count);
        for (const rope::Body& each : now.bodies) EXPECT_FALSE(world().name(each).empty());
    }
    EXPECT_GT(world().state().bodies.size(), 1u);
    for (const rope::Body& each : world().state().bodies) {
        EXPECT_EQ(each.tear, 0.05f);
        EXPECT_EQ(settings_of(world(), each).bend.value_or(0.25f), 0.25f);
        EXPECT_EQ(each.friction, 0.75f);
        EXPECT_EQ(world().colour(each), BodyColour::Teal);
    }
}

TEST_F(RopeCutCloth, ATearIsShownUntilARestartOrItsRopeIsRemoved) {
    single_rope(8);
    run("rope.set", {{"rope", "rope"}, {"tear", 0.1}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 0}});
    run("rope.pin", {{"rope", "rope"}, {"particle", 8}, {"at", {2.5, 2, 0}}});
    const auto shown = [&] { return test::PanelReader().inspector(lab(), workspace); };
    EXPECT_FALSE(test::says(shown(), "tore"));
    wait(60);
    ASSERT_GT(world().state().bodies.size(), 1u);
    std::size_t particles = 0;
    for (const rope::Body& each : world().state().bodies) {
        EXPECT_EQ(each.row, each.count);
        EXPECT_EQ(each.tear, 0.1f);
        particles += each.count;
    }
    EXPECT_EQ(particles, 9u);
    EXPECT_LT(world().length_error(), 0.01);
    EXPECT_EQ(state()["verdict"], "Torn");
    wait(640);
    EXPECT_NE(state()["verdict"], "Torn") << "ten seconds ago";
    EXPECT_TRUE(test::says(shown(), "rope tore at particle Restart")) << shown();
    run("rope.set", {{"rope", "rope"}, {"name", "line"}});
    EXPECT_TRUE(test::says(shown(), "line tore at particle")) << shown();
    run("undo");
    run("rope.restart");
    EXPECT_TRUE(part().tears.empty());
    run("undo");
    EXPECT_FALSE(part().tears.empty());
    run("rope.remove", {{"name", "rope"}});
    for (const RopeTear& each : part().tears) EXPECT_NE(each.body, "rope");
}

TEST_F(RopeCutCloth, RefusalsGiveReasonAndPlace) {
    run("rope.add", {{"from", {0, 2, 0}}, {"to", {1, 2, 0}}});
    const auto says = [&](const Json& arguments, const char* words) {
        refuses("rope.cloth.cut", arguments, words);
    };
    says({{"rope", "rope"}, {"points", {{0, 0}, {1, 1}}}}, "rope.cloth.cut only cloth");
    says({{"rope", "cloth"}, {"points", {{0, 0}}}}, "rope.cloth.cut 2 points got 1");
    says({{"rope", "cloth"}, {"points", {{0, 0}, {9, 1}}}}, "rope.cloth.cut lines[0][1].column 8 got 9");
    says({{"rope", "cloth"}, {"points", {{0, -2}, {7, 1}}}}, "rope.cloth.cut lines[0][0].row -1 8 got -2");
    says({{"rope", "cloth"}, {"points", {{0, "x"}, {7, 1}}}}, "rope.cloth.cut points.0.1 x");
    says({{"rope", "cloth"}, {"points", {{0, nullptr}, {7, 1}}}}, "rope.cloth.cut points.0.1 null");
    says({{"rope", "cloth"}, {"points", {{0, 0, 1}, {1, 1, 1}}}}, "rope.cloth.cut points column");
    says({{"rope", "cloth"}}, "rope.cloth.cut needs either points or lines");
    says({{"rope", "cloth"}, {"lines", Json::array()}}, "rope.cloth.cut lines across links of the cloth");
    says({{"rope", "cloth"}, {"lines", {{{0, 0}, {1, 1}}, {{2, "x"}, {7, 1}}}}},
         "rope.cloth.cut lines.1.0.1 x");
    const Json long_line(600, {0.5, 0.5});
    says({{"rope", "cloth"}, {"lines", {long_line, long_line}}},
         "rope.cloth.cut lines.1 600 points maximum is 400");
    says({{"rope", "line"}, {"points", {{0, 0}, {1, 1}}}}, "line");
}

}  // namespace
}  // namespace tendril::app
