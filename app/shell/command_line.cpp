#include "app/shell/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

/// Keeps rows that contain the typed text; those that begin with it come first.
void sort_by(std::vector<CompletionRow>& rows, const std::string& typed) {
    const std::string wanted = lower_case(typed);
    const auto place = [&](const CompletionRow& row) { return lower_case(row.text).find(wanted); };
    std::erase_if(rows, [&](const CompletionRow& row) { return place(row) == std::string::npos; });
    std::stable_partition(rows.begin(), rows.end(),
                          [&](const CompletionRow& row) { return place(row) == 0; });
}

/// The typed value without the opening quote of a text.
std::string bare(const std::string& value) {
    return value.starts_with('"') ? value.substr(1) : value;
}

/// The part of a value being typed, and the text before it: the whole value, or a list's last element.
struct TypedValue {
    std::string before{}, text{};
    bool element = false, closed = false;  ///< closed: a list that has its "]"
};

TypedValue typed_value(const Argument& argument, const std::string& value) {
    if (argument.list_of.empty()) return {.text = value};
    if (value.empty()) return {.before = "[", .element = true};
    bool quoted = false, escaped = false;
    std::size_t from = 0;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const char c = value[i];
        if (c == '"' && !escaped) quoted = !quoted;
        escaped = quoted && c == '\\' && !escaped;
        if (!quoted && (c == '[' || c == ',')) from = i + 1;
        if (!quoted && c == ']') return {.text = value, .element = true, .closed = true};
    }
    while (from < value.size() && value[from] == ' ') ++from;
    return {value.substr(0, from), value.substr(from), true};
}

/// A name or a number in the syntax of list elements.
std::string as_element(const std::string& value, const Argument& of) {
    return of.type == ArgumentType::Text ? Json(value).dump() : value;
}

std::vector<std::string> known_values(const Argument& argument, const Workspace& workspace) {
    std::vector<std::string> values = argument.choices;
    if (argument.type == ArgumentType::Boolean) values = {"true", "false"};
    if (values.empty() && argument.known) values = argument.known(workspace);
    const std::string now = argument.present ? argument.present(workspace) : std::string();
    if (values.empty() && !now.empty()) values = {now};
    return values;
}

/// At most max_rows values that contain the typed text and as many that begin with it, since a chain may have
/// half a million joints.
std::vector<std::string> first_of(std::vector<std::string> values, const std::string& typed) {
    if (values.size() <= max_rows) return values;
    const std::string wanted = lower_case(typed);
    std::vector<std::string> first, rest;
    for (std::string& value : values) {
        const std::size_t at = lower_case(value).find(wanted);
        if (at == 0 && first.size() < max_rows) first.push_back(std::move(value));
        if (at != 0 && at != std::string::npos && rest.size() < max_rows) rest.push_back(std::move(value));
    }
    first.insert(first.end(), std::make_move_iterator(rest.begin()), std::make_move_iterator(rest.end()));
    return first;
}

/// Offers the possible continuations of a list after an element.
void add_endings(std::vector<CompletionRow>& rows, const std::string& line) {
    rows.insert(rows.begin(),
                {{"]", "ends the list", "", line + "] "}, {",", "adds another", "", line + ","}});
}

/// The elements of a complete list; empty for any other text.
std::vector<std::string> elements_of(const std::string& list) {
    const Json parsed = Json::parse(list, nullptr, false);
    std::vector<std::string> elements;
    if (!parsed.is_array()) return elements;
    for (const Json& each : parsed)
        elements.push_back(each.is_string() ? each.get<std::string>() : each.dump());
    return elements;
}

bool contains(const std::vector<std::string>& list, const std::string& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
}

