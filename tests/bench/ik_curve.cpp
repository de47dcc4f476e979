// Cost of placing a chain along a curve.
//
// Claim: 30 bones take at most 7 loops (measure.hpp) along 2 to 8 points, without fit.
#include "measure.hpp"
#include "tendril/ik/curve.hpp"

namespace {

using namespace tendril::bench;
namespace ik = tendril::ik;

constexpr int frames = 50;

struct Case {
    Case(std::size_t bones, std::size_t count)
        : lengths(bones, 8.0f / static_cast<float>(bones)),
          joints(bones + 1),
          points(count),
          state(bones),
          memory(bones) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto along = static_cast<float>(i);
            points[i] = {along * 8.0f / static_cast<float>(count), 0.3f * std::sin(along),
                         0.3f * std::cos(2 * along)};
        }
    }
    void place(bool fit) {
        for (int i = 0; i < frames; ++i) {
            points[1].y += 1e-5f;
            ik::place_along(points, {lengths, {}}, joints, state, memory, {.fit = fit});
        }
    }

    std::vector<float> lengths;
    std::vector<glm::vec3> joints, points;
    ik::State state;
    ik::CurveMemory memory;
};

}  // namespace

int main(int count, char** arguments) {
    std::printf("%-8s%-8s%12s%12s\n", "bones", "points", "us", "us, fitted");
    double slowest = 0.0;
    for (const std::size_t bones : {8u, 30u, 128u})
        for (const std::size_t points : {2u, 4u, 8u, 64u}) {
            Case each(bones, points);
            const std::vector<double> seconds =
                race({[&] { each.place(false); }, [&] { each.place(true); }}, 31);
            constexpr double us = 1e6 / frames;
            std::printf("%-8zu%-8zu%12.2f%12.2f\n", bones, points, us * seconds[0], us * seconds[1]);
            if (bones == 30 && points <= 8) slowest = std::max(slowest, us * seconds[0]);
        }
    const bool fast = claim_loops("30 bones along 2 to 8 points", 1e-6 * slowest, 7);
    return fast || !has_flag(count, arguments, "--check") ? 0 : 1;
}
