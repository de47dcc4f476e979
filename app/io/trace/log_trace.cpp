// Traces in any text: vectors as programs print them, with words around them.
//
// A line with two joints or more is a frame; a line with a target or a pole target alone belongs to it. Where
// lines have one vector each, the joints of a frame follow one another; a name that comes again, or between
// vectors without names a line without any, begins the next frame. Lines are joined where a bracket stays
// open, as in a printed array or matrix, and where x, y and z have a line each, as in YAML; there, --- parts
// frames. Names in front of the vectors say which are targets and pole targets, and which are no positions.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "app/document/text.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

/// The words before a vector.
struct Words {
    std::string label{};  ///< "elbow" in "elbow = new Vector3", in lower case; may be empty
    Meaning meaning = Meaning::Joint;
    bool is_position = true;
    char letter = 0;  ///< the word next to the vector, if it is one: "p=("
};

/// Three or four numbers.
struct Found : Words {
    std::vector<double> numbers{};
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

enum Says : unsigned {
    NoName = 1,      ///< a constructor, or what every name may have behind it
    Position = 2,    ///< the numbers are one
    NoPosition = 4,  ///< they are something else
    Alone = 8        ///< only if it is a word of its own: "r", and not "hand_r"
};

unsigned says(const std::string& word) {
    static const auto words = [] {
        std::map<std::string, unsigned> all;
        for (const auto& [says, list] : std::initializer_list<std::pair<unsigned, const char*>>{
                 {NoName,
                  "fvector vector3 vector new vec3 dvec3 float3 double3 v array hou np gf vec3d vec3f "
                  "lpoint3f lvecbase3f lvector3f tensor numpy point3 4x4 mat4 at is was now to set world "
                  "global xyz"},
                 {NoName | Position | Alone, "p t"},
                 {NoName | NoPosition | Alone, "r s q v w up"},
                 {NoName | Position, "position pos location loc translation"},
                 {Position, "positions point points target goal joint joints pole origin"},
                 {NoName | NoPosition,
                  "quat fquat quaternion matrix rotation rotations rot orientation orient rpy euler angle "
                  "angles degree degrees deg radian radians rad scale scaling velocity vel speed angular "
                  "linear acceleration accel normal tangent force torque covariance color colour size "
                  "extents gravity mat3 mat3x3 basis scale3d fwd forward dir direction axis omega local"}}) {
            std::istringstream in(list);
            for (std::string each; in >> each;) all[each] = says;
        }
        return all;
    }();
    const auto found = words.find(word);
    return found == words.end() ? 0 : found->second;
}

/// Whether a word or a part of it, PoleTarget or pole_target, the last one first, says what numbers are.
std::optional<bool> says_position(std::string_view word) {
    for (bool whole = true; !word.empty(); whole = false) {
        std::size_t begin = word.size();
        while (begin > 0 && word[begin - 1] != '_') {
            --begin;
            const bool capital = word[begin] >= 'A' && word[begin] <= 'Z';
            if (capital && begin > 0 && word[begin - 1] >= 'a' && word[begin - 1] <= 'z') break;
        }
        const unsigned said = says(lower_case(word.substr(begin)));
        const bool counts = (said & Alone) == 0 || (begin == 0 && whole);
        if (counts && (said & (Position | NoPosition)) != 0) return (said & Position) != 0;
        word = word.substr(0, begin > 0 && word[begin - 1] == '_' ? begin - 1 : begin);
    }
    return std::nullopt;
}

/// Reads from the last word to the first. A number ends them, unless it is the index of a word: joint 1,
/// joint[1].
Words words_before(std::string_view text) {
    constexpr std::size_t farthest = 1000;  // characters; else a long line takes the square of its length
    if (text.size() > farthest) text.remove_prefix(text.size() - farthest);
    Words found;
    // quat(1.0, {0, 0, 0}): one of its numbers stands before the vector.
    if (const std::size_t open = text.rfind('('); open != text.npos) {
        std::string_view inside = text.substr(open + 1);
        if (take_number(inside) && inside.starts_with(',') && inside.find_first_not_of(" ,") == inside.npos)
            text = text.substr(0, open);
    }
    std::string kind, index;
    bool named = false;
    std::optional<bool> position;
    for (std::size_t last = text.size(); !named || !position;) {
        std::size_t end = last;
        while (end > 0 && !is_word(text[end - 1])) --end;
        if (end == 0) break;
        std::size_t begin = end;
        while (begin > 0 && is_word(text[begin - 1])) --begin;
        const char* const joins = index.empty() ? " =:<([{\"'\t]." : " [#";
        std::string_view between = text.substr(end, last - end);
        if (between.starts_with("()")) between.remove_prefix(2);  // GetTarget()
        const bool joined = between.find_first_not_of(joins) == between.npos;
        if (end - begin == 1 && begin > 1 && text[begin - 1] == '.' && !is_digit(text[begin]))
            for (--begin; begin > 0 && is_word(text[begin - 1]);) --begin;  // hand.R
        const std::string word = lower_case(text.substr(begin, end - begin));
        if (last == text.size() && word.size() == 1 && !is_digit(word[0])) found.letter = word[0];
        const bool number = word.find_first_not_of("0123456789_") == word.npos;
        if (number ? named || !joined || !index.empty() : !named && !joined && !index.empty()) break;
        named = named || !joined;
        if (number) {
            index = word;
        } else if (!named) {
            const unsigned said = says(word);
            if (index.empty() && (said & NoName) != 0) {
                if ((said & Position) != 0) kind = word;
            } else {
                found.label = word + index;
                named = true;
            }
        }
        if (!position) position = says_position(text.substr(begin, end - begin));
        last = begin;
    }
    if (found.label.empty()) found.label = kind;
    found.meaning = meaning_of(found.label);
    found.is_position = position.value_or(true);
    return found;
}

bool is_number_start(char c) {
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
}

/// A number, or one in a constructor: np.float64(1.5), array(1.5, dtype=float32).
std::optional<double> take_printed(std::string_view& text) {
    if (const auto number = take_number(text)) return number;
    constexpr std::size_t longest = 16;  // "numpy.float64"
    std::size_t open = 0;
    while (open < std::min(text.size(), longest) && (is_word(text[open]) || text[open] == '.')) ++open;
    if (open == 0 || open == text.size() || text[open] != '(') return std::nullopt;
    std::string_view rest = text.substr(open + 1);
    const auto number = take_number(rest);
    constexpr std::string_view type = ", dtype=";
    if (number && rest.starts_with(type))
        for (rest.remove_prefix(type.size()); !rest.empty() && is_word(rest[0]);) rest.remove_prefix(1);
    if (!number || !rest.starts_with(')')) return std::nullopt;
    text = rest.substr(1);
    return number;
}

/// Finds vectors in one line.
class Scanner {
  public:
    Scanner(std::string_view text, RawTrace& trace) : text_(text), trace_(trace) {}

