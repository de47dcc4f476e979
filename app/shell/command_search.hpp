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
/// case. One whose name equals the query comes first; then those of the open lab and of the program itself.
/// Among these, matches at the start of a word in the title rank before matches in the name, then come
/// matches inside the title, in the help, in the arguments. Of equal matches those that add something come
/// first, and those that remove something last. Without a query the most recently run come first (`recent`,
/// newest first). Arguments in the query are ignored.
std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab = {},
                                            std::span<const std::string> recent = {});

}  // namespace tendril::app