/// For the last element of a list: values that the list does not contain yet.
std::vector<CompletionRow> element_rows(const TypedLine& typed, const TypedValue& value, const Argument& list,
                                        const std::string& line, const Workspace& workspace) {
    const Argument* of = find_argument(*typed.command, list.list_of);
    if (of == nullptr || value.closed) return {};
    std::vector<std::string> values = known_values(*of, workspace);
    const std::vector<std::string> last = elements_of("[" + value.text + "]");
    const bool whole = last.size() == 1 && contains(values, last.front());
    const std::vector<std::string> given =
        elements_of(value.before.substr(0, value.before.find_last_of(',')) + "]");
    if (!given.empty()) std::erase_if(values, [&](const auto& each) { return contains(given, each); });
    std::vector<CompletionRow> rows;
    for (const std::string& each : first_of(std::move(values), bare(value.text)))
        rows.push_back(
            {each, "", list.help,
             line.substr(0, typed.last_at) + list.name + "=" + value.before + as_element(each, *of)});
    sort_by(rows, bare(value.text));
    if (rows.size() > max_rows) rows.erase(rows.begin() + max_rows, rows.end());
    if (whole) add_endings(rows, line);
    return rows;
}

std::vector<CompletionRow> value_rows(const TypedLine& typed, const Argument& argument,
                                      const std::string& line, const Workspace& workspace) {
    const TypedValue value = typed_value(argument, typed.last.value);
    if (value.element) return element_rows(typed, value, argument, line, workspace);
    const std::string now = argument.present ? argument.present(workspace) : std::string();
    const bool text = argument.type == ArgumentType::Text;
    std::vector<CompletionRow> rows;
    for (const std::string& each : first_of(known_values(argument, workspace), bare(value.text)))
        rows.push_back(
            {each, each == now ? "now" : "", argument.help,
             line.substr(0, typed.last_at) + argument.name + "=" + (text ? quoted(each) : each) + " "});
    sort_by(rows, bare(value.text));
    if (rows.size() > max_rows) rows.erase(rows.begin() + max_rows, rows.end());
    return rows;
}

std::string detail_of(const Argument& argument, const Workspace& workspace) {
    return rule_text(argument) + (argument.present ? "; now " + argument.present(workspace) : "");
}

std::vector<CompletionRow> argument_rows(const TypedLine& typed, const std::string& line,
                                         const Workspace& workspace) {
    // The next argument follows the typed text, or replaces an unfinished name.
    const bool behind = typed.last.assigned;
    const std::string before = behind ? line + " " : line.substr(0, typed.last_at);
    std::vector<CompletionRow> required, optional, given;
    for (const Argument& argument : typed.command->arguments) {
        CompletionRow row{argument.name + "=", detail_of(argument, workspace), argument.help,
                          before + argument.name + "="};
        if (const TypedArgument* found = typed.find(argument.name)) {
            row.given = true;
            row.text += found->value;
            row.line = line;
            given.push_back(std::move(row));
        } else {
            (argument.required ? required : optional).push_back(std::move(row));
        }
    }
    std::vector<CompletionRow> rows = std::move(required);
    rows.insert(rows.end(), std::make_move_iterator(optional.begin()),
                std::make_move_iterator(optional.end()));
    if (!behind && !typed.last.name.empty()) {
        auto matching = rows;
        sort_by(matching, typed.last.name);
        if (!matching.empty()) return matching;
    }
    // The argument being typed comes first.
    const auto current = std::find_if(given.begin(), given.end(), [&](const CompletionRow& row) {
        return behind && row.text == typed.last.name + "=" + typed.last.value;
    });
    if (current != given.end()) {
        rows.insert(rows.begin(), std::move(*current));
        given.erase(current);
    }
    rows.insert(rows.end(), std::make_move_iterator(given.begin()), std::make_move_iterator(given.end()));
    return rows;
}

/// True if a word of the text begins with `word`: at the start, or after a character that is not
/// alphanumeric.
bool begins_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) return true;
    return false;
}

/// True if an argument's name has a word that begins with `word`.
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

