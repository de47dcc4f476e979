// Traces in any text: vectors as programs print them, with words around them.
//
// No program's format is built in. The first lines show how words repeat, as in mining templates of logs (He
// et al., Drain, ICWS 2017). A word before several vectors of a line is not a label, nor is one that follows
// different words on different lines. Before every vector it is a type, such as Vector3 or SIMD3<Float>;
// otherwise it is a kind that every joint has: pos, rot. The word before it is the label. Kinds and labels
// tell which vectors are targets, which are pole targets, and which are not positions.
//
// A gap between vectors may start a frame: a closing bracket, a line break, other text, a blank line or ---.
// The first of these that splits the joints into groups of equal size is used: brackets, if a frame fills a
// line; line breaks; repeated names; wider gaps; positions that return to almost the same values. A group
// without joints, such as a lone target, belongs to the frame before it or, at the start of the file, to the
// one after it.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <exception>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "app/io/text.hpp"
#include "app/io/trace/log_vectors.hpp"

namespace tendril::app {
namespace {

enum Says : unsigned {
    Position = 1,    ///< the numbers are a position
    NoPosition = 2,  ///< the numbers are something else
    AsKind = 4       ///< only if every joint has one, as in p=(...) r=(...); a joint may be called r
};

/// Whether a word, or a part of it (PoleTarget, pole_target; the last part first), says what the numbers are.
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
                  "quat fquat quaternion rotation rotations rot orientation orient rpy euler angle "
                  "angles degree degrees deg radian radians rad scale scaling velocity vel speed angular "
                  "linear acceleration accel normal tangent force torque covariance color colour size "
                  "extents gravity basis scale3d fwd forward dir direction axis omega local"}}) {
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

using Line = std::vector<LogVector>;

std::string chain_of(const LogVector& first) {
    return first.kind.empty() ? first.label : first.label + ' ' + first.kind;
}

/// The meaning of a name in lower case: "ik_target", "pole vector".
Meaning meaning_of(std::string_view name) {
    const auto has = [&](auto... words) { return ((name.find(words) != name.npos) || ...); };
    if (has("pole", "hint")) return Meaning::Pole;
    if (has("target", "tgt", "goal", "aim", "cmd", "command", "desired", "setpoint", "moving", "toward"))
        return Meaning::Target;
    const bool tip = has("endeffector", "end_effector", "end effector", "end-effector");
    return has("effector") && !tip ? Meaning::Target : Meaning::Joint;
}

/// The roles of words before vectors, learned from how they repeat.
class Schema {
  public:
    void learn(std::deque<Line>& lines) {
        for (const Line& line : lines)
            for (const LogVector& each : line)
                homogeneous_ = homogeneous_ || (is_point(each) && length(each.numbers) > 1.02);
        for (Line& each : lines) sort_fours(each);
        constexpr std::size_t longest = 8;  // words in a type
        for (std::size_t depth = 0; depth < longest; ++depth) learn(lines, depth);
    }

    void apply(Line& items) const {
        sort_fours(items);
        for (std::size_t i = 0; i < items.size(); ++i) name(items[i], i > 0 ? &items[i - 1] : nullptr);
    }

  private:
    /// The words of an item that are not its label: their count, and their text.
    std::pair<std::size_t, std::string> kind_of(const std::vector<LogWord>& words) const {
        std::string kind;
        for (std::size_t n = 0; n < words.size(); ++n) {
            const std::string& word = words[words.size() - 1 - n].name;
            std::string longer = word + ' ' + kind;
            const bool describes = meaning_of(word) == Meaning::Joint && says_position(word, false);
            if (!describes && !kinds_.contains(longer)) return {n, kind};
            kind = std::move(longer);
        }
        return {words.size(), kind};
    }

    /// A word after different words in different places is not a label, nor is one before every vector.
    void learn(const std::deque<Line>& lines, std::size_t depth) {
        struct Count {
            std::size_t all = 0;
            std::map<std::string, std::size_t> numbered{}, plain{};  ///< by the preceding words
        };
        std::map<std::string, Count> counts;
        std::size_t all = 0;
        for (const Line& line : lines)
            for (const LogVector& item : line) {
                if (item.numbers.size() != 3) continue;
                ++all;
                const auto [n, kind] = kind_of(item.words);
                if (n != depth || n == item.words.size()) continue;
                const auto rest = std::span(item.words).first(item.words.size() - n);
                std::string before;
                for (const LogWord& each : rest.first(rest.size() - 1))
                    if (!each.is_number()) before += each.name + ' ';
                Count& count = counts[rest.back().name + ' ' + kind];
                ++count.all;
                ++count.plain[before];
                if (rest.size() > 1 && rest[rest.size() - 2].is_number())
                    before += rest[rest.size() - 2].name;
                ++count.numbered[before];
            }
        for (const auto& [key, count] : counts) {
            // Indices repeat; frame numbers do not.
            const bool indexed = count.all <= 8 || 2 * count.numbered.size() <= count.all;
            const auto& before = indexed ? count.numbered : count.plain;
            std::size_t most = 0;
            for (const auto& [words, times] : before) most = std::max(most, times);
            const bool common = 10 * count.all >= 9 * all;
            if (common || 10 * most < 9 * count.all) kinds_[key] = common;
        }
    }

    void name(LogVector& item, const LogVector* before) const {
        const auto [n, kind] = kind_of(item.words);
        const auto rest = std::span(item.words).first(item.words.size() - n);
        const auto known = kinds_.find(kind);
        const bool type = known != kinds_.end() && known->second;
        std::optional<bool> position;
        for (std::size_t i = 0; i < n && !position; ++i)
            position = says_position(item.words[item.words.size() - 1 - i].text, !type);
        if (!type) item.kind = kind;
        for (std::size_t i = rest.size(); i-- > 0;) {
            const LogWord& word = rest[i];
            if (i + 1 < rest.size() && (word.ends_phrase || (item.first && word.names))) break;
            if (!word.is_number()) item.phrase.insert(0, word.name + ' ');
            if (!position) position = says_position(word.text, before && !before->kind.empty());
        }
        if (!rest.empty()) item.label = rest.back().name;
        if (!rest.empty() && rest.back().is_number())
            item.label = rest.size() > 1 && !rest[rest.size() - 2].is_number()
                             ? rest[rest.size() - 2].name + item.label
                             : "";
        item.phrase += item.kind;
        item.meaning = meaning_of(item.phrase);
        item.is_position = item.matrix || position.value_or(true);
        // A rotation after a target's position belongs to the target.
        if (before && (rest.empty() ? !item.is_position || item.numbers.size() != before->numbers.size()
                                    : rest.size() == 1 && !item.is_position))
            item.meaning = before->meaning;
    }

    static double length(const std::vector<double>& n) {
        return std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3]);
    }
    static bool is_point(const LogVector& each) { return each.numbers.size() == 4 && each.numbers[3] == 1.0; }
    /// Four numbers are a quaternion if their length is 1, or a point if the last one is 1 in every vector.
    void sort_fours(std::vector<LogVector>& items) const {
        for (LogVector& each : items)
            if (homogeneous_ && is_point(each)) each.numbers.pop_back();
        std::erase_if(items, [](const LogVector& each) {
            return each.numbers.size() == 4 && !(std::abs(length(each.numbers) - 1.0) <= 0.02);
        });
    }

    std::map<std::string, bool> kinds_;  ///< not labels; whether before every vector
    bool homogeneous_ = false;
};