    std::vector<Found> all() {
        std::vector<Found> found;
        for (std::size_t at = 0; at < text_.size();) {
            std::size_t end = at;
            std::vector<std::vector<double>> rows(1);
            if (!named(at, end, rows[0]) && !bracketed(at, end, rows) && !bare(at, end, rows[0])) {
                ++at;
                continue;
            }
            Words words = words_before(text_.substr(from_, at - from_));
            // A rotation behind a target's position is the target's.
            if (words.label.empty() && !found.empty() &&
                (!words.is_position || rows[0].size() != found.back().numbers.size()))
                words.meaning = found.back().meaning;
            const std::vector<double> pose = rows[0].size() > 4 ? rows[0] : std::vector<double>();
            if (!pose.empty()) rows[0].resize(3);
            for (std::vector<double>& numbers : rows) found.push_back({words, std::move(numbers)});
            words.is_position = false;
            if (pose.size() == 7) found.push_back({words, {pose.begin() + 3, pose.end()}});
            at = end;
            from_ = end;
        }
        positions_of_matrices(found);
        return found;
    }

  private:
    /// Four rows with (0, 0, 0, 1) for the last row or column are one position; three that are at right
    /// angles and 1 long are a rotation.
    static void positions_of_matrices(std::vector<Found>& found) {
        const auto sized = [&](std::size_t at, std::size_t rows, std::size_t numbers) {
            return at + rows <= found.size() &&
                   std::all_of(found.begin() + static_cast<std::ptrdiff_t>(at),
                               found.begin() + static_cast<std::ptrdiff_t>(at + rows),
                               [&](const Found& each) { return each.numbers.size() == numbers; });
        };
        const auto number = [&](std::size_t row, std::size_t column) { return found[row].numbers[column]; };
        for (std::size_t at = 0; at < found.size(); ++at) {
            if (sized(at, 4, 4) && number(at + 3, 3) == 1.0) {
                bool by_row = true, by_column = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    by_row = by_row && number(at + 3, i) == 0.0;
                    by_column = by_column && number(at + i, 3) == 0.0;
                }
                if (!by_row && !by_column) continue;
                found[at].numbers =
                    by_row ? std::vector{number(at, 3), number(at + 1, 3), number(at + 2, 3)}
                           : std::vector{number(at + 3, 0), number(at + 3, 1), number(at + 3, 2)};
                found[at].is_position = true;
                found.erase(found.begin() + static_cast<std::ptrdiff_t>(at + 1),
                            found.begin() + static_cast<std::ptrdiff_t>(at + 4));
            } else if (sized(at, 3, 3)) {
                bool rotates = true;
                for (std::size_t i = 0; i < 3; ++i)
                    for (std::size_t j = i; j < 3; ++j) {
                        double product = 0.0;
                        for (std::size_t k = 0; k < 3; ++k) product += number(at + i, k) * number(at + j, k);
                        rotates = rotates && std::abs(product - (i == j ? 1.0 : 0.0)) < 5e-3;
                    }
                for (std::size_t i = 0; rotates && i < 3; ++i) found[at + i].is_position = false;
            }
        }
    }

