// Animated PNG: reading returns what was written, pixel for pixel, with a strict reader.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "app/io/apng.hpp"
#include "app/io/samples.hpp"
#include "app/system/child_process.hpp"
#include "tests/app/support/apng.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using app::ApngFile;
using app::Image;

/// A gradient with a square that moves with `number`, translucent at its edge.
Image picture(glm::ivec2 size, int number) {
    Image image{size, {}};
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const bool inside = std::abs(x - 3 * number - 4) < 4 && std::abs(y - 2 * number - 4) < 4;
            for (const int c : {inside ? 250 : 3 * x, inside ? 9 * number : 5 * y, x + y, inside ? 90 : 255})
                image.rgba.push_back(static_cast<std::uint8_t>(c & 255));
        }
    return image;
}

Image noise(glm::ivec2 size, unsigned seed) {
    std::mt19937 random(seed);
    Image image{size, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * size.x * size.y))};
    for (auto& each : image.rgba) each = static_cast<std::uint8_t>(random());
    return image;
}

std::string written(const std::vector<Image>& frames, app::VideoFormat format) {
    const TempFolder folder;
    format.size = frames.front().size;
    format.frames = static_cast<int>(frames.size());
    ApngFile file(folder / "a.png", format);
    for (const Image& frame : frames) file.add(frame);
    file.finish();
    file.commit();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
    return read(folder / "a.png");
}

Image opaque(Image image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

TEST(AnimatedPng, ReadsBackPixelForPixel) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(37, 23), glm::ivec2(300, 5)}) {
        for (const bool transparent : {false, true}) {
            std::vector<Image> frames;
            for (int i = 0; i < 6; ++i) frames.push_back(picture(size, i / 2));  // each twice
            frames.push_back(noise(size, 7));
            const Apng read = read_apng(written(frames, {.transparent = transparent}));
            EXPECT_EQ(read.size, size);
            EXPECT_EQ(read.plays, 0u) << "for ever";
            ASSERT_EQ(read.frames.size(), frames.size());
            for (std::size_t i = 0; i < frames.size(); ++i)
                EXPECT_EQ(read.frames[i].image.rgba, (transparent ? frames[i] : opaque(frames[i])).rgba) << i;
        }
    }
}

/// Larger than a chunk, and than zlib's buffer.
TEST(AnimatedPng, LargeFramesAreSplitIntoChunks) {
    const std::vector<Image> frames{noise({500, 300}, 1), noise({500, 300}, 2)};
    const std::string bytes = written(frames, {.transparent = true});
    EXPECT_GT(bytes.size(), 1'000'000u);
    const Apng read = read_apng(bytes);
    EXPECT_EQ(read.frames[0].image.rgba, frames[0].rgba);
    EXPECT_EQ(read.frames[1].image.rgba, frames[1].rgba);
}

TEST(AnimatedPng, WritesOnlyWhatChanged) {
    Image second = picture({200, 100}, 1), third = second;
    for (const auto& [x, y] : {std::pair{20, 30}, std::pair{29, 32}})
        third.rgba[4 * static_cast<std::size_t>(y * 200 + x) + 1] ^= 255;
    Image fourth = third;
    for (const auto& [x, y] : {std::pair{59, 40}, std::pair{50, 41}, std::pair{52, 43}})
        fourth.rgba[4 * static_cast<std::size_t>(y * 200 + x) + 2] ^= 255;
    const Apng read = read_apng(written({picture({200, 100}, 1), second, third, fourth}, {}));
    EXPECT_EQ(read.frames[0].changed, glm::ivec2(200, 100));
    EXPECT_EQ(read.frames[1].changed, glm::ivec2(1, 1)) << "nothing";
    EXPECT_EQ(read.frames[2].changed, glm::ivec2(10, 3));
    EXPECT_EQ(read.frames[3].changed, glm::ivec2(10, 4)) << "its widest row is the first";
    EXPECT_EQ(read.frames[3].image.rgba, opaque(fourth).rgba);
    const std::string once = written({noise({100, 100}, 1)}, {}),
                      often = written(std::vector<Image>(50, noise({100, 100}, 1)), {});
    EXPECT_LT(often.size(), once.size() + 50 * 100);
}

TEST(AnimatedPng, ShowsAFrameForItsNumberOfTicks) {
    const auto seconds = [](const app::VideoFormat& format) {
        const Apng read = read_apng(written({picture({4, 4}, 0), picture({4, 4}, 1)}, format));
        EXPECT_EQ(read.frames[0].numerator * read.frames[1].denominator,
                  read.frames[1].numerator * read.frames[0].denominator);
        return static_cast<double>(read.frames[1].numerator) / read.frames[1].denominator;
    };
    EXPECT_DOUBLE_EQ(seconds({}), 1.0 / 30.0);
    EXPECT_DOUBLE_EQ(seconds({.every = 1}), 1.0 / 60.0);
    EXPECT_DOUBLE_EQ(seconds({.every = 1, .speed = 0.5}), 1.0 / 30.0);
    EXPECT_DOUBLE_EQ(seconds({.every = 60, .speed = 0.05}), 20.0);
    EXPECT_DOUBLE_EQ(seconds({.every = 60, .speed = 2.0}), 0.5);
}

