// Child processes: found on PATH, given bytes, and their failures reported with their own messages.
#include "app/io/child_process.hpp"

#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

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

}  // namespace
}  // namespace tendril::test