struct Piece {
    std::string text;
    std::size_t begin = 0;
};

/// Splits at blanks outside brackets and quotes. The last piece is empty after a trailing blank.
std::vector<Piece> pieces(const std::string& line) {
    std::vector<Piece> found{{}};
    int depth = 0;
    bool quoted = false, escaped = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && !escaped) quoted = !quoted;
        escaped = quoted && c == '\\' && !escaped;
        if (!quoted && (c == '[' || c == '{')) ++depth;
        if (!quoted && (c == ']' || c == '}')) --depth;
        if (c == ' ' && depth <= 0 && !quoted) {
            if (!found.back().text.empty()) found.emplace_back();
            found.back().begin = i + 1;
        } else {
            found.back().text += c;
        }
    }
    return found;
}

TypedArgument argument_of(const std::string& piece) {
    const std::size_t equals = piece.find('=');
    if (equals == std::string::npos) return {piece, {}, false};
    return {piece.substr(0, equals), piece.substr(equals + 1), true};
}

Json value_of(const std::string& text) {
    Json parsed = Json::parse(text, nullptr, false);
    return parsed.is_discarded() ? Json(text) : parsed;
}

/// True if more typing may turn the text into a valid value.
bool may_become(const Argument& argument, const std::string& text) {
    if (text.empty()) return true;
    const auto begins = [&](const std::string& whole) { return whole.starts_with(text); };
    switch (argument.type) {
        case ArgumentType::Text:
            return text[0] == '"' || std::any_of(argument.choices.begin(), argument.choices.end(), begins);
        case ArgumentType::Boolean:
            return begins("true") || begins("false");
        case ArgumentType::Any:
        case ArgumentType::ListOrText:
            return true;
        case ArgumentType::List:
            return text[0] == '[' && Json::parse(text, nullptr, false).is_discarded();
        default:  // an unfinished number or list is not yet JSON
            return Json::parse(text, nullptr, false).is_discarded() &&
                   text.find_first_not_of("0123456789+-.eE[], ") == std::string::npos;
    }
}

std::string mistake_in(const Command& command, const TypedArgument& typed, bool last) {
    const Argument* argument = find_argument(command, typed.name);
    if (!typed.assigned) {
        if (!last) return "\"" + typed.name + "\" is not an argument; write name=value";
        const auto begins = [&](const Argument& each) { return each.name.starts_with(typed.name); };
        if (std::any_of(command.arguments.begin(), command.arguments.end(), begins)) return {};
    }
    if (argument == nullptr) return command.name + " has no argument \"" + typed.name + "\"";
    try {
        check_value(*argument, value_of(typed.value), typed.name);
    } catch (const Refused& refusal) {
        if (!last || !may_become(*argument, typed.value)) return refusal.what();
    }
    return {};
}

}  // namespace

std::string common_prefix(const std::vector<std::string>& texts) {
    if (texts.empty()) return {};
    std::string prefix = texts.front();
    for (const std::string& text : texts) {
        const auto end = std::mismatch(prefix.begin(), prefix.end(), text.begin(), text.end()).first;
        prefix.erase(end, prefix.end());
    }
    // Do not cut within a UTF-8 character.
    while (!prefix.empty() && texts.front().size() > prefix.size() &&
           (static_cast<unsigned char>(texts.front()[prefix.size()]) & 0xC0) == 0x80)
        prefix.pop_back();
    return prefix;
}

std::vector<CompletionRow> completions(const TypedLine& typed, const std::string& line,
                                       const Workspace& workspace) {
    if (typed.command == nullptr) return {};
    if (typed.last.assigned) {
        if (const Argument* argument = find_argument(*typed.command, typed.last.name)) {
            auto rows = value_rows(typed, *argument, line, workspace);
            if (!rows.empty()) return rows;
        }
    }
    return argument_rows(typed, line, workspace);
}

