// Limits as they are: a cone where the bone may point, a fan for a hinge, a dial for twist.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/labs/chain/colours.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/limit_pen.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_limits =
    24;  ///< drawn; in longer chains those of the selected joints and of the active limit

class LimitDrawing {
  public:
    LimitDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view),
          part_(shown.part),
          list_(list),
          active_(shown_active_limit(shown)),
          bones_(segment_style().chosen(view.workspace.settings) == 1),
          joints_(shown_joints(shown)),
          turns_(rotations_at(joints_, part_.reach.state.rotations, part_.chain.default_direction())) {}

    void run() {
        const std::size_t bones = joints_.size() - 1;
        for (std::size_t i = 0; i < bones; ++i) {
            const bool shown = bones <= max_limits || is_active(i) || part_.selection.has(i);
            if (shown && limit_of(part_.reach, i).kind != ik::JointKind::Free) joint(i);
        }
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    bool is_active(std::size_t i) const { return active_ != nullptr && active_->joint == i; }

    void joint(std::size_t i) {
        const ik::Limit limit = limit_of(part_.reach, i);
        const glm::vec3 rest = part_.chain.default_direction();
        const glm::quat parent = i == 0 ? glm::quat(1, 0, 0, 0) : turns_[i - 1];
        const float bone = part_.chain.segments()[i + 1].length;
        const float pixels = 90.0f * view_.scale * view_.camera.metres_per_pixel(joints_[i]);
        const bool active = is_active(i), lit = active || part_.selection.has(i);
        const LimitShape shape(limit, rest, parent);
        const LimitLook look{.centre = joints_[i],
                             .radius = std::min(0.75f * bone, pixels),
                             .colour = active ? view_.palette.limit
                                       : lit  ? view_.palette.selection
                                              : view_.palette.ghost,
                             .strength = lit ? 1.0f : 0.75f};
        const LimitPen pen(view_, list_, look);
        const ik::JointAngles angles = ik::measure(limit, rest, glm::conjugate(parent) * turns_[i]);
        if (bones_ && shape.is_hinge()) pen.fill(shape);
        pen.outline(shape);
        pen.dot(shape, angles);
        pen.dial(shape, angles, 0.5f, 0.22f);
        pen.rest(shape);
        if (active) {
            needed(pen, look, shape, angles);
            list_.ring(look.centre, px(13.0f), px(3.0f), glm::vec4(view_.palette.limit, 1.0f)).layer =
                Layer::Overlay;
        }
    }

    /// Where the bone would have to point for the target, dashed, with the angle beside it.
    void needed(const LimitPen& pen, const LimitLook& look, const LimitShape& shape,
                const ik::JointAngles& now) {
        const ik::ActiveLimit& limit = *active_;
        if (limit.bound == ik::Bound::TwistMin || limit.bound == ik::Bound::TwistMax) return;
        const bool sideways = limit.bound == ik::Bound::Left || limit.bound == ik::Bound::Right;
        const bool down = limit.bound == ik::Bound::Down || limit.bound == ik::Bound::Right;
        const float angle = down ? -std::abs(limit.needed) : limit.needed;
        const glm::vec3 towards =
            look.radius * (sideways ? shape.direction(now.up, angle) : shape.direction(angle, now.left));
        constexpr int dashes = 7;
        for (int i = 0; i < dashes; ++i) {
            const float from = (static_cast<float>(i) + 0.2f) / dashes;
            pen.line(look.centre + from * towards, look.centre + (from + 0.6f / dashes) * towards, 2.0f,
                     1.0f);
        }
        list_.labels.push_back({.at = look.centre + 1.05f * towards,
                                .clearance = px(6.0f),
                                .text = "needs " + needed_degrees(limit) + "\xc2\xb0",
                                .colour = view_.palette.text,
                                .rank = 3});
    }

    const View& view_;
    const ChainPart& part_;
    DrawList& list_;
    const ik::ActiveLimit* active_;
    bool bones_;
    std::vector<glm::vec3> joints_;
    std::vector<glm::quat> turns_;
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
