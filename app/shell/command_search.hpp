// Finds commands by a few words, the likeliest first.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

struct Command;
class CommandTable;

/// Commands that contain every word of the query in title, name or help, ignoring case. One whose name equals
/// the query comes first; then those of the open lab and of the program itself. Among these, matches at the
/// start of a word in the title rank before matches in the name, and those before matches in the help.
/// Without a query the most recently run come first (`recent`, newest first). Arguments in the query are
/// ignored.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab = {},
                                            std::span<const std::string> recent = {});

}  // namespace tendril::app