/// Viewers without animation, and tests that compare pictures, see the first frame.
TEST(AnimatedPng, IsAPictureOfItsFirstFrame) {
    const std::vector<Image> frames{picture({31, 17}, 0), picture({31, 17}, 1)};
    EXPECT_EQ(app::decode_png(written(frames, {.transparent = true})).rgba, frames[0].rgba);
}

TEST(AnimatedPng, LeavesTheOldFileUnlessItIsFinished) {
    const TempFolder folder;
    write(folder / "a.png", "old");
    const auto begin = [&](int frames, const auto& then) {
        ApngFile file(folder / "a.png", {.size = {8, 8}, .frames = frames});
        file.add(picture({8, 8}, 0));
        return message_of([&] { then(file); });
    };
    begin(2, [](ApngFile&) {});
    EXPECT_TRUE(has(begin(2, [](ApngFile& file) { file.finish(); }), "only 1 of 2 frames"));
    EXPECT_TRUE(has(begin(1, [](ApngFile& file) { file.add(picture({8, 8}, 1)); }), "frame 2 of 1"));
    EXPECT_TRUE(has(begin(2, [](ApngFile& file) { file.add(picture({9, 8}, 1)); }), "9x8"));
    EXPECT_EQ(read(folder / "a.png"), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.png"});
    const auto in = [](const std::filesystem::path& path) {
        return message_of([&] { ApngFile(path, {.size = {8, 8}, .frames = 1}); });
    };
    EXPECT_TRUE(has(in("/nowhere/a.png"), "/nowhere/a.png"));
    EXPECT_TRUE(has(in("/dev/null"), "is not a regular file"));
}

TEST(AnimatedPng, ABrokenFileIsRefused) {
    const std::string whole = written({picture({20, 20}, 0), picture({20, 20}, 1)}, {});
    ASSERT_EQ(read_apng(whole).frames.size(), 2u);
    const auto broken = [](const std::string& bytes) {
        return !message_of([&] { read_apng(bytes); }).empty();
    };
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_TRUE(broken(whole.substr(0, length))) << "cut after " << length;
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 0x20);
        EXPECT_TRUE(broken(changed)) << "byte " << at;
    }
    EXPECT_TRUE(broken("")) << "empty";
    EXPECT_TRUE(broken(whole + "x"));
    std::mt19937 random(3);
    for (int i = 0; i < 200; ++i) {
        std::string garbage = whole.substr(0, 8 + random() % 60);
        for (int j = 0; j < 200; ++j) garbage += static_cast<char>(random());
        EXPECT_TRUE(broken(garbage));
    }
}

// Child processes: found on PATH, given bytes, and their failures reported with their own messages.

using app::ChildProcess;
using Words = std::vector<std::string>;

Words shell(const std::string& script) {
    return {"/bin/sh", "-c", script};
}

TEST(ChildProcesses, AreGivenAllBytes) {
    const TempFolder folder;
    std::string bytes;
    for (unsigned i = 0; i < 1'000'000; ++i) bytes += static_cast<char>(i * i >> 3);
    ChildProcess child(shell("sleep 0.1; cat > '" + (folder / "out").string() + "'; echo chatter"));
    child.write(bytes);
    child.write("end");
    child.finish(20.0);
    EXPECT_EQ(read(folder / "out"), bytes + "end");
}

TEST(ChildProcesses, FailWithTheirOwnMessages) {
    const auto failure = [](const std::string& script) {
        return message_of([&] { ChildProcess(shell(script)).finish(20.0); });
    };
    EXPECT_EQ(failure("true"), "");
    EXPECT_TRUE(test::says(failure("echo first >&2; echo 'no such encoder' >&2; echo >&2; exit 3"),
                           "sh no such encoder"));
    EXPECT_TRUE(test::says(failure("exit 3"), "sh code 3"));
    EXPECT_TRUE(test::says(failure("kill -9 $$"), "sh signal 9"));
    EXPECT_EQ(failure("yes long | head -100000 >&2; echo last >&2; exit 1"), "sh failed: last");
    EXPECT_TRUE(has(message_of([] { ChildProcess(Words{"/nowhere/tool"}); }), "cannot start tool"));
}

/// Writing to a pipe without a reader must not end this program.
TEST(ChildProcesses, MayEndBeforeTheyReadEverything) {
    const std::string many(10'000'000, 'x');
    const auto failure = [&](const std::string& script) {
        return message_of([&] { ChildProcess(shell(script)).write(many); });
    };
    EXPECT_EQ(failure("echo 'disk full' >&2; exit 1"), "sh failed: disk full");
    EXPECT_TRUE(test::says(failure("head -c 100000 > /dev/null"), "sh too early"));
}

