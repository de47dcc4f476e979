// Scenes written by older versions still open, with the same meaning.
#include <glm/gtc/quaternion.hpp>

#include "tests/app/labs/chain_support.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

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

TEST_F(SceneVersion1, opens_with_its_rotations_as_they_were) {
    load_scene_file(workspace, version_1);
    ASSERT_EQ(part().reach.state.bones(), 4u);
    expect_rotations_of(part().reach.state.rotations, positions(part().chain));
    expect_rotations_of(part().study.start_state.rotations, part().study.start);
    EXPECT_EQ(part().study.step, 3u);
    run("chain.target", {{"to", {1, 2, 0.5}}});
    EXPECT_EQ(state()["solve"]["report"]["status"], "Converged");
}

TEST_F(SceneVersion1, is_saved_again_as_version_2_with_w_last_everywhere) {
    load_scene_file(workspace, version_1);
    const test::TempFolder folder;
    save_scene_file(workspace, folder / "scene.json");
    const Json old = parse_json(read_text_file(version_1)),
               now = parse_json(test::read(folder / "scene.json"));
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
    // Those of the ropes were already in that order; two of their keys have been renamed, and particles have
    // three numbers fewer.
    std::string ropes = old["labs"]["rope"].dump();
    for (const auto& [before, after] : {std::pair{"\"torture\"", "\"jitter\""}, {"\"stress\"", "\"strain\""}})
        ropes.replace(ropes.find(before), std::string_view(before).size(), after);
    Json expected = parse_json(ropes);
    for (Json& row : expected["world"]["particles"])
        if (row.size() == 10)
            row.erase(row.begin() + 6, row.begin() + 9);  // the displacement of the substep before
    Json saved = now["labs"]["rope"];
    for (const char* newer : {"wind", "gusts", "still_air"})
        EXPECT_EQ(saved["world"]["settings"].erase(newer), 1u);
    EXPECT_EQ(saved["world"].erase("drift"), 1u);
    EXPECT_EQ(saved, expected);

    Workspace again = make_blank_workspace(labs);
    load_scene_file(again, folder / "scene.json");
    EXPECT_EQ(save_scene(again), now);
}

TEST_F(SceneVersion1, that_is_broken_is_refused_in_the_words_of_today) {
    const auto refusal_of = [&](const Json& rotations) {
        Json scene = parse_json(read_text_file(version_1));
        scene["labs"]["chain"]["reach"]["rotations"] = rotations;
        return test::message_of([&] { load_scene(workspace, scene); });
    };
    const Json unit = {1, 0, 0, 0};
    EXPECT_TRUE(test::says(refusal_of({unit, unit, unit, {1, 0, 0}}), "state.rotations.3 quaternion"));
    EXPECT_NE(refusal_of({unit, unit, unit, {2, 0, 0, 0}}).find("state.rotations.3"), std::string::npos);
    EXPECT_NE(refusal_of(7).find("rotations"), std::string::npos);
    EXPECT_EQ(refusal_of({unit, unit, unit, unit}), "");
}

}  // namespace
}  // namespace tendril::app
