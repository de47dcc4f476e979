// Poses between steps: positions at a frame's time, for frames that are not a whole number of substeps.
#include <vector>

#include "random.hpp"
#include "rope_support.hpp"

namespace tendril::test {
namespace {

using glm::dvec3;

constexpr double speed = 10.0;  // m/s
constexpr double even = 1e-4;   // metres

dvec3 goal_at(double time) {
    return {speed * time, 2.0, 0.0};
}

std::vector<dvec3> pose_of(const rope::World& world) {
    std::vector<dvec3> pose(world.size());
    world.pose(pose);
    return pose;
}

/// A rope in weightlessness, straight down; its start is moved at 10 m/s.
struct Drawn {
    rope::World world;
    rope::Workspace workspace;
    double time = 0.0;

    Drawn() {
        rope::Settings settings;
        settings.gravity = glm::vec3(0.0f);
        settings.damping = 0.0f;
        EXPECT_TRUE(world.set_settings(settings));
        EXPECT_TRUE(world.add_rope({.from = {0, 2, 0}, .to = {0, 1, 0}, .segments = 8, .pin_start = true}));
        rope::State state = world.state();
        for (dvec3& moved : state.displacement) moved = {speed * settings.substep, 0.0, 0.0};
        state.displaced_in = settings.substep;
        world = *rope::World::from_state(state);
    }
    void frame(double seconds) {
        time += seconds;
        EXPECT_TRUE(world.pin(0, goal_at(time), world.pending() + seconds));
        world.advance(seconds, workspace);
    }
};

double seconds_of_frame(double rate, Random& random) {
    return rate > 0.0 ? 1.0 / rate : 0.002 + 0.028 * static_cast<double>(random.part());
}

TEST(RopePose, APinIsAtItsGoalAtTheFramesTime) {
    for (const double rate : {60.0, 75.0, 90.0, 144.0, 0.0}) {
        Random random(7);
        Drawn drawn;
        for (int i = 0; i < 500; ++i) {
            drawn.frame(seconds_of_frame(rate, random));
            const std::vector<dvec3> pose = pose_of(drawn.world);
            ASSERT_LT(glm::distance(pose[0], goal_at(drawn.time)), 1e-9) << rate << " Hz, frame " << i;
            // The rest of the rope moves as evenly.
            for (std::size_t p = 1; p < pose.size(); ++p)
                ASSERT_NEAR(pose[p].x, goal_at(drawn.time).x, even) << rate << " Hz, frame " << i;
        }
    }
}

/// Given only the frame's length, the pin still is at its goal in every frame.
TEST(RopePose, IsExactForAPinWithoutThePendingTime) {
    for (const double rate : {75.0, 90.0, 144.0, 0.0}) {
        Random random(7);
        Drawn drawn;
        double behind = 0.0;
        for (int i = 0; i < 500; ++i) {
            const double seconds = seconds_of_frame(rate, random);
            drawn.time += seconds;
            ASSERT_TRUE(drawn.world.pin(0, goal_at(drawn.time), seconds));
            drawn.world.advance(seconds, drawn.workspace);
            behind = std::max(behind, glm::distance(drawn.world.position(0), goal_at(drawn.time)));
            ASSERT_LT(glm::distance(pose_of(drawn.world)[0], goal_at(drawn.time)), 1e-9) << rate << " Hz";
        }
        EXPECT_GT(behind, 0.008) << "the last whole step is behind, at " << rate << " Hz";
    }
}

TEST(RopePose, IsTheStateAtTheEndOfAStep) {
    World world;
    hang_between(world, 1.0f, 1.5f, 16);
    for (int i = 0; i < 60; ++i) {
        world.advance(1.0 / 60.0);
        const std::vector<dvec3> pose = pose_of(world);
        for (std::size_t p = 0; p < pose.size(); ++p) ASSERT_EQ(pose[p], world.state().position[p]);
    }
    EXPECT_EQ(world.pending(), 0.0);
}

/// In free fall, poses lie between the steps' samples, to within the fall of one substep.
TEST(RopePose, FallsEvenlyBetweenSteps) {
    rope::World world;
    rope::Workspace workspace;
    ASSERT_TRUE(world.add_rope({.from = {0, 50, 0}, .to = {1, 50, 0}, .segments = 4}));
    rope::Settings settings;
    settings.damping = 0.0f;
    ASSERT_TRUE(world.set_settings(settings));
    Random random(3);
    double time = 0.0;
    while (time < 2.0) {
        const double seconds = 0.001 + 0.019 * static_cast<double>(random.part());
        time += seconds;
        world.advance(seconds, workspace);
        const double fallen = 0.5 * 9.81 * time * (time + settings.substep);
        for (const dvec3& at : pose_of(world)) ASSERT_NEAR(50.0 - at.y, fallen, 2e-4) << time;
    }
}

/// Between the last step before contact and the next one, nothing is drawn inside a collider.
TEST(RopePose, EntersNoCollider) {
    rope::World world;
    rope::Workspace workspace;
    ASSERT_TRUE(world.add_rope({.from = {-1, 3, 0}, .to = {1, 3, 0}, .segments = 16}));
    const auto ball = *world.add_collider(rope::Sphere{{0, 1, 0}, 0.5f});
    ASSERT_TRUE(world.add_collider(rope::Plane{{0, 0, 0}, {0, 1, 0}}));
    Random random(5);
    for (int i = 0; i < 400; ++i) {
        const double seconds = 0.001 + 0.009 * static_cast<double>(random.part());
        const float x = 0.5f * std::sin(0.05f * static_cast<float>(i));
        ASSERT_TRUE(world.move_collider(ball, {x, 1, 0}, world.pending() + seconds));
        world.advance(seconds, workspace);
        const rope::Shape shape = world.pose(*world.find(ball));
        EXPECT_NEAR(rope::centre(shape).x, x, 1e-6f);
        for (const dvec3& at : pose_of(world)) {
            ASSERT_GT(rope::surface_distance(shape, at).distance, 0.02 - 1e-3) << "frame " << i;
            ASSERT_GT(at.y, 0.02 - 1e-3) << "frame " << i;
        }
    }
}

TEST(RopePose, CarriesAttachedParticles) {
    rope::World world;
    rope::Workspace workspace;
    const auto bar = *world.add_collider(rope::Capsule{{0, 1, 0}, {1, 1, 0}, 0.05f});
    ASSERT_TRUE(world.add_rope({.from = {0, 1.1f, 0}, .to = {0, 2, 0}, .segments = 4}));
    ASSERT_TRUE(world.attach(0, bar));
    double time = 0.0;
    for (int i = 0; i < 100; ++i) {
        time += 1.0 / 144.0;
        const auto x = static_cast<float>(speed * time);
        const rope::Capsule to{{x, 1, 0}, {x + 1, 1, 0}, 0.05f};
        ASSERT_TRUE(world.move_capsule(bar, to, world.pending() + 1.0 / 144.0));
        world.advance(1.0 / 144.0, workspace);
        const auto capsule = std::get<rope::Capsule>(world.pose(*world.find(bar)));
        EXPECT_LT(glm::distance(capsule.a, to.a), 1e-5f);
        EXPECT_LT(glm::distance(capsule.b, to.b), 1e-5f);
        EXPECT_NEAR(pose_of(world)[0].x, static_cast<double>(x), 1e-5);
    }
}

/// A single particle, and a list from any start, equal the whole pose.
TEST(RopePose, GivesPartsOfTheWorld) {
    Drawn drawn;
    drawn.frame(1.0 / 144.0);
    const std::vector<dvec3> all = pose_of(drawn.world);
    for (std::size_t i = 0; i < all.size(); ++i) {
        dvec3 one(0.0);
        drawn.world.pose({&one, 1}, i);
        EXPECT_EQ(one, all[i]);
    }
    std::vector<dvec3> more(3, dvec3(-1.0));
    drawn.world.pose(more, all.size() - 1);
    EXPECT_EQ(more[0], all.back());
    EXPECT_EQ(more[1], dvec3(-1.0)) << "there is no such particle";
}

}  // namespace
}  // namespace tendril::test
