#include "app/io/trace/raw.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/io/text.hpp"

namespace tendril::app {

void fail_line(std::size_t line, const std::string& what) {
    throw std::runtime_error("line " + std::to_string(line) + ": " + what);
}

namespace {

/// Calls `see` for each run of digits with commas between them, with the number of commas.
void for_each_comma_run(std::string& text, auto see) {
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at, commas = 0;
        for (; end < text.size() && (is_digit(text[end]) || text[end] == ','); ++end)
            commas += text[end] == ',' && end > at && end + 1 < text.size() && is_digit(text[end - 1]) &&
                      is_digit(text[end + 1]);
        if (commas > 0) see(text, at, end, commas);
        at = end + 1;
    }
}

void make_points(std::string& text) {
    for_each_comma_run(text, [](std::string& all, std::size_t at, std::size_t end, std::size_t) {
        for (++at; at + 1 < end; ++at)
            if (all[at] == ',') all[at] = '.';
    });
}

}  // namespace

Lines::Lines(std::istream& in) : in_(in) {
    constexpr std::size_t most = 64, enough = 1u << 16;  // lines, bytes
    while (ahead_.size() < most && bytes_ < enough && ahead(ahead_.size())) {
    }
    // "0,5; 1,5" has decimal commas, and "0,1,0 0,2,0" has none.
    std::size_t single = 0, several = 0, points = 0;
    for (std::string& text : ahead_) {
        for_each_comma_run(text, [&](std::string&, std::size_t, std::size_t, std::size_t commas) {
            ++(commas == 1 ? single : several);
        });
        for (std::size_t i = 1; i + 1 < text.size(); ++i)
            points += text[i] == '.' && is_digit(text[i - 1]) && is_digit(text[i + 1]);
    }
    decimal_commas_ = single > 2 * points && single > 10 * several;
    if (decimal_commas_) std::ranges::for_each(ahead_, make_points);
}

const std::string* Lines::ahead(std::size_t index) {
    while (ahead_.size() <= index)
        if (!read(ahead_.emplace_back())) {
            ahead_.pop_back();
            return nullptr;
        }
    return &ahead_[index];
}

bool Lines::next(std::string& text) {
    if (ahead(0) == nullptr) return false;
    text = std::move(ahead_.front());
    drop(1);
    return true;
}

void Lines::drop(std::size_t count) {
    ahead_.erase(ahead_.begin(), ahead_.begin() + static_cast<std::ptrdiff_t>(count));
    taken_ += count;
}

