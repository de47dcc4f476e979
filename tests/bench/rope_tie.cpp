// Cost of ties: the same bodies tied and untied.
//
// Claims: tied, two ropes of 32 to 2048 segments take at most 2.3 times as long as untied, and a cloth of
// 16 x 16 to 64 x 64 on a rope, by every other particle of a side, twice. Times are processor time.
#include "rope_stage.hpp"

namespace {

using namespace tendril::bench;
namespace rope = tendril::rope;

constexpr int repetitions = 5;

/// Two ropes one above the other, with a tie every eighth particle: a bridge with hangers.
Stage bridge(int segments, bool tied) {
    Stage stage;
    const auto add = [&](float height, float density) {
        return *stage.world.add_rope({.from = {0, height, 0},
                                      .to = {4, height, 0},
                                      .segments = segments,
                                      .length = 4.4f,
                                      .density = density,
                                      .pin_start = true,
                                      .pin_end = true});
    };
    const rope::BodyId above = add(1.0f, 0.5f), below = add(0.5f, 2.0f);
    for (int i = 4; tied && i < segments; i += 8) {
        const auto at = static_cast<std::size_t>(i);
        static_cast<void>(stage.world.tie(*stage.world.particle(above, at), *stage.world.particle(below, at),
                                          {.length = 0.5f}));
    }
    stage.advance(240);
    return stage;
}

/// A cloth under a slack rope, by every other particle of its first row, or by two corners.
Stage line(int side, bool tied) {
    Stage stage;
    const rope::BodyId above = *stage.world.add_rope({.from = {0.2f, 1, 0},
                                                      .to = {1.8f, 1, 0},
                                                      .segments = side - 1,
                                                      .length = 1.68f,
                                                      .pin_start = true,
                                                      .pin_end = true});
    const rope::BodyId sheet = *stage.world.add_cloth(
        {.corner = {0.2f, 0.8f, 0},
         .along = {1.6f, 0, 0},
         .down = {0, -1.6f, 0.2f},
         .columns = side,
         .rows = side,
         .pins = tied ? rope::ClothShape::Pins::None : rope::ClothShape::Pins::Corners});
    for (int i = 0; tied && i < side; i += 2) {
        const auto at = static_cast<std::size_t>(i);
        static_cast<void>(stage.world.tie(*stage.world.particle(above, at), *stage.world.particle(sheet, at),
                                          {.length = 0.05f}));
    }
    stage.advance(120);
    return stage;
}

/// Untied and tied.
std::vector<double> cost(Stage (*make)(int, bool), int size, int substeps) {
    return cost(make(size, false), make(size, true), substeps, repetitions);
}

}  // namespace

int main(int count, char** arguments) {
    std::printf("us a substep of 1/240 s; medians of %d\n%-24s%10s%12s%12s%10s\n", repetitions, "", "size",
                "untied", "tied", "ratio");
    double ropes = 1.0, cloths = 1.0;
    for (const int segments : {32, 128, 512, 2048}) {
        const std::vector<double> micros = cost(bridge, segments, 20000 / segments);
        print_row("two ropes", segments, micros);
        ropes = std::min(ropes, micros[0] / micros[1]);
    }
    for (const int side : {8, 16, 24, 32, 48, 64}) {
        const std::vector<double> micros = cost(line, side, 6000 / (side * side) + 4);
        print_row("cloth on a rope", side, micros);
        if (side >= 16) cloths = std::min(cloths, micros[0] / micros[1]);
    }
    std::printf("\n");
    bool all = claim("two ropes untied over tied", ropes, 1.0 / 2.3);
    all &= claim("a cloth of 16 x 16 or more untied over tied", cloths, 0.5);
    return all || !has_flag(count, arguments, "--check") ? 0 : 1;
}
