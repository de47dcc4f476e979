#include "app/system/atomic_file.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <random>
#include <thread>

#include "tests/app/support/child.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;
using test::has;
using test::message_of;
using test::TempFolder;
using Names = std::vector<std::string>;

struct AtomicFiles : testing::Test {
    const TempFolder folder;
};

std::string write_message(const fs::path& path, std::string_view bytes = "new") {
    return message_of([&] { write_file_atomically(path, bytes); });
}

std::string check_message(const fs::path& path) {
    return message_of([&] { check_writable(path); });
}

LABEL(slow, "AtomicFiles.IsWholeWheneverItsWriterIsKilled");

TEST_F(AtomicFiles, MakesAndReplacesAFileAndLeavesNothingBesideIt) {
    for (const std::string& bytes :
         {std::string("first"), std::string(), std::string("a\0b\n", 4), std::string(1 << 20, 'x')}) {
        EXPECT_EQ(write_message(folder / "file", bytes), "");
        EXPECT_EQ(test::read(folder / "file"), bytes);
    }
    EXPECT_EQ(folder.names(), Names{"file"});
}

TEST_F(AtomicFiles, WorksInTheCurrentFolder) {
    const auto result = test::in_child([&] {
        fs::current_path(folder.path());
        write_file_atomically("plain", "here");
        check_writable("other");
        return 0;
    });
    EXPECT_EQ(result, 0);
    EXPECT_EQ(test::read(folder / "plain"), "here");
    EXPECT_EQ(folder.names(), Names{"plain"});
}

TEST_F(AtomicFiles, KeepsThePermissionsOfTheReplacedFile) {
    test::write(folder / "secret", "old");
    fs::permissions(folder / "secret", fs::perms::owner_read | fs::perms::owner_write);
    ASSERT_EQ(write_message(folder / "secret"), "");
    EXPECT_EQ(fs::status(folder / "secret").permissions(), fs::perms::owner_read | fs::perms::owner_write);

    const mode_t mask = ::umask(0027);
    ASSERT_EQ(write_message(folder / "fresh"), "");
    ::umask(mask);
    EXPECT_EQ(static_cast<int>(fs::status(folder / "fresh").permissions()), 0640);
}

TEST_F(AtomicFiles, WritesThroughSymbolicLinks) {
    fs::create_directory(folder / "deep");
    test::write(folder / "deep" / "target", "old");
    fs::create_symlink("deep/target", folder / "link");
    fs::create_symlink(folder / "link", folder / "link2");
    fs::create_symlink("deep/later", folder / "dangling");
    EXPECT_EQ(write_message(folder / "link2", "through"), "");
    EXPECT_EQ(write_message(folder / "dangling", "made"), "");
    EXPECT_EQ(test::read(folder / "deep" / "target"), "through");
    EXPECT_EQ(test::read(folder / "deep" / "later"), "made");
    EXPECT_TRUE(fs::is_symlink(folder / "link2"));

    fs::create_symlink("round", folder / "round");
    EXPECT_TRUE(has(write_message(folder / "round"), "round: "));
}

TEST_F(AtomicFiles, RefusesPathsThatCannotBeFiles) {
    fs::create_directory(folder / "dir");
    test::write(folder / "file", "old");
    const std::string too_long(300, 'x');
    const std::vector<std::pair<fs::path, std::string>> bad{
        {"", "cannot write : not a file name"},
        {folder / std::string("file\0more", 9), "not a file name"},
        {folder / "dir", "dir: is a folder"},
        {folder / "new/", "new/: is a folder"},
        {folder / "missing" / "file", "missing/file: No such file or directory"},
        {folder / "file" / "below", "file/below: Not a directory"},
        {folder / too_long, "File name too long"},
        {"/proc/tendril", "/proc/tendril: "},
    };
    for (const auto& [path, reason] : bad) {
        EXPECT_TRUE(has(write_message(path), reason));
        EXPECT_TRUE(write_message(path).starts_with("cannot write " + std::string(path.c_str())));
        EXPECT_TRUE(has(check_message(path), reason));
    }
    EXPECT_EQ(folder.names(), (Names{"dir", "file"}));
    EXPECT_EQ(test::read(folder / "file"), "old");
}

TEST_F(AtomicFiles, RefusesWithoutPermission) {
    test::write(folder / "file", "old");
    fs::permissions(folder / "file", fs::perms::owner_read);
    const auto result = test::in_child([&] {
        // root can write anywhere.
        if (::geteuid() == 0 && (::chown(folder.path().c_str(), 65534, 65534) != 0 || ::setuid(65534) != 0))
            return 9;
        const bool read_only = has(write_message(folder / "file"), "Permission denied") &&
                               has(check_message(folder / "file"), "Permission denied");
        fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
        const bool closed = has(write_message(folder / "new"), "Permission denied") &&
                            has(check_message(folder / "new"), "Permission denied");
        fs::permissions(folder.path(), fs::perms::owner_all);
        return (read_only ? 0 : 1) + (closed ? 0 : 2);
    });
    EXPECT_EQ(result, 0);
    EXPECT_EQ(test::read(folder / "file"), "old");
    EXPECT_EQ(folder.names(), Names{"file"});
}

