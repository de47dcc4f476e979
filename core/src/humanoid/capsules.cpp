#include "tendril/humanoid/capsules.hpp"

#include <algorithm>
#include <span>

#include "humanoid/anatomy.hpp"
#include "humanoid/input.hpp"
#include "humanoid/limb.hpp"
#include "rig/math.hpp"

namespace tendril::humanoid {
namespace {

using namespace rig::detail;

class DefaultCapsules {
  public:
    DefaultCapsules(const Skeleton& skeleton, const BoneMap& map) : map_(map), placements_(skeleton.size()) {
        place(skeleton, rest_pose(skeleton), placements_);
        size_ = detail::size_of(map, placements_);
    }

    std::vector<BodyCapsule> all() {
        constexpr Bone trunk[]{Bone::Hips, Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck};
        for (std::size_t i = 0; i + 1 < 5; ++i) {
            std::size_t next = i + 1;
            while (next < 4 && !has(trunk[next])) ++next;
            add(trunk[i], has(trunk[next]) ? trunk[next] : Bone::Head, 0.13);
        }
        add_end(Bone::Head, Bone::Neck, 0.05, 0.1, 0.095);
        for (const Bone upper : {Bone::LeftUpperArm, Bone::RightUpperArm}) limb(upper, 0.045, 0.038);
        for (const Bone upper : {Bone::LeftUpperLeg, Bone::RightUpperLeg}) limb(upper, 0.075, 0.05);
        add_end(Bone::LeftHand, Bone::LeftLowerArm, 0.02, 0.1, 0.04);
        add_end(Bone::RightHand, Bone::RightLowerArm, 0.02, 0.1, 0.04);
        return std::move(capsules_);
    }

  private:
    bool has(Bone bone) const { return map_[bone].node >= 0; }
    const Placement& at(Bone bone) const { return placements_[static_cast<std::size_t>(map_[bone].node)]; }
    void limb(Bone upper, double radius, double lower_radius) {
        const Bone lower = *detail::limb_child(upper);
        add(upper, lower, radius);
        add(lower, *detail::limb_child(lower), lower_radius);
    }
    /// Adds a capsule from one bone's joint to another's.
    void add(Bone bone, Bone next, double radius) {
        if (has(bone) && has(next)) put(bone, at(bone).position, at(next).position, radius);
    }
    /// Adds a capsule from `start` to `end` past a bone's joint, in the direction from `before`.
    void add_end(Bone bone, Bone before, double start, double end, double radius) {
        if (!has(bone)) return;
        glm::dvec3 along{0.0, 1.0, 0.0};
        if (has(before))
            along = direction_of(minus(at(bone).position, at(before).position), 1e-9).value_or(along);
        put(bone, plus(at(bone).position, times(along, start * size_)),
            plus(at(bone).position, times(along, end * size_)), radius);
    }
    void put(Bone bone, const glm::dvec3& from, const glm::dvec3& to, double radius) {
        const Placement& own = at(bone);
        capsules_.push_back({bone, detail::to_local(own, minus(from, own.position)),
                             detail::to_local(own, minus(to, own.position)), radius * size_});
    }

    const BoneMap& map_;
    std::vector<Placement> placements_;
    double size_ = 1.0;
    std::vector<BodyCapsule> capsules_{};
};

}  // namespace

double detail::size_of(const BoneMap& map, std::span<const Placement> rest) noexcept {
    const auto way = [&](std::initializer_list<Bone> bones) {
        double sum = 0.0;
        const glm::dvec3* last = nullptr;
        for (const Bone bone : bones) {
            if (map[bone].node < 0) continue;
            const glm::dvec3& at = rest[static_cast<std::size_t>(map[bone].node)].position;
            if (last != nullptr) sum += length(minus(at, *last));
            last = &at;
        }
        return sum;
    };
    const double left = way({Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot}),
                 right = way({Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot});
    const double leg = left > 0.0 && right > 0.0 ? 0.5 * (left + right) : left + right;
    const double size = (way({Bone::Hips, Bone::Head}) + leg) / 1.45;
    return size > 1e-9 ? size : 1.0;
}

std::vector<BodyCapsule> default_capsules(const Skeleton& skeleton, const BoneMap& map) {
    return DefaultCapsules(skeleton, detail::map_or_none(map, skeleton)).all();
}

PlacedCapsule place(const BodyCapsule& capsule, const BoneMap& map,
                    std::span<const Placement> placements) noexcept {
    const auto node = static_cast<std::size_t>(map[capsule.bone].node);  // -1 becomes out of range
    const Placement at = node < placements.size() ? placements[node] : Placement();
    return {at.apply(capsule.from), at.apply(capsule.to), capsule.radius};
}

Nearest nearest(const PlacedCapsule& first, const PlacedCapsule& second) noexcept {
    const glm::dvec3 a = minus(first.to, first.from), b = minus(second.to, second.from);
    const glm::dvec3 apart = minus(first.from, second.from);
    const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ac = dot(a, apart), bc = dot(b, apart);
    const double across = aa * bb - ab * ab;  // 0 if they are parallel
    double s = across > 1e-12 * aa * bb ? std::clamp((ab * bc - ac * bb) / across, 0.0, 1.0) : 0.0;
    double t = bb > 0.0 ? (ab * s + bc) / bb : 0.0;
    if (t < 0.0 || t > 1.0 || bb <= 0.0) {
        t = std::clamp(t, 0.0, 1.0);
        s = aa > 0.0 ? std::clamp((ab * t - ac) / aa, 0.0, 1.0) : 0.0;
    }
    return {plus(first.from, times(a, s)), plus(second.from, times(b, t))};
}

double gap(const PlacedCapsule& first, const PlacedCapsule& second) noexcept {
    const Nearest at = nearest(first, second);
    return length(minus(at.first, at.second)) - first.radius - second.radius;
}

}  // namespace tendril::humanoid
