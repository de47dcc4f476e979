// Traces in any text: vectors as programs print them, with words around them.
//
// No maker's names are known here. The start of the file shows how its lines repeat themselves, as in mining
// templates of logs (He et al., Drain, ICWS 2017): words that stand before several vectors of a line, or
// before those of lines that differ in the words before them, are no labels. They are a type if they stand
// before every vector, Vector3 or SIMD3<Float>, else a kind that every joint has: pos, rot. The word before
// them is the label. Kinds and labels say which vectors are targets and pole targets, and which no positions.
//
// A line with two joints or more is a frame; a line with a target or a pole target alone belongs to the one
// before it or, if the file begins with such a line, after it. Where lines have one vector each, the joints
// of a frame follow one another; a name that comes again, or between vectors without names a line without
// any, begins the next frame. Lines are joined where a bracket stays open, as in a printed array or matrix,
// and where x, y and z have a line each; there, --- parts frames.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "app/document/text.hpp"
#include "app/io/trace/log_vectors.hpp"

namespace tendril::app {
namespace {

enum Says : unsigned {
    Position = 1,    ///< the numbers are one
    NoPosition = 2,  ///< they are something else
    AsKind = 4       ///< only if every joint has one: p=(...) r=(...), and not a joint that is called r
};

/// Whether a word or a part of it, PoleTarget or pole_target, the last one first, says what numbers are.
std::optional<bool> says_position(std::string_view word, bool kind) {
    static const auto words = [] {
        std::map<std::string, unsigned> all;
        for (const auto& [says, list] : std::initializer_list<std::pair<unsigned, const char*>>{
                 {Position | AsKind, "p t"},
                 {NoPosition | AsKind, "r s q v w up"},
                 {Position,
                  "position pos location loc translation positions point points target goal joint joints "
                  "pole origin"},
                 {NoPosition,
                  "quat fquat quaternion matrix rotation rotations rot orientation orient rpy euler angle "
                  "angles degree degrees deg radian radians rad scale scaling velocity vel speed angular "
                  "linear acceleration accel normal tangent force torque covariance color colour size "
                  "extents gravity mat3 mat3x3 basis scale3d fwd forward dir direction axis omega local"}}) {
            std::istringstream in(list);
            for (std::string each; in >> each;) all[each] = says;
        }
        return all;
    }();
    for (bool whole = true; !word.empty(); whole = false) {
        std::size_t begin = word.size();
        while (begin > 0 && word[begin - 1] != '_') {
            --begin;
            const bool capital = word[begin] >= 'A' && word[begin] <= 'Z';
            if (capital && begin > 0 && word[begin - 1] >= 'a' && word[begin - 1] <= 'z') break;
        }
        const auto said = words.find(lower_case(word.substr(begin)));
        if (said != words.end() && ((said->second & AsKind) == 0 || (kind && whole && begin == 0)))
            return (said->second & Position) != 0;
        word = word.substr(0, begin > 0 && word[begin - 1] == '_' ? begin - 1 : begin);
    }
    return std::nullopt;
}

/// A line, or some that belong together.
struct Record {
    std::size_t line = 0;
    std::optional<double> stamp{};  ///< seconds
    std::vector<LogVector> items{};
    bool parts = false, closes = false;  ///< begins with ---; has nothing but closing brackets

    std::string chain() const {
        return items[0].kind.empty() ? items[0].label : items[0].label + ' ' + items[0].kind;
    }
};

/// What the words before vectors are, learned from how they repeat.
class Schema {
  public:
    void learn(std::deque<Record>& records) {
        for (const Record& record : records)
            for (const LogVector& each : record.items)
                homogeneous_ = homogeneous_ || (is_point(each) && length(each.numbers) > 1.02);
        for (Record& each : records) sort_fours(each.items);
        constexpr std::size_t longest = 8;  // words of a type
        for (std::size_t depth = 0; depth < longest && learn(records, depth); ++depth) {
        }
    }

