// `tendril solve`: the built program with valid and invalid files.
#include "app/batch/paper.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using Strings = std::vector<std::string>;
using app::Json;

class Solve : public testing::Test {
  protected:
    Outcome run(const std::string& cases, const Strings& arguments = {}) {
        write(folder_ / "cases.json", cases);
        Strings all{"solve", path()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run_program(all, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    }
    std::string path() const { return (folder_ / "cases.json").string(); }
    TempFolder folder_;
};

const char* const two_cases = R"([
 {"name": "near", "lengths": [1, 1, 1], "target": [1, 1.5, 0.5], "note": {"ignored": true}},
 {"name": "a \"far\", one", "lengths": [1, 2], "target": [0, 0, 9],
  "start": [[0, 0, 0], [0, 1, 0], [0, 3, 0]]}
])";

int lines_without(const std::string& text, const std::string& part) {
    int found = 0;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1)
        found += text.substr(begin, end - begin).find(part) == std::string::npos;
    return found;
}

LABEL(slow, "Solve.ManyCasesTakeLittleMoreMemoryThanTheirText");
LABEL(slow, "All/SolveSignals.EndWithWhatIsDoneWhole/*");

TEST_F(Solve, PrintsOneArrayWithPositions) {
    const Outcome outcome = run(two_cases, {"--json"});
    ASSERT_TRUE(succeeded(outcome));
    const Json rows = app::parse_json(outcome.out);
    ASSERT_EQ(rows.size(), 2u);
    for (const Json& row : rows) {
        Strings keys;
        for (const auto& item : row.items()) keys.push_back(item.key());
        EXPECT_EQ(keys, (Strings{"name", "solver", "status", "iterations", "residual", "microseconds",
                                 "positions"}));
        EXPECT_EQ(row["solver"], "fabrik");
        EXPECT_GE(row["microseconds"].get<double>(), 0.0);
    }
    EXPECT_EQ(rows[0]["name"], "near");
    EXPECT_EQ(rows[0]["status"], "Converged");
    EXPECT_LE(rows[0]["residual"].get<double>(), 3e-3);
    ASSERT_EQ(rows[0]["positions"].size(), 4u);
    EXPECT_EQ(rows[0]["positions"][0], Json::array({0.0, 0.0, 0.0}));
    const Json& tip = rows[0]["positions"][3];
    const double off =
        std::hypot(tip[0].get<double>() - 1.0, tip[1].get<double>() - 1.5, tip[2].get<double>() - 0.5);
    EXPECT_NEAR(off, rows[0]["residual"].get<double>(), 1e-5);
    EXPECT_EQ(rows[1]["name"], "a \"far\", one");
    EXPECT_NEAR(rows[1]["residual"].get<double>(), 6.0, 1e-3);
}

TEST_F(Solve, AChainAlongACurveHasOneRowForAllSolvers) {
    const char* const text =
        R"([{"name": "tail", "lengths": [1, 1, 1], "curve": [[0, 0, 0], [1, 0, 0], [2, 0, 0]]}])";
    const Outcome outcome = run(text, {"--json", "--solver", "all"});
    ASSERT_TRUE(succeeded(outcome));
    const Json rows = app::parse_json(outcome.out);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0]["solver"], "curve");
    EXPECT_EQ(rows[0]["status"], "Stretched");
    EXPECT_EQ(rows[0]["curve"]["bones_past_end"], 1);
    EXPECT_EQ(rows[0]["positions"][3], Json::array({3.0, 0.0, 0.0}));
    EXPECT_TRUE(has(run(text, {"--csv"}).out, "tail,curve,Stretched,0,1.0,"));
}

TEST_F(Solve, SolvesInAPlane) {
    const char* const planar = R"([{"lengths": [1, 1, 1], "target": [1, 1.5, 0.5], "plane": [0, 0, 1],
        "bend": "right", "angle_limits": [null, {"min_deg": -90, "max_deg": 90, "from": "bone"}, null]}])";
    const Outcome outcome = run(planar, {"--json"});
    ASSERT_TRUE(succeeded(outcome));
    const Json row = app::parse_json(outcome.out)[0];
    EXPECT_EQ(row["status"], "Converged");
    EXPECT_NEAR(row["off_plane"].get<double>(), 0.5, 1e-6);
    for (const Json& joint : row["positions"]) EXPECT_NEAR(joint[2].get<double>(), 0.0, 3e-6);
    const Outcome refused = run(R"([{"lengths": [1], "target": [1, 0, 0], "bend": "left"}])");
    EXPECT_FALSE(succeeded(refused));
    EXPECT_TRUE(says(refused.err, "bend plane"));
}

