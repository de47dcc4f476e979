// Which commands a person may mean by a few words, the likeliest first.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tendril::app {

struct Command;
class CommandTable;

/// Commands that have every word of the query in title, name or help, upper case or lower. One whose name is
/// the query comes first; then those of the open lab and of the program itself; of these, words that begin a
/// word of the title count before words in the name, and those before words in the help. With no query, those
/// that ran last come first (`recent`, the newest first). Of a query with arguments only the name counts.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab = {},
                                            std::span<const std::string> recent = {});

}  // namespace tendril::app
