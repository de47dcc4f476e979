// Expected results from an independent source (skipped if missing), and a few built-in cases. Every chain
// starts straight along +X.
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "ik_support.hpp"
#include "tests/places.hpp"

namespace tendril::test::ik_reference_test {
namespace {

using ik::Method;
using ik::Report;
using ik::Status;
using Json = nlohmann::json;

struct Case {
    std::string name;
    Lengths lengths;
    glm::vec3 target;
    Status status = Status::Converged;
    double residual = 0.0;
};

std::vector<Case> own_cases() {
    const Lengths five(5, 1.0f), mixed{0.7f, 1.1f, 0.3f, 0.9f}, heavy{2.0f, 0.3f, 0.3f};
    return {
        {"inside", mixed, {0.5f, 1.0f, -0.8f}},
        {"near the rim", five, {2.8f, 2.8f, 3.05f}},
        {"on the rim", five, {0.0f, 5.0f, 0.0f}},
        {"on the line, ahead", five, {3.5f, 0.0f, 0.0f}},
        {"on the line, just ahead of the root", mixed, {0.01f, 0.0f, 0.0f}},
        {"on the line, behind", five, {-3.0f, 0.0f, 0.0f}},
        {"on the line, far behind", mixed, {-2.99f, 0.0f, 0.0f}},
        {"on the root", five, {0.0f, 0.0f, 0.0f}},
        {"two bones, on the root", {1.0f, 1.0f}, {0.0f, 0.0f, 0.0f}},
        {"out of reach", mixed, {3.0f, 4.0f, 0.0f}, Status::Stretched, 2.0},
        {"out of reach, behind", five, {-8.0f, 0.0f, 0.0f}, Status::Stretched, 3.0},
        {"too close", heavy, {0.0f, 0.6f, 0.8f}, Status::TooClose, 0.4},
        {"too close, on the root", heavy, {0.0f, 0.0f, 0.0f}, Status::TooClose, 1.4},
        {"too close for one bone", {1.5f}, {0.0f, 1.0f, 0.0f}, Status::TooClose, 0.5},
        {"just not too close", heavy, {0.0f, 1.41f, 0.0f}},
    };
}

glm::vec3 point(const Json& json) {
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

std::vector<Case> read_cases(std::istream& file) {
    const std::map<std::string, Status> named{
        {"Converged", Status::Converged}, {"Stretched", Status::Stretched}, {"TooClose", Status::TooClose}};
    std::vector<Case> cases;
    for (const Json& json : Json::parse(file)) {
        const Json& expected = json.at("expect");
        cases.push_back({json.at("name").get<std::string>(), json.at("lengths").get<Lengths>(),
                         point(json.at("target")), named.at(expected.at("status").get<std::string>()),
                         expected.at("residual").get<double>()});
    }
    return cases;
}

/// Tolerance of the residual: 1e-4 m if stretched, 1 % if folded, otherwise `tolerance`.
double allowed(const Case& example, double tolerance) {
    if (example.status == Status::Stretched) return 1e-4;
    return example.status == Status::TooClose ? 0.01 * example.residual : tolerance;
}

/// For any method: the chain's invariants hold, and the report is true.
void expect_valid(const Case& example, const Report& report, const Joints& joints, double tolerance) {
    EXPECT_TRUE(Holds(joints, example.lengths));
    EXPECT_TRUE(same_bits(joints.front(), glm::vec3(0.0f)));
    const double residual = distance(joints.back(), example.target);
    EXPECT_NEAR(report.residual, residual, 1e-5 * std::max(1.0, residual));
    EXPECT_LE(report.iterations, 100);
    if (example.status == Status::Converged) {
        EXPECT_EQ(report.status == Status::Converged, report.residual <= tolerance);
        EXPECT_NE(report.status, Status::Stretched);
        EXPECT_NE(report.status, Status::TooClose);
    } else {
        EXPECT_EQ(report.status, example.status) << name(report.status);
    }
    EXPECT_NE(report.status, Status::InvalidInput);
}

/// Returns whether it ended as expected.
bool check(Method method, const Case& example, bool must_match) {
    KeptSolver solver(example.lengths);
    Joints joints = straight_joints(example.lengths);
    const Report report = solver.solve(method, joints, example.target);
    const double tolerance = 1e-3 * reach_of(example.lengths);
    SCOPED_TRACE(std::string(name(method)) + ", " + example.name + ": " + name(report.status) + ", " +
                 std::to_string(report.iterations) + " iterations, residual " +
                 std::to_string(report.residual));
    expect_valid(example, report, joints, tolerance);
    const bool matches = report.status == example.status &&
                         std::abs(report.residual - example.residual) <= allowed(example, tolerance);
    EXPECT_TRUE(matches || !must_match);
    return matches;
}

void check_all(const std::vector<Case>& cases) {
    for (const Method method : iterating_methods) {
        const bool must = method == Method::Fabrik || method == Method::Dls;
        std::size_t matches = 0;
        for (const Case& example : cases) matches += check(method, example, must) ? 1 : 0;
        std::printf("%-18s %zu of %zu as expected\n", name(method), matches, cases.size());
    }
}

TEST(IkReference, BuiltInCases) {
    check_all(own_cases());
}

TEST(IkReference, CasesFromAnIndependentSource) {
    const auto path = reference_path("solve.json");
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << path << " is not there";
    const std::vector<Case> cases = read_cases(file);
    EXPECT_FALSE(cases.empty());
    check_all(cases);
}

TEST(IkReference, PlainFabrikReportsThatItStallsOnALine) {
    const Lengths lengths(5, 1.0f);
    for (const float x : {4.0f, 2.0f, -2.5f}) {
        KeptSolver solver(lengths);
        Joints joints = straight_joints(lengths);
        const Report report = solver.solve(Method::FabrikPlain, joints, {x, 0, 0});
        EXPECT_EQ(report.status, Status::Stalled) << x;
        EXPECT_GT(report.residual, 0.005f) << x;
    }
}

}  // namespace
}  // namespace tendril::test::ik_reference_test
