#include "tendril/humanoid/retarget.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "humanoid/input.hpp"
#include "humanoid/names.hpp"
#include "humanoid/retarget_body.hpp"
#include "humanoid/retarget_feet.hpp"
#include "rig/math.hpp"
#include "tendril/humanoid/lint.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

constexpr std::size_t max_retargeted_keys = 100'000;

/// Thigh plus shin of a person. The source is scaled to this size before its steps are detected, since many
/// files use a wrong unit.
constexpr double person_leg = 0.85;  // metres

constexpr double helper_reach = 0.1;  // in leg lengths, at rest: helpers this close to a node follow it

constexpr double max_flat_tilt = 8.0;  // degrees of tilt above which a foot on the ground is not flat

Clip scaled(Clip clip, double by) {
    for (Channel& each : clip.channels)
        for (glm::dvec3& value : each.translation.values) value = times(value, by);
    return clip;
}
Skeleton scaled(const Skeleton& skeleton, double by) {
    std::vector<Node> nodes = skeleton.nodes();
    for (Node& each : nodes) {
        each.rest.translation = times(each.rest.translation, by);
        if (each.keys) each.keys->rest.translation = times(each.keys->rest.translation, by);
    }
    const auto made = Skeleton::make(std::move(nodes));
    return made ? *made : skeleton;
}
double person_scale(const MappedSkeleton& body) {
    const double leg = detail::RetargetBody(body).leg;
    return leg > 1e-6 && leg < 1e6 ? person_leg / leg : 1.0;
}

/// All key times of the source and all its frames, ascending.
std::vector<double> key_times(const Clip& clip) {
    const Frames frames = frames_at(clip, frame_rate(clip));
    if (frames.count > max_retargeted_keys) return std::vector<double>(max_retargeted_keys + 1);
    std::vector<double> times{0.0, clip.duration};
    for (const Channel& each : clip.channels)
        for (const std::vector<double>* own :
             {&each.translation.times, &each.rotation.times, &each.scale.times})
            times.insert(times.end(), own->begin(), own->end());
    std::sort(times.begin(), times.end());
    const double same = 1e-3 * frames.step;  // tracks of one file differ by rounding
    times.erase(std::unique(times.begin(), times.end(), [&](double a, double b) { return b - a < same; }),
                times.end());
    return with_frames(times, frames);
}

/// The sum of the lengths from each node to its parent at rest.
double extent_of(const Skeleton& skeleton) {
    double sum = 0.0;
    for (const Node& each : skeleton.nodes()) sum += length(each.rest.translation);
    return sum;
}

/// For each source node, the same node of the target: same name, parent and rest pose, up to one scale and to
/// the rounding of a file's 32-bit numbers. Empty if a node differs or is missing on either side, or if the
/// maps differ.
std::vector<std::size_t> same_nodes(const MappedSkeleton& from, const MappedSkeleton& to, double ratio) {
    constexpr double same = 1e-5;  // in metres of a person, and for unit quaternions
    const double near = same * std::max(ratio, 1.0);
    const auto matches = [&](const rig::Transform& a, const rig::Transform& b) {
        return length(minus(times(a.translation, ratio), b.translation)) < near &&
               std::abs(dot(a.rotation, b.rotation)) > 1.0 - same * same &&
               length(minus(a.scale, b.scale)) < same;
    };
    if (from.skeleton.size() != to.skeleton.size()) return {};
    std::vector<std::size_t> nodes(from.skeleton.size());
    const auto corresponds = [&](std::int32_t a, std::int32_t b) {
        return a < 0 || b < 0 ? a == b : nodes[static_cast<std::size_t>(a)] == static_cast<std::size_t>(b);
    };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string& name = from.skeleton[i].name;
        const auto found = to.skeleton[i].name == name ? std::optional(i) : to.skeleton.find(name);
        if (!found) return {};
        nodes[i] = *found;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Node &a = from.skeleton[i], &b = to.skeleton[nodes[i]];
        if (!corresponds(a.parent, b.parent) || !corresponds(a.key_parent(), b.key_parent()) ||
            !matches(a.rest, b.rest) || !matches(a.key_rest(), b.key_rest()))
            return {};
    }
    for (std::size_t i = 0; i < bone_count; ++i)
        if (!corresponds(from.map.bones[i].node, to.map.bones[i].node)) return {};
    return nodes;
}

