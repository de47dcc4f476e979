#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "app/io/character/bvh.hpp"
#include "app/io/character/unique_names.hpp"
#include "app/io/text.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using humanoid::Node;

constexpr std::size_t max_frames = 1'000'000;
constexpr std::size_t max_values = 100'000'000;
constexpr std::size_t max_name = 250;

/// Reads the text word by word.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
    }
    /// The next word; empty at the end of the text.
    std::string_view next() {
        skip_blanks();
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string_view peek() {
        const std::size_t at = at_, line = line_;
        const std::string_view word = next();
        at_ = at, line_ = line;
        return word;
    }
    void expect(std::string_view wanted) {
        const std::string_view word = next();
        if (!same(word, wanted)) fail("expected " + std::string(wanted) + ", found " + shown(word));
    }
    /// The rest of this line without surrounding blanks. Stops before an opening brace.
    std::string rest_of_line() {
        while (at_ < text_.size() && is_blank(text_[at_]) && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
        std::size_t end = at_;
        while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r' && text_[end] != '{') ++end;
        const std::size_t begin = at_;
        at_ = end;
        while (end > begin && is_blank(text_[end - 1])) --end;
        return std::string(text_.substr(begin, end - begin));
    }
    double number() {
        std::string_view word = next();
        const std::string_view whole = word;
        if (word.find(',') != word.npos) fail("numbers need a decimal point, found " + shown(word));
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, error] = read_double(word.data(), word.data() + word.size(), value);
        if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
            !(std::abs(value) <= 1e9))
            fail("expected a number of at most 1e9 in magnitude, found " + shown(whole));
        return value;
    }
    static bool same(std::string_view a, std::string_view b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
            return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
        });
    }
    static std::string shown(std::string_view word) {
        if (word.empty()) return "the end of the file";
        std::string text(word.substr(0, 40));
        for (char& c : text)
            if (static_cast<unsigned char>(c) < ' ') c = '?';
        return '"' + text + '"';
    }
    /// True if nothing but blanks follows on this line.
    bool at_line_end() const {
        const std::size_t end = std::min(text_.find_first_not_of(" \t\v\f", at_), text_.size());
        return end == text_.size() || text_[end] == '\n' || text_[end] == '\r';
    }
    /// Reads "Frames:" or "Frame Time:", with any blanks between the words and around the colon. Returns
    /// whether the blanks around the colon are the usual ones.
    bool label(std::string_view wanted) {
        skip_blanks();
        const std::size_t begin = at_;
        bool is_tight = true;
        for (std::string_view rest = wanted; !rest.empty();) {
            const std::string_view word = rest.substr(0, rest.find(' '));
            rest.remove_prefix(std::min(word.size() + 1, rest.size()));
            skip_blanks();
            if (!same(text_.substr(at_, word.size()), word)) at_ = begin, refuse_label(wanted);
            at_ += word.size();
        }
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_, is_tight = false;
        if (at_ == text_.size() || text_[at_] != ':') at_ = begin, refuse_label(wanted);
        ++at_;
        return is_tight && at_ < text_.size() && is_blank(text_[at_]);
    }
    /// Reads the numbers of a frame, which begins and ends with a line. False if the file ends within it and
    /// `may_be_cut`.
    bool row(std::vector<double>& numbers, bool may_be_cut) {
        const std::size_t width = numbers.size();
        skip_blanks();
        const std::size_t begin = at_, line = line_;
        const auto refuse = [&] {
            const std::string_view rest = text_.substr(begin);
            Words again(rest.substr(0, rest.find_first_of("\r\n")));
            std::size_t found = 0;
            while (!again.next().empty()) ++found;
            const bool is_last = peek().empty();
            line_ = line;
            fail("expected " + std::to_string(width) + " numbers in this row, found " +
                 std::to_string(found) + (is_last ? " before the end of the file" : ""));
        };
        for (double& each : numbers) {
            if (peek().empty()) {
                if (may_be_cut && text_.find_first_of("\r\n", at_) == text_.npos) return false;
                refuse();
            }
            each = number();
        }
        if (!at_line_end()) refuse();
        return true;
    }

  private:
    [[noreturn]] void refuse_label(std::string_view wanted) {
        fail("expected " + std::string(wanted) + ":, found " + shown(peek()));
    }
    static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
    }
    void skip_blanks() {
        for (; at_ < text_.size() && is_blank(text_[at_]); ++at_)
            if (text_[at_] == '\n') ++line_;
    }

    std::string_view text_;
    std::size_t at_ = 0, line_ = 1;
};

