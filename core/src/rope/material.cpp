// Changes of a body's material.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "math/checks.hpp"
#include "rope/rest_grid.hpp"
#include "rope/slots.hpp"
#include "tendril/rope/world.hpp"

namespace tendril::rope {
namespace {

using detail::missing;
using tendril::detail::check_length;
using tendril::detail::refused;

}  // namespace

Result World::set_radius(BodyId body, float metres) noexcept {
    Body* const changed = found(body);
    if (changed == nullptr) return missing("set_radius", "body", body, state_);
    const Result result = check_length("set_radius", "metres", metres);
    if (result) changed->radius = metres;
    return result;
}

Result World::set_friction(BodyId body, std::optional<float> friction) noexcept {
    Body* const changed = found(body);
    if (changed == nullptr) return missing("set_friction", "body", body, state_);
    if (friction && !(*friction >= 0.0f && static_cast<double>(*friction) <= max_friction))
        return refused("set_friction", "friction", "0 to 100", *friction);
    changed->friction = friction;
    return {};
}

Result World::set_tear(BodyId body, float tear) noexcept {
    Body* const changed = found(body);
    if (changed == nullptr) return missing("set_tear", "body", body, state_);
    const Result result = check_length("set_tear", "tear", tear);
    if (result) changed->tear = tear;
    return result;
}

Result World::set_bending(BodyId rope, float stiffness) noexcept {
    Body* const changed = found(rope);
    if (changed == nullptr) return missing("set_bending", "rope", rope, state_);
    if (changed->kind != Body::Kind::Rope)
        return {ErrorCode::InvalidArgument, "cloth and hair bend by links: set_compliance"};
    const Result result = check_length("set_bending", "stiffness", stiffness);
    if (result) changed->bending = stiffness;
    return result;
}

double World::mass(const Body& body) const noexcept {
    double sum = 0.0;
    for (std::size_t i = body.first; i < body.first + body.count; ++i) sum += state_.mass[i];
    return sum;
}

Result World::set_mass(BodyId body, double kilograms) noexcept {
    const Body* const changed = find(body);
    if (changed == nullptr) return missing("set_mass", "body", body, state_);
    if (!(kilograms > 0.0 && kilograms <= 1e18))
        return refused("set_mass", "kilograms", "over 0 and at most 1e18", kilograms);
    scale_mass(*changed, kilograms / mass(*changed));
    return {};
}

double World::density(const Body& body) const {
    const detail::RestGrid grid = detail::rest_grid(state_, body);
    const double filled = static_cast<double>(body.count) / static_cast<double>(body.row * body.rows());
    double extent = filled * grid.length() * grid.width() * std::sqrt(1.0 - grid.cosine * grid.cosine);
    if (body.kind != Body::Kind::Cloth) extent = grid.length() * static_cast<double>(body.count / body.row);
    return extent > 0.0 ? mass(body) / extent : 0.0;
}

Result World::set_density(BodyId body, double density) {
    const Body* const changed = find(body);
    if (changed == nullptr) return missing("set_density", "body", body, state_);
    if (!(density >= static_cast<double>(min_density) && density <= static_cast<double>(max_magnitude)))
        return refused("set_density", "density", "1e-9 to 1e9", density);
    const double now = this->density(*changed);
    if (!(now > 0.0)) return refused("set_density", "body", "longer than 0", now);
    scale_mass(*changed, density / now);
    return {};
}

void World::scale_mass(const Body& body, double factor) noexcept {
    for (std::size_t i = body.first; i < body.first + body.count; ++i)
        state_.mass[i] = std::clamp(factor * state_.mass[i], 1e-30, 1e30);
}

/// Scales a rope's own mass, given particles `along` it; its lightest part is assumed to carry no weight.
void World::lengthen_mass(const Body& rope, std::span<const double> along, double ratio) noexcept {
    const auto half_links = [&](std::size_t i) {
        return 0.5 * (along[std::min(i + 1, rope.count - 1)] - along[i > 0 ? i - 1 : 0]);
    };
    double density = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rope.count; ++i)
        if (half_links(i) > 0.0) density = std::min(density, state_.mass[rope.first + i] / half_links(i));
    for (std::size_t i = 0; i < rope.count; ++i) {
        double& mass = state_.mass[rope.first + i];
        mass = std::clamp(mass + (ratio - 1.0) * density * half_links(i), 1e-30, 1e30);
    }
}

