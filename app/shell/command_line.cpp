#include "app/shell/command_line.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

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

/// Whether more typing may turn the text into a valid value.
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
