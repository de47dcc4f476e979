#include "app/labs/chain/command_support.hpp"

#include <algorithm>

#include "app/labs/chain/chain_runtime.hpp"
#include "app/labs/chain/commands.hpp"
#include "app/labs/kit/index_list.hpp"
#include "app/labs/kit/part_command.hpp"

namespace tendril::app {

Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainSolve change, Effect effect) {
    return {.name = name,
            .title = title,
            .arguments = std::move(arguments),
            .help = help,
            .effect = effect,
            .apply = [change, effect](Workspace& workspace, const Arguments& given) {
                ChainRuntime& runtime = workspace.runtimes.of<ChainRuntime>(chain_lab);
                change_part<ChainPart>(workspace, chain_lab, [&](ChainPart& part, const ChainPart&) {
                    part.study.gesture_begins = workspace.gesture_begins;
                    change(part, given, runtime);
                    // What is studied is always the solve that the chain shows.
                    if (part.study.open() && effect == Effect::Edit) reach_for(part, part.target, runtime);
                    check_range(part);
                    keep_step(part, runtime);
                });
            }};
}

Command chain_command(const char* name, const char* title, std::vector<Argument> arguments, const char* help,
                      ChainChange change, Effect effect) {
    return chain_command(
        name, title, std::move(arguments), help,
        ChainSolve([change](ChainPart& part, const Arguments& given, ChainRuntime&) { change(part, given); }),
        effect);
}

Argument index_argument(bool required, const char* help) {
    return offering(index_argument("index", required, help, max_segments), [](const Workspace& w) {
        return places(w.document.get<ChainPart>(chain_lab).chain.size());
    });
}

std::size_t index_of(const Arguments& given) {
    return static_cast<std::size_t>(given.integer("index"));
}

void check_index(const ChainPart& part, std::size_t index) {
    if (index >= part.chain.size()) {
        throw Refused("index " + std::to_string(index) + " is out of range, the chain has " +
                      std::to_string(part.chain.size()) + " segments");
    }
}

Argument joints_argument() {
    return index_list_argument("joints", "index");
}

std::vector<std::size_t> joints_of(const Arguments& given, const ChainPart& part) {
    if (!gives_one(given, "index", "joints")) return index_list(given, "joints", part.chain.size());
    const std::size_t index = index_of(given);
    check_index(part, index);
    return {index};
}

std::vector<std::size_t> joints_to_set(const Arguments& given, const ChainPart& part) {
    std::vector<std::size_t> joints = joints_of(given, part);
    if (joints.empty()) throw Refused("joints is empty");
    std::sort(joints.begin(), joints.end());
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    return joints;
}

void add_chain_commands(CommandTable& table) {
    add_shape_commands(table);
    add_mode_commands(table);
    add_reach_commands(table);
    add_study_commands(table);
    add_copy_commands(table);
}

}  // namespace tendril::app
