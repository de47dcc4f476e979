// Cost of ropes and cloth in contact, over sizes and states: at rest, pressed, freed. Their length is in
// tests/core/rope_resolution_test.cpp and rope_cloth_sizes_test.cpp.
//
// Claims: a segment of a rope of 4096 over 4 balls costs at most twice one of 1024; 1024 segments with 256
// balls pressed into them take at most 600 loops (measure.hpp) per substep; a cloth of 64 x 64 that falls on
// a ball takes at most 1.5 times as long as one that is held.
//
// Not claimed, because it does not hold: a cloth of 64 x 64 in 8 ms per frame (10 by two corners or on a
// ball). Times are processor time.
#include "measure.hpp"
#include "tendril/rope/world.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;

constexpr double frame = 1.0 / 60.0;

/// Microseconds of individual frames.
struct Frames {
    std::vector<double> times;

    double at(double part) {
        std::sort(times.begin(), times.end());
        return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
    }
};

struct Stage {
    rope::World world;
    rope::Workspace workspace;
    std::uint64_t unconverged = 0;

    Frames run(double seconds, const std::source_location& where = std::source_location::current()) {
        Frames frames;
        for (int i = 0; i < static_cast<int>(std::lround(seconds / frame)); ++i) {
            const double from = cpu_seconds();
            unconverged += world.advance(frame, workspace).unconverged;
            frames.times.push_back(1e6 * (cpu_seconds() - from));
        }
        record({1e-6 * frames.at(0.5)}, where);
        return frames;
    }
};

rope::ColliderId ball(rope::World& world, glm::vec3 at, float radius) {
    const auto added = world.add_collider(rope::Sphere{at, radius});
    require(added.error());
    return *added;
}

/// Four metres between points three metres apart.
Stage hung(int segments) {
    Stage stage;
    require(stage.world
                .add_rope({.from = {0, 1, 0},
                           .to = {3, 1, 0},
                           .segments = segments,
                           .length = 4.0f,
                           .radius = 0.01f,
                           .pin_start = true,
                           .pin_end = true})
                .error());
    return stage;
}

/// Nanoseconds per segment and substep, moving or at rest, whichever is more.
double over_balls(int segments) {
    Stage stage = hung(segments);
    for (int i = 0; i < 4; ++i) ball(stage.world, {0.6f + 0.6f * static_cast<float>(i), 0.1f, 0.0f}, 0.2f);
    // They begin inside it: the time until that is resolved is not measured.
    stage.run(1.0);
    Frames moving = stage.run(2.0), resting;
    stage.run(2.0);
    resting = stage.run(1.0);
    const double cost = 1e3 / (4.0 * segments) * std::max(moving.at(0.5), resting.at(0.5));
    std::printf("%-10d%12.1f%12.1f%12.1f%12.1f%14llu\n", segments, moving.at(0.5), moving.at(0.99),
                resting.at(0.5), cost, static_cast<unsigned long long>(stage.unconverged));
    return cost;
}

/// Balls that appear half inside a rope, all along it. Microseconds per substep once that is resolved.
double pressed(int segments) {
    constexpr int balls = 256;
    Stage stage = hung(segments);
    stage.run(0.1);
    for (int i = 0; i < balls; ++i) {
        const auto along = static_cast<std::size_t>((i + 0.5) / balls * segments);
        const glm::vec3 at = glm::vec3(stage.world.position(along));
        if (at.x < 0.05f || at.x > 2.95f) continue;  // pinned particles cannot get out
        ball(stage.world, at - glm::vec3(0, i % 2 == 0 ? 0.05f : 0.03f, 0), 0.05f);
    }
    Frames first = stage.run(1.0), later = stage.run(2.0);
    std::printf("%-10d%12.1f%12.1f%12.1f%14llu\n", segments, first.at(0.5) / 4.0, first.at(0.99) / 4.0,
                later.at(0.5) / 4.0, static_cast<unsigned long long>(stage.unconverged));
    return later.at(0.5) / 4.0;
}

/// Microseconds of a frame. One metre along each side, released flat: held by two corners, or above a ball
/// and a floor.
double cloth(int side, bool held) {
    Stage stage;
    if (!held) {
        ball(stage.world, {0.5f, -0.4f, 0.5f}, 0.3f);
        require(stage.world.add_collider(rope::Plane{{0, -1, 0}, {0, 1, 0}}).error());
    }
    require(stage.world
                .add_cloth({.corner = {0, 0, 0},
                            .along = {1, 0, 0},
                            .down = {0, 0, 1},
                            .columns = side,
                            .rows = side,
                            .pins = held ? rope::ClothShape::Pins::Corners : rope::ClothShape::Pins::None})
                .error());
    Frames frames = stage.run(side > 64 ? 1.0 : 3.0);
    std::printf("%-10d%12.1f%12.1f\n", side, frames.at(0.5), frames.at(0.99));
    return frames.at(0.5);
}

}  // namespace

int main(int count, char** arguments) {
    const auto columns = [](std::initializer_list<const char*> names) {
        std::printf("%-10s", "segments");
        for (const char* name : names) std::printf("%12s", name);
        std::printf("\n");
    };
    std::printf("4 m of rope over 4 balls; us a frame\n");
    columns({"moving p50", "p99", "resting", "ns/segment", "unconverged"});
    double coarse = 0.0, fine = 0.0;
    for (const int n : {64, 256, 1024, 1100, 1536, 4096}) {
        fine = over_balls(n);
        if (n == 1024) coarse = fine;
    }
    std::printf("\n256 balls pressed into it; us a substep\n");
    columns({"p50", "p99", "later", "unconverged"});
    double press = 0.0;
    for (const int n : {256, 1024, 4096}) {
        const double micros = pressed(n);
        if (n == 1024) press = micros;
    }
    double cloths[2] = {};
    for (const bool held : {true, false}) {
        std::printf("\ncloth %s; us a frame\n", held ? "by two corners" : "over a ball and a floor");
        columns({"p50", "p99"});
        for (const int n : {16, 24, 48, 64, 128})
            if (const double micros = cloth(n, held); n == 64) cloths[held] = micros;
    }
    std::printf("\n");

    bool all = claim("cost of 1024 segments over that of 4096, by the segment", coarse / fine, 0.5);
    all &= claim_loops("a substep of 1024 segments and 256 balls", 1e-6 * press, 600);
    all &= claim("cost of a cloth of 64 x 64 by two corners over that on a ball",
                 cloths[true] / cloths[false], 0.66);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
