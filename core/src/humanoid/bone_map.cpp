#include "tendril/humanoid/bone_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "humanoid/input.hpp"
#include "humanoid/names.hpp"
#include "humanoid/shape.hpp"
#include "rig/math.hpp"
#include "tendril/elementary.hpp"

namespace tendril::humanoid {
namespace {

using detail::NameReading;
using detail::Part;
using detail::ShapeReading;
using detail::Side;

constexpr const char* names[bone_count]{
    "Hips",          "Spine",         "Chest",        "UpperChest",   "Neck",          "Head",
    "LeftShoulder",  "LeftUpperArm",  "LeftLowerArm", "LeftHand",     "RightShoulder", "RightUpperArm",
    "RightLowerArm", "RightHand",     "LeftUpperLeg", "LeftLowerLeg", "LeftFoot",      "LeftToes",
    "RightUpperLeg", "RightLowerLeg", "RightFoot",    "RightToes"};

using Nodes = std::array<std::int32_t, bone_count>;

/// Finds bones by name, one after another; those already found restrict the search for the next.
class Names {
  public:
    /// If the names give no hips or head, takes them from the shape to find the spine.
    Names(const Skeleton& skeleton, const ShapeReading& shape)
        : skeleton_(skeleton), readings_(skeleton.size()) {
        const std::string ignored = detail::common_word(skeleton);
        for (std::size_t i = 0; i < skeleton.size(); ++i)
            readings_[i] = detail::read_name(skeleton[i].name, ignored);
        found.fill(-1);
        set(Bone::Hips, find_hips());
        set(Bone::Head, topmost(Part::Head, Side::None, at(Bone::Hips)));
        limb(Side::Left, Bone::LeftShoulder, Bone::LeftUpperLeg);
        limb(Side::Right, Bone::RightShoulder, Bone::RightUpperLeg);
        raise_hips();
        const auto or_shape = [&](Bone bone) { return at(bone) >= 0 ? at(bone) : shape[bone]; };
        column(or_shape(Bone::Hips), or_shape(Bone::Head));
    }
    Nodes found;
    bool raised = false;  ///< the hips are not the node named hips

  private:
    std::int32_t at(Bone bone) const { return found[static_cast<std::size_t>(bone)]; }
    void set(Bone bone, std::int32_t node) { found[static_cast<std::size_t>(bone)] = node; }
    const NameReading& reading(std::int32_t node) const { return readings_[static_cast<std::size_t>(node)]; }
    std::int32_t parent(std::int32_t node) const { return skeleton_[static_cast<std::size_t>(node)].parent; }
    const std::string& name_of(std::int32_t node) const {
        return skeleton_[static_cast<std::size_t>(node)].name;
    }
    bool below(std::int32_t node, std::int32_t above) const {
        return above < 0 ||
               skeleton_.is_below(static_cast<std::size_t>(node), static_cast<std::size_t>(above));
    }

