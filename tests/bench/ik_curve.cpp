// Cost of placing a chain along a curve, against marching along samples of it, the usual way.
//
// The baseline takes 100 samples a piece and the first beyond a bone's length, interpolated with the one
// before: joints are up to a hundredth of a piece off, there are no rotations, and a fold between two samples
// is missed. Its cost grows with the number of pieces, the exact method's with the number of bones.
//
// Claim: 30 bones take at most 7 loops (measure.hpp) along 2 to 8 points, without fit.
#include <glm/geometric.hpp>

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
    void exact(bool fit) {
        for (int i = 0; i < frames; ++i) {
            points[1].y += 1e-5f;
            ik::place_along(points, {lengths, {}}, joints, state, memory, {.fit = fit});
        }
    }
    void marched() {
        for (int i = 0; i < frames; ++i) {
            points[1].y += 1e-5f;
            std::size_t joint = 1;
            glm::vec3 before = points[0];
            joints[0] = before;
            for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                const glm::vec3 a = points[k], b = points[k + 1];
                const glm::vec3 slope_a = k > 0 ? 0.5f * (b - points[k - 1]) : b - a;
                const glm::vec3 slope_b = k + 2 < points.size() ? 0.5f * (points[k + 2] - a) : b - a;
                for (int sample = 1; sample <= 100; ++sample) {
                    const float t = 0.01f * static_cast<float>(sample), s = 1.0f - t;
                    const glm::vec3 at =
                        s * s * ((1 + 2 * t) * a + t * slope_a) + t * t * ((1 + 2 * s) * b - s * slope_b);
                    while (joint < joints.size()) {
                        const float far = glm::distance(at, joints[joint - 1]);
                        if (far < lengths[joint - 1]) break;
                        const float near = glm::distance(before, joints[joint - 1]);
                        joints[joint] = glm::mix(before, at, (lengths[joint - 1] - near) / (far - near));
                        ++joint;
                    }
                    before = at;
                }
            }
            const glm::vec3 ray = glm::normalize(points.back() - points[points.size() - 2]);
            for (; joint < joints.size(); ++joint)
                joints[joint] = joints[joint - 1] + lengths[joint - 1] * ray;
        }
    }

    std::vector<float> lengths;
    std::vector<glm::vec3> joints, points;
    ik::State state;
    ik::CurveMemory memory;
};

}  // namespace

int main(int count, char** arguments) {
    std::printf("%-8s%-8s%12s%12s%12s%10s\n", "bones", "points", "us", "us, fitted", "us marched", "times");
    double slowest = 0.0;
    for (const std::size_t bones : {8u, 30u, 128u})
        for (const std::size_t points : {2u, 4u, 8u, 64u}) {
            Case each(bones, points), other(bones, points);
            const std::vector<double> seconds =
                race({[&] { each.exact(false); }, [&] { each.exact(true); }, [&] { other.marched(); }}, 31);
            const double us = 1e6 / frames, ratio = seconds[0] / seconds[2];
            std::printf("%-8zu%-8zu%12.2f%12.2f%12.2f%10.2f\n", bones, points, us * seconds[0],
                        us * seconds[1], us * seconds[2], ratio);
            if (bones == 30 && points <= 8) slowest = std::max(slowest, us * seconds[0]);
        }
    const bool fast = claim_loops("30 bones along 2 to 8 points", 1e-6 * slowest, 7);
    return fast || !has_flag(count, arguments, "--check") ? 0 : 1;
}