/// Poses the limbs first, then the feet, then the helpers.
class Retargeter {
  public:
    Retargeter(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to)
        : size_(person_scale(from)),
          skeleton_(scaled(from.skeleton, size_)),
          clip_(scaled(clip, size_)),
          to_(to),
          was_({skeleton_, from.map}),
          now_(to),
          shared_(to.skeleton.size()),
          leaders_(to.skeleton.size()),
          travels_(to.skeleton.size()),
          rest_(rest_pose(to.skeleton)),
          pose_(rest_),
          source_pose_(skeleton_.size()),
          source_(skeleton_.size()),
          placed_(to.skeleton.size()) {
        find_root();
        for (std::size_t i = 0; i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            if (was_.has(bone) && now_.has(bone))
                shared_[now_.node(bone)] = was_.node(bone);
            else if (was_.has(bone))
                result_.left_out.push_back(bone);
            else if (now_.has(bone))
                result_.at_rest.push_back(bone);
        }
        for (const bool left : {true, false}) share_hand(left);
        turn_ = math::compose(now_.frame, conjugate(was_.frame));
        scale_ = was_.leg > 0.0 && now_.leg > 0.0 ? now_.leg / was_.leg : 1.0 / size_;
        result_.scale = scale_ * size_;
        plan_feet();
    }

    Retargeted run(const std::vector<double>& times) {
        result_.clip.name = clip_.name;
        result_.clip.duration = clip_.duration;
        result_.clip.rate = clip_.rate;
        std::vector<Channel> channels(to_.skeleton.size());
        for (const double time : times) {
            pose_limbs(time);
            place_feet(time);
            move_helpers();
            for (std::size_t node = 0; node < shared_.size(); ++node)
                if (moves(node)) add_key(channels[node], time, key_of(to_.skeleton, pose_, node), node);
        }
        for (std::size_t node = 0; node < shared_.size(); ++node) {
            if (!moves(node)) continue;
            channels[node].node = node;
            result_.clip.channels.push_back(std::move(channels[node]));
        }
        return std::move(result_);
    }

  private:
    /// Pairs the hands, turned palms down if both palms are known, and the fingers that both have. Palm bones
    /// beside the mapped hand follow it.
    void share_hand(bool left) {
        const std::size_t side = left ? 0 : 1;
        const Bone hand = left ? Bone::LeftHand : Bone::RightHand;
        if (!was_.has(hand) || !now_.has(hand)) return;
        const auto before = was_.palm_down(left), after = now_.palm_down(left);
        if (before && after) was_.turn(was_.node(hand), *before), now_.turn(now_.node(hand), *after);
        shared_[now_.node(hand)] = was_.hands[side];
        const std::int32_t arm = to_.skeleton[now_.node(hand)].parent;
        if (arm >= 0)
            for (const std::int32_t each : to_.skeleton.children(static_cast<std::size_t>(arm))) {
                const auto node = static_cast<std::size_t>(each);
                const std::string& name = to_.skeleton[node].name;
                if (node != now_.node(hand) && (detail::is_palm_name(name) || detail::finger_named(name)))
                    leaders_[node] = now_.node(hand);
            }
        for (std::size_t finger = 0; finger < was_.fingers[side].size(); ++finger)
            for (std::size_t i = 0; i < was_.fingers[side][finger].size(); ++i) {
                const std::int32_t a = was_.fingers[side][finger][i], b = now_.fingers[side][finger][i];
                if (a < 0 || b < 0) break;
                auto& from = shared_[static_cast<std::size_t>(b)];
                if (!from) from = static_cast<std::size_t>(a);
            }
    }

    // ------------------------------------------------------------------------------------------- helpers

