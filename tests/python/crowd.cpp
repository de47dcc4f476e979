// 100 000 chains of 8 bones solved together, for crowd.py to compare with: prints the seconds of the fastest
// round.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <tendril/ik/many.hpp>
#include <vector>

int main() {
    using namespace tendril;
    constexpr std::size_t chains = 100'000, bones = 8;
    ik::Batch batch = *ik::Batch::make(chains, bones);
    std::vector<glm::vec3> rest, targets;
    for (std::size_t i = 0; i < chains; ++i) {
        for (std::size_t j = 0; j <= bones; ++j) rest.emplace_back(static_cast<float>(j), 0.0f, 0.0f);
        const auto part = [i](std::size_t step) { return static_cast<float>(i * step % 1024) / 256.0f; };
        targets.emplace_back(part(37), part(91) - 1.0f, part(53) - 2.0f);
    }
    double fastest = 1e9;
    std::vector<ik::ManyReport> reports(chains);
    for (int round = 0; round < 15; ++round) {
        std::vector<glm::vec3> joints = rest;
        const std::clock_t began = std::clock();
        ik::solve_many(batch, joints, targets, reports, {});
        fastest = std::min(fastest, static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC);
    }
    std::printf("%.6f\n", fastest);
}