    std::size_t skip(std::size_t at, std::string_view what) const {
        while (at < text_.size() && what.find(text_[at]) != what.npos) ++at;
        return at;
    }

    /// X=1.0 Y=2.0 Z=3.0 [W=1.0], or W first; each may have the point's name: elbow.x=1.0 elbow.y=2.0
    bool named(std::size_t at, std::size_t& end, std::vector<double>& numbers) {
        const bool joined = at > 0 && (text_[at - 1] == '.' || text_[at - 1] == '_');
        if (at > 0 && is_word(text_[at - 1]) && !joined) return false;
        std::size_t begin = at;
        while (joined && begin > from_ && (is_word(text_[begin - 1]) || text_[begin - 1] == '.')) --begin;
        const std::string_view name = text_.substr(begin, at - begin);
        const bool w_first = text_[at] == 'w' || text_[at] == 'W';
        const std::string_view lower = w_first ? "wxyz" : "xyzw", upper = w_first ? "WXYZ" : "XYZW";
        std::size_t here = at;
        bool equals = false, tight = false;
        for (std::size_t i = 0; i < 4; ++i) {
            std::size_t start = skip(here, i == 0 ? "" : " ,;\t\"'");
            if (i > 0 && joined && text_.substr(start).starts_with(name)) start += name.size();
            if (start >= text_.size() || (text_[start] != lower[i] && text_[start] != upper[i])) break;
            const std::size_t sign = skip(start + 1, " \"'");
            if (sign >= text_.size() || (text_[sign] != '=' && text_[sign] != ':')) break;
            const std::size_t value = skip(sign + 1, " ");
            if (i == 0) {
                equals = text_[sign] == '=';
                tight = value == start + 2;
            }
            std::string_view rest = text_.substr(value);
            const auto number = take_printed(rest);
            if (!number) break;
            numbers.push_back(*number);
            here = text_.size() - rest.size();
        }
        if (numbers.size() < (w_first ? 4 : 3)) {
            numbers.clear();
            return false;
        }
        if (w_first) std::rotate(numbers.begin(), numbers.begin() + 1, numbers.end());
        const std::size_t before = at > 0 ? text_.find_last_not_of(' ', at - 1) : text_.npos;
        const bool braced = before != text_.npos && text_[before] == '{';
        if (text_[at] == 'X' && equals && tight && !braced) trace_.engine = Engine::Unreal;
        if (text_[at] == 'X' && !equals && braced) trace_.engine = tight ? Engine::Xna : Engine::Babylon;
        end = here;
        return true;
    }