    /// Sorts the nodes that are not below the hips. The root above the hips travels with them, and so do its
    /// other children. Helpers that are at a node of the body at rest, such as IK targets, follow that node.
    /// Other roots stay, unless they have such helpers.
    void find_root() {
        const Skeleton& skeleton = to_.skeleton;
        const auto hips = now_.node(Bone::Hips);
        place(skeleton, rest_, placed_);
        rest_placed_ = placed_;
        const double near = helper_reach * now_.leg;
        for (const std::int32_t each : skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            if (skeleton.is_below(node, hips)) continue;
            std::size_t top = node;
            while (skeleton[top].parent >= 0) top = static_cast<std::size_t>(skeleton[top].parent);
            if (skeleton.is_below(hips, node)) {
                travels_[top] = true;
                continue;
            }
            double nearest = near;
            for (std::size_t i = 0; i < skeleton.size(); ++i) {
                if (!skeleton.is_below(i, hips)) continue;
                const double away = length(minus(rest_placed_[i].position, rest_placed_[node].position));
                if (away < nearest) nearest = away, leaders_[node] = i;
            }
            if (leaders_[node] && top != node) travels_[top] = true;
            if (!leaders_[node]) result_.helpers.push_back(node);
        }
    }
    /// Keeps each helper's rest pose relative to the node that it follows.
    void move_helpers() {
        place(to_.skeleton, pose_, placed_);
        for (const std::int32_t each : to_.skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            if (const auto& leader = leaders_[node]) {
                const Placement &now = placed_[*leader], &rest = rest_placed_[*leader],
                                &own = rest_placed_[node];
                const glm::dquat turned = math::compose(now.rotation(), conjugate(rest.rotation()));
                Placement target{own.axes,
                                 plus(now.position, rotated(turned, minus(own.position, rest.position)))};
                for (int axis = 0; axis < 3; ++axis) target.axes[axis] = rotated(turned, own.axes[axis]);
                pose_[node] = relative(above_of(node), target);
                pose_[node].scale = rest_[node].scale;  // scale gets no keys
            }
            placed_[node] = above_of(node) * placement(pose_[node]);
        }
    }

    // ---------------------------------------------------------------------------------------------- feet

