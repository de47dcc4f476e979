#include "app/io/trace/log_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/document/text.hpp"

namespace tendril::app {

std::vector<LogToken> tokens_of(std::string_view rest) {
    std::vector<LogToken> tokens;
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
    return tokens;
}

namespace {

/// Finds vectors in one line.
class Scanner {
  public:
    Scanner(std::string_view text, RawTrace& trace) : tokens_(tokens_of(text)), trace_(trace) {}

    std::vector<LogVector> all() {
        std::vector<LogVector> found;
        for (std::size_t at = 0; at < tokens_.size();) {
            std::size_t end = at;
            std::vector<std::vector<double>> rows(1);
            std::string_view name;
            if (!named(at, end, rows[0], name) && !bracketed(at, end, rows) && !bare(at, end, rows[0])) {
                ++at;
                continue;
            }
            std::vector<LogWord> words = words_before(at);
            if (!name.empty()) add_words(words, name.substr(0, name.size() - 1));
            const bool first = found.empty();
            const std::vector<double> pose = rows[0].size() > 4 ? rows[0] : std::vector<double>();
            if (!pose.empty()) rows[0].resize(3);
            for (std::vector<double>& numbers : rows) {
                found.push_back({.words = std::move(words), .numbers = std::move(numbers), .first = first});
                words.clear();
            }
            if (pose.size() == 7) found.push_back({.numbers = {pose.begin() + 3, pose.end()}});
            from_ = at = end;
        }
        positions_of_matrices(found);
        return found;
    }

  private:
    bool is(std::size_t at, char kind) const { return at < tokens_.size() && tokens_[at].kind == kind; }

