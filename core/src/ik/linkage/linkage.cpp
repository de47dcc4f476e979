// Linkages as data: names, positions, and checks.
#include "tendril/ik/linkage.hpp"

#include <limits>

#include "ik/math.hpp"
#include "math/checks.hpp"
#include "tendril/elementary.hpp"

namespace tendril::ik {

using tendril::detail::index_of_name;
using tendril::detail::refused;

namespace {

constexpr const char* joint_names[] = {"hinge", "slider", "ball"};
constexpr const char* closure_names[] = {"point", "frame"};
constexpr const char* status_names[] = {"Reached", "TargetMissed",   "Limited",     "DeadPoint",
                                        "Open",    "IterationLimit", "InvalidInput"};

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr FieldRange any_place{-max_magnitude, max_magnitude};
/// Metres: max_links links of maximum length, end to end and back. Angles are far smaller.
constexpr double max_span = 2.0 * static_cast<double>(max_links) * static_cast<double>(max_magnitude);

}  // namespace

const char* name(LinkJoint joint) noexcept {
    return joint_names[static_cast<std::size_t>(joint)];
}

const char* name(LinkageStatus status) noexcept {
    return status_names[static_cast<std::size_t>(status)];
}

glm::dvec3 LinkPlace::point(const glm::dvec3& drawn) const noexcept {
    return detail::plus(detail::rotated(rotation, drawn), shift);
}

namespace {

Result check_range(const Link& link, std::size_t at) noexcept {
    if (link.joint == LinkJoint::Ball) {
        // By default a ball turns all the way; its rest and minimum have no effect.
        if (!((link.maximum >= 0.0 && link.maximum <= math::pi) || link.maximum == unbounded))
            return refused("linkage", {"links", at, "maximum"}, "0 to pi, or infinite", link.maximum);
        return {};
    }
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
    if (link.joint != LinkJoint::Ball && !(detail::length(link.axis) > 1e-9))
        return refused("linkage", {"links", at, "axis"}, "longer than 0", detail::length(link.axis));
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
    if (const Result bad = check_fields("linkage", linkage); !bad) return bad;
    for (std::size_t i = 0; i < linkage.links.size(); ++i) {
        if (const Result bad = check_one_link(linkage, i); !bad) return bad;
        const std::string& name = linkage.links[i].name;
        if (!name.empty() && *linkage.find_link(name) < i)
            return refused("linkage", {"links", i, "name"}, "a name that no earlier link has",
                           std::string_view(name));
    }
    for (std::size_t i = 0; i < linkage.closures.size(); ++i)
        if (const Closure& each = linkage.closures[i]; each.first == each.second)
            return refused("linkage", {"closures", i, "second"}, "a link other than its first", each.second);
    return {};
}

}  // namespace tendril::ik

namespace tendril {

template <>
std::span<const Field> fields<ik::Link>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&Link::name>("name"),
                                     index<&Link::parent>("parent", "links", true),
                                     field<&Link::joint>("joint", joint_names),
                                     field<&Link::at>("at", any_place, "m"),
                                     field<&Link::axis>("axis", any_place),
                                     field<&Link::rest>("rest", any_place),
                                     field<&Link::minimum>("minimum", {-unbounded, max_magnitude}),
                                     field<&Link::maximum>("maximum", {-max_magnitude, unbounded})};
    return rows;
}

template <>
std::span<const Field> fields<ik::LinkPoint>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&LinkPoint::name>("name"),
                                     index<&LinkPoint::link>("link", "links", true),
                                     field<&LinkPoint::at>("at", any_place, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Closure>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&Closure::name>("name"),
                                     field<&Closure::kind>("kind", closure_names),
                                     index<&Closure::first>("first", "links", true),
                                     index<&Closure::second>("second", "links", true),
                                     field<&Closure::first_at>("first_at", any_place, "m"),
                                     field<&Closure::second_at>("second_at", any_place, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::Linkage>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {list<&Linkage::links>("links").sparsely().up_to(max_links),
                                     list<&Linkage::points>("points").sparsely().up_to(max_links),
                                     list<&Linkage::closures>("closures").sparsely().up_to(max_links)};
    return rows;
}

template <>
std::span<const Field> fields<ik::JointPlace>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&JointPlace::value>("value", {-max_span, max_span}),
                                     field<&JointPlace::turn>("turn", unit_length),
                                     field<&JointPlace::last>("last", {-max_span, max_span})};
    return rows;
}

template <>
std::span<const Field> fields<ik::LinkageState>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {list<&LinkageState::joints>("joints").sparsely().up_to(max_links)};
    return rows;
}

template <>
std::span<const Field> fields<ik::LinkageReport>() noexcept {
    using namespace ik;
    constexpr FieldRange length{0, max_span};
    static constexpr Field rows[] = {field<&LinkageReport::status>("status", status_names),
                                     field<&LinkageReport::iterations>("iterations", {0, 1e6}),
                                     field<&LinkageReport::closed_to>("closed_to", length, "m"),
                                     field<&LinkageReport::residual>("residual", {0.0, unbounded}, "m"),
                                     field<&LinkageReport::driver_residual>("driver_residual", length),
                                     field<&LinkageReport::freedom>("freedom", {0, 1e6}),
                                     field<&LinkageReport::stopped>("stopped", {0, max_links}),
                                     field<&LinkageReport::stopped_at>("stopped_at", {-max_span, max_span}),
                                     field<&LinkageReport::passed_dead_point>("passed_dead_point"),
                                     field<&LinkageReport::jumped>("jumped", {0, max_links}),
                                     field<&LinkageReport::jump>("jump", length, "m")};
    return rows;
}

template <>
std::span<const Field> fields<ik::LinkageFreedom>() noexcept {
    using namespace ik;
    static constexpr Field rows[] = {field<&LinkageFreedom::counted>("counted", {-1e6, 1e6}),
                                     field<&LinkageFreedom::actual>("actual", {0, 1e6})};
    return rows;
}

}  // namespace tendril
