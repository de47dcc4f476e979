// The command line: --help and lists; errors are one line with exit code 2, and nothing is overwritten.
#include "tests/app/support/play.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

class CommandLine : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    TempFolder folder_;
};

TEST_F(CommandLine, PrintsTheRequestedLists) {
    for (const char* flag : {"--list-commands", "--list-labs", "--list-shortcuts", "--version", "--help"}) {
        const Outcome outcome = run_program({flag}, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
        EXPECT_TRUE(succeeded(outcome)) << flag;
        EXPECT_FALSE(outcome.out.empty()) << flag;
    }
    EXPECT_EQ(run_program({"--list-labs"}).out, "chain\nrope\nsignal\nrig\nhumanoid\nlinkage\n");
    EXPECT_TRUE(run_program({"--version"}).out.starts_with("tendril "));
}

TEST_F(CommandLine, HelpNamesEveryFlag) {
    const std::string help = run_program({"--help"}).out;
    for (const char* flag :
         {"SCENE", "--lab", "--size", "--headless", "--backend", "--script", "--frames", "--screenshot",
          "--state", "--record", "--force", "--no-config", "--list-labs", "--list-commands", "--version"})
        EXPECT_TRUE(has(help, flag));
}

TEST_F(CommandLine, ListsTheChainCommandsWithExactlyTheseArguments) {
    const std::string list = run_program({"--list-commands"}).out;
    for (const char* usage :
         {"chain.clear [default_direction]", "chain.mode mode [index] [iterations] [tolerance]",
          "chain.set_length length [index] [joints]", "undo [ask]", "scene.open path", "time.step"})
        EXPECT_TRUE(has("\n" + list, std::string("\n") + usage + "\n"));
}

// The README's tables and the program's shortcuts must be the same text.
TEST_F(CommandLine, TheReadmeHasTheShortcuts) {
    const fs::path readme = source_path("app/README.md");
    ASSERT_TRUE(fs::exists(readme));
    const std::string text = read(readme), begin = "<!-- shortcuts -->\n", end = "<!-- /shortcuts -->";
    const auto from = text.find(begin), to = text.find(end);
    ASSERT_NE(from, text.npos) << "app/README.md has no line " << begin;
    ASSERT_NE(to, text.npos) << "app/README.md has no line " << end;
    std::string found = text.substr(from + begin.size(), to - from - begin.size());
    std::string expected = run_program({"--list-shortcuts"}).out;
    const auto trim = [](std::string& s) {
        while (!s.empty() && s.front() == '\n') s.erase(0, 1);
        while (!s.empty() && s.back() == '\n') s.pop_back();
    };
    trim(found);
    trim(expected);
    EXPECT_EQ(found, expected) << "tendril --list-shortcuts prints what belongs there";
}

struct Mistake {
    const char* name;
    Strings arguments;
    Strings told;  ///< parts of the message
};

class Mistakes : public testing::TestWithParam<Mistake> {};

TEST_P(Mistakes, AreOneLineAndExitCode2) {
    const TempFolder folder;
    const std::pair<const char*, const char*> olds[]{{"state.json", R"({"layout": {"strip": {}}})"},
                                                     {"picture.png", "\x89PNG\r\n\x1a\nold"},
                                                     {"record.jsonl", R"({"recording":1})"}};
    for (const auto& [name, old] : olds) write(folder / name, old);
    Strings arguments{"--force",
                      "--state",
                      (folder / "state.json").string(),
                      "--screenshot",
                      (folder / "picture.png").string(),
                      "--record",
                      (folder / "record.jsonl").string()};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const Outcome outcome = run_program(arguments, {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
    EXPECT_TRUE(complained(outcome, 2, GetParam().told));
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    for (const auto& [name, old] : olds) EXPECT_EQ(read(folder / name), old) << name;
    EXPECT_EQ(folder.names().size(), 3u);
}

INSTANTIATE_TEST_SUITE_P(
    All, Mistakes,
    testing::Values(
        Mistake{"size_zero", {"--headless", "--size", "0x0"}, {"--size", "0x0"}},
        Mistake{"size_negative", {"--headless", "--size", "-5x10"}, {"--size"}},
        Mistake{"size_no_number", {"--headless", "--size", "wide"}, {"--size", "wide"}},
        Mistake{"size_trailing", {"--headless", "--size", "800x600x2"}, {"--size"}},
        Mistake{"size_huge", {"--headless", "--size", "99999x99999"}, {"--size"}},
        Mistake{"flag", {"--headless", "--no-such-flag"}, {"--no-such-flag"}},
        Mistake{"second_scene", {"--headless", "a.json", "b.json"}, {"b.json"}},
        Mistake{"lab", {"--headless", "--lab", "kitchen"}, {"lab", "kitchen"}},
        Mistake{"backend", {"--headless", "--backend", "crayon"}, {"--backend", "crayon"}},
        Mistake{"backend_with_window", {"--headless", "--backend", "glfw"}, {"glfw"}},
        Mistake{"frames_negative", {"--headless", "--frames", "-1"}, {"--frames"}},
        Mistake{"no_script", {"--headless", "--script", "/no/such/script.jsonl"}, {"/no/such/script.jsonl"}},
        Mistake{"script_is_folder", {"--headless", "--script", "/"}, {"/"}},
        Mistake{"no_scene", {"--headless", "/no/such/scene.json"}, {"/no/such/scene.json"}},
        Mistake{"no_display", {}, {"no display"}}),
    [](const auto& mistake) { return mistake.param.name; });

TEST_F(CommandLine, WithoutADisplayTheMessageSaysWhatHelps) {
    EXPECT_TRUE(complained(run_program({}, {{"DISPLAY", ":9731"}, {"WAYLAND_DISPLAY", {}}}), 2, {"display"}));
}

TEST_F(CommandLine, APathThatCannotBeWrittenIsRefusedBeforeAnythingRuns) {
    fs::create_directory(folder_ / "folder");
    write(folder_ / "file", "a file is no folder");
    write(folder_ / "script.jsonl", ScriptText().line({{"state", path("ran.json")}}).text());
    for (const char* flag : {"--state", "--screenshot", "--record"})
        for (const std::string& target :
             {path("missing/out"), path("folder"), path("file/out"), std::string("/proc/out")}) {
            const Outcome outcome =
                run_program({"--headless", "--script", path("script.jsonl"), flag, target});
            EXPECT_TRUE(complained(outcome, 2, {target})) << flag;
        }
    EXPECT_FALSE(fs::exists(folder_ / "ran.json"));
    EXPECT_EQ(read(folder_ / "file"), "a file is no folder");
}

TEST_F(CommandLine, AnUnwritablePathInAScriptEndsItWith2) {
    for (const char* form : {"screenshot", "state"}) {
        const Outcome outcome = run_script(ScriptText().line({{form, path("missing/out")}}));
        EXPECT_TRUE(complained(outcome, 2, {path("missing/out")})) << form;
    }
}

/// Refuses inputs and other files as outputs, existing outputs without --force, and one file used twice.
TEST_F(CommandLine, NothingIsOverwrittenThatWouldBeLost) {
    const std::string png = path("a.png"), script = path("s.jsonl"), scene = path("scene.json");
    write(script, ScriptText().wait(1).text());
    ASSERT_TRUE(succeeded(run_here({"--headless", "--script", script, "--screenshot", png, "--record",
                                    path("r.jsonl"), "--state", path("state.json")})));
    write(scene, R"({"tendril_scene": 2, "labs": {}})");
    write(folder_ / "diary.txt", "Dear diary");
    fs::create_symlink(script, folder_ / "link.png");
    struct Case {
        Strings arguments;
        const char* told;
        bool forced = false;  ///< --force helps
    };
    const std::vector<Case> cases{{{"--screenshot", script}, "in use as input"},
                                  {{"--screenshot", path("link.png")}, "in use as input"},
                                  {{"--record", script}, "in use as input"},
                                  {{"--state", scene}, "is not a state"},
                                  {{"--record", scene}, "is not a recording"},
                                  {{"--screenshot", path("diary.txt")}, "is not a PNG"},
                                  {{"--screenshot", path("new"), "--state", path("new")}, "two outputs"},
                                  {{"--record", path("r.jsonl")}, "already exists; --force", true},
                                  {{"--screenshot", png, "--state", path("state.json")}, nullptr, true}};
    for (const Case& each : cases)
        for (const bool force : {false, true}) {
            std::map<std::string, std::string> before;
            for (const std::string& name : folder_.names()) before[name] = read(folder_ / name);
            Strings arguments{"--headless", "--script", script};
            arguments.insert(arguments.end(), each.arguments.begin(), each.arguments.end());
            if (force) arguments.push_back("--force");
            const Outcome outcome = run_here(arguments);
            if (each.told == nullptr || (force && each.forced)) {
                EXPECT_TRUE(succeeded(outcome));
                continue;
            }
            EXPECT_TRUE(complained(outcome, 2, {each.told}));
            for (const auto& [name, bytes] : before) EXPECT_EQ(read(folder_ / name), bytes) << name;
            EXPECT_EQ(folder_.names().size(), before.size());
        }
}

/// Commands in scripts, too.
TEST_F(CommandLine, CommandsOfScriptsAskForForce) {
    write(folder_ / "b.json", R"({"tendril_scene": 2, "labs": {}})");
    write(folder_ / "walk.glb", "glTF");
    for (const char* name : {"b.json", "walk.glb"}) {
        const std::string old = read(folder_ / name);
        ScriptText script;
        script.command("chain.add", {{"length", 0.5}}).command("scene.save", {{"path", path("own.json")}});
        script.command("chain.add", {{"length", 0.5}}).command("scene.save", {{"path", path("own.json")}});
        script.command("scene.save", {{"path", path(name)}});
        write(folder_ / "s.jsonl", script.text());
        fs::remove(folder_ / "own.json");
        EXPECT_TRUE(complained(run_here({"--headless", "--script", path("s.jsonl")}), 1, {"line 5", name}));
        EXPECT_EQ(read(folder_ / name), old);
        fs::remove(folder_ / "own.json");
        const Outcome forced = run_here({"--headless", "--force", "--script", path("s.jsonl")});
        EXPECT_EQ(forced.exit_code, std::string_view(name) == "b.json" ? 0 : 1) << forced.err;
    }
    EXPECT_EQ(read(folder_ / "walk.glb"), "glTF");
    EXPECT_NE(read(folder_ / "b.json").find("0.5"), std::string::npos);
}

TEST_F(CommandLine, AFullDiskIsReportedByEverythingThatPrints) {
    write(folder_ / "cases.json", R"([{"lengths": [1, 1], "target": [1, 1, 0]}])");
    write(folder_ / "filter.json", R"({"kind": "spring"})");
    write(folder_ / "samples.csv", "dt,input\n0.1,1\n");
    write(folder_ / "trace.jsonl", "{\"joints\": [[0,0,0],[1,0,0]]}\n{\"joints\": [[0,0,0],[1,0,0]]}\n");
    write(folder_ / "scene.json", R"({"tendril_scene": 2, "labs": {}})");
    const std::string bvh = source_path("tests/app/golden/a_pose.bvh");
    for (const std::string& arguments :
         {std::string("--list-commands"), std::string("--list-labs"), std::string("--list-shortcuts"),
          std::string("--version"), std::string("--help"), std::string("solve --help"),
          "solve " + path("cases.json"), "signal " + path("filter.json") + " " + path("samples.csv"),
          "trace " + path("trace.jsonl"), "code " + path("scene.json"), "lint " + bvh,
          "bake " + bvh + " --out " + path("out.bvh") + " --force"}) {
        const std::string line = program_command({}).front() + " " + arguments;
        const Outcome printed = Process({"sh", "-c", line}).wait();
        EXPECT_LE(printed.exit_code, 1) << arguments << ": " << printed.err;
        EXPECT_TRUE(complained(Process({"sh", "-c", line + " > /dev/full"}).wait(), 2, {"No space left"}))
            << arguments;
    }
}

TEST_F(CommandLine, FramesAreTicks) {
    write(folder_ / "script.jsonl", ScriptText().command("chain.motion", {{"path", "circle"}}).text());
    const Outcome outcome = run_program(
        {"--headless", "--script", path("script.jsonl"), "--frames", "25", "--state", path("state.json")});
    EXPECT_TRUE(succeeded(outcome));
    EXPECT_EQ(app::parse_json(read(folder_ / "state.json"))["time"]["tick"], 25);
}

TEST_F(CommandLine, HeadlessNeitherReadsNorWritesSettings) {
    fs::create_directory(folder_ / "tendril");
    write(folder_ / "tendril/settings.json", R"({"theme": "light", "left_open": false})");
    const Environment config{{"XDG_CONFIG_HOME", folder_.path().string()}};
    write(folder_ / "script.jsonl", ScriptText().key("l").wait(2).text());
    const Strings arguments{"--headless", "--script", path("script.jsonl"), "--screenshot"};
    const auto with = [&](const std::string& name) {
        Strings all = arguments;
        all.push_back(path(name));
        return all;
    };
    EXPECT_TRUE(succeeded(run_program(with("configured.png"), config)));
    EXPECT_TRUE(succeeded(run_program(with("plain.png"))));
    EXPECT_TRUE(read(folder_ / "configured.png") == read(folder_ / "plain.png"));
    EXPECT_EQ(read(folder_ / "tendril/settings.json"), R"({"theme": "light", "left_open": false})");
}

// app/run with mock tools: its output while it installs and builds.

namespace fs = std::filesystem;

/// A copy of the scripts beside a mock cmake, apt and program that only print what they would do.
class RunScript : public testing::Test {
  protected:
    RunScript() {
        const fs::path source(source_path(""));
        for (const char* file : {"app/run", "third_party/install", "third_party/progress"}) {
            fs::create_directories((folder_ / file).parent_path());
            fs::copy_file(source / file, folder_ / file);
        }
        write(folder_ / "third_party/packages-debian.txt", "# build\nlibmissing-dev\n");
        tool("build/default/app/tendril", "echo \"started with $*\"");
        tool("bin/dpkg-query", "exit 1");
        tool("bin/sudo", "\"$@\"");
        tool("bin/id", "echo 1000");
        tool("bin/apt-get",
             "case $* in *install*) echo pmstatus:libmissing-dev:40.0:Unpacking; echo Setting up; esac");
    }

    void tool(const std::string& name, const std::string& body) {
        fs::create_directories((folder_ / name).parent_path());
        write(folder_ / name, "#!/usr/bin/env bash\n" + body + "\n");
        fs::permissions(folder_ / name, fs::perms::owner_all);
    }
    /// The output of `cmake --build`; configuring prints nothing.
    void build_says(const std::string& lines) {
        tool("bin/cmake", "case $1 in --build) " + lines + " ;; esac");
    }
    Outcome run(std::vector<std::string> before = {}) {
        before.insert(before.end(), {(folder_ / "app/run").string(), "--frames", "3"});
        const std::string path = (folder_ / "bin").string() + ":" + std::getenv("PATH");
        return Process(before, {{"PATH", path}}).wait();
    }

    TempFolder folder_;
};

TEST_F(RunScript, CountsWhatItInstallsAndBuildsAndThenStartsTheProgram) {
    build_says("for i in $(seq 40); do echo \"[$i/40] Building CXX object $i.o\"; done");
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "started with --frames 3\n") << "stdout is the program's";
    EXPECT_NE(outcome.err.find("Installing: libmissing-dev\n"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("Installing: 70 %\n"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("Building 40 of 40\n"), std::string::npos) << outcome.err;
    EXPECT_LE(count_lines(outcome.err), 15) << "off a terminal a line stands for a tenth:\n" << outcome.err;
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "lines are written over on terminals alone";
}

TEST_F(RunScript, OnATerminalTheCountIsUpdatedInPlace) {
    build_says("for i in 1 2 3; do echo \"[$i/3] Building CXX object $i.o\"; done");
    // script (util-linux) provides a terminal.
    const Outcome outcome = Process({"script", "-qec", (folder_ / "app/run").string(), "/dev/null"},
                                    {{"PATH", (folder_ / "bin").string() + ":" + std::getenv("PATH")}})
                                .wait();
    for (const char* step : {"\r\033[KBuilding 1 of 3", "\r\033[KBuilding 2 of 3", "\r\033[KBuilding 3 of 3"})
        EXPECT_NE(outcome.out.find(step), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("3 of 3\r\033[Kstarted"), std::string::npos)
        << "the line is gone once it is through:\n"
        << outcome.out;
}

TEST_F(RunScript, PrintsNothingIfNothingIsToBeDone) {
    tool("bin/dpkg-query", "echo installed");
    build_says("echo 'ninja: no work to do.'");
    EXPECT_TRUE(succeeded(run()));
}

TEST_F(RunScript, ShowsAnErrorOfTheBuildWhole) {
    build_says("echo '[1/2] Building a.o'; echo 'FAILED: b.o'; echo 'b.cpp:3: error: no'; exit 1");
    const Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "") << "what did not build is not started";
    EXPECT_NE(outcome.err.find("FAILED: b.o\nb.cpp:3: error: no\n"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("Building a.o"), std::string::npos) << outcome.err;
}

TEST_F(RunScript, ShowsWhyItCouldNotConfigureOrInstall) {
    tool("bin/cmake", "echo 'Tendril needs GLM'; exit 1");
    Outcome outcome = run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("Tendril needs GLM\n"), std::string::npos) << outcome.err;

    tool("bin/apt-get", "case $* in *install*) echo 'E: Unable to locate package' >&2; exit 100; esac");
    outcome = run();
    EXPECT_NE(outcome.exit_code, 0);
    EXPECT_TRUE(says(outcome.err, "E: Unable to locate package"));
    EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace tendril::test
