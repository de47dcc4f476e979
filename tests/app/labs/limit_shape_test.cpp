// The outline of a limit compared with the library's own measure: the drawing shows the solvers' limits.
#include <cctype>
#include <stdexcept>

#include "app/labs/humanoid/humanoid_commands.hpp"
#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/humanoid/ik/solvers.hpp"
#include "app/labs/kit/code_text.hpp"
#include "app/labs/kit/library_json.hpp"
#include "app/labs/kit/limit_shape.hpp"
#include "tests/app/labs/chain_support.hpp"
#include "tests/core/random.hpp"

namespace tendril::app {
namespace {

class Pose {
  public:
    explicit Pose(test::Random& random) {
        rest = glm::normalize(random.point(1.0f) + glm::vec3(1e-3f));
        const glm::vec3 other = glm::normalize(random.point(1.0f) + glm::vec3(0.0f, 1e-3f, 0.0f));
        limit.axis = glm::cross(rest, other) + 0.3f * rest;
        parent = glm::angleAxis(random.around(3.0f), glm::normalize(random.point(1.0f) + glm::vec3(1e-3f)));
    }
    /// The solver's angles for a bone in this world direction, by the shortest rotation from rest.
    ik::JointAngles measured(glm::vec3 direction) const {
        const glm::vec3 to = glm::conjugate(parent) * direction;
        return ik::measure(limit, rest, glm::quat(rest, to));
    }
    float excess(glm::vec3 direction) const { return ik::excess(limit, measured(direction)); }

    ik::Limit limit;
    glm::vec3 rest;
    glm::quat parent;
};

glm::quat turn_between(glm::vec3 bone, glm::vec3 side, glm::vec3 to_bone, glm::vec3 to_side) {
    const glm::mat3 from(bone, side, glm::cross(bone, side)),
        to(to_bone, to_side, glm::cross(to_bone, to_side));
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

float angle(test::Random& random, float low, float high) {
    return low + (high - low) * 0.5f * (1.0f + random.around(1.0f));
}

TEST(LimitShape, AConesOutlineIsTheSolversLimit) {
    test::Random random(5);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        ik::Limit& limit = pose.limit;
        limit.kind = ik::JointKind::BallAndSocket;
        for (float* half : {&limit.up, &limit.down, &limit.left, &limit.right})
            *half = angle(random, 0.1f, 2.6f);
        limit.twist_min = -0.5f, limit.twist_max = 0.5f;
        const float least = std::min({limit.up, limit.down, limit.left, limit.right});
        const LimitShape shape(limit, pose.rest, pose.parent);
        const auto outline = shape.outline(64);
        ASSERT_EQ(outline.size(), 65u);
        EXPECT_LT(glm::distance(outline.front(), outline.back()), 1e-4f);
        for (const glm::vec3& direction : outline) {
            EXPECT_NEAR(glm::length(direction), 1.0f, 1e-5f);
            EXPECT_LT(pose.excess(direction), 3e-4f);
            const ik::JointAngles at = pose.measured(direction);
            EXPECT_GT(pose.excess(shape.direction(1.01f * at.up, 1.01f * at.left)), 0.004f * least);
            EXPECT_EQ(pose.excess(shape.direction(0.99f * at.up, 0.99f * at.left)), 0.0f);
        }
    }
}

TEST(LimitShape, AHingesFanEndsWhereItsRangeDoes) {
    test::Random random(6);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        const float middle = random.around(1.5f), half = angle(random, 0.1f, 1.2f);
        pose.limit.kind = ik::JointKind::Hinge;
        pose.limit.min = middle - half, pose.limit.max = middle + half;
        const LimitShape shape(pose.limit, pose.rest, pose.parent);
        const auto outline = shape.outline(40);
        for (const glm::vec3& direction : outline) EXPECT_LT(pose.excess(direction), 1e-3f);
        EXPECT_NEAR(pose.measured(outline.front()).up, pose.limit.min, 1e-3f);
        EXPECT_NEAR(pose.measured(outline.back()).up, pose.limit.max, 1e-3f);
        EXPECT_GT(pose.excess(shape.direction(pose.limit.max + 0.02f * half, 0.0f)), 0.01f * half);
        EXPECT_GT(pose.excess(shape.direction(pose.limit.min - 0.02f * half, 0.0f)), 0.01f * half);
    }
}

TEST(LimitShape, TheDialsEndsAreTheTwistLimits) {
    test::Random random(7);
    for (int round = 0; round < 300; ++round) {
        Pose pose(random);
        ik::Limit& limit = pose.limit;
        limit.kind = ik::JointKind::BallAndSocket;
        limit.up = limit.down = limit.left = limit.right = 2.0f;
        limit.twist_min = angle(random, -2.0f, -0.2f), limit.twist_max = angle(random, 0.2f, 2.0f);
        const LimitShape shape(limit, pose.rest, pose.parent);
        const float up = random.around(1.2f), left = random.around(1.2f);
        const glm::vec3 side_at_rest = glm::conjugate(pose.parent) * shape.side({});
        const auto posed = [&](float twist) {
            const glm::quat world = turn_between(pose.rest, side_at_rest, shape.direction(up, left),
                                                 shape.side({up, left, twist}));
            return ik::measure(limit, pose.rest, glm::conjugate(pose.parent) * world);
        };
        for (const float twist : {limit.twist_min, 0.0f, limit.twist_max}) {
            const ik::JointAngles at = posed(twist);
            EXPECT_NEAR(at.twist, twist, 2e-3f);
            EXPECT_NEAR(at.up, up, 2e-3f);
            EXPECT_NEAR(at.left, left, 2e-3f);
            EXPECT_LT(ik::excess(limit, at), 2e-3f);
        }
        EXPECT_GT(ik::excess(limit, posed(1.05f * limit.twist_max)), 0.01f * limit.twist_max);
        EXPECT_GT(ik::excess(limit, posed(1.05f * limit.twist_min)), -0.01f * limit.twist_min);
    }
}

// IK states in current and older scene files.

ik::State remembering() {
    ik::State state(2);
    state.rotations[1] = glm::angleAxis(0.5f, glm::vec3(0, 0, 1));
    state.pole = {.valid = true,
                  .turn = ik::PoleTurn::EachJoint,
                  .pole = {1, 2, 3},
                  .target = {2e9f, 0, -1},  // an offset may exceed the range of a coordinate
                  .twist = 0.25f,
                  .joints = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}};
    state.limits = {.valid = true, .limited = true, .target = {4, 5, 6}, .damping = 0.125f};
    return state;
}

