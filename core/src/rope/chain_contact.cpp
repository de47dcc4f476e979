// The contacts of a chain: the planes that hold each particle, and the drag of friction.
#include <algorithm>
#include <cmath>

#include "rope/build.hpp"
#include "rope/chain_newton.hpp"
#include "rope/contact_shape.hpp"
#include "rope/geometry.hpp"

namespace tendril::rope {
namespace {

using detail::dot;
using glm::dvec3;

constexpr double allowed_depth = 1e-7;               ///< metres inside that are harmless
constexpr double penetration_tolerance = 1e-6;       ///< metres inside that require another step
constexpr double late_penetration_tolerance = 1e-5;  ///< the same after many steps
/// Normals follow features for this many steps: they could circle a collider thinner than a link is long.
constexpr int following_steps = 5;
constexpr double unmeasured = 1e30;  ///< metres; not yet measured
/// Slip per substep of a particle that friction holds, metres.
constexpr double min_slip = 1e-7;
/// Part of the limit by which friction may miss it while a particle slips by more than ten times that.
constexpr double friction_tolerance = 0.05;

dvec3 tangential(const dvec3& v, const dvec3& normal) {
    return v - dot(v, normal) * normal;
}

}  // namespace

bool ChainNewton::rests() const {
    return s_.progress.steps_taken > following_steps && !s_.link_contacts.empty();
}

/// The colliders near the chunk of particle `i`; the search for the chunk starts at `chunk`.
std::span<const IslandScratch::Near> ChainNewton::near_of(std::uint32_t i, std::uint32_t& chunk) const {
    while (plan_.chunks[chunk].first > i) --chunk;
    while (i - plan_.chunks[chunk].first >= plan_.chunks[chunk].count) ++chunk;
    const auto before = [](const IslandScratch::Near& near, std::uint32_t c) { return near.chunk < c; };
    const auto after = [](std::uint32_t c, const IslandScratch::Near& near) { return c < near.chunk; };
    const auto first = std::lower_bound(local_.near.begin(), local_.near.end(), chunk, before);
    return {first, std::upper_bound(first, local_.near.end(), chunk, after)};
}

ContactScratch::Contact& ChainNewton::contact_of(std::uint32_t node) {
    if (s_.contacts.empty() || s_.contacts.back().node != node)
        s_.contacts.push_back({node, static_cast<std::uint32_t>(s_.planes.size()), 0});
    return s_.contacts.back();
}

void ChainNewton::open(std::uint32_t chain) {
    chain_ = chain;
    radius_ = state_.bodies[plan_.chains[chain].body].radius;
}

bool ChainNewton::find(std::uint32_t number) {
    open(number);
    s_.contacts.clear();
    s_.planes.clear();
    s_.link_contacts.clear();
    s_.link_colliders.clear();
    if (local_.near.empty()) return false;
    const Plan::Chain& chain = plan_.chains[number];
    std::uint32_t chunk = island_.chunks.first, searched = chunk + island_.chunks.count;
    std::span<const IslandScratch::Near> near;
    bool link_before = false;
    for (std::uint32_t k = 0; k <= chain.links; ++k) {
        const std::uint32_t i = particle(k);
        if (searched != chunk || i - plan_.chunks[chunk].first >= plan_.chunks[chunk].count) {
            near = near_of(i, chunk);
            searched = chunk;
        }
        if (link_before) contact_of(k);  // for the friction of the link
        link_before = false;
        const dvec3 from = state_.position[i], to = scratch_.base[i];
        const double reach = radius_ + path_margin + detail::length(to - from);
        local_.done.work += near.size();
        for (const IslandScratch::Near& each : near) {
            if (scratch_.weight[i] == 0.0 || collider(each.collider).far_from(to, reach)) continue;
            ++contact_of(k).count;
            s_.planes.emplace_back().collider = each.collider;
        }
        if (k == chain.links || plan_.chunks[chunk].reach <= 0.0f) continue;
        const Link& link = state_.links[chain.first_link + k];
        for (const IslandScratch::Near& each : near) {
            const Scratch::Moving& moving = collider(each.collider);
            if (link.rest <= moving.size) continue;
            const std::uint32_t j = particle(k + 1);
            const dvec3 path = scratch_.base[j] - state_.position[j], along = state_.position[j] - from;
            const double far =
                radius_ + path_margin + 0.5 * detail::length(along) + detail::length(path) + reach;
            if (moving.far_from(from + 0.5 * along, far)) continue;
            if (!link_before) {
                contact_of(k);
                s_.link_contacts.push_back({k, static_cast<std::uint32_t>(s_.link_colliders.size())});
            }
            ++s_.link_contacts.back().count;
            s_.link_colliders.push_back(each.collider);
            link_before = true;
        }
    }
    return !s_.contacts.empty();
}

/// A link at the start of the substep, relative to a collider that has moved since.
Scratch::Moving::Segment ChainNewton::start_of(std::uint32_t bond, const Scratch::Moving& moving) const {
    const dvec3 a = state_.position[particle(bond)], b = state_.position[particle(bond + 1)];
    return {a + moving.move_at(a), b + moving.move_at(b)};
}

/// Whether a link touches, or very nearly does, on its way to a position.
bool ChainNewton::link_touches(const ContactScratch::LinkContact& contact,
                               const std::vector<dvec3>& to) const {
    const Scratch::Moving::Segment end{to[particle(contact.bond)], to[particle(contact.bond + 1)]};
    const double near = radius_ + touch_distance;
    for (std::uint32_t c = contact.first; c < contact.first + contact.count; ++c) {
        const Scratch::Moving& moving = collider(s_.link_colliders[c]);
        std::uint64_t& work = local_.done.work;
        if (moving.first_touch(start_of(contact.bond, moving), end, radius_, work)) return true;
        const auto at = moving.nearest(end, near, work);
        if (at && at->surface.distance < near) return true;
    }
    return false;
}

bool ChainNewton::touches() const {
    for (const ContactScratch::Contact& contact : s_.contacts) {
        const std::uint32_t i = particle(contact.node);
        const dvec3 start = state_.position[i], base = scratch_.base[i];
        for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p) {
            const Scratch::Moving& moving = collider(s_.planes[p].collider);
            const dvec3 from = start + moving.move_at(start);
            const double near = radius_ + touch_distance, far = detail::length(base - from);
            ++local_.done.work;
            const double distance = surface_distance(*moving.shape, base).distance;
            if (distance < near || far > 0.5 * moving.size + radius_) return true;
            if (surface_distance(*moving.shape, from).distance < near) return true;
        }
    }
    return std::ranges::any_of(s_.link_contacts, [&](const ContactScratch::LinkContact& contact) {
        return link_touches(contact, state_.position) || link_touches(contact, scratch_.base);
    });
}