std::string completed(const TypedLine& typed, const std::string& line, const std::vector<CompletionRow>& rows,
                      std::size_t chosen) {
    if (chosen >= rows.size()) return line;
    const Argument* argument = typed.last.assigned ? find_argument(*typed.command, typed.last.name) : nullptr;
    const TypedValue value = argument ? typed_value(*argument, typed.last.value) : TypedValue{};
    const std::string as_typed = argument              ? value.text
                                 : typed.last.assigned ? typed.last.value
                                                       : typed.last.name;
    const std::string text = bare(as_typed);
    std::vector<std::string> beginning;
    for (const CompletionRow& row : rows)
        if (!row.given && !text.empty() && row.text.starts_with(text)) beginning.push_back(row.text);
    const std::string common = common_prefix(beginning);
    if (beginning.size() < 2 || common.size() <= text.size()) return rows[chosen].line;
    // A name with a blank, or in a list, needs an opening quote; the closing one follows the complete name.
    const Argument* of = value.element ? find_argument(*typed.command, argument->list_of) : nullptr;
    std::string inserted = of ? as_element(common, *of) : typed.last.assigned ? quoted(common) : common;
    if (inserted != common) inserted.pop_back();
    return line.substr(0, line.size() - as_typed.size()) + inserted;
}

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

TypedCommand read_typed_command(const std::string& line) {
    auto words = pieces(line);
    if (words.back().text.empty()) words.pop_back();
    if (words.empty()) throw std::runtime_error("no command");
    Json arguments = Json::object();
    for (std::size_t i = 1; i < words.size(); ++i) {
        const TypedArgument typed = argument_of(words[i].text);
        if (!typed.assigned || typed.name.empty())
            throw std::runtime_error("\"" + words[i].text + "\" is not an argument; write name=value");
        arguments[typed.name] = value_of(typed.value);
    }
    return {words.front().text, std::move(arguments)};
}

const TypedArgument* TypedLine::find(const std::string& name) const {
    if (last.assigned && last.name == name) return &last;
    const auto found = std::find_if(given.begin(), given.end(),
                                    [&](const TypedArgument& each) { return each.name == name; });
    return found == given.end() ? nullptr : &*found;
}

TypedLine read_typed_line(const CommandTable& table, const std::string& line) {
    const auto words = pieces(line);
    if (words.size() < 2) return {};
    TypedLine typed{.command = table.find(words.front().text)};
    if (typed.command == nullptr) return typed;
    for (std::size_t i = 1; i + 1 < words.size(); ++i) typed.given.push_back(argument_of(words[i].text));
    typed.last = argument_of(words.back().text);
    typed.last_at = words.back().begin;
    return typed;
}

const Argument* find_argument(const Command& command, const std::string& name) {
    const auto found = std::find_if(command.arguments.begin(), command.arguments.end(),
                                    [&](const Argument& each) { return each.name == name; });
    return found == command.arguments.end() ? nullptr : &*found;
}

std::string mistake(const TypedLine& line) {
    if (line.command == nullptr) return {};
    for (const TypedArgument& each : line.given)
        if (std::string found = mistake_in(*line.command, each, false); !found.empty()) return found;
    if (line.last.name.empty() && !line.last.assigned) return {};
    return mistake_in(*line.command, line.last, true);
}

std::string missing(const TypedLine& line) {
    if (line.command == nullptr) return {};
    for (const Argument& argument : line.command->arguments) {
        const TypedArgument* typed = line.find(argument.name);
        if (argument.required && (typed == nullptr || typed->value.empty()))
            return argument.name + " is missing (" + rule_text(argument) + ")" +
                   (argument.help.empty() ? "" : ": " + argument.help);
    }
    return {};
}

std::string quoted(const std::string& text) {
    const bool bare = !text.empty() && text.find_first_of(" \"[]{}\\") == std::string::npos &&
                      Json::parse(text, nullptr, false).is_discarded();
    return bare ? text : Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tendril::app
