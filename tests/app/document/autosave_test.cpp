#include "app/document/autosave.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/system/atomic_file.hpp"
#include "tests/app/support/child.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

using namespace std::chrono_literals;
using test::has;
using test::message_of;
using test::TempFolder;
using test::TestPart;

const Autosave::Clock::time_point start{1000s};

void change(Workspace& workspace, const std::string& title) {
    workspace.document.edit<TestPart>("arm").title = title;
}

std::string saved_title(const std::filesystem::path& file) {
    return read_json_file(file)["labs"]["arm"]["title"].get<std::string>();
}

/// The folder's files, without lock files.
std::vector<std::string> files(const TempFolder& folder) {
    std::vector<std::string> names = folder.names();
    std::erase_if(names, [](const std::string& name) { return name.ends_with(".lock"); });
    return names;
}

struct Autosaves : testing::Test {
    const TempFolder folder;
    Workspace workspace = test::make_workspace();
};

/// The ID of a process that has ended.
std::string dead_pid() {
    const pid_t pid = ::fork();
    if (pid == 0) ::_exit(0);
    ::waitpid(pid, nullptr, 0);
    return std::to_string(pid);
}

TEST_F(Autosaves, Writes30SecondsAfterTheFirstChange) {
    Autosave autosave(folder.path());
    autosave.update(workspace, start);
    change(workspace, "one");
    autosave.update(workspace, start + 1s);
    change(workspace, "two");
    autosave.update(workspace, start + 30s);
    EXPECT_TRUE(files(folder).empty());
    autosave.update(workspace, start + 31s);
    EXPECT_EQ(saved_title(autosave.file()), "two");

    change(workspace, "three");
    autosave.update(workspace, start + 40s);
    autosave.update(workspace, start + 69s);
    EXPECT_EQ(saved_title(autosave.file()), "two");
    autosave.update(workspace, start + 70s);
    EXPECT_EQ(saved_title(autosave.file()), "three");
}

TEST_F(Autosaves, WritesNothingWhileNothingChanges) {
    Autosave autosave(folder.path());
    for (int i = 0; i < 100; ++i) autosave.update(workspace, start + i * 10s);
    EXPECT_TRUE(files(folder).empty());

    change(workspace, "one");
    autosave.update(workspace, start + 2000s);
    autosave.update(workspace, start + 2030s);
    std::filesystem::remove(autosave.file());
    for (int i = 0; i < 100; ++i) autosave.update(workspace, start + 3000s + i * 10s);
    EXPECT_TRUE(files(folder).empty()) << "the same document once more";
}

TEST_F(Autosaves, RemovesItsFileOnceTheWorkIsSavedAndAtTheEnd) {
    {
        Autosave autosave(folder.path(), 0s);
        change(workspace, "one");
        autosave.update(workspace, start);
        EXPECT_EQ(files(folder).size(), 1u);
        save_scene_file(workspace, folder / "scene.json");
        autosave.update(workspace, start + 1s);
        EXPECT_EQ(files(folder), std::vector<std::string>{"scene.json"});
        change(workspace, "two");
        autosave.update(workspace, start + 2s);
        EXPECT_EQ(files(folder).size(), 2u);
        autosave.end(workspace, false);
    }
    EXPECT_EQ(files(folder), std::vector<std::string>{"scene.json"});
}

TEST_F(Autosaves, KeepsUnsavedWorkIfTheProgramIsTerminated) {
    std::filesystem::path file;
    {
        Autosave autosave(folder.path());
        change(workspace, "one");
        autosave.update(workspace, start);
        autosave.end(workspace, true);  // within the 30 s
        file = autosave.file();
        EXPECT_EQ(saved_title(file), "one");
    }
    EXPECT_TRUE(std::filesystem::exists(file)) << "an exception ends no autosave either";
    Autosave autosave(folder.path());
    workspace.saved = workspace.document;
    autosave.end(workspace, true);
    EXPECT_FALSE(std::filesystem::exists(autosave.file())) << "there is nothing to keep";
}

TEST_F(Autosaves, CreatesItsFolderAndReportsOnceIfItCannot) {
    change(workspace, "one");
    {
        Autosave autosave(folder / "a" / "b", 0s);
        autosave.update(workspace, start);
        EXPECT_TRUE(std::filesystem::exists(autosave.file()));
        EXPECT_TRUE(workspace.ui.toasts.empty());
    }
    test::write(folder / "file", "");
    Autosave autosave(folder / "file", 0s);
    for (int i = 0; i < 5; ++i) {
        change(workspace, std::to_string(i));
        autosave.update(workspace, start + i * 1s);
    }
    ASSERT_EQ(workspace.ui.toasts.size(), 1u);
    EXPECT_TRUE(has(workspace.ui.toasts[0].text, "Autosave: "));
    EXPECT_EQ(workspace.ui.toasts[0].kind, ToastKind::Refusal);
}