TEST_F(Solve, PrintsTheSameAsQuotedCsv) {
    const Outcome outcome = run(two_cases, {"--csv", "--solver", "fabrik_plain"});
    ASSERT_TRUE(succeeded(outcome));
    EXPECT_TRUE(
        outcome.out.starts_with("name,solver,status,iterations,residual,microseconds\nnear,fabrik_plain,"
                                "Converged,"))
        << outcome.out;
    EXPECT_TRUE(has(outcome.out, "\n\"a \"\"far\"\", one\",fabrik_plain,"));
    EXPECT_EQ(count_lines(outcome.out), 3);
}

TEST_F(Solve, PrintsATableByDefault) {
    const std::string name = "wide \xc3\xa4 name\\nof two lines and a tail that no column holds";
    std::string cases = two_cases;
    cases.insert(cases.rfind(']'), R"(, {"name": ")" + name + R"(", "lengths": [1], "target": [1, 0, 0]})");
    const Outcome outcome = run(cases);
    ASSERT_TRUE(succeeded(outcome));
    ASSERT_EQ(count_lines(outcome.out), 4);
    EXPECT_TRUE(outcome.out.starts_with("name "));
    // The solver's column begins at the same character in every row.
    std::size_t begin = 0;
    for (int line = 0; line < 4; ++line) {
        const std::size_t end = outcome.out.find('\n', begin);
        const std::string row = outcome.out.substr(begin, end - begin);
        std::size_t at = row.find(line == 0 ? "solver" : "fabrik");
        at -= static_cast<std::size_t>(std::count(row.begin(), row.end(), '\xa4'));
        EXPECT_EQ(at, 42u) << row;
        begin = end + 1;
    }
    EXPECT_TRUE(has(outcome.out, "..."));
}

TEST_F(Solve, AllSolversAnswerInTheirOrderAndARefusalIsARow) {
    const Outcome outcome = run(two_cases, {"--json", "--solver", "all"});
    ASSERT_TRUE(succeeded(outcome));
    const Json rows = app::parse_json(outcome.out);
    ASSERT_EQ(rows.size(), 14u);
    const Strings names{"fabrik", "fabrik_plain", "ccd", "jacobian_transpose", "dls", "svd_dls", "two_bone"};
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i]["solver"], names[i % 7]);
    EXPECT_EQ(rows[6]["status"], "InvalidInput");
    EXPECT_EQ(rows[6]["reason"], "Two-bone needs exactly two bones");
    EXPECT_FALSE(rows[5].contains("reason"));
    EXPECT_EQ(rows[6]["positions"][3], Json::array({3.0, 0.0, 0.0}));
}

TEST_F(Solve, ALimitThatDoesNotFitTheRestPoseIsNamed) {
    const std::string hinge = R"([{"name": "h", "lengths": [1, 1], "target": [1, 0, 0], "limits": [null,
                                  {"kind": "hinge", "axis": [1, 0, 0], "min_deg": 0, "max_deg": 90}]}])";
    const Json row = app::parse_json(run(hinge, {"--json"}).out).at(0);
    EXPECT_EQ(row["status"], "InvalidInput");
    EXPECT_TRUE(says(row["reason"].get<std::string>(), "limits[1] the hinge's axis")) << row;
    EXPECT_TRUE(has(run(hinge).out, row["reason"].get<std::string>()));
}

