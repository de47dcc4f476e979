#include "app/shell/unfold.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/document/json_complete.hpp"
#include "app/shell/shell.hpp"
#include "app/widgets/row_search.hpp"

namespace tendril::app {
namespace {

/// Unfolds the section of that title, if there is one, and the sections that hide a row of the command.
void unfold(const ShellFrame& frame, const std::string& title, const std::string& command,
            const Json& arguments, Emit& emit) {
    RowSearch search{.title = title, .command = command};
    for (const auto& [name, value] : arguments.items()) search.arguments.push_back(name);
    {
        const SearchWindow window(search);
        Emit unused;
        frame.lab.panel(frame.workspace, unused);
        search.inside.clear();
        frame.lab.inspector(frame.workspace, unused);
    }
    std::vector<std::string> unfolded;
    for (const std::string& section : search.found) {
        if (std::ranges::find(unfolded, section) != unfolded.end()) continue;
        unfolded.push_back(section);
        emit("view.fold", {{"section", section}, {"folded", false}});
    }
}

}  // namespace

void Unfolding::for_step(const ShellFrame& frame, const CardStep* step, Emit& emit) {
    if (std::exchange(step_, step) == step || step == nullptr || step->place == CardStep::Place::Handle)
        return;
    for (const CardLine& line : step->by)
        unfold(frame, step->place_name, line.command, *line.arguments, emit);
}

void Unfolding::for_command(const ShellFrame& frame, const Emitted& command, Emit& emit) {
    unfold(frame, "", command.name, *command.arguments, emit);
}

}  // namespace tendril::app