std::string refusal(const Json& json) {
    return test::message_of([&] { load_ik_state({json, "state"}, 2); });
}

TEST(IkStateJson, IsRestoredBitForBit) {
    for (ik::State state : {remembering(), ik::State(2)}) {
        const Json json = parse_json(save_ik_state(state).dump());
        EXPECT_EQ(load_ik_state({json, "state"}, 2), state);
    }
}

TEST(IkStateJson, OfAnOlderRigIsRead) {
    Json json = save_ik_state(remembering());
    json["pole"].erase("turn");
    json["pole"].erase("twist_deg");
    json["pole"]["each_joint"] = true;
    json["pole"]["twist"] = 0.25;
    EXPECT_EQ(load_ik_state({json, "state"}, 2), remembering());
}

TEST(IkStateJson, WithoutJointsThePoleGetsTheChains) {
    Json json = save_ik_state(remembering());
    json["pole"].erase("joints");
    EXPECT_EQ(load_ik_state({json, "state"}, 2, remembering().pole.joints), remembering());
    EXPECT_NE(refusal(json), "") << "there is no chain";
}

TEST(IkStateJson, InvalidOnesAreRefusedWithTheirPath) {
    struct Case {
        const char* path;
        Json value;
        const char* says;
    };
    for (const Case& each : {Case{"/rotations", Json::array({{0, 0, 0, 1}}), "state.rotations"},
                             Case{"/limits/damping", 101, "state.limits.damping 0 100 101"},
                             Case{"/limits/target", {0, 0, 5e9}, "state.limits.target"},
                             Case{"/pole/turn", "sideways", "state.pole.turn"},
                             Case{"/pole/joints", Json::array(), "state.pole.joints"}}) {
        Json json = save_ik_state(remembering());
        json[Json::json_pointer(each.path)] = each.value;
        EXPECT_TRUE(test::says(refusal(json), each.says)) << each.path;
    }
    for (const char* const member : {"limited", "target", "damping"}) {
        Json json = save_ik_state(remembering());
        json["limits"].erase(member);
        EXPECT_TRUE(test::says(refusal(json), std::string("state.limits ") + member + " missing"));
    }
}

// Texts of exported C++.

/// A name with a newline would end the literal, or a comment, and go on as code.
TEST(CodeText, EscapesCharactersThatALiteralCannotHold) {
    EXPECT_EQ(string_text("a\"b\\c"), R"("a\"b\\c")");
    EXPECT_EQ(string_text(std::string_view("a\n\r\0\x7f"
                                           "1",
                                           6)),
              R"("a\012\015\000\1771")");
    EXPECT_EQ(string_text("Bär"), "\"Bär\"");
}

