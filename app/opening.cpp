#include "app/opening.hpp"

#include <algorithm>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// Whether the user has already chosen the lab's setting that the command changes.
bool is_chosen(const Lab& lab, const Settings& settings, const std::string& command) {
    const std::vector<LabSetting> all = lab.all_settings();
    return std::any_of(all.begin(), all.end(), [&](const LabSetting& each) {
        return each.command == command && settings.choices.contains(each.key);
    });
}

}  // namespace

bool opens_alive(const SessionOptions& options) {
    return !options.headless && options.scene.empty() && options.script.empty() && options.lab.empty();
}

void open_alive(App& app) {
    Workspace& workspace = app.workspace();
    const std::string first = workspace.lab;
    const auto set_up = [&](const Lab& lab) {
        workspace.open_lab(lab.name());
        for (const CommandCall& call : lab.opening()) {
            if (is_chosen(lab, workspace.settings, call.name)) continue;
            app.commands().run(workspace, call.name, to_json(call.arguments));
        }
    };
    for (const auto& lab : app.labs().all())
        if (lab->name() != first) set_up(*lab);
    set_up(*app.labs().find(first));
    workspace.saved = workspace.document;
    workspace.history.clear();
    const auto cameras = workspace.cameras;
    workspace.start_anew();
    workspace.cameras = cameras;
    for (const auto& lab : app.labs().all()) workspace.openings.insert(lab->name());
}

void offer_cards(App& app) {
    Settings& settings = app.workspace().settings;
    for (const auto& lab : app.labs().all())
        if (!card_known(settings, lab->name())) show_card(settings, lab->name(), true);
}

}  // namespace tendril::app
