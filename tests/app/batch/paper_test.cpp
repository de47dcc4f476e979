// `tendril paper`: its measurements, and the built program's table. No test depends on timing.
#include "app/batch/paper.hpp"

#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using Strings = std::vector<std::string>;

float length_of(const glm::vec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

TEST(Paper, TargetsAreWithinTheirRangesAndReproducible) {
    const app::PaperTargets near = app::reachable_targets(), far = app::unreachable_targets();
    ASSERT_EQ(near.targets.size(), app::paper_count);
    ASSERT_EQ(near.starts.size(), app::paper_count * (app::paper_bones + 1));
    EXPECT_EQ(near.targets, app::reachable_targets().targets);
    EXPECT_EQ(near.starts, app::reachable_targets().starts);
    for (std::size_t i = 0; i < app::paper_count; ++i) {
        EXPECT_LT(length_of(near.targets[i]), 0.951f);
        EXPECT_GT(length_of(far.targets[i]), 1.049f);
        const glm::vec3* const joints = near.starts.data() + i * (app::paper_bones + 1);
        EXPECT_EQ(joints[0], glm::vec3(0.0f));
        for (std::size_t bone = 0; bone < app::paper_bones; ++bone)
            EXPECT_NEAR(length_of(joints[bone + 1] - joints[bone]), app::paper_bone_length, 1e-6f);
    }
}

TEST(Paper, ARowCountsWhatTheSolverReports) {
    const app::PaperTargets targets = app::reachable_targets();
    int call = 0;
    const auto solve = [&](std::span<glm::vec3> joints, glm::vec3) {
        EXPECT_EQ(joints.size(), app::paper_bones + 1);
        // One in four is not solved and takes nine iterations.
        const bool solved = call++ % 4 != 0;
        return ik::Report{solved ? ik::Status::Converged : ik::Status::Stalled, solved ? 1 : 9, 0.0f};
    };
    double last = -1.0;
    const auto row = app::measure(targets, solve, [&](double done) {
        EXPECT_GT(done, last);
        EXPECT_LT(done, 1.0);
        last = done;
        return true;
    });
    ASSERT_TRUE(row);
    EXPECT_DOUBLE_EQ(row->solved, 0.75);
    EXPECT_DOUBLE_EQ(row->mean_iterations, 3.0);
    EXPECT_DOUBLE_EQ(row->median_iterations, 1.0);
    EXPECT_GT(row->microseconds, 0.0);
    EXPECT_NEAR(row->nanoseconds.value(), row->microseconds * 1000.0 / 3.0, 1e-6 * *row->nanoseconds);
}

TEST(Paper, StopsOnRequestAndReportsNoCostPerIterationWithoutIterations) {
    const app::PaperTargets targets = app::unreachable_targets();
    const auto solve = app::paper_solver(ik::Method::Fabrik);
    EXPECT_FALSE(app::measure(targets, solve, [](double done) { return done < 0.5; }));
    const auto row = app::measure(targets, solve, [](double) { return true; });
    ASSERT_TRUE(row);
    EXPECT_EQ(row->solved, 1.0);
    EXPECT_EQ(row->mean_iterations, 0.0);
    EXPECT_FALSE(row->nanoseconds);
}

Strings lines_of(const std::string& text) {
    Strings lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST(Paper, PrintsARowForEachSolverAndKindOfTarget) {
    const Outcome outcome = run_program({"paper", "--csv"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const Strings lines = lines_of(outcome.out);
    ASSERT_EQ(lines.size(), 13u);
    EXPECT_EQ(lines[0],
              "targets,solver,solved,mean_iterations,median_iterations,microseconds_per_solve,"
              "nanoseconds_per_iteration");
    const Strings solvers{"fabrik", "fabrik_plain", "ccd", "jacobian_transpose", "dls", "svd_dls"};
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::string kind = i <= 6 ? "reachable," : "unreachable,";
        EXPECT_TRUE(lines[i].starts_with(kind + solvers[(i - 1) % 6] + ",")) << lines[i];
        if (i > 6 || (i - 1) % 6 < 2) {
            EXPECT_TRUE(has(lines[i], ",1.0000,"));
        }
    }
    EXPECT_EQ(count_lines(run_program({"paper"}).out), 16);
    EXPECT_TRUE(complained(run_program({"paper", "cases.json"}), 2, {"cases.json"}));
    EXPECT_TRUE(has(run_program({"paper", "--help"}).out, "Aristidou"));
}

TEST(Paper, ASignalLeavesWholeRows) {
    Process process(program_command({"paper", "--csv"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    process.signal(SIGINT);
    const Outcome outcome = process.wait();
    // If the signal came before the program listened, or after its end, there is no message.
    if (outcome.exit_code == 128 + SIGINT) GTEST_SKIP() << "too early";
    EXPECT_EQ(outcome.exit_code, 0);
    const Strings lines = lines_of(outcome.out);
    ASSERT_GE(lines.size(), 1u);
    if (lines.size() < 13) {
        const std::string told = "stopped after " + std::to_string(lines.size() - 1) + " of 12 rows";
        EXPECT_TRUE(has(outcome.err, told));
    }
    for (const std::string& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6) << line;
}

}  // namespace
}  // namespace tendril::test
