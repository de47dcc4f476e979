#include "app/labs/chain/command_support.hpp"

#include "app/labs/chain/commands.hpp"

namespace tendril::app {

Command chain_command(const char* name, std::vector<Argument> arguments, const char* help,
                      void (*change)(ChainPart&, const Arguments&), Effect effect) {
    return {.name = name,
            .arguments = std::move(arguments),
            .help = help,
            .effect = effect,
            .apply = [change](Workspace& workspace, const Arguments& given) {
                const Document before = workspace.document;
                ChainPart& part = workspace.document.edit<ChainPart>(chain_lab);
                change(part, given);
                check_range(part);
                // What changes nothing leaves no step to undo.
                if (same(part, before.get<ChainPart>(chain_lab))) {
                    workspace.document = before;
                    return;
                }
                part.study.refresh(part.chain, part.reach, part.target);
            }};
}

Argument index_argument(bool required, const char* help) {
    return {.name = "index",
            .type = ArgumentType::Integer,
            .required = required,
            .help = help,
            .low = 0,
            .high = static_cast<double>(max_segments) - 1};
}

Argument choice_argument(const char* name, bool required, const char* help,
                         std::vector<std::string> choices) {
    return {.name = name,
            .type = ArgumentType::Text,
            .required = required,
            .help = help,
            .choices = std::move(choices)};
}

Argument integer_argument(const char* name, const char* help, double low, double high) {
    return {.name = name,
            .type = ArgumentType::Integer,
            .required = false,
            .help = help,
            .low = low,
            .high = high};
}

Argument number_argument(const char* name, const char* help, double low, double high) {
    return {.name = name, .required = false, .help = help, .low = low, .high = high};
}

Argument switch_argument(const char* name, const char* help) {
    return {.name = name, .type = ArgumentType::Boolean, .required = false, .help = help};
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

void add_chain_commands(CommandTable& table) {
    add_shape_commands(table);
    add_mode_commands(table);
    add_reach_commands(table);
    add_study_commands(table);
    add_copy_commands(table);
}

}  // namespace tendril::app