    /// 1.0 2.0 3.0, after a name and a colon or equals sign, or beside a pipe.
    bool bare(std::size_t at, std::size_t& end, std::vector<double>& numbers) {
        if (!is_number_start(text_[at])) return false;
        const std::size_t sign = at == 0 ? text_.npos : text_.find_last_not_of(" \t", at - 1);
        const char before = sign == text_.npos ? '|' : text_[sign];
        if ((sign != text_.npos && sign < from_) || (before != ':' && before != '=' && before != '|'))
            return false;
        std::size_t here = at;
        for (;;) {
            std::string_view rest = text_.substr(here);
            const auto number = take_printed(rest);
            if (!number) break;
            numbers.push_back(*number);
            end = text_.size() - rest.size();
            here = skip(end, " \t");
            if (here < text_.size() && text_[here] == ',') here = skip(here + 1, " \t");
            if (here == end) break;
        }
        const auto named = [&] {
            const Words words = words_before(text_.substr(from_, at - from_));
            return !words.label.empty() || !words.is_position;
        };
        const bool fits =
            (numbers.size() == 3 || numbers.size() == 4) &&
            text_.substr(at, end - at).find('.') != text_.npos &&
            ((sign != text_.npos && before == '|') || (here < text_.size() && text_[here] == '|') || named());
        if (!fits) numbers.clear();
        return fits;
    }

    /// A position and a unit quaternion, or p[...] as Universal Robots prints it: and a rotation vector.
    bool is_pose(std::size_t at, const std::vector<double>& n) const {
        if (n.size() == 6) return at > 0 && text_[at - 1] == 'p' && text_[at] == '[';
        return n.size() == 7 && std::abs(n[3] * n[3] + n[4] * n[4] + n[5] * n[5] + n[6] * n[6] - 1.0) < 0.02;
    }

    /// (1, 2, 3), [1, 2, 3], {1, 2, 3} or <1, 2, 3>, of three or four numbers; or rows of them, [1 2 3; 4 5
    /// 6].
    bool bracketed(std::size_t at, std::size_t& end, std::vector<std::vector<double>>& rows) {
        constexpr std::string_view open = "([{<", close = ")]}>";
        const std::size_t kind = open.find(text_[at]);
        if (kind == open.npos) return false;
        std::size_t here = skip(at + 1, " ");
        bool single = false;  // 1.0f
        while (here < text_.size()) {
            std::string_view rest = text_.substr(here);
            const auto number = take_printed(rest);
            if (!number) break;
            rows.back().push_back(*number);
            here = text_.size() - rest.size();
            single = single || text_[here - 1] == 'f' || text_[here - 1] == 'F';
            const std::size_t next = skip(here, " \t");
            if (next < text_.size() && (text_[next] == ',' || text_[next] == ';')) {
                here = skip(next + 1, " \t");
                if (text_[next] == ';' && rows.back().size() >= 3) rows.emplace_back();
            } else if (next == here || next >= text_.size() || text_[next] == close[kind]) {
                here = next;
                break;
            } else {
                here = next;
            }
        }
        const bool fit =
            std::ranges::all_of(rows, [](const auto& row) { return row.size() == 3 || row.size() == 4; }) ||
            (rows.size() == 1 && is_pose(at, rows[0]));
        if (here >= text_.size() || text_[here] != close[kind] || !fit) {
            rows.assign(1, {});
            return false;
        }
        end = here + 1;
        const std::string before =
            lower_case(text_.substr(at < 16 ? 0 : at - 16, std::min<std::size_t>(at, 16)));
        if (before.ends_with("<vector ") || before.ends_with("vector("))
            trace_.engine = before.ends_with("fvector(") ? Engine::Unreal : Engine::Blender;
        else if (before.ends_with("new vector3") || (before.ends_with("vector3") && single))
            trace_.engine = Engine::Unity;
        else if (before.ends_with("hou.vector3 "))
            trace_.engine = Engine::Houdini;
        else if (before.ends_with("vector3"))
            trace_.engine = Engine::Godot;
        else if (before.ends_with("fvector"))
            trace_.engine = Engine::Unreal;
        return true;
    }