TEST_F(Solve, UsesTheGivenIterationsAndTolerance) {
    const std::string rim = R"([{"name": "rim", "lengths": [1, 1, 1, 1, 1, 1], "target": [3, 5.1, 0]}])";
    const auto row = [&](const Strings& arguments) {
        Strings all{"--json", "--solver", "fabrik_plain"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return app::parse_json(run(rim, all).out).at(0);
    };
    EXPECT_EQ(row({"--max-iterations", "3"})["status"], "IterationLimit");
    EXPECT_EQ(row({"--max-iterations", "3"})["iterations"], 3);
    EXPECT_LE(row({"--max-iterations", "100000", "--tolerance", "0.00001"})["residual"], 1e-5);
    EXPECT_LE(row({"--tolerance", "2"})["iterations"], 2);
}

TEST_F(Solve, AnEmptyListGivesAnEmptyResult) {
    EXPECT_TRUE(succeeded(run("[]")));
    EXPECT_EQ(run("[]").out, "");
    EXPECT_EQ(run(" [ ]\n", {"--json"}).out, "[]\n");
    EXPECT_EQ(run("[]", {"--csv"}).out, "name,solver,status,iterations,residual,microseconds\n");
}

struct BadFile {
    const char* name;
    std::string cases;
    Strings told;
};

class BadCases : public testing::TestWithParam<BadFile> {};

/// A valid case on line 2, then this one on line 3.
std::string after_a_sound_one(const std::string& members) {
    return std::string("[\n{\"name\": \"sound\", \"lengths\": [1], \"target\": [1, 0, 0]},\n{")
        .append(members)
        .append("}]");
}

TEST_P(BadCases, AreRefusedWholeWithLineAndPlace) {
    const TempFolder folder;
    write(folder / "cases.json", GetParam().cases);
    const Outcome outcome = run_program({"solve", (folder / "cases.json").string(), "--json"});
    Strings told = GetParam().told;
    told.push_back("cases.json: ");
    EXPECT_TRUE(complained(outcome, 2, told));
    EXPECT_EQ(outcome.out, "");
}

INSTANTIATE_TEST_SUITE_P(
    All, BadCases,
    testing::Values(
        BadFile{"empty_file", "", {"line 1"}}, BadFile{"no_list", "{}", {"expected a list"}},
        BadFile{"cut_off", "[{\"lengths\": [1", {"line 1"}},
        BadFile{"nan", after_a_sound_one(R"("lengths": [NaN], "target": [0, 0, 0])"), {"line 3"}},
        BadFile{"huge",
                after_a_sound_one(R"("lengths": [1], "target": [0, -1e30, 0])"),
                {"line 3: cases.1.target", "1e9", "-1e+30"}},
        BadFile{"no_object", after_a_sound_one("}, 5, {"), {"cases.1"}},
        BadFile{"no_target", after_a_sound_one(R"("lengths": [1])"), {"cases.1", "target", "missing"}},
        BadFile{"length_is_text",
                after_a_sound_one("\"target\": [1, 0, 0],\n\"lengths\": [1,\n\"x\"]"),
                {"line 5: cases.1.lengths.1", "\"x\""}},
        BadFile{"length_is_negative",
                after_a_sound_one(R"("lengths": [-1], "target": [1, 0, 0])"),
                {"cases.1.lengths.0", "-1"}},
        BadFile{"no_bones", after_a_sound_one(R"("lengths": [], "target": [1, 0, 0])"), {"cases.1.lengths"}},
        BadFile{"target_is_flat",
                after_a_sound_one(R"("lengths": [1], "target": [1, 0])"),
                {"cases.1.target", "[1,0]"}},
        BadFile{"start_is_short",
                after_a_sound_one(R"("lengths": [1, 1], "target": [1, 0, 0], "start": [[0, 0, 0]])"),
                {"cases.1.start", "3"}},
        BadFile{"pole_is_a_text",
                after_a_sound_one(R"("lengths": [1], "target": [1, 0, 0], "pole": "up")"),
                {"cases.1.pole", "\"up\""}},
        BadFile{"limits_are_short",
                after_a_sound_one(R"("lengths": [1, 1], "target": [1, 0, 0], "limits": [null])"),
                {"cases.1.limits", "2"}},
        BadFile{"limit_min_over_max",
                after_a_sound_one(R"("lengths": [1, 1], "target": [1, 0, 0],
                    "limits": [null, {"kind": "hinge", "min_deg": 20, "max_deg": 10}])"),
                {"line 4: cases.1.limits.1", "20", "10"}}),
    [](const auto& file) { return file.param.name; });

/// Not a test parameter: those are created whenever the test program starts.
TEST_F(Solve, AFileThatIsTooLargeExitsWith2) {
    EXPECT_TRUE(complained(run(std::string((64u << 20) + 1, ' '), {}), 2, {"cases.json: ", "64 MB"}));
}

TEST_F(Solve, InvalidArgumentsExitWith2) {
    EXPECT_TRUE(complained(run("[]", {"--solver", "newton"}), 2,
                           {"--solver", "newton", "fabrik, fabrik_plain, ccd", "two_bone", "all"}));
    EXPECT_TRUE(complained(run("[]", {"--csv", "--json"}), 2, {"--csv", "--json"}));
    EXPECT_TRUE(complained(run("[]", {"--max-iterations", "0"}), 2, {"--max-iterations"}));
    for (const char* bad : {"-1", "nan", "inf", "1e30", "far"})
        EXPECT_TRUE(complained(run("[]", {"--tolerance", bad}), 2, {"--tolerance"})) << bad;
    EXPECT_TRUE(complained(run_program({"solve"}), 2, {"CASES"}));
    EXPECT_TRUE(complained(run_program({"solve", "/no/such/file.json"}), 2, {"/no/such/file.json"}));
    EXPECT_TRUE(complained(run_program({"--headless", "solve", path()}), 2, {"solve", "--headless"}));
    EXPECT_TRUE(complained(run_program({"scene.json", "solve", path()}), 2, {"solve", "SCENE"}));
    EXPECT_TRUE(has(run_program({"--help"}).out, "solve"));
    EXPECT_TRUE(has(run_program({"solve", "--help"}).out, "min_deg"));
}

TEST_F(Solve, ASceneOfThatNameOpensByItsPath) {
    write(folder_ / "solve", "{}");
    Process process(program_command({"--headless", "./solve"}), {}, folder_.path());
    EXPECT_TRUE(complained(process.wait(), 2, {"./solve", "does not read this kind of file"}));
}

std::string many_cases(int count) {
    std::string text = "[";
    for (int i = 0; i < count; ++i) {
        if (i > 0) text += ',';
        text += R"({"lengths":[1],"target":[)";
        text += std::to_string(i % 3);
        text += ",1,0]}";
    }
    return text + "]";
}

/// At night a million.
TEST_F(Solve, ManyCasesTakeLittleMoreMemoryThanTheirText) {
    const int count = is_thorough() ? 1'000'000 : 200'000;
    const Outcome outcome = run(many_cases(count), {"--csv"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(lines_without(outcome.err, "tendril: "), 0) << outcome.err;  // progress and nothing else
    EXPECT_EQ(count_lines(outcome.out), count + 1);
    EXPECT_TRUE(has(outcome.out.substr(outcome.out.size() - 100), "\n" + std::to_string(count - 1) + ",fabrik,"));
    EXPECT_LT(outcome.peak_megabytes, (50.0 + 150e-6 * count) * sanitizer_factor);
    EXPECT_LT(outcome.cpu_seconds, 60.0 * sanitizer_factor);
}

class SolveSignals : public testing::TestWithParam<std::pair<int, const char*>> {};

TEST_P(SolveSignals, EndWithWhatIsDoneWhole) {
    const auto& [number, format] = GetParam();
    const TempFolder folder;
    // Slow enough to be interrupted: targets out of reach use all their iterations.
    std::string cases = "[";
    for (int i = 0; i < 20'000; ++i) {
        if (i > 0) cases += ',';
        cases += R"({"lengths":[1,1,1,1,1,1,1,1,1,1],"target":[6,7.995,0]})";
    }
    write(folder / "cases.json", cases + "]");
    Process process(program_command({"solve", (folder / "cases.json").string(), format, "--solver",
                                     "fabrik_plain", "--max-iterations", "1000000", "--tolerance", "0"}));
    for (int i = 0; i < 6000 && process.running() && process.out().size() < 200; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    process.signal(number);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_TRUE(has(outcome.err, "tendril: stopped after "));
    if (std::string(format) == "--json") {
        const Json rows = app::parse_json(outcome.out);
        EXPECT_GT(rows.size(), 0u);
        EXPECT_LT(rows.size(), 20'000u);
        for (const Json& row : rows) EXPECT_EQ(row["positions"].size(), 11u);
    } else {
        EXPECT_GT(count_lines(outcome.out), 1);
        EXPECT_LT(count_lines(outcome.out), 20'000);
        EXPECT_TRUE(outcome.out.ends_with('\n'));
    }
}

INSTANTIATE_TEST_SUITE_P(All, SolveSignals,
                         testing::Values(std::pair(SIGINT, "--json"), std::pair(SIGTERM, "--csv")),
                         [](const auto& each) { return each.param.first == SIGINT ? "SIGINT" : "SIGTERM"; });

// `tendril paper`: its measurements, and the built program's table. No test depends on timing.

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
