#include "app/labs/chain/draw.hpp"
#include "app/labs/chain/engine_trace.hpp"

#include <imgui.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

#include "app/io/text.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/chain/chain_part.hpp"
#include "app/labs/chain/panel.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/kit/race.hpp"
#include "app/widgets/icons.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_labels = 2000;  ///< more would not fit

/// The radius of a joint's ball, in pixels: constant, but smaller where joints crowd together.
float joint_pixels(const ChainPart& part, const Camera& camera, float scale) {
    const float largest = 7.5f * scale, smallest = 2.5f * scale;
    if (part.chain.size() < 2) return largest;
    const float mean_length = part.chain.reach() / static_cast<float>(part.chain.size() - 1);
    const float metres_per_pixel = camera.metres_per_pixel(camera.pose().target);
    return std::clamp(0.3f * mean_length / metres_per_pixel, smallest, largest);
}

/// Draws the pole target, and the line that it turns the chain about.
void draw_pole(const View& view, const ChainPart& part, DrawList& list) {
    if (!part.reach.options.pole || !view.handles) return;
    const glm::vec3 at = *part.reach.options.pole;
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

/// The silhouette of a sphere: smaller than its great circle, and nearer to the eye.
void outline(const View& view, DrawList& list, glm::vec3 centre, float radius) {
    const Camera& camera = view.camera;
    glm::vec3 middle = centre;
    float seen = radius;
    glm::vec3 towards = -camera.forward();
    if (!camera.pose().orthographic) {
        const float distance = glm::distance(camera.eye(), centre);
        if (!(distance > 1.001f * radius)) return;  // no silhouette from inside
        towards = (camera.eye() - centre) / distance;
        const float share = radius / distance;
        middle = centre + towards * (radius * share);
        seen = radius * std::sqrt(1.0f - share * share);
    }
    const glm::vec3 across = glm::normalize(glm::cross(camera.up(), towards));
    draw_circle(list, middle, seen, across, glm::cross(towards, across), 1.5f * view.scale,
                faded(view.palette, view.palette.ghost, 0.38f));
}

/// Draws the sphere within the chain's reach as faint outlines: its silhouette, and its intersection with the
/// ground.
void draw_reach_sphere(const View& view, const ShownChain& shown, DrawList& list) {
    if (shown.part.chain.size() < 2) return;
    const glm::vec3 root = shown.part.chain.position(0);
    const float reach = shown.part.chain.reach();
    if (!(reach > 0.0f)) return;
    if (shown.part.reach.plane) return;  // draw_plane draws the circle
    outline(view, list, root, reach);
    const float high = std::abs(root.y);
    if (high >= reach) return;
    const glm::vec3 foot(root.x, 0.0f, root.z);
    draw_circle(list, foot, std::sqrt(reach * reach - high * high), {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f},
                view.scale, faded(view.palette, view.palette.ghost, 0.3f));
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
        draw_plane();
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
        if (!part_.study.open()) draw_past_ghosts(view_, chain_past(), list_);
        draw_traced_ghost(view_, part_, list_);
        draw_incident(view_, part_, list_);
        path();
        if (part_.mode == ChainMode::Curve)
            draw_curve(view_, part_, list_);
        else
            target();
        labels();
    }

  private:
    glm::vec3 at(std::size_t i) const { return shown_[i]; }
    float length(std::size_t i) const { return part_.chain.segments()[i].length; }

    float px(float pixels) const { return pixels * view_.scale; }

    /// The region within reach in the chain's plane: a disc, so that orbiting shows that it is flat.
    void draw_plane() {
        if (!part_.reach.plane || part_.chain.size() < 2) return;
        const glm::vec3 normal = glm::normalize(part_.reach.plane->normal);
        const glm::vec3 across = ik::base_direction(normal, part_.chain.default_direction());
        draw_circle(list_, part_.chain.position(0), part_.chain.reach(), across, glm::cross(normal, across),
                    px(1.5f), faded(view_.palette, view_.palette.ghost, 0.45f));
        const glm::vec3 below = in_plane(part_.chain, part_.reach, part_.target);
        list_.line(part_.target, below, px(1.0f), glm::vec4(view_.palette.target, 0.6f));
    }

    glm::vec3 joint_colour(std::size_t i) const {
        const Palette& p = view_.palette;
        if (i == 0) return p.head;
        if (i + 1 == part_.chain.size()) return p.tail;
        return bones_ ? glm::mix(p.joint, p.neutral, 0.75f) : p.joint;
    }

    /// Metres, at the thick end of the bone that ends at joint i.
    float bone_radius(std::size_t i) const { return std::min(0.13f * length(i), 0.16f); }

    /// Pixels. The ball may be smaller if bones are drawn, since the bone shows where its joint is.
    float joint_radius(std::size_t i) const {
        if (!bones_) return ball_;
        const float bone =
            i + 1 < part_.chain.size() ? bone_radius(i + 1) / view_.camera.metres_per_pixel(at(i)) : 0.0f;
        return std::max(0.75f * ball_, 0.8f * bone);
    }

    /// The bone from joint i - 1 to joint i.
    void bone(std::size_t i) {
        if (bones_) return tapered_bone(i);
        const float width = std::clamp(0.45f * ball_, px(1.5f), px(3.0f));
        Stroke& stroke = list_.line(at(i - 1), at(i), width, glm::vec4(view_.palette.neutral, 1.0f));
        stroke.shadow = true;
        stroke.pick = segment_pick(i);
    }

    /// Thickest near its start, as in animation software, to show its direction. The shadow is wider, so that
    /// it stays visible on the ground from high above.
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
        if (view_.handles && part_.selection.has(i)) {
            list_
                .ring(at(i), grown + px(4.0f), px(part_.selection.active() == i ? 2.5f : 1.5f),
                      glm::vec4(view_.palette.selection, 1.0f))
                .layer = Layer::Overlay;
        } else if (hovered) {
            list_.ring(at(i), grown + px(3.0f), px(1.5f), glm::vec4(view_.palette.text, 0.55f)).layer =
                Layer::Overlay;
        }
        if (view_.handles && part_.mode == ChainMode::WithIndex && part_.index == i) {
            list_.ring(at(i), grown + px(8.0f), px(1.5f), glm::vec4(view_.palette.target, 0.8f)).layer =
                Layer::Overlay;
        }
    }

    /// The target, with a line to the ground that shows its height.
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
        if (!view_.handles) return;
        list_
            .ring(at, px(hovered ? 18.0f : 16.5f), px(1.5f),
                  glm::vec4(view_.palette.target, hovered ? 1.0f : 0.6f))
            .layer = Layer::Overlay;
    }

    /// The path of a moving target.
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
        if (chain_.race) return;  // a race shows other joints than the chain's
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
            if (view_.handles && selected && segment_pick(*selected) != pick) label(*selected, 2);
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