    std::string_view text_;
    RawTrace& trace_;
    std::size_t from_ = 0;  ///< the end of the vector before
};

/// The brackets that are not closed yet, line by line.
class OpenBrackets {
  public:
    void add(std::string_view line) {
        while (!line.empty()) {
            const char c = line[0];
            const bool matrix = line.starts_with("<Matrix");
            if (opened_.empty()) any_ = false, only_numbers_ = true;
            const bool closes =
                !opened_.empty() && (opened_.back() == '<' ? c == '>' : c == ')' || c == ']' || c == '}');
            if (c == '(' || c == '[' || c == '{' || matrix) {
                opened_.push_back(c);
            } else if (closes) {
                opened_.pop_back();
            } else if (!opened_.empty() && only_numbers_) {
                if (take_printed(line)) {
                    any_ = true;
                    continue;
                }
                only_numbers_ = std::string_view(" \t,;)]}").find(c) != std::string_view::npos;
            }
            line.remove_prefix(1);
        }
    }
    /// Whether nothing but numbers follows the first of them.
    bool hold_numbers() const {
        return !opened_.empty() && (opened_.front() == '<' || (any_ && only_numbers_));
    }

  private:
    std::string opened_;
    bool any_ = false, only_numbers_ = true;
};

class LogTrace final : public RawTrace {
  public:
    LogTrace(std::istream& in, std::string first, std::size_t at) : in_(in), text_(std::move(first)) {
        line = at;
    }

    bool next(RawFrame& frame) override {
        frame = std::move(ahead_);
        ahead_ = {};
        while (read_joined())
            if (take(frame)) return true;
        if (!frame.joints.empty()) return true;
        if (!any_)
            throw std::runtime_error(
                "has no positions in it: expected vectors such as (1, 2, 3) or X=1 Y=2 Z=3");
        return false;
    }

  private:
    bool read_next() {
        if (waiting_) return waiting_ = false, true;
        if (later_.empty()) return read_line(in_, text_, line);
        text_ = std::move(later_.front());
        later_.pop_front();
        ++line;
        return true;
    }
    /// The next line into `text_`, with those that continue it.
    bool read_joined() {
        if (!read_next()) return false;
        constexpr std::size_t longest = 1u << 20;
        const char begun = component_of(text_);
        const bool component = begun != 0;
        if (component) {
            if (!documents_) find_documents();
            text_.insert(0, before_ + ' ');
        }
        OpenBrackets brackets;
        brackets.add(text_);
        std::string whole = std::move(text_);
        while (whole.size() < longest && (component || brackets.hold_numbers()) && read_next()) {
            const char name = component_of(text_);
            if (name == 0 ? !brackets.hold_numbers() : name == begun && name != '#') {
                later_.push_front(std::move(text_));
                --line;
                break;
            }
            brackets.add(text_);
            whole += ' ' + text_;
        }
        text_ = std::move(whole);
        // Numbers alone, as a column of Eigen: in brackets.
        if (component && text_.find_first_of(":=", before_.size()) == text_.npos)
            text_ = before_ + " (" + text_.substr(before_.size() + 1) + ')';
        before_ = !component && text_.size() < 200 && text_.ends_with(':') ? text_ : std::string();
        return true;
    }
    /// x, y, z or w of a line such as "  x: 0.3", '#' of one that is a number alone, else 0.
    static char component_of(std::string_view text) {
        const std::size_t begin = text.find_first_not_of(" \t");
        if (begin == text.npos) return 0;
        text.remove_prefix(begin);
        if (text.starts_with("- ")) text.remove_prefix(2);
        char name = '#';
        if (text.size() > 2 && text[0] >= 'w' && text[0] <= 'z' && text[1] == ':') {
            name = text[0];
            text.remove_prefix(text.find_first_not_of(' ', 2) == text.npos ? 2
                                                                           : text.find_first_not_of(' ', 2));
        }
        const bool number = take_printed(text) && text.find_first_not_of(" \t") == text.npos;
        return number ? name : '\0';
    }
    /// Reads ahead, as far as memory may grow, to see whether --- parts the frames.
    void find_documents() {
        constexpr std::size_t farthest = 1u << 20;  // bytes
        const auto parts = [](const std::string& each) { return each.starts_with("---"); };
        documents_ = std::ranges::any_of(later_, parts);
        std::string text;
        std::size_t at = line + later_.size(), bytes = 0;
        while (!*documents_ && bytes < farthest && read_line(in_, text, at)) {
            documents_ = parts(text);
            bytes += text.size() + 1;
            later_.push_back(std::move(text));
        }
        if (*documents_) engine = Engine::Ros;
    }

