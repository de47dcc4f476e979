// The value: names, places, and what is refused.
#include "tendril/ik/linkage.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "ik/math.hpp"
#include "math/checks.hpp"
#include "math/elementary.hpp"

namespace tendril::ik {

using tendril::detail::Argument;
using tendril::detail::index_of_name;
using tendril::detail::refused;
using tendril::detail::Shown;

const char* name(LinkJoint joint) noexcept {
    constexpr const char* names[] = {"hinge", "slider", "ball"};
    return names[static_cast<std::size_t>(joint)];
}

const char* name(LinkageStatus status) noexcept {
    constexpr const char* names[] = {"Reached", "TargetMissed",   "Limited",     "DeadPoint",
                                     "Open",    "IterationLimit", "InvalidInput"};
    return names[static_cast<std::size_t>(status)];
}

glm::dvec3 LinkPlace::point(const glm::dvec3& drawn) const noexcept {
    return detail::plus(detail::rotated(rotation, drawn), shift);
}

namespace {

constexpr const char* coordinate_range_said = "a number of magnitude at most 1e9";

Result check_place(const Argument& argument, const glm::dvec3& at) noexcept {
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(at[axis]) <= static_cast<double>(max_magnitude)))
            return refused("linkage", argument, coordinate_range_said, at[axis]);
    return {};
}
Result check_link_of(const Argument& argument, std::size_t link, const Linkage& linkage) noexcept {
    if (link == ground_link || link < linkage.links.size()) return {};
    return refused("linkage", argument, "a link's index, or the ground", link);
}

Result check_range(const Link& link, std::size_t at) noexcept {
    if (link.joint == LinkJoint::Ball) {
        // By default a ball turns all the way; its rest and minimum have no effect.
        for (const auto& [field, value] : {std::pair("rest", link.rest), std::pair("minimum", link.minimum)})
            if (std::isnan(value)) return refused("linkage", {"links", at, field}, "a number", value);
        if (!((link.maximum >= 0.0 && link.maximum <= math::pi) ||
              link.maximum == std::numeric_limits<double>::infinity()))
            return refused("linkage", {"links", at, "maximum"}, "0 to pi, or infinite", link.maximum);
        return {};
    }
    if (!(std::abs(link.rest) <= static_cast<double>(max_magnitude)))
        return refused("linkage", {"links", at, "rest"}, coordinate_range_said, link.rest);
    if (!(link.minimum <= link.maximum))
        return refused("linkage", {"links", at, "minimum"}, "at most its maximum", link.minimum);
    if (!(link.minimum <= link.rest && link.rest <= link.maximum))
        return refused("linkage", {"links", at, "rest"}, "within its range", link.rest);
    return {};
}

Result check_one_link(const Linkage& linkage, std::size_t at) noexcept {
    const Link& link = linkage.links[at];
    if (link.parent != ground_link && link.parent >= at)
        return refused("linkage", {"links", at, "parent"}, "an earlier link, or the ground", link.parent);
    if (static_cast<std::uint8_t>(link.joint) > static_cast<std::uint8_t>(LinkJoint::Ball))
        return refused("linkage", {"links", at, "joint"}, "hinge, slider or ball",
                       static_cast<std::size_t>(link.joint));
    if (const Result bad = check_place({"links", at, "at"}, link.at); !bad) return bad;
    if (link.joint != LinkJoint::Ball) {
        if (const Result bad = check_place({"links", at, "axis"}, link.axis); !bad) return bad;
        if (!(detail::length(link.axis) > 1e-9))
            return refused("linkage", {"links", at, "axis"}, "longer than 0", detail::length(link.axis));
    }
    return check_range(link, at);
}

}  // namespace

std::optional<std::size_t> Linkage::find_link(std::string_view name) const noexcept {
    return index_of_name(links, name);
}
std::optional<std::size_t> Linkage::find_point(std::string_view name) const noexcept {
    return index_of_name(points, name);
}

Result check(const Linkage& linkage) noexcept {
    const char* lists[] = {"links", "points", "closures"};
    const std::size_t sizes[] = {linkage.links.size(), linkage.points.size(), linkage.closures.size()};
    for (std::size_t i = 0; i < 3; ++i)
        if (sizes[i] > max_links) return refused("linkage", lists[i], "at most 512 in number", sizes[i]);
    for (std::size_t i = 0; i < linkage.links.size(); ++i) {
        if (const Result bad = check_one_link(linkage, i); !bad) return bad;
        const std::string& name = linkage.links[i].name;
        if (!name.empty() && *linkage.find_link(name) < i)
            return refused("linkage", {"links", i, "name"}, "that of no link before", std::string_view(name));
    }
    for (std::size_t i = 0; i < linkage.points.size(); ++i) {
        const LinkPoint& each = linkage.points[i];
        if (const Result bad = check_link_of({"points", i, "link"}, each.link, linkage); !bad) return bad;
        if (const Result bad = check_place({"points", i, "at"}, each.at); !bad) return bad;
    }
    for (std::size_t i = 0; i < linkage.closures.size(); ++i) {
        const Closure& each = linkage.closures[i];
        if (static_cast<std::uint8_t>(each.kind) > static_cast<std::uint8_t>(ClosureKind::Frame))
            return refused("linkage", {"closures", i, "kind"}, "point or frame",
                           static_cast<std::size_t>(each.kind));
        if (const Result bad = check_link_of({"closures", i, "first"}, each.first, linkage); !bad) return bad;
        if (const Result bad = check_link_of({"closures", i, "second"}, each.second, linkage); !bad)
            return bad;
        if (each.first == each.second)
            return refused("linkage", {"closures", i, "second"}, "another link than its first", each.second);
        if (const Result bad = check_place({"closures", i, "first_at"}, each.first_at); !bad) return bad;
        if (const Result bad = check_place({"closures", i, "second_at"}, each.second_at); !bad) return bad;
    }
    return {};
}

}  // namespace tendril::ik
