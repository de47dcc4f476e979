// A scene is refused by a std::runtime_error and changes nothing, or it is loaded whole: it saves and loads
// back to the same, and its labs can show it and let time pass.
//
// It begins with the labs' own scenes (Lab::test_scenes), as far as they are small.
#include <filesystem>
#include <fstream>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril::app;
using tendril::fuzz::check;

namespace {

/// What takes long is shown, but no time passes in it: a fuzzer goes through many scenes instead.
constexpr std::uint64_t max_work = 20'000;
constexpr std::size_t max_bytes = 8192;  ///< of a scene to begin with

struct Fixture {
    Labs labs;
    CommandTable commands = make_command_table(labs);
    Workspace blank = make_blank_workspace(labs);
    Json saved;

    /// Labs that can be emptied are: what a scene does not mention is written and read all the same.
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

/// Puts the labs' scenes into the first folder that it is given, which takes what the fuzzer learns.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    std::filesystem::path folder;
    for (int i = 1; i < *count && folder.empty(); ++i)
        if (std::filesystem::is_directory((*arguments)[i])) folder = (*arguments)[i];
    if (folder.empty()) return 0;
    const Fixture& with = fixture();
    for (const auto& lab : with.labs.all())
        for (const TestScene& scene : lab->test_scenes()) {
            Workspace workspace = with.blank;
            workspace.document.set(lab->name(), lab->blank());
            for (const CommandCall& command : scene.commands)
                with.commands.run(workspace, command.name, to_json(command.arguments));
            const std::string text = save_scene(workspace).dump();
            if (text.size() <= max_bytes)
                std::ofstream(folder / (lab->name() + "_" + scene.name + ".json")) << text;
        }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Fixture& with = fixture();
    Workspace workspace = with.blank;
    try {
        load_scene(workspace, parse_json(tendril::fuzz::text_of(data, size)));
    } catch (const std::runtime_error&) {
        check(workspace.document == with.blank.document, "a refused scene leaves the document");
        check(save_scene(workspace) == with.saved, "a refused scene leaves everything");
        return 0;
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
    load_scene(again, save_scene(workspace));  // what time has made of it opens again
    return 0;
}