    void apply(std::vector<LogVector>& items) const {
        sort_fours(items);
        for (std::size_t i = 0; i < items.size(); ++i) name(items[i], i > 0 ? &items[i - 1] : nullptr);
    }

  private:
    /// The words of an item that are no label: how many, and as one text.
    std::pair<std::size_t, std::string> kind_of(const std::vector<LogWord>& words) const {
        std::string kind;
        for (std::size_t n = 0; n < words.size(); ++n) {
            std::string longer = words[words.size() - 1 - n].name + ' ' + kind;
            if (!kinds_.contains(longer)) return {n, kind};
            kind = std::move(longer);
        }
        return {words.size(), kind};
    }

    bool learn(const std::deque<Record>& records, std::size_t depth) {
        struct Seen {
            std::string key{}, before{}, rest{};
        };
        struct Count {
            std::size_t all = 0, shared = 0, numbered = 0, runs = 0;
            std::set<std::string> numbers{}, rests{};
            /// Indices come again; counted frames do not.
            bool indexed() const { return numbered <= 8 || 2 * numbers.size() <= numbered; }
        };
        std::map<std::string, Count> counts;
        std::vector<std::vector<Seen>> lines;
        std::vector<bool> differs;
        std::size_t all = 0;
        bool follows = false;  // the line before has a vector
        for (const Record& record : records) {
            std::vector<Seen> line;
            for (const LogVector& item : record.items) {
                if (item.numbers.size() != 3) continue;
                ++all;
                auto [n, kind] = kind_of(item.words);
                Seen& seen = line.emplace_back();
                if (n != depth || n == item.words.size()) continue;
                const auto rest = std::span(item.words).first(item.words.size() - n);
                seen.key = rest.back().name + ' ' + kind;
                Count& count = counts[seen.key];
                ++count.all;
                count.runs += follows;
                if (rest.size() > 1) seen.before = rest[rest.size() - 2].name;
                if (rest.size() > 1 && rest[rest.size() - 2].is_number()) {
                    ++count.numbered;
                    count.numbers.insert(seen.before);
                }
                for (const LogWord& each : rest.first(rest.size() - 1)) seen.rest += each.name + ' ';
                count.rests.insert(seen.rest);
            }
            follows = record.closes ? follows : !line.empty();
            if (!line.empty()) lines.push_back(std::move(line));
        }
        differs.resize(lines.size());
        const auto same_key = [](const Seen& a, const Seen& b) { return a.key == b.key; };
        const auto same = [&](const Seen& a, const Seen& b) {
            const bool numbers =
                !a.before.empty() && !b.before.empty() && is_digit(a.before[0]) && is_digit(b.before[0]);
            return a.key.empty() || a.before == b.before || (numbers && !counts[a.key].indexed());
        };
        for (std::size_t i = 1; i < lines.size(); ++i)
            if (std::ranges::equal(lines[i - 1], lines[i], same_key) &&
                !std::ranges::equal(lines[i - 1], lines[i], same))
                differs[i - 1] = differs[i] = true;
        for (std::size_t i = 0; i < lines.size(); ++i)
            for (const Seen& seen : lines[i])
                if (!seen.key.empty() &&
                    (differs[i] || std::ranges::count(lines[i], seen.key, &Seen::key) > 1))
                    ++counts[seen.key].shared;
        bool any = false;
        for (const auto& [key, count] : counts) {
            const bool common = 10 * count.all >= 9 * all;
            const bool parted =
                common && all > 1 && (count.rests.size() > 1 ? count.indexed() : 2 * count.runs >= count.all);
            if (2 * count.shared < count.all && !parted) continue;
            kinds_[key] = common;
            any = true;
        }
        return any;
    }

