// The figure's walk, and third-party clips, with their feet on the ground.
#include <gtest/gtest.h>

#include <filesystem>

#include "app/io/character/read.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/core/humanoid_feet_support.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using test::Measured;
using test::Walker;
using test::WalkOptions;

const double pi = std::acos(-1.0);

std::vector<humanoid::Ground> grounds() {
    return {*humanoid::Ground::flat(), *humanoid::Ground::slope(20.0 * pi / 180.0),
            *humanoid::Ground::stairs(0.15, 0.3)};
}

void expect_stands(const Measured& all) {
    EXPECT_LT(all.sink, 0.005);
    EXPECT_LT(all.floating, 0.005);
    EXPECT_LT(all.skate, 0.005);
    EXPECT_LE(all.stretch, 0.995 + 1e-6);
}

LABEL(slow, "CharacterFeet.ClipsThatOthersMadeStandToo");

TEST(CharacterFeet, TheFiguresSolesAreWhereItsBuilderPutsThem) {
    const Character figure = stick_figure();
    const auto soles = humanoid::find_soles(figure.skeleton, humanoid::match_bones(figure.skeleton));
    ASSERT_TRUE(soles) << soles.message();
    std::vector<humanoid::Placement> placements(figure.skeleton.size());
    place(figure.skeleton, rest_pose(figure.skeleton), placements);
    const auto points = sole_points(*soles, placements);
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 ankle = placements[soles->feet[i].foot].position;
        EXPECT_LT(glm::distance(points[i].heel, ankle + stick_heel), 1e-9);
        EXPECT_LT(glm::distance(points[i].toe, ankle + stick_toe), 1e-9);
    }
}

TEST(CharacterFeet, ClipsThatOthersMadeStandToo) {
    if (!fs::is_directory(tendril::test::characters_folder()))
        GTEST_SKIP() << tendril::test::characters_folder() << " is not there";
    int walked = 0;
    for (const auto& entry : fs::directory_iterator(tendril::test::characters_folder())) {
        if (!entry.is_regular_file() || !ends_as_character(entry.path())) continue;
        const Character character = read_character(entry.path());
        const auto soles =
            humanoid::find_soles(character.skeleton, humanoid::match_bones(character.skeleton));
        if (!soles || soles->leg > 2.0) continue;  // no body, or one in other units
        for (const humanoid::Clip& clip : character.clips) {
            WalkOptions walk{.seconds = std::min(clip.duration, 10.0)};
            walk.options.floor = clip_floor(character.skeleton, *soles, clip);
            Walker walker(character.skeleton, clip);
            for (const humanoid::Ground& ground : grounds()) {
                SCOPED_TRACE(entry.path().filename().string() + ' ' + clip.name + ' ' + name(ground.kind()));
                const Measured all = walker.walk(ground, walk);
                expect_stands(all);
                EXPECT_LT(all.beyond, 0.060 * std::max(1.0, soles->leg / 0.9));  // longer legs, faster knees
                ++walked;
            }
        }
    }
    EXPECT_GT(walked, 0);
}

}  // namespace
}  // namespace tendril::app
