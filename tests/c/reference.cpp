// Prints the same as reference.c, by the library itself.
#include <cstdio>
#include <cstring>
#include <tendril/ik/solver.hpp>
#include <vector>

namespace {

using namespace tendril;

void print_bits(float number) {
    std::uint32_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    std::printf(" %08x", static_cast<unsigned>(bits));
}

void solve(const std::vector<float>& lengths, glm::vec3 target, ik::Method method) {
    ik::Solver solver = *ik::Solver::make(lengths);
    ik::State state = solver.initial_state();
    std::vector<glm::vec3> joints{glm::vec3(0.0f)};
    for (const float length : lengths) joints.push_back(joints.back() + glm::vec3(length, 0.0f, 0.0f));
    ik::Options options;
    options.rotations = true;
    const ik::Report report = solver.solve(method, joints, state, target, options);
    std::printf("%s %s %d", ik::name(method), ik::name(report.status), report.iterations);
    print_bits(report.residual);
    for (const glm::vec3 joint : joints) print_bits(joint.x), print_bits(joint.y), print_bits(joint.z);
    for (const glm::quat turn : state.rotations)
        print_bits(turn.x), print_bits(turn.y), print_bits(turn.z), print_bits(turn.w);
    std::printf("\n");
}

}  // namespace

int main() {
    std::size_t bones;
    while (std::scanf("%zu", &bones) == 1) {
        std::vector<float> lengths(bones);
        glm::vec3 target;
        for (float& length : lengths)
            if (std::scanf("%f", &length) != 1) return 1;
        if (std::scanf("%f %f %f", &target.x, &target.y, &target.z) != 3) return 1;
        for (const ik::Method method : {ik::Method::Fabrik, ik::Method::Ccd, ik::Method::Dls})
            solve(lengths, target, method);
    }
}
