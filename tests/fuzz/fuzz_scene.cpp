// A scene is refused by a std::runtime_error and changes nothing, or it is loaded whole: it saves and loads
// back to the same, and its labs can show it and let time pass.
#include "app/document/json_complete.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"
#include "app/labs/rope/rope_part.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril::app;
using tendril::fuzz::check;

/// Ropes may be asked to be solved as thoroughly as takes minutes; a fuzzer need not wait for it.
bool quick(const Workspace& workspace) {
    const tendril::rope::State& state = rope_part(workspace).world->state();
    const double passes = tick_seconds / state.settings.substep * state.settings.iterations;
    return passes * static_cast<double>(state.links.size() + state.position.size()) *
               static_cast<double>(1 + state.colliders.size()) <
           1e7;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Labs labs;
    static const Workspace blank = make_blank_workspace(labs);
    static const std::string blank_text = json_to_text(save_scene(blank));

    Workspace workspace = blank;
    try {
        load_scene(workspace, parse_json(tendril::fuzz::text_of(data, size)));
    } catch (const std::runtime_error&) {
        check(workspace.document == blank.document, "a refused scene leaves the document");
        check(json_to_text(save_scene(workspace)) == blank_text, "a refused scene leaves everything");
        return 0;
    }
    const std::string saved = json_to_text(save_scene(workspace));
    Workspace again = blank;
    load_scene(again, parse_json(saved));
    check(json_to_text(save_scene(again)) == saved, "a saved scene loads to the same");

    for (const auto& lab : labs.all()) {
        lab->state(workspace);
        lab->handles(workspace);
        lab->bounds(workspace, false);
        for (int tick = 0; tick < 3 && quick(workspace); ++tick) lab->step(workspace);
    }
    load_scene(again, save_scene(workspace));  // what time has made of it opens again
    return 0;
}
