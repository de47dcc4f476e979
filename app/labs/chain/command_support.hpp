// What the files of this lab's commands share.
#pragma once

#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

/// A command on a copy of the lab's part; what is being studied is worked out anew after it.
Command chain_command(const char* name, std::vector<Argument> arguments, const char* help,
                      void (*change)(ChainPart&, const Arguments&), Effect effect = Effect::Edit);

Argument index_argument(bool required, const char* help);
Argument choice_argument(const char* name, bool required, const char* help, std::vector<std::string> choices);
Argument integer_argument(const char* name, const char* help, double low, double high);  ///< optional
Argument number_argument(const char* name, const char* help, double low, double high);   ///< optional
Argument switch_argument(const char* name, const char* help);                            ///< optional

std::size_t index_of(const Arguments& given);
/// Throws Refused.
void check_index(const ChainPart& part, std::size_t index);

std::vector<std::string> names(const auto& list, auto name_of) {
    std::vector<std::string> result;
    for (const auto& each : list) result.emplace_back(name_of(each));
    return result;
}

void add_shape_commands(CommandTable& table);
void add_mode_commands(CommandTable& table);
void add_reach_commands(CommandTable& table);
void add_study_commands(CommandTable& table);
void add_copy_commands(CommandTable& table);

}  // namespace tendril::app
