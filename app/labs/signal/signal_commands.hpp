// The commands of the Signal lab: signal.*.
#pragma once

#include "app/document/command.hpp"
#include "app/labs/kit/arguments.hpp"
#include "app/labs/signal/signal_part.hpp"

namespace tendril::app {

void add_filter_commands(CommandTable& table);
void add_input_commands(CommandTable& table);
void add_fit_commands(CommandTable& table);

}  // namespace tendril::app