    /// Needs two whole legs in both figures.
    void plan_feet() {
        if (!was_.soles || !now_.soles) return;
        for (std::size_t i = 0; i < 2; ++i)
            legs_[i] = lint_detail::leg_of(to_.skeleton, to_.map,
                                           to_.map[i == 0 ? Bone::LeftFoot : Bone::RightFoot].node);
        const LintSettings settings;
        LintReport report = lint_detail::blank_report(clip_, settings);
        rate_ = report.rate;
        const lint_detail::FeetMotion motion =
            lint_detail::feet_motion({skeleton_, was_.body.map, clip_, settings, 0.0, report});
        if (!legs_[0] || !legs_[1] || motion.feet.size() != 2) return;
        if (motion.floor || motion.has_soles) learn_level_feet(motion);
        const std::array<detail::SoleTriple, 2> soles{was_.sole(true, motion.feet[0].points[0].above),
                                                      was_.sole(false, motion.feet[1].points[0].above)};
        std::vector<detail::PointedFrame> frames;
        for (std::size_t i = 0; i < report.frames; ++i) {
            pose_limbs(std::min(static_cast<double>(i) / report.rate, clip_.duration));
            frames.push_back(pointed(soles));
        }
        footing_ = detail::plan_feet(
            {.motion = motion,
             .frames = frames,
             .rate = report.rate,
             .scale = scale_,
             .leg = now_.leg,
             .floor = now_.ground,
             .shift = now_.ground - now_.soles->floor - scale_ * (was_.ground - was_.soles->floor),
             .source_floor = motion.floor,
             .ground = was_.ground,
             .turn = turn_});
    }
    /// Learns how feet and toes rest on the ground from the frames in which they stand.
    void learn_level_feet(const lint_detail::FeetMotion& motion) {
        for (const bool left : {true, false}) {
            const lint_detail::Foot& foot = motion.feet[left ? 0 : 1];
            was_.level(static_cast<std::size_t>(foot.node), foot.flat);
            was_.straighten_foot(left);
            const Bone toes = left ? Bone::LeftToes : Bone::RightToes;
            if (!was_.has(toes) || motion.has_soles) continue;
            glm::dvec3 up(0.0);
            for (std::size_t i = 0; i < foot.still.size(); ++i) {
                if (!foot.still[i] || foot.tilt[i] > max_flat_tilt) continue;
                sample(clip_, skeleton_, std::min(static_cast<double>(i) / rate_, clip_.duration),
                       source_pose_);
                place(skeleton_, source_pose_, source_);
                const glm::dquat turned = source_[was_.node(toes)].rotation();
                up = plus(up, rotated(conjugate(turned), {0.0, 1.0, 0.0}));
            }
            if (const auto mean = direction_of(up, 1e-9)) was_.level(was_.node(toes), *mean);
        }
    }
    detail::PointedFrame pointed(const std::array<detail::SoleTriple, 2>& source_soles) const {
        detail::PointedFrame frame{.hips = placed_[now_.node(Bone::Hips)].position};
        for (std::size_t i = 0; i < 2; ++i) {
            const auto at = [&](std::size_t place) { return placed_[legs_[i]->node(place)].position; };
            detail::PointedFoot& foot = frame.feet[i];
            foot.hip = at(legs_[i]->upper), foot.ankle = at(legs_[i]->end);
            const glm::dvec3 knee = at(legs_[i]->lower);
            foot.leg = length(minus(knee, foot.hip)) + length(minus(foot.ankle, knee));
            const Sole& sole = now_.soles->feet[i];
            const Placement &ankle = placed_[sole.foot], &toes = placed_[sole.toes];
            foot.sole[0] = minus(ankle.apply(sole.heel), foot.ankle);
            foot.sole[1] = minus(toes.apply(sole.toe), foot.ankle);
            foot.source_low = lowest_of_source(i == 0, source_soles[i]);
            foot.sole[2] = now_.tips[i] ? minus(toes.apply(*now_.tips[i]), foot.ankle) : foot.sole[1];
        }
        return frame;
    }
    double lowest_of_source(bool left, const detail::SoleTriple& sole) const {
        const Bone foot = left ? Bone::LeftFoot : Bone::RightFoot,
                   toes = left ? Bone::LeftToes : Bone::RightToes;
        const Placement &ankle = source_[was_.node(foot)],
                        &ball = source_[was_.node(was_.has(toes) ? toes : foot)];
        return std::min({plus(ankle.position, rotated(ankle.rotation(), sole[0])).y,
                         plus(ball.position, rotated(ball.rotation(), sole[1])).y,
                         plus(ball.position, rotated(ball.rotation(), sole[2])).y});
    }
    /// Displaces hips and feet as planned.
    void place_feet(double time) {
        if (footing_.empty()) return;
        const double frame = std::clamp(time * rate_, 0.0, static_cast<double>(footing_.size() - 1));
        const auto first = static_cast<std::size_t>(frame), next = std::min(first + 1, footing_.size() - 1);
        const detail::Footing &a = footing_[first], &b = footing_[next];
        const double part = frame - static_cast<double>(first);
        const double up = a.hips + (b.hips - a.hips) * part;
        const std::size_t hips = now_.node(Bone::Hips);
        pose_[hips].translation =
            plus(pose_[hips].translation, detail::to_local(above_of(hips), {0.0, up, 0.0}));
        for (std::size_t i = 0; i < 2; ++i) {
            const detail::Limb& leg = *legs_[i];
            const glm::dvec3 move = mix(a.feet[i], b.feet[i], part);
            const glm::dvec3 target = plus(placed_[leg.node(leg.end)].position, move);
            if (length(minus(move, {0.0, up, 0.0})) < 1e-9) continue;
            detail::LimbPlacement at = detail::place(leg, Placement{}, pose_);
            const glm::dquat thigh =
                math::compose(at.upper.rotation(), conjugate(now_.rotations[leg.node(leg.upper)]));
            const detail::Pole pole{rotated(thigh, now_.at.forward), 0.005, false};
            detail::apply(detail::bend_to(at, target, pole, 0.9999), {1.0, 0.0, 0.0, 0.0}, leg, at, pose_);
        }
    }

    // --------------------------------------------------------------------------------------------- limbs

