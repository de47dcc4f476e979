// Traces in any text: vectors as engines print them, with words around them.
//
// A line with two joints or more is a frame; a line with a target or a pole target alone belongs to it. Where
// lines have one vector each, the joints of a frame follow one another, and a name that comes again begins
// the next frame. Names in front of the vectors say which are targets and pole targets.
#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>
#include <utility>

#include "app/document/text.hpp"
#include "app/io/trace/raw.hpp"

namespace tendril::app {
namespace {

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
}

enum class Meaning { Joint, Target, Pole };

/// Three or four numbers.
struct Found {
    std::string label;  ///< in lower case; may be empty
    std::vector<double> numbers;
    Meaning meaning = Meaning::Joint;
};

/// Finds vectors in one line.
class Scanner {
  public:
    Scanner(std::string_view text, RawTrace& trace) : text_(text), trace_(trace) {}

    std::vector<Found> all() {
        std::vector<Found> found;
        for (std::size_t at = 0; at < text_.size();) {
            std::size_t end = at;
            std::vector<double> numbers;
            if (named(at, end, numbers) || bracketed(at, end, numbers)) {
                found.push_back({label_before(at), std::move(numbers)});
                found.back().meaning = meaning_of(found.back().label);
                at = end;
                from_ = end;
            } else {
                ++at;
            }
        }
        return found;
    }

  private:
    static Meaning meaning_of(const std::string& label) {
        for (const char* word : {"target", "goal", "effector", "aim"})
            if (label.find(word) != label.npos && label.find("pole") == label.npos) return Meaning::Target;
        for (const char* word : {"pole", "hint"})
            if (label.find(word) != label.npos) return Meaning::Pole;
        return Meaning::Joint;
    }

    std::size_t skip(std::size_t at, std::string_view what) const {
        while (at < text_.size() && what.find(text_[at]) != what.npos) ++at;
        return at;
    }

    /// X=1.0 Y=2.0 Z=3.0 [W=1.0]
    bool named(std::size_t at, std::size_t& end, std::vector<double>& numbers) {
        if (at > 0 && is_word(text_[at - 1])) return false;
        constexpr std::string_view lower = "xyzw", upper = "XYZW";
        std::size_t here = at;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t start = skip(here, i == 0 ? "" : " ,;\t");
            if (start >= text_.size() || (text_[start] != lower[i] && text_[start] != upper[i])) break;
            std::size_t value = skip(start + 1, " ");
            if (value >= text_.size() || (text_[value] != '=' && text_[value] != ':')) break;
            value = skip(value + 1, " ");
            std::string_view rest = text_.substr(value);
            const auto number = take_number(rest);
            if (!number) break;
            numbers.push_back(*number);
            here = text_.size() - rest.size();
        }
        if (numbers.size() < 3) {
            numbers.clear();
            return false;
        }
        if (text_[at] == 'X') trace_.engine = Engine::Unreal;
        end = here;
        return true;
    }

    /// (1, 2, 3), [1, 2, 3] or {1, 2, 3}, of three or four numbers.
    bool bracketed(std::size_t at, std::size_t& end, std::vector<double>& numbers) {
        constexpr std::string_view open = "([{", close = ")]}";
        const std::size_t kind = open.find(text_[at]);
        if (kind == open.npos) return false;
        std::size_t here = skip(at + 1, " ");
        bool single = false;  // 1.0f
        while (here < text_.size() && numbers.size() < 5) {
            std::string_view rest = text_.substr(here);
            const auto number = take_number(rest);
            if (!number) break;
            numbers.push_back(*number);
            here = text_.size() - rest.size();
            single = single || text_[here - 1] == 'f' || text_[here - 1] == 'F';
            const std::size_t next = skip(here, " \t");
            if (next < text_.size() && (text_[next] == ',' || text_[next] == ';'))
                here = skip(next + 1, " \t");
            else if (next == here || next >= text_.size() || text_[next] == close[kind]) {
                here = next;
                break;
            } else {
                here = next;
            }
        }
        if (here >= text_.size() || text_[here] != close[kind] || numbers.size() < 3 || numbers.size() > 4) {
            numbers.clear();
            return false;
        }
        end = here + 1;
        const std::string before =
            lower_case(text_.substr(at < 16 ? 0 : at - 16, std::min<std::size_t>(at, 16)));
        if (before.ends_with("<vector ") || before.ends_with("vector("))
            trace_.engine = before.ends_with("fvector(") ? Engine::Unreal : Engine::Blender;
        else if (before.ends_with("new vector3") || (before.ends_with("vector3") && single))
            trace_.engine = Engine::Unity;
        else if (before.ends_with("vector3"))
            trace_.engine = Engine::Godot;
        else if (before.ends_with("fvector"))
            trace_.engine = Engine::Unreal;
        return true;
    }

