#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/io/character/bvh.hpp"
#include "app/io/character/unique_names.hpp"

namespace tendril::app {
namespace {

using humanoid::Node;

constexpr std::size_t max_frames = 1'000'000;
constexpr std::size_t max_values = 100'000'000;

/// Reads the text word by word.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error("line " + std::to_string(line_) + ": " + what);
    }
    /// Empty at the end of the text.
    std::string_view next() {
        skip_blanks();
        const std::size_t begin = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    /// Characters not yet read.
    std::size_t left() const { return text_.size() - at_; }
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
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0.0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
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
        return '"' + std::string(word.substr(0, 40)) + '"';
    }

  private:
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
    std::vector<int> channels;  // 0 to 2: position x to z; 3 to 5: rotation
};

/// The first part of the file: joints, and a node for each.
struct Hierarchy {
    std::vector<Node> nodes;
    std::vector<BvhJoint> joints;
    UniqueNames names;
    std::size_t channels = 0;

    std::size_t add(std::string name, std::int32_t parent) {
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
    if (count < 0 || count > 6 || count != std::floor(count)) words.fail("a joint has 0 to 6 channels");
    for (int i = 0; i < static_cast<int>(count); ++i) {
        joint.channels.push_back(channel_of(words.next(), words));
        ++all;
    }
}

/// Reads a joint from its name on, and all its descendants. Iterative, so that deep nesting cannot overflow
/// the call stack.
void read_tree(Words& words, Hierarchy& hierarchy) {
    std::vector<std::size_t> open{hierarchy.add(words.rest_of_line(), -1)};
    words.expect("{");
    while (!open.empty()) {
        const std::size_t node = open.back();
        const std::string_view word = words.next();
        const auto parent = static_cast<std::int32_t>(node);
        if (Words::same(word, "OFFSET")) {
            read_offset(words, hierarchy, node);
        } else if (Words::same(word, "CHANNELS")) {
            read_channels(words, hierarchy.joints[node], hierarchy.channels);
        } else if (Words::same(word, "JOINT")) {
            open.push_back(hierarchy.add(words.rest_of_line(), parent));
            words.expect("{");
        } else if (Words::same(word, "End")) {
            words.expect("Site");
            words.rest_of_line();
            open.push_back(hierarchy.add(hierarchy.nodes[node].name + " end", parent));
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
    glm::dquat turn(std::cos(half), 0.0, 0.0, 0.0);
    turn[axis] = std::sin(half);
    return turn;
}

/// One joint's values of one frame.
rig::Transform local_of(const BvhJoint& joint, bool is_root, const double* values) {
    rig::Transform local;
    bool has_position = false;
    glm::dvec3 position(0.0);
    for (std::size_t i = 0; i < joint.channels.size(); ++i) {
        const int channel = joint.channels[i];
        if (channel < 3) {
            position[channel] = values[i];
            has_position = true;
        } else {
            local.rotation =
                local.rotation * turned_about(channel - 3, std::remainder(values[i], 360.0 * 2.0));
        }
    }
    local.rotation = rig::normalised(local.rotation);
    local.translation = !has_position ? joint.offset : is_root ? joint.offset + position : position;
    return local;
}

humanoid::Clip read_motion(Words& words, const Hierarchy& hierarchy, LoadProgress* progress) {
    words.expect("Frames:");
    const double count = words.number();
    if (count < 0 || count > static_cast<double>(max_frames) || count != std::floor(count))
        words.fail("expected 0 to 1000000 frames");
    const auto frames = static_cast<std::size_t>(count);
    if (frames * hierarchy.channels > max_values) words.fail("more than 100000000 numbers");
    // A number and its separator take at least two characters.
    if (2 * frames * hierarchy.channels > words.left() + 1)
        words.fail("claims " + std::to_string(frames) + " frames of " + std::to_string(hierarchy.channels) +
                   " numbers, the file has " + std::to_string(words.left()) + " more characters");
    words.expect("Frame");
    words.expect("Time:");
    const double step = words.number();
    if (!(step > 0.0) && frames > 1) words.fail("the frame time must be over 0");

    humanoid::Clip clip;
    clip.name = "motion";
    clip.duration = frames > 1 ? static_cast<double>(frames - 1) * step : 0.0;
    for (std::size_t node = 0; node < hierarchy.joints.size(); ++node) {
        const std::vector<int>& channels = hierarchy.joints[node].channels;
        if (channels.empty()) continue;
        humanoid::Channel channel{.node = node};
        std::vector<double> times;
        for (std::size_t i = 0; i < frames; ++i)
            times.push_back(std::min(static_cast<double>(i) * step, clip.duration));
        if (std::any_of(channels.begin(), channels.end(), [](int each) { return each < 3; }))
            channel.translation.times = times;
        if (std::any_of(channels.begin(), channels.end(), [](int each) { return each >= 3; }))
            channel.rotation.times = std::move(times);
        clip.channels.push_back(std::move(channel));
    }
    std::vector<double> row;
    for (std::size_t frame = 0; frame < frames; ++frame) {
        if (frame % 64 == 0)
            report(progress, 0.1 + 0.8 * static_cast<double>(frame) / static_cast<double>(frames));
        for (humanoid::Channel& channel : clip.channels) {
            const BvhJoint& joint = hierarchy.joints[channel.node];
            row.clear();
            for (std::size_t i = 0; i < joint.channels.size(); ++i) row.push_back(words.number());
            const rig::Transform local =
                local_of(joint, hierarchy.nodes[channel.node].parent < 0, row.data());
            if (!channel.translation.times.empty()) channel.translation.values.push_back(local.translation);
            if (!channel.rotation.times.empty()) channel.rotation.values.push_back(local.rotation);
        }
    }
    if (const std::string_view more = words.next(); !more.empty())
        words.fail("expected the end of the file after " + std::to_string(frames) + " frames, found " +
                   Words::shown(more));
    return clip;
}

bool has_keys(const humanoid::Clip& clip) {
    return std::any_of(clip.channels.begin(), clip.channels.end(), [](const humanoid::Channel& each) {
        return !each.translation.times.empty() || !each.rotation.times.empty();
    });
}

double height_of(const humanoid::Skeleton& skeleton) {
    std::vector<humanoid::Placement> placements(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), placements);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const humanoid::Placement& each : placements) {
        low = std::min(low, each.position.y);
        high = std::max(high, each.position.y);
    }
    return high - low;
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
    std::vector<humanoid::Clip> clips;
    clips.push_back(read_motion(words, hierarchy, progress));
    const LengthUnit unit = guess_unit(height_of(skeleton_of(hierarchy.nodes)));
    character.scale = unit.metres;
    character.notes.push_back(
        std::string("BVH files do not state a unit; judging by the figure's height, this one is in ") +
        unit.name + '.');
    normalise(hierarchy.nodes, clips, unit.metres);
    character.skeleton = skeleton_of(std::move(hierarchy.nodes));
    for (const humanoid::Clip& clip : clips)
        if (const Result bad = check(clip, character.skeleton); !bad)
            throw std::runtime_error(std::string(bad.message()));
    if (has_keys(clips.front())) character.clips = std::move(clips);
    return character;
}

}  // namespace

Character parse_bvh(std::string_view text, const std::string& name, LoadProgress* progress) {
    try {
        if (text.empty()) throw std::runtime_error("is empty");
        if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // a byte order mark
        Words words(text);
        return read(words, progress);
    } catch (const std::runtime_error& error) {
        const std::string what = error.what();
        throw std::runtime_error(name + (what.starts_with("line ") ? ", " : ": ") + what);
    }
}

}  // namespace tendril::app
