// Input that every method must withstand: any chain, any pose, any target.
#pragma once

#include "ik_support.hpp"
#include "tests/labels.hpp"

namespace tendril::test {

inline glm::dvec3 cross(glm::dvec3 a, glm::dvec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(glm::dvec3 a, glm::dvec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A distance between two fractions of the reach; longer if a long bone makes nearer targets unreachable.
inline float some_span(std::span<const float> lengths, float least, float most, Random& random) {
    const auto reach = static_cast<float>(reach_of(lengths));
    const float hole = 2.0f * *std::max_element(lengths.begin(), lengths.end()) - reach;
    return std::max(reach * between(random, least, most), hole + 0.02f * reach);
}

/// Lengths of 1 mm to 1 km, sometimes 0.
inline Lengths hostile_lengths(Random& random) {
    Lengths lengths(1 + random.below(random.chance(4) ? 40 : 8));
    const float scales[] = {1e-3f, 0.1f, 1.0f, 1.0f, 30.0f, 1e3f};
    const float scale = scales[random.below(std::size(scales))];
    for (float& length : lengths) {
        length = scale * between(random, 0.1f, 1.0f);
        if (random.chance(10)) length = scales[random.below(std::size(scales))];
        if (random.chance(12)) length = 0.0f;
    }
    return lengths;
}

/// A straight, folded or random pose.
inline Joints hostile_pose(std::span<const float> lengths, Random& random) {
    const glm::vec3 root = random.chance(3) ? random.point(100.0f) : glm::vec3(0.0f);
    const glm::vec3 along = random.chance(2) ? glm::vec3(1, 0, 0) : some_direction(random);
    if (random.chance(4)) return straight_joints(lengths, along, root);
    if (!random.chance(4)) return some_pose(lengths, random, root);
    Joints joints{root};
    for (const float length : lengths)
        joints.push_back(joints.back() + along * (random.chance(2) ? length : -length));
    return joints;
}

/// A target on a joint, on the line, on the rim, on the root, far away, or anywhere.
inline glm::vec3 hostile_target(const Joints& joints, std::span<const float> lengths, Random& random) {
    const glm::vec3 root = joints.front();
    const auto reach = static_cast<float>(reach_of(lengths));
    switch (random.below(9)) {
        case 0:
            return joints[random.below(joints.size())];
        case 1:
            return root + (joints.back() - root) * random.around(1.5f);
        case 2:
            return root + some_direction(random) * reach;
        case 3:
            return root;
        case 4:
            return random.point(1e9f);
        case 5:
            return root + glm::vec3(1, 0, 0) * (reach * random.around(1.0f));
        default:
            return root + some_offset(random, 0.0f, reach);
    }
}

/// Expects kept lengths, finite output, a tip no further off than before, and repeatable bits.
inline void expect_invariants(ik::Method method, std::span<const float> lengths, const Joints& start,
                              glm::vec3 target, const ik::Options& options) {
    KeptSolver solver(lengths), again(lengths);
    Joints joints = start, twin = start;
    const ik::Report report = solver.solve(method, joints, target, options);
    EXPECT_NE(report.status, ik::Status::InvalidInput);
    EXPECT_TRUE(same_bits(joints.front(), start.front()));
    EXPECT_TRUE(Holds(joints, lengths));
    const double before = distance(start.back(), target), after = distance(joints.back(), target);
    const double reach = reach_of(lengths), rounding = 2e-6 * (reach + before + distance(start.front(), {}));
    const double tolerance = static_cast<double>(options.tolerance.value_or(0.0f));
    EXPECT_LE(after, std::max(before, tolerance) + rounding);
    EXPECT_NEAR(report.residual, after, rounding);

    Recorder recorder;
    const ik::Report same = again.solve(method, twin, target, options, &recorder);
    EXPECT_EQ(same, report);
    EXPECT_TRUE(same_bits(joints, twin)) << "watched, or a second time, it went elsewhere";
    EXPECT_TRUE(same_bits(recorder.replay(start), joints)) << "the steps that were shown lead elsewhere";
}

inline void expect_invariants_always(ik::Method method, int solves) {
    Random random(given_seed());
    for (int k = 0; k < solves && !::testing::Test::HasFailure(); ++k) {
        SCOPED_TRACE("solve " + std::to_string(k));
        const Lengths lengths = hostile_lengths(random);
        const Joints start = hostile_pose(lengths, random);
        const glm::vec3 target = hostile_target(start, lengths, random);
        ik::Options options{.max_iterations = 1 + static_cast<int>(random.below(40)),
                            .every_iteration = random.chance(5)};
        if (random.chance(4)) options.damping = 1e-6f;
        // Farther out, the spacing of floats exceeds the tolerance of bone lengths.
        const bool near = reach_of(lengths) < 500.0;
        if (random.chance(3) && near) options.pole = hostile_target(start, lengths, random);
        if (random.chance(2)) options.pole_turn = ik::PoleTurn::EachJoint;
        if (random.chance(4)) options.tolerance = 0.0f;
        expect_invariants(method, lengths, start, target, options);
    }
}

}  // namespace tendril::test