    /// The first node with this part and side from the root down, below `above`.
    std::int32_t topmost(Part part, Side side, std::int32_t above) const {
        for (const std::int32_t node : skeleton_.order())
            if (reading(node).part == part && reading(node).side == side && node != above &&
                below(node, above))
                return node;
        return -1;
    }
    /// The candidate with the most left and right nodes below it; among equals, one named hips, or else the
    /// one nearest to the limbs.
    std::int32_t find_hips() const {
        std::int32_t best = -1;
        std::size_t most = 0;
        bool best_is_hips = false;
        for (const std::int32_t node : skeleton_.order()) {
            if (reading(node).part != Part::Hips) continue;
            std::size_t sided = 0;
            for (std::size_t i = 0; i < skeleton_.size(); ++i)
                sided += readings_[i].side != Side::None && below(static_cast<std::int32_t>(i), node);
            const bool is_hips = reading(node).is_plain;
            if (best >= 0 && (sided < most || (sided == most && best_is_hips && !is_hips))) continue;
            best = node, most = sided, best_is_hips = is_hips;
        }
        return best;
    }
    /// The nearest ancestor, up to the hips, that is one of these parts on this side.
    std::int32_t above(std::int32_t node, Side side, std::initializer_list<Part> parts) const {
        for (std::int32_t each = parent(node); each >= 0 && each != at(Bone::Hips); each = parent(each))
            if (reading(each).side == side &&
                std::find(parts.begin(), parts.end(), reading(each).part) != parts.end())
                return first_of_split(each);
        return -1;
    }
    /// The first part of a split limb bone: upperarm01, above upperarm02. "arm 1, arm 2" may be the two bones
    /// of an arm.
    std::int32_t first_of_split(std::int32_t node) const {
        const Part part = reading(node).part;
        if (part == Part::Arm || part == Part::Leg || part == Part::ShoulderArm) return node;
        for (std::int32_t next = parent(node);
             next >= 0 && reading(next).part == part && reading(next).side == reading(node).side &&
             skeleton_.children(static_cast<std::size_t>(next)).size() == 1 &&
             detail::is_same_but_for_numbers(name_of(next), name_of(node));
             next = parent(node))
            node = next;
        return node;
    }
    /// The first node from the root down with this part and side, and one of `parts` above it. Prefers nodes
    /// beside or below the hips, since a file may have several rigs.
    std::int32_t leg_node(Part part, Side side, std::initializer_list<Part> parts) const {
        const std::int32_t hips = at(Bone::Hips);
        for (const std::int32_t around : {hips >= 0 ? parent(hips) : -1, -1})
            for (const std::int32_t node : skeleton_.order())
                if (reading(node).part == part && reading(node).side == side && below(node, around) &&
                    (parts.size() == 0 || above(node, side, parts) >= 0))
                    return node;
        return -1;
    }
    void limb(Side side, Bone shoulder, Bone upper_leg) {
        const auto next = [](Bone bone, int by) { return static_cast<Bone>(static_cast<int>(bone) + by); };
        const std::int32_t hand = topmost(Part::Hand, side, at(Bone::Hips));
        std::int32_t lower = hand >= 0 ? above(hand, side, {Part::LowerArm, Part::Arm})
                                       : topmost(Part::LowerArm, side, at(Bone::Hips));
        std::int32_t upper =
            lower >= 0 ? above(lower, side, {Part::UpperArm, Part::Arm, Part::ShoulderArm}) : -1;
        if (lower < 0) upper = topmost(Part::UpperArm, side, at(Bone::Hips));
        set(next(shoulder, 3), hand);
        set(next(shoulder, 2), lower);
        set(next(shoulder, 1), upper);
        if (upper >= 0) set(shoulder, above(upper, side, {Part::Shoulder, Part::ShoulderArm}));

        // Legs may be siblings of the node named hips. A foot without a leg above it, as in IK rigs, counts
        // only once attached() has moved it (attach.hpp).
        const std::int32_t foot = leg_node(Part::Foot, side, {Part::LowerLeg, Part::Leg});
        lower =
            foot >= 0 ? above(foot, side, {Part::LowerLeg, Part::Leg}) : leg_node(Part::LowerLeg, side, {});
        if (lower < 0) lower = leg_node(Part::Leg, side, {Part::UpperLeg, Part::Leg});
        const std::int32_t thigh =
            lower >= 0 ? above(lower, side, {Part::UpperLeg, Part::Leg}) : leg_node(Part::UpperLeg, side, {});
        set(next(upper_leg, 2), foot);
        set(next(upper_leg, 1), lower);
        set(upper_leg, thigh);
        if (foot >= 0) set(next(upper_leg, 3), topmost(Part::Toes, side, foot));
    }
    /// A node named hips may be the first of the spine, with the legs beside it. The body's hips are then the
    /// node above both, unless it is at least a thigh's length from the legs, like a root on the floor.
    void raise_hips() {
        const std::int32_t left = at(Bone::LeftUpperLeg), right = at(Bone::RightUpperLeg);
        const std::int32_t knee = at(Bone::LeftLowerLeg), named = at(Bone::Hips);
        std::int32_t node = named;
        if (node < 0 || left < 0 || right < 0 || knee < 0) return;
        while (node >= 0 && !(below(left, node) && below(right, node))) node = parent(node);
        if (node < 0 || node == named) return;
        using namespace rig::detail;
        std::vector<Placement> rest(skeleton_.size());
        place(skeleton_, rest_pose(skeleton_), rest);
        const auto place_of = [&](std::int32_t each) {
            return rest[static_cast<std::size_t>(each)].position;
        };
        const glm::dvec3 middle = times(plus(place_of(left), place_of(right)), 0.5);
        if (length(minus(place_of(node), middle)) >= length(minus(place_of(knee), place_of(left)))) return;
        set(Bone::Hips, node);
        raised = true;
    }
    /// Finds the bones between the hips and the head: a neck, and below it one to three bones of the spine.
    void column(std::int32_t hips, std::int32_t head) {
        if (hips < 0 || head < 0 || !below(head, hips)) return;
        std::vector<std::int32_t> spine;
        std::int32_t neck = -1;
        for (std::int32_t node = parent(head); node >= 0 && node != hips; node = parent(node)) {
            if (reading(node).part == Part::Neck) neck = node;
            if (reading(node).part == Part::Spine && arms_below(node)) spine.push_back(node);
        }
        set(Bone::Neck, neck);
        if (spine.empty()) return;
        std::reverse(spine.begin(), spine.end());
        set(Bone::Spine, spine.front());
        if (spine.size() > 1) set(Bone::Chest, spine[spine.size() > 2 ? spine.size() - 2 : 1]);
        if (spine.size() > 2) set(Bone::UpperChest, spine.back());
    }

