#include "tendril/rig/parent_constraint.hpp"

#include <algorithm>

#include "rig/euler_choice.hpp"
#include "rig/math.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::rig {
namespace {

using namespace detail;
using Axes = std::array<bool, 3>;

bool all(const Axes& axes) noexcept {
    return axes[0] && axes[1] && axes[2];
}
bool any(const Axes& axes) noexcept {
    return axes[0] || axes[1] || axes[2];
}
bool passes_all(const TransformFilter& filter) noexcept {
    return all(filter.translation) && all(filter.rotation) && all(filter.scale);
}
bool passes_any(const TransformFilter& filter) noexcept {
    return any(filter.translation) || any(filter.rotation) || any(filter.scale);
}

glm::dvec3 chosen(const glm::dvec3& from, const glm::dvec3& to, const Axes& axes) noexcept {
    return {axes[0] ? to.x : from.x, axes[1] ? to.y : from.y, axes[2] ? to.z : from.z};
}
glm::dquat chosen(const glm::dquat& from, const glm::dquat& to, const Axes& axes) noexcept {
    if (all(axes)) return to;
    if (!any(axes)) return from;
    return choose_angles(from, to, axes);
}

/// The weight, bounded so that the sum of all stays finite.
double relative_weight(const ConstraintParent& parent) noexcept {
    return parent.weight > 0.0 ? std::min(parent.weight, static_cast<double>(max_magnitude)) : 0.0;
}

Transform goal(const ConstraintChild& child, const ConstraintParent& parent, bool offset) noexcept {
    if (!offset) return parent.global;
    return compose(parent.global, relative(parent.initial_global, child.initial_global));
}

glm::dquat sum(const glm::dquat& a, const glm::dquat& b, double by) noexcept {
    return {a.w + b.w * by, a.x + b.x * by, a.y + b.y * by, a.z + b.z * by};
}

/// `total` is the sum of the weights, not 0.
Transform mean_goal(const ConstraintChild& child, std::span<const ConstraintParent> parents, double total,
                    bool offset) noexcept {
    const Transform first = goal(child, parents.front(), offset);
    const glm::dquat& hemisphere = first.rotation;
    Transform mean{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    glm::dquat heaviest_rotation = hemisphere;
    double heaviest = 0.0;
    for (const ConstraintParent& parent : parents) {
        const double share = relative_weight(parent) / total;
        if (share == 0.0) continue;
        const Transform each = &parent == parents.data() ? first : goal(child, parent, offset);
        const double side = detail::dot(hemisphere, each.rotation) < 0.0 ? -1.0 : 1.0;
        mean.translation = plus(mean.translation, times(each.translation, share));
        mean.rotation = sum(mean.rotation, each.rotation, side * share);
        mean.scale = plus(mean.scale, times(each.scale, share));
        if (share > heaviest) heaviest = share, heaviest_rotation = each.rotation;
    }
    // Rotations half a turn apart may cancel.
    const bool cancelled = detail::dot(mean.rotation, mean.rotation) < 1e-24;
    mean.rotation = cancelled ? heaviest_rotation : normalised(mean.rotation);
    return mean;
}

}  // namespace

Transform filtered(const Transform& from, const Transform& to, const TransformFilter& filter) noexcept {
    return {chosen(from.translation, to.translation, filter.translation),
            chosen(from.rotation, to.rotation, filter.rotation), chosen(from.scale, to.scale, filter.scale)};
}

Transform parent_constraint(const ConstraintChild& child, std::span<const ConstraintParent> parents,
                            const ParentConstraintOptions& options) noexcept {
    double total = 0.0;
    for (const ConstraintParent& parent : parents) total += relative_weight(parent);
    if (total == 0.0 || weight(options.weight) == 0.0 || !passes_any(options.filter)) return child.global;

    Transform target = mean_goal(child, parents, total, options.maintain_offset);
    if (!passes_all(options.filter)) {
        const Transform from = relative(child.space, child.global), to = relative(child.space, target);
        target = compose(child.space, filtered(from, to, options.filter));
    }
    return blend(child.global, target, options.weight);
}

}  // namespace tendril::rig

template <>
std::span<const tendril::Field> tendril::fields<tendril::rig::ParentConstraintOptions>() noexcept {
    using rig::ParentConstraintOptions;
    static constexpr Field rows[] = {field<&ParentConstraintOptions::maintain_offset>("maintain_offset"),
                                     nested<&ParentConstraintOptions::filter>("filter"),
                                     field<&ParentConstraintOptions::weight>("weight")};
    return rows;
}
