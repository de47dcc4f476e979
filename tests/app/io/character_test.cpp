// Characters: the built-in figure, and third-party files if present.
#include <gtest/gtest.h>

#include <filesystem>
#include <tendril/humanoid/bone_map.hpp>

#include "app/io/character/read.hpp"
#include "app/io/character/stick_figure.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using humanoid::Bone;
using humanoid::BoneMap;

TEST(StickFigure, HasEveryBoneOfABodyForCertain) {
    const Character figure = stick_figure();
    const BoneMap map = humanoid::match_bones(figure.skeleton);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        ASSERT_GE(map[bone].node, 0) << humanoid::name(bone);
        EXPECT_EQ(figure.skeleton[static_cast<std::size_t>(map[bone].node)].name, humanoid::name(bone));
        EXPECT_GT(map[bone].confidence, 0.9) << humanoid::name(bone);
    }
    EXPECT_TRUE(map.is_usable());
    EXPECT_EQ(map.rest, humanoid::RestPose::T);
}

TEST(StickFigure, WalksAndPunches) {
    const Character figure = stick_figure();
    ASSERT_EQ(figure.clips.size(), 2u);
    EXPECT_EQ(figure.clips[0].name, "walk");
    EXPECT_EQ(figure.clips[1].name, "punch");
    for (const humanoid::Clip& clip : figure.clips)
        EXPECT_TRUE(humanoid::check(clip, figure.skeleton))
            << humanoid::check(clip, figure.skeleton).message();
    std::vector<rig::Transform> pose(figure.skeleton.size());
    humanoid::sample(figure.clips[0], figure.skeleton, figure.clips[0].duration, pose);
    EXPECT_NEAR(pose[*figure.skeleton.find("Hips")].translation.z, 1.1, 1e-9);
}

TEST(CharacterFiles, BrokenOnesAreRefusedAndNamed) {
    const fs::path broken = fs::path(tendril::test::characters_folder()) / "broken";
    if (!fs::is_directory(broken)) GTEST_SKIP() << broken << " is not there";
    for (const auto& entry : fs::directory_iterator(broken)) {
        const std::string name = entry.path().filename().string();
        try {
            read_character(entry.path());
            ADD_FAILURE() << name << " was read";
        } catch (const std::runtime_error& error) {
            EXPECT_TRUE(std::string_view(error.what()).starts_with(name)) << error.what();
        }
    }
}

TEST(CharacterFiles, MissingFilesAndOtherKindsAreRefused) {
    EXPECT_THROW(read_character("nothing.glb"), std::runtime_error);
    EXPECT_THROW(read_character("notes.txt"), std::runtime_error);
}

}  // namespace
}  // namespace tendril::app