struct BvhJoint {
    glm::dvec3 offset{0.0};
    bool is_end = false;
    std::vector<int> channels;  // 0 to 2: position x to z; 3 to 5: rotation
};

/// The file's HIERARCHY section: joints, and a node for each.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<BvhJoint> joints;
    UniqueNames names;
    std::size_t channels = 0;

    std::size_t add(std::string name, std::int32_t parent, const Words& words) {
        if (name.size() > max_name)
            words.fail("a name of more than " + std::to_string(max_name) + " characters");
        nodes.push_back({names.add(std::move(name), nodes.size()), parent, {}});
        joints.emplace_back();
        return nodes.size() - 1;
    }
};

int channel_of(std::string_view word, Words& words) {
    constexpr std::array<std::string_view, 6> names{"Xposition", "Yposition", "Zposition",
                                                    "Xrotation", "Yrotation", "Zrotation"};
    for (int i = 0; i < 6; ++i)
        if (Words::same(word, names[static_cast<std::size_t>(i)])) return i;
    words.fail("expected a channel (Xposition to Zrotation), found " + Words::shown(word));
}

void read_offset(Words& words, Hierarchy& hierarchy, std::size_t node) {
    glm::dvec3 offset;
    for (int i = 0; i < 3; ++i) offset[i] = words.number();
    hierarchy.joints[node].offset = hierarchy.nodes[node].rest.translation = offset;
}

void read_channels(Words& words, BvhJoint& joint, std::size_t& all) {
    const double count = words.number();
    if (count < 0 || count > 6 || count != std::floor(count))
        words.fail("a joint has 0 to 6 channels, found " + fixed_text(count, 0));
    for (int i = 0; i < static_cast<int>(count); ++i) {
        joint.channels.push_back(channel_of(words.next(), words));
        ++all;
    }
}

/// Reads a joint from its name on, and all its descendants. Iterative, so that deep nesting cannot overflow
/// the call stack.
void read_tree(Words& words, Hierarchy& hierarchy) {
    std::vector<std::size_t> open{hierarchy.add(words.rest_of_line(), -1, words)};
    words.expect("{");
    while (!open.empty()) {
        const std::size_t node = open.back();
        const std::string_view word = words.next();
        const auto parent = static_cast<std::int32_t>(node);
        const bool is_joint = Words::same(word, "JOINT"), is_end = Words::same(word, "End");
        if ((is_joint || is_end) && hierarchy.joints[node].is_end)
            words.fail("an End Site has no joints below it");
        if (Words::same(word, "OFFSET")) {
            read_offset(words, hierarchy, node);
        } else if (Words::same(word, "CHANNELS")) {
            read_channels(words, hierarchy.joints[node], hierarchy.channels);
        } else if (is_joint) {
            open.push_back(hierarchy.add(words.rest_of_line(), parent, words));
            words.expect("{");
        } else if (is_end) {
            words.expect("Site");
            words.rest_of_line();
            open.push_back(
                hierarchy.add(hierarchy.nodes[node].name.substr(0, max_name - 4) + " end", parent, words));
            hierarchy.joints.back().is_end = true;
            words.expect("{");
        } else if (word == "}") {
            open.pop_back();
        } else {
            words.fail("expected OFFSET, CHANNELS, JOINT, End Site or }, found " + Words::shown(word));
        }
        if (hierarchy.nodes.size() > humanoid::Skeleton::max_nodes)
            words.fail("more than " + std::to_string(humanoid::Skeleton::max_nodes) + " joints");
    }
}

