// Drawing of the Humanoid lab: the character's bones, nodes and targets, and behind them the unmodified pose.
#include "app/labs/humanoid/draw.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <tendril/humanoid/soles.hpp>

#include "app/labs/humanoid/hold/hold.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/humanoid/humanoid_runtime.hpp"
#include "app/labs/humanoid/ik/ik_settings.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_labels = 60;
constexpr float see_through = 0.35f;  // opacity of a skin that shows its bones

class Drawing {
  public:
    Drawing(const View& view, DrawList& list)
        : view_(view),
          list_(list),
          part_(humanoid_part(view.workspace)),
          shown_(shown_pose(view.workspace)),
          body_(body_nodes(part_)),
          springs_(swinging_nodes(part_, humanoid_runtime(view.workspace).solvers)),
          clad_(part_.loaded->character.skin.mesh && part_.view.skin != SkinLook::None),
          tapered_(bones_setting().chosen(view.workspace.settings) == 0),
          helpers_(helpers_setting().chosen(view.workspace.settings) == 0),
          thickest_(static_cast<float>(0.014 *
                                       glm::distance(part_.loaded->bounds.low, part_.loaded->bounds.high))) {}

    void run() {
        const std::size_t middle = part_.node_of(humanoid::Bone::Hips).value_or(0);
        draw_ground(view_, list_, part_.ik.ground, shown_.point(middle));
        soles();
        balance();
        skin();
        volumes();
        if (part_.view.ghost && !shown_.ghost.empty()) ghost();
        for (std::size_t i = 0; i < part_.skeleton().size(); ++i) {
            if (!body_[i] && !springs_[i] && !helpers_) continue;
            bones_from(i);
            node(i);
        }
        if (view_.handles && humanoid_runtime(view_.workspace).solvers.body(part_) != nullptr)
            for (const humanoid::Effector each : all_effectors)
                if (!holds(part_, each)) effector(each);
        if (view_.handles && shown_.look) gaze();
        draw_limits(view_, list_, part_, shown_);
        draw_attachments(view_, list_, part_.attachments);
        draw_bone_curves(view_, list_, part_, humanoid_runtime(view_.workspace).solvers, shown_);
        draw_hold(view_, list_, part_, shown_);
        labels();
    }

  private:
    float px(float pixels) const { return pixels * view_.scale; }
    bool lit(std::size_t i) const {
        return (view_.dragged != no_pick ? view_.dragged : view_.hovered) == node_pick(i);
    }
    bool selected(std::size_t i) const { return view_.handles && part_.selection.has(i); }
    bool active(std::size_t i) const { return part_.selection.active() == i; }
    glm::vec3 marked(glm::vec3 colour, std::size_t i) const {
        if (selected(i)) return glm::mix(colour, view_.palette.selection, active(i) ? 0.75f : 0.45f);
        return lit(i) ? glm::mix(colour, view_.palette.accent, 0.6f) : colour;
    }
    /// True if the joint's limit stops its bone.
    bool at_limit(std::size_t i) const {
        const auto bone = part_.bone_of(i);
        return bone && shown_.body && shown_.body->at_limit[static_cast<std::size_t>(*bone)];
    }
    glm::vec3 colour_of(std::size_t i) const {
        if (at_limit(i)) return marked(view_.palette.limit, i);
        return marked(kind_colour(i), i);
    }
    glm::vec3 kind_colour(std::size_t i) const {
        if (springs_[i]) return attached_colour(view_.palette);
        return body_[i] ? view_.palette.joint : view_.palette.neutral;
    }

