#include "app/io/trace/log_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/io/text.hpp"

namespace tendril::app {

void add_tokens(std::vector<LogToken>& tokens, std::string_view rest) {
    for (bool spaced = true; !rest.empty();) {
        if (std::string_view(" \t\"'\\").find(rest[0]) != std::string_view::npos) {
            spaced = true;
            rest.remove_prefix(1);
            continue;
        }
        LogToken& token = tokens.emplace_back(LogToken{rest[0], spaced});
        std::size_t end = 1;
        std::string_view after = rest;
        const auto number = take_number(after);
        const std::string_view text = rest.substr(0, rest.size() - after.size());
        if (number && (after.empty() || !is_letter(after[0]) || text.find('.') != text.npos)) {  // not 4x4
            token.kind = '0';
            token.value = *number;
            end = text.size();
        } else if (is_letter(rest[0]) || is_digit(rest[0])) {
            token.kind = 'a';
            while (end < rest.size() &&
                   (is_letter(rest[end]) || is_digit(rest[end]) ||
                    (rest[end] == '.' && end + 1 < rest.size() && is_letter(rest[end + 1]))))
                ++end;
        }
        token.text = rest.substr(0, end);
        rest.remove_prefix(end);
        spaced = false;
    }
}

void add_words(std::vector<LogWord>& words, std::string_view text) {
    while (!text.empty()) {
        std::size_t end = std::min(text.find_first_of(". "), text.size());
        if (end + 2 == text.size()) end = text.size();  // hand.R
        if (end > 0) words.push_back({std::string(text.substr(0, end)), lower_case(text.substr(0, end))});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

namespace {

double dot(const double* a, const double* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// True if three rows, `stride` numbers apart, are orthonormal.
bool rotates(const double* rows, std::size_t stride) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j)
            if (!(std::abs(dot(rows + i * stride, rows + j * stride) - (i == j ? 1.0 : 0.0)) < 5e-3))
                return false;
    return true;
}

/// The position in a 4x4 matrix whose last row or column is (0, 0, 0, 1); empty for any other matrix.
std::vector<double> position_in(const std::vector<double>& m) {
    const double volume = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
                          m[2] * (m[4] * m[9] - m[5] * m[8]);
    if (m[15] != 1.0 || !(std::abs(volume) > 1e-9)) return {};
    if (m[12] == 0.0 && m[13] == 0.0 && m[14] == 0.0) return {m[3], m[7], m[11]};
    if (m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0) return {m[12], m[13], m[14]};
    return {};
}

bool is_unit(const double* quaternion) {
    return std::abs(dot(quaternion, quaternion) + quaternion[3] * quaternion[3] - 1.0) < 0.02;
}

}  // namespace

bool LogScanner::pull() {
    const std::string* text = lines_.ahead(pulled_);
    if (text == nullptr) return false;
    add_tokens(tokens_, *text);
    tokens_.push_back({'\n'});
    ++pulled_;
    return true;
}

void LogScanner::skip_breaks(std::size_t& at) {
    while (is(at, '\n') && (at + 1 < tokens_.size() || pull())) ++at;
}

bool LogScanner::next(std::vector<LogVector>& found) {
    found.clear();
    while (found.empty()) {
        tokens_.clear();
        pulled_ = from_ = 0;
        if (!pull()) {
            if (std::exchange(unread_, 0) > 0)
                trace_.notes.push_back("lines with numbers that are not positions were left out, from line " +
                                       std::to_string(first_unread_) + " on");
            return false;
        }
        const std::size_t end = scan_line(found);
        if (found.empty()) pass_line(end);
        gap_ = std::max<unsigned>(gap_, NextLine);
        const auto last = tokens_.begin() + static_cast<std::ptrdiff_t>(end + 1);
        lines_.drop(static_cast<std::size_t>(
            std::count_if(tokens_.begin(), last, [](const LogToken& each) { return each.kind == '\n'; })));
    }
    return true;
}

std::size_t LogScanner::scan_line(std::vector<LogVector>& found) {
    bullets_ = 0;
    while (is(bullets_, '-')) ++bullets_;
    lone_ = lone_ && is(bullets_, '0') && is(bullets_ + 1, '\n');
    std::size_t at = 0;
    while (!is(at, '\n')) {
        std::size_t begin = at, end = at, row = 0;
        Numbers numbers;
        std::string_view name;
        axes_ = false;
        if (!named(at, end, numbers, row, name) && !bracketed(at, end, numbers, row) &&
            !bare(begin, end, numbers)) {
            if (is_any(at, "([{")) ++opened_;
            if (is_any(at, ")]}")) {
                if (opened_ > 0)
                    --opened_;
                else
                    ++closed_;
            }
            ++at;
            continue;
        }
        LogVector vector{.words = words_before(begin),
                         .first = found.empty(),
                         .gap = gap_ + std::min(closed_, NextLine - 1u),
                         .line = lines_.taken() + 1};
        add_words(vector.words, name);
        if (found.empty()) {
            read_stamp(at);
            if (!loose_ || std::ranges::all_of(vector.words, &LogWord::is_number))
                vector.words.insert(vector.words.begin(), heading_.begin(), heading_.end());
            heading_.clear();
        }
        vector.stamp = stamp_;
        add(found, std::move(vector), std::move(numbers), row, end);
        gap_ = SameLine;
        opened_ = closed_ = 0;
        from_ = at = end;
    }
    if (!found.empty()) return at;
    read_stamp(at);
    const auto fractions = std::count_if(
        tokens_.begin(), tokens_.begin() + static_cast<std::ptrdiff_t>(at),
        [](const LogToken& each) { return each.kind == '0' && each.text.find('.') != each.text.npos; });
    if (fractions >= 3 && unread_++ == 0) first_unread_ = lines_.taken() + 1;
    return at;
}

/// Adds the numbers as vectors of three, one of four, or a pose; moves `end` past a matrix.
void LogScanner::add(std::vector<LogVector>& found, LogVector vector, Numbers numbers, std::size_t row,
                     std::size_t& end) {
    const std::size_t count = numbers.size();
    const auto put = [&](std::size_t begin, std::size_t size, std::size_t stride = 1) {
        vector.numbers.clear();
        for (std::size_t i = 0; i < size; ++i) vector.numbers.push_back(numbers[begin + i * stride]);
        found.push_back(vector);
        vector.words.clear();
        vector.first = false;
        vector.gap = SameLine;
    };
    // Each row of a matrix has its own brackets or line.
    const std::size_t width = count == 4 ? 4 : 3;
    if (count == 4 || (count == 3 && std::abs(dot(numbers.data(), numbers.data()) - 1.0) < 5e-3)) {
        std::size_t next = end;
        Numbers all = numbers;
        while (all.size() < width * width && next_row(next, width, all)) {
        }
        if (all.size() == width * width && (width == 4 ? !position_in(all).empty() : rotates(all.data(), 3)))
            numbers = std::move(all), row = width, end = next;
    }
    if (!axes_ && (numbers.size() == 16 || (row == 4 && numbers.size() == 12))) {
        if (numbers.size() == 12 && rotates(numbers.data(), 4)) numbers.insert(numbers.end(), {0, 0, 0, 1});
        if (numbers.size() == 16) {
            numbers = position_in(numbers);
            vector.matrix = true;
            if (!numbers.empty()) put(0, 3);
            return;
        }
    }
    if (numbers.size() == 9 && !axes_ && rotates(numbers.data(), 3)) return;
    if (count == 7 || (count == 6 && row == 6)) {
        put(0, 3);
        if (count == 7) put(3, 4);
    } else if (axes_ || (row > 3 && count == 3 * row)) {  // x, y and z have a row each
        for (std::size_t i = 0; i < row; ++i) put(i, 3, row);
    } else {
        for (std::size_t i = 0; i + width <= count; i += width) put(i, width);
    }
}

/// Reads another row of `width` numbers, after brackets and line breaks or after the name of an axis.
bool LogScanner::next_row(std::size_t& at, std::size_t width, Numbers& numbers) {
    std::size_t here = at, begin = numbers.size();
    for (bool broken = false;; ++here) {
        if (is(here, '\n') && std::exchange(broken, true)) return false;
        if (is(here, '\n') && here + 1 == tokens_.size() && !pull()) return false;
        if (is(here, 'a') && tokens_[here].text.size() == 1 && is(here + 1, ':')) ++here;
        if (!is_any(here, "\n:,;|()[]{}<>")) break;
    }
    while (const auto number = number_at(here)) {
        numbers.push_back(*number);
        if (is(here, ',')) ++here;
    }
    at = here;
    return numbers.size() == begin + width;
}

/// Takes a heading, the time and the gap from a line without vectors.
void LogScanner::pass_line(std::size_t end) {
    const auto mark = [&](unsigned gap) { gap_ = std::max(gap_, gap); };
    const bool rule = end >= 3 && is_any(0, "-=*#~") && is(1, tokens_[0].kind) && is(2, tokens_[0].kind);
    if (end == 0 || rule) {
        mark(rule ? RuleBetween : BlankBetween);
        if (loose_ || rule) heading_.clear();
        if (std::exchange(scaled_, false)) scale_ = 1.0;
        return;
    }
    if (is(0, '0') && is(1, '*') && end == 2) {  // MATLAB's 1.0e+03 *
        scale_ = tokens_[0].value;
        return;
    }
    if (is(0, 'a') && tokens_[0].text == "Columns" && is(1, '0') && is(2, 'a'))
        fail_line(lines_.taken() + 1,
                  "a matrix is printed a few columns at a time: widen the window, or write a table");
    const bool text = std::any_of(tokens_.begin(), tokens_.begin() + static_cast<std::ptrdiff_t>(end),
                                  [](const LogToken& each) { return each.kind == 'a' || each.kind == '0'; });
    if (!text) return;
    const bool heads = is_any(end - 1, ":={[(") || (is(0, '<') && is(1, 'a'));
    if (!heads) mark(TextBetween);
    std::vector<LogWord> words = words_before(end);
    if (!heads) heading_.clear();
    loose_ = !heads;
    constexpr std::size_t most = 3;  // words of a name that has its own line
    if (heads || words.size() <= most) heading_.insert(heading_.end(), words.begin(), words.end());
}

/// "[0.033] ...", "time: 0.033", "12:00:01.033 ..."; ROS has "sec: 12" and "nanosec: 345".
void LogScanner::read_stamp(std::size_t end) {
    constexpr std::size_t farthest = 24;  // tokens
    for (std::size_t at = 0; at < std::min(end, farthest);) {
        std::size_t next = at + 1;
        if (is(at, '0')) {
            double value = tokens_[at].value;
            bool whole = tokens_[at].is_whole();
            for (; is(next, ':') && is(next + 1, '0') && next + 1 < end; next += 2)
                value = 60.0 * value + tokens_[next + 1].value, whole = tokens_[next + 1].is_whole();
            const bool leads = (at == 0 || (at == 1 && is_any(0, "([|"))) && !is_any(next, ",;");
            if (!whole && std::isfinite(value) && (leads || next > at + 1)) {
                stamp_ = value;
                return;
            }
        } else if (is(at, 'a')) {
            while (is_any(next, "=:")) ++next;
            if (next < end && is(next, '0') && std::isfinite(tokens_[next].value)) {
                const std::string word = lower_case(tokens_[at].text);
                const double value = tokens_[next].value;
                if (const double unit = time_unit(word); unit > 0.0) {
                    stamp_ = value * unit;
                    return;
                }
                if (word == "sec" || word == "secs") stamp_ = value;
                if (word == "nanosec" || word == "nsecs") stamp_ = stamp_.value_or(0.0) + 1e-9 * value;
                ++next;
            }
        }
        at = next;
    }
}

std::vector<LogWord> LogScanner::words_before(std::size_t at) const {
    constexpr std::size_t most = 24;  // tokens; without a limit a long line takes quadratic time
    std::vector<LogWord> words;
    for (std::size_t i = std::max(from_, at < most ? 0 : at - most); i < at; ++i) {
        const LogToken& token = tokens_[i];
        const char before = i > from_ ? tokens_[i - 1].kind : '(';
        if (token.kind == 'a' || (token.kind == '0' && token.is_whole())) {
            add_words(words, token.text);
        } else if (token.kind == '0' && !words.empty() && (before == 'a' || before == ':' || before == '=')) {
            words.pop_back();  // speed 1.5
            if (!words.empty()) words.back().ends_phrase = true;
        }
        if (words.empty()) continue;
        if (std::string_view(",;|)]}>").find(token.kind) != std::string_view::npos)
            words.back().ends_phrase = true;
        if (token.kind == ':' || token.kind == '=') words.back().names = true;
    }
    return words;
}

/// A number, with its unit, in a constructor or in Haskell's brackets: 1.5, 1.5m, np.float64(1.5),
/// array(1.5, dtype=float32), (-1.5).
std::optional<double> LogScanner::number_at(std::size_t& at) const {
    const bool made = is(at, 'a') && is(at + 1, '(');
    if (is(at, '[') && is(at + 1, '0') && is(at + 2, ']')) {  // a row of a column
        at += 3;
        return tokens_[at - 2].value;
    }
    const bool open = made || (is(at, '(') && is(at + 1, '0') && tokens_[at + 1].text[0] == '-');
    std::size_t here = at + (made ? 2 : open ? 1 : 0);
    if (!is(here, '0')) return std::nullopt;
    const double value = tokens_[here++].value;
    if (open) {
        if (is(here, ',') && is(here + 1, 'a') && is(here + 2, '=') && is(here + 3, 'a')) here += 4;
        if (!is(here++, ')')) return std::nullopt;
    } else if (is(here, 'a') && tokens_[here].text.size() <= 2 &&
               (!tokens_[here].spaced || is_any(here + 1, ",)]"))) {
        ++here;
    }
    at = here;
    return value;
}

/// X=1.0 Y=2.0 Z=3.0 [W=1.0], or W first; each may have the point's name: elbow.x=1.0 elbow.y=2.0
bool LogScanner::named(std::size_t at, std::size_t& end, Numbers& numbers, std::size_t& row,
                       std::string_view& name) {
    if (!is(at, 'a')) return false;
    const std::string_view text = tokens_[at].text;
    const std::string_view prefix = text.substr(0, text.size() - 1);
    const auto axis = [](std::string_view word) { return static_cast<char>(word.back() | 0x20); };
    if (axis(text) != 'x' && axis(text) != 'w') return false;
    const bool w_first = axis(text) == 'w';
    std::size_t here = at;
    bool breaks = false;
    for (const char letter : std::string_view(w_first ? "wxyz" : "xyzw")) {
        std::size_t next = here;
        bool broken = false;
        while (!numbers.empty()) {  // separators: , or </x> <y>
            const std::size_t before = next;
            skip_breaks(next);
            broken = broken || next != before;
            if (is(next, '<') && is(next + 1, '/')) next += 4;
            if (is_any(next, ",;.:<-")) ++next;
            if (next == before) break;
        }
        if (!is(next, 'a') || tokens_[next].text.size() != text.size() ||
            axis(tokens_[next].text) != letter || !tokens_[next].text.starts_with(prefix))
            break;
        ++next;
        while (is_any(next, "=:>")) ++next;
        std::size_t unused = 0;
        const std::size_t before = numbers.size();
        if (const auto number = number_at(next))
            numbers.push_back(*number);
        else if (w_first || !list_at(next, numbers, unused))
            break;
        if (before == 0) row = numbers.size();
        if (numbers.size() != before + row) break;
        breaks = breaks || broken;
        here = next;
        if (row > 1 && numbers.size() == 3 * row) break;
    }
    axes_ = row > 1;
    const bool basis =
        row == 3 && numbers.size() == 9 && rotates(numbers.data(), 3);  // the basis of a transform
    if (numbers.size() < (w_first ? 4 : 3 * row) || numbers.empty() || basis) {
        numbers.clear();
        axes_ = false;
        return false;
    }
    if (!axes_) row = 0;
    if (w_first) std::rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
    components_ = components_ || breaks;
    const bool braced = at > 0 && is(at - 1, '{'), equals = is(at + 1, '='), tight = !tokens_[at + 2].spaced;
    if (text == "X" && equals && tight && !braced) trace_.engine = Engine::Unreal;
    if (text == "X" && !equals && braced) trace_.engine = tight ? Engine::Xna : Engine::Babylon;
    name = prefix.substr(0, prefix.find_last_not_of("._") + 1);
    end = here;
    if (at > 0 && is_any(at - 1, "({[")) {
        skip_breaks(here);
        if (is_any(here, ")}]")) end = here + 1;
    }
    return true;
}

/// Numbers in brackets, and their count per row if they have rows.
bool LogScanner::list_at(std::size_t& at, Numbers& numbers, std::size_t& row) {
    constexpr std::string_view open = "([{<", close = ")]}>";
    if (!is_any(at, open)) return false;
    const char closes = close[open.find(tokens_[at].kind)];
    std::size_t here = at + 1;
    if (is(here, '|')) ++here;  // OCaml's [|1.; 2.; 3.|]
    skip_breaks(here);
    bool regular = true;
    const std::size_t before = numbers.size();
    row = 0;
    for (auto number = number_at(here); number && numbers.size() <= 3 * max_trace_joints;
         number = number_at(here)) {
        numbers.push_back(*number);
        bool ends = is(here, ';');
        if (is_any(here, ",;.")) ++here;
        if (is(here, '\n')) ends = true, skip_breaks(here);
        if (is(here, ',')) ++here;
        const std::size_t n = numbers.size() - before;
        if (ends && row == 0) row = n;
        regular = regular && (!ends || n % row == 0);
    }
    if (is(here, '|')) ++here;
    const std::size_t n = numbers.size() - before;
    if (!regular || row < 3 || n % row != 0 || row == n) row = 0;
    if (n > 0 && is(here, closes)) {
        at = here + 1;
        return true;
    }
    numbers.resize(before);
    return false;
}

/// (1, 2, 3), [1, 2, 3], {1, 2, 3} or <1, 2, 3>, of three or four numbers; or several of them, [1 2 3; 4 5
/// 6]. Or a pose: a position and a unit quaternion, or p[...] as Universal Robots prints it.
bool LogScanner::bracketed(std::size_t at, std::size_t& end, Numbers& numbers, std::size_t& row) {
    std::size_t here = at;
    if (!list_at(here, numbers, row)) return false;
    const std::size_t n = numbers.size();
    const std::string_view word = at > from_ && is(at - 1, 'a') ? tokens_[at - 1].text : std::string_view();
    if (n == 6 && row == 0 && word == "p" && is(at, '[')) row = 6;
    const bool fits = n == 3 || n == 4 || (n == 7 && is_unit(&numbers[3])) || n == 16 ||
                      (n == 6 && (row == 6 || row == 3)) || (n >= 9 && n % 3 == 0);
    if (!fits) {
        numbers.clear();
        row = 0;
        return false;
    }
    end = here--;
    const std::string type = lower_case(word);
    const bool single = tokens_[here - 1].text.ends_with('f');
    if (type == "vector" && is(at, '('))
        trace_.engine = Engine::Blender;
    else if (type == "fvector")
        trace_.engine = Engine::Unreal;
    else if (type == "hou.vector3")
        trace_.engine = Engine::Houdini;
    else if (type == "vector3")
        trace_.engine = single || (at > 1 && tokens_[at - 2].text == "new") ? Engine::Unity : Engine::Godot;
    return true;
}

/// 1.0 2.0 3.0, after a name, beside a pipe or on its own line, which may also have a time and several
/// vectors, or be a column. Unreal's transforms are 1.0,2.0,3.0|10.0,20.0,30.0|1.0,1.0,1.0. Moves `at` past
/// the time.
bool LogScanner::bare(std::size_t& at, std::size_t& end, Numbers& numbers) {
    const char before = at == bullets_ ? '\n' : at > from_ ? tokens_[at - 1].kind : ' ';
    const bool named_cell = (before == ',' || before == ';') && at > 1 && is(at - 2, 'a');  // 7,elbow,1.0,...
    if (!(named_cell || std::string_view("\n:=|a>]").find(before) != std::string_view::npos)) return false;
    std::size_t next = at, fractions = 0;
    if (!is(at, '0') && !is(at, '(')) return false;
    bool joined = false;
    std::vector<std::size_t> ends;
    for (auto number = number_at(next); number; number = is(next, '[') ? std::nullopt : number_at(next)) {
        if (!tokens_[next - 1].spaced && tokens_[next - 1].text.starts_with('.') && is(next - 2, '0'))
            fail_line(lines_.taken() + 1, "numbers run into one another: \"" +
                                              printable(tokens_[next - 2].text) +
                                              printable(tokens_[next - 1].text) + '"');
        fractions += tokens_[next - 1].text.find_first_of(".eEnNpP)") != std::string_view::npos;
        numbers.push_back(*number);
        ends.push_back(next);
        end = next;
        const bool pipe = is(next, '|') && !tokens_[next].spaced && numbers.size() % 3 == 0;
        joined = joined || pipe;
        if (is_any(next, ",;") || pipe) ++next;
    }
    const std::size_t n = numbers.size();
    if (n == 0) return false;
    const std::vector<LogWord> words = words_before(at);
    const auto is_name = [&](std::size_t last) {
        return words.size() >= last && !words[words.size() - last].is_number();
    };
    const bool row = before == '\n' && is(next, '\n');
    std::size_t skip = 0;
    bool fits = false;
    if (joined) {
        fits = n == 9;
        if (fits) numbers.resize(3);
    } else if (row && n == 1) {
        return column(at, end, numbers);
    } else if (row && n > 4) {
        const bool pose = n == 7 && is_unit(&numbers[3]);
        skip = pose ? 0 : n % 3;  // perhaps an index and the time
        fits = skip < 2 || tokens_[at].is_whole();
        if (fits && skip > 0 && n > 5 && std::isfinite(numbers[skip - 1])) stamp_ = numbers[skip - 1];
    } else if (row) {
        skip = n == 4 && tokens_[at].is_whole() && fractions == 3 ? 1 : 0;
        fits = n >= 3;
    } else {
        const bool beside = before == '|' || before == '\n' || is(end, '|');
        fits = (n == 3 || n == 4) && fractions > 0 &&
               (beside || named_cell || before == '>' || before == ']' || is_name(1) || is_name(2));
        if ((n == 7 || n == 8) && fractions > 6 && is_unit(&numbers[n - 4])) fits = true, skip = n - 7;
        if (fits && skip > 0) stamp_ = numbers[0];
        fits = fits || (n >= 9 && n % 3 == 0 && 2 * fractions >= n && (before == '>' || is_name(1)));
    }
    if (!fits) {
        numbers.clear();
        return false;
    }
    numbers.erase(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(skip));
    if (skip > 0) at = ends[skip - 1];
    for (double& each : numbers) each *= row ? scale_ : 1.0;
    scaled_ = scaled_ || row;
    return true;
}

/// Three or four numbers, each on its own line.
bool LogScanner::column(std::size_t at, std::size_t& end, Numbers& numbers) {
    numbers.clear();
    for (std::size_t here = at; numbers.size() < 5;) {
        const std::size_t line = here;
        while (!numbers.empty() && is(here, '-')) ++here;
        if (!numbers.empty() && here - line != std::min<std::size_t>(bullets_, 1)) break;  // a nested list
        const auto number = number_at(here);
        if (is_any(here, ",;")) ++here;
        if (!number || !is(here, '\n')) break;
        numbers.push_back(*number);
        end = here;
        skip_breaks(here);
    }
    const bool fits = !lone_ && (numbers.size() == 3 || numbers.size() == 4);
    lone_ = !fits;
    if (!fits) numbers.clear();
    components_ = components_ || fits;
    return fits;
}

}  // namespace tendril::app