bool ChainNewton::inside() const {
    for (const ContactScratch::Contact& contact : s_.contacts) {
        const dvec3& x = scratch_.x[particle(contact.node)];
        for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p) {
            const Scratch::Moving& moving = collider(s_.planes[p].collider);
            ++local_.done.work;
            if (moving.far_from(x, radius_)) continue;
            if (surface_distance(*moving.shape, x).distance < radius_ - allowed_depth) return true;
        }
    }
    return std::ranges::any_of(s_.link_contacts, [&](const ContactScratch::LinkContact& contact) {
        return link_touches(contact, scratch_.x);
    });
}

/// If a particle's free path would pass through a surface, stops it on the side that it came from.
void ChainNewton::begin_plane(ContactScratch::Contact& contact, ContactScratch::Plane& plane) {
    const std::uint32_t i = particle(contact.node);
    const Scratch::Moving& moving = collider(plane.collider);
    plane.by = moving.move_at(state_.position[i]);
    const dvec3 from = state_.position[i] + plane.by, base = scratch_.base[i];  // relative to the collider
    Scratch::Moving::At at{0.0, from, surface_distance(*moving.shape, from)};
    plane.active = at.surface.distance < radius_ + touch_distance;
    if (!plane.active) {
        const auto touch = moving.first_touch({from, from}, {base, base}, radius_, local_.done.work);
        if (touch) at = *touch, plane.active = true;
    }
    plane.normal = at.surface.normal;
    plane.point = at.point - (at.surface.distance - radius_) * at.surface.normal;
}

