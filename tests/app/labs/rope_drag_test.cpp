// Quasi-static drags in the Rope lab use the lab's own runtime, and no bit depends on it.
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/app/labs/rope_support.hpp"
#include "tests/places.hpp"

namespace tendril::app {
namespace {

namespace fs = std::filesystem;

class RopeDrag : public RopeTest {};

TEST_F(RopeDrag, DiscardingTheRuntimeChangesNoBitOfAPausedDrag) {
    std::vector<rope::State> ends;
    for (const bool thrown_away : {false, true}) {
        run("rope.preset", {{"name", "drape"}});
        wait(40);
        run("time.pause");
        for (int i = 0; i < 12; ++i) {
            if (thrown_away) workspace.runtimes.clear();
            const float by = 0.05f * static_cast<float>(i);
            run("rope.hold", {{"rope", "short 2"}, {"particle", 3}, {"at", {1.2f + by, 1.5f, 0.3f}}}, 7);
            if (thrown_away) workspace.runtimes.clear();
            run("rope.collider.move", {{"name", "ball"}, {"to", {-0.65f + by, 1.0f, 0.0f}}}, 8);
        }
        ends.push_back(world().state());
        run("time.play");
        wait(3);
        ends.push_back(world().state());
    }
    EXPECT_TRUE(ends[0] == ends[2]);
    EXPECT_TRUE(ends[1] == ends[3]) << "and time goes on the same";
}

/// A mouse drag moves a hundred times per second, so its workspace is created only once.
TEST_F(RopeDrag, OnlyRuntimesMakeAWorkspaceOfTheLibrarys) {
    const std::regex made(R"(rope::Workspace\s+\w+\s*[;{=(]|rope::Workspace\s*[({])");
    int found = 0;
    for (const auto& entry : fs::recursive_directory_iterator(tendril::test::source_path("app"))) {
        if (!entry.is_regular_file() || !entry.path().string().ends_with("pp")) continue;
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) {
            if (!std::regex_search(line, made) || line.find("say(") != line.npos) continue;  // exported code
            ++found;
            const auto file = entry.path().filename();
            EXPECT_TRUE(file == "rope_time.hpp" || file == "humanoid_runtime.hpp") << file << ": " << line;
        }
    }
    EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace tendril::app