TEST_F(Autosaves, OffersOnlyFilesOfEndedProgramsNewestFirst) {
    const std::string old_file = "autosave-" + dead_pid() + ".json",
                      new_file = "autosave-" + dead_pid() + ".json";
    const std::string aside = "autosave-" + std::to_string(::getpid()) + ".1.json";
    for (const std::string& name :
         {old_file, new_file, aside, "autosave-" + std::to_string(::getpid()) + ".json",
          std::string("autosave-1.json"), std::string("autosave-.json"), std::string("autosave-0.json"),
          std::string("autosave--5.json"), std::string("autosave-99999999999999999999.json"),
          std::string("autosave-12x.json"), std::string("autosave.json"), std::string("settings.json"),
          "autosave-" + dead_pid() + ".json.bak"})
        test::write(folder / name, "{}");
    // IDs of running processes, ours and process 1, which always runs: only the lock matters.
    const auto ours = FileLock::take(folder / ("autosave-" + std::to_string(::getpid()) + ".lock"));
    const auto first = FileLock::take(folder / "autosave-1.lock");
    ASSERT_TRUE(ours && first);
    std::filesystem::create_directory(folder / ("autosave-" + dead_pid() + ".json"));
    const auto now = std::filesystem::file_time_type::clock::now();
    std::filesystem::last_write_time(folder / old_file, now - 2h);
    std::filesystem::last_write_time(folder / new_file, now - 1h);
    EXPECT_EQ(Autosave::left_behind(folder.path()),
              (std::vector<std::filesystem::path>{folder / new_file, folder / old_file}));
    EXPECT_TRUE(Autosave::left_behind(folder / "missing").empty());
    EXPECT_TRUE(Autosave::left_behind("").empty());
}

TEST_F(Autosaves, AFileIsOfferedEvenIfItsProcessIdIsReused) {
    const auto reused = folder / "autosave-1.json";  // process 1 runs everywhere
    test::write(reused, "{}");
    test::write(folder / "autosave-1.lock", "");  // left by a crash, held by nobody
    EXPECT_EQ(Autosave::left_behind(folder.path()), std::vector{reused});
}

/// Two containers share a folder, and both programs have process ID 7.
TEST_F(Autosaves, TwoProgramsWithTheSameIdWriteTwoFiles) {
    Autosave first(folder.path(), 0s);
    change(workspace, "first");
    first.update(workspace, start);
    first.update(workspace, start + 1s);
    const auto file = first.file();
    ASSERT_EQ(saved_title(file), "first");
    {
        Autosave second(folder.path(), 0s);
        EXPECT_NE(second.file(), file);
        change(workspace, "second");
        second.update(workspace, start);
        second.update(workspace, start + 1s);
        EXPECT_EQ(saved_title(second.file()), "second");
        EXPECT_EQ(saved_title(file), "first");
        EXPECT_TRUE(Autosave::left_behind(folder.path()).empty());
    }
    EXPECT_EQ(Autosave::left_behind(folder.path()).size(), 1u) << "the second one's, which has ended";
}

TEST_F(Autosaves, RemovesFilesLeftByKilledPrograms) {
    const AtomicFile being_written(folder / "picture.png");
    const auto held = FileLock::take(folder / "autosave-2.lock");
    for (const char* name : {".tendril-1-0.tmp", "mine.tmp", "autosave-1.lock", "autosave-1.json"})
        test::write(folder / name, "half");
    const Autosave autosave(folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder / ".tendril-1-0.tmp"));
    EXPECT_FALSE(std::filesystem::exists(folder / "autosave-1.lock"));
    EXPECT_TRUE(std::filesystem::exists(being_written.beside()));
    for (const char* name : {"mine.tmp", "autosave-2.lock", "autosave-1.json"})
        EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
}

TEST_F(Autosaves, FindsAndRecoversTheFileOfAKilledProgram) {
    const pid_t victim = ::fork();
    if (victim == 0) {
        workspace.path = "/elsewhere/scene.json";
        change(workspace, "precious");
        Autosave autosave(folder.path(), 0s);
        autosave.update(workspace, start);
        ::_exit(1);  // no destructor runs
    }
    ::waitpid(victim, nullptr, 0);

    const auto files = Autosave::left_behind(folder.path());
    ASSERT_EQ(files.size(), 1u);
    EXPECT_TRUE(Autosave::title(files[0]).starts_with("scene.json, 20")) << Autosave::title(files[0]);
    EXPECT_TRUE(Autosave::title(folder / "none.json").starts_with("Unnamed scene"));
    Autosave::recover(workspace, files[0]);
    EXPECT_EQ(workspace.document.get<TestPart>("arm").title, "precious");
    EXPECT_EQ(workspace.path, "/elsewhere/scene.json");
    EXPECT_TRUE(workspace.modified());
    EXPECT_TRUE(std::filesystem::exists(workspace.recovered));
}

