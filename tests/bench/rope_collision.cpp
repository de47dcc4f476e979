// Cost of collisions between ropes: the same ropes with collisions switched on and off.
//
// Claim: ropes that collide but are apart take at most 1.6 times as long, with 256 and 4 096 particles.
#include "rope_stage.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;

constexpr int repetitions = 5, segments = 63;

void collide(Stage& stage, bool on) {
    const std::vector<rope::Body> bodies = stage.world.state().bodies;
    for (const rope::Body& a : bodies)
        for (const rope::Body& b : bodies)
            if (a.id.index <= b.id.index) static_cast<void>(stage.world.set_collides(a.id, b.id, on));
}

/// A rope that hangs between two pins a metre apart.
void hang(Stage& stage, float z) {
    static_cast<void>(stage.world.add_rope({.from = {0, 1, z},
                                            .to = {1, 1, z},
                                            .segments = segments,
                                            .length = 1.1f,
                                            .radius = 0.01f,
                                            .pin_start = true,
                                            .pin_end = true}));
}

/// Ropes side by side.
Stage apart(int particles) {
    Stage stage;
    for (int i = 0; i < particles / (segments + 1); ++i) hang(stage, 0.1f * static_cast<float>(i));
    return stage;
}

/// Without collisions and with them, from the same moment on.
std::vector<double> cost(int particles, int substeps) {
    Stage on = apart(particles);
    collide(on, true);
    on.advance(120);
    Stage off;
    off.world = on.world;
    collide(off, false);
    return cost(std::move(off), std::move(on), substeps, repetitions);
}

}  // namespace

int main(int count, char** arguments) {
    std::printf("us a substep of 1/240 s; medians of %d\n%-24s%10s%12s%12s%10s\n", repetitions, "",
                "particles", "off", "on", "ratio");
    double ratio = 1.0;
    for (const int particles : {256, 4096}) {
        const std::vector<double> micros = cost(particles, 400000 / particles);
        print_row("apart", particles, micros);
        ratio = std::min(ratio, micros[0] / micros[1]);
    }
    std::printf("\n");
    const bool all = claim("ropes apart, off over on", ratio, 1.0 / 1.6);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