    void name(LogVector& item, const LogVector* before) const {
        const auto [n, kind] = kind_of(item.words);
        const auto rest = std::span(item.words).first(item.words.size() - n);
        const bool type = n > 0 && kinds_.at(kind);
        std::optional<bool> position;
        for (std::size_t i = 0; i < n && !position; ++i)
            position = says_position(item.words[item.words.size() - 1 - i].text, !type);
        if (!type) item.kind = kind;
        for (std::size_t i = rest.size(); i-- > 0;) {
            const LogWord& word = rest[i];
            if (i + 1 < rest.size() && (word.ends_phrase || (item.first && word.names))) break;
            if (!word.is_number()) item.phrase.insert(0, word.name + ' ');
            if (!position) position = says_position(word.text, false);
        }
        if (!rest.empty()) item.label = rest.back().name;
        if (!rest.empty() && rest.back().is_number())
            item.label = rest.size() > 1 && !rest[rest.size() - 2].is_number()
                             ? rest[rest.size() - 2].name + item.label
                             : "";
        item.phrase += item.kind;
        item.meaning = meaning_of(item.phrase);
        item.is_position = item.matrix || position.value_or(true);
        // A rotation behind a target's position is the target's.
        if (before && (rest.empty() ? !item.is_position || item.numbers.size() != before->numbers.size()
                                    : rest.size() == 1 && !item.is_position))
            item.meaning = before->meaning;
    }

    static double length(const std::vector<double>& n) {
        return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3]);
    }
    static bool is_point(const LogVector& each) { return each.numbers.size() == 4 && each.numbers[3] == 1.0; }
    /// Four numbers are a quaternion if they are 1 long, or a point if the last is 1: in all of them, then.
    void sort_fours(std::vector<LogVector>& items) const {
        for (LogVector& each : items)
            if (homogeneous_ && is_point(each)) each.numbers.pop_back();
        std::erase_if(items, [](const LogVector& each) {
            return each.numbers.size() == 4 && !(std::abs(length(each.numbers) - 1.0) <= 0.02);
        });
    }

