#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/io/character/bvh.hpp"

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using humanoid::Placement;
using humanoid::Skeleton;

constexpr double degrees = 180.0 / 3.14159265358979323846;

/// Euler angles z, x and y in degrees, intrinsic in that order, the most common one. If x is a quarter turn,
/// y is 0.
glm::dvec3 angles_zxy(const glm::dquat& q) {
    const double sine_x = 2.0 * (q.w * q.x + q.y * q.z);
    const double x = 0.5 * math::pi - math::arccosine(sine_x);
    if (std::abs(sine_x) > 1.0 - 1e-12) return {2.0 * math::arctangent(q.z, q.w) * degrees, x * degrees, 0.0};
    const double z = math::arctangent(2.0 * (q.w * q.z - q.x * q.y), 1.0 - 2.0 * (q.x * q.x + q.z * q.z));
    const double y = math::arctangent(2.0 * (q.w * q.y - q.x * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
    return {z * degrees, x * degrees, y * degrees};
}

class Writer {
  public:
    Writer(const Skeleton& skeleton, const humanoid::Clip& clip, double rate)
        : skeleton_(skeleton), clip_(clip), rate_(rate), rest_(skeleton.size()), now_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), rest_);
        moves_.assign(skeleton.size(), false);
        for (const std::int32_t each : skeleton.order())
            if (skeleton[at(each)].parent < 0) moves_[at(each)] = true;
        frames_ = frames_at(clip, rate);
        find_what_moves();
        find_unit();
    }
    std::string text() {
        text_ = "HIERARCHY\n";
        for (const std::int32_t each : skeleton_.order())
            if (skeleton_[at(each)].parent < 0) write_joint(at(each));
        text_ += "MOTION\nFrames: " + std::to_string(frames_.count) + "\nFrame Time: ";
        write_exactly(1.0 / rate_);
        text_ += '\n';
        for (std::size_t frame = 0; frame < frames_.count; ++frame) write_frame(frame);
        return std::move(text_);
    }

  private:
    static std::size_t at(std::int32_t node) { return static_cast<std::size_t>(node); }
    /// True if the node came from an end site: it has the reader's name for one, and is not animated.
    bool is_end_site(std::size_t node) const {
        const std::int32_t parent = skeleton_[node].parent;
        return skeleton_.children(node).empty() && parent >= 0 &&
               skeleton_[node].name == skeleton_[at(parent)].name + " end" && !turns_or_moves(node);
    }
    /// A BVH file has no unit. guess_unit() recognises metres up to a height of about 5.5 m, and millimetres
    /// above 4.5 m.
    void find_unit() {
        double low = 0.0, high = 0.0;
        for (std::size_t node = 0; node < skeleton_.size(); ++node) {
            const double height = rest_[node].position.y;
            low = node == 0 ? height : std::min(low, height);
            high = node == 0 ? height : std::max(high, height);
        }
        unit_ = high - low < 4.5 ? 1.0 : 1000.0;
    }
    /// Replaces braces and control characters, which would end a name.
    static std::string written(std::string name) {
        for (char& c : name)
            if (c == '{' || c == '}' || static_cast<unsigned char>(c) < ' ') c = '_';
        return name;
    }
    bool turns_or_moves(std::size_t node) const {
        return moves_[node] ||
               std::any_of(clip_.channels.begin(), clip_.channels.end(), [&](const auto& channel) {
                   return channel.node == node && !channel.rotation.times.empty();
               });
    }
    void pose_at(std::size_t frame) {
        pose_.resize(skeleton_.size());
        sample(clip_, skeleton_, std::min(frames_.time(frame), clip_.duration), pose_);
        place(skeleton_, pose_, now_);
    }
    /// The vector from a node's parent to the node, in the parent's frame relative to rest.
    glm::dvec3 reach(std::size_t node) const {
        const glm::dvec3 way = now_[node].position - now_[at(skeleton_[node].parent)].position;
        return conjugate(turned(at(skeleton_[node].parent))) * way;
    }
    glm::dquat turned(std::size_t node) const {
        return now_[node].rotation() * conjugate(rest_[node].rotation());
    }
    glm::dvec3 offset(std::size_t node) const {
        const std::int32_t parent = skeleton_[node].parent;
        return parent < 0 ? rest_[node].position : rest_[node].position - rest_[at(parent)].position;
    }
    void find_what_moves() {
        for (std::size_t frame = 0; frame < frames_.count; ++frame) {
            pose_at(frame);
            for (std::size_t node = 0; node < skeleton_.size(); ++node)
                if (!moves_[node] && distance(reach(node), offset(node)) > 1e-5) moves_[node] = true;
        }
    }

    /// Writes the frame time exactly: with six decimals, time would drift by a frame in ten hours, and a fast
    /// foot by a tenth of a millimetre in two seconds.
    void write_exactly(double value) {
        char digits[32];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
    }
    void write(double value) {
        char digits[32];
        const auto [end, error] =
            std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, 6);
        text_.append(digits, error == std::errc() ? end : digits);
    }
    void write(const glm::dvec3& value) {
        for (int i = 0; i < 3; ++i) text_ += ' ', write(value[i]);
    }
    void write_length(const glm::dvec3& value) { write(value * unit_); }
    void line(const std::string& what) { text_.append(2 * depth_, ' ') += what + '\n'; }
    void write_offset(const glm::dvec3& value) {
        text_.append(2 * depth_, ' ') += "OFFSET";
        write_length(value);
        text_ += '\n';
    }
    void write_joint(std::size_t node) {
        const bool is_root = skeleton_[node].parent < 0;
        if (is_end_site(node)) {
            line("End Site");
        } else {
            line((is_root ? "ROOT " : "JOINT ") + written(skeleton_[node].name));
            joints_.push_back(node);
        }
        line("{");
        ++depth_;
        // A root's position is added to its offset, so the offset is 0.
        write_offset(is_root ? glm::dvec3(0.0) : offset(node));
        if (!is_end_site(node)) {
            line(moves_[node] ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
                              : "CHANNELS 3 Zrotation Xrotation Yrotation");
            for (const std::int32_t child : skeleton_.children(node)) write_joint(at(child));
            if (skeleton_.children(node).empty()) write_end_of(node);
        }
        --depth_;
        line("}");
    }
    /// A joint without children needs an end site: extend its own offset by a fifth.
    void write_end_of(std::size_t node) {
        line("End Site");
        line("{");
        ++depth_;
        write_offset(skeleton_[node].parent < 0 ? glm::dvec3(0.0) : 0.2 * offset(node));
        --depth_;
        line("}");
    }
    void write_frame(std::size_t frame) {
        pose_at(frame);
        const std::size_t begin = text_.size();
        for (const std::size_t node : joints_) {
            const std::int32_t parent = skeleton_[node].parent;
            if (moves_[node]) write_length(parent < 0 ? now_[node].position : reach(node));
            const glm::dquat turn = parent < 0 ? turned(node) : conjugate(turned(at(parent))) * turned(node);
            write(angles_zxy(turn));
        }
        if (text_.size() > begin) text_.erase(begin, 1);
        text_ += '\n';
    }

    const Skeleton& skeleton_;
    const humanoid::Clip& clip_;
    double rate_, unit_ = 1.0;
    std::vector<Placement> rest_, now_;
    std::vector<rig::Transform> pose_{};
    std::vector<bool> moves_{};
    std::vector<std::size_t> joints_{};
    humanoid::Frames frames_{};
    std::size_t depth_ = 0;
    std::string text_{};
};

}  // namespace

std::string bvh_text(const Skeleton& skeleton, const humanoid::Clip& clip, double rate) {
    return Writer(skeleton, clip, rate).text();
}

}  // namespace tendril::app
