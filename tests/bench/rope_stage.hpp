// A world of ropes with its workspace, and what a substep costs with and without one of their features.
#pragma once

#include "measure.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::bench {

struct Stage {
    rope::World world;
    rope::Workspace workspace;

    void advance(int substeps) {
        for (int i = 0; i < substeps; ++i) world.advance(world.settings().substep, workspace);
    }
};

/// Microseconds a substep, without and with it.
inline std::vector<double> cost(Stage without, Stage with, int substeps, int repetitions) {
    std::vector<double> micros;
    for (const double seconds :
         race({[&] { without.advance(substeps); }, [&] { with.advance(substeps); }}, repetitions))
        micros.push_back(seconds * 1e6 / substeps);
    return micros;
}

inline void print_row(const char* what, int size, const std::vector<double>& micros) {
    std::printf("%-24s%10d%12.2f%12.2f%10.2f\n", what, size, micros[0], micros[1], micros[1] / micros[0]);
}

}  // namespace tendril::bench
