#include "app/io/character/bvh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tendril/humanoid/t_pose.hpp>
#include <utility>

#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Placement;
using humanoid::Skeleton;

constexpr std::size_t axis_count = 6, max_looked_at = 200;
/// Minimum cosine between an axis and the legs and spine of a standing figure: at rest, in motion.
constexpr double stands_at_rest = 0.7, stands = 0.6;
/// Feet on a floor may be above or below 0 by this fraction of the figure's height.
constexpr double near_floor = 0.1;

/// A skeleton's legs and spine, which show whether it stands.
struct Body {
    std::array<std::size_t, 2> thighs, feet;
    std::size_t hips, head, root;
    double leg, spine;             ///< lengths along the bones
    std::vector<std::size_t> all;  ///< nodes below the root
    double height() const { return leg + spine; }
};

double length_between(const Skeleton& skeleton, std::span<const Placement> placed, std::size_t from,
                      std::size_t to) {
    double length = 0.0;
    for (std::size_t node = from; node != to && skeleton[node].parent >= 0;) {
        const auto parent = static_cast<std::size_t>(skeleton[node].parent);
        length += glm::distance(placed[node].position, placed[parent].position);
        node = parent;
    }
    return length;
}

std::optional<Body> body_in(const Skeleton& skeleton, const humanoid::BoneMap& map) {
    for (const Bone bone : {Bone::Hips, Bone::Head, Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot,
                            Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot})
        if (map[bone].node < 0) return std::nullopt;
    if (!check(map, skeleton)) return std::nullopt;
    const auto node = [&](Bone bone) { return static_cast<std::size_t>(map[bone].node); };
    Body body{.thighs = {node(Bone::LeftUpperLeg), node(Bone::RightUpperLeg)},
              .feet = {node(Bone::LeftFoot), node(Bone::RightFoot)},
              .hips = node(Bone::Hips),
              .head = node(Bone::Head),
              .root = node(Bone::Hips),
              .leg = 0.0,
              .spine = 0.0,
              .all = {}};
    while (skeleton[body.root].parent >= 0) body.root = static_cast<std::size_t>(skeleton[body.root].parent);
    std::vector<Placement> placed(skeleton.size());
    place(skeleton, rest_pose(skeleton), placed);
    for (std::size_t side = 0; side < 2; ++side)
        body.leg += 0.5 * length_between(skeleton, placed, body.feet[side], body.thighs[side]);
    body.spine = length_between(skeleton, placed, body.head, body.hips);
    if (!(body.leg > 0.0 && body.spine > 0.0)) return std::nullopt;
    std::vector<bool> below(skeleton.size());
    for (const std::int32_t each : skeleton.order()) {
        const auto i = static_cast<std::size_t>(each);
        below[i] = i == body.root ||
                   (skeleton[i].parent >= 0 && below[static_cast<std::size_t>(skeleton[i].parent)]);
        if (below[i]) body.all.push_back(i);
    }
    return body;
}

/// The measures of a pose that show how it stands.
struct Look {
    glm::dvec3 legs{0.0}, spine{0.0};  ///< from feet to thighs and from hips to head; 1: straight
    glm::dvec3 spread{0.0};            ///< from the right foot to the left, minus the same for the thighs
    glm::dvec3 low{0.0}, high{0.0};    ///< the box around all nodes

    /// 1: straight and along the axis.
    double standing(UpAxis up) const {
        const glm::dvec3 axis = direction(up);
        return std::min(glm::dot(legs, axis), glm::dot(spine, axis));
    }
    /// The lowest point along the axis.
    double lowest(UpAxis up) const {
        const glm::dvec3 axis = direction(up);
        return std::min(glm::dot(low, axis), glm::dot(high, axis));
    }
};

UpAxis axis_at(std::size_t index) {
    return static_cast<UpAxis>(index);
}

/// The skeleton in the given rest pose, rotated so that the axis becomes Y.
Expected<Skeleton> stood_up(const Skeleton& skeleton, std::span<const rig::Transform> rest, UpAxis up) {
    std::vector<humanoid::Node> nodes = skeleton.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].rest = rest[i];
    std::vector<humanoid::Clip> none;
    normalise(nodes, none, 1.0, turn_of(up));
    return Skeleton::make(std::move(nodes));
}