/// Whether anything changed that requires another step.
bool ChainNewton::update_contacts() {
    bool changed = false;
    for (const ContactScratch::Contact& contact : s_.contacts) measure_planes(contact);
    if (!s_.bends.empty()) choose_deepest();
    for (ContactScratch::Contact& contact : s_.contacts) changed |= update_planes(contact);
    for (ContactScratch::LinkContact& contact : s_.link_contacts) changed |= update_link(contact);
    s_.progress.excess = 0.0;
    for (const bool sums : {true, false}) {
        if (sums && !s_.progress.moved) continue;  // no drag yet
        for (ContactScratch::Contact& contact : s_.contacts) changed |= apply_friction(contact, sums);
        for (ContactScratch::LinkContact& contact : s_.link_contacts)
            for (std::size_t i = 0; i < contact.touches.size(); ++i)
                changed |=
                    apply_link_friction(contact.bond, contact.touches[i], effects_of(contact)[i], sums);
    }
    return changed;
}

void ChainNewton::measure_planes(const ContactScratch::Contact& contact) {
    const detail::ChainNode& node = s_.nodes[contact.node];
    for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p) {
        ContactScratch::Plane& plane = s_.planes[p];
        const Scratch::Moving& moving = collider(plane.collider);
        ++local_.done.work;
        plane.gap = unmeasured;
        const dvec3 start = state_.position[particle(contact.node)], way = node.x - start - plane.by;
        const double thick = 0.5 * moving.size + radius_;
        const bool fast = !plane.active && std::abs(way.x) + std::abs(way.y) + std::abs(way.z) > thick;
        if (s_.progress.moved && !plane.active && !fast && moving.far_from(node.x, radius_)) continue;
        plane.gap = dot(plane.normal, node.x - plane.point);
        // A particle far behind a plane that it touched has passed through: the nearest surface is now
        // another one. If it never touched the plane, it may have gone round.
        if (!s_.progress.moved || (plane.active && (rests() || plane.gap <= -thick))) continue;
        dvec3 at = node.x;
        const SurfaceDistance surface =
            fast ? moving.sweep(start, at, radius_, local_.done.work) : surface_distance(*moving.shape, at);
        plane.normal = surface.normal;
        plane.gap = dot(surface.normal, node.x - at) + surface.distance - radius_;
        plane.point = node.x - plane.gap * surface.normal;
    }
}

/// Where bending moves the nodes of new contacts together, a step keeps only the deepest of them: a stiff
/// rope bent round a ball in one step would be flung off in the next.
void ChainNewton::choose_deepest() {
    ContactScratch::Contact* kept = nullptr;
    double deepest = 0.0;
    for (ContactScratch::Contact& contact : s_.contacts) {
        contact.deferred = false;
        double gap = -allowed_depth;
        for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p)
            if (!s_.planes[p].active) gap = std::min(gap, s_.planes[p].gap);
        if (gap == -allowed_depth) continue;
        // The number of links that bending reaches in a substep is the fourth root of its stiffness.
        const double stiff = s_.bends[contact.node].own / s_.nodes[contact.node].mass;
        if (kept != nullptr && contact.node - kept->node < std::sqrt(std::sqrt(stiff))) {
            (gap < deepest ? kept : &contact)->deferred = true;
            if (gap >= deepest) continue;
        }
        kept = &contact;
        deepest = gap;
    }
}

