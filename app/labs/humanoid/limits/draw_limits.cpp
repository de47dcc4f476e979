#include "app/labs/humanoid/limits/draw_limits.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/labs/humanoid/character/figure.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/limits/limit_ranges.hpp"
#include "app/labs/humanoid/limits/selected_joints.hpp"
#include "app/labs/kit/limit_pen.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;

bool held(const ShownPose& shown, Bone bone) {
    return shown.body && shown.body->at_limit[static_cast<std::size_t>(bone)];
}

class LimitDrawing {
  public:
    LimitDrawing(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown)
        : view_(view),
          list_(list),
          part_(part),
          shown_(shown),
          solvers_(humanoid_runtime(view.workspace).solvers),
          body_(body_nodes(part)) {}

    void selected(Bone bone, bool active) {
        const auto joint = joint_now(part_, solvers_, shown_, bone);
        if (!joint) return;
        const LimitRanges& ranges = solvers_.limits(part_);
        const LimitShape adult = ranges.shape(bone, *joint->adult, shown_);
        const float radius = radius_of(bone, 0.95f, 160.0f);
        const bool beyond = joint->held || joint->excess > slack;
        const auto range = [&](const ik::Limit& limit, glm::vec3 colour, float dial) {
            const bool in_force = joint->in_force == &limit;
            const LimitShape shape = ranges.shape(bone, limit, shown_);
            const LimitPen pen =
                pen_of(bone, radius, beyond && in_force ? view_.palette.limit : colour,
                       (in_force ? 1.0f : 0.7f) * (active ? 1.0f : 0.5f), in_force && active);
            if (active) pen.fill(shape);
            pen.outline(shape);
            if (active) pen.dial(shape, joint->angles, 0.62f, dial);
        };
        range(*joint->adult, adult_colour(view_.palette), 0.3f);
        if (joint->clips != nullptr) range(*joint->clips, clips_colour(view_.palette), 0.24f);
        const LimitPen now =
            pen_of(bone, radius, beyond ? view_.palette.limit : view_.palette.text, 1.0f, true);
        now.rest(adult);
        now.needle(adult, joint->angles);
        if (joint->held)
            list_
                .ring(centre(bone), 13.0f * view_.scale, 3.0f * view_.scale,
                      glm::vec4(view_.palette.limit, 1.0f))
                .layer = Layer::Overlay;
    }

    /// Without what is learned from clips: that takes a while the first time.
    void held_back(Bone bone) {
        const LimitRanges& ranges = solvers_.limits(part_);
        const ik::Limit limit = ranges.in_force(part_.ik)[static_cast<std::size_t>(bone)];
        if (ranges.adult(bone) == nullptr || limit.kind == ik::JointKind::Free) return;
        outline(bone, ranges, limit, view_.palette.limit);
    }

    void discreet(Bone bone) {
        const auto joint = joint_now(part_, solvers_, shown_, bone);
        if (!joint) return;
        const LimitRanges& ranges = solvers_.limits(part_);
        outline(bone, ranges, *joint->adult, adult_colour(view_.palette));
        if (joint->clips != nullptr) outline(bone, ranges, *joint->clips, clips_colour(view_.palette));
    }

  private:
    static constexpr float slack = 0.002f;  // radians; solvers stop as near as that

    void outline(Bone bone, const LimitRanges& ranges, const ik::Limit& limit, glm::vec3 colour) {
        const LimitShape shape = ranges.shape(bone, limit, shown_);
        const LimitPen pen = pen_of(bone, radius_of(bone, 0.75f, 55.0f), colour, 0.6f, false);
        pen.outline(shape);
        pen.dot(shape, ranges.angles(bone, shown_));
    }

    glm::vec3 centre(Bone bone) const { return shown_.point(*part_.node_of(bone)); }
    LimitPen pen_of(Bone bone, float radius, glm::vec3 colour, float strength, bool spokes) const {
        return {view_,
                list_,
                {.centre = centre(bone),
                 .radius = radius,
                 .colour = colour,
                 .strength = strength,
                 .spokes = spokes}};
    }
    /// So much of the bone, but no more than so many pixels.
    float radius_of(Bone bone, float share, float pixels) const {
        const std::size_t node = *part_.node_of(bone);
        float length = 0.0f;
        for (const std::int32_t each : part_.skeleton().children(node))
            if (const auto child = static_cast<std::size_t>(each); body_[child])
                length = std::max(length, glm::distance(shown_.point(node), shown_.point(child)));
        if (!(length > 1e-5f))
            length =
                glm::distance(shown_.point(node), glm::vec3(shown_.placed[node].apply(end_of(part_, node))));
        return std::min(share * length, pixels * view_.scale * view_.camera.metres_per_pixel(centre(bone)));
    }

    const View& view_;
    DrawList& list_;
    const HumanoidPart& part_;
    const ShownPose& shown_;
    Solvers& solvers_;
    std::vector<bool> body_;
};

}  // namespace

glm::vec3 adult_colour(const Palette& palette) {
    return palette.selection;
}

glm::vec3 clips_colour(const Palette& palette) {
    return palette.head;
}

void draw_limits(const View& view, DrawList& list, const HumanoidPart& part, const ShownPose& shown) {
    if (part.view.limits == LimitsShown::None ||
        humanoid_runtime(view.workspace).solvers.body(part) == nullptr)
        return;
    LimitDrawing drawing(view, list, part, shown);
    const SelectedJoints chosen = selected_joints(part, humanoid_runtime(view.workspace).solvers);
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (!part.node_of(bone) || chosen.has(bone)) continue;
        if (held(shown, bone))
            drawing.held_back(bone);
        else if (part.view.limits == LimitsShown::All)
            drawing.discreet(bone);
    }
    for (const Bone bone : chosen.all)
        if (bone != chosen.shown) drawing.selected(bone, false);
    if (chosen.shown) drawing.selected(*chosen.shown, true);
}

std::vector<LegendRow> limits_legend(const Workspace& workspace) {
    const HumanoidPart& part = humanoid_part(workspace);
    Solvers& solvers = humanoid_runtime(workspace).solvers;
    if (part.view.limits == LimitsShown::None || solvers.body(part) == nullptr) return {};
    const SelectedJoints chosen = selected_joints(part, solvers);
    bool adult = false, clips = false;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (part.view.limits != LimitsShown::All && !chosen.has(bone)) continue;
        adult = adult || solvers.limits(part).adult(bone) != nullptr;
        clips = clips || solvers.limits(part).clips(bone) != nullptr;
    }
    const Palette& colours = palette(workspace.settings.theme);
    std::vector<LegendRow> rows;
    if (adult) rows.push_back({"an adult's range", adult_colour(colours)});
    if (clips) rows.push_back({"the clips' range", clips_colour(colours)});
    return rows;
}

}  // namespace tendril::app
