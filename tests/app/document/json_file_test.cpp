// Reading files that are missing, endless, too large or too deep, and the memory that this takes.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <thread>

#include "app/document/json_complete.hpp"
#include "tests/app/support/child.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::message_of;
using test::TempFolder;

struct JsonFile : testing::Test {
    const TempFolder folder;
};

std::string read_message(const std::filesystem::path& path) {
    return message_of([&] { read_text_file(path); });
}

TEST_F(JsonFile, IsReadWithItsPathAndLineInErrors) {
    test::write(folder / "good.json", "{\"a\": 1}\n");
    EXPECT_EQ(read_json_file(folder / "good.json")["a"], 1);
    test::write(folder / "bad.json", "{\n\"a\": ]}\n");
    EXPECT_TRUE(
        has(message_of([&] { read_json_file(folder / "bad.json"); }), "bad.json: line 2: unexpected ']'"));
}

TEST_F(JsonFile, RefusesPathsThatAreNotFiles) {
    EXPECT_TRUE(has(read_message(folder / "missing"), "missing: No such file or directory"));
    EXPECT_TRUE(has(read_message(folder.path()), ": is a folder"));
    EXPECT_TRUE(has(read_message(folder / "a" / "b"), ": No such file or directory"));
    EXPECT_TRUE(has(read_message(""), "No such file or directory"));
    EXPECT_TRUE(has(read_message(std::string("a\0b", 3)), "not a file name"));
    EXPECT_EQ(read_text_file("/dev/null"), "");
}

TEST_F(JsonFile, Of64MegabytesIsReadAndOneByteMoreRefused) {
    const auto path = folder / "large";
    test::write(path, "");
    std::filesystem::resize_file(path, max_file_bytes);
    EXPECT_EQ(read_text_file(path).size(), max_file_bytes);
    std::filesystem::resize_file(path, max_file_bytes + 1);
    EXPECT_TRUE(has(read_message(path), "large: larger than 64 MB"));
}

TEST_F(JsonFile, WithoutAnEndIsRefused) {
    EXPECT_TRUE(test::says(read_message("/dev/zero"), "/dev/zero larger 64 MB"));
}

TEST_F(JsonFile, MayBeAPipe) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { test::write(pipe, "{\"a\": [" + std::string(200'000, ' ') + "7]}"); });
    const Json json = read_json_file(pipe);
    writer.join();
    EXPECT_EQ(json["a"][0], 7);
}

TEST_F(JsonFile, DoesNotWaitForeverForAPipeWithoutWriter) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_TRUE(test::says(read_message(pipe), "pipe nothing came through this pipe for 5 s"));
}

TEST_F(JsonFile, Of100MegabytesOfBracketsIsRefusedInNoMemory) {
    const auto path = folder / "brackets.json";
    const std::string block(1 << 20, '[');
    for (int i = 0; i < 100; ++i) std::ofstream(path, std::ios::app | std::ios::binary) << block;
    const int result = test::in_child([&] {
        const long before = test::peak_megabytes();
        const std::string message = message_of([&] { read_json_file(path); });
        if (message.find("larger than 64 MB") == message.npos) return 100;
        return static_cast<int>(std::min(99L, test::peak_megabytes() - before));
    });
    EXPECT_LT(result, 8 * test::sanitizer_factor) << "megabytes, or 100 and more for the wrong answer";
    EXPECT_GE(result, 0);
}

TEST_F(JsonFile, Of60MegabytesOfBracketsIsRefusedInTheMemoryOfItsText) {
    const std::string brackets(60 << 20, '[');
    const int result = test::in_child([&] {
        const long before = test::peak_megabytes();
        if (message_of([&] { parse_json(brackets); }) != "line 1: nested deeper than 64") return 100;
        return static_cast<int>(std::min(99L, test::peak_megabytes() - before));
    });
    EXPECT_LT(result, 8 * test::sanitizer_factor);
    EXPECT_GE(result, 0);
}

}  // namespace
}  // namespace tendril::app
