#include "app/document/outputs.hpp"

#include <gtest/gtest.h>

#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::TempFolder;

struct Sample {
    OutputKind kind;
    std::string bytes;
};

std::vector<Sample> samples() {
    const std::string png = "\x89PNG\r\n\x1a\n", header = std::string(25, '0') + "0000";
    return {{OutputKind::Scene, R"({"tendril_scene": 2, "labs": {"chain": {"handles": 1, "layout": 2}}})"},
            {OutputKind::Recording, R"({"recording":1,"scene":{"tendril_scene":2}})"},
            {OutputKind::State, "{\"mode\": \"reach\",\n \"handles\": \"" + std::string(300'000, '1') +
                                    "\",\n \"layout\": {\"strip\": {}}}"},
            {OutputKind::Picture, png + header + "IDAT"},
            {OutputKind::Video, png + header + "sRGB0acTL"},
            {OutputKind::Video, std::string("\0\0\0\x20", 4) + "ftypisom"},
            {OutputKind::Motion, "glTF binary"},
            {OutputKind::Motion, "{\n  \"asset\": {\"version\": \"2.0\"}}"},
            {OutputKind::Motion, "HIERARCHY\nROOT Hips\n"},
            {OutputKind::BoneMap, R"({"tendril": "bone map", "version": 1})"},
            {OutputKind::Csv, "tick,error\n0,1\n"},
            {OutputKind::Trace, "{\"tendril\":\"trace\",\"up\":\"y\"}\n{\"joints\":[]}\n"}};
}

std::string refusal(Outputs outputs, const fs::path& path, OutputKind kind, bool redraws = false) {
    return message_of([&] { outputs.check({path}, kind, redraws); });
}

/// Every kind over every kind: the same kind needs --force, another kind is refused even with it.
TEST(Outputs, ReplaceOnlyTheirOwnKind) {
    const TempFolder folder;
    const fs::path file = folder / "file.any";
    std::vector<Sample> there = samples();
    for (const char* other :
         {"Dear diary", "\xff\xd8\xff\xe0 JPEG", "{}", "[1, 2]", "{\"command\": \"undo\"}\n"})
        there.push_back({OutputKind{-1}, other});
    for (const Sample& old : there) {
        test::write(file, old.bytes);
        for (const Sample& fresh : samples()) {
            const bool own = old.kind == fresh.kind;
            const std::string why = refusal({}, file, fresh.kind);
            EXPECT_TRUE(test::says(why, own ? "already exists --force" : "is not replaced it is not"))
                << why << ": " << old.bytes.substr(0, 30) << " by " << fresh.bytes.substr(0, 30);
            Outputs outputs;
            outputs.force = true;
            EXPECT_EQ(refusal(outputs, file, fresh.kind).empty(), own);
            EXPECT_EQ(refusal({}, file, fresh.kind, true).empty(), own);
        }
    }
}

TEST(Outputs, AreNeverInputsByAnyName) {
    const TempFolder folder;
    test::write(folder / "walk.glb", "glTF");
    fs::create_directories(folder / "sub/a b");
    for (const char* name : {"skin.png", "sub/a b/\xC3\xA4.png", "sub/in_binary.png", "other.png"})
        test::write(folder / name, samples()[3].bytes);
    test::write(folder / "hero.gltf", R"({"asset": {}, "buffers": [{"uri": "data:,other.png"}],
        "images": [{"name": "other.png", "uri": "skin.png"}, {"uri": "sub/a%20b/%C3%a4.png"}, {"uri": 7}]})");
    const std::string json = R"({"images": [{"uri": "sub\\in_binary.png"}]})";
    test::write(folder / "hero.vrm", "glTF" + std::string(8, '\2') + static_cast<char>(json.size()) +
                                         std::string(3, '\0') + "JSON" + json + std::string(9, '\1'));
    fs::create_symlink(folder / "walk.glb", folder / "symbolic.glb");
    fs::create_hard_link(folder / "walk.glb", folder / "hard.glb");
    Outputs outputs;
    outputs.force = true;
    outputs.inputs = {folder / "walk.glb"};
    outputs.in_use = {folder / "hero.gltf", folder / "hero.vrm"};
    for (const char* name : {"walk.glb", "sub/../walk.glb", "symbolic.glb", "hard.glb", "hero.gltf"})
        EXPECT_TRUE(test::says(refusal(outputs, folder / name, OutputKind::Motion), "in use as input"))
            << name;
    for (const char* name : {"skin.png", "sub/a b/\xC3\xA4.png", "sub/in_binary.png"})
        EXPECT_TRUE(test::says(refusal(outputs, folder / name, OutputKind::Picture, true), "in use as input"))
            << name;
    EXPECT_EQ(refusal(outputs, folder / "other.png", OutputKind::Picture, true), "");
    EXPECT_EQ(refusal(outputs, folder / "new.glb", OutputKind::Motion), "");
}

TEST(Outputs, AreReplacedUnaskedIfOnlyThisSessionWroteThem) {
    const TempFolder folder;
    const fs::path file = folder / "a.csv";
    Outputs outputs;
    const auto write = [&](const std::string& bytes) {
        return message_of([&] { outputs.write(file, OutputKind::Csv, bytes); });
    };
    for (const char* bytes : {"a,b\n1,2\n", "a,b\n3,4\n"}) EXPECT_EQ(write(bytes), "");
    test::write(file, "another,program\n");
    EXPECT_TRUE(test::says(write("a,b\n"), "was changed by another program"));
    EXPECT_EQ(test::read(file), "another,program\n");
    EXPECT_EQ(write("another,program\n"), "") << "it holds that already";
    test::write(file, "another,again\n");
    outputs.in_window = true;
    EXPECT_TRUE(test::says(write("a,b\n"), "Do the same again to replace it"));
    EXPECT_EQ(write("a,b\n"), "");
    EXPECT_EQ(test::read(file), "a,b\n");
    test::write(file, "");
    EXPECT_EQ(write("a,b\n"), "") << "an empty file has nothing to lose";
}

/// Long work is not lost if another program has written the file in the meantime.
TEST(Outputs, TakeAnotherNameAtTheEndOfLongWork) {
    const TempFolder folder;
    Outputs outputs;
    const auto place = [&] { return outputs.place_at_end(folder / "a.mp4", OutputKind::Video); };
    EXPECT_EQ(place().path, folder / "a.mp4");
    test::write(folder / "a.mp4", "Dear diary");
    test::write(folder / "a-1.mp4", "");
    EXPECT_EQ(place().path, folder / "a-2.mp4");
    EXPECT_TRUE(test::says(place().refusal, "a.mp4 is not replaced it is not a video"));
}

TEST(Outputs, AreAskedAboutTogether) {
    const TempFolder folder;
    std::vector<fs::path> files;
    for (const char* name : {"a.bvh", "b.bvh", "c.bvh", "new.bvh"}) files.push_back(folder / name);
    for (std::size_t i = 0; i < 3; ++i) test::write(files[i], "HIERARCHY");
    Outputs outputs;
    const auto check = [&] { return message_of([&] { outputs.check(files, OutputKind::Motion); }); };
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(test::says(check(), "a.bvh and 2 more already exist --force"));
    outputs.in_window = true;
    test::write(files[1], "HIERARCHY again");
    EXPECT_TRUE(test::says(check(), "again to replace it")) << "it has changed since";
    EXPECT_EQ(check(), "");
}

}  // namespace
}  // namespace tendril::app
