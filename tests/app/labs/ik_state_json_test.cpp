// IK states in current and older scene files.
#include "app/labs/kit/library_json.hpp"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

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
    try {
        load_ik_state({json, "state"}, 2);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(IkStateJson, ComesBackBitForBit) {
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

TEST(IkStateJson, WithoutJointsThePoleHasThoseOfTheChain) {
    Json json = save_ik_state(remembering());
    json["pole"].erase("joints");
    EXPECT_EQ(load_ik_state({json, "state"}, 2, remembering().pole.joints), remembering());
    EXPECT_NE(refusal(json), "") << "there is no chain";
}

TEST(IkStateJson, ThatIsWrongIsRefusedWithItsPlace) {
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

}  // namespace
}  // namespace tendril::app
