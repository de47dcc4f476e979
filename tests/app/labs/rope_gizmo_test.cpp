// The gizmo of the selected collider: arrows move it, rings rotate shapes that have a direction.
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "app/document/json_complete.hpp"
#include "tests/app/labs/rope_support.hpp"

namespace tendril::app {
namespace {

class RopeGizmo : public RopeTest {
  protected:
    RopeGizmo() {
        run("rope.clear");
        run("rope.collider.add",
            {{"name", "ball"}, {"kind", "sphere"}, {"centre", {1, 1, 0}}, {"radius", 0.3}});
        run("rope.collider.add",
            {{"name", "bar"}, {"kind", "capsule"}, {"a", {0, 1, 0}}, {"b", {0, 1, 2}}, {"radius", 0.1}});
        run("rope.collider.add",
            {{"name", "crate"}, {"kind", "box"}, {"centre", {2, 1, 0}}, {"half_extents", {0.2, 0.3, 0.4}}});
        run("rope.collider.add",
            {{"name", "wall"}, {"kind", "plane"}, {"point", {3, 0, 0}}, {"normal", {-1, 0, 0}}});
    }
    std::optional<Handle> gizmo() const { return lab().gizmo(workspace); }
    void select(const char* name) { run("rope.select", {{"collider", name}}); }
    void drag(const Handle::Frame& to) {
        emit([&](Emit& by) { lab().drag(workspace, gizmo()->pick, to, by); });
    }
    const rope::Shape& shape(const char* name) const { return world().find_collider(name)->shape; }
};

TEST_F(RopeGizmo, CollidersAndPinsHaveOneAndFreeParticlesNone) {
    EXPECT_FALSE(gizmo());
    for (const char* name : {"ball", "bar", "crate", "wall"}) {
        select(name);
        ASSERT_TRUE(gizmo()) << name;
        EXPECT_EQ(gizmo()->name, std::string("collider.") + name);
        EXPECT_EQ(has(gizmo()->drag, Drag::Rotation), std::string(name) != "ball");
    }
    run("rope.add", {{"name", "line"}, {"from", {0, 3, 0}}, {"to", {1, 3, 0}}, {"segments", 4}});
    run("rope.select", {{"rope", "line"}, {"particle", 1}});
    EXPECT_FALSE(gizmo());
    run("rope.pin", {{"rope", "line"}, {"particle", 1}});
    ASSERT_TRUE(gizmo());
    EXPECT_EQ(gizmo()->name, "line.1");
    EXPECT_FALSE(has(gizmo()->drag, Drag::Rotation)) << "a point has no rotation";
    run("time.pause");
    drag({glm::vec3(0.25f, 3.2f, 0.1f)});
    EXPECT_LT(glm::distance(gizmo()->frame.position, glm::vec3(0.25f, 3.2f, 0.1f)), 1e-4f);
    run("rope.unpin", {{"rope", "line"}, {"particle", 1}});
    EXPECT_FALSE(gizmo());
}

TEST_F(RopeGizmo, AParticleThatMovesWithAColliderHasNone) {
    run("rope.preset", {{"name", "hair"}});
    run("rope.select", {{"rope", state()["hair"][0]["name"]}, {"particle", 0}});
    EXPECT_FALSE(gizmo());
}

TEST_F(RopeGizmo, RotationsContinueFromWhereTheyAreWithoutDrift) {
    std::mt19937 random(3);
    std::normal_distribution<float> any;
    for (const char* name : {"bar", "crate", "wall"}) {
        select(name);
        const glm::vec3 middle = rope::centre(shape(name));
        for (int i = 0; i < 200; ++i) {
            Handle::Frame to = gizmo()->frame;
            const float x = any(random), y = any(random), z = any(random), w = any(random);
            to.rotation = glm::normalize(glm::quat(w, x, y, z));
            drag(to);
            const glm::vec3 axis = std::string(name) == "wall" ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            EXPECT_LT(glm::distance(gizmo()->frame.rotation * axis, to.rotation * axis), 1e-3f) << name;
        }
        EXPECT_LT(glm::distance(rope::centre(shape(name)), middle), 1e-3f) << name;
    }
    const auto& bar = std::get<rope::Capsule>(shape("bar"));
    EXPECT_NEAR(glm::distance(bar.a, bar.b), 2.0f, 1e-3f);
}

TEST_F(RopeGizmo, OppositeAndEqualDirectionsRotateToo) {
    for (const glm::vec3 direction :
         {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
        run("rope.collider.set", {{"name", "bar"}, {"a", point(-direction)}, {"b", point(direction)}});
        select("bar");
        EXPECT_LT(glm::distance(gizmo()->frame.rotation * glm::vec3(1, 0, 0), direction), 1e-3f);
        run("rope.collider.set", {{"name", "wall"}, {"normal", point(direction)}});
        select("wall");
        EXPECT_LT(glm::distance(gizmo()->frame.rotation * glm::vec3(0, 1, 0), direction), 1e-3f);
    }
}

TEST_F(RopeGizmo, AnArrowMovesWithoutRotating) {
    select("crate");
    const glm::quat before = std::get<rope::Box>(shape("crate")).rotation;
    Handle::Frame to = gizmo()->frame;
    to.position.y += 0.5f;
    drag(to);
    wait(5);
    EXPECT_NEAR(rope::centre(shape("crate")).y, 1.5f, 1e-3f);
    EXPECT_EQ(std::get<rope::Box>(shape("crate")).rotation, before);
}

}  // namespace
}  // namespace tendril::app
