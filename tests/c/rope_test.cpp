// Rope worlds of C: the library's own bits, handles, saved states.
#include <thread>

#include "arm.hpp"
#include "tendril/rope/edit.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::test {
namespace {

constexpr double frame = 1.0 / 60.0;

tendril_vec3 to_c(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
rope::BodyId to_cpp(tendril_rope_body_id id) {
    return {id.index, id.generation};
}

/// A rope and a cloth tied to each other, a ball below, made twice.
class TwinWorld {
  public:
    TwinWorld() {
        EXPECT_DONE(tendril_rope_world_make(nullptr, &c_world, &error));
        tendril_rope_shape shape = tendril_rope_shape_default();
        shape.to = {1.0f, 0.2f, 0.0f}, shape.length = 1.3f, shape.segments = 20, shape.pin_start = 1;
        EXPECT_DONE(tendril_rope_add_rope(c_world, &shape, &c_line, &error));
        line = *world.add_rope({.to = {1.0f, 0.2f, 0.0f}, .segments = 20, .length = 1.3f, .pin_start = true});
        tendril_rope_cloth_shape cloth = tendril_rope_cloth_shape_default();
        cloth.corner = {0.0f, -0.5f, 0.3f}, cloth.columns = 9, cloth.rows = 7;
        cloth.pins = TENDRIL_ROPE_CLOTH_PINS_CORNERS;
        EXPECT_DONE(tendril_rope_add_cloth(c_world, &cloth, &c_sail, &error));
        sail = *world.add_cloth({.corner = {0.0f, -0.5f, 0.3f},
                                 .columns = 9,
                                 .rows = 7,
                                 .pins = rope::ClothShape::Pins::Corners});
        tendril_rope_sphere ball = tendril_rope_sphere_default();
        ball.centre = {0.5f, -1.2f, 0.2f}, ball.radius = 0.3f;
        EXPECT_DONE(tendril_rope_add_sphere(c_world, &ball, &c_ball, &error));
        this->ball = *world.add_collider(rope::Sphere{{0.5f, -1.2f, 0.2f}, 0.3f});
        EXPECT_DONE(tendril_rope_tie(c_world, 20, 40, nullptr, &c_tie, &error));
        tie = *world.tie(20, 40);
    }
    ~TwinWorld() { tendril_rope_world_destroy(c_world); }
    TwinWorld(const TwinWorld&) = delete;
    TwinWorld& operator=(const TwinWorld&) = delete;

    /// The hand and the ball move, then both advance.
    void step(int number) {
        const double t = frame * number;
        const glm::dvec3 hand(0.3 * t, 0.1 * t, -0.2 * t);
        ASSERT_DONE(tendril_rope_pin(c_world, 0, to_c(hand), tendril_rope_pending(c_world) + frame, &error));
        ASSERT_TRUE(world.pin(0, hand, world.pending() + frame));
        const auto up = static_cast<float>(-1.2 + 0.4 * t);
        ASSERT_DONE(tendril_rope_move_collider(c_world, c_ball, {0.5f, up, 0.2f}, frame, &error));
        ASSERT_TRUE(world.move_collider(ball, {0.5f, up, 0.2f}, frame));
        ASSERT_DONE(tendril_rope_advance(c_world, frame, 1, &report, &error));
        last = world.advance(frame, workspace, {.impulses = true});
    }
    std::vector<tendril_vec3> c_positions(tendril_rope_body_id body) {
        tendril_rope_body_info info = tendril_rope_body_info_default();
        EXPECT_DONE(tendril_rope_find_body(c_world, body, &info, &error));
        std::vector<tendril_vec3> at(info.count);
        EXPECT_DONE(tendril_rope_positions(c_world, body, at.data(), at.size(), &error));
        return at;
    }
    std::vector<glm::dvec3> positions(rope::BodyId body) const {
        std::vector<glm::dvec3> at(world.find(body)->count);
        world.pose(at, world.find(body)->first);
        return at;
    }
    std::vector<std::byte> saved() {
        std::vector<std::byte> bytes(tendril_rope_saved_bytes(c_world));
        std::size_t used = 0;
        EXPECT_DONE(tendril_rope_save(c_world, bytes.data(), bytes.size(), &used, &error));
        EXPECT_EQ(used, bytes.size());
        return bytes;
    }

    rope::World world;
    rope::Workspace workspace;
    rope::Advance last;
    rope::BodyId line, sail;
    rope::ColliderId ball;
    rope::TieId tie;
    tendril_rope_world c_world{};
    tendril_rope_body_id c_line{}, c_sail{};
    tendril_rope_collider_id c_ball{};
    tendril_rope_tie_id c_tie{};
    tendril_rope_report report = tendril_rope_report_default();
    tendril_error error{};
};

TEST(CRope, MovesWithTheLibrarysBits) {
    TwinWorld twin;
    tendril_error& error = twin.error;
    std::uint64_t pushed = 0;
    for (int i = 0; i < 120; ++i) {
        ASSERT_NO_FATAL_FAILURE(twin.step(i));
        EXPECT_EQ(twin.report.substeps, twin.last.substeps);
        EXPECT_EQ(twin.report.work, twin.last.work);
        EXPECT_EQ(twin.report.contact_loss, twin.last.contact_loss);
        tendril_vec3 linear, angular;
        ASSERT_DONE(tendril_rope_collider_impulse(twin.c_world, twin.c_ball, &linear, &angular, &error));
        const glm::dvec3 expected =
            twin.last.impulses.empty() ? glm::dvec3(0.0) : twin.last.impulses[0].linear;
        ASSERT_EQ(glm::dvec3(linear.x, linear.y, linear.z), expected);
        pushed += linear.y != 0.0 ? 1 : 0;
    }
    EXPECT_GT(pushed, 0u) << "nothing touched the ball";
    EXPECT_TRUE(same_bytes(twin.positions(twin.line), twin.c_positions(twin.c_line)));
    EXPECT_TRUE(same_bytes(twin.positions(twin.sail), twin.c_positions(twin.c_sail)));
    EXPECT_EQ(tendril_rope_energy(twin.c_world), twin.world.energy());
    float tension = 0.0f;
    ASSERT_DONE(tendril_rope_tie_tension(twin.c_world, twin.c_tie, &tension, &error));
    EXPECT_EQ(tension, twin.world.find(twin.tie)->tension);
    tendril_vec3f centre{};
    ASSERT_DONE(tendril_rope_collider_centre(twin.c_world, twin.c_ball, &centre, &error));
    EXPECT_EQ(centre.y, rope::centre(twin.world.pose(*twin.world.find(twin.ball))).y);
    std::vector<tendril_vec3> speeds(21);
    ASSERT_DONE(tendril_rope_velocities(twin.c_world, twin.c_line, speeds.data(), speeds.size(), &error));
    EXPECT_EQ(speeds[20].y, twin.world.velocity(20).y);
}

TEST(CRope, CutsTearsAndPartsAsTheLibrary) {
    TwinWorld twin;
    tendril_error& error = twin.error;
    tendril_rope_body_id rest{};
    ASSERT_DONE(tendril_rope_cut(twin.c_world, twin.c_line, 9, &rest, &error));
    const rope::BodyId cpp_rest = *twin.world.cut(twin.line, 9);
    EXPECT_EQ(to_cpp(rest), cpp_rest);
    const tendril_vec2f line[] = {{4.5f, -0.5f}, {4.5f, 6.5f}};
    std::size_t pieces = 0;
    ASSERT_DONE(tendril_rope_cut_cloth(twin.c_world, twin.c_sail, line, 2, &pieces, &error));
    const rope::ClothLine lines[] = {{{4.5f, -0.5f}, {4.5f, 6.5f}}};
    twin.world = std::move(rope::cut_cloth(twin.world, twin.sail, lines)->world);
    EXPECT_EQ(pieces, 1u);
    EXPECT_EQ(tendril_rope_bodies(twin.c_world), 4u);
    tendril_rope_body_id piece{};
    ASSERT_DONE(tendril_rope_body_at(twin.c_world, 3, &piece, &error));
    EXPECT_EQ(to_cpp(piece), twin.world.state().bodies[3].id);
    EXPECT_EQ(tendril_rope_body_at(twin.c_world, 4, &piece, &error), TENDRIL_OUT_OF_RANGE);

    ASSERT_DONE(tendril_rope_set_tear(twin.c_world, twin.c_line, 1e-6f, &error));
    ASSERT_TRUE(twin.world.set_tear(twin.line, 1e-6f));
    ASSERT_DONE(tendril_rope_set_mass(twin.c_world, twin.c_line, 50.0, &error));
    ASSERT_TRUE(twin.world.set_mass(twin.line, 50.0));
    tendril_rope_settings settings = tendril_rope_settings_default();
    settings.compliance = 1e-3f;
    ASSERT_DONE(tendril_rope_set_settings(twin.c_world, &settings, &error));
    rope::Settings cpp_settings;
    cpp_settings.compliance = 1e-3f;
    ASSERT_TRUE(twin.world.set_settings(cpp_settings));
    std::size_t torn = 0;
    for (int i = 0; i < 20 && torn == 0; ++i) {
        ASSERT_NO_FATAL_FAILURE(twin.step(i));
        torn = tendril_rope_torn(twin.c_world);
        ASSERT_EQ(torn, twin.last.torn.size());
    }
    ASSERT_GT(torn, 0u);
    tendril_rope_body_id body{};
    std::size_t a = 99, b = 99;
    ASSERT_DONE(tendril_rope_torn_at(twin.c_world, 0, &body, &a, &b, &error));
    EXPECT_EQ(body.index, twin.c_line.index);
    EXPECT_EQ(a, twin.last.torn[0].link.a);
    EXPECT_EQ(tendril_rope_torn_at(twin.c_world, torn, &body, &a, &b, &error), TENDRIL_OUT_OF_RANGE);
    ASSERT_DONE(tendril_rope_part(twin.c_world, twin.c_line, &pieces, &error));
    EXPECT_GE(pieces, 1u);
}

TEST(CRope, SavedAndLoadedContinuesWithTheSameBits) {
    TwinWorld twin;
    tendril_error& error = twin.error;
    for (int i = 0; i < 30; ++i) ASSERT_NO_FATAL_FAILURE(twin.step(i));
    const auto bytes = twin.saved();
    tendril_rope_world other{};
    ASSERT_DONE(tendril_rope_world_make(nullptr, &other, &error));
    ASSERT_DONE(tendril_rope_load(other, bytes.data(), bytes.size(), &error));
    std::swap(other, twin.c_world);  // the loaded one goes on as the library's does
    for (int i = 30; i < 60; ++i) ASSERT_NO_FATAL_FAILURE(twin.step(i));
    EXPECT_TRUE(same_bytes(twin.positions(twin.sail), twin.c_positions(twin.c_sail)));
    ASSERT_DONE(tendril_rope_copy(other, twin.c_world, &error));
    std::swap(other, twin.c_world);
    for (int i = 60; i < 70; ++i) ASSERT_NO_FATAL_FAILURE(twin.step(i));
    EXPECT_TRUE(same_bytes(twin.positions(twin.line), twin.c_positions(twin.c_line)));
    EXPECT_EQ(tendril_rope_world_destroy(other), TENDRIL_OK);
}

TEST(CRope, DamagedIsRefusedAndTheWorldStays) {
    TwinWorld twin;
    tendril_error& error = twin.error;
    for (int i = 0; i < 5; ++i) ASSERT_NO_FATAL_FAILURE(twin.step(i));
    const auto bytes = twin.saved();
    Random random(5);
    for (int round = 0; round < 2000; ++round) {
        auto wrong = bytes;
        const std::size_t bit = random.below(bytes.size() * 8);
        wrong[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        ASSERT_EQ(tendril_rope_load(twin.c_world, wrong.data(), wrong.size(), &error),
                  TENDRIL_INVALID_ARGUMENT)
            << bit;
        const std::size_t size = random.below(bytes.size());
        ASSERT_EQ(tendril_rope_load(twin.c_world, bytes.data(), size, &error), TENDRIL_INVALID_ARGUMENT);
    }
    EXPECT_EQ(twin.saved(), bytes);
    std::size_t used = 77;
    std::vector<std::byte> few(bytes.size() - 1);
    EXPECT_EQ(tendril_rope_save(twin.c_world, few.data(), few.size(), &used, &error), TENDRIL_SHORT_BUFFER);
    EXPECT_EQ(used, 77u);
}

/// FNV-1a over the state, so that wrong bits pass the checksum.
void sign(std::vector<std::byte>& bytes) {
    std::uint64_t sum = 14695981039346656037u ^ 1u;
    for (std::size_t i = 24; i < bytes.size(); ++i)
        sum = (sum ^ static_cast<std::uint64_t>(bytes[i])) * 1099511628211u;
    std::memcpy(bytes.data() + 16, &sum, sizeof sum);
}

TEST(CRope, WithWrongBitsAndARightChecksumIsRefusedOrHarmless) {
    TwinWorld twin;
    for (int i = 0; i < 5; ++i) ASSERT_NO_FATAL_FAILURE(twin.step(i));
    const auto bytes = twin.saved();
    Random random(6);
    int accepted = 0;
    for (int round = 0; round < 1500; ++round) {
        auto wrong = bytes;
        const std::size_t bit = 24 * 8 + random.below((bytes.size() - 24) * 8);
        wrong[bit / 8] ^= static_cast<std::byte>(1u << (bit % 8));
        sign(wrong);
        if (tendril_rope_load(twin.c_world, wrong.data(), wrong.size(), nullptr) != TENDRIL_OK) continue;
        ++accepted;
        static_cast<void>(tendril_rope_advance(twin.c_world, 0.01, 0, nullptr, nullptr));
        EXPECT_EQ(tendril_rope_energy(twin.c_world) != tendril_rope_energy(twin.c_world), false) << bit;
    }
    EXPECT_GT(accepted, 100) << "mostly refused: tests too little";
}

TEST(CRope, StaleAndForeignHandlesAreRefusedByName) {
    TwinWorld twin;
    tendril_error& error = twin.error;
    ASSERT_DONE(tendril_rope_remove(twin.c_world, twin.c_line, &error));
    tendril_vec3 at[21];
    for (const tendril_rope_body_id body :
         {twin.c_line, tendril_rope_body_id{}, tendril_rope_body_id{~0u, 1}, tendril_rope_body_id{7, 1}}) {
        EXPECT_EQ(tendril_rope_positions(twin.c_world, body, at, 21, &error), TENDRIL_OUT_OF_RANGE);
        EXPECT_NE(std::strstr(error.message, "body"), nullptr) << error.message;
        EXPECT_EQ(tendril_rope_move(twin.c_world, body, {0, 1, 0}, &error), TENDRIL_OUT_OF_RANGE);
        EXPECT_EQ(tendril_rope_set_tear(twin.c_world, body, 1.0f, &error), TENDRIL_OUT_OF_RANGE);
    }
    float tension;
    EXPECT_EQ(tendril_rope_tie_tension(twin.c_world, twin.c_tie, &tension, &error), TENDRIL_OUT_OF_RANGE)
        << "gone with its rope";
    EXPECT_EQ(tendril_rope_move_collider(twin.c_world, {3, 1}, {0, 1, 0}, 0.1, &error), TENDRIL_OUT_OF_RANGE);
    EXPECT_EQ(tendril_rope_positions(twin.c_world, twin.c_sail, at, 21, &error), TENDRIL_INVALID_ARGUMENT);
    EXPECT_STREQ(error.message,
                 "rope_positions: positions must have 63 elements, the body's particles, got 21");
    EXPECT_EQ(tendril_rope_copy(twin.c_world, twin.c_world, &error), TENDRIL_BUSY);
    const tendril_rope_world gone{};
    EXPECT_EQ(tendril_rope_advance(gone, frame, 0, nullptr, &error), TENDRIL_STALE_HANDLE);
    EXPECT_EQ(tendril_rope_particles(gone), 0u);
}

TEST(CRope, RunsOnTheProgramsJobs) {
    struct Jobs {
        int calls = 0;
    } jobs;
    const auto run = [](void* user, void (*task)(void*, uint32_t), void* context, uint32_t count) {
        ++static_cast<Jobs*>(user)->calls;
        std::vector<std::thread> workers;
        for (std::uint32_t i = 0; i < count; ++i) workers.emplace_back([=] { task(context, i); });
        for (std::thread& worker : workers) worker.join();
    };
    tendril_error error{};
    std::vector<std::byte> saved[2];
    for (const bool threaded : {false, true}) {
        tendril_rope_world world{};
        ASSERT_DONE(tendril_rope_world_make(nullptr, &world, &error));
        for (int i = 0; i < 4; ++i) {
            tendril_rope_shape shape = tendril_rope_shape_default();
            shape.segments = 2000, shape.pin_start = 1, shape.from.z = shape.to.z = static_cast<float>(i);
            tendril_rope_body_id rope;
            ASSERT_DONE(tendril_rope_add_rope(world, &shape, &rope, &error));
        }
        if (threaded) {
            const tendril_tasks tasks{run, &jobs};  // the world keeps a copy
            ASSERT_DONE(tendril_rope_use_threads(world, 3, &tasks, &error));
        }
        for (int i = 0; i < 3; ++i) ASSERT_DONE(tendril_rope_advance(world, frame, 0, nullptr, &error));
        saved[threaded].resize(tendril_rope_saved_bytes(world));
        ASSERT_DONE(
            tendril_rope_save(world, saved[threaded].data(), saved[threaded].size(), nullptr, &error));
        EXPECT_EQ(tendril_rope_use_threads(world, 0, nullptr, &error), TENDRIL_INVALID_ARGUMENT);
        tendril_rope_world_destroy(world);
    }
    EXPECT_GT(jobs.calls, 0);
    EXPECT_EQ(saved[0], saved[1]);
}

}  // namespace
}  // namespace tendril::test
