// What Esc does: closes what lies over the scene, or else selects nothing.
#pragma once

namespace tendril::app {

class CommandTable;
class Labs;

/// The labs must outlive what it adds.
void add_closing_command(CommandTable& table, const Labs& labs);

}  // namespace tendril::app
