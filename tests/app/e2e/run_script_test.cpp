// app/run with mock tools: its output while it installs and builds.
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

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
