#include "app/io/trace/raw.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/document/json_scan.hpp"
#include "app/document/text.hpp"

namespace tendril::app {

void fail_line(std::size_t line, const std::string& what) {
    throw std::runtime_error("line " + std::to_string(line) + ": " + what);
}

bool read_line(std::istream& in, std::string& text, std::size_t& line) {
    constexpr std::size_t longest = 16u << 20;
    text.clear();
    std::streambuf& buffer = *in.rdbuf();
    bool any = false;
    for (;;) {
        const int c = buffer.sbumpc();
        if (c == std::char_traits<char>::eof()) break;
        any = true;
        if (c == '\r' && buffer.sgetc() == '\n') buffer.sbumpc();
        if (c == '\n' || c == '\r') break;
        if (text.size() == longest) fail_line(line + 1, "is longer than 16 MiB");
        text.push_back(static_cast<char>(c));
    }
    if (!any) return false;
    ++line;
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    return true;
}

std::optional<double> take_number(std::string_view& text) {
    std::string_view rest = text;
    const bool negative = rest.starts_with('-');
    if (negative || rest.starts_with('+')) rest.remove_prefix(1);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     infinity = std::numeric_limits<double>::infinity();
    struct Word {
        std::string_view text;
        double value;
    };
    static constexpr std::array words{
        Word{"nan(ind)", nan}, Word{"nan(snan)", nan}, Word{"nan", nan},    Word{"infinity", infinity},
        Word{"inf", infinity}, Word{"1.#qnan", nan},   Word{"1.#ind", nan}, Word{"1.#inf", infinity}};
    const std::string start = lower_case(rest.substr(0, 10));
    for (const Word& word : words) {
        if (!start.starts_with(word.text)) continue;
        rest.remove_prefix(word.text.size());
        while (word.text.starts_with('1') && rest.starts_with('0')) rest.remove_prefix(1);
        if (rest.starts_with('f') || rest.starts_with('F')) rest.remove_prefix(1);
        const char after = rest.empty() ? ' ' : rest[0];
        if ((after >= 'a' && after <= 'z') || (after >= 'A' && after <= 'Z') || after == '_')
            return std::nullopt;
        text = rest;
        return negative ? -word.value : word.value;
    }
    const bool digit = !rest.empty() && ((rest[0] >= '0' && rest[0] <= '9') || rest[0] == '.');
    if (!digit) return std::nullopt;
    double value = 0.0;
    const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    if (error == std::errc::result_out_of_range)
        value = infinity;
    else if (error != std::errc())
        return std::nullopt;
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
    if (rest.starts_with('f') || rest.starts_with('F')) rest.remove_prefix(1);
    text = rest;
    return negative ? -value : value;
}

namespace {

/// Whether a line can be JSON, as far as it goes: NumPy, MATLAB and Python print brackets, too.
bool can_be_json(std::string_view text) {
    bool value = false;  // the last thing was one
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        std::string_view rest = text.substr(at);
        const bool begins =
            c == '{' || c == '[' || c == '"' || (c != ',' && c != ':' && c != '}' && c != ']');
        if (c == ' ' || c == '\t') {
            ++at;
            continue;
        }
        if (begins && value) return false;
        value = begins ? c != '{' && c != '[' : c == '}' || c == ']';
        if (c == '"') {
            at = string_end(text, at);
        } else if (!begins || c == '{' || c == '[') {
            ++at;
        } else if (take_number(rest)) {
            at = text.size() - rest.size();
        } else {
            static constexpr std::array<std::string_view, 3> literals{"true", "false", "null"};
            const auto word =
                std::ranges::find_if(literals, [&](auto each) { return rest.starts_with(each); });
            if (word == literals.end()) return false;
            at += word->size();
        }
    }
    return true;
}

}  // namespace

std::unique_ptr<RawTrace> open_raw_trace(std::istream& in) {
    std::string first;
    std::size_t line = 0;
    do {
        if (!read_line(in, first, line)) throw std::runtime_error("has nothing in it");
        if (first.starts_with("\xff\xfe") || first.starts_with("\xfe\xff"))
            throw std::runtime_error("is UTF-16 text: save it as UTF-8");
        if (first.starts_with('#') && begins_table(std::string_view(first).substr(1))) first.erase(0, 1);
    } while (first.find_first_not_of(" \t") == first.npos || first.starts_with("sep=") ||
             (first.starts_with('#') && first.find_first_of("([{<:=") == first.npos));
    const char begin = first[first.find_first_not_of(" \t")];
    const bool named = first.find("\"joints\"") != first.npos || first.find("\"tendril\"") != first.npos;
    const bool block = begin == '{' && first.find_first_not_of(" \t{") == first.npos;  // over many lines
    if ((begin == '{' || begin == '[') && !block && (named || can_be_json(first)))
        return open_json_trace(in, std::move(first), line);
    if (begins_table(first)) return open_table_trace(in, std::move(first), line);
    return open_log_trace(in, std::move(first), line);
}

}  // namespace tendril::app
