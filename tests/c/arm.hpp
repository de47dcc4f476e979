// An arm solved twice: through the C interface, and by the library itself.
#pragma once

#include <gtest/gtest.h>
#include <tendril/c.h>

#include <cstring>
#include <tendril/ik/solver.hpp>
#include <vector>

#include "tests/core/random.hpp"

namespace tendril::test {

/// Fails with the message of a call that was refused.
#define EXPECT_DONE(code) EXPECT_EQ(code, TENDRIL_OK) << error.message
#define ASSERT_DONE(code) ASSERT_EQ(code, TENDRIL_OK) << error.message

inline tendril_vec3f to_c(glm::vec3 v) {
    return {v.x, v.y, v.z};
}
template <class One, class Other>
bool same_bytes(const std::vector<One>& one, const std::vector<Other>& other) {
    static_assert(sizeof(One) == sizeof(Other));
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof(One)) == 0;
}
inline tendril_ik_limit to_c(const ik::Limit& limit) {
    tendril_ik_limit c = tendril_ik_limit_default();
    c.kind = static_cast<tendril_ik_joint_kind>(limit.kind);
    c.axis = to_c(limit.axis);
    c.min = limit.min, c.max = limit.max;
    c.up = limit.up, c.down = limit.down, c.left = limit.left, c.right = limit.right;
    c.twist_min = limit.twist_min, c.twist_max = limit.twist_max;
    c.stiffness = limit.stiffness;
    return c;
}

/// A straight arm along +X, and its C twin.
class TwinArm {
  public:
    explicit TwinArm(std::vector<float> bones)
        : lengths(std::move(bones)), solver(*ik::Solver::make(lengths)), state(solver.initial_state()) {
        glm::vec3 at(0.0f);
        joints.push_back(at);
        for (const float length : lengths) joints.push_back(at += glm::vec3(length, 0.0f, 0.0f));
        for (const glm::vec3 joint : joints) c_joints.push_back(to_c(joint));
        EXPECT_DONE(tendril_ik_solver_make(lengths.data(), lengths.size(), nullptr, 0, &c_solver, &error));
        c_state.resize(TENDRIL_IK_STATE_BYTES(lengths.size()));
        EXPECT_DONE(tendril_ik_state_init(c_solver, c_state.data(), c_state.size(), &error));
    }
    ~TwinArm() { tendril_ik_solver_destroy(c_solver); }
    TwinArm(const TwinArm&) = delete;
    TwinArm& operator=(const TwinArm&) = delete;

    tendril_code solve_c(glm::vec3 target, const tendril_ik_options* options,
                         tendril_ik_method method = TENDRIL_IK_METHOD_FABRIK) {
        return tendril_ik_solve(c_solver, method, c_joints.data(), c_joints.size(), c_state.data(),
                                c_state.size(), to_c(target), options, &c_report, &error);
    }
    /// Solves both and compares every bit.
    void solve(glm::vec3 target, const ik::Options& options, const tendril_ik_options& c_options,
               ik::Method method = ik::Method::Fabrik) {
        const ik::Report report = solver.solve(method, joints, state, target, options);
        const tendril_code code = solve_c(target, &c_options, static_cast<tendril_ik_method>(method));
        ASSERT_EQ(code == TENDRIL_OK, report.status != ik::Status::InvalidInput) << error.message;
        if (code != TENDRIL_OK) return;
        EXPECT_TRUE(same_bytes(joints, c_joints));
        EXPECT_EQ(static_cast<int>(report.status), static_cast<int>(c_report.status));
        EXPECT_EQ(report.iterations, c_report.iterations);
        EXPECT_EQ(report.residual, c_report.residual);
        EXPECT_EQ(report.off_plane, c_report.off_plane);
        std::vector<tendril_quatf> turns(lengths.size());
        EXPECT_DONE(tendril_ik_state_rotations(c_solver, c_state.data(), c_state.size(), turns.data(),
                                               turns.size(), nullptr, 0, &error));
        EXPECT_TRUE(same_bytes(state.rotations, turns));
    }

    std::vector<float> lengths;
    ik::Solver solver;
    ik::State state;
    std::vector<glm::vec3> joints;
    tendril_ik_solver c_solver{};
    std::vector<std::byte> c_state;
    std::vector<tendril_vec3f> c_joints;
    tendril_ik_report c_report = tendril_ik_report_default();
    tendril_error error{};
};

}  // namespace tendril::test
