// Draws joint limits: a cone, a fan for a hinge, a dial for twist; in a plane an arc with ends that can be
// dragged.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "app/labs/chain/draw.hpp"
#include "app/labs/kit/limit_shape.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_limits =
    24;  ///< in longer chains, only limits of selected joints and the active limit are drawn

class LimitDrawing {
  public:
    LimitDrawing(const View& view, const ShownChain& shown, DrawList& list)
        : view_(view),
          part_(shown.part),
          list_(list),
          active_(shown_active_limit(shown)),
          bones_(segment_style().chosen(view.workspace.settings) == 1),
          joints_(shown_joints(shown)),
          plane_(part_.reach.plane ? &*part_.reach.plane : nullptr),
          rest_(plane_ ? ik::base_direction(plane_->normal, part_.chain.default_direction())
                       : part_.chain.default_direction()),
          turns_(rotations_at(joints_, plane_ ? std::vector<glm::quat>() : part_.reach.state.rotations,
                              rest_)) {}

    void run() {
        const std::size_t bones = joints_.size() - 1;
        for (std::size_t i = 0; i < bones; ++i) {
            const bool shown = bones <= max_limits || is_active(i) || part_.selection.has(i);
            if (shown && limit_at(i).kind != ik::JointKind::Free) joint(i);
        }
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    bool is_active(std::size_t i) const { return active_ != nullptr && active_->joint == i; }

    /// The limit in a plane: a hinge about its normal, measured from straight or from the base.
    ik::Limit limit_at(std::size_t i) const {
        if (!plane_) return limit_of(part_.reach, i);
        const ik::AngleLimit limit = angle_limit_of(*plane_, i);
        return limit.max - limit.min >= glm::radians(359.9f)
                   ? ik::Limit{}
                   : ik::Limit::hinge(glm::normalize(plane_->normal), limit.min, limit.max);
    }

    /// The knobs at the ends of an arc, with "-45" and "+60" degrees.
    void ends(const LimitLook& look, const LimitShape& shape, std::size_t i) {
        for (const bool max : {false, true}) {
            const float angle = max ? shape.limit().max : shape.limit().min;
            const PickId pick = limit_pick({i, max});
            const bool hovered = view_.hovered == pick || view_.dragged == pick;
            if (view_.handles && !part_.study.open()) {
                Stroke& knob = list_.sphere(look.centre + look.radius * shape.direction(angle, 0.0f),
                                            px(hovered ? 6.5f : 5.0f), Unit::Pixels,
                                            glm::vec4(hovered ? view_.palette.selection : look.colour, 1.0f));
                knob.layer = Layer::Overlay;
                knob.pick = pick;
                knob.rank = 1;
            }
            char text[16];
            const bool straight = std::abs(angle) < glm::radians(0.5f);
            std::snprintf(text, sizeof text, straight ? "%.0f\xc2\xb0" : "%+.0f\xc2\xb0",
                          std::round(glm::degrees(static_cast<double>(angle))) + 0.0);
            list_.labels.push_back({.at = look.centre + look.radius * shape.direction(angle, 0.0f),
                                    .clearance = px(8.0f),
                                    .text = text,
                                    .colour = view_.palette.text,
                                    .rank = 1});
        }
    }

    void joint(std::size_t i) {
        const ik::Limit limit = limit_at(i);
        const glm::vec3 rest = rest_;
        const bool from_base = plane_ && angle_limit_of(*plane_, i).from == ik::AngleFrom::Base;
        const glm::quat parent = i == 0 || from_base ? glm::quat(1, 0, 0, 0) : turns_[i - 1];
        const float bone = part_.chain.segments()[i + 1].length;
        const float pixels = 90.0f * view_.scale * view_.camera.metres_per_pixel(joints_[i]);
        const bool active = is_active(i), lit = active || (view_.handles && part_.selection.has(i));
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
        if (plane_) ends(look, shape, i);
        if (active) {
            needed(pen, look, shape, angles);
            list_.ring(look.centre, px(13.0f), px(3.0f), glm::vec4(view_.palette.limit, 1.0f)).layer =
                Layer::Overlay;
        }
    }

    /// The direction that the target needs, dashed and labelled with its angle.
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
    const ChainPlane* plane_;
    glm::vec3 rest_;  ///< direction of all bones at rest
    std::vector<glm::quat> turns_;
};

}  // namespace

void draw_limits(const View& view, const ShownChain& shown, DrawList& list) {
    if (!is_limited(shown.part.reach) || shown.part.chain.size() < 2) return;
    LimitDrawing(view, shown, list).run();
}

}  // namespace tendril::app