    /// Adds a line's vectors to the frame. True if the line begins the next one, which is then in ahead_.
    bool take(RawFrame& frame) {
        std::vector<Found> found = Scanner(text_, *this).all();
        read_stamp();
        const bool ends =
            documents_.value_or(false) ? text_.starts_with("---") : labels_.empty() && !by_line_;
        if (found.empty()) return ends && frame.joints.size() >= (documents_ ? 1u : 2u);
        sort_fours(found);
        any_ = true;
        name_by_letters(found);
        leave_out_attributes(found);
        const auto joints = std::ranges::count_if(found, is_joint);
        if (joints >= 2) by_line_ = true;
        const bool by_document = documents_.value_or(false);
        RawFrame* into = &frame;
        if (by_line_ && !by_document && joints > 0 && !frame.joints.empty()) into = &ahead_;
        for (const Found& each : found) {
            const bool again = each.is_position && each.numbers.size() == 3 && labels_.contains(each.label);
            if (!by_line_ && !by_document && again && !into->joints.empty()) {
                into = &ahead_;
                labels_.clear();
            }
            add(*into, each);
        }
        return into == &ahead_;
    }
    /// "[0.033] ...", "time: 0.033", "12:00:01.033 ..."; ROS has "sec: 12" and "nanosec: 345".
    void read_stamp() {
        constexpr std::size_t farthest = 60;  // characters
        std::string_view text = std::string_view(text_).substr(0, farthest);
        text.remove_prefix(std::min(text.find_first_not_of(" \t[("), text.size()));
        const std::string_view all = text;
        if (auto number = take_number(text)) {
            for (; text.starts_with(':') && text.size() > 1 && is_digit(text[1]);)
                text.remove_prefix(1), number = 60.0 * *number + take_number(text).value_or(0.0);
            const bool whole = all.substr(0, all.size() - text.size()).find('.') == all.npos;
            if (!whole && !text.empty() && std::string_view(" ])\t:s|").find(text[0]) != text.npos)
                stamp_ = number;
            return;
        }
        while (!text.empty()) {
            std::size_t end = 0;
            while (end < text.size() && is_word(text[end])) ++end;
            const std::string word = lower_case(text.substr(0, end));
            const double unit = end > 0 ? time_unit(word) : 0.0;
            text.remove_prefix(std::max<std::size_t>(end, 1));
            std::string_view rest = text.substr(std::min(text.find_first_not_of(" =:"), text.size()));
            const auto number = rest.size() < text.size() ? take_number(rest) : std::nullopt;
            if (number && unit > 0.0) stamp_ = *number * unit;
            if (number && (word == "sec" || word == "secs")) stamp_ = *number;
            if (number && (word == "nanosec" || word == "nsecs"))
                stamp_ = stamp_.value_or(0.0) + 1e-9 * *number;
            if (number) return;
        }
    }
    /// p (...) q (...) r (...): letters that stand once each, with no other names, are the joints' names.
    static void name_by_letters(std::vector<Found>& found) {
        std::set<char> letters;
        std::size_t joints = 0;
        for (const Found& each : found) {
            if (each.meaning != Meaning::Joint || each.numbers.size() != 3) continue;
            if (each.letter == 0 || each.label.size() > 1) return;
            letters.insert(each.letter);
            ++joints;
        }
        if (joints < 2 || letters.size() < joints) return;
        for (Found& each : found)
            if (each.letter != 0) each.label = each.letter, each.is_position = true;
    }
    static bool is_joint(const Found& found) {
        return found.is_position && found.meaning == Meaning::Joint && found.numbers.size() == 3;
    }
    /// A label that repeats in a line beside two or more named joints is an attribute of each joint: "elbow
    /// (...) side (...) hand (...) side (...)". Where labels alternate, "a (...) b (...) a (...) b (...)",
    /// the first one labels the positions.
    void leave_out_attributes(std::vector<Found>& found) {
        std::map<std::string, std::size_t> counts;
        std::vector<std::string> labels;
        for (const Found& each : found)
            if (is_joint(each)) ++counts[labels.emplace_back(each.label)];
        const auto own = std::ranges::count_if(
            counts, [](const auto& each) { return each.second == 1 && !each.first.empty(); });
        const std::size_t turn = counts.size();
        bool turns = turn > 1 && labels.size() >= 2 * turn && labels.size() % turn == 0;
        for (std::size_t i = turn; turns && i < labels.size(); ++i) turns = labels[i] == labels[i - turn];
        std::erase_if(found, [&](const Found& each) {
            if (!is_joint(each) || each.label.empty()) return false;
            const bool out = turns ? each.label != labels.front() : own >= 2 && counts[each.label] >= 2;
            if (out && left_out_.insert(each.label).second)
                notes.push_back("the vectors of \"" + printable(each.label) +
                                "\" were left out: every joint has one");
            return out;
        });
    }
    /// Four numbers are a quaternion if they are 1 long, or a point if the last is 1: in all of them, then.
    void sort_fours(std::vector<Found>& found) {
        const auto length = [](const std::vector<double>& n) {
            return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3]);
        };
        const auto point = [](const Found& each) {
            return each.is_position && each.numbers.size() == 4 && each.numbers[3] == 1.0;
        };
        for (const Found& each : found)
            homogeneous_ = homogeneous_ || (point(each) && length(each.numbers) > 1.02);
        for (Found& each : found)
            if (homogeneous_ && point(each)) each.numbers.pop_back();
        std::erase_if(found, [&](const Found& each) {
            return each.numbers.size() == 4 && !(std::abs(length(each.numbers) - 1.0) <= 0.02);
        });
    }

    void add(RawFrame& frame, const Found& found) {
        if (!found.is_position && found.numbers.size() == 3) return;
        if (frame.line == 0) frame.line = line, frame.time = stamp_;
        const auto& n = found.numbers;
        if (n.size() == 4) {
            if (found.meaning == Meaning::Joint && frame.rotations.size() < max_trace_joints)
                frame.rotations.emplace_back(n[0], n[1], n[2], n[3]);
            return;
        }
        const glm::dvec3 at(n[0], n[1], n[2]);
        if (!by_line_ && !found.label.empty()) labels_.insert(found.label);
        if (found.meaning == Meaning::Target)
            frame.target = at;
        else if (found.meaning == Meaning::Pole)
            frame.pole = at;
        else if (frame.joints.size() == max_trace_joints)
            fail_line(line, "found more than 4096 joints");
        else
            frame.joints.push_back(at);
    }

    std::istream& in_;
    std::string text_;
    RawFrame ahead_;
    std::set<std::string> labels_;    ///< of the present frame
    std::set<std::string> left_out_;  ///< labels
    std::string before_;              ///< the line before, if it ends with a colon
    std::deque<std::string> later_;   ///< lines that were read ahead
    std::optional<bool>
        documents_{};                ///< whether --- parts the frames; unknown before the first x: on a line
    std::optional<double> stamp_{};  ///< seconds, the latest that was read
    bool waiting_ = true, by_line_ = false, any_ = false, homogeneous_ = false;
};

}  // namespace

Meaning meaning_of(std::string_view name) {
    const auto has = [&](auto... words) { return ((name.find(words) != name.npos) || ...); };
    if (has("pole", "hint")) return Meaning::Pole;
    if (has("target", "tgt", "goal", "aim", "cmd", "command", "desired", "setpoint", "moving"))
        return Meaning::Target;
    const bool tip = has("endeffector", "end_effector", "end effector", "end-effector");
    return has("effector") && !tip ? Meaning::Target : Meaning::Joint;
}

bool names_no_position(std::string_view text) {
    return !words_before(text).is_position;
}

std::unique_ptr<RawTrace> open_log_trace(std::istream& in, std::string first, std::size_t line) {
    return std::make_unique<LogTrace>(in, std::move(first), line);
}

}  // namespace tendril::app
