// `tendril solve` with linkages: sweeps, scenes and refusals.
#include <glm/trigonometric.hpp>
#include <tendril/ik/mechanisms.hpp>

#include "tests/app/support/program.hpp"
#include "tests/labels.hpp"

namespace tendril::test {
namespace {

using app::Json;
using Strings = std::vector<std::string>;

class SolveLinkage : public testing::Test {
  protected:
    Outcome run(const std::string& cases, const Strings& arguments = {}) {
        write(folder_ / "cases.json", cases);
        Strings all{"solve", (folder_ / "cases.json").string()};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run_program(all, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    }
    Json rows(const Json& cases, Strings arguments = {}) {
        arguments.push_back("--json");
        const Outcome outcome = run(cases.dump(), arguments);
        EXPECT_TRUE(succeeded(outcome)) << outcome.err;
        return outcome.out.empty() ? Json::array() : app::parse_json(outcome.out);
    }
    void refuses(const std::string& cases, const Strings& arguments, const char* words) {
        const Outcome outcome = run(cases, arguments);
        EXPECT_FALSE(succeeded(outcome)) << cases;
        EXPECT_TRUE(says(outcome.err, words)) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    TempFolder folder_;
};

TEST_F(SolveLinkage, ASweepIsATableOfDriversAndPoints) {
    const std::string one = R"({"name": "turn", "linkage": "four_bar"})";
    const Outcome outcome = run(one, {"--csv", "--drive", "crank=0:90:30"});
    ASSERT_TRUE(succeeded(outcome)) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("name,solver,status,iterations,residual,microseconds,crank,A_x,A_y,"))
        << outcome.out;
    EXPECT_EQ(count_lines(outcome.out), 5);
    const Json four = rows(app::parse_json(one), {"--drive", "crank=0:90:30"});
    for (std::size_t i = 0; i < 4; ++i) {
        const double angle = 30.0 * static_cast<double>(i) * 3.14159265358979 / 180.0;
        EXPECT_NEAR(four[i]["points"]["B"][0].get<double>(), std::cos(angle), 1e-9);
        EXPECT_NEAR(four[i]["points"]["B"][1].get<double>(), std::sin(angle), 1e-9);
        EXPECT_EQ(four[i]["freedom"], 1);
    }
    const Json robot = rows({{"linkage", "delta"},
                             {"lengths", {{"upper_arm", 0.4}, {"forearm", 0.9}}},
                             {"targets", {{"platform", {{0, 0, -0.6}}}}}})
                           .at(0);
    EXPECT_EQ(robot["solver"], "linkage");
    EXPECT_EQ(robot["status"], "Reached");
    EXPECT_LE(robot["closed_to"].get<double>(), 1e-6);
    const auto motors = *ik::delta_motors({.upper_arm = 0.4, .forearm = 0.9}, {0, 0, -0.6});
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(robot["drivers"]["motor_" + std::to_string(k)].get<double>(), glm::degrees(motors[k]),
                    1e-3);
    // Backwards; rounding leads neither beyond the end nor short of it.
    EXPECT_EQ(rows(app::parse_json(one), {"--drive", "crank=90:0:-0.1"}).size(), 901u);
    EXPECT_EQ(rows(app::parse_json(one), {"--drive", "crank=0:0.3:0.1"}).size(), 4u);
    // With cases of several kinds, only the usual columns are printed.
    const Outcome mixed =
        run(R"([{"linkage": "four_bar"}, {"lengths": [1], "target": [1, 0, 0]}, {"linkage": "delta"}])",
            {"--csv"});
    EXPECT_TRUE(
        mixed.out.starts_with("name,solver,status,iterations,residual,microseconds\n0,linkage,Reached,"))
        << mixed.out;
    EXPECT_TRUE(has(mixed.out, "\n1,fabrik,Converged,"));
}

TEST_F(SolveLinkage, ReportsWhyItStops) {
    const Json far = rows({{"linkage", "four_bar"}}, {"--drive", "crank=30", "--target", "P=9,0,0"}).at(0);
    EXPECT_EQ(far["status"], "TargetMissed");
    EXPECT_NEAR(far["residual"].get<double>(), far["targets"]["P"]["residual"].get<double>(), 1e-12);
    const Json dead =
        rows({{"linkage", "four_bar"}, {"lengths", {{"crank", 2.2}}}, {"drivers", {{"crank", {60, 170}}}}});
    ASSERT_EQ(dead.size(), 2u);
    EXPECT_EQ(dead[0]["status"], "Reached");
    EXPECT_EQ(dead[1]["status"], "DeadPoint");
    EXPECT_LT(dead[1]["drivers"]["crank"].get<double>(), 170.0);
    EXPECT_EQ(
        rows({{"linkage", "four_bar"}}, {"--drive", "crank=3600", "--max-iterations", "3"})[0]["status"],
        "IterationLimit");
}

LABEL(slow, "SolveLinkage.TakesASceneOfTheLabWithItsRangesAndTargets");

TEST_F(SolveLinkage, TakesASceneOfTheLabWithItsRangesAndTargets) {
    const std::string scene = (folder_ / "scene.json").string();
    const std::string script = (folder_ / "scene.jsonl").string();
    write(script, std::string(R"({"command": "linkage.clear"}
{"command": "linkage.joint", "at": [0, 0, 0]}
{"command": "linkage.pin", "point": "A"}
{"command": "linkage.bar", "from": "A", "to": [1, 0, 0]}
{"command": "linkage.motor.add", "point": "A"}
{"command": "linkage.range", "joint": "motor 1", "min": -10, "max": 45}
{"command": "linkage.target", "point": "B", "to": [0, 2, 0]}
{"command": "scene.save", "path": ")") +
                      scene + "\"}\n");
    ASSERT_TRUE(succeeded(run_program({"--headless", "--lab", "linkage", "--script", script})));
    const Outcome outcome = run_program({"solve", scene, "--json"});
    ASSERT_TRUE(succeeded(outcome)) << outcome.err;
    const Json row = app::parse_json(outcome.out).at(0);
    EXPECT_EQ(row["status"], "Limited");
    EXPECT_EQ(row["active"], Json::array({"motor 1"}));
    for (const std::size_t axis : {0u, 1u})
        EXPECT_NEAR(row["points"]["B"][axis].get<double>(), std::sqrt(0.5), 1e-5);
    const Outcome driven = run_program({"solve", scene, "--csv", "--drive", "motor 1=-5:5:5"});
    ASSERT_TRUE(succeeded(driven)) << driven.err;
    EXPECT_EQ(count_lines(driven.out), 4);
    // The linkage of a scene file is a case, too.
    const Json part = app::read_json_file(scene).at("labs").at("linkage");
    EXPECT_EQ(rows(Json::array({{{"linkage", part}}})).at(0)["status"], "Limited");
}

TEST_F(SolveLinkage, ArgumentsReplaceACasesGoals) {
    Json wide{{"linkage", "four_bar"}, {"drivers", {{"crank", {{"from", 0}, {"to", 360}, {"step", 15}}}}}};
    EXPECT_EQ(rows(wide).size(), 25u);
    EXPECT_EQ(rows(wide, {"--drive", "crank=0:90:15"}).size(), 7u);
    wide["targets"]["P"] = {1, 2, 0};
    EXPECT_EQ(rows(wide, {"--drive", "crank=0:90:15", "--target", "P=1,1,0"}).size(), 7u);
    const std::string good = R"({"linkage": "four_bar"})";
    refuses(good, {"--drive", "crank=1", "--drive", "crank=2"}, "--drive crank twice");
    refuses(good, {"--target", "P=1,2,0", "--target", "P=1,1,0"}, "--target P twice");
    refuses(good, {"--drive", "nobody=1"}, "--drive nobody no joint");
    refuses(good, {"--target", "Q=1,2,0"}, "--target Q no point");
    refuses(R"({"linkage": "four_bar", "targets": {"P": [[1, 2, 0], [1, 2, 0]]}})",
            {"--drive", "crank=0:90:30"}, "--drive crank as many 2 4");
}

TEST_F(SolveLinkage, ErrorsNameTheirPlaceAndNothingIsSolved) {
    refuses(R"([{"linkage": "five_bar"}])", {}, "line 1 cases.0.linkage five_bar");
    refuses(R"([{"linkage": 5}])", {}, "cases.0.linkage 5");
    refuses("[{\"linkage\": \"four_bar\"},\n {\"linkage\": \"four_bar\", \"lengths\": {\"cranc\": 1}}]", {},
            "line 2 cases.1 cranc");
    refuses(R"([{"linkage": "four_bar", "lengths": {"crank": -1}}])", {}, "cases.0.lengths.crank -1");
    refuses(R"([{"linkage": "four_bar", "lengths": {"ground": 100}}])", {}, "cases.0.linkage ground 100");
    refuses(R"([{"linkage": "four_bar", "drivers": {"nobody": 1}}])", {}, "drivers.nobody no joint nobody");
    refuses(R"([{"linkage": "four_bar", "drivers": {"crank": []}}])", {}, "drivers.crank empty");
    refuses(R"([{"linkage": "four_bar", "drivers": {"crank": [1, "x"]}}])", {}, "drivers.crank.1 x");
    refuses(R"([{"linkage": "four_bar", "drivers": {"crank": {"from": 0, "to": 9, "step": 0}}}])", {},
            "drivers.crank.step from to");
    refuses(R"([{"linkage": "four_bar", "drivers": {"crank": {"from": 0, "to": 9, "step": 1e-9}}}])", {},
            "drivers.crank.step 100000");
    refuses(R"([{"linkage": "four_bar", "targets": {"Q": [1, 2, 3]}}])", {}, "targets.Q no point Q");
    refuses(R"([{"linkage": "four_bar", "targets": {"P": [1, 2]}}])", {}, "targets.P");
    refuses(
        R"([{"linkage": "four_bar", "drivers": {"crank": [1, 2]}, "targets": {"P": [[1, 2, 0], [1, 2, 0], [1, 2, 0]]}}])",
        {}, "targets.P as many 2 3");
    refuses(R"([{"linkage": {"mechanism": {}}}])", {}, "cases.0.linkage.mechanism");
    refuses(R"({"lab": "chain"})", {}, "a list of cases a linkage or a scene");
    const std::string good = R"({"linkage": "four_bar"})";
    refuses(good, {"--drive", "crank"}, "--drive JOINT=VALUE crank");
    refuses(good, {"--drive", "crank=1:2"}, "--drive crank=1:2");
    refuses(good, {"--drive", "crank=nan"}, "--drive number nan");
    refuses(good, {"--drive", "crank=1e300"}, "crank 1e+300");
    refuses(good, {"--target", "P=1,2"}, "--target POINT P=1,2");
    refuses(R"([{"lengths": [1], "target": [1, 0, 0]}])", {"--drive", "crank=1"}, "--drive linkages 0");
}

}  // namespace
}  // namespace tendril::test