bool ChainNewton::update_planes(ContactScratch::Contact& contact) {
    const detail::ChainNode& node = s_.nodes[contact.node];
    detail::NodeContact& effect = s_.node_effects[static_cast<std::size_t>(node.contact)];
    bool changed = false;
    effect.planes = 0;
    for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p) {
        ContactScratch::Plane& plane = s_.planes[p];
        const bool was = plane.active;
        if (plane.gap < -allowed_depth) {
            plane.active = was || !contact.deferred;
            changed |=
                plane.gap < (s_.progress.may_release ? -penetration_tolerance : -late_penetration_tolerance);
        } else if (was && s_.progress.may_release) {
            // The force that the contact has to bear: the imbalance without it.
            plane.active = dot(node.force, plane.normal) + node.mass * plane.gap <= 0.0;
        }
        changed |= s_.progress.may_release && plane.active != was;
        if (!plane.active) continue;
        // Sorted by depth, deepest first.
        constexpr int max_planes = detail::NodeContact::max_planes;
        if (effect.planes == max_planes && plane.gap >= effect.gap[max_planes - 1]) continue;
        int at = std::min(effect.planes, max_planes - 1);
        for (; at > 0 && effect.gap[at - 1] > plane.gap; --at)
            effect.normal[at] = effect.normal[at - 1], effect.gap[at] = effect.gap[at - 1];
        effect.normal[at] = plane.normal;
        effect.gap[at] = plane.gap;
        effect.planes = std::min(effect.planes + 1, max_planes);
    }
    return changed;
}

/// Sets the drag on slip that gives the limiting friction; first only sums by how much the last drag missed
/// it. If that is too much in all, everything slips as much farther as moves the whole chain. Returns whether
/// friction requires another step.
bool ChainNewton::set_drag(double& drag, double limit, double slip, bool sums) {
    const double excess = drag > 0.0 ? drag * slip - limit : 0.0;
    if (sums) {
        s_.progress.excess += excess;
        return false;
    }
    const double missed = slip > 10.0 * min_slip ? std::abs(excess) : excess;
    drag = limit / std::max(slip + std::max(0.0, s_.progress.excess) / s_.progress.mass, min_slip);
    return s_.progress.may_release && missed > friction_tolerance * limit;
}

/// Friction of a particle.
bool ChainNewton::apply_friction(ContactScratch::Contact& contact, bool sums) {
    const detail::ChainNode& node = s_.nodes[contact.node];
    detail::NodeContact& effect = s_.node_effects[static_cast<std::size_t>(node.contact)];
    const double friction = detail::friction(state_, state_.bodies[plan_.chains[chain_].body]);
    effect.drag = 0.0;
    if (effect.planes == 0 || friction == 0.0) {
        contact.drag = 0.0;
        return false;
    }
    dvec3 by(0.0);
    for (std::uint32_t p = contact.first; p < contact.first + contact.count; ++p)
        if (s_.planes[p].active && s_.planes[p].normal == effect.normal[0]) by = s_.planes[p].by;
    dvec3 force = node.force, slip = node.x - state_.position[particle(contact.node)] - by;
    double normal = 0.0;
    for (int p = 0; p < effect.planes; ++p) {
        normal += std::max(0.0, -dot(force, effect.normal[p]) - node.mass * effect.gap[p]);
        force = tangential(force, effect.normal[p]);
        slip = tangential(slip, effect.normal[p]);
    }
    double slip_distance = detail::length(slip);
    if (!s_.progress.moved) {  // the larger of its previous slip and its free slip
        const double before = detail::length(state_.displacement[particle(contact.node)] - by);
        const double alone = detail::length(slip + (1.0 / node.mass) * force) - friction * normal / node.mass;
        slip_distance = std::max(before, alone);
    }
    const bool changed = set_drag(contact.drag, friction * normal, slip_distance, sums);
    effect.slip = slip;
    effect.drag = contact.drag;
    return changed;
}