    /// The bones from a node to its children, which turn with it. A rig's root and controls have none.
    void bones_from(std::size_t i) {
        const auto hips = part_.node_of(humanoid::Bone::Hips);
        if (!body_[i] && !springs_[i] && hips && !part_.skeleton().is_below(i, *hips)) return;
        if (tapered_ && !clad_ && part_.node_of(humanoid::Bone::Head) == i && head(i)) return;
        bool ended = false;
        for (const std::int32_t each : part_.skeleton().children(i)) {
            const auto child = static_cast<std::size_t>(each);
            if (!body_[child] && !springs_[i] && !helpers_) continue;
            bone(i, shown_.point(i), shown_.point(child), body_[i] && body_[child]);
            ended = ended || body_[child];
        }
        if (!ended && body_[i] && part_.bone_of(i))
            bone(i, shown_.point(i), glm::vec3(shown_.placed[i].apply(end_of(part_, i))), true);
    }
    /// A ball above the joint, sized by the joint's only child if that is plausible, else by the trunk.
    bool head(std::size_t i) {
        const auto hips = part_.node_of(humanoid::Bone::Hips);
        const std::int32_t neck = part_.skeleton()[i].parent;
        if (!hips || neck < 0) return false;
        const std::vector<humanoid::Placement>& rest = part_.loaded->rest;
        const double trunk = glm::distance(rest[i].position, rest[*hips].position);
        glm::dvec3 up = rest[i].position - rest[static_cast<std::size_t>(neck)].position;
        double size = 0.145 * trunk;
        if (const auto ends = part_.skeleton().children(i); ends.size() == 1) {
            const glm::dvec3 end = rest[static_cast<std::size_t>(ends[0])].position - rest[i].position;
            if (const double half = 0.5 * glm::length(end); half > 0.5 * size && half < 1.5 * size)
                up = end, size = half;
        }
        if (!(size > 0.0) || !(glm::length(up) > 1e-9)) return false;
        const glm::dvec3 way = glm::conjugate(rest[i].rotation()) * (size * glm::normalize(up));
        const glm::vec3 centre(shown_.placed[i].position + shown_.placed[i].rotation() * way);
        Stroke& ball = list_.sphere(centre, static_cast<float>(size), Unit::Metres,
                                    glm::vec4(marked(view_.palette.joint, i), 1.0f));
        ball.pick = node_pick(i);
        ball.shadow = true;
        return true;
    }
    void bone(std::size_t i, glm::vec3 from, glm::vec3 to, bool of_body) {
        if (glm::distance(from, to) < 1e-5f) return;
        of_body = of_body || springs_[i];
        const glm::vec4 paint(marked(of_body ? kind_colour(i) : view_.palette.neutral, i), 1.0f);
        if (!of_body || !tapered_) {
            Stroke& stroke = list_.line(from, to, px(of_body ? 3.0f : 1.2f), paint);
            stroke.pick = node_pick(i);
            stroke.shadow = of_body;
            return;
        }
        const float thick = std::min(0.11f * glm::distance(from, to), thickest_) * (clad_ ? 0.6f : 1.0f);
        const glm::vec3 belly = glm::mix(from, to, 0.15f);
        for (const auto& [a, b, ra, rb] :
             {std::tuple(from, belly, 0.45f * thick, thick), std::tuple(belly, to, thick, 0.35f * thick)}) {
            Stroke& stroke = list_.bone(a, b, ra, rb, paint);
            stroke.pick = node_pick(i);
            stroke.shadow = true;
        }
    }
    void node(std::size_t i) {
        const bool marks = selected(i) || lit(i);
        const float radius = (at_limit(i)   ? 6.0f
                              : body_[i]    ? 4.0f
                              : springs_[i] ? 3.0f
                                            : 2.0f) +
                             (marks ? 1.5f : 0.0f);
        Stroke& ball = list_.sphere(shown_.point(i), px(radius), Unit::Pixels, glm::vec4(colour_of(i), 1.0f));
        ball.pick = node_pick(i);
        ball.rank = body_[i] ? 2 : 1;
        if (marks) ball.layer = Layer::Overlay;
    }