    /// True if the arms branch off below the node. Rigify names its neck "spine" too.
    bool arms_below(std::int32_t node) const {
        const std::int32_t arm = at(Bone::LeftUpperArm);
        return arm < 0 || below(arm, node);
    }

    const Skeleton& skeleton_;
    std::vector<NameReading> readings_;
};

std::string named(const Skeleton& skeleton, std::int32_t node) {
    std::string text = "named ";
    text += skeleton[static_cast<std::size_t>(node)].name;
    return text;
}

// Confidences rank the evidence: chosen, not measured.
constexpr double by_shape_alone = 0.6, contradicted = 0.65, by_name_alone = 0.8, agreed = 0.98;

/// Combines the answers of both readers for one bone.
BoneMatch combine_matches(const Skeleton& skeleton, std::int32_t by_name, std::int32_t by_shape) {
    BoneMatch match;
    if (by_name < 0 && by_shape < 0) return match;
    match.node = by_name >= 0 ? by_name : by_shape;
    if (by_name < 0) {
        match.confidence = by_shape_alone;
        match.reasons = "its position in the skeleton; its name gives no clue";
    } else if (by_shape < 0) {
        match.confidence = by_name_alone;
        match.reasons = named(skeleton, by_name);
    } else if (by_name == by_shape) {
        match.confidence = agreed;
        match.reasons = named(skeleton, by_name) + "; its position in the skeleton agrees";
    } else {
        match.confidence = contradicted;
        match.reasons = named(skeleton, by_name) + "; by its position in the skeleton it would be " +
                        skeleton[static_cast<std::size_t>(by_shape)].name;
    }
    return match;
}

/// If palm bones start side by side at the wrist, the one with the middle finger is the hand.
std::int32_t middle_of_palm(const Skeleton& skeleton, std::int32_t hand) {
    const auto node = [&](std::int32_t i) -> const Node& { return skeleton[static_cast<std::size_t>(i)]; };
    if (hand < 0 || node(hand).parent < 0 || !detail::is_palm_name(node(hand).name)) return hand;
    for (const std::int32_t sibling : skeleton.children(static_cast<std::size_t>(node(hand).parent)))
        if (detail::is_palm_name(node(sibling).name))
            for (const std::int32_t finger : skeleton.children(static_cast<std::size_t>(sibling)))
                if (detail::finger_named(node(finger).name) == detail::Finger::Middle) return sibling;
    return hand;
}

using Path = std::vector<std::int32_t>;
/// The paths from below the last common ancestor down to each node, continued while nodes have one child.
/// Mirrored limbs give equally long paths, whichever of their nodes have bones.
std::array<Path, 2> limb_paths(const Skeleton& skeleton, std::int32_t a, std::int32_t b) {
    const auto index = [](std::int32_t node) { return static_cast<std::size_t>(node); };
    const auto path_to = [&](std::int32_t node, std::int32_t other) {
        Path path;
        for (; node >= 0 && node != other && !skeleton.is_below(index(other), index(node));
             node = skeleton[index(node)].parent)
            path.insert(path.begin(), node);
        return path;
    };
    std::array<Path, 2> paths{path_to(a, b), path_to(b, a)};
    for (Path& path : paths)
        while (!path.empty() && skeleton.children(index(path.back())).size() == 1)
            path.push_back(skeleton.children(index(path.back()))[0]);
    return paths;
}

/// Gives limbs with equally many nodes on both sides their bones at the same nodes. If the sides differ, the
/// one that agrees more with the shape wins.
void mirror_limbs(const Skeleton& skeleton, const ShapeReading& shape, BoneMap& map) {
    constexpr std::size_t bones = 4;
    for (const Bone first : {Bone::LeftShoulder, Bone::LeftUpperLeg}) {
        const auto bone = [&](std::size_t side, std::size_t i) {
            return static_cast<Bone>(static_cast<std::size_t>(side == 0 ? first : mirrored(first)) + i);
        };
        std::array<std::int32_t, 2> ends{-1, -1};
        std::array<int, 2> score{};
        for (const std::size_t side : {0u, 1u})
            for (std::size_t i = 0; i < bones; ++i)
                if (const std::int32_t node = map[bone(side, i)].node; node >= 0) {
                    ends[side] = node;
                    score[side] += node == shape[bone(side, i)] ? 2 : 1;
                }
        if (ends[0] < 0 || ends[1] < 0) continue;
        const std::array<Path, 2> paths = limb_paths(skeleton, ends[0], ends[1]);
        if (paths[0].size() != paths[1].size()) continue;
        const std::size_t better = score[1] > score[0] ? 1 : 0;
        const auto mirror = [&](std::size_t from, std::size_t i) {
            const auto& path = paths[from];
            const auto at = static_cast<std::size_t>(
                std::find(path.begin(), path.end(), map[bone(from, i)].node) - path.begin());
            BoneMatch& match = map[bone(1 - from, i)];
            if (at == path.size() || match.node == paths[1 - from][at]) return;  // loose feet are in neither
            match = {paths[1 - from][at], contradicted, "as "};
            match.reasons += skeleton[static_cast<std::size_t>(path[at])].name + " on the other side";
        };
        for (std::size_t i = 0; i < bones; ++i)
            if (map[bone(better, i)].node >= 0) mirror(better, i);
        for (std::size_t i = 0; i < bones; ++i) {
            BoneMatch& other = map[bone(1 - better, i)];
            if (map[bone(better, i)].node >= 0 || other.node < 0) continue;
            bool is_taken = false;
            for (std::size_t k = 0; k < bones; ++k)
                is_taken = is_taken || (k != i && map[bone(1 - better, k)].node == other.node);
            if (is_taken)
                other = {};
            else
                mirror(1 - better, i);
        }
    }
    // If two bones share a node, the one with the higher confidence keeps it.
    for (BoneMatch& match : map.bones)
        for (BoneMatch& other : map.bones)
            if (&match != &other && match.node >= 0 && match.node == other.node)
                (match.confidence < other.confidence ? match : other) = {};
}

/// The shape alone cannot tell left from right if the feet have no direction; names can.
void swap_sides(ShapeReading& shape) {
    for (std::size_t i = 0; i < bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        if (mirrored(bone) > bone) std::swap(shape[bone], shape[mirrored(bone)]);
    }
}

}  // namespace

const char* name(Bone bone) noexcept {
    return names[static_cast<std::size_t>(bone)];
}
std::optional<Bone> bone_named(std::string_view text) noexcept {
    for (std::size_t i = 0; i < bone_count; ++i)
        if (names[i] == text) return static_cast<Bone>(i);
    return std::nullopt;
}
bool is_needed(Bone bone) noexcept {
    constexpr Bone others[]{Bone::Chest,         Bone::UpperChest, Bone::Neck,     Bone::LeftShoulder,
                            Bone::RightShoulder, Bone::LeftToes,   Bone::RightToes};
    return std::ranges::find(others, bone) == std::end(others);
}
Bone mirrored(Bone bone) noexcept {
    const int i = static_cast<int>(bone);
    if (i < static_cast<int>(Bone::LeftShoulder)) return bone;
    return static_cast<Bone>((i - 6) / 4 % 2 == 0 ? i + 4 : i - 4);
}
const char* name(RestPose pose) noexcept {
    constexpr const char* all[]{"T", "A", "other"};
    return all[static_cast<std::size_t>(pose)];
}

BoneMap match_bones(const Skeleton& skeleton) {
    ShapeReading shape = detail::read_shape(skeleton);
    for (const Bone hand : {Bone::LeftHand, Bone::RightHand})
        shape.nodes[static_cast<std::size_t>(hand)] = middle_of_palm(skeleton, shape[hand]);
    const Names by_name(skeleton, shape);
    std::size_t same = 0, crossed = 0;
    for (std::size_t i = static_cast<std::size_t>(Bone::LeftShoulder); i < bone_count; ++i) {
        if (by_name.found[i] < 0) continue;
        same += by_name.found[i] == shape.nodes[i];
        crossed += by_name.found[i] == shape[mirrored(static_cast<Bone>(i))];
    }
    if (crossed > same) swap_sides(shape);

    BoneMap map;
    std::vector<bool> taken(skeleton.size());
    for (const std::int32_t node : by_name.found)
        if (node >= 0) taken[static_cast<std::size_t>(node)] = true;
    for (std::size_t i = 0; i < bone_count; ++i) {
        std::int32_t by_shape = shape.nodes[i];
        if (by_name.found[i] < 0 && by_shape >= 0) {
            if (taken[static_cast<std::size_t>(by_shape)])
                by_shape = -1;
            else
                taken[static_cast<std::size_t>(by_shape)] = true;
        }
        map.bones[i] = combine_matches(skeleton, by_name.found[i], by_shape);
    }
    mirror_limbs(skeleton, shape, map);
    if (by_name.raised) map[Bone::Hips].reasons = "the legs and the node named hips are below it";
    review(map, skeleton);
    return map;
}

namespace {

/// The parent bone in a body with all bones; the hips are their own parent.
Bone parent_of(Bone bone) noexcept {
    switch (bone) {
        case Bone::Hips:
        case Bone::Spine:
        case Bone::LeftUpperLeg:
        case Bone::RightUpperLeg:
            return Bone::Hips;
        case Bone::LeftShoulder:
        case Bone::RightShoulder:
            return Bone::UpperChest;
        default:
            return static_cast<Bone>(static_cast<int>(bone) - 1);
    }
}

bool is_in(const Skeleton& skeleton, std::int32_t node) noexcept {
    return node >= 0 && static_cast<std::size_t>(node) < skeleton.size();
}

std::optional<Bone> first_missing(const BoneMap& map) noexcept {
    for (std::size_t i = 0; i < bone_count; ++i)
        if (const auto bone = static_cast<Bone>(i); is_needed(bone) && map[bone].node < 0) return bone;
    return std::nullopt;
}

}  // namespace

Result detail::check_usable(std::string_view operation, const BoneMap& map) noexcept {
    using tendril::detail::refused;
    if (const auto bone = first_missing(map)) return refused(operation, name(*bone), "mapped", "none");
    return map.upright ? Result() : refused(operation, "map", "for an upright body", "one that is not");
}

bool BoneMap::is_usable() const noexcept {
    return upright && !first_missing(*this);
}

Result detail::check_map(std::string_view operation, const BoneMap& map, const Skeleton& skeleton) noexcept {
    using tendril::detail::refused;
    for (std::size_t i = 0; i < bone_count; ++i) {
        const auto bone = static_cast<Bone>(i);
        const std::int32_t node = map[bone].node;
        if (node == -1) continue;
        if (!is_in(skeleton, node)) return refused(operation, name(bone), "a node of the skeleton", node);
        const std::string_view found = skeleton[static_cast<std::size_t>(node)].name;
        for (std::size_t other = 0; other < i; ++other)
            if (map.bones[other].node == node)
                return refused(operation, name(bone), "a node not mapped to another bone", found);
        for (Bone above = bone; above != Bone::Hips;) {
            above = parent_of(above);
            const std::int32_t parent = map[above].node;
            if (is_in(skeleton, parent) && parent != node &&
                skeleton.is_below(static_cast<std::size_t>(parent), static_cast<std::size_t>(node)))
                return refused(operation, name(bone), "a node that is not above any of its parent bones",
                               found);
        }
    }
    return {};
}

Result detail::not_below_hips(const Skeleton& skeleton, std::size_t node, Bone bone) noexcept {
    char text[Result::max_message + 1];
    std::snprintf(text, sizeof text, "%.80s is not below the hips. Pick another node for %s",
                  skeleton[node].name.c_str(), name(bone));
    return {ErrorCode::InvalidArgument, text};
}

const BoneMap& detail::map_or_none(const BoneMap& map, const Skeleton& skeleton) noexcept {
    static const BoneMap none;
    return check(map, skeleton) ? map : none;
}

Result check(const BoneMap& map, const Skeleton& skeleton) noexcept {
    return detail::check_map("bone map", map, skeleton);
}

void review(BoneMap& map, const Skeleton& skeleton) {
    map.missing.clear();
    for (std::size_t i = 0; i < bone_count; ++i)
        if (!is_in(skeleton, map.bones[i].node) && is_needed(static_cast<Bone>(i)))
            map.missing.push_back(static_cast<Bone>(i));

    std::vector<Placement> places(skeleton.size());
    place(skeleton, rest_pose(skeleton), places);
    const auto at = [&](Bone bone) { return places[static_cast<std::size_t>(map[bone].node)].position; };
    const auto has = [&](Bone bone) { return is_in(skeleton, map[bone].node); };
    map.upright = true;
    if (has(Bone::Hips) && has(Bone::Head)) {
        const glm::dvec3 way = at(Bone::Head) - at(Bone::Hips);
        map.upright = way.y > std::sqrt(way.x * way.x + way.z * way.z);
    }
    map.rest = RestPose::Other;
    double lowest = 90.0, highest = -90.0;  // degrees above level, of both upper arms
    for (const Bone upper : {Bone::LeftUpperArm, Bone::RightUpperArm}) {
        const auto lower = static_cast<Bone>(static_cast<int>(upper) + 1);
        if (!has(upper) || !has(lower)) return;
        const glm::dvec3 way = at(lower) - at(upper);
        const double angle =
            math::arctangent(way.y, std::sqrt(way.x * way.x + way.z * way.z)) * 180.0 / rig::detail::pi;
        lowest = std::min(lowest, angle), highest = std::max(highest, angle);
    }
    if (lowest >= -22.5 && highest <= 22.5)
        map.rest = RestPose::T;
    else if (lowest >= -67.5 && highest <= -22.5)
        map.rest = RestPose::A;
}

}  // namespace tendril::humanoid
