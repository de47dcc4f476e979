// Limits as they are: a cone where the bone may point, a fan for a hinge, a dial for twist.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/labs/chain/colours.hpp"
#include "app/labs/chain/draw.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t most_limits =
    24;  ///< drawn; in longer chains those of the selected joint and of the active limit

class LimitDrawing {
  public:
    LimitDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view),
          part_(shown.part),
          list_(list),
          active_(shown_active_limit(shown)),
          joints_(shown_joints(shown)),
          turns_(rotations_at(joints_, part_.reach.state.rotations, part_.chain.default_direction())) {}

    void run() {
        const std::size_t bones = joints_.size() - 1;
        for (std::size_t i = 0; i < bones; ++i) {
            const bool shown = bones <= most_limits || is_active(i) || part_.selected == i;
            if (shown && limit_of(part_.reach, i).kind != ik::JointKind::Free) joint(i);
        }
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    bool is_active(std::size_t i) const { return active_ != nullptr && active_->joint == i; }

    void joint(std::size_t i) {
        limit_ = limit_of(part_.reach, i);
        centre_ = joints_[i];
        const float bone = part_.chain.segments()[i + 1].length;
        const float pixels = 90.0f * view_.scale * view_.camera.metres_per_pixel(centre_);
        radius_ = std::min(0.75f * bone, pixels);
        rest_ = part_.chain.default_direction();
        parent_ = i == 0 ? glm::quat(1, 0, 0, 0) : turns_[i - 1];
        axis_ = limit_.axis - rest_ * glm::dot(limit_.axis, rest_);
        axis_ = glm::length(axis_) > 1e-6f ? glm::normalize(axis_) : glm::vec3(0, 0, 1);
        left_axis_ = glm::cross(axis_, rest_);
        const bool active = is_active(i);
        const bool lit = active || part_.selected == i;
        colour_ = active ? view_.palette.limit : lit ? view_.palette.selection : view_.palette.ghost;
        strength_ = lit ? 1.0f : 0.75f;
        const glm::quat turn = glm::conjugate(parent_) * turns_[i];
        angles_ = ik::measure(limit_, rest_, turn);
        limit_.kind == ik::JointKind::Hinge ? fan() : cone();
        if (limit_.kind != ik::JointKind::Hinge) dial(glm::normalize(turns_[i] * rest_));
        line(centre_, centre_ + radius_ * direction(0.0f, 0.0f), 1.0f, 0.35f);  // where it points at rest
        if (active) {
            needed(*active_);
            list_.ring(centre_, px(13.0f), px(3.0f), glm::vec4(view_.palette.limit, 1.0f)).layer =
                Layer::Overlay;
        }
    }

    /// Where the bone points after a swing of so much up and left.
    glm::vec3 direction(float up, float left) const {
        const glm::vec3 swing = axis_ * up + left_axis_ * left;
        const float angle = glm::length(swing);
        const glm::quat turn = angle < 1e-7f ? glm::quat(1, 0, 0, 0) : glm::angleAxis(angle, swing / angle);
        return parent_ * (turn * rest_);
    }

    void line(glm::vec3 a, glm::vec3 b, float width, float alpha) {
        list_.line(a, b, px(width), faded(view_.palette, colour_, alpha * strength_));
    }

    /// A hinge's range as an arc with its two ends, and where the bone is in it.
    void fan() {
        constexpr int sides = 40;
        glm::vec3 from = centre_ + radius_ * direction(limit_.min, 0.0f);
        line(centre_, from, 2.0f, 0.9f);
        for (int i = 1; i <= sides; ++i) {
            const float share = static_cast<float>(i) / sides;
            const glm::vec3 to =
                centre_ + radius_ * direction(limit_.min + (limit_.max - limit_.min) * share, 0.0f);
            line(from, to, 2.0f, 0.9f);
            if (i % 4 == 0 && i < sides) line(centre_ + 0.9f * (to - centre_), to, 1.0f, 0.6f);
            from = to;
        }
        line(centre_, from, 2.0f, 0.9f);
        needle(angles_.up, 0.0f);
    }

    /// The rim of the cone, with spokes.
    void cone() {
        constexpr int sides = 64;
        glm::vec3 from{};
        for (int i = 0; i <= sides; ++i) {
            const float phi = glm::two_pi<float>() * static_cast<float>(i) / sides;
            const float up = std::sin(phi), left = std::cos(phi);
            const glm::vec3 to =
                centre_ + radius_ * direction(up * (up > 0.0f ? limit_.up : limit_.down),
                                              left * (left > 0.0f ? limit_.left : limit_.right));
            if (i > 0) line(from, to, 2.0f, 0.9f);
            if (i % 8 == 0) line(centre_, to, 1.0f, 0.4f);
            from = to;
        }
        needle(angles_.up, angles_.left);
    }

    /// Where the bone would have to point for the target, dashed, with the angle beside it.
    void needed(const ik::ActiveLimit& limit) {
        if (limit.bound == ik::Bound::TwistMin || limit.bound == ik::Bound::TwistMax) return;
        const bool sideways = limit.bound == ik::Bound::Left || limit.bound == ik::Bound::Right;
        const bool down = limit.bound == ik::Bound::Down || limit.bound == ik::Bound::Right;
        const float angle = down ? -std::abs(limit.needed) : limit.needed;
        const glm::vec3 towards = sideways ? direction(angles_.up, angle) : direction(angle, angles_.left);
        constexpr int dashes = 7;
        for (int i = 0; i < dashes; ++i) {
            const float from = (static_cast<float>(i) + 0.2f) / dashes;
            line(centre_ + radius_ * from * towards, centre_ + radius_ * (from + 0.6f / dashes) * towards,
                 2.0f, 1.0f);
        }
        list_.labels.push_back({.at = centre_ + 1.05f * radius_ * towards,
                                .clearance = px(6.0f),
                                .text = "needs " + needed_degrees(limit) + "\xc2\xb0",
                                .colour = view_.palette.text,
                                .rank = 3});
    }

    void needle(float up, float left) {
        list_.sphere(centre_ + radius_ * direction(up, left), px(3.5f), Unit::Pixels,
                     glm::vec4(colour_, 1.0f));
    }

    /// Twist, as an arc about the bone with a needle.
    void dial(glm::vec3 bone) {
        if (limit_.twist_max <= limit_.twist_min) return;
        constexpr int sides = 32;
        const glm::vec3 middle = centre_ + 0.5f * radius_ * bone;
        const float size = 0.22f * radius_;
        const glm::quat swing = least_rotation(parent_ * rest_, bone) * parent_;
        const auto at = [&](float twist) {
            return middle + size * (glm::angleAxis(twist, bone) * (swing * left_axis_));
        };
        glm::vec3 from = at(limit_.twist_min);
        line(middle, from, 1.5f, 0.8f);
        for (int i = 1; i <= sides; ++i) {
            const float share = static_cast<float>(i) / sides;
            const glm::vec3 to = at(limit_.twist_min + (limit_.twist_max - limit_.twist_min) * share);
            line(from, to, 1.5f, 0.8f);
            from = to;
        }
        line(middle, from, 1.5f, 0.8f);
        list_.line(middle, at(angles_.twist), px(2.0f), glm::vec4(view_.palette.text, 0.9f));
    }

    const View& view_;
    const ChainPart& part_;
    DrawList& list_;
    const ik::ActiveLimit* active_;
    std::vector<glm::vec3> joints_;
    std::vector<glm::quat> turns_;
    // of the joint that is being drawn
    ik::Limit limit_;
    ik::JointAngles angles_;
    glm::vec3 centre_{}, rest_{}, axis_{}, left_axis_{}, colour_{};
    glm::quat parent_{1, 0, 0, 0};
    float radius_ = 0.0f, strength_ = 1.0f;
};

}  // namespace