    std::map<std::string, bool> kinds_;  ///< words that are no labels; whether they are before every vector
    bool homogeneous_ = false;
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
                if (take_number(line)) {
                    any_ = true;
                    continue;
                }
                only_numbers_ = std::string_view(" \t,;").find(c) != std::string_view::npos;
            }
            line.remove_prefix(1);
        }
    }
    bool any() const { return !opened_.empty(); }
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
    LogTrace(std::istream& in, std::string first, std::size_t at) : in_(in) {
        line = at - 1;
        later_.push_back(std::move(first));
        learn();
    }

    bool next(RawFrame& frame) override {
        for (Record record; ready_.empty(); take(record))
            if (!sample_.empty()) {
                record = std::move(sample_.front());
                sample_.pop_front();
            } else if (!read(record)) {
                finish();
                break;
            } else {
                schema_.apply(record.items);
            }
        if (ready_.empty()) return false;
        frame = std::move(ready_.front());
        ready_.pop_front();
        return true;
    }

  private:
    void learn() {
        constexpr std::size_t enough = 1u << 18, most = 1000;  // bytes; lines with vectors
        std::size_t vectors = 0;
        read_bytes_ = 0;
        for (Record record; vectors < most && read_bytes_ < enough && read(record);) {
            vectors += !record.items.empty();
            sample_.push_back(std::move(record));
        }
        schema_.learn(sample_);
        documents_ = components_ && std::ranges::any_of(sample_, &Record::parts);
        if (documents_) engine = Engine::Ros;
        std::map<std::size_t, std::size_t> counts;  // of lines with so many joints
        std::array<std::set<std::string>, 2> sides;
        two_sides_ = true;
        bool begun = false;
        for (Record& record : sample_) {
            schema_.apply(record.items);
            leave_out_attributes(record.items);
            const auto joints =
                static_cast<std::size_t>(std::ranges::count_if(record.items, &LogVector::is_joint));
            if (joints > 0) ++counts[joints];
            if (!begun && !record.items.empty()) leads_ = joints == 0;
            begun = begun || !record.items.empty();
            Sided side{2, {}};
            for (const LogVector& each : record.items) {
                const bool own = take_side(each, side);
                if (!own) side.part += '+';
                if (!each.is_joint()) continue;
                two_sides_ = two_sides_ && side.side < 2;
                if (two_sides_) sides[side.side].insert(side.part);
            }
        }
        two_sides_ = two_sides_ && sides[0].size() > 1 && sides[0] == sides[1];
        if (!two_sides_) find_chains();
        std::size_t whole = 0;
        for (const auto& [joints, lines] : counts) {
            if (joints < 2) continue;
            whole += lines;
            if (joints_ == 0 || lines > counts[joints_]) joints_ = joints;
        }
        by_line_ = !documents_ && whole > 0 && 10 * whole >= counts[1];
    }
    /// Lines of chains that take turns begin with their names: "leg 0: (...) (...)", "[arm] (...) (...)".
    void find_chains() {
        std::vector<std::string> names;
        for (const Record& record : sample_)
            if (std::ranges::count_if(record.items, &LogVector::is_joint) > 1)
                names.push_back(record.chain());
        const std::size_t turn =
            names.empty() ? 0
                          : static_cast<std::size_t>(std::find(names.begin() + 1, names.end(), names[0]) -
                                                     names.begin());
        if (turn < 2 || names.size() < 2 * turn) return;
        for (std::size_t i = turn; i < names.size(); ++i)
            if (names[i] != names[i - turn]) return;
        chains_.insert(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(turn));
    }
    /// The side of an item with a label that has one; else `side` stays.
    static bool take_side(const LogVector& item, Sided& side) {
        for (const std::string* name : {&item.label, &item.phrase})
            if (const auto own = sided(std::string_view(*name).substr(0, name->find_last_not_of(' ') + 1))) {
                side = *own;
                return true;
            }
        return false;
    }

    bool read_next() {
        if (!later_.empty()) {
            text_ = std::move(later_.front());
            later_.pop_front();
            ++line;
        } else if (!read_line(in_, text_, line)) {
            return false;
        }
        read_bytes_ += text_.size();
        return true;
    }
    void unread() {
        later_.push_front(std::move(text_));
        --line;
    }
    /// The next line, with those that continue it.
    bool read(Record& record) {
        if (!read_next()) return false;
        constexpr std::size_t longest = 1u << 20;
        std::string whole = std::move(text_);
        record = {.line = line};
        char begun = component_of(whole);
        std::size_t head = 0;
        // shoulder: or shoulder { above x: 0.1
        for (; begun == 0 && is_heading(whole) && whole.size() < longest && read_next();
             head = whole.size()) {
            begun = component_of(text_);
            if (begun == 0 && !is_heading(text_)) {
                unread();
                break;
            }
            whole += ' ';
            head = whole.size();
            whole += text_;
            if (begun != 0) break;
        }
        OpenBrackets brackets;
        brackets.add(std::string_view(whole).substr(0, head));
        const bool column = begun == '#' && !brackets.any();
        brackets.add(std::string_view(whole).substr(head));
        components_ = components_ || begun != 0;
        while (whole.size() < longest && (begun != 0 || brackets.hold_numbers()) && read_next()) {
            const char name = component_of(text_);
            if (name == 0 ? !brackets.hold_numbers() : name == begun && name != '#') {
                unread();
                break;
            }
            brackets.add(text_);
            whole += ' ' + text_;
        }
        // Numbers alone, as a column of Eigen: in brackets.
        if (column) whole.insert(head, "(") += ')';
        record.items = vectors_in(whole, *this);
        record.parts = whole.starts_with("---");
        record.closes = !whole.empty() && whole.find_first_not_of(" \t)]}>,;") == whole.npos;
        read_stamp(whole);
        record.stamp = stamp_;
        return true;
    }
    static bool is_heading(std::string_view text) {
        const std::size_t last = text.find_last_not_of(" \t");
        return last < 200 && std::string_view(":={[(").find(text[last]) != std::string_view::npos;
    }
    /// x, y, z or w of a line such as "  x: 0.3", '#' of one that is a number alone, else 0.
    static char component_of(std::string_view text) {
        const std::vector<LogToken> tokens = tokens_of(text.substr(0, 64));
        std::size_t at = !tokens.empty() && tokens[0].kind == '-' ? 1 : 0;
        char name = '#';
        if (at + 1 < tokens.size() && tokens[at].text.size() == 1 &&
            (tokens[at + 1].kind == ':' || tokens[at + 1].kind == '=')) {
            name = static_cast<char>(tokens[at].text[0] | 0x20);
            at += 2;
        }
        const bool number = at < tokens.size() && tokens[at].kind == '0' && text.size() < 64;
        const bool ends =
            at + 1 == tokens.size() ||
            (at + 2 == tokens.size() && (tokens[at + 1].kind == ',' || tokens[at + 1].kind == ';'));
        return number && ends && (name == '#' || (name >= 'w' && name <= 'z')) ? name : '\0';
    }

    /// "[0.033] ...", "time: 0.033", "12:00:01.033 ..."; ROS has "sec: 12" and "nanosec: 345".
    void read_stamp(std::string_view text) {
        constexpr std::size_t farthest = 60;  // characters
        text = text.substr(0, farthest);
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
            while (end < text.size() && (is_letter(text[end]) || is_digit(text[end]))) ++end;
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

    /// Adds a line's vectors to the frame.
    void take(Record& record) {
        if (record.items.empty()) {
            const bool ends = documents_ ? record.parts : labels_.empty() && !by_line_ && !record.closes;
            if (ends && frame_[0].joints.size() + frame_[1].joints.size() >= (documents_ ? 1u : 2u)) flush();
            return;
        }
        any_ = true;
        leave_out_attributes(record.items);
        const auto joints =
            static_cast<std::size_t>(std::ranges::count_if(record.items, &LogVector::is_joint));
        const bool known =
            chains_.empty() ? joints == joints_ : joints > 1 && chains_.contains(record.chain());
        if (by_line_ && joints > 0 && !known) {
            if (left_out_lines_++ == 0) first_left_out_ = record.line;
            return;
        }
        if (by_line_ && (joints > 0 || leads_)) flush();
        if (joints > 0 && !chains_.empty()) frame_[0].chain = record.chain();
        Sided side{2, {}};
        for (const LogVector& each : record.items) {
            take_side(each, side);
            const bool single = each.is_position && each.numbers.size() == 3 && !by_line_ && !documents_;
            const std::string name = each.kind + each.label;
            if (single && labels_.contains(name)) flush();
            if (single && !each.label.empty()) labels_.insert(name);
            if (!two_sides_ || side.side < 2) add(frame_[two_sides_ ? side.side : 0], each, record);
        }
    }
    void add(RawFrame& frame, const LogVector& item, const Record& record) {
        if (!item.is_position && item.numbers.size() == 3) return;
        if (frame.line == 0) frame.line = record.line, frame.time = record.stamp;
        const auto& n = item.numbers;
        if (n.size() == 4) {
            if (item.meaning == Meaning::Joint && frame.rotations.size() < max_trace_joints)
                frame.rotations.emplace_back(n[0], n[1], n[2], n[3]);
            return;
        }
        const glm::dvec3 at(n[0], n[1], n[2]);
        if (item.meaning == Meaning::Target)
            frame.target = at;
        else if (item.meaning == Meaning::Pole)
            frame.pole = at;
        else if (frame.joints.size() == max_trace_joints)
            fail_line(record.line, "found more than 4096 joints");
        else
            frame.joints.push_back(at);
    }
    /// Hands the frame out if it has joints.
    void flush() {
        if (frame_[0].joints.empty() && frame_[1].joints.empty()) return;
        for (const std::size_t side : {0u, 1u}) {
            if (two_sides_) frame_[side].chain = side == 0 ? "left" : "right";
            if (!frame_[side].joints.empty()) ready_.push_back(std::move(frame_[side]));
            frame_[side] = {};
        }
        labels_.clear();
    }
    void finish() {
        flush();
        if (!any_)
            throw std::runtime_error(
                "has no positions in it: expected vectors such as (1, 2, 3) or X=1 Y=2 Z=3");
        if (left_out_lines_ > 0)
            notes.push_back(
                (left_out_lines_ == 1 ? "line " : std::to_string(left_out_lines_) + " lines, from line ") +
                std::to_string(first_left_out_) + " on, were left out: frames have " +
                std::to_string(joints_) + " positions");
        left_out_lines_ = 0;
    }
    /// A name that repeats in a line beside two or more joints with names of their own is an attribute of
    /// each joint: "elbow (...) side (...) hand (...) side (...)". Where kinds alternate, "a (...) b (...) a
    /// (...) b (...)", the first one is of the positions.
    void leave_out_attributes(std::vector<LogVector>& items) {
        std::map<std::string, std::size_t> counts;
        std::set<std::string> kinds;
        std::vector<std::string> turns;
        bool own_side = false;
        for (const LogVector& each : items) {
            if (!each.is_joint()) continue;
            ++counts[each.label + ' ' + each.kind];
            kinds.insert(turns.emplace_back(each.kind));
            Sided side{2, {}};
            own_side = own_side || take_side(each, side);
        }
        const auto own = std::ranges::count_if(
            counts, [](const auto& each) { return each.second == 1 && each.first != " "; });
        const std::size_t turn = kinds.size();
        bool turning = turn > 1 && turns.size() >= 2 * turn && turns.size() % turn == 0 && !own_side;
        for (std::size_t i = turn; turning && i < turns.size(); ++i) turning = turns[i] == turns[i - turn];
        std::erase_if(items, [&](const LogVector& each) {
            if (!each.is_joint() || (each.label.empty() && each.kind.empty())) return false;
            const bool out =
                turning ? each.kind != turns.front() : own >= 2 && counts[each.label + ' ' + each.kind] >= 2;
            const std::string& name = each.label.empty() ? each.kind : each.label;
            if (out && left_out_.insert(name).second)
                notes.push_back("the vectors of \"" + printable(name) +
                                "\" were left out: every joint has one");
            return out;
        });
    }

    std::istream& in_;
    std::string text_;
    std::deque<std::string> later_;  ///< lines that were read ahead
    std::deque<Record> sample_;      ///< read to learn from
    Schema schema_;
    std::array<RawFrame, 2> frame_{};  ///< the present one; of two sides
    std::deque<RawFrame> ready_;
    std::set<std::string> labels_;    ///< of the present frame
    std::set<std::string> left_out_;  ///< labels
    std::set<std::string> chains_;    ///< names, if there are more than one
    std::optional<double> stamp_{};   ///< seconds, the latest that was read
    std::size_t read_bytes_ = 0, left_out_lines_ = 0, first_left_out_ = 0;
    std::size_t joints_ = 0;  ///< of most lines that have two or more
    bool by_line_ = false, documents_ = false, components_ = false, leads_ = false, two_sides_ = false,
         any_ = false;
};

}  // namespace

Meaning meaning_of(std::string_view name) {
    const auto has = [&](auto... words) { return ((name.find(words) != name.npos) || ...); };
    if (has("pole", "hint")) return Meaning::Pole;
    if (has("target", "tgt", "goal", "aim", "cmd", "command", "desired", "setpoint", "moving", "toward"))
        return Meaning::Target;
    const bool tip = has("endeffector", "end_effector", "end effector", "end-effector");
    return has("effector") && !tip ? Meaning::Target : Meaning::Joint;
}

bool names_no_position(std::string_view text) {
    const std::vector<LogToken> tokens = tokens_of(text);
    for (std::size_t i = tokens.size(); i-- > 0;)
        for (std::string_view word = tokens[i].text; !word.empty();) {
            const std::size_t dot = word.rfind('.');
            if (const auto position = says_position(dot == word.npos ? word : word.substr(dot + 1), false))
                return !*position;
            word = word.substr(0, dot == word.npos ? 0 : dot);
        }
    return false;
}

std::unique_ptr<RawTrace> open_log_trace(std::istream& in, std::string first, std::size_t line) {
    return std::make_unique<LogTrace>(in, std::move(first), line);
}

}  // namespace tendril::app