    /// Turns every shared bone from its reference pose as the source's bone turns from its own.
    void pose_limbs(double time) {
        sample(clip_, skeleton_, time, source_pose_);
        place(skeleton_, source_pose_, source_);
        const glm::dvec3 way =
            times(rotated(turn_, minus(source_[was_.node(Bone::Hips)].position, was_.hips)), scale_);
        for (const std::int32_t each : to_.skeleton.order()) {
            const auto node = static_cast<std::size_t>(each);
            const Placement above = above_of(node);
            pose_[node] = rest_[node];
            if (travels_[node]) pose_[node].translation = plus(pose_[node].translation, {way.x, 0.0, way.z});
            if (const auto& from = shared_[node]) {
                // In the source's frame, then in the target's.
                const glm::dquat moved =
                    math::compose(source_[*from].rotation(), conjugate(was_.rotations[*from]));
                const glm::dquat target = math::compose(
                    math::compose(turn_, math::compose(moved, conjugate(turn_))), now_.rotations[node]);
                pose_[node].rotation = rig::normalised(math::compose(conjugate(above.rotation()), target));
                if (node == now_.node(Bone::Hips))
                    pose_[node].translation =
                        relative(above, Placement{glm::dmat3(1.0), plus(now_.hips, way)}).translation;
            }
            placed_[node] = above * placement(pose_[node]);
        }
    }
    /// A node whose keys are local to a node other than its parent (attach.hpp) needs keys to stay in place
    /// below its parent.
    bool moves(std::size_t node) const {
        return shared_[node] || travels_[node] || leaders_[node] || to_.skeleton[node].keys;
    }
    bool is_translated(std::size_t node) const {
        return node == now_.node(Bone::Hips) || travels_[node] || leaders_[node] || to_.skeleton[node].keys;
    }
    Placement above_of(std::size_t node) const {
        const std::int32_t parent = to_.skeleton[node].parent;
        return parent < 0 ? Placement() : placed_[static_cast<std::size_t>(parent)];
    }
    void add_key(Channel& channel, double time, const rig::Transform& key, std::size_t node) const {
        glm::dquat rotation = key.rotation;
        if (!channel.rotation.values.empty() && dot(channel.rotation.values.back(), rotation) < 0.0)
            rotation = glm::dquat(-rotation.w, -rotation.x, -rotation.y, -rotation.z);
        channel.rotation.times.push_back(time);
        channel.rotation.values.push_back(rotation);
        if (!is_translated(node)) return;
        channel.translation.times.push_back(time);
        channel.translation.values.push_back(key.translation);
        if (!to_.skeleton[node].keys) return;
        channel.scale.times.push_back(time);
        channel.scale.values.push_back(key.scale);
    }

    const double size_;  // scale of skeleton_ and clip_ relative to the source
    const Skeleton skeleton_;
    const Clip clip_;
    const MappedSkeleton to_;
    detail::RetargetBody was_, now_;
    std::vector<std::optional<std::size_t>> shared_;   // the source's node for each target node
    std::vector<std::optional<std::size_t>> leaders_;  // the node that a helper follows
    std::vector<bool> travels_;                        // roots that travel with the hips
    const std::vector<rig::Transform> rest_;
    glm::dquat turn_{1.0, 0.0, 0.0, 0.0};  // from the source's frame to the target's
    double scale_ = 1.0;
    Retargeted result_{};
    std::array<std::optional<detail::Limb>, 2> legs_{};
    std::vector<detail::Footing> footing_{};
    double rate_ = 0.0;  // frames per second of the footing
    std::vector<rig::Transform> pose_, source_pose_;
    std::vector<Placement> source_, placed_, rest_placed_;
};

}  // namespace

Expected<Retargeted> retarget(const MappedSkeleton& from, const Clip& clip, const MappedSkeleton& to) {
    constexpr const char* operation = "retarget";
    for (const MappedSkeleton* body : {&from, &to})
        if (const Result bad = detail::check_map(operation, body->map, body->skeleton); !bad) return bad;
    if (const Result bad = check(clip, from.skeleton); !bad) return bad;
    if (from.map[Bone::Hips].node < 0) return refused(operation, "from.map", "a map with Hips", "none");
    if (to.map[Bone::Hips].node < 0) return refused(operation, "to.map", "a map with Hips", "none");
    double ratio = extent_of(to.skeleton) / extent_of(from.skeleton);
    if (!(std::abs(ratio - 1.0) > 1e-6)) ratio = 1.0;
    if (const std::vector<std::size_t> nodes = same_nodes(from, to, ratio); !nodes.empty()) {
        Retargeted same{.clip = scaled(clip, ratio), .scale = ratio};
        for (Channel& each : same.clip.channels) each.node = nodes[each.node];
        return same;
    }
    const std::vector<double> times = key_times(clip);
    if (times.size() > max_retargeted_keys)
        return refused(operation, "clip", "of at most 100000 keys and frames", times.size());
    return Retargeter(from, clip, to).run(times);
}

}  // namespace tendril::humanoid