/// Whether a contact at a position on a link is one of the end next to it, which touches as well. If a stiff
/// rope had both, tiny differences of their gaps would make their forces many times its weight.
bool ChainNewton::holds_end(const ContactScratch::LinkContact& contact, std::uint32_t collider,
                            double at) const {
    const double apart = std::min(at, 1.0 - at) * s_.bonds[contact.bond].rest;
    if (apart * apart > 4.0 * thickness(collider) * touch_distance)
        return false;  // the end of a straight link is clear
    const detail::ChainNode& node = s_.nodes[contact.bond + (at < 0.5 ? 0 : 1)];
    const ContactScratch::Contact& end = s_.contacts[static_cast<std::size_t>(node.contact)];
    const auto first = s_.planes.begin() + end.first;
    return std::any_of(first, first + end.count, [&](const ContactScratch::Plane& plane) {
        return plane.active && plane.collider == collider;
    });
}

/// Chooses the deepest touches of a link, each with another collider, and apart from each other. Touches that
/// rest stay.
bool ChainNewton::update_link(ContactScratch::LinkContact& contact) {
    using LinkTouch = ContactScratch::LinkContact::Touch;
    const detail::ChainBond& bond = s_.bonds[contact.bond];
    const dvec3 a = s_.nodes[contact.bond].x, b = s_.nodes[contact.bond + 1].x;
    const bool moved = s_.progress.moved, may_release = s_.progress.may_release;
    const double tolerance = may_release ? penetration_tolerance : late_penetration_tolerance;
    const std::span<detail::BondContact> effects = effects_of(contact);
    bool stay = rests(), changed = false;
    std::size_t held = 0;
    for (; held < effects.size() && effects[held].active; ++held) {
        detail::BondContact& effect = effects[held];
        effect.gap = dot(effect.normal, a + effect.at * (b - a) - contact.touches[held].point);
        if (effect.gap < -thickness(contact.touches[held].collider)) return true;  // it has passed through
        stay &= !may_release || effect.multiplier >= 0.0;
        changed |= effect.gap < -tolerance;
    }
    stay &= held > 0;
    if (stay && held == effects.size()) return changed;
    const auto earlier = contact.touches;
    std::array<detail::BondContact, detail::ChainBond::max_contacts> before;
    std::ranges::copy(effects, before.begin());
    std::array<double, detail::ChainBond::max_contacts> depths;
    depths.fill(-unmeasured);  // nothing takes the place of those that stay
    const std::size_t kept = stay ? held : 0;
    std::size_t count = kept;
    for (std::uint32_t c = contact.first; c < contact.first + contact.count; ++c) {
        const std::uint32_t number = s_.link_colliders[c];
        std::size_t was = 0;
        while (was < held && earlier[was].collider != number) ++was;
        if (was < kept) continue;
        const bool keeps = !moved || (was < held && (!may_release || before[was].multiplier >= 0.0));
        const Scratch::Moving& moving = collider(number);
        const Scratch::Moving::Segment now{a, b},
            start = start_of(contact.bond, moving),
            free{scratch_.base[particle(contact.bond)], scratch_.base[particle(contact.bond + 1)]};
        std::optional<Scratch::Moving::At> at =
            moving.first_touch(start, moved ? now : free, radius_, local_.done.work);
        const bool swept = at.has_value();
        if (!swept) at = moving.nearest(moved ? now : start, radius_ + touch_distance, local_.done.work);
        if (!at || holds_end(contact, number, at->along)) continue;
        const dvec3 normal = at->surface.normal;
        const double distance = at->surface.distance - radius_;
        const dvec3 point = at->point - distance * normal;
        const double gap = dot(normal, a + at->along * (b - a) - point);
        const double depth = moved ? gap : swept ? -1.0 : std::min(gap, distance);
        if (depth >= (keeps ? touch_distance : -allowed_depth)) continue;
        // Takes the place of a shallower one beside it, or of the shallowest.
        std::size_t to = kept;
        while (to < count && std::abs(effects[to].at - at->along) * bond.rest > radius_) ++to;
        if (to == count && count == effects.size())
            to = kept + static_cast<std::size_t>(std::max_element(depths.begin() + kept, depths.end()) -
                                                 (depths.begin() + kept));
        else if (to == count)
            depths[count++] = unmeasured;
        if (depths[to] <= depth) continue;
        depths[to] = depth;
        detail::BondContact& effect = effects[to] = {};
        effect.active = true;
        effect.normal = normal;
        effect.at = at->along;
        effect.gap = gap;
        contact.touches[to] = {number, point};
        if (was < held) {
            effect.multiplier = before[was].multiplier;
            contact.touches[to].drag = earlier[was].drag;
        } else if (!moved) {  // a rough estimate of the force that it has to bear
            const dvec3 force = s_.nodes[contact.bond].force + s_.nodes[contact.bond + 1].force;
            effect.multiplier = std::max(0.0, -dot(force, normal));
        }
    }
    for (std::size_t i = count; i < effects.size(); ++i) effects[i] = {}, contact.touches[i] = {};
    changed = may_release && count != held;
    for (std::size_t i = 0; i < count; ++i) {
        changed |= effects[i].gap < -tolerance;
        changed |=
            may_release && std::ranges::none_of(std::span(earlier).first(held), [&](const LinkTouch& touch) {
                return touch.collider == contact.touches[i].collider;
            });
    }
    return changed;
}

