// Memory in a long session is bounded: undo and the last ten seconds account for all of it.
#include <malloc.h>

#include "app/labs/humanoid/humanoid_part.hpp"
#include "tests/app/e2e/monkey.hpp"
#include "tests/app/labs/lab_support.hpp"
#include "tests/app/support/full_scenes.hpp"

namespace tendril::test {
namespace {

using namespace app;

std::size_t heap_bytes() {
    const auto used = mallinfo2();
    return used.uordblks + used.hblkhd;
}

std::size_t counted_bytes(const Workspace& workspace) {
    std::size_t bytes = workspace.history.bytes() + workspace.rewind.bytes();
    for (const auto& [lab, past] : workspace.pasts) bytes += past.rewind.bytes();
    return bytes + (workspace.discarded ? workspace.discarded->rewind.bytes() : 0);
}

class CharacterMemory : public LabTest {
  protected:
    CharacterMemory() : LabTest(humanoid_lab) {}
};

/// Changing the unit creates a new character with all its keys.
TEST_F(CharacterMemory, UndoStaysWithinItsLimit) {
    constexpr std::size_t bound = 8u << 20;
    run("humanoid.load", {{"path", source_path("tests/app/golden/antennae.bvh")}});
    workspace.history = History(1000, bound);
    const std::size_t before = heap_bytes();
    for (int i = 0; i < 400; ++i) run("humanoid.scale", {{"metres", i % 2 == 0 ? 0.01 : 0.0254}});
    EXPECT_LT(heap_bytes(), before + 2 * bound);
}

/// A character that all moments share is counted by undo, not once more for each moment.
TEST_F(CharacterMemory, ThePastStoresOnlyTheMovingPart) {
    run("humanoid.load", {{"path", source_path("tests/app/golden/antennae.bvh")}});
    const auto part = [&] { return workspace.document.parts().at(humanoid_lab); };
    const std::size_t all = part()->bytes(), moving = all - part()->shared_bytes(*part());
    ASSERT_GT(all, 2 * moving);
    Rewind past(1u << 30);
    for (std::uint64_t tick = 0; tick < 600; ++tick) {
        workspace.document.edit<HumanoidPart>(humanoid_lab).view.ghost ^= true;
        past.remember(tick, tick, part());
    }
    EXPECT_LE(past.bytes(), 600 * moving + all);
}

TEST(Memory, OfRandomCommandsInEveryLabIsCounted) {
    constexpr std::size_t rest = 40u << 20;  // solvers, GPU buffers, glyphs, and what Dear ImGui remembers
    const TempFolder folder;
    const WorkingIn inside(folder);
    const auto window = open_offscreen({640, 480});
    App app(*window);
    const std::size_t before = heap_bytes();
    unsigned seed = 0;
    for (const auto& lab : app.labs().all()) {
        const TestScene scene = test_scenes(*lab).back();
        app.run({"lab.open", Json{{"name", lab->name()}}});
        for (const CommandCall& command : scene.commands) app.run({command.name, to_json(command.arguments)});
        CommandTable table;
        lab->add_commands(table);
        std::vector<std::string> names{"time.step", "time.play", "time.seek", "undo", "redo"};
        for (const Command& command : table.all()) names.push_back(command.name);
        Monkey monkey(app, ++seed, names, scene.words);
        for (int i = 0; i < 100; ++i) {
            monkey.command();
            app.tick(nullptr);
        }
        EXPECT_LT(heap_bytes(), before + 2 * counted_bytes(app.workspace()) + rest) << lab->name();
    }
}

}  // namespace
}  // namespace tendril::test