/// Finds the legs and the head in the zero pose, or else in the first frame. Shapes are recognised upright,
/// so the figure is tried along each axis.
std::optional<Body> find_body(const Skeleton& skeleton, const humanoid::Clip& clip) {
    std::vector<std::vector<rig::Transform>> poses{rest_pose(skeleton)};
    if (!clip.channels.empty()) {
        poses.push_back(poses[0]);
        sample(clip, skeleton, 0.0, poses[1]);
    }
    for (const std::vector<rig::Transform>& pose : poses) {
        for (const UpAxis up : {UpAxis::Y, UpAxis::Z, UpAxis::X}) {
            const auto turned = stood_up(skeleton, pose, up);
            if (!turned) continue;
            if (const auto body = body_in(*turned, humanoid::match_bones(*turned))) return body;
        }
    }
    return std::nullopt;
}

class Judge {
  public:
    Judge(Character& character, std::vector<humanoid::Node> nodes)
        : character_(character),
          nodes_(std::move(nodes)),
          skeleton_(skeleton_of(nodes_)),
          clip_(character.clips.front()),
          body_(find_body(skeleton_, clip_)),
          pose_(rest_pose(skeleton_)),
          placed_(skeleton_.size()) {}

    void judge() {
        if (body_) {
            for (const RootOffset& each : character_.root_offsets)
                if (each.node == body_->root) offset_ = each.offset;
            look_at_all();
            find_up();
            find_positions();
            stand_up();
        }
        find_unit();
        character_.skeleton = skeleton_of(nodes_);
        read_as(character_, scale_, space_);
        character_.states_unit = false;
        character_.guesses = guesses_;
    }

  private:
    using Positions = RootPositions;

    Look look() {
        place(skeleton_, pose_, placed_);
        const auto at = [&](std::size_t node) { return placed_[node].position; };
        Look look;
        look.low = glm::dvec3(std::numeric_limits<double>::max());
        look.high = -look.low;
        for (const std::size_t node : body_->all) {
            look.low = glm::min(look.low, at(node));
            look.high = glm::max(look.high, at(node));
        }
        const auto &thighs = body_->thighs, &feet = body_->feet;
        look.legs = 0.5 * (at(thighs[0]) - at(feet[0]) + at(thighs[1]) - at(feet[1])) / body_->leg;
        look.spine = (at(body_->head) - at(body_->hips)) / body_->spine;
        look.spread = (at(feet[0]) - at(feet[1]) - at(thighs[0]) + at(thighs[1])) / body_->leg;
        return look;
    }
    void look_at_all() {
        rest_ = look();
        for (const humanoid::Channel& each : clip_.channels)
            frames_ = std::max({frames_, each.translation.times.size(), each.rotation.times.size()});
        const std::size_t count = std::min(frames_, max_looked_at);
        for (std::size_t i = 0; i < count; ++i) {
            sample_frame(i);
            looks_.push_back(look());
        }
    }
    /// The frame of a look.
    std::size_t frame_of(std::size_t look) const {
        const std::size_t count = std::min(frames_, max_looked_at);
        return count < 2 ? 0 : look * (frames_ - 1) / (count - 1);
    }
    void sample_frame(std::size_t look) {
        const double steps = static_cast<double>(std::max<std::size_t>(frames_, 2) - 1);
        sample(clip_, skeleton_, clip_.duration * static_cast<double>(frame_of(look)) / steps, pose_);
    }

    /// The fraction of frames in which the figure stands along the axis.
    double share(UpAxis up) const {
        if (looks_.empty()) return 0.0;
        const auto standing =
            std::ranges::count_if(looks_, [&](const Look& each) { return each.standing(up) >= stands; });
        return static_cast<double>(standing) / static_cast<double>(looks_.size());
    }
    /// The median distance of the lowest point from 0, in multiples of the figure's height.
    double off_floor(UpAxis up, Positions positions) const {
        const double raised = positions == Positions::Add ? glm::dot(offset_, direction(up)) : 0.0;
        std::vector<double> off;
        for (const Look& each : looks_) off.push_back(std::abs(each.lowest(up) + raised));
        const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
        std::nth_element(off.begin(), middle, off.end());
        return *middle / body_->height();
    }
    double off_floor(UpAxis up) const {
        return std::min(off_floor(up, Positions::Replace), off_floor(up, Positions::Add));
    }

