#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "app/document/units.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/past.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_labels = 2000;  ///< more would never find space beside one another

/// How large a joint's ball is, in pixels: a handle of steady size, smaller only where the joints crowd
/// together.
float joint_pixels(const ChainPart& part, const Camera& camera, float scale) {
    const float largest = 7.5f * scale, smallest = 2.5f * scale;
    if (part.chain.size() < 2) return largest;
    const float mean_length = part.chain.reach() / static_cast<float>(part.chain.size() - 1);
    const float metres_per_pixel = camera.metres_per_pixel(camera.pose().target);
    return std::clamp(0.3f * mean_length / metres_per_pixel, smallest, largest);
}

class Drawing {
  public:
    Drawing(const View& view, DrawList& list)
        : view_(view),
          list_(list),
          chain_(shown_chain(view.workspace)),
          part_(chain_.part),
          shown_(shown_joints(chain_)),
          ball_(joint_pixels(part_, view.camera, view.scale)),
          bones_(segment_style().chosen(view.workspace.settings) == 1) {}

    void run() {
        list_.strokes.reserve(2 * part_.chain.size() + 16);
        if (part_.mode == ChainMode::Reach && reach_sphere().chosen(view_.workspace.settings) == 1)
            draw_reach_sphere(view_, chain_, list_);
        const bool racing = chain_.race != nullptr;
        if (racing) {
            draw_race(view_, chain_, list_);
        } else {
            for (std::size_t i = 1; i < part_.chain.size(); ++i) bone(i);
            for (std::size_t i = 0; i < part_.chain.size(); ++i) joint(i);
        }
        if (chain_.trace) draw_microscope(view_, chain_, list_);
        if (part_.mode == ChainMode::Reach) {
            draw_limits(view_, chain_, list_);
            draw_pole(view_, part_, list_);
        }
        if (!part_.study.open()) draw_past_ghosts(view_, chain_past(), chain_lines, list_);
        draw_incident(view_, part_, list_);
        path();
        target();
        labels();
    }

  private:
    glm::vec3 at(std::size_t i) const { return shown_[i]; }
    float length(std::size_t i) const { return part_.chain.segments()[i].length; }

    float px(float pixels) const { return pixels * view_.scale; }

    glm::vec3 joint_colour(std::size_t i) const {
        const Palette& p = view_.palette;
        if (i == 0) return p.head;
        if (i + 1 == part_.chain.size()) return p.tail;
        return bones_ ? glm::mix(p.joint, p.neutral, 0.75f) : p.joint;
    }

    /// Metres, at the thick end of the bone that leads to joint i.
    float bone_radius(std::size_t i) const { return std::min(0.13f * length(i), 0.16f); }

    /// Pixels. A bone shows by itself where its joint is, so the ball may be small, but not much smaller than
    /// the bone.
    float joint_radius(std::size_t i) const {
        if (!bones_) return ball_;
        const float bone =
            i + 1 < part_.chain.size() ? bone_radius(i + 1) / view_.camera.metres_per_pixel(at(i)) : 0.0f;
        return std::max(0.75f * ball_, 0.8f * bone);
    }

    /// From joint i - 1 to joint i.
    void bone(std::size_t i) {
        if (bones_) return tapered_bone(i);
        const float width = std::clamp(0.45f * ball_, px(1.5f), px(3.0f));
        Stroke& stroke = list_.line(at(i - 1), at(i), width, glm::vec4(view_.palette.neutral, 1.0f));
        stroke.shadow = true;
        stroke.pick = segment_pick(i);
    }

    /// Thickest a little way from where it starts, as animation programs draw bones: one sees which way it
    /// leads. Its shadow is that of a thicker one, so that it is seen on the ground from a height too.
    void tapered_bone(std::size_t i) {
        constexpr float thickest = 0.17f, wide = 2.6f;
        const glm::vec3 from = at(i - 1), to = at(i);
        const float thick = bone_radius(i);
        const glm::vec3 widest = glm::mix(from, to, thickest);
        const glm::vec4 paint(view_.palette.joint, 1.0f);
        list_.bone(from, widest, 0.4f * thick, thick, paint).pick = segment_pick(i);
        list_.bone(widest, to, thick, 0.34f * thick, paint).pick = segment_pick(i);
        list_.bone(widest, to, wide * thick, 0.6f * wide * thick, glm::vec4(paint.r, paint.g, paint.b, 0.0f))
            .shadow = true;
    }