/// In a container, every start of the program may have the same process ID.
TEST_F(Autosaves, DoesNotOverwriteTheFileOfAProgramWithTheSameId) {
    for (const char* title : {"first crash", "second crash"}) {
        Autosave autosave(folder.path(), 0s);
        change(workspace, title);
        autosave.update(workspace, start);
    }
    const auto files = Autosave::left_behind(folder.path());
    ASSERT_EQ(files.size(), 2u);
    EXPECT_NE(saved_title(files[0]), saved_title(files[1]));
}

/// Two crashes left A and B; both are recovered, one after the other, and one of them is saved.
class RecoveredTwo : public testing::Test {
  protected:
    RecoveredTwo() {
        for (const char* title : {"A", "B"}) {
            Workspace lost = test::make_workspace();
            change(lost, title);
            test::write(folder_ / ("autosave-" + dead_pid() + ".json"), json_to_text(save_scene(lost)));
        }
        add_workspace_commands(table_);
        autosave_.emplace(folder_.path(), 0s);
        for (const char* title : {"A", "B"})
            for (const auto& file : Autosave::left_behind(folder_.path()))
                if (saved_title(file) == title) {
                    workspace_.ui.recoverable = {{file, title}};
                    run("scene.recover", {{"path", file.string()}});
                }
    }
    void run(const char* command, const Json& arguments = Json::object()) {
        table_.run(workspace_, command, arguments);
        for (int i = 0; i < 2; ++i) autosave_->update(workspace_, now_ += 1s);
    }
    /// The files that the next start would offer if the program were killed now; sorted.
    std::vector<std::string> on_disk() {
        std::vector<std::string> titles;
        for (const auto& each : std::filesystem::directory_iterator(folder_.path()))
            if (each.path().filename().string().starts_with("autosave-") &&
                each.path().extension() == ".json")
                titles.push_back(saved_title(each.path()));
        std::ranges::sort(titles);
        return titles;
    }
    const TempFolder folder_;
    Workspace workspace_ = test::make_workspace();
    CommandTable table_;
    std::optional<Autosave> autosave_;
    Autosave::Clock::time_point now_ = start;
};

TEST_F(RecoveredTwo, AreBothOnDiskUntilEachIsSaved) {
    using Titles = std::vector<std::string>;
    EXPECT_EQ(workspace_.document.get<TestPart>("arm").title, "B");
    EXPECT_EQ(on_disk(), (Titles{"A", "B"}));
    EXPECT_TRUE(Autosave::left_behind(folder_.path()).empty()) << "another program must not offer them";
    change(workspace_, "B edited");
    autosave_->update(workspace_, now_ += 1s);
    autosave_->update(workspace_, now_ += 1s);
    EXPECT_EQ(on_disk(), (Titles{"A", "B edited"}));
    run("undo");
    EXPECT_EQ(workspace_.document.get<TestPart>("arm").title, "A");
    EXPECT_EQ(on_disk(), (Titles{"A", "B edited"}));
    run("scene.save", {{"path", (folder_ / "a.json").string()}});
    EXPECT_EQ(on_disk(), Titles{"B edited"});
    run("redo");
    run("scene.save", {{"path", (folder_ / "b.json").string()}});
    autosave_->end(workspace_, false);
    EXPECT_EQ(on_disk(), Titles{});
}

/// The other labs' work is recovered, and the file keeps the part that could not be read.
TEST_F(Autosaves, RecoversTheOtherLabsIfOneCannotBeRead) {
    change(workspace, "precious");
    Json scene = save_scene(workspace);
    scene["labs"]["rope"]["target"] = "nowhere";
    test::write(folder / "autosave-1.json", json_to_text(scene));
    Workspace again = test::make_workspace();
    Autosave::recover(again, folder / "autosave-1.json");
    EXPECT_EQ(again.document.get<TestPart>("arm").title, "precious");
    ASSERT_FALSE(again.ui.toasts.empty());
    EXPECT_TRUE(has(again.ui.toasts.back().text, "labs.rope.target"));
    EXPECT_EQ(save_scene(again)["labs"], scene["labs"]);
}

TEST_F(Autosaves, ABrokenFileIsRefusedAndChangesNothing) {
    for (const char* text :
         {"", "{", "[]", R"({"tendril_scene": 1, "labs": {}, "path": 3})", R"({"tendril_scene": 3})"}) {
        test::write(folder / "autosave-1.json", text);
        EXPECT_NE(message_of([&] { Autosave::recover(workspace, folder / "autosave-1.json"); }), "") << text;
        EXPECT_FALSE(workspace.modified());
        EXPECT_EQ(workspace.path, "");
    }
}

}  // namespace
}  // namespace tendril::app