/// A device to write to. root gets a private one: if the code is wrong, it could replace the system's device
/// with a file. Empty if none can be made.
fs::path device(const TempFolder& folder, const char* name, unsigned minor_number) {
    if (::geteuid() != 0) return fs::path("/dev") / name;
    const fs::path path = folder / name;
    const bool made = ::mknod(path.c_str(), S_IFCHR | 0666, makedev(1, minor_number)) == 0;
    return made && std::ofstream(path) ? path : fs::path();
}

TEST_F(AtomicFiles, WritesIntoDevicesAndLeavesThemThere) {
    const fs::path null = device(folder, "null", 3), full = device(folder, "full", 7);
    if (null.empty() || full.empty()) GTEST_SKIP() << "no devices can be made in " << folder.path();
    EXPECT_EQ(write_message(null), "");
    EXPECT_TRUE(fs::is_character_file(null));
    EXPECT_TRUE(has(write_message(full), "No space left on device"));
    EXPECT_TRUE(fs::is_character_file(full));
    EXPECT_EQ(check_message(null), "");
}

TEST_F(AtomicFiles, WritesIntoPipesAndLeavesThemThere) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::string received;
    std::thread reader([&] { received = test::read(pipe); });
    EXPECT_EQ(write_message(pipe, std::string(200'000, 'p')), "");
    reader.join();
    EXPECT_EQ(received.size(), 200'000u);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(AtomicFiles, DoesNotWaitForeverForAPipeWithoutReader) {
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_TRUE(has(write_message(folder / "pipe"), "nobody reads from this pipe"));
}

TEST_F(AtomicFiles, CheckingLeavesNoTrace) {
    test::write(folder / "file", "old");
    const auto time = fs::last_write_time(folder / "file");
    EXPECT_EQ(check_message(folder / "file"), "");
    EXPECT_EQ(check_message(folder / "new"), "");
    EXPECT_EQ(folder.names(), Names{"file"});
    EXPECT_EQ(test::read(folder / "file"), "old");
    EXPECT_EQ(fs::last_write_time(folder / "file"), time);
}

TEST_F(AtomicFiles, AFullDiskLeavesTheOldFileAlone) {
    test::write(folder / "file", "old");
    const auto result = test::in_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100'000, 100'000};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) return 9;
        return has(write_message(folder / "file", std::string(300'000, 'x')), "File too large") ? 0 : 1;
    });
    EXPECT_EQ(result, 0);
    EXPECT_EQ(test::read(folder / "file"), "old");
    EXPECT_EQ(folder.names(), Names{"file"});
}

/// A temporary name may be taken by a dead program with the same process ID.
TEST_F(AtomicFiles, SkipsTheRemainsOfADeadWriter) {
    const auto result = test::in_child([&] {
        for (int i = 0; i < 500; ++i)
            test::write(
                folder / (".tendril-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp"),
                "half of something longer");
        write_file_atomically(folder / "file", "whole");
        return 0;
    });
    EXPECT_EQ(result, 0);
    EXPECT_EQ(test::read(folder / "file"), "whole");
}

/// The version's letter, repeated a number of times that the letter determines: torn or mixed versions show.
std::string version_of(int i) {
    const auto step = static_cast<std::size_t>(i % 26);
    return std::string(50'000 + 17'000 * step, static_cast<char>('a' + i % 26));
}

TEST_F(AtomicFiles, IsWholeWheneverItsWriterIsKilled) {
    const auto path = folder / "file";
    write_file_atomically(path, version_of(0));
    std::mt19937 random(3);
    std::uniform_int_distribution<int> microseconds(0, 15'000);
    int changed = 0, torn_beside = 0;
    std::string last = version_of(0);
    for (int round = 0; round < 100; ++round) {
        const pid_t writer = ::fork();
        if (writer == 0) {
            for (int i = round;; ++i) write_file_atomically(path, version_of(i));
        }
        std::this_thread::sleep_for(std::chrono::microseconds(microseconds(random)));
        ::kill(writer, SIGKILL);
        ::waitpid(writer, nullptr, 0);

        const std::string now = test::read(path);
        ASSERT_FALSE(now.empty());
        ASSERT_TRUE(now == version_of(now[0] - 'a')) << "torn in round " << round;
        changed += now != last;
        last = now;
        for (const auto& name : folder.names()) {
            if (name == "file") continue;
            ++torn_beside;
            fs::remove(folder / name);
        }
    }
    // Otherwise nothing is tested: some writers must finish, others must be interrupted.
    EXPECT_GT(changed, 5);
    EXPECT_GT(torn_beside, 5);
}

}  // namespace
}  // namespace tendril::app