    static const char* name(UpAxis up) { return up_axes.title(up); }

    void find_up() {
        std::optional<UpAxis> at_rest;
        UpAxis moving = UpAxis::Y;
        for (std::size_t i = 0; i < axis_count; ++i) {
            if (rest_.standing(axis_at(i)) >= stands_at_rest) at_rest = axis_at(i);
            if (share(axis_at(i)) > share(moving)) moving = axis_at(i);
        }
        rest_up_ = at_rest;
        up_ = at_rest.value_or(share(moving) >= 0.3 ? moving : UpAxis::Y);
        if (at_rest && *at_rest != moving && share(moving) >= 0.6) {
            // Decide between the two by the floor: a figure lying on it does not stand, either.
            const double by_rest = off_floor(*at_rest), by_motion = off_floor(moving);
            const bool floor_at_rest = by_rest < near_floor && by_rest < by_motion;
            if (!floor_at_rest && (share(*at_rest) < 0.1 || by_motion + near_floor < by_rest)) up_ = moving;
        }
        space_.up = up_;
        if (up_ == UpAxis::Y) return;
        const bool rest_agrees = at_rest == up_, motion_agrees = share(up_) >= stands;
        guesses_.up = std::string("The file does not say which axis is up; judging by ") +
                      (rest_agrees && motion_agrees ? "its zero pose and its motion"
                       : rest_agrees                ? "its zero pose"
                                                    : "its motion") +
                      ", it is " + name(up_) + '.';
    }

    void find_positions() {
        if (offset_ == glm::dvec3(0.0) || looks_.empty()) return;
        const bool added = off_floor(up_, Positions::Add) < near_floor,
                   replaced = off_floor(up_, Positions::Replace) < near_floor;
        if (added && !replaced) space_.positions = Positions::Add;
        if (added == replaced)
            guesses_.positions = "The root's positions are taken to replace its OFFSET.";
        else
            guesses_.positions = std::string(added ? "The root's positions are added to its OFFSET"
                                                   : "The root's positions replace its OFFSET") +
                                 ": that puts the feet on the floor.";
    }

    /// Rotates a zero pose that stands along another axis, and takes the rest pose from the motion if the
    /// zero pose does not stand at all.
    void stand_up() {
        if (rest_up_ == up_ || share(up_) == 0.0) return;
        if (rest_up_) {
            const glm::dquat turn = conjugate(turn_of(up_)) * turn_of(*rest_up_);
            std::vector<humanoid::Clip> none;
            normalise(nodes_, none, 1.0, turn);
            character_.notes.push_back(std::string("The zero pose stands along ") + name(*rest_up_) +
                                       ", the motion along " + name(up_) +
                                       "; the rest pose is rotated to stand like the motion.");
            return;
        }
        const auto neutral = [&](const Look& each) {
            const glm::dvec3 axis = direction(up_);
            return glm::dot(each.legs + each.spine, axis) - glm::length(each.spread);
        };
        const auto best = std::ranges::max_element(looks_, {}, neutral);
        const auto index = static_cast<std::size_t>(best - looks_.begin());
        sample_frame(index);
        stand_straight();
        for (std::size_t i = 0; i < nodes_.size(); ++i) nodes_[i].rest = pose_[i];
        // Place it above the origin, at its height in the motion or, failing that, on the floor.
        const glm::dvec3 axis = direction(up_);
        const double added = space_.positions == Positions::Add ? glm::dot(offset_, axis) : 0.0;
        glm::dvec3& at = nodes_[body_->root].rest.translation;
        const bool has_floor = off_floor(up_, space_.positions) < near_floor;
        at = axis * (has_floor ? glm::dot(at, axis) + added : glm::dot(at, axis) - best->lowest(up_));
        character_.notes.push_back("The zero pose does not stand; the rest pose is frame " +
                                   std::to_string(frame_of(index)) + " of the motion, on straight legs.");
    }