    /// Outlines of the volumes that hands avoid, and of the colliders of selected springs.
    void volumes() {
        Solvers& solvers = humanoid_runtime(view_.workspace).solvers;
        for (const humanoid::BodyCapsule& each : solvers.capsules(part_)) {
            const humanoid::PlacedCapsule at = humanoid::place(each, *part_.map, shown_.placed);
            outline(glm::vec3(at.from), glm::vec3(at.to), static_cast<float>(at.radius));
        }
        std::vector<SpringCollider> drawn;  // strands of hair share them
        for (const std::size_t spring : selected_springs(part_)) {
            const NamedSpring* const file = colliding(part_, part_.springs[spring]);
            for (std::size_t i = 0; file != nullptr && i < file->colliders.size(); ++i) {
                if (std::ranges::find(drawn, file->colliders[i]) != drawn.end()) continue;
                drawn.push_back(file->colliders[i]);
                const humanoid::PlacedCapsule at = place(drawn.back(), shown_.placed);
                outline(glm::vec3(at.from), glm::vec3(at.to), static_cast<float>(at.radius));
            }
        }
    }
    void outline(glm::vec3 from, glm::vec3 to, float radius) {
        const glm::vec3 sight = glm::normalize(0.5f * (from + to) - view_.camera.eye());
        const glm::vec3 flat = (to - from) - glm::dot(to - from, sight) * sight;
        const glm::vec3 along = glm::length(flat) > 1e-6f ? glm::normalize(flat) : view_.camera.up();
        const glm::vec3 aside = glm::cross(sight, along);
        constexpr int steps = 24;  // from the right side of `to` round its end, and back round the other one
        const auto point = [&](int i) {
            const float angle = glm::two_pi<float>() * static_cast<float>(i) / steps;
            return (i <= steps / 2 ? to : from) +
                   radius * (math::cosine(angle) * aside + math::sine(angle) * along);
        };
        const glm::vec4 paint(view_.palette.neutral, 0.7f);
        for (int i = 0; i < steps; ++i) list_.line(point(i), point(i + 1), px(1.0f), paint);
        list_.line(point(steps), point(0), px(1.0f), paint);
    }

    void skin() {
        if (!clad_) return;
        const Skin& skin = part_.loaded->character.skin;
        const float opacity = part_.view.skin == SkinLook::Solid ? 1.0f : see_through;
        SkinDraw& draw = list_.skins.emplace_back(SkinDraw{.mesh = skin.mesh, .opacity = opacity});
        if (part_.view.skinning == Skinning::TwistSpread) {
            const TwistSpread& spread = humanoid_runtime(view_.workspace).twist(part_);
            draw.weights = spread.weights();
            draw.matrices = spread.matrices(skin, shown_.placed);
        } else {
            draw.matrices = skin_matrices(skin, shown_.placed);
        }
        const Playback& playback = part_.playback;
        if (playback.clip) draw.morph_weights = morph_weights(skin, *playback.clip, playback.time);
    }

    /// A draggable ball at the target or, without one, at the bone. A line shows a target out of reach.
    void effector(humanoid::Effector which) {
        const PickId pick = effector_pick(which);
        const bool marks = view_.dragged == pick || view_.hovered == pick;
        const glm::vec3 bone = shown_.point(*part_.node_of(humanoid::bone_of(which)));
        const auto& target = part_.ik.target(which);
        const glm::vec3 at = target ? glm::vec3(target->position) : bone;
        const glm::vec4 paint(view_.palette.target, 1.0f);
        const float radius = (target ? 8.0f : 6.0f) + (marks ? 1.5f : 0.0f);
        Stroke& ball = list_.sphere(at, px(radius), Unit::Pixels, paint);
        ball.pick = pick;
        ball.rank = 5;
        ball.layer = Layer::Overlay;
        if (!target) return;
        list_.ring(at, px(13.0f), px(1.6f), glm::vec4(view_.palette.target, 0.7f)).layer = Layer::Overlay;
        if (glm::distance(bone, at) > 0.001f * static_cast<float>(part_.loaded->height()))
            list_.line(bone, at, px(1.6f), glm::vec4(view_.palette.limit, 1.0f)).layer = Layer::Overlay;
    }

