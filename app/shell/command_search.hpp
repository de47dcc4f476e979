// Finds commands by a few words, the likeliest first.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

struct Command;
class CommandTable;

/// Commands that contain every word of the query in title, name, help or the name of an argument, ignoring
/// case. A command named exactly as the query comes first; then the open lab's and the program's own.
/// Among these, matches at the start of a word in the title rank before matches in the name, then come
/// matches inside the title, in the help, in the arguments. Among equal matches, commands that add
/// come first and commands that remove last. Without a query the most recently run come first (`recent`,
/// newest first). Arguments in the query are ignored.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab = {},
                                            std::span<const std::string> recent = {});

}  // namespace tendril::app