glm::dquat turned_about(int axis, double degrees) {
    const double half = degrees * (3.14159265358979323846 / 360.0);
    glm::dquat turn(math::cosine(half), 0.0, 0.0, 0.0);
    turn[axis] = math::sine(half);
    return turn;
}

/// One joint's values of one frame. Positions replace the OFFSET; judge_space() decides for roots.
rig::Transform local_of(const BvhJoint& joint, const double* values) {
    rig::Transform local;
    bool has_position = false;
    glm::dvec3 position(0.0);
    for (std::size_t i = 0; i < joint.channels.size(); ++i) {
        const int channel = joint.channels[i];
        if (channel < 3) {
            position[channel] = values[i];
            has_position = true;
        } else {
            local.rotation = local.rotation * turned_about(channel - 3, std::remainder(values[i], 360.0));
        }
    }
    local.rotation = rig::normalised(local.rotation);
    local.translation = has_position ? position : joint.offset;
    return local;
}

bool moves(const BvhJoint& joint) {
    return std::any_of(joint.channels.begin(), joint.channels.end(), [](int each) { return each < 3; });
}
bool turns(const BvhJoint& joint) {
    return std::any_of(joint.channels.begin(), joint.channels.end(), [](int each) { return each >= 3; });
}

/// Skips whole rows beyond the declared ones, and notes how many rows are extra or missing: some programs
/// count one too few, and takes are cut short.
void compare_rows(Words& words, std::size_t frames, std::size_t declared, std::vector<double>& row,
                  std::vector<std::string>& notes) {
    std::size_t found = row.empty() ? declared : frames;
    for (; !row.empty() && !words.peek().empty(); ++found) words.row(row, true);
    if (const std::string_view rest = words.next(); !rest.empty())
        words.fail("expected the end of the file after " + std::to_string(frames) + " frames, found " +
                   Words::shown(rest));
    if (found == declared) return;
    const std::size_t by = std::max(found, declared) - std::min(found, declared);
    notes.push_back("The file has " + std::to_string(by) + (found > declared ? " more row" : " fewer row") +
                    (by == 1 ? "" : "s") + " than the " + std::to_string(declared) +
                    " frames that it declares" + (found > declared ? "; left out." : "."));
}

