// The Chain lab's commands: chain.*.
#pragma once

#include "app/document/command.hpp"

namespace tendril::app {

void add_chain_commands(CommandTable& table);

}  // namespace tendril::app