    /// The name in front of a vector: "elbow" in "elbow = new Vector3".
    std::string label_before(std::size_t at) const {
        std::size_t end = at;
        for (;;) {
            while (end > from_ &&
                   std::string_view(" =:<([{\"'\t").find(text_[end - 1]) != std::string_view::npos)
                --end;
            std::size_t begin = end;
            while (begin > from_ && is_word(text_[begin - 1])) --begin;
            const std::string word = lower_case(text_.substr(begin, end - begin));
            static const std::set<std::string> constructors{
                "fvector", "vector3", "vector", "new", "vec3", "float3", "v", "quat", "fquat", "quaternion"};
            if (!word.empty() && constructors.contains(word)) {
                end = begin;
                continue;
            }
            const bool name = word.find_first_not_of("0123456789_") != word.npos;
            return name ? word : std::string();
        }
    }

    std::string_view text_;
    RawTrace& trace_;
    std::size_t from_ = 0;  ///< the end of the vector before
};

class LogTrace final : public RawTrace {
  public:
    LogTrace(std::istream& in, std::string first, std::size_t at) : in_(in), text_(std::move(first)) {
        line = at;
    }

    bool next(RawFrame& frame) override {
        frame = std::move(ahead_);
        ahead_ = {};
        while (waiting_ || read_line(in_, text_, line)) {
            waiting_ = false;
            if (take(frame)) return true;
        }
        if (!frame.joints.empty()) return true;
        if (!any_)
            throw std::runtime_error(
                "has no positions in it: expected vectors such as (1, 2, 3) or X=1 Y=2 Z=3");
        return false;
    }

  private:
    /// Adds a line's vectors to the frame. True if the line begins the next one, which is then in ahead_.
    bool take(RawFrame& frame) {
        const std::vector<Found> found = Scanner(text_, *this).all();
        if (found.empty()) return false;
        count_decimals(*this, text_);
        any_ = true;
        const auto joints = std::ranges::count_if(found, [](const Found& each) {
            return each.meaning == Meaning::Joint && each.numbers.size() == 3;
        });
        if (joints >= 2) by_line_ = true;
        RawFrame* into = &frame;
        if (by_line_ && joints > 0 && !frame.joints.empty()) into = &ahead_;
        for (const Found& each : found) {
            if (!by_line_ && begins_again(each) && !into->joints.empty()) {
                into = &ahead_;
                labels_.clear();
            }
            add(*into, each);
        }
        return into == &ahead_;
    }

    bool begins_again(const Found& each) {
        return !each.label.empty() && each.numbers.size() == 3 && labels_.contains(each.label);
    }

    void add(RawFrame& frame, const Found& found) {
        if (frame.line == 0) frame.line = line;
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
    std::set<std::string> labels_;  ///< of the present frame
    bool waiting_ = true, by_line_ = false, any_ = false;
};

}  // namespace

std::unique_ptr<RawTrace> open_log_trace(std::istream& in, std::string first, std::size_t line) {
    return std::make_unique<LogTrace>(in, std::move(first), line);
}

}  // namespace tendril::app
