// The Chain lab's commands: chain.*.
#pragma once

namespace tendril::app {

class CommandTable;

void add_chain_commands(CommandTable& table);

}  // namespace tendril::app