    void joint(std::size_t i) {
        const PickId pick = segment_pick(i);
        const bool hovered = view_.hovered == pick || view_.dragged == pick;
        const bool end = i == 0 || i + 1 == part_.chain.size();
        const float grown = joint_radius(i) * (end ? 1.25f : 1.0f) + (hovered ? px(1.5f) : 0.0f);
        Stroke& ball = list_.sphere(at(i), grown, Unit::Pixels, glm::vec4(joint_colour(i), 1.0f));
        ball.shadow = true;
        ball.pick = pick;
        ball.rank = 1;
        if (part_.selection.has(i)) {
            list_
                .ring(at(i), grown + px(4.0f), px(part_.selection.active() == i ? 2.5f : 1.5f),
                      glm::vec4(view_.palette.selection, 1.0f))
                .layer = Layer::Overlay;
        } else if (hovered) {
            list_.ring(at(i), grown + px(3.0f), px(1.5f), glm::vec4(view_.palette.text, 0.55f)).layer =
                Layer::Overlay;
        }
        if (part_.mode == ChainMode::WithIndex && part_.index == i) {
            list_.ring(at(i), grown + px(8.0f), px(1.5f), glm::vec4(view_.palette.target, 0.8f)).layer =
                Layer::Overlay;
        }
    }

    /// A line down to the ground tells how high the target hangs.
    void target() {
        const glm::vec3 at = part_.target;
        const bool hovered = view_.hovered == target_pick || view_.dragged == target_pick;
        const glm::vec4 orange(view_.palette.target, 1.0f);
        if (at.y > 0.05f) {
            list_.line(at, {at.x, 0.0f, at.z}, px(1.0f), glm::vec4(view_.palette.target, 0.35f));
        }
        Stroke& ball = list_.sphere(at, px(hovered ? 12.5f : 11.0f), Unit::Pixels, orange);
        ball.shadow = true;
        ball.layer = Layer::Overlay;
        ball.pick = target_pick;
        ball.rank = 2;
        list_
            .ring(at, px(hovered ? 18.0f : 16.5f), px(1.5f),
                  glm::vec4(view_.palette.target, hovered ? 1.0f : 0.6f))
            .layer = Layer::Overlay;
    }

    /// The way that a moving target goes.
    void path() {
        if (part_.motion.path == Motion::Path::Still) return;
        constexpr std::uint32_t sides = 96;
        const std::uint32_t round = ticks_per_round(part_.motion);
        glm::vec3 from = motion_point(part_.motion, 0);
        for (std::uint32_t i = 1; i <= sides; ++i) {
            const glm::vec3 to = motion_point(part_.motion, round * i / sides);
            list_.line(from, to, px(1.5f), glm::vec4(view_.palette.target, 0.3f));
            from = to;
        }
    }

    void label(std::size_t i, int rank) {
        const std::string end = end_name(part_, i);
        std::string text = std::to_string(i) + (end.empty() ? "" : " " + end);
        if (i > 0) text += "  " + short_text(static_cast<double>(length(i)), "m");
        // The target's ring is wider than a joint.
        const float target_pixels =
            glm::distance(at(i), part_.target) / view_.camera.metres_per_pixel(part_.target);
        const float clearance = target_pixels < ball_ ? px(20.0f) : ball_ + px(7.0f);
        list_.labels.push_back({.at = at(i),
                                .clearance = clearance,
                                .text = std::move(text),
                                .colour = view_.palette.text,
                                .rank = rank});
    }

    void labels() {
        if (view_.workspace.settings.labels == LabelMode::Always) {
            const std::size_t stride = part_.chain.size() / max_labels + 1;
            for (std::size_t i = 0; i < part_.chain.size(); i += stride) {
                const bool end = i == 0 || i + 1 == part_.chain.size();
                label(i, part_.selection.has(i) ? 2 : end ? 1 : 0);
            }
        } else {
            const PickId pick = view_.dragged != no_pick ? view_.dragged : view_.hovered;
            if (pick != no_pick && pick != target_pick && pick != pole_pick &&
                picked_segment(pick) < part_.chain.size()) {
                label(picked_segment(pick), 3);
            }
            const auto selected = part_.selection.active();
            if (selected && segment_pick(*selected) != pick) label(*selected, 2);
        }
    }

    const View& view_;
    DrawList& list_;
    const ShownChain chain_;
    const ChainPart& part_;
    std::vector<glm::vec3> shown_;
    float ball_;
    bool bones_;
};

}  // namespace

LabSetting segment_style() {
    return {.key = "segments",
            .command = "view.segments",
            .title = "Draw spheres or tapered bones",
            .argument = "style",
            .help = "Draws segments as lines and spheres, or as tapered bones",
            .choices = {{"spheres", "lines and spheres"}, {"bones", "bones"}}};
}

void ChainLab::draw(const View& view, DrawList& list) const {
    Drawing(view, list).run();
}

}  // namespace tendril::app