void draw_limits(const View& view, const ShownChain& shown, DrawList& list) {
    if (shown.part.reach.limits.empty() || shown.part.chain.size() < 2) return;
    LimitDrawing(view, shown, list).run();
}

void draw_pole(const View& view, const ChainPart& part, DrawList& list) {
    if (!part.reach.pole) return;
    const glm::vec3 at = *part.reach.pole;
    const bool hovered = view.hovered == pole_pick || view.dragged == pole_pick;
    if (!part.chain.empty()) {
        const glm::vec3 root = part.chain.position(0), along = part.target - root;
        const float square = glm::dot(along, along);
        const float share =
            square < 1e-9f ? 0.0f : std::clamp(glm::dot(at - root, along) / square, 0.0f, 1.0f);
        list.line(root, part.target, view.scale, faded(view.palette, pole_colour(view.palette), 0.35f));
        list.line(at, root + along * share, 1.5f * view.scale,
                  faded(view.palette, pole_colour(view.palette), 0.5f));
    }
    Stroke& ball = list.sphere(at, (hovered ? 9.5f : 8.0f) * view.scale, Unit::Pixels,
                               glm::vec4(pole_colour(view.palette), 1.0f));
    ball.shadow = true;
    ball.layer = Layer::Overlay;
    ball.pick = pole_pick;
    ball.rank = 2;
    list.labels.push_back({.at = at,
                           .clearance = 12.0f * view.scale,
                           .text = "pole",
                           .colour = view.palette.text_dim,
                           .rank = 1});
}

}  // namespace tendril::app