TEST(ChildProcesses, HangingOnesAreAbandoned) {
    EXPECT_TRUE(
        test::says(message_of([] { ChildProcess(shell("exec sleep 60")).finish(0.05); }), "sh not exit"));
    EXPECT_TRUE(test::says(
        message_of([] { ChildProcess(shell("exec sleep 60")).write(std::string(1'000'000, 'x'), 0.05); }),
        "sh stopped reading"));
}

/// The child leaves a process in the background with the same files open, as xclip does.
TEST(ChildProcesses, MayLeaveAProcessBehind) {
    EXPECT_EQ(message_of([] { ChildProcess(shell("cat > /dev/null; sleep 5 & exit 0")).finish(2.0); }), "");
}

TEST(ChildProcesses, AreFoundOnPath) {
    EXPECT_EQ(app::find_program("sh").filename(), "sh");
    EXPECT_TRUE(app::find_program("tendril-no-such-program").empty());
    EXPECT_TRUE(app::find_program("").empty()) << "a folder is none";
}

using app::read_points;
using Points = std::vector<glm::vec3>;

TEST(PointsFromText, AreReadAsTablesListsAndSourceCode) {
    const Points one{{1, -2.5f, 3}}, two{{1, 2, 3}, {4, 5, 6}};
    for (const char* text :
         {"1 -2.5 3", "1,-2.5,3\n", "1;-2.5;3", "1\t-2.5\t3\r\n", "(1, -2.5, 3)", "[1, -2.5, 3]",
          "{1,-2.5,3};", "Vector3(1, -2.5, 3)", "new Vector3(1f, -2.5f, 3f)", "FVector(X=1.0 Y=-2.5 Z=3.0)",
          "(X=1,Y=-2.5,Z=3)", "(Z=3,X=1,Y=-2.5)", "vec3(1.0, -2.5, 3.0)", "glm::vec3{1, -2.5, 3}",
          "{\"x\": 1, \"y\": -2.5, \"z\": 3}", "[\n  1,\n  -2.5,\n  3\n]", "+1 -25e-1 3.", "x,y,z\n1,-2.5,3"})
        EXPECT_EQ(read_points(text, 10), one) << text;
    for (const char* text :
         {"1 2 3\n4 5 6", "1,2,3\n\n4,5,6\n", "[[1, 2, 3], [4, 5, 6]]", "{{1,2,3},{4,5,6}}",
          "[[1. 2. 3.]\n [4. 5. 6.]]", "[[\n1,\n2,\n3\n],\n[4,5,6]\n]\n", "[1, 2, 3\n 4, 5, 6]",
          "Vector3(1,2,3), Vector3(4,5,6)", "x y z\n1 2 3\n4 5 6", "(X=1,Y=2,Z=3)\n(X=4,Y=5,Z=6)",
          "new Vector3(1f, 2f, 3f),\nnew Vector3(4f, 5f, 6f),",
          "\xef\xbb\xbf"
          "1 2 3\n4 5 6"})
        EXPECT_EQ(read_points(text, 10), two) << text;
}

TEST(PointsFromText, InvalidTextIsRefusedWithLineAndContent) {
    struct Bad {
        std::string text, told;
    };
    std::string many;
    for (int i = 0; i < 100'000; ++i) many += "1 2 3\n";
    for (const Bad& bad :
         {Bad{"", "line 1 nothing"}, Bad{"1 2 3\n4 5", "line 2 three two"},
          Bad{"1 2 3\n4 5 6 7", "line 2 fourth 7"}, Bad{"[1,2,3,4,5,6]", "line 1 fourth 4"},
          Bad{"1 2 nan", "line 1 nan"}, Bad{"1 2 1000000001", "line 1 1000000001"},
          Bad{"1 2 3m", "line 1 3m"}, Bad{"hello world", "line 1 hello"},
          Bad{"(1, 2, 3", "line 1 not closed"}, Bad{"1 2 3)", "line 1 too many"},
          Bad{"(X=1,X=2,Z=3)", "line 1 x twice"}, Bad{"(X=1,2,Z=3)", "line 1 names none"},
          Bad{"X=1 Y=", "line 1 three one"}, Bad{"sin(1,2,3)", "line 1 sin"},
          Bad{std::string("1 2 \0", 5), "line 1"}, Bad{std::string(1 << 20, '['), "not closed"},
          Bad{std::string(1 << 20, 'j'), "line 1 expected a number"},
          Bad{std::string(1 << 20, '7'), "line 1 1e9"}, Bad{many, "line 10001 10000"}}) {
        const std::string told = message_of([&] { read_points(bad.text, 10'000); });
        EXPECT_TRUE(says(told, bad.told)) << bad.text.substr(0, 40);
        EXPECT_LT(told.size(), 200u);
    }
}

}  // namespace
}  // namespace tendril::test