    /// The look-at target, with a thin line to the head.
    void gaze() {
        const auto at = glm::vec3(part_.ik.look_at.options.target);
        const glm::vec3 head = shown_.point(*part_.node_of(humanoid::Bone::Head));
        list_.line(head, at, px(1.0f), glm::vec4(view_.palette.target, 0.35f)).layer = Layer::Overlay;
        const bool marks = view_.dragged == look_pick || view_.hovered == look_pick;
        Stroke& ball =
            list_.sphere(at, px(marks ? 9.0f : 7.5f), Unit::Pixels, glm::vec4(view_.palette.target, 1.0f));
        ball.pick = look_pick;
        ball.rank = 5;
        if (!marks) return;
        list_.labels.push_back(
            {.at = at, .clearance = px(14.0f), .text = "look-at", .colour = view_.palette.text, .rank = 3});
    }

    /// Where planted soles touch the ground. A foot over the edge of a step, or rolling onto its toes, is
    /// marked only where it stands.
    void soles() {
        if (!shown_.feet || !view_.handles) return;
        const humanoid::Ground& ground = humanoid_runtime(view_.workspace).solvers.ground(part_);
        for (std::size_t side = 0; side < 2; ++side)
            if (shown_.feet->feet[side].planted) sole(ground, shown_.soles[side]);
    }
    void sole(const humanoid::Ground& ground, const humanoid::SolePoints& at) {
        constexpr int parts = 16;
        constexpr double contact = 0.015;  // metres
        const glm::vec4 paint(view_.palette.tail, 1.0f);
        const auto point = [&](int i) { return glm::mix(at.heel, at.toe, static_cast<double>(i) / parts); };
        const auto above = [&](int i) {
            const auto hit = ground.highest(point(i).x, point(i).z);
            return hit ? std::abs(point(i).y - hit->height) : 1e9;
        };
        const auto dot = [&](int i) {
            list_.sphere(glm::vec3(point(i)), px(3.5f), Unit::Pixels, paint).layer = Layer::Overlay;
        };
        int from = -1;  // where the present stretch of contact begins
        bool any = false;
        for (int i = 0; i <= parts + 1; ++i) {
            const bool touches = i <= parts && above(i) < contact;
            if (touches && from < 0) from = i;
            if (touches || from < 0) continue;
            if (i - 1 > from)
                list_.line(glm::vec3(point(from)), glm::vec3(point(i - 1)), px(3.0f), paint).layer =
                    Layer::Overlay;
            dot(from);
            if (i - 1 > from) dot(i - 1);
            from = -1;
            any = true;
        }
        if (!any) dot(above(0) < above(parts) ? 0 : parts);
    }

    /// The area that supports the body, and a plumb line from the centre of mass to the ground.
    void balance() {
        if (!shown_.balance || shown_.balance->support.count == 0) return;
        const humanoid::Support& support = shown_.balance->support;
        const glm::vec4 quiet(view_.palette.neutral, 0.8f);
        for (std::size_t i = 0; i < support.count; ++i)
            list_
                .line(glm::vec3(support.corners[i]), glm::vec3(support.corners[(i + 1) % support.count]),
                      px(1.4f), quiet)
                .layer = Layer::Overlay;
        const glm::vec3 centre(shown_.balance->centre);
        const glm::vec3 foot(centre.x, static_cast<float>(support.middle.y), centre.z);
        const glm::vec3 colour = balance_colour(part_, shown_, view_.palette);
        list_.line(centre, foot, px(1.0f), glm::vec4(colour, 0.5f)).layer = Layer::Overlay;
        for (const auto& [at, radius] : {std::pair(centre, 3.0f), std::pair(foot, 4.5f)})
            list_.sphere(at, px(radius), Unit::Pixels, glm::vec4(colour, 1.0f)).layer = Layer::Overlay;
    }

    void ghost() {
        const glm::vec4 paint = faded(view_.palette, view_.palette.ghost, 0.6f);
        // Fixes move joints by less than a bone's thickness.
        const Layer layer = part_.shows_fixes() ? Layer::Overlay : Layer::Scene;
        const auto at = [&](std::size_t i) { return glm::vec3(shown_.ghost[i].position); };
        for (std::size_t i = 0; i < part_.skeleton().size(); ++i) {
            if (!body_[i] && !springs_[i]) continue;
            for (const std::int32_t each : part_.skeleton().children(i))
                if (const auto child = static_cast<std::size_t>(each);
                    (body_[child] || springs_[i]) && glm::distance(at(i), at(child)) > 1e-5f)
                    list_.line(at(i), at(child), px(2.0f), paint).layer = layer;
        }
    }