double World::compliance(const Body& body, Link::Kind kind) const {
    const auto link = std::find_if(state_.links.begin(), state_.links.end(), [&](const Link& each) {
        return each.kind == kind && detail::owns(body, each);
    });
    if (link == state_.links.end()) return 0.0;
    if (kind != Link::Kind::Stretch || link->compliance == 0.0f) return link->compliance;
    const double per = detail::unit_link_compliance(body, detail::rest_grid(state_, body), *link);
    return per > 0.0 ? link->compliance / per : 0.0;
}

Result World::set_compliance(BodyId body, Link::Kind kind, double compliance) {
    const Body* const changed = find(body);
    if (changed == nullptr) return missing("set_compliance", "body", body, state_);
    if (!(compliance >= 0.0 && compliance <= static_cast<double>(max_magnitude)))
        return refused("set_compliance", "compliance", "0 to 1e9", compliance);
    const detail::RestGrid grid = detail::rest_grid(state_, *changed);
    for (Link& link : state_.links) {
        if (link.kind != kind || !detail::owns(*changed, link)) continue;
        const double per =
            kind == Link::Kind::Stretch ? detail::unit_link_compliance(*changed, grid, link) : 1.0;
        link.compliance = static_cast<float>(std::min(per * compliance, static_cast<double>(max_magnitude)));
    }
    return {};
}

double World::width(const Body& body) const {
    return body.kind == Body::Kind::Cloth ? detail::rest_grid(state_, body).width() : 0.0;
}

Result World::set_length(BodyId body, float metres) {
    return scale(body, "set_length", metres, true);
}

Result World::set_width(BodyId cloth, float metres) {
    const Body* const changed = find(cloth);
    if (changed != nullptr && changed->kind != Body::Kind::Cloth)
        return {ErrorCode::InvalidArgument, "only cloth has a width"};
    return scale(cloth, "set_width", metres, false);
}

/// Scales a body along its rows, or across them.
Result World::scale(BodyId body, const char* operation, float metres, bool rows) {
    Body* const changed = found(body);
    if (changed == nullptr) return missing(operation, "body", body, state_);
    if (const Result bad = check_length(operation, "metres", metres); !bad) return bad;
    const detail::RestGrid was = detail::rest_grid(state_, *changed);
    const double now = rows ? was.length() : was.width();
    if (!(now > 0.0)) return refused(operation, "body", "longer than 0", now);
    const double ratio = metres / now;
    detail::RestGrid grid = was;
    for (double& each : rows ? grid.along : grid.down) each *= ratio;
    // Diagonals follow both sides; links along one side keep their own proportion.
    const auto new_rest = [&](const Link& link) -> double {
        const detail::LinkStep step = detail::link_step(*changed, link);
        const bool diagonal = step.columns != 0 && step.rows != 0 && changed->kind == Body::Kind::Cloth;
        if (!diagonal)
            return (rows == (step.rows == 0) || changed->kind != Body::Kind::Cloth ? ratio : 1.0) * link.rest;
        const auto to = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(step.column) + step.columns);
        return detail::length(grid.at(to, step.row + static_cast<std::size_t>(step.rows)) -
                              grid.at(step.column, step.row));
    };
    for (const Link& link : state_.links) {
        if (detail::owns(*changed, link) && !(new_rest(link) <= static_cast<double>(max_magnitude)))
            return refused(operation, "metres", "such that no link is longer than 1e9 m", metres);
    }
    for (Link& link : state_.links) {
        if (!detail::owns(*changed, link)) continue;
        const double material =
            link.compliance > 0.0f && link.kind == Link::Kind::Stretch
                ? link.compliance / std::max(detail::unit_link_compliance(*changed, was, link), 1e-30)
                : -1.0;
        link.rest = static_cast<float>(new_rest(link));
        if (material < 0.0) continue;
        const double soft = material * detail::unit_link_compliance(*changed, grid, link);
        link.compliance = static_cast<float>(std::min(soft, static_cast<double>(max_magnitude)));
    }
    if (rows && changed->kind == Body::Kind::Rope)
        lengthen_mass(*changed, was.along, ratio);
    else
        scale_mass(*changed, ratio);
    take_stretch(*changed);
    return {};
}

}  // namespace tendril::rope