humanoid::Clip read_motion(Words& words, const Hierarchy& hierarchy, std::vector<std::string>& notes,
                           LoadProgress* progress) {
    const bool usual_frames = words.label("Frames");
    const double count = words.number();
    if (count < 0 || count > static_cast<double>(max_frames) || count != std::floor(count))
        words.fail("expected 0 to 1000000 frames");
    const auto declared = static_cast<std::size_t>(count);
    if (declared * hierarchy.channels > max_values) words.fail("more than 100000000 numbers");
    const bool usual_time = words.label("Frame Time");
    const double step = words.number();
    if (!(step > 0.0) && declared > 1)
        words.fail("the frame time must be over 0, found " + fixed_text(step, 4));
    if (!usual_frames || !usual_time)
        notes.push_back(std::string("The blanks around the colon after ") +
                        (usual_time     ? "Frames"
                         : usual_frames ? "Frame Time"
                                        : "Frames and Frame Time") +
                        " are not the usual ones.");
    if (step >= 1.0 && declared > 1)
        notes.push_back("A frame lasts " + fixed_text(step, 4) +
                        " s, as Frame Time says. At 30 frames per second it would be 0.0333.");

    humanoid::Clip clip;
    clip.name = "motion";
    for (std::size_t node = 0; node < hierarchy.joints.size(); ++node)
        if (!hierarchy.joints[node].channels.empty()) clip.channels.push_back({.node = node});
    std::vector<double> row(hierarchy.channels), times;
    bool is_cut = false;
    for (; times.size() < declared && !row.empty() && !words.peek().empty();
         times.push_back(static_cast<double>(times.size()) * step)) {
        if (times.size() % 64 == 0)
            report(progress, 0.1 + 0.8 * static_cast<double>(times.size()) / static_cast<double>(declared));
        is_cut = !words.row(row, !times.empty());
        if (is_cut) break;
        const double* values = row.data();
        for (humanoid::Channel& channel : clip.channels) {
            const BvhJoint& joint = hierarchy.joints[channel.node];
            const rig::Transform local = local_of(joint, values);
            values += joint.channels.size();
            if (moves(joint)) channel.translation.values.push_back(local.translation);
            if (!turns(joint)) continue;
            // The file stores angles, so the sign of a quaternion is free to choose.
            std::vector<glm::dquat>& keys = channel.rotation.values;
            const bool is_far = !keys.empty() && glm::dot(keys.back(), local.rotation) < 0.0;
            keys.push_back(is_far ? -local.rotation : local.rotation);
        }
    }
    clip.duration = times.size() > 1 ? times.back() : 0.0;
    clip.rate = times.size() > 1 ? 1.0 / step : 0.0;
    for (humanoid::Channel& channel : clip.channels) {
        if (moves(hierarchy.joints[channel.node])) channel.translation.times = times;
        if (turns(hierarchy.joints[channel.node])) channel.rotation.times = times;
    }
    if (is_cut)
        notes.push_back("The file is cut off in row " + std::to_string(times.size() + 1) + " of " +
                        std::to_string(declared) + ", which is left out.");
    else
        compare_rows(words, times.size(), declared, row, notes);
    return clip;
}

bool has_keys(const humanoid::Clip& clip) {
    return std::any_of(clip.channels.begin(), clip.channels.end(), [](const humanoid::Channel& each) {
        return !each.translation.times.empty() || !each.rotation.times.empty();
    });
}

Character read(Words& words, LoadProgress* progress) {
    words.expect("HIERARCHY");
    Hierarchy hierarchy;
    do {
        words.expect("ROOT");
        read_tree(words, hierarchy);
    } while (Words::same(words.peek(), "ROOT"));
    words.expect("MOTION");

    Character character;
    character.clips.push_back(read_motion(words, hierarchy, character.notes, progress));
    for (std::size_t node = 0; node < hierarchy.nodes.size(); ++node) {
        const BvhJoint& joint = hierarchy.joints[node];
        if (hierarchy.nodes[node].parent < 0 && moves(joint) && joint.offset != glm::dvec3(0.0))
            character.root_offsets.push_back({node, joint.offset});
    }
    judge_space(character, std::move(hierarchy.nodes));
    if (!has_keys(character.clips.front())) character.clips.clear();
    return character;
}

/// The text without the ^Z or NUL that some programs write at its end.
std::string_view without_end_marks(std::string_view text) {
    const std::size_t last = text.find_last_not_of(std::string_view("\0\x1a \t\r\n", 6));
    const std::size_t end =
        text.find_first_of(std::string_view("\0\x1a", 2), last == text.npos ? 0 : last + 1);
    return text.substr(0, end);
}

}  // namespace

Character parse_bvh(std::string_view text, const std::string& name, LoadProgress* progress) {
    try {
        if (text.empty()) throw std::runtime_error("is empty");
        if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
            (text.size() > 1 && (text[0] == '\0') != (text[1] == '\0')))
            throw std::runtime_error("line 1: is UTF-16 text; save it as ASCII or UTF-8");
        if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark
        const std::string_view clean = without_end_marks(text);
        Words words(clean);
        Character character = read(words, progress);
        if (clean.size() < text.size())
            character.notes.push_back("The file ends in a control character, ^Z or NUL, which is left out.");
        return character;
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        throw std::runtime_error(name + (what.starts_with("line ") ? ", " : ": ") + what);
    }
}

}  // namespace tendril::app