    /// Turns a frame into a rest pose: facing +Z of a file with Y up, legs straight, feet pointing forward,
    /// 30 degrees below level, toes level. The heading and footing of a single frame say nothing about the
    /// figure. The lower ankle stays in place.
    void stand_straight() {
        const double before = lowest_ankle();
        const auto standing = stood_up(skeleton_, pose_, up_);
        if (!standing) return;
        const humanoid::BoneMap map = humanoid::match_bones(*standing);
        const glm::dvec3 forward = facing(*standing, map).forward;
        glm::dquat& root = pose_[body_->root].rotation;
        root = math::rotation_about(direction(up_), -math::arctangent(forward.x, forward.z)) * root;
        const glm::dvec3 ahead = conjugate(turn_of(up_)) * glm::dvec3(0.0, 0.0, 1.0);
        const auto point_bone = [&](Bone from, Bone to, const glm::dvec3& way) {
            point(map[from].node, map[to].node, way);
        };
        for (const bool left : {true, false}) {
            const Bone upper = left ? Bone::LeftUpperLeg : Bone::RightUpperLeg,
                       lower = left ? Bone::LeftLowerLeg : Bone::RightLowerLeg,
                       foot = left ? Bone::LeftFoot : Bone::RightFoot,
                       toes = left ? Bone::LeftToes : Bone::RightToes;
            point_bone(upper, lower, -direction(up_)), point_bone(lower, foot, -direction(up_));
            point_bone(foot, toes, ahead * std::sqrt(0.75) - direction(up_) * 0.5);
            if (map[toes].node < 0) continue;
            const auto below = skeleton_.children(static_cast<std::size_t>(map[toes].node));
            if (!below.empty()) point(map[toes].node, below.front(), ahead);
        }
        pose_[body_->root].translation += direction(up_) * (before - lowest_ankle());
    }
    double lowest_ankle() {
        place(skeleton_, pose_, placed_);
        return std::min(glm::dot(placed_[body_->feet[0]].position, direction(up_)),
                        glm::dot(placed_[body_->feet[1]].position, direction(up_)));
    }
    /// Rotates a node so that another node below it lies in that direction.
    void point(std::int32_t node, std::int32_t end, const glm::dvec3& to) {
        if (node < 0 || end < 0) return;
        const auto from = static_cast<std::size_t>(node);
        place(skeleton_, pose_, placed_);
        const glm::dvec3 way = placed_[static_cast<std::size_t>(end)].position - placed_[from].position;
        if (!(glm::length(way) > 0.0)) return;
        const glm::dquat own = placed_[from].rotation(), above = own * conjugate(pose_[from].rotation);
        pose_[from].rotation = conjugate(above) * glm::dquat(glm::normalize(way), to) * own;
    }

    void find_unit() {
        const Skeleton skeleton = skeleton_of(nodes_);
        place(skeleton, rest_pose(skeleton), placed_);
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const Placement& each : placed_) {
            const double height = glm::dot(each.position, direction(up_));
            low = std::min(low, height);
            high = std::max(high, height);
        }
        const LengthUnit unit = guess_unit(high - low);
        guesses_.unit =
            std::string("BVH files do not state a unit; judging by the figure's height, this one is in ") +
            unit.name + '.';
        scale_ = unit.metres;
    }

    Character& character_;
    std::vector<humanoid::Node> nodes_;
    const Skeleton skeleton_;
    const humanoid::Clip& clip_;
    const std::optional<Body> body_;
    std::vector<rig::Transform> pose_;
    std::vector<Placement> placed_;
    glm::dvec3 offset_{0.0};
    Look rest_{};
    std::vector<Look> looks_{};
    std::size_t frames_ = 0;
    std::optional<UpAxis> rest_up_{};
    UpAxis up_ = UpAxis::Y;
    double scale_ = 1.0;
    FileSpace space_{};
    Character::Guesses guesses_{};
};

}  // namespace

void judge_space(Character& character, std::vector<humanoid::Node> nodes) {
    Judge(character, std::move(nodes)).judge();
}

}  // namespace tendril::app
