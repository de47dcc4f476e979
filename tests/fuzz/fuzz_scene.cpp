// A scene is refused with a std::runtime_error and changes nothing, or is loaded completely: it saves and
// loads unchanged, and its labs can show it and advance it.
//
// Starts with the labs' own scenes (tests/app/data/test_scenes.json) that are small enough.
#include <fstream>

#include "app/document/command.hpp"
#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "tests/app/support/full_scenes.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril::app;
using tendril::fuzz::check;

namespace {

/// Slow scenes are shown but not advanced: a fuzzer should go through many scenes instead.
constexpr std::uint64_t max_work = 20'000;
constexpr std::size_t max_bytes = 8192;  ///< of an initial scene

struct Fixture {
    Labs labs;
    CommandTable commands = make_command_table(labs);
    Workspace blank = make_blank_workspace(labs);
    Json saved;

    /// Clears the labs that can be cleared: members that a scene omits are still written and read.
    Fixture() {
        for (const auto& lab : labs.all())
            if (commands.find(lab->name() + ".clear") != nullptr)
                commands.run(blank, lab->name() + ".clear", to_json({}));
        blank.history.clear();
        saved = save_scene(blank);
    }
};

const Fixture& fixture() {
    static const Fixture fixture;
    return fixture;
}

}  // namespace

void tendril::fuzz::write_scenes(const std::filesystem::path& folder) {
    const Fixture& with = fixture();
    for (const auto& lab : with.labs.all())
        for (const tendril::test::TestScene& scene : tendril::test::test_scenes(*lab)) {
            Workspace workspace = with.blank;
            workspace.document.set(lab->name(), lab->blank());
            for (const CommandCall& command : scene.commands)
                with.commands.run(workspace, command.name, to_json(command.arguments));
            const std::string text = save_scene(workspace).dump();
            if (text.size() <= max_bytes)
                std::ofstream(folder / (lab->name() + "_" + scene.name + ".json")) << text;
        }
}

FUZZ_TARGET(scene) {
    const Fixture& with = fixture();
    Workspace workspace = with.blank;
    try {
        load_scene(workspace, parse_json(text));
    } catch (const std::runtime_error&) {
        check(workspace.document == with.blank.document, "a refused scene leaves the document");
        check(save_scene(workspace) == with.saved, "a refused scene leaves everything");
        return;
    }
    const Json saved = save_scene(workspace);
    Workspace again = with.blank;
    load_scene(again, parse_json(saved.dump()));
    check(save_scene(again) == saved, "a saved scene loads to the same");

    for (const auto& lab : with.labs.all()) {
        lab->state(workspace);
        lab->handles(workspace);
        lab->bounds(workspace, false);
        for (int tick = 0; tick < 2 && lab->tick_work(workspace) <= max_work; ++tick) lab->step(workspace);
    }
    load_scene(again, save_scene(workspace));  // it opens again after some time
}