glm::vec3 pole_colour(const Palette& palette) {
    return curve_colour(palette);
}

glm::vec3 solver_colour(const Palette& palette, ik::Method method) {
    static_assert(ik::all_methods.size() <= max_racers);
    return racer_colour(palette, static_cast<std::size_t>(method));
}

ShownChain shown_chain(const Workspace& workspace) {
    const ChainPart& part = chain_part(workspace);
    return {workspace.runtimes.of<ChainRuntime>(chain_lab).studied(part), part};
}

std::vector<glm::vec3> shown_joints(const ShownChain& shown) {
    return shown.trace ? shown.trace->pose(shown.part.study.step) : positions(shown.part.chain);
}

bool shows_end(const ShownChain& shown) {
    return !shown.trace || shown.part.study.step == shown.trace->frames();
}

const ik::ActiveLimit* shown_active_limit(const ShownChain& shown) {
    const auto& result = shown.part.result;
    return result && result->active_limit && shows_end(shown) ? &*result->active_limit : nullptr;
}

ShownSegment shown_segment(const ShownChain& shown, const std::vector<glm::vec3>& joints, std::size_t index) {
    const float length = shown.part.chain.segments()[index].length;
    if (index == 0) return {joints[0], length, 0.0f};
    const float distance = glm::distance(joints[index], joints[index - 1]);
    // At the end of a solve, show the stored length: the rounding difference is in `error`.
    return {joints[index], shows_end(shown) ? length : distance, std::abs(distance - length)};
}

float worst_error(const ShownChain& shown, const std::vector<glm::vec3>& joints) {
    const auto segments = shown.part.chain.segments();
    float worst = 0.0f;
    for (std::size_t i = 1; i < joints.size(); ++i) {
        worst = std::max(worst, std::abs(glm::distance(joints[i], joints[i - 1]) - segments[i].length));
    }
    return worst;
}

const char* end_name(const ChainPart& part, std::size_t index) {
    const bool reaches = part.mode == ChainMode::Reach || part.mode == ChainMode::Curve;
    if (index == 0) return reaches ? "root" : "head";
    if (index + 1 == part.chain.size()) return reaches ? "tip" : "tail";
    return "";
}

float shown_residual(const ChainPart& part, const std::vector<glm::vec3>& joints) {
    if (joints.empty()) return 0.0f;
    return glm::distance(joints.back(), in_plane(part.chain, part.reach, part.target));
}

void draw_incident(const View& view, const ChainPart& part, DrawList& list) {
    const auto& incident = view.workspace.ui.incident;
    if (!incident) return;
    const auto before = std::dynamic_pointer_cast<const ChainPart>(view.workspace.around(*incident).before);
    if (!before || before->chain.size() != part.chain.size() || incident->joint >= part.chain.size()) return;
    const auto was = before->chain.segments(), is = part.chain.segments();
    const glm::vec4 ghost = faded(view.palette, view.palette.ghost, 0.9f);
    for (std::size_t i = 1; i < was.size(); ++i)
        list.line(was[i - 1].position, was[i].position, 2.5f * view.scale, ghost);
    for (const Segment& joint : was) list.sphere(joint.position, 4.5f * view.scale, Unit::Pixels, ghost);
    list.ring(before->target, 12.0f * view.scale, 1.5f * view.scale, ghost).layer = Layer::Overlay;
    const std::size_t joint = incident->joint;
    const bool traced = !incident->title.empty(), flip = incident->kind == Incident::Kind::Flip;
    if (flip || traced || incident->kind == Incident::Kind::Jump)
        draw_incident_mark(view, *incident, is[joint].position, list);
    if (!flip) return;
    // Turn about the neighbour that moved less.
    const auto moved = [&](std::size_t i) { return glm::distance(was[i].position, is[i].position); };
    const bool last = joint + 1 == is.size();
    const std::size_t about =
        joint == 0 || (!last && moved(joint + 1) < moved(joint - 1)) ? joint + 1 : joint - 1;
    draw_turn(view, was[joint].position, is[joint].position, is[about].position, list);
}