class LogTrace final : public RawTrace {
  public:
    explicit LogTrace(Lines lines) : RawTrace(std::move(lines)), scanner_(lines_, *this) {
        table_ = open_table(lines_, *this);
        learn();
    }

    bool next(RawFrame& frame) override {
        for (Line items; ready_.empty() && !ended_; take(items))
            if (!sample_.empty()) {
                items = std::move(sample_.front());
                sample_.pop_front();
            } else if (read(items)) {
                schema_.apply(items);
            } else {
                finish();
            }
        if (ready_.empty() && damage_) std::rethrow_exception(damage_);
        if (ready_.empty()) return false;
        frame = std::move(ready_.front());
        ready_.pop_front();
        return true;
    }

  private:
    /// False at the end, or at damaged text, which next() reports after all frames before it.
    bool read(Line& items) {
        items.clear();
        try {
            return !damage_ && (table_ ? table_->next(items) : scanner_.next(items));
        } catch (const std::runtime_error&) {
            damage_ = std::current_exception();
            return false;
        }
    }
    void learn() {
        constexpr std::size_t enough = 1u << 18, most = 1000;  // bytes; lines with vectors
        while (read(sample_.emplace_back()) && sample_.size() < most && lines_.bytes() < enough) {
        }
        if (sample_.back().empty()) sample_.pop_back();
        schema_.learn(sample_);
        std::vector<const LogVector*> joints;
        std::vector<unsigned> gaps, repeats;  // per joint: the gap before it; whether its name repeats
        std::set<std::string> names;
        std::size_t labelled = 0;
        unsigned gap = RuleBetween * 2;
        std::array<std::set<std::string>, 2> sides;
        two_sides_ = true;
        for (Line& line : sample_) {
            schema_.apply(line);
            Sided side{2, {}};
            for (const LogVector& each : line) {
                gap = std::max(gap, each.gap);
                if (!take_side(each, side)) side.part += '+';
                if (!each.is_joint()) continue;
                joints.push_back(&each);
                gaps.push_back(std::exchange(gap, SameLine));
                labelled += !each.label.empty();
                const std::string name = each.kind + each.label;
                const bool again = !each.label.empty() && !names.insert(name).second;
                if (again) names = {name};
                repeats.push_back(again ? NameAgain : SameLine);
                two_sides_ = two_sides_ && side.side < 2;
                if (two_sides_) sides[side.side].insert(side.part);
            }
        }
        two_sides_ = two_sides_ && sides[0].size() > 1 && sides[0] == sides[1];
        const std::set<unsigned> levels(gaps.begin(), gaps.end());
        const auto by_gaps = [&](unsigned from, unsigned to) {
            return std::any_of(levels.lower_bound(from), levels.lower_bound(to),
                               [&](unsigned level) { return splits(joints, gaps, level); });
        };
        const bool one_line = !levels.empty() && *levels.lower_bound(NextLine) == *levels.rbegin();
        if (!(one_line && by_gaps(SameLine + 1, NextLine)) && !by_gaps(NextLine, TextBetween) &&
            !splits(joints, repeats, NameAgain) && !by_gaps(TextBetween, RuleBetween * 2) &&
            2 * labelled < joints.size())
            split_by_positions(joints, gaps);
        if (level_ == NameAgain) level_ = 0;
        const bool has_target = std::ranges::any_of(sample_, [](const Line& line) {
            return std::ranges::find(line, Meaning::Target, &LogVector::meaning) != line.end();
        });
        aims_ = !has_target && 2 * labelled < joints.size() && !two_sides_ && chains_.empty() &&
                last_is_target(joints);
        if (levels.contains(RuleBetween) && scanner_.components()) engine = Engine::Ros;
        const auto first = std::ranges::find_if(sample_, [](const Line& each) { return !each.empty(); });
        leads_ = first != sample_.end() && std::ranges::none_of(*first, &LogVector::is_joint);
    }
    /// True if unnamed positions keep their distances, except the last one.
    bool last_is_target(const std::vector<const LogVector*>& joints) {
        const std::size_t count = period_ > 0 ? period_ : joints_;
        /// The fraction by which a distance varies, without the tenth at either end.
        const auto change = [&](std::size_t bone) {
            std::vector<double> lengths;
            for (; bone < joints.size(); bone += count) {
                const auto &a = joints[bone - 1]->numbers, &b = joints[bone]->numbers;
                const double length =
                    glm::distance(glm::dvec3(a[0], a[1], a[2]), glm::dvec3(b[0], b[1], b[2]));
                if (std::isfinite(length)) lengths.push_back(length);
            }
            std::ranges::sort(lengths);
            const std::size_t out = lengths.size() / 10;
            if (lengths.size() < 8) return 0.0;
            const double longest = lengths[lengths.size() - 1 - out];
            return longest > 0.0 ? 1.0 - lengths[out] / longest : 1.0;
        };
        if (count < 4 || change(count - 1) < 0.25) return false;
        for (std::size_t bone = 1; bone + 1 < count; ++bone)
            if (change(bone) > 0.02) return false;
        notes.push_back("the last of " + std::to_string(count) +
                        " positions was taken for the target: its distance from the one before changes");
        return true;
    }
    /// True if gaps of at least `level` split the joints into groups of one size, or of alternating chains.
    bool splits(const std::vector<const LogVector*>& joints, const std::vector<unsigned>& gaps,
                unsigned level) {
        std::map<std::size_t, std::size_t> counts;  // groups by size
        std::vector<std::string> names;
        std::size_t groups = 0;
        for (std::size_t i = 0, end = 0; i < joints.size(); i = end, ++groups) {
            for (end = i + 1; end < joints.size() && gaps[end] < level;) ++end;
            ++counts[end - i];
            if (end - i > 1) names.push_back(chain_of(*joints[i]));
        }
        const auto usual = std::ranges::max_element(
            counts, {}, [](const auto& each) { return each.first > 1 ? each.second : 0; });
        const bool chains = !two_sides_ && find_chains(names);
        if (groups < 2 && (level < NextLine || level == NameAgain)) return false;
        if (usual == counts.end() || usual->first < 2 || (10 * usual->second < 6 * groups && !chains))
            return false;
        joints_ = usual->first;
        level_ = level;
        return true;
    }
    /// Lines of alternating chains begin with the chain's name: "leg 0: (...) (...)", "[arm] (...) (...)".
    bool find_chains(const std::vector<std::string>& names) {
        const std::size_t turn =
            names.empty() ? 0
                          : static_cast<std::size_t>(std::find(names.begin() + 1, names.end(), names[0]) -
                                                     names.begin());
        if (turn < 2 || names.size() < 2 * turn) return false;
        for (std::size_t i = turn; i < names.size(); ++i)
            if (names[i] != names[i - turn]) return false;
        chains_ = {names.begin(), names.begin() + static_cast<std::ptrdiff_t>(turn)};
        return true;
    }
    /// Finds the number of joints after which positions return to almost the same values. Failing that,
    /// frames begin at text or blank lines, if there are any.
    void split_by_positions(const std::vector<const LogVector*>& joints, const std::vector<unsigned>& gaps) {
        const auto step = [&](std::size_t by) {
            double sum = 0.0;
            for (std::size_t i = by; i < joints.size(); ++i)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const double d = joints[i]->numbers[axis] - joints[i - by]->numbers[axis];
                    if (std::isfinite(d)) sum += std::abs(d);
                }
            return sum / static_cast<double>(joints.size() - by);
        };
        for (std::size_t by = 2; by <= std::min<std::size_t>(joints.size() / 3, 64); ++by)
            if (step(by) < 0.1 * step(1)) {
                period_ = by;
                return;
            }
        if (std::ranges::count_if(gaps, [](unsigned gap) { return gap >= TextBetween; }) > 1)
            level_ = TextBetween, joints_ = 1;
    }
    /// Sets `side` if the item's label names one.
    static bool take_side(const LogVector& item, Sided& side) {
        for (const std::string* name : {&item.label, &item.phrase})
            if (const auto own = sided(std::string_view(*name).substr(0, name->find_last_not_of(' ') + 1))) {
                side = *own;
                return true;
            }
        return false;
    }

    static std::size_t joints_in(const Line& group) {
        return static_cast<std::size_t>(std::ranges::count_if(group, &LogVector::is_joint));
    }
    void take(Line& items) {
        any_ = any_ || !items.empty();
        for (LogVector& each : items) {
            const bool single = level_ == 0 && period_ == 0 && each.is_position && each.numbers.size() == 3;
            const std::string name = each.kind + each.label;
            const bool begins = level_ > 0    ? each.gap >= level_
                                : period_ > 0 ? each.is_joint() && joints_in(group_) == period_
                                              : single && labels_.contains(name);
            if (begins && !group_.empty()) {
                if (joints_in(group_) > 0) {
                    emit();
                    pending_ = std::move(group_);
                    group_ = {};
                } else if (!leads_) {
                    std::ranges::move(group_, std::back_inserter(pending_));
                    group_ = {};
                }
                labels_.clear();
            }
            if (single && !each.label.empty()) labels_.insert(name);
            group_.push_back(std::move(each));
        }
    }
    /// Turns the pending group into a frame, or into one for each of two sides.
    void emit() {
        Line group = std::exchange(pending_, {});
        const std::size_t joints = joints_in(group);
        if (joints == 0) return;
        const auto first = std::ranges::find_if(group, &LogVector::is_joint);
        const std::string chain = chain_of(*first), column = first->chain;
        const bool known = chains_.empty() ? joints == joints_ : joints > 1 && chains_.contains(chain);
        if (level_ > 0 && !known) {
            if (left_out_lines_++ == 0) first_left_out_ = first->line;
            return;
        }
        leave_out_attributes(group);
        name_bones(group);
        std::array<RawFrame, 2> frames{};
        Sided side{2, {}};
        for (const LogVector& each : group) {
            take_side(each, side);
            if (!two_sides_ || side.side < 2) add(frames[two_sides_ ? side.side : 0], each);
        }
        for (const std::size_t i : {0u, 1u}) {
            if (frames[i].joints.empty()) continue;
            if (aims_ && !frames[i].target) {
                frames[i].target = frames[i].joints.back();
                frames[i].joints.pop_back();
            }
            frames[i].chain = two_sides_ ? i == 0 ? "left" : "right" : chains_.empty() ? column : chain;
            ready_.push_back(std::move(frames[i]));
        }
    }
    /// Uses the names of the first frame's joints, if all have one; with two sides, the left one's.
    void name_bones(const Line& group) {
        if (std::exchange(named_, true) || !chains_.empty()) return;
        for (const LogVector& each : group) {
            Sided side{2, each.label};
            if (!each.is_joint() || (two_sides_ && take_side(each, side) && side.side == 1)) continue;
            header.bones.push_back(side.part);
        }
        if (std::ranges::count(header.bones, "") > 0) header.bones.clear();
    }
    void leave_out(const std::string& name, const char* why) {
        if (left_out_.insert(name).second)
            notes.push_back("the vectors of \"" + printable(name) + "\" were left out: " + why);
    }
    void add(RawFrame& frame, const LogVector& item) {
        if (!item.is_position && item.numbers.size() == 3) return;
        if (item.missing && item.meaning != Meaning::Joint) return;
        if (frame.line == 0) frame.line = item.line, frame.time = item.stamp, frame.dt = item.dt;
        const auto& n = item.numbers;
        if (n.size() == 4) {
            if (item.meaning == Meaning::Joint && frame.rotations.size() < max_trace_joints)
                frame.rotations.emplace_back(n[0], n[1], n[2], n[3]);
            return;
        }
        const glm::dvec3 at(n[0], n[1], n[2]);
        if (item.meaning != Meaning::Joint) {
            auto& aim = item.meaning == Meaning::Target ? frame.target : frame.pole;
            if (aim) leave_out(item.label, "a second target");
            if (!aim) aim = at;
        } else if (frame.joints.size() == max_trace_joints)
            fail_line(item.line, "found more than 4096 joints");
        else {
            frame.joints.push_back(at);
        }
    }
    void finish() {
        ended_ = true;
        if (!any_ && !damage_)
            throw std::runtime_error(
                "has no positions in it: expected vectors such as (1, 2, 3) or X=1 Y=2 Z=3");
        if (joints_in(group_) > 0) emit();
        std::ranges::move(group_, std::back_inserter(pending_));
        group_ = {};
        emit();
        if (left_out_lines_ > 0)
            notes.push_back(
                (left_out_lines_ == 1 ? "line " : std::to_string(left_out_lines_) + " lines, from line ") +
                std::to_string(first_left_out_) + " on, were left out: frames have " +
                std::to_string(joints_) + " positions");
        left_out_lines_ = 0;
    }
    /// A name that repeats in a frame with two or more unique names is an attribute of each joint: "elbow
    /// (...) side (...) hand (...) side (...)". If names alternate, "a (...) b (...) a (...) b (...)", the
    /// first name has the positions.
    void leave_out_attributes(Line& group) {
        std::map<std::string, std::size_t> counts;
        std::vector<std::string> names;
        bool own_side = false;
        for (const LogVector& each : group) {
            if (!each.is_joint()) continue;
            ++counts[names.emplace_back(chain_of(each))];
            Sided side{2, {}};
            own_side = own_side || take_side(each, side);
        }
        const auto own = std::ranges::count_if(
            counts, [](const auto& each) { return each.second == 1 && !each.first.empty(); });
        const std::size_t turn = counts.size();
        bool alternating = turn > 1 && names.size() % turn == 0 && names.size() > turn && !own_side;
        for (std::size_t i = turn; alternating && i < names.size(); ++i)
            alternating = names[i] == names[i - turn];
        std::erase_if(group, [&](const LogVector& each) {
            const std::string name = chain_of(each);
            if (!each.is_joint() || name.empty()) return false;
            const bool out = alternating ? name != names.front() : own >= 2 && counts[name] >= 2;
            if (out) leave_out(name, "every joint has one");
            return out;
        });
    }

    LogScanner scanner_;
    std::unique_ptr<VectorLines> table_;  ///< if set, read instead of scanner_
    std::deque<Line> sample_;             ///< the first lines, for learn()
    Schema schema_;
    Line group_, pending_;  ///< vectors of the current frame; of the one before, while its target may follow
    std::deque<RawFrame> ready_;
    std::set<std::string> labels_;    ///< of the current frame
    std::set<std::string> left_out_;  ///< labels
    std::set<std::string> chains_;    ///< names, if there are several
    std::size_t left_out_lines_ = 0, first_left_out_ = 0;
    unsigned level_ = 0;      ///< minimum gap between frames; 0: names separate them
    std::size_t joints_ = 0;  ///< in most frames
    std::size_t period_ = 0;  ///< joints per frame, if only positions separate frames
    bool leads_ = false, two_sides_ = false, any_ = false, ended_ = false, named_ = false, aims_ = false;
    std::exception_ptr damage_{};
};

}  // namespace

bool names_no_position(std::string_view text) {
    std::vector<LogToken> tokens;
    add_tokens(tokens, text);
    for (std::size_t i = tokens.size(); i-- > 0;)
        for (std::string_view word = tokens[i].text; !word.empty();) {
            const std::size_t dot = word.rfind('.');
            if (const auto position = says_position(dot == word.npos ? word : word.substr(dot + 1), false))
                return !*position;
            word = word.substr(0, dot == word.npos ? 0 : dot);
        }
    return false;
}

std::unique_ptr<RawTrace> open_log_trace(Lines lines) {
    return std::make_unique<LogTrace>(std::move(lines));
}

}  // namespace tendril::app