    static void add_words(std::vector<LogWord>& words, std::string_view text) {
        while (!text.empty()) {
            std::size_t end = std::min(text.find('.'), text.size());
            if (end + 2 == text.size()) end = text.size();  // hand.R
            words.push_back({std::string(text.substr(0, end)), lower_case(text.substr(0, end))});
            text.remove_prefix(std::min(end + 1, text.size()));
        }
    }
    std::vector<LogWord> words_before(std::size_t at) const {
        constexpr std::size_t most = 24;  // tokens; else a long line takes the square of its length
        std::vector<LogWord> words;
        for (std::size_t i = std::max(from_, at < most ? 0 : at - most); i < at; ++i) {
            const LogToken& token = tokens_[i];
            const char before = i > from_ ? tokens_[i - 1].kind : '(';
            if (token.kind == 'a' || (token.kind == '0' && token.is_whole())) {
                add_words(words, token.text);
            } else if (token.kind == '0' && !words.empty() &&
                       (before == 'a' || before == ':' || before == '=')) {
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

    /// Four rows with (0, 0, 0, 1) for the last row or column are one position; three that are at right
    /// angles and 1 long are a rotation.
    static void positions_of_matrices(std::vector<LogVector>& found) {
        const auto sized = [&](std::size_t at, std::size_t size) {
            std::size_t rows = 0;
            while (at + rows < found.size() && rows < size && found[at + rows].numbers.size() == size &&
                   (rows == 0 || found[at + rows].words.empty()))
                ++rows;
            return rows == size;
        };
        for (std::size_t at = 0; at < found.size(); ++at) {
            const auto number = [&](std::size_t row, std::size_t column) {
                return found[at + row].numbers[column];
            };
            if (sized(at, 4) && number(3, 3) == 1.0) {
                const auto zero = [](double a, double b, double c) {
                    return a == 0.0 && b == 0.0 && c == 0.0;
                };
                if (zero(number(3, 0), number(3, 1), number(3, 2)))
                    found[at].numbers = {number(0, 3), number(1, 3), number(2, 3)};
                else if (zero(number(0, 3), number(1, 3), number(2, 3)))
                    found[at].numbers = {number(3, 0), number(3, 1), number(3, 2)};
                else
                    continue;
                found[at].matrix = true;
                const auto rest = found.begin() + static_cast<std::ptrdiff_t>(at + 1);
                found.erase(rest, rest + 3);
            } else if (sized(at, 3)) {
                bool rotates = true;
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t j = i; j < 3; ++j) {
                        double product = 0.0;
                        for (std::size_t k = 0; k < 3; ++k) product += number(i, k) * number(j, k);
                        rotates = rotates && std::abs(product - (i == j ? 1.0 : 0.0)) < 5e-3;
                    }
                const auto begin = found.begin() + static_cast<std::ptrdiff_t>(at);
                if (rotates) found.erase(begin, begin + 3);
            }
        }
    }

    /// A number, with its unit or in a constructor: 1.5, 1.5m, np.float64(1.5), array(1.5, dtype=float32).
    std::optional<double> number_at(std::size_t& at) const {
        const bool made = is(at, 'a') && is(at + 1, '(') && is(at + 2, '0');
        std::size_t here = made ? at + 2 : at;
        if (!is(here, '0')) return std::nullopt;
        const double value = tokens_[here++].value;
        if (made) {
            if (is(here, ',') && is(here + 1, 'a') && is(here + 2, '=') && is(here + 3, 'a')) here += 4;
            if (!is(here++, ')')) return std::nullopt;
        } else if (is(here, 'a') && tokens_[here].text.size() <= 2 &&
                   (!tokens_[here].spaced || is(here + 1, ',') || is(here + 1, ')') || is(here + 1, ']'))) {
            ++here;
        }
        at = here;
        return value;
    }

    /// X=1.0 Y=2.0 Z=3.0 [W=1.0], or W first; each may have the point's name: elbow.x=1.0 elbow.y=2.0
    bool named(std::size_t at, std::size_t& end, std::vector<double>& numbers, std::string_view& name) {
        if (!is(at, 'a')) return false;
        const std::string_view text = tokens_[at].text;
        name = text.substr(0, text.size() - 1);
        if (!name.empty() && name.back() != '.' && name.back() != '_') return false;
        const auto axis = [](std::string_view word) { return static_cast<char>(word.back() | 0x20); };
        if (axis(text) != 'x' && axis(text) != 'w') return false;
        const bool w_first = axis(text) == 'w';
        std::size_t here = at;
        for (const char letter : std::string_view(w_first ? "wxyz" : "xyzw")) {
            std::size_t next = here;
            while (!numbers.empty() && (is(next, ',') || is(next, ';') || is(next, '.'))) ++next;
            if (!is(next, 'a') || tokens_[next].text.size() != text.size() ||
                axis(tokens_[next].text) != letter || !tokens_[next].text.starts_with(name))
                break;
            ++next;
            if (is(next, '=') || is(next, ':')) ++next;
            const auto number = number_at(next);
            if (!number) break;
            numbers.push_back(*number);
            here = next;
        }
        if (numbers.size() < (w_first ? 4 : 3)) {
            numbers.clear();
            return false;
        }
        if (w_first) std::rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
        const bool braced = at > 0 && is(at - 1, '{'), equals = is(at + 1, '='),
                   tight = !tokens_[at + 2].spaced;
        if (text == "X" && equals && tight && !braced) trace_.engine = Engine::Unreal;
        if (text == "X" && !equals && braced) trace_.engine = tight ? Engine::Xna : Engine::Babylon;
        end = here;
        return true;
    }

    /// 1.0 2.0 3.0, after a name and a colon or equals sign, or beside a pipe. Unreal's transforms are
    /// 1.0,2.0,3.0|10.0,20.0,30.0|1.0,1.0,1.0.
    bool bare(std::size_t at, std::size_t& end, std::vector<double>& numbers) {
        const char before = at == 0 ? '|' : at > from_ ? tokens_[at - 1].kind : ' ';
        if (!is(at, '0') || (before != ':' && before != '=' && before != '|' && before != 'a')) return false;
        std::size_t broken = 0;  // have a decimal point
        bool joined = false;
        for (std::size_t next = at; is(next, '0');) {
            broken += !tokens_[next].is_whole();
            numbers.push_back(*number_at(next));
            end = next;
            const bool pipe = is(next, '|') && !tokens_[next].spaced && numbers.size() % 3 == 0;
            joined = joined || pipe;
            if (is(next, ',') || pipe) ++next;
        }
        const std::vector<LogWord> words = words_before(at);
        const bool beside = (at > 0 && before == '|') || is(end, '|');
        const auto is_name = [&](std::size_t last) {
            return words.size() >= last && !words[words.size() - last].is_number();
        };
        const bool named = is_name(1) || is_name(2);
        const bool fits = joined ? numbers.size() == 9
                                 : (numbers.size() == 3 || numbers.size() == 4) && (beside || named) &&
                                       broken >= (before == 'a' ? numbers.size() : 1);
        if (!fits) numbers.clear();
        return fits;
    }

    /// (1, 2, 3), [1, 2, 3], {1, 2, 3} or <1, 2, 3>, of three or four numbers; or rows of them, [1 2 3; 4 5
    /// 6]. Or a pose: a position and a unit quaternion, or p[...] as Universal Robots prints it.
    bool bracketed(std::size_t at, std::size_t& end, std::vector<std::vector<double>>& rows) {
        constexpr std::string_view open = "([{<", close = ")]}>";
        const std::size_t kind = open.find(tokens_[at].kind);
        if (kind == open.npos) return false;
        std::size_t here = at + 1;
        while (const auto number = number_at(here)) {
            rows.back().push_back(*number);
            if (is(here, ';') && rows.back().size() >= 3) rows.emplace_back();
            if (is(here, ',') || is(here, ';')) ++here;
        }
        const std::string_view word =
            at > from_ && is(at - 1, 'a') ? tokens_[at - 1].text : std::string_view();
        const std::vector<double>& n = rows[0];
        const bool pose = rows.size() == 1 &&
                          (n.size() == 6 ? word == "p" && is(at, '[')
                                         : n.size() == 7 && std::abs(n[3] * n[3] + n[4] * n[4] + n[5] * n[5] +
                                                                     n[6] * n[6] - 1.0) < 0.02);
        const auto three_or_four = [](const auto& row) { return row.size() == 3 || row.size() == 4; };
        if (!is(here, close[kind]) || !(pose || std::ranges::all_of(rows, three_or_four))) {
            rows.assign(1, {});
            return false;
        }
        end = here + 1;
        const std::string type = lower_case(word);
        const bool single = tokens_[here - 1].text.ends_with('f');
        if (type == "vector" && (kind == 0))
            trace_.engine = Engine::Blender;
        else if (type == "fvector")
            trace_.engine = Engine::Unreal;
        else if (type == "hou.vector3")
            trace_.engine = Engine::Houdini;
        else if (type == "vector3")
            trace_.engine =
                single || (at > 1 && tokens_[at - 2].text == "new") ? Engine::Unity : Engine::Godot;
        return true;
    }

    std::vector<LogToken> tokens_;
    RawTrace& trace_;
    std::size_t from_ = 0;  ///< the token after the vector before
};

}  // namespace

std::vector<LogVector> vectors_in(std::string_view line, RawTrace& trace) {
    return Scanner(line, trace).all();
}

}  // namespace tendril::app
