#pragma once

namespace tendril::app {

class CommandTable;

/// view.card
void add_card_commands(CommandTable& table);

}  // namespace tendril::app
