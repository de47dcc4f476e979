// BVH files as programs write them: loose spellings and damage.
#include <gtest/gtest.h>

#include <string>

#include "app/io/character/bvh.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app::bvh_spelling {
namespace {

const std::string stalk =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\n"
    "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
    "JOINT Neck\n{\nOFFSET 0 50 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
    "End Site\n{\nOFFSET 0 12 0\n}\n}\n}\n";
const std::string rows = "0 90 0 0 0 0 10 0 0\n0 90 0 0 0 0 20 0 0\n0 90 0 0 0 0 30 0 0\n";
const std::string motion = "MOTION\nFrames: 3\nFrame Time: 0.0333333\n" + rows;

std::string all_notes(const Character& character) {
    std::string all;
    for (const std::string& each : character.notes) all += each + '\n';
    return all;
}

std::string refusal(const std::string& text) {
    return test::message_of([&] { parse_bvh(text, "it.bvh"); });
}

TEST(Bvh, SpellingsOfRealExportersAreReadAsDeclaredWithANote) {
    const struct {
        const char* kind;
        std::string text;
        const char* note;
    } loose[] = {
        {"extra row", stalk + motion + "0 90 0 0 0 0 40 0 0\n", "1 more row than 3"},
        {"spaced colon", stalk + "MOTION\nFrames : 3\nFrame Time : 0.0333333\n" + rows, "Frames Frame Time"},
        {"no space", stalk + "MOTION\nFrames:3\nFrame Time: 0.0333333\n" + rows, "Frames"},
        {"no space", stalk + "MOTION\nFrames: 3\nFrame Time:0.0333333\n" + rows, "Frame Time"},
        {"^Z", stalk + motion + "\x1a", "control character"},
        {"NUL", stalk + motion + std::string(3, '\0') + "\r\n", "control character"},
        {"fewer rows", stalk + "MOTION\nFrames: 5\nFrame Time: 0.0333333\n" + rows, "2 fewer rows than 5"},
        {"one row fewer", stalk + "MOTION\nFrames: 4\nFrame Time: 0.0333333\n" + rows + "\n ",
         "1 fewer row than 4"},
        {"cut off in a row", stalk + "MOTION\nFrames: 4\nFrame Time: 0.0333333\n" + rows + "0 90 0 0 0",
         "cut off in row 4 of 4"},
        {"cut off in a row that is not declared", stalk + motion + "0 90 0 0", "1 more row"},
    };
    const Character strict = parse_bvh(stalk + motion, "it.bvh");
    for (const auto& each : loose) {
        SCOPED_TRACE(each.kind);
        ASSERT_EQ(refusal(each.text), "");
        const Character read = parse_bvh(each.text, "it.bvh");
        EXPECT_EQ(read.clips, strict.clips);
        EXPECT_TRUE(test::says(all_notes(read), each.note));
        EXPECT_EQ(read.notes.size(), strict.notes.size() + 1);
    }
}

TEST(Bvh, ATurnBeyond180DegreesTakesTheShortWay) {
    std::string text = stalk + "MOTION\nFrames: 100\nFrame Time: 0.0333333\n";
    for (int i = 0; i < 100; ++i)
        text += "0 90 0 0 " + std::to_string(std::remainder(31.0 * i, 360.0)) + " 0 0 0 0\n";
    const auto channels = parse_bvh(text, "it.bvh").clips.at(0).channels;
    for (const auto& channel : channels)
        for (std::size_t i = 1; i < channel.rotation.values.size(); ++i)
            EXPECT_GE(glm::dot(channel.rotation.values[i - 1], channel.rotation.values[i]), 0.0) << i;
}

TEST(Bvh, DamageIsRefusedWithTheLine) {
    const std::string head = stalk + "MOTION\nFrames: 3\nFrame Time: 0.0333333\n";
    EXPECT_TRUE(test::says(refusal(stalk + "MOTION\nFrames: 3\nFrame Time: 0,0333333\n" + rows),
                           "line 18 decimal point 0,0333333"));
    EXPECT_TRUE(test::says(refusal(head + "0 90 0 0 0 0 10 0 0\n0 90 nan 0 0 0 10 0 0\n"), "line 20 nan"));
    const std::string fine = "0 90 0 0 0 0 10 0 0\n";
    EXPECT_TRUE(test::says(refusal(head + fine + "0 90 0 0 0 0 10 0\n" + fine), "line 20 9 found 8"));
    EXPECT_TRUE(test::says(refusal(head + fine + "0 90 0 0 0 0 10 0 0 0\n" + fine), "line 20 9 found 10"));
    EXPECT_TRUE(test::says(refusal(head + fine + fine + "0 90 0\n"), "line 21 9 found 3"));
    EXPECT_TRUE(
        test::says(refusal(stalk + "MOTION\nFrames: 3\nFrame Time: 0\n" + rows), "line 18 frame time"));
    std::string nine = stalk;
    nine.replace(nine.find("CHANNELS 3"), 10, "CHANNELS 9");
    EXPECT_TRUE(test::says(refusal(nine + motion), "line 9 channels"));
    std::string wide = "\xff\xfe";
    for (const char c : stalk + motion) wide += c, wide += '\0';
    EXPECT_TRUE(test::says(refusal(wide), "line 1 UTF-16"));
    EXPECT_TRUE(test::says(refusal(wide.substr(2)), "line 1 UTF-16"));
}

TEST(Bvh, ALongNameIsNotCopiedToThousandsOfEndSites) {
    std::string text = "HIERARCHY\nROOT " + std::string(100'000, 'a') + "\n{\nOFFSET 0 0 0\n";
    for (int i = 0; i < 4000; ++i) text += "End Site\n{\n}\n";
    EXPECT_TRUE(test::says(refusal(text + "}\nMOTION\nFrames: 0\nFrame Time: 1\n"), "line 2 name"));
    std::string nested = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nEnd Site\n{\nEnd Site\n{\n}\n}\n}\n";
    EXPECT_TRUE(test::says(refusal(nested + "MOTION\nFrames: 0\nFrame Time: 1\n"), "line 7 End Site"));
}

}  // namespace
}  // namespace tendril::app::bvh_spelling
