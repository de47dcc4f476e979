#include "rope/build.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/checks.hpp"
#include "rope/geometry.hpp"
#include "rope/hang.hpp"
#include "rope/slots.hpp"

namespace tendril::rope::detail {
namespace {

using tendril::detail::Argument;
using tendril::detail::check_point;
using tendril::detail::refused;

/// Whether `more` particles fit.
Result check_fit(const char* operation, const State& state, std::size_t more) {
    if (more <= max_particles && state.position.size() + more <= max_particles) return {};
    return refused(operation, "particles", "at most 1000000 in all", state.position.size() + more);
}

}  // namespace

void Draft::pin(std::size_t particle) {
    pins.push_back({.particle = particle, .goal = points[particle], .seconds = 0.0, .collider = {}});
}
void Draft::link(std::uint32_t a, std::uint32_t b, double rest, Link::Kind kind, float compliance) {
    links.push_back(
        {.a = a, .b = b, .rest = static_cast<float>(rest), .kind = kind, .compliance = compliance});
}
void Draft::link(std::uint32_t a, std::uint32_t b, Link::Kind kind, float compliance) {
    link(a, b, length(points[b] - points[a]), kind, compliance);
}

dvec3 acceleration(const Settings& settings) noexcept {
    return static_cast<double>(settings.gravity_scale) * dvec3(settings.gravity) + dvec3(settings.external);
}

double enforced_length(const Tie& tie, double h) noexcept {
    const double length = tie.length, max_change = static_cast<double>(tie_speed) * h;
    return std::clamp(length, tie.now - max_change, tie.now + max_change);
}

double elastic_energy(const Link& link, double compliance, double tension, const dvec3& now,
                      const dvec3& by) noexcept {
    if (link.kind != Link::Kind::Stretch) return 0.5 * compliance * tension * tension;
    const double longer = length(now) - link.rest, halfway = 0.5 * (longer + length(now - by) - link.rest);
    if (!(longer * tension > 0.0)) return 0.0;
    const double stiffness = std::min(tension / longer, 1.0 / compliance);
    return 0.5 * stiffness * halfway * halfway;
}

ChainBend bend_between(const State& state, const Body& body, const Link& before, const Link& after) noexcept {
    constexpr double min_length = 1e-6;     // shorter links bend as if this long
    constexpr double max_stiffness = 1e12;  // between a particle and its neighbours, relative to its mass
    const double square = state.settings.substep * state.settings.substep;
    const double length = std::max(static_cast<double>(before.rest), min_length),
                 next = std::max(static_cast<double>(after.rest), min_length);
    ChainBend bend;
    bend.before = 1.0 / length, bend.after = 1.0 / next;
    const double both = bend.before + bend.after;
    bend.stiffness = std::min(2.0 * static_cast<double>(body.bending) * square / (length + next),
                              max_stiffness * state.mass[after.a] / (both * both));
    return bend;
}

dvec3 down(const Settings& settings) noexcept {
    const dvec3 gravity = static_cast<double>(settings.gravity_scale) * dvec3(settings.gravity);
    return length(gravity) > 1e-12 ? unit(gravity) : dvec3(0.0, -1.0, 0.0);
}

Expected<BodyId> append(State& state, const char* operation, Draft draft) {
    constexpr double edge = max_magnitude;
    for (const dvec3& p : draft.points) {
        const double farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        if (!(farthest <= edge))
            return refused(operation, "every coordinate of its particles", "at most 1e9 m", farthest);
    }
    for (const Link& link : draft.links) {
        if (link.rest > max_magnitude)
            return refused(operation, "the length of its links", "at most 1e9 m", link.rest);
    }
    const std::size_t first = state.position.size(), count = draft.points.size();
    for (auto* const list : {&state.position, &state.displacement}) reserve_more(*list, count);
    reserve_more(state.mass, count);
    reserve_more(state.links, draft.links.size());
    reserve_more(state.pins, draft.pins.size());
    const BodyId id = draft.body.id = take_slot(state.body_slots, state.bodies);
    state.position.insert(state.position.end(), draft.points.begin(), draft.points.end());
    state.displacement.resize(first + count, dvec3(0.0));
    state.mass.resize(first + count, draft.mass);
    for (std::size_t row = first; draft.body.kind != Body::Kind::Cloth && row < first + count;
         row += draft.body.row)
        for (const std::size_t end : {row, row + draft.body.row - 1}) state.mass[end] *= 0.5;  // half a link
    for (Link& link : draft.links) {
        link.a += static_cast<std::uint32_t>(first);
        link.b += static_cast<std::uint32_t>(first);
    }
    state.links.insert(state.links.end(), draft.links.begin(), draft.links.end());
    for (Pin& pin : draft.pins) pin.particle += first;
    state.pins.insert(state.pins.end(), draft.pins.begin(), draft.pins.end());
    draft.body.first = first;
    draft.body.count = count;
    state.bodies.push_back(std::move(draft.body));
    return id;
}

Result draft_rope(const State& state, const RopeShape& shape, Draft& draft) {
    const char* const op = "add_rope";
    if (const Result bad = check_fields(op, shape); !bad) return bad;
    const auto segments = static_cast<std::size_t>(shape.segments);
    if (const Result full = check_fit(op, state, segments + 1); !full) return full;

    const dvec3 from(shape.from), to(shape.to);
    const double whole = shape.length ? *shape.length : length(to - from);
    const double each = whole / static_cast<double>(segments);
    draft.points = hang(from, to, whole, segments, down(state.settings));
    draft.mass = std::max(static_cast<double>(shape.density) * each, 1e-9);
    for (std::uint32_t i = 0; i < segments; ++i) draft.link(i, i + 1, each, Link::Kind::Stretch, 0.0f);
    draft.body.kind = Body::Kind::Rope;
    draft.body.row = segments + 1;
    draft.body.radius = shape.radius;
    draft.body.bending = shape.bending;
    if (shape.pin_start) draft.pin(0);
    if (shape.pin_end) draft.pin(segments);
    return {};
}

Result draft_cloth(const State& state, const ClothShape& shape, Draft& draft) {
    const char* const op = "add_cloth";
    if (const Result bad = check_fields(op, shape); !bad) return bad;
    const auto columns = static_cast<std::uint32_t>(shape.columns),
               rows = static_cast<std::uint32_t>(shape.rows);
    const std::size_t count = static_cast<std::size_t>(columns) * rows;
    if (const Result full = check_fit(op, state, count); !full) return full;

    draft.points.reserve(count);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            draft.points.push_back(dvec3(shape.corner) +
                                   (static_cast<double>(c) / (columns - 1)) * dvec3(shape.along) +
                                   (static_cast<double>(r) / (rows - 1)) * dvec3(shape.down));
    const double area = length(cross(dvec3(shape.along), dvec3(shape.down)));
    draft.mass = std::max(static_cast<double>(shape.density) * area / static_cast<double>(count), 1e-9);
    each_link(Body::Kind::Cloth, columns, rows, [&](std::uint32_t a, std::uint32_t b, Link::Kind kind) {
        const bool soft = kind != Link::Kind::Stretch;
        draft.link(a, b, kind, !soft ? 0.0f : kind == Link::Kind::Shear ? shape.shear : shape.bend);
    });
    draft.body.kind = Body::Kind::Cloth;
    draft.body.row = columns;
    draft.body.radius = shape.radius;
    draft.body.tear = shape.tear;
    for (std::uint32_t c = 0; c < columns; ++c) {
        const bool corner = c == 0 || c + 1 == columns;
        const bool held =
            shape.pins == ClothShape::Pins::Row || (shape.pins == ClothShape::Pins::Corners && corner);
        if (held) draft.pin(c);
    }
    return {};
}

static Result check_roots(const char* operation, const HairShape& shape) {
    if (shape.roots.empty()) return refused(operation, "roots", "at least 1", std::size_t{0});
    for (std::size_t i = 0; i < shape.roots.size(); ++i) {
        const HairRoot& root = shape.roots[i];
        const Result point = check_point(operation, Argument("roots", i, "position"), root.position);
        if (!point) return point;
        const Result direction = check_point(operation, Argument("roots", i, "direction"), root.direction);
        if (!direction) return direction;
        if (!(length(dvec3(root.direction)) > 1e-12))
            return refused(operation, Argument("roots", i, "direction"), "longer than 0", "0");
    }
    return {};
}

Result draft_hair(const State& state, const HairShape& shape, Draft& draft) {
    const char* const op = "add_hair";
    if (const Result bad = check_fields(op, shape); !bad) return bad;
    if (const Result bad = check_roots(op, shape); !bad) return bad;
    const auto segments = static_cast<std::uint32_t>(shape.segments);
    const std::size_t row = static_cast<std::size_t>(segments) + 1;
    const std::size_t count = row * std::min(shape.roots.size(), max_particles);
    if (const Result full = check_fit(op, state, count); !full) return full;
    const Collider* holder = find_in(state.colliders, shape.attach);
    if (shape.attach && holder == nullptr) return missing(op, "attach", shape.attach, state);

    const double each = static_cast<double>(shape.length) / segments;
    draft.points.reserve(count);
    for (const HairRoot& root : shape.roots)
        for (std::uint32_t i = 0; i <= segments; ++i)
            draft.points.push_back(dvec3(root.position) + (each * i) * unit(dvec3(root.direction)));
    draft.mass = std::max(shape.density * each, 1e-9);
    const auto strands = static_cast<std::uint32_t>(shape.roots.size());
    each_link(Body::Kind::Hair, segments + 1, strands,
              [&](std::uint32_t a, std::uint32_t b, Link::Kind kind) {
                  if (kind == Link::Kind::Stretch)
                      draft.link(a, b, each, kind, 0.0f);
                  else
                      draft.link(a, b, kind, shape.bend);
              });
    draft.body.kind = Body::Kind::Hair;
    draft.body.row = row;
    draft.body.radius = shape.radius;
    // Both ends of a strand's first link are pinned, so that it keeps its direction.
    for (std::size_t at = 0; at < count; at += row) {
        for (const std::size_t particle : {at, at + 1}) {
            draft.pin(particle);
            if (holder == nullptr) continue;
            draft.pins.back().collider = holder->id;
            draft.pins.back().goal -= dvec3(centre(holder->shape));
        }
    }
    return {};
}

}  // namespace tendril::rope::detail