TEST(HumanoidCode, SetsOnlyNonDefaultValues) {
    HumanoidPart part;
    part.ik.target(humanoid::Effector::LeftHand) =
        humanoid::BodyTarget{.effector = humanoid::Effector::LeftHand, .position = {0.3, 1.2, 0.4}};
    part.ik_state.body.pace = 0.1;  // and no turns
    Solvers solvers;
    EXPECT_TRUE(test::has(humanoid_code(part, solvers), "body_state = {.pace = 0.1};"));
}

// Scenes written by older versions still open, with the same meaning.

/// Written by version 1: a chain with limits under the microscope, and a rope beside a rotated box.
const std::string version_1 = tendril::test::source_path("tests/app/labs/scene_version_1.json");

/// Checks that each rotation takes the rest direction, +X, to the bone's direction.
void expect_rotations_of(const std::vector<glm::quat>& rotations, const std::vector<glm::vec3>& joints) {
    ASSERT_EQ(rotations.size() + 1, joints.size());
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const glm::vec3 bone = glm::normalize(joints[i + 1] - joints[i]);
        EXPECT_LT(glm::distance(rotations[i] * glm::vec3(1, 0, 0), bone), 1e-4f) << "bone " << i;
    }
}

class SceneVersion1 : public ChainTest {};

TEST_F(SceneVersion1, OpensWithItsRotationsUnchanged) {
    load_scene_file(workspace, version_1);
    ASSERT_EQ(part().reach.state.bones(), 4u);
    expect_rotations_of(part().reach.state.rotations, positions(part().chain));
    expect_rotations_of(part().study.start_state.rotations, part().study.start);
    EXPECT_EQ(part().study.step, 3u);
    run("chain.target", {{"to", {1, 2, 0.5}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Converged");
}

TEST_F(SceneVersion1, IsSavedAsVersion2WithWLastEverywhere) {
    load_scene_file(workspace, version_1);
    save_scene_file(workspace, path("scene.json"));
    const Json old = parse_json(read_text_file(version_1)), now = parse_json(test::read(path("scene.json")));
    EXPECT_EQ(old["tendril_scene"], 1);
    EXPECT_EQ(now["tendril_scene"], 2);
    const Json& was = old["labs"]["chain"];
    const Json& is = now["labs"]["chain"];
    for (const char* owner : {"reach", "study"}) {
        ASSERT_EQ(is[owner]["state"]["rotations"].size(), 4u);
        for (std::size_t i = 0; i < 4; ++i) {
            const Json& w_first = was[owner]["rotations"][i];
            EXPECT_EQ(is[owner]["state"]["rotations"][i],
                      Json::array({w_first[1], w_first[2], w_first[3], w_first[0]}));
        }
    }
    // The ropes' quaternions already had that order; two of their keys were renamed, and particles have three
    // numbers fewer.
    std::string ropes = old["labs"]["rope"].dump();
    for (const auto& [before, after] : {std::pair{"\"torture\"", "\"jitter\""}, {"\"stress\"", "\"strain\""}})
        ropes.replace(ropes.find(before), std::string_view(before).size(), after);
    Json expected = parse_json(ropes);
    for (Json& row : expected["world"]["particles"])
        if (row.size() == 10)
            row.erase(row.begin() + 6, row.begin() + 9);  // the displacement of the substep before
    const auto in_any_order = [](const Json& json) { return nlohmann::json::parse(json.dump()); };
    for (const auto& each : nlohmann::json::diff(in_any_order(expected), in_any_order(now["labs"]["rope"]))) {
        const char last = each["path"].get<std::string>().back();
        EXPECT_TRUE(each["op"] == "add" && std::isalpha(static_cast<unsigned char>(last)) != 0)
            << each << "; only members that version 1 did not have may differ";
    }

    Workspace again = make_blank_workspace(labs);
    load_scene_file(again, path("scene.json"));
    EXPECT_EQ(save_scene(again), now);
}

TEST_F(SceneVersion1, ADamagedOneIsRefusedWithPresentMessages) {
    const auto refusal_of = [&](const Json& rotations) {
        Json scene = parse_json(read_text_file(version_1));
        scene["labs"]["chain"]["reach"]["rotations"] = rotations;
        return test::message_of([&] { load_scene(workspace, scene); });
    };
    const Json unit = {1, 0, 0, 0};
    EXPECT_TRUE(test::says(refusal_of({unit, unit, unit, {1, 0, 0}}), "state.rotations.3 quaternion"));
    EXPECT_TRUE(test::has(refusal_of({unit, unit, unit, {2, 0, 0, 0}}), "state.rotations.3"));
    EXPECT_TRUE(test::has(refusal_of(7), "rotations"));
    EXPECT_EQ(refusal_of({unit, unit, unit, unit}), "");
}

}  // namespace
}  // namespace tendril::app
