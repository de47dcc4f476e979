// Shared by the tests of solve_many: a crowd of chains, solved together. One by one: ik_many_scalar.hpp.
#pragma once

#include "ik_poses.hpp"
#include "memory.hpp"
#include "tendril/ik/many.hpp"

namespace tendril::test {

using ik::Batch;
using ik::ManyOptions;
using ik::ManyReport;
using ik::Status;

/// No comparison of residuals takes it for success.
inline const ManyReport refused_chain{.status = Status::InvalidInput, .residual = infinity};

/// Chains before a solve, and their targets.
struct Crowd {
    std::vector<Lengths> lengths;
    std::vector<Joints> joints;
    std::vector<glm::vec3> targets;

    std::size_t size() const { return lengths.size(); }
    std::size_t bones() const { return lengths.front().size(); }
    void add(Lengths of, Joints pose, glm::vec3 target) {
        lengths.push_back(std::move(of)), joints.push_back(std::move(pose)), targets.push_back(target);
    }
};

/// Each chain has its own lengths, root and pose; targets are between `least` and `most` of the reach.
inline Crowd some_crowd(std::size_t chains, std::size_t bones, Random& random, float least = 0.05f,
                        float most = 0.9f) {
    Crowd crowd;
    for (std::size_t i = 0; i < chains; ++i) {
        const Lengths lengths = some_lengths(bones, random);
        const glm::vec3 root = random.point(4.0f);
        const float far = between(random, least, most) * static_cast<float>(reach_of(lengths));
        const Joints pose = some_pose(lengths, random, root);
        crowd.add(lengths, pose, root + some_direction(random) * far);
    }
    return crowd;
}

inline Batch batch_of(const Crowd& crowd, int threads = 1) {
    Batch batch = *Batch::make(crowd.size(), crowd.bones(), threads);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        EXPECT_TRUE(batch.set_lengths(i, crowd.lengths[i]));
        EXPECT_TRUE(batch.set_joints(i, crowd.joints[i]));
    }
    return batch;
}

struct Answer {
    std::vector<Joints> joints;
    std::vector<ManyReport> reports;
};

/// Empty if bitwise equal; otherwise the first chain that differs.
inline std::string difference(const Answer& a, const Answer& b) {
    for (std::size_t i = 0; i < std::min(a.joints.size(), b.joints.size()); ++i) {
        if (!same_bits(a.joints[i], b.joints[i])) return "joints of chain " + std::to_string(i);
        if (!(a.reports[i] == b.reports[i])) return "report of chain " + std::to_string(i);
    }
    return {};
}

inline std::vector<Joints> joints_of(const Batch& batch) {
    std::vector<Joints> joints(batch.size(), Joints(batch.bones() + 1));
    for (std::size_t i = 0; i < batch.size(); ++i) EXPECT_TRUE(batch.copy_joints(i, joints[i]));
    return joints;
}

inline Answer solve_many(const Crowd& crowd, const ManyOptions& options, int threads = 1) {
    Batch batch = batch_of(crowd, threads);
    Answer answer{{}, std::vector<ManyReport>(crowd.size())};
    ik::solve_many(batch, crowd.targets, answer.reports, options);
    answer.joints = joints_of(batch);
    return answer;
}

inline double furthest(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double apart = distance(a[i], b[i]);
        if (!(apart <= most)) most = apart;
    }
    return most;
}

/// Expects joints equal to within `part` of the reach, and equal reports.
inline void expect_same(const Crowd& crowd, const Answer& many, const Answer& each, double part) {
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        const double reach = reach_of(crowd.lengths[i]);
        EXPECT_LE(furthest(many.joints[i], each.joints[i]), part * reach) << "chain " << i;
        EXPECT_EQ(many.reports[i].status, each.reports[i].status) << "chain " << i;
        EXPECT_EQ(many.reports[i].iterations, each.reports[i].iterations) << "chain " << i;
        EXPECT_NEAR(many.reports[i].residual, each.reports[i].residual, part * reach) << "chain " << i;
        EXPECT_TRUE(Holds(many.joints[i], crowd.lengths[i])) << "chain " << i;
        EXPECT_TRUE(same_bits(many.joints[i].front(), crowd.joints[i].front())) << "chain " << i;
        if (::testing::Test::HasFailure()) return;  // one is enough
    }
}

}  // namespace tendril::test