void draw_circle(DrawList& list, glm::vec3 centre, float radius, glm::vec3 across, glm::vec3 up, float pixels,
                 glm::vec4 colour) {
    constexpr int sides = 128;
    glm::vec3 from = centre + radius * across;
    for (int i = 1; i <= sides; ++i) {
        const float angle = glm::two_pi<float>() * static_cast<float>(i) / sides;
        const glm::vec3 to = centre + radius * (math::cosine(angle) * across + math::sine(angle) * up);
        list.line(from, to, pixels, colour);
        from = to;
    }
}

LabSetting reach_sphere() {
    return {.key = "reach sphere",
            .command = "view.reach_sphere",
            .title = "Show or hide the reach sphere",
            .argument = "show",
            .help = "Shows the sphere that the chain can reach, in mode reach",
            .choices = {{"off", "hidden"}, {"on", "shown"}}};
}

namespace {

/// A sketch of a mode in a 3 by 1 box: the joints from head to tail, with the index of the one that goes to
/// the target, and of the one that stays, if any.
struct ModePicture {
    std::vector<glm::vec2> joints;
    std::size_t at_target = 0;
    int stays = -1;
};

ModePicture picture_of(ChainMode mode) {
    switch (mode) {
        case ChainMode::Forward:
            return {{{2.7f, 0.25f}, {1.9f, 0.45f}, {1.1f, 0.6f}, {0.3f, 0.65f}}, 0};
        case ChainMode::Backward:
            return {{{0.3f, 0.65f}, {1.1f, 0.6f}, {1.9f, 0.45f}, {2.7f, 0.25f}}, 3};
        case ChainMode::Fixed:
            return {{{2.6f, 0.45f}, {1.9f, 0.1f}, {1.1f, 0.25f}, {0.5f, 0.8f}}, 0, 3};
        case ChainMode::WithIndex:
            return {{{0.4f, 0.85f}, {0.9f, 0.45f}, {1.5f, 0.15f}, {2.1f, 0.45f}, {2.6f, 0.85f}}, 2};
        case ChainMode::Curve:
            return {{{0.3f, 0.3f}, {0.7f, 0.75f}, {1.3f, 0.75f}, {1.75f, 0.3f}, {2.35f, 0.25f}}, 4, 0};
        case ChainMode::Reach:
            break;
    }
    return {{{0.5f, 0.8f}, {1.1f, 0.25f}, {1.9f, 0.1f}, {2.6f, 0.45f}}, 3, 0};
}

}  // namespace

void draw_mode(ChainMode mode, const Palette& colours, float short_of, float scale) {
    const float high = scale * ImGui::GetTextLineHeight(), wide = 3.0f * high;
    const ImVec2 low = ImGui::GetItemRectMin(), top = ImGui::GetItemRectMax();
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x - short_of;
    if (right - wide < top.x + 0.5f * high) return;  // text takes precedence
    const ImVec2 corner{right - wide, 0.5f * (low.y + top.y) - 0.5f * high};
    const auto at = [&](glm::vec2 place) {
        return ImVec2(corner.x + place.x * high, corner.y + place.y * high);
    };
    const auto ink = [](glm::vec3 colour) { return imgui_u32(colour); };
    const ModePicture picture = picture_of(mode);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float unit = high / 15.0f;
    for (std::size_t i = 1; i < picture.joints.size(); ++i)
        list->AddLine(at(picture.joints[i - 1]), at(picture.joints[i]), ink(colours.neutral), 1.5f * unit);
    for (std::size_t i = 0; i < picture.joints.size(); ++i) {
        const bool head = i == 0, tail = i + 1 == picture.joints.size();
        const glm::vec3 colour = head ? colours.head : tail ? colours.tail : colours.joint;
        list->AddCircleFilled(at(picture.joints[i]), (head || tail ? 2.6f : 2.0f) * unit, ink(colour), 12);
    }
    list->AddCircle(at(picture.joints[picture.at_target]), 4.8f * unit, ink(colours.target), 16, 1.5f * unit);
    if (picture.stays < 0) return;
    const ImVec2 foot = at(picture.joints[static_cast<std::size_t>(picture.stays)]);
    list->AddLine({foot.x - 5.0f * unit, foot.y + 4.0f * unit}, {foot.x + 5.0f * unit, foot.y + 4.0f * unit},
                  ink(colours.text_dim), 1.5f * unit);
}

}  // namespace tendril::app
