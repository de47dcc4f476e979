// Cost of a rope substep: by particles, by colliders far and near, and for many ropes with and without vector
// units.
//
// Claims: a rope of 1024 segments among 16 colliders takes at most 450 loops (measure.hpp) per frame; with
// 256 distant colliders it takes at most 1.5 times as long as with none; one that resists bending takes at
// most 6 times as long as one that does not; vector units pay off for 200 ropes of 32 segments. Times are
// processor time.
#include "rope_stage.hpp"
#include "tendril/ik/many.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;

constexpr int repetitions = 9;
constexpr double frame = 1.0 / 60.0;

/// Hung between two points, with four metres of rope for every three metres of distance.
Stage hung(int segments) {
    Stage stage;
    const float span = 3.0f;
    static_cast<void>(stage.world.add_rope({.from = {0, 0, 0},
                                            .to = {span, 0, 0},
                                            .segments = segments,
                                            .length = 4.0f,
                                            .radius = 0.01f,
                                            .pin_start = true,
                                            .pin_end = true}));
    stage.advance(24);  // sizes its buffers
    return stage;
}

/// Balls on a grid far below, or all along the rope with half of them touching it.
void add_colliders(Stage& stage, int count, bool near) {
    const std::size_t particles = stage.world.size();
    for (int i = 0; i < count; ++i) {
        const auto n = static_cast<float>(i);
        glm::vec3 at(n * 0.5f, -50.0f, std::fmod(n, 16.0f));
        if (near) {
            const auto along = static_cast<std::size_t>((i + 0.5) / count * static_cast<double>(particles));
            at = glm::vec3(stage.world.position(along)) - glm::vec3(0, i % 2 == 0 ? 0.05f : 0.12f, 0);
        }
        static_cast<void>(stage.world.add_collider(rope::Sphere{at, 0.05f}));
    }
    stage.advance(24);
}

/// Enough frames for a few milliseconds.
int frames_for(int segments) {
    return std::max(1, 16384 / segments);
}

void run_frames(Stage& stage, int frames) {
    for (int i = 0; i < frames; ++i) stage.world.advance(frame, stage.workspace);
}

/// Microseconds per substep: without colliders, with 16 and 256 far away, with 16 and 256 near.
std::vector<double> cost(int segments) {
    std::vector<Stage> worlds;
    for (const auto& [count, near] :
         {std::pair{0, false}, {16, false}, {256, false}, {16, true}, {256, true}}) {
        worlds.push_back(hung(segments));
        add_colliders(worlds.back(), count, near);
    }
    const int frames = frames_for(segments);
    std::vector<std::function<void()>> runs;
    for (Stage& world : worlds) runs.push_back([&world, frames] { run_frames(world, frames); });
    std::vector<double> micros;
    for (const double seconds : race(runs, repetitions)) micros.push_back(seconds * 1e6 / (4.0 * frames));
    return micros;
}

struct Gains {
    double far = 0.0;
    double frame = 0.0;  ///< microseconds
};

Gains particle_table() {
    std::printf(
        "us a substep of 1/240 s, one rope, direct solver, by segments and colliders; medians of %d\n",
        repetitions);
    std::printf("%-12s%12s%12s%12s%12s%12s%18s\n", "", "none", "16 far", "256 far", "16 near", "256 near",
                "ns a segment");
    Gains gains;
    for (const int segments : {64, 1024, 16384}) {
        const std::vector<double> micros = cost(segments);
        std::printf("%-12d", segments);
        for (const double each : micros) std::printf("%12.2f", each);
        std::printf("%18.1f\n", micros[0] * 1e3 / segments);
        if (segments != 1024) continue;
        gains.far = micros[0] / micros[2];
        gains.frame = 4.0 * std::max(micros[1], micros[3]);
    }
    return gains;
}

/// A rope that resists bending over one that does not: at rest, and swinging by one end.
double bending_table() {
    const auto stage_of = [](float bending, bool swings) {
        Stage stage = hung(1024);
        const rope::BodyId id = stage.world.state().bodies.front().id;
        require(stage.world.set_bending(id, bending));
        if (swings) require(stage.world.unpin(1024));
        stage.advance(24);
        return stage;
    };
    std::printf("\nus a substep, 1024 segments, by bending stiffness\n");
    std::printf("%-12s%12s%12s%12s\n", "", "0", "0.01 N m^2", "ratio");
    double most = 0.0;
    for (const bool swings : {false, true}) {
        Stage limp = stage_of(0.0f, swings), stiff = stage_of(0.01f, swings);
        const std::vector<double> seconds =
            race({[&] { run_frames(limp, 8); }, [&] { run_frames(stiff, 8); }}, repetitions);
        const double ratio = seconds[1] / seconds[0];
        std::printf("%-12s%12.2f%12.2f%12.2f\n", swings ? "swinging" : "at rest", seconds[0] * 1e6 / 32.0,
                    seconds[1] * 1e6 / 32.0, ratio);
        most = std::max(most, ratio);
    }
    return most;
}

/// Hung by one end, in rows of 20.
rope::World hung_ropes(int ropes, int segments) {
    rope::World world;
    for (int i = 0; i < ropes; ++i) {
        const auto x = static_cast<float>(i % 20), z = static_cast<float>(i / 20);
        static_cast<void>(world.add_rope({.from = {x, 0, z},
                                          .to = {x + 0.5f, 0, z},
                                          .segments = segments,
                                          .length = 1.0f,
                                          .pin_start = true}));
    }
    return world;
}

/// The speed-up of the widest unit over none.
double crowd_table() {
    constexpr int ropes = 200, segments = 32;
    const rope::World start = hung_ropes(ropes, segments);
    std::vector<std::string> names{"none"};
    for (const std::string_view unit : tendril::ik::vector_units()) names.emplace_back(unit);
    std::vector<Stage> worlds(names.size());
    std::vector<std::function<void()>> runs;
    for (std::size_t i = 0; i < names.size(); ++i) {
        worlds[i].world = start;
        static_cast<void>(worlds[i].workspace.use_vector_unit(names[i]));
        runs.push_back([&world = worlds[i]] { run_frames(world, 4); });
    }
    const std::vector<double> seconds = race(runs, repetitions);
    std::printf("\nus a substep, %d ropes of %d segments, by vector unit\n", ropes, segments);
    for (std::size_t i = 0; i < names.size(); ++i)
        std::printf("%-12s%12.2f%8.2fx\n", names[i].c_str(), seconds[i] * 1e6 / 16.0,
                    seconds[0] / seconds[i]);
    return seconds[0] / *std::min_element(seconds.begin(), seconds.end());
}

}  // namespace

int main(int count, char** arguments) {
    const Gains gains = particle_table();
    const double bending = bending_table();
    const double units = crowd_table();
    std::printf("\n");
    bool all = claim_loops("a frame of 1024 segments among 16 colliders", 1e-6 * gains.frame, 450);
    all &= claim("time without colliders over that with 256 far ones", gains.far, 0.67);
    all &= claim("200 ropes without vector units over with", units, 1.5);
    all &= claim("6 times a limp rope over one that resists bending", 6.0 / bending, 1.0);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
