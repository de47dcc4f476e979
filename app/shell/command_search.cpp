#include "app/shell/command_search.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/text.hpp"

namespace tendril::app {
namespace {

/// Whether a word of the text begins with `word`: at the start, or after a character that is not
/// alphanumeric.
bool begins_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) return true;
    return false;
}

/// Whether an argument's name has a word that begins with `word`.
bool takes(const Command& command, const std::string& word) {
    return std::any_of(command.arguments.begin(), command.arguments.end(), [&](const Argument& argument) {
        return begins_word(lower_case(argument.name), word);
    });
}

/// Breaks ties between equal matches: commands that add come first, then those that change, remove, and
/// remove everything. Read from the title's first word.
enum class Verb { Adds, Changes, Removes, RemovesAll };

Verb verb_of(const Command& command) {
    const std::string title = lower_case(command.title), verb = title.substr(0, title.find(' '));
    const auto is_one_of = [&](std::initializer_list<const char*> verbs) {
        return std::find(verbs.begin(), verbs.end(), verb) != verbs.end();
    };
    if (is_one_of({"add", "insert", "attach"})) return Verb::Adds;
    if (is_one_of({"clear", "reset"})) return Verb::RemovesAll;
    if (!is_one_of({"remove", "delete", "detach", "forget"})) return Verb::Changes;
    return begins_word(title, "every") || begins_word(title, "all") ? Verb::RemovesAll : Verb::Removes;
}

/// Distance of a command from the query. Each word adds 0 if a word of the title begins with it, more for the
/// name, the inside of the title, the help, or an argument's name. None if a word is nowhere.
std::optional<int> distance(const Command& command, const std::vector<std::string>& words) {
    const std::string title = lower_case(command.title), name = lower_case(command.name),
                      help = lower_case(command.help);
    int sum = 0;
    for (const std::string& word : words) {
        const int of_word = begins_word(title, word)               ? 0
                            : begins_word(name, word)              ? 1
                            : name.find(word) != name.npos         ? 2
                            : title.find(word) != title.npos       ? 3
                            : help.find(word) != std::string::npos ? 4
                            : takes(command, word)                 ? 5
                                                                   : -1;
        if (of_word < 0) return std::nullopt;
        sum += of_word;
    }
    return sum;
}

}  // namespace

std::vector<const Command*> search_commands(const CommandTable& table, const std::string& query,
                                            std::string_view open_lab, std::span<const std::string> recent) {
    std::istringstream stream(lower_case(query.substr(0, query.find('='))));
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    // With "chain.add length=..." typed, the last word is an argument's name.
    if (query.find('=') != std::string::npos && words.size() > 1) words.resize(1);

    const auto age = [&](const Command& command) {
        return words.empty() ? std::find(recent.begin(), recent.end(), command.name) - recent.begin() : 0;
    };
    const auto scope = [&](const Command& command) {
        return open_lab.empty() || command.lab == open_lab ? 0 : command.lab.empty() ? 1 : 2;
    };
    // A match in the help alone ranks below other labs' matches in title or name.
    using Rank = std::tuple<bool, std::ptrdiff_t, bool, bool, int, Verb, int>;
    std::vector<std::pair<Rank, const Command*>> found;
    for (const Command& command : table.all()) {
        const auto far = distance(command, words);
        if (!far) continue;
        const bool other = words.size() != 1 || lower_case(command.name) != words.front();
        found.push_back({{other, age(command), *far > 3 * static_cast<int>(words.size()), scope(command) == 2,
                          *far, words.empty() ? Verb::Changes : verb_of(command), scope(command)},
                         &command});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<const Command*> list;
    for (const auto& [rank, command] : found) list.push_back(command);
    return list;
}

}  // namespace tendril::app
