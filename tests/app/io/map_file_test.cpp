// Bone maps as files: valid ones load unchanged, invalid ones are refused with the position of the fault.
#include <gtest/gtest.h>

#include "app/io/character/map_file.hpp"
#include "app/io/character/stick_figure.hpp"
#include "app/io/json_complete.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/core/random.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::BoneMap;

const humanoid::Skeleton& skeleton() {
    static const Character figure = stick_figure();
    return figure.skeleton;
}
std::string refusal(const std::string& text) {
    return test::message_of([&] { parse_map(text, "map.json"); });
}

TEST(MapFile, IsReadBackUnchanged) {
    tendril::test::Random random(3);
    for (int i = 0; i < 50; ++i) {
        BoneMap map = humanoid::match_bones(skeleton());
        for (humanoid::BoneMatch& each : map.bones)
            if (random.chance(4)) each = {};
        const SavedMap saved = saved_map(map, skeleton());
        const SavedMap read = parse_map(map_text(saved), "map.json");
        EXPECT_EQ(read, saved);
        const BoneMap again = applied(read, skeleton());
        for (std::size_t k = 0; k < humanoid::bone_count; ++k) {
            EXPECT_EQ(again.bones[k].node, map.bones[k].node);
            EXPECT_EQ(again.bones[k].confidence, map.bones[k].node < 0 ? 0.0 : 1.0);
        }
        humanoid::review(map, skeleton());
        EXPECT_EQ(again.missing, map.missing);
        EXPECT_EQ(again.rest, map.rest);
    }
}

TEST(MapFile, ANameThatTheCharacterLacksIsReported) {
    SavedMap saved = saved_map(humanoid::match_bones(skeleton()), skeleton());
    saved.bones[static_cast<std::size_t>(Bone::LeftHand)] = "hand_l";
    EXPECT_TRUE(test::says(test::message_of([&] { applied(saved, skeleton()); }), "LeftHand hand_l"));
}

TEST(MapFile, OtherTextIsRefusedWithItsPlace) {
    const auto with = [](const char* bones) {
        return std::string(R"({"tendril": "bone map", "version": 1, "bones": )") + bones + "}";
    };
    EXPECT_EQ(refusal(with(R"({"Hips": "a"})")), "");
    EXPECT_TRUE(test::says(refusal(with(R"({"Tail": "a"})")), "map.json bones.Tail no"));
    EXPECT_TRUE(test::says(refusal(with(R"({"Hips": "a", "Head": "a"})")), "map.json bones.Head Hips"));
    EXPECT_TRUE(test::has(refusal(with(R"({"Hips": 3})")), "map.json: bones.Hips"));
    EXPECT_TRUE(test::says(refusal(with("[]")), "map.json bones object"));
    for (const char* text :
         {"", "{", "[]", "3", "{}", R"({"tendril": "scene"})", R"({"tendril": "bone map"})",
          R"({"tendril": "bone map", "version": 2, "bones": {}})", R"({"tendril": "bone map", "version": 1})",
          R"({"tendril": "bone map", "version": 1, "bones": {}, "nodes": 3})",
          R"({"tendril": "bone map", "version": 1, "bones": {}, "nodes": [3]})"})
        EXPECT_TRUE(refusal(text).starts_with("map.json: ")) << text << ": " << refusal(text);
    Json many = Json::array();
    for (int i = 0; i < 5000; ++i) many.push_back("a");
    EXPECT_NE(refusal(R"({"tendril": "bone map", "version": 1, "bones": {}, "nodes": )" + many.dump() + "}"),
              "");
}

TEST(MapFile, RandomBytesAndCutTextsAreRefusedWithWords) {
    const std::string text = map_text(saved_map(humanoid::match_bones(skeleton()), skeleton()));
    tendril::test::Random random(8);
    for (int i = 0; i < 2000; ++i) {
        std::string bad = text.substr(0, random.below(text.size()));
        for (std::size_t k = random.below(6); k > 0 && !bad.empty(); --k) {
            const std::size_t at = random.below(bad.size());
            bad[at] = static_cast<char>(random.below(256));
        }
        const std::string why = refusal(bad);
        EXPECT_TRUE(why.empty() || why.starts_with("map.json: ")) << why;
    }
}

TEST(MapFile, IsKeptForSkeletonsWithTheSameNamesOnly) {
    const tendril::test::TempFolder folder;
    EXPECT_FALSE(find_kept_map(folder.path(), skeleton()));
    const SavedMap saved = saved_map(humanoid::match_bones(skeleton()), skeleton());
    const auto path = kept_map(folder.path(), skeleton());
    keep_map(folder.path(), saved, skeleton());
    EXPECT_EQ(tendril::test::read(path), map_text(saved));
    EXPECT_EQ(find_kept_map(folder.path(), skeleton()), saved);
    std::vector<humanoid::Node> nodes = skeleton().nodes();
    nodes.back().rest.translation *= 2.0;  // another size, but the same names
    EXPECT_EQ(find_kept_map(folder.path(), *humanoid::Skeleton::make(nodes)), saved);
    nodes.back().name = "other";
    const humanoid::Skeleton other = *humanoid::Skeleton::make(nodes);
    EXPECT_FALSE(find_kept_map(folder.path(), other));
    EXPECT_TRUE(forget_kept_map(folder.path(), skeleton()));
    EXPECT_FALSE(forget_kept_map(folder.path(), skeleton()));
    EXPECT_FALSE(find_kept_map(folder.path(), skeleton()));
}

TEST(MapFile, AKeptMapThatDoesNotFitIsRefusedByName) {
    const tendril::test::TempFolder folder;
    const SavedMap saved = saved_map(humanoid::match_bones(skeleton()), skeleton());
    keep_map(folder.path(), saved, skeleton());
    const auto path = kept_map(folder.path(), skeleton());
    const auto why = [&](const std::string& text) {
        tendril::test::write(path, text);
        return tendril::test::message_of([&] { find_kept_map(folder.path(), skeleton()); });
    };
    SavedMap other = saved;
    other.nodes.back() = "other";
    EXPECT_TRUE(tendril::test::has(why(map_text(other)), "nodes: they are not this character's nodes"));
    other = saved;
    other.bones[0] = "nobody's";
    EXPECT_TRUE(tendril::test::has(why(map_text(other)), "bones: Hips is node \"nobody's\""));
    EXPECT_TRUE(tendril::test::has(why("{"), path.filename().string()));
    EXPECT_TRUE(tendril::test::has(why(std::string(5000, '[')), path.filename().string()));
    EXPECT_TRUE(tendril::test::has(why(""), path.filename().string()));
    std::filesystem::remove(path);
    std::filesystem::create_directories(path);
    EXPECT_TRUE(tendril::test::has(
        tendril::test::message_of([&] { find_kept_map(folder.path(), skeleton()); }), "is not a file"));
    // If the folder cannot be created.
    tendril::test::write(folder / "file", "");
    EXPECT_TRUE(tendril::test::has(
        tendril::test::message_of([&] { keep_map(folder / "file", saved, skeleton()); }), "cannot write"));
}

}  // namespace
}  // namespace tendril::app