bool Lines::read(std::string& text) {
    constexpr std::size_t longest = 16u << 20;
    std::streambuf& buffer = *in_.rdbuf();
    bool any = false;
    for (;;) {
        const int c = buffer.sbumpc();
        if (c == std::char_traits<char>::eof()) break;
        any = true;
        if (c == '\r' && buffer.sgetc() == '\n') buffer.sbumpc();
        if (c == '\n' || c == '\r') break;
        if (text.size() == longest) fail_line(taken_ + ahead_.size(), "is longer than 16 MiB");
        text.push_back(static_cast<char>(c));
    }
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (bytes_ == 0 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
    bytes_ += text.size() + 1;
    if (decimal_commas_) make_points(text);
    return any;
}

std::optional<double> take_number(std::string_view& text) {
    std::string_view rest = text;
    constexpr std::string_view minus = "\u2212";
    const bool typeset = rest.starts_with(minus), negative = typeset || rest.starts_with('-');
    if (negative || rest.starts_with('+')) rest.remove_prefix(typeset ? minus.size() : 1);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                     infinity = std::numeric_limits<double>::infinity();
    struct Word {
        std::string_view text;
        double value;
    };
    static constexpr std::array words{
        Word{"nan(ind)", nan}, Word{"nan(snan)", nan}, Word{"nan", nan},    Word{"null", nan},
        Word{"none", nan},     Word{"nil", nan},       Word{"na", nan},     Word{"infinity", infinity},
        Word{"inf", infinity}, Word{"1.#qnan", nan},   Word{"1.#ind", nan}, Word{"1.#inf", infinity}};
    const std::string start = lower_case(rest.substr(0, 10));
    for (const Word& word : words) {
        if (!start.starts_with(word.text)) continue;
        std::string_view after = rest.substr(word.text.size());
        while (word.text.starts_with('1') && after.starts_with('0')) after.remove_prefix(1);
        if (after.starts_with('f') || after.starts_with('F')) after.remove_prefix(1);
        if (!after.empty() && (is_letter(after[0]) || is_digit(after[0]))) return std::nullopt;
        text = after;
        return negative ? -word.value : word.value;
    }
    if (rest.empty() || !(is_digit(rest[0]) || rest[0] == '.')) return std::nullopt;
    const std::string_view number = rest;
    const auto read = [&](std::string_view digits, std::chars_format format) -> std::optional<double> {
        double value = 0.0;
        const auto [stop, error] = read_double(digits.data(), digits.data() + digits.size(), value, format);
        if (error != std::errc() && error != std::errc::result_out_of_range) return std::nullopt;
        rest.remove_prefix(rest.size() - digits.size() + static_cast<std::size_t>(stop - digits.data()));
        return error == std::errc() ? value : infinity;
    };
    std::optional<double> value;
    const std::size_t mantissa = std::min(rest.find_first_not_of("0123456789.abcdefABCDEFxX"), rest.size());
    if (start.starts_with("0x") && mantissa < rest.size() && (rest[mantissa] | 0x20) == 'p')
        value = read(rest.substr(2), std::chars_format::hex);
    else
        value = read(rest, std::chars_format::general);
    if (!value) return std::nullopt;
    // Fortran's 0.14D+01, Mathematica's 1.4*^-2
    const std::size_t mark = rest.starts_with("*^") ? 2 : !rest.empty() && (rest[0] | 0x20) == 'd' ? 1 : 0;
    if (mark > 0 && rest.size() > mark && !is_letter(rest[mark])) {
        std::size_t digits = mark + (rest[mark] == '+' || rest[mark] == '-'), end = digits;
        while (end < rest.size() && is_digit(rest[end])) ++end;
        std::string whole(number.substr(0, number.size() - rest.size()));
        whole += (rest[mark] == '-' ? "e-" : "e") + std::string(rest.substr(digits, end - digits));
        std::string_view all = whole;
        if (const auto scaled = take_number(all); scaled && all.empty() && end > digits) {
            value = scaled;
            rest.remove_prefix(end);
        }
    }
    for (const std::string_view suffix : {"_f32", "_f64", "f32", "f64", "f", "F"})
        if (rest.starts_with(suffix)) {
            rest.remove_prefix(suffix.size());
            break;
        }
    text = rest;
    return negative ? -*value : *value;
}

std::unique_ptr<RawTrace> open_raw_trace(std::istream& in) {
    Lines lines(in);
    for (const std::string* first = nullptr;; lines.drop(1)) {
        first = lines.ahead(0);
        if (first == nullptr) throw std::runtime_error("has nothing in it");
        if (first->starts_with("\xff\xfe") || first->starts_with("\xfe\xff"))
            throw std::runtime_error("is UTF-16 text: save it as UTF-8");
        if (first->find_first_not_of(" \t") != first->npos) break;
    }
    // Native JSON: lists of joints.
    const char begin = (*lines.ahead(0))[lines.ahead(0)->find_first_not_of(" \t")];
    std::string start;
    for (std::size_t i = 0; i < 64 && start.size() < (1u << 16) && lines.ahead(i); ++i)
        start += *lines.ahead(i) + ' ';
    const auto has = [&](std::string_view name, std::string_view value) {
        const std::size_t at = start.find(name);
        if (at == start.npos) return false;
        const auto key = start.begin() + static_cast<std::ptrdiff_t>(at);
        const std::size_t next = start.find_first_not_of(" \t:", at + name.size());
        return std::count(start.begin(), key, '{') == 1 + std::count(start.begin(), key, '}') &&
               next != start.npos && value.find(start[next]) == value.npos;
    };
    if ((begin == '{' || begin == '[') && (has("\"tendril\"", "") || has("\"joints\"", "{")))
        return open_json_trace(std::move(lines));
    return open_log_trace(std::move(lines));
}

}  // namespace tendril::app