    void labels() {
        const bool always = view_.workspace.settings.labels == LabelMode::Always;
        const std::size_t stride = part_.skeleton().size() / max_labels + 1;
        const PickId pointed = view_.dragged != no_pick ? view_.dragged : view_.hovered;
        if (const auto which = picked_effector(pointed)) {
            const auto& target = part_.ik.target(*which);
            const glm::vec3 bone = shown_.point(*part_.node_of(humanoid::bone_of(*which)));
            list_.labels.push_back({.at = target ? glm::vec3(target->position) : bone,
                                    .clearance = px(16.0f),
                                    .text = title(*which),
                                    .colour = view_.palette.text,
                                    .rank = 3});
        }
        for (std::size_t i = 0; i < part_.skeleton().size(); ++i) {
            const bool marks = lit(i) || selected(i);
            if (!marks && !(always && body_[i] && i % stride == 0)) continue;
            list_.labels.push_back({.at = shown_.point(i),
                                    .clearance = px(10.0f),
                                    .text = part_.titled(i),
                                    .colour = view_.palette.text,
                                    .rank = lit(i)  ? 2
                                            : marks ? 1
                                                    : 0});
        }
    }

    const View& view_;
    DrawList& list_;
    const HumanoidPart& part_;
    const ShownPose& shown_;
    std::vector<bool> body_, springs_;  // nodes of the body; nodes turned by a spring
    bool clad_;                         // a skin is drawn: bones stay inside it
    bool tapered_, helpers_;
    float thickest_;  ///< metres
};

}  // namespace

LabSetting bones_setting() {
    return {.key = "character_bones",
            .command = "view.character_bones",
            .title = "Choose how bones are drawn",
            .argument = "style",
            .help = "Shows the bones of a character as tapered bones, or as lines and spheres",
            .choices = {{"tapered", "Tapered bones"}, {"lines", "Lines and spheres"}}};
}

LabSetting helpers_setting() {
    return {.key = "character_helpers",
            .command = "view.character_helpers",
            .title = "Show or hide helper nodes",
            .argument = "nodes",
            .help = "Shows the nodes that are not bones of the body: fingers, helpers",
            .choices = {{"shown", "Nodes beside the body shown"}, {"hidden", "The body alone"}}};
}

glm::vec3 balance_colour(const HumanoidPart& part, const ShownPose& shown, const Palette& colours) {
    return shown.balance->margin >= 0.0 || part.ik_state.steps.stepping() ? colours.tail : colours.limit;
}

std::vector<LabSetting> HumanoidLab::settings() const {
    return {bones_setting(), helpers_setting()};
}

void HumanoidLab::draw(const View& view, DrawList& list) const {
    draw_past_ghosts(view, humanoid_past(), list);
    Drawing(view, list).run();
    draw_humanoid_incident(view, shown_pose(view.workspace), list);
}

std::vector<LegendRow> HumanoidLab::legend(const Workspace& workspace) const {
    const Palette& colours = palette(workspace.settings.theme);
    const HumanoidPart& part = humanoid_part(workspace);
    const ShownPose& shown = shown_pose(workspace);
    std::vector<LegendRow> rows{{"bone", colours.joint}};
    if (humanoid_runtime(workspace).solvers.body(part) != nullptr)
        rows.push_back({.name = "target", .colour = colours.target, .handle = true});
    if (shown.body && std::ranges::find(shown.body->at_limit, true) != shown.body->at_limit.end())
        rows.push_back({"at its limit", colours.limit});
    if (shows_lint_marks(workspace)) rows.push_back({"lint finding", colours.limit});
    for (LegendRow& row : limits_legend(workspace)) rows.push_back(std::move(row));
    const std::vector<bool> body = body_nodes(part);
    if (std::ranges::find(body, false) != body.end()) rows.push_back({"helper", colours.neutral});
    if (shown.feet || shown.hold)
        rows.push_back({.name = !shown.hold   ? "planted"
                                : !shown.feet ? "closed grip"
                                              : "planted, closed grip",
                        .colour = colours.tail,
                        .handle = true});
    if (shown.balance) rows.push_back({"centre of mass", balance_colour(part, shown, colours)});
    if (!part.curves.empty()) rows.push_back({"curve", curve_colour(colours)});
    if (!part.springs.empty()) rows.push_back({"on a spring", attached_colour(colours)});
    if (!part.attachments.list.empty()) rows.push_back({"attached", attached_colour(colours)});
    if (part.view.ghost && (part.shows_fixes() || !shown.ghost.empty()))
        rows.push_back({"before", colours.ghost});
    add_ghost_legend(workspace, humanoid_past(), rows);
    return rows;
}