/// Friction of a link: its ends share the drag.
bool ChainNewton::apply_link_friction(std::uint32_t bond, ContactScratch::LinkContact::Touch& touch,
                                      const detail::BondContact& effect, bool sums) {
    const double friction = detail::friction(state_, state_.bodies[plan_.chains[chain_].body]);
    const bool holds =
        effect.active && effect.gap >= -thickness(touch.collider);  // it has not passed through
    const double normal = holds ? std::max(0.0, effect.multiplier) : 0.0;
    if (friction == 0.0 || normal == 0.0) {
        touch.drag = 0.0;
        return false;
    }
    const detail::ChainNode &a = s_.nodes[bond], &b = s_.nodes[bond + 1];
    const auto slip_of = [&](std::uint32_t node) {
        const dvec3 start = state_.position[particle(node)];
        const dvec3 by = collider(touch.collider).move_at(s_.nodes[node].x);
        return tangential(s_.nodes[node].x - start - by, effect.normal);
    };
    const dvec3 slip_a = slip_of(bond), slip_b = slip_of(bond + 1);
    const double t = effect.at;
    const dvec3 slip = (1.0 - t) * slip_a + t * slip_b;
    double slip_distance = detail::length(slip);
    if (!s_.progress.moved) {  // as for a particle
        const dvec3 before =
            (1.0 - t) * state_.displacement[particle(bond)] + t * state_.displacement[particle(bond + 1)];
        const dvec3 by = collider(touch.collider).move_at((1.0 - t) * a.x + t * b.x);
        const double to_a = a.pinned ? 0.0 : (1.0 - t) / a.mass, to_b = b.pinned ? 0.0 : t / b.mass;
        const dvec3 free = slip + tangential(to_a * a.force + to_b * b.force, effect.normal);
        const double braked = friction * normal * ((1.0 - t) * to_a + t * to_b);
        slip_distance =
            std::max(detail::length(tangential(before - by, effect.normal)), detail::length(free) - braked);
    }
    const bool changed = set_drag(touch.drag, friction * normal, slip_distance, sums);
    if (sums) return false;
    const auto share = [&](const detail::ChainNode& node, double part, const dvec3& its_slip) {
        detail::NodeContact& end = s_.node_effects[static_cast<std::size_t>(node.contact)];
        const double drag = part * touch.drag;
        end.drag += drag;  // with other contacts' shares
        if (end.drag > 0.0) end.slip += (drag / end.drag) * (its_slip - end.slip);
    };
    share(a, 1.0 - t, slip_a);
    share(b, t, slip_b);
    return changed;
}

}  // namespace tendril::rope
