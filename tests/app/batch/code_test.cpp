// A chain as a C++ program: its text. tests/package/code.cmake compiles it, runs it and compares its results.
#include "app/labs/chain/commands.hpp"
#include "app/labs/kit/code_text.hpp"

#include <glm/trigonometric.hpp>
#include <random>

#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using namespace app;

bool lacks(const std::string& text, const char* part) {
    return text.find(part) == text.npos;
}

ChainPart reaching() {
    ChainPart part = first_chain();
    part.mode = ChainMode::Reach;
    return part;
}

TEST(Code, EveryFloatHasItsOwnLiteral) {
    EXPECT_EQ(literal(1.0f), "1.0f");
    EXPECT_EQ(literal(0.1f), "0.1f");
    EXPECT_EQ(literal(-2.5f), "-2.5f");
    EXPECT_EQ(literal(1e9f), "1e+09f");
    EXPECT_EQ(literal(-0.0f), "-0.0f");
    std::mt19937 random(3);
    std::uniform_real_distribution<float> exponent(-30.0f, 9.0f);
    for (int i = 0; i < 10'000; ++i) {
        const float value = std::pow(10.0f, exponent(random)) * (i % 2 == 0 ? 1.0f : -1.0f);
        EXPECT_EQ(std::stof(literal(value)), value);
    }
}

TEST(Code, OmitsOptionsThatEqualTheLibrarysDefaults) {
    const std::string plain = chain_code(reaching());
    for (const char* option : {"options.pole", "options.snap_back", "options.soft_zone", "options.damping",
                               "options.twist", "options.limits", "options.restarts", "state.rotations"})
        EXPECT_TRUE(lacks(plain, option)) << option;
    ChainPart part = reaching();
    part.reach.method = ik::Method::SvdDls;
    part.reach.options.pole = glm::vec3(0, 2, 0);
    part.reach.options.pole_turn = ik::PoleTurn::EachJoint;
    part.reach.options.snap_back = 0.5f;
    part.reach.options.soft_zone = 0.1f;
    part.reach.options.twist = glm::radians(90.0f);
    part.reach.options.restarts = 3;
    part.reach.limits.resize(7);
    part.reach.limits[2] = ik::Limit::hinge({0, 1, 0}, 0.0f, 1.5f);
    part.reach.limits[3] = ik::Limit::of(ik::JointKind::BallAndSocket);
    part.reach.limits[4].stiffness = 0.5f;
    const std::string code = chain_code(part);
    for (const char* said : {"Method::SvdDls", "options.pole = glm::vec3{0.0f, 2.0f, 0.0f};",
                             "PoleTurn::EachJoint", "options.snap_back = 0.5f;", "options.soft_zone = 0.1f;",
                             "options.twist = 1.5707964f;  // 90 degrees", "options.restarts = 3;",
                             "limits(7);", "options.limits = limits;",
                             "limits[2] = {\n        .kind = ik::JointKind::Hinge,\n        .axis = {0.0f, "
                             "1.0f, 0.0f},\n        "
                             ".max = 1.5f,  // 85.94 degrees\n",
                             "limits[3] = {\n        .kind = ik::JointKind::BallAndSocket,"})
        EXPECT_TRUE(has(code, said));
    EXPECT_TRUE(
        has(code, "limits[4] = {\n        .kind = ik::JointKind::Free,\n        .stiffness = 0.5f,\n    };"));
    EXPECT_TRUE(lacks(code, "limits[0]"));
}

TEST(Code, TheProgramPrintsTheOpenLabsCodeAndRefusesWhatIsNoScene) {
    const TempFolder folder;
    const std::string scene = (folder / "scene.json").string();
    const Labs labs;
    Workspace workspace = make_blank_workspace(labs);
    save_scene_file(workspace, scene);
    const Outcome outcome = run_program({"code", scene}, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    EXPECT_TRUE(succeeded(outcome));
    EXPECT_EQ(outcome.out, chain_code(first_chain()));

    EXPECT_TRUE(complained(run_program({"code", "/no/such.json"}), 2, {"/no/such.json"}));
    EXPECT_TRUE(complained(run_program({"code"}), 2, {"SCENE"}));
    write(folder / "bad.json", R"({"tendril_scene": 1, "lab": "kitchen", "labs": {}, "camera": {}})");
    EXPECT_TRUE(complained(run_program({"code", (folder / "bad.json").string()}), 2, {"kitchen"}));
    write(folder / "list.json", "[]");
    EXPECT_TRUE(complained(run_program({"code", (folder / "list.json").string()}), 2, {"list.json"}));
    EXPECT_TRUE(has(run_program({"code", "--help"}).out, "C++"));
}

}  // namespace
}  // namespace tendril::test