std::optional<humanoid::Effector> picked_effector(PickId pick) {
    const PickId at = pick - first_effector_pick;
    if (at < 0 || at >= static_cast<PickId>(humanoid::effector_count)) return std::nullopt;
    return static_cast<humanoid::Effector>(at);
}

std::optional<std::size_t> picked_node(const HumanoidPart& part, PickId pick) {
    if (pick < 0 || static_cast<std::size_t>(pick) >= part.skeleton().size()) return std::nullopt;
    return static_cast<std::size_t>(pick);
}

std::vector<bool> body_nodes(const HumanoidPart& part) {
    const humanoid::Skeleton& skeleton = part.skeleton();
    const auto mapped =
        std::ranges::count_if(part.map->bones, [](const auto& each) { return each.node >= 0; });
    constexpr std::ptrdiff_t few = 6;
    if (mapped < few) return std::vector<bool>(skeleton.size(), true);
    std::vector<bool> body(skeleton.size());
    const auto hips = part.node_of(humanoid::Bone::Hips);
    for (const humanoid::BoneMatch& match : part.map->bones) {
        std::vector<std::size_t> way;
        for (std::int32_t at = match.node; at >= 0; at = skeleton[static_cast<std::size_t>(at)].parent) {
            way.push_back(static_cast<std::size_t>(at));
            if (hips != way.back() && !body[way.back()]) continue;
            for (const std::size_t node : way) body[node] = true;
            break;
        }
        if (match.node >= 0) body[static_cast<std::size_t>(match.node)] = true;
    }
    for (const BoneCurve& each : part.curves)
        if (const auto chain = chain_of(part, each))
            for (std::size_t at = chain->last; skeleton.is_below(at, chain->first);
                 at = static_cast<std::size_t>(skeleton[at].parent)) {
                body[at] = true;
                if (at == chain->first) break;
            }
    // The end of a last bone, if it is the only child.
    for (const humanoid::BoneMatch& match : part.map->bones) {
        if (match.node < 0) continue;
        const auto children = skeleton.children(static_cast<std::size_t>(match.node));
        if (children.size() == 1) body[static_cast<std::size_t>(children.front())] = true;
    }
    return body;
}

std::vector<bool> swinging_nodes(const HumanoidPart& part, Solvers& solvers) {
    std::vector<bool> swinging(part.skeleton().size());
    for (const auto& chain : solvers.springs(part))
        if (chain != nullptr)
            for (const std::size_t each : chain->bones()) swinging[each] = true;
    return swinging;
}

glm::dvec3 end_of(const HumanoidPart& part, std::size_t node) {
    const std::int32_t parent = part.skeleton()[node].parent;
    if (parent < 0) return glm::dvec3(0.0);
    if (const auto soles = humanoid::find_soles(part.skeleton(), *part.map))
        for (const humanoid::Sole& each : soles->feet)
            if (each.foot == node && each.toes == node) return each.toe;
    const humanoid::Placement& at = part.loaded->rest[node];
    const glm::dvec3 way = at.position - part.loaded->rest[static_cast<std::size_t>(parent)].position;
    return 0.5 * (glm::conjugate(at.rotation()) * way);
}

}  // namespace tendril::app
