#include "humanoid/shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rig/math.hpp"

namespace tendril::humanoid::detail {
namespace {

using namespace rig::detail;
using Path = std::vector<std::size_t>;

struct Pair {
    std::size_t a, b;
    double reach;  // reach of the shorter limb
};

class Shape {
  public:
    explicit Shape(const Skeleton& skeleton)
        : skeleton_(skeleton), places_(skeleton.size()), reach_(skeleton.size()), end_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), places_);
        top_.resize(skeleton.size());
        double low = INFINITY, high = -INFINITY;
        for (std::size_t i = 0; i < skeleton.size(); ++i) {
            top_[i] = at(i).y;
            end_[i] = i;
            low = std::min(low, at(i).y), high = std::max(high, at(i).y);
        }
        height_ = high - low;
        const auto& order = skeleton.order();
        for (auto it = order.rbegin(); it != order.rend(); ++it) {
            const auto node = static_cast<std::size_t>(*it);
            if (skeleton[node].parent < 0) continue;
            const auto parent = static_cast<std::size_t>(skeleton[node].parent);
            if (const double way = reach_[node] + length(minus(at(node), at(parent))); way >= reach_[parent])
                reach_[parent] = way, end_[parent] = end_[node];
            top_[parent] = std::max(top_[parent], top_[node]);
        }
    }

    ShapeReading read() {
        found_.nodes.fill(-1);
        found_.left_known = false;
        if (!(height_ > 0.0)) return found_;
        const auto hips = find_hips();
        if (!hips) return found_;
        set(Bone::Hips, hips->first);
        read_column(hips->first, hips->second);
        read_legs(hips->second);
        return found_;
    }

  private:
    const glm::dvec3& at(std::size_t node) const { return places_[node].position; }
    void set(Bone bone, std::size_t node) { found_[bone] = static_cast<std::int32_t>(node); }

    /// Children; a child at its parent's position is replaced by its own children.
    Path branches(std::size_t node) const {
        Path result;
        for (const std::int32_t each : skeleton_.children(node)) {
            const auto child = static_cast<std::size_t>(each);
            if (length(minus(at(child), at(node))) > 2e-3 * height_ || skeleton_.children(child).empty())
                result.push_back(child);
            else
                for (const std::size_t further : branches(child)) result.push_back(further);
        }
        return result;
    }
    /// The path from a node to the leaf that is farthest along the bones.
    Path longest(std::size_t node) const {
        Path path{node};
        while (!skeleton_.children(path.back()).empty()) {
            const auto below = skeleton_.children(path.back());
            path.push_back(static_cast<std::size_t>(
                *std::max_element(below.begin(), below.end(),
                                  [&](std::int32_t a, std::int32_t b) { return way(a) < way(b); })));
        }
        return path;
    }
    double way(std::int32_t node) const {
        const auto child = static_cast<std::size_t>(node);
        return reach_[child] +
               length(minus(at(child), at(static_cast<std::size_t>(skeleton_[child].parent))));
    }
    /// True if `middle` lies between `a` and `b`, seen from above.
    bool is_between(const glm::dvec3& middle, const glm::dvec3& a, const glm::dvec3& b) const {
        const glm::dvec3 way(b.x - a.x, 0.0, b.z - a.z);
        if (length(way) < 0.02 * height_) return false;
        const double part = dot(minus(middle, a), way) / dot(way, way);
        return part > 0.1 && part < 0.9;
    }
    /// The pair of equal limbs, one on each side, that reaches furthest.
    std::optional<Pair> pair_at(std::size_t node, bool down) const {
        const Path all = branches(node);
        std::optional<Pair> best;
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t j = i + 1; j < all.size(); ++j) {
                const double shorter = std::min(reach_[all[i]], reach_[all[j]]);
                const double longer = std::max(reach_[all[i]], reach_[all[j]]);
                if (shorter < 0.15 * height_ || shorter < 0.8 * longer) continue;
                if (!is_between(at(node), at(all[i]), at(all[j]))) continue;
                const std::size_t a = end_[all[i]], b = end_[all[j]];
                if (std::abs(at(a).y - at(b).y) > 0.25 * height_) continue;
                if (down && std::max(at(a).y, at(b).y) > at(node).y - 0.2 * height_) continue;
                if (!best || shorter > best->reach) best = Pair{all[i], all[j], shorter};
            }
        }
        return best;
    }
    std::optional<std::pair<std::size_t, Pair>> find_hips() const {
        std::optional<std::pair<std::size_t, Pair>> best;
        double lowest = INFINITY;
        for (std::size_t node = 0; node < skeleton_.size(); ++node) {
            if (top_[node] < at(node).y + 0.2 * height_) continue;
            const auto legs = pair_at(node, true);
            if (!legs) continue;
            // Prefer the limbs that end lowest; among equals, the node nearest to them.
            const double end = std::max(at(end_[legs->a]).y, at(end_[legs->b]).y);
            if (best && end > lowest + 0.05 * height_) continue;
            if (best && end > lowest - 0.05 * height_ && !skeleton_.is_below(node, best->first)) continue;
            best = {node, *legs};
            lowest = end;
        }
        return best;
    }
    /// Index in a path at which the two longest consecutive bones of similar length begin.
    std::optional<std::size_t> upper_of(const Path& path) const {
        std::optional<std::size_t> best;
        double most = 0.0;
        for (std::size_t i = 0; i + 2 < path.size(); ++i) {
            const double upper = length(minus(at(path[i + 1]), at(path[i])));
            const double lower = length(minus(at(path[i + 2]), at(path[i + 1])));
            if (std::min(upper, lower) > 0.4 * std::max(upper, lower) && upper + lower > most)
                most = upper + lower, best = i;
        }
        return best;
    }
    void set_limb(const Path& path, std::array<Bone, 3> bones, Bone before, std::optional<Bone> after) {
        const auto upper = upper_of(path);
        if (!upper) return;
        for (std::size_t i = 0; i < 3; ++i) set(bones[i], path[*upper + i]);
        if (before != bones[0] && *upper > 0) set(before, path[*upper - 1]);
        if (after && *upper + 3 < path.size()) set(*after, path[*upper + 3]);
    }
    std::pair<std::size_t, std::size_t> left_first(const Pair& pair, const glm::dvec3& left) const {
        const std::size_t a = end_[pair.a], b = end_[pair.b];
        const bool a_is_left = dot(minus(at(a), at(b)), left) > 0.0;
        return a_is_left ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
    }
    void read_legs(const Pair& pair) {
        const auto toe_of = [&](std::size_t leg) -> glm::dvec3 {
            const Path path = longest(leg);
            const auto upper = upper_of(path);
            if (!upper || *upper + 3 >= path.size()) return {0.0, 0.0, 0.0};
            return minus(at(path[*upper + 3]), at(path[*upper + 2]));
        };
        const glm::dvec3 toes = plus(toe_of(pair.a), toe_of(pair.b));
        if (std::sqrt(toes.x * toes.x + toes.z * toes.z) > 0.03 * height_) {
            left_ = {toes.z, 0.0, -toes.x};  // up x forward
            found_.left_known = true;
        }
        const auto [left, right] = left_first(pair, left_);
        set_limb(longest(left), {Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot}, Bone::LeftUpperLeg,
                 Bone::LeftToes);
        set_limb(longest(right), {Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot},
                 Bone::RightUpperLeg, Bone::RightToes);
        if (!arms_) return;
        const auto [left_arm, right_arm] = left_first(*arms_, left_);
        set_limb(longest(left_arm), {Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand},
                 Bone::LeftShoulder, std::nullopt);
        set_limb(longest(right_arm), {Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand},
                 Bone::RightShoulder, std::nullopt);
    }
    std::optional<std::size_t> highest_child(std::size_t node, const std::optional<Pair>& but) const {
        std::optional<std::size_t> best;
        for (const std::size_t each : branches(node)) {
            if (but && (each == but->a || each == but->b)) continue;
            if (!best || top_[each] > top_[*best]) best = each;
        }
        return best;
    }
    /// Follows the column up from the hips to the node where the arms branch, and on to the head.
    void read_column(std::size_t hips, const Pair& legs) {
        Path column;
        auto next = highest_child(hips, legs);
        while (next && !arms_) {
            column.push_back(*next);
            arms_ = pair_at(*next, false);
            next = highest_child(*next, arms_);
        }
        if (!arms_) return;
        set(Bone::Spine, column.front());
        if (column.size() > 1) set(Bone::Chest, column[column.size() > 2 ? column.size() - 2 : 1]);
        if (column.size() > 2) set(Bone::UpperChest, column.back());
        if (!next || top_[*next] <= at(column.back()).y) return;
        const auto above = highest_child(*next, std::nullopt);
        if (above) set(Bone::Neck, *next);
        set(Bone::Head, above ? *above : *next);
    }

    const Skeleton& skeleton_;
    std::vector<Placement> places_;
    std::vector<double> reach_, top_;  // per node: length of its longest path down; highest y below it
    std::vector<std::size_t> end_;     // the last node of that path
    double height_ = 0.0;
    std::optional<Pair> arms_{};
    glm::dvec3 left_{1.0, 0.0, 0.0};
    ShapeReading found_{};
};

}  // namespace

ShapeReading read_shape(const Skeleton& skeleton) {
    return Shape(skeleton).read();
}

}  // namespace tendril::humanoid::detail
