#include "rope/build.hpp"

#include <algorithm>
#include <string>

#include "chain/checks.hpp"
#include "rope/geometry.hpp"
#include "rope/hang.hpp"

namespace tendril::rope::detail {
namespace {

using tendril::detail::refuse;
using tendril::detail::require_length;
using tendril::detail::require_point;
using tendril::detail::text;

void require_count(const char* operation, const char* what, int count, int least) {
    if (count < least) refuse(operation, what, "at least " + std::to_string(least), std::to_string(count));
}
void require_positive(const char* operation, const char* what, float value) {
    if (!(value > 0.0f && value <= max_magnitude)) refuse(operation, what, "over 0 and finite", text(value));
}
void require_room(const char* operation, const State& state, std::size_t more) {
    if (more <= max_particles && state.position.size() + more <= max_particles) return;
    refuse(operation, "particles", "at most " + std::to_string(max_particles) + " in all",
           std::to_string(state.position.size() + more));
}

/// A body that is not yet in a state: its particles are numbered from 0.
struct Draft {
    Body body;
    std::vector<dvec3> points;
    double mass = 0.0;  ///< kg, of each particle
    std::vector<Link> links;
    std::vector<Pin> pins;

    void pin(std::size_t particle) {
        pins.push_back({.particle = particle, .goal = points[particle], .seconds = 0.0, .collider = {}});
    }
    void link(std::uint32_t a, std::uint32_t b, double rest, Link::Kind kind, float compliance) {
        links.push_back({.a = a,
                         .b = b,
                         .rest = static_cast<float>(rest),
                         .kind = kind,
                         .compliance = compliance});
    }
    /// As long as its particles are apart.
    void link(std::uint32_t a, std::uint32_t b, Link::Kind kind, float compliance) {
        link(a, b, length(points[b] - points[a]), kind, compliance);
    }
};

/// The new particles are at rest.
void append(State& state, const char* operation, Draft draft) {
    constexpr double edge = max_magnitude;
    for (const dvec3& p : draft.points) {
        if (std::abs(p.x) <= edge && std::abs(p.y) <= edge && std::abs(p.z) <= edge) continue;
        refuse(operation, "every particle", "at most 1e9 m from the origin each way", "one further out");
    }
    for (const Link& link : draft.links) {
        if (link.rest > max_magnitude)
            refuse(operation, "every link", "at most 1e9 m long", text(link.rest));
    }
    const std::size_t first = state.position.size(), count = draft.points.size();
    state.position.insert(state.position.end(), draft.points.begin(), draft.points.end());
    state.moved.resize(first + count, dvec3(0.0));
    state.before.resize(first + count, dvec3(0.0));
    state.mass.resize(first + count, draft.mass);
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
}

/// The links of a cloth.
class Grid {
  public:
    Grid(Draft& draft, std::uint32_t columns, std::uint32_t rows)
        : draft_(draft), columns_(columns), rows_(rows) {}

    void stretch() {
        for (std::uint32_t r = 0; r < rows_; ++r)
            for (std::uint32_t c = 0; c + 1 < columns_; ++c) link(c, r, c + 1, r, Link::Kind::Stretch, 0.0f);
        for (std::uint32_t c = 0; c < columns_; ++c)
            for (std::uint32_t r = 0; r + 1 < rows_; ++r) link(c, r, c, r + 1, Link::Kind::Stretch, 0.0f);
    }
    void shear(float compliance) {
        for (std::uint32_t r = 0; r + 1 < rows_; ++r)
            for (std::uint32_t c = 0; c + 1 < columns_; ++c) {
                link(c, r, c + 1, r + 1, Link::Kind::Shear, compliance);
                link(c + 1, r, c, r + 1, Link::Kind::Shear, compliance);
            }
    }
    void bend(float compliance) {
        for (std::uint32_t r = 0; r < rows_; ++r)
            for (std::uint32_t c = 0; c + 2 < columns_; ++c)
                link(c, r, c + 2, r, Link::Kind::Bend, compliance);
        for (std::uint32_t c = 0; c < columns_; ++c)
            for (std::uint32_t r = 0; r + 2 < rows_; ++r) link(c, r, c, r + 2, Link::Kind::Bend, compliance);
    }

  private:
    void link(std::uint32_t c, std::uint32_t r, std::uint32_t to_c, std::uint32_t to_r, Link::Kind kind,
              float compliance) {
        draft_.link(r * columns_ + c, to_r * columns_ + to_c, kind, compliance);
    }

    Draft& draft_;
    std::uint32_t columns_, rows_;
};

}  // namespace

dvec3 acceleration(const Settings& settings) noexcept {
    return static_cast<double>(settings.gravity_scale) * dvec3(settings.gravity) + dvec3(settings.external);
}

dvec3 down(const Settings& settings) noexcept {
    const dvec3 gravity = static_cast<double>(settings.gravity_scale) * dvec3(settings.gravity);
    return length(gravity) > 1e-12 ? unit(gravity) : dvec3(0.0, -1.0, 0.0);
}

void build(State& state, const RopeShape& shape, std::string name) {
    const char* const op = "add_rope";
    require_point(op, "from", shape.from);
    require_point(op, "to", shape.to);
    require_count(op, "segments", shape.segments, 1);
    if (shape.length) require_length(op, "length", *shape.length);
    require_length(op, "radius", shape.radius);
    require_positive(op, "density", shape.density);
    const auto segments = static_cast<std::size_t>(shape.segments);
    require_room(op, state, segments + 1);

    const dvec3 from(shape.from), to(shape.to);
    const double whole = shape.length ? *shape.length : length(to - from);
    const double each = whole / static_cast<double>(segments);
    const double mass = std::max(static_cast<double>(shape.density) * each, 1e-9);
    Draft draft;
    draft.points = hang(from, to, whole, segments, down(state.settings));
    draft.mass = mass;
    for (std::uint32_t i = 0; i < segments; ++i) draft.link(i, i + 1, each, Link::Kind::Stretch, 0.0f);
    draft.body.name = std::move(name);
    draft.body.kind = Body::Kind::Rope;
    draft.body.row = segments + 1;
    draft.body.radius = shape.radius;
    if (shape.pin_start) draft.pin(0);
    if (shape.pin_end) draft.pin(segments);
    append(state, op, std::move(draft));
}

void build(State& state, const SheetShape& shape, std::string name) {
    const char* const op = "add_sheet";
    require_point(op, "corner", shape.corner);
    require_point(op, "along", shape.along);
    require_point(op, "down", shape.down);
    require_count(op, "columns", shape.columns, 2);
    require_count(op, "rows", shape.rows, 2);
    require_length(op, "radius", shape.radius);
    require_positive(op, "density", shape.density);
    require_length(op, "shear", shape.shear);
    require_length(op, "bend", shape.bend);
    require_length(op, "tear", shape.tear);
    const auto columns = static_cast<std::uint32_t>(shape.columns),
               rows = static_cast<std::uint32_t>(shape.rows);
    const std::size_t count = static_cast<std::size_t>(columns) * rows;
    require_room(op, state, count);

    Draft draft;
    draft.points.reserve(count);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            draft.points.push_back(dvec3(shape.corner) +
                                   (static_cast<double>(c) / (columns - 1)) * dvec3(shape.along) +
                                   (static_cast<double>(r) / (rows - 1)) * dvec3(shape.down));
    const double area = length(cross(dvec3(shape.along), dvec3(shape.down)));
    draft.mass = std::max(static_cast<double>(shape.density) * area / static_cast<double>(count), 1e-9);
    Grid grid(draft, columns, rows);
    grid.stretch();
    grid.shear(shape.shear);
    grid.bend(shape.bend);
    draft.body.name = std::move(name);
    draft.body.kind = Body::Kind::Sheet;
    draft.body.row = columns;
    draft.body.radius = shape.radius;
    draft.body.tear = shape.tear;
    for (std::uint32_t c = 0; c < columns; ++c) {
        const bool corner = c == 0 || c + 1 == columns;
        const bool held =
            shape.pins == SheetShape::Pins::Row || (shape.pins == SheetShape::Pins::Corners && corner);
        if (held) draft.pin(c);
    }
    append(state, op, std::move(draft));
}

void build(State& state, const LockShape& shape, std::string name) {
    const char* const op = "add_lock";
    require_positive(op, "length", shape.length);
    require_count(op, "segments", shape.segments, 2);
    require_count(op, "roots", static_cast<int>(std::min<std::size_t>(shape.roots.size(), max_particles)), 1);
    require_length(op, "radius", shape.radius);
    require_positive(op, "density", shape.density);
    require_length(op, "bend", shape.bend);
    for (const LockShape::Root& root : shape.roots) {
        require_point(op, "position", root.position);
        require_point(op, "direction", root.direction);
        if (!(length(dvec3(root.direction)) > 1e-12)) refuse(op, "direction", "longer than 0", "0");
    }
    const Collider* holder = nullptr;
    for (const Collider& collider : state.colliders)
        if (collider.name == shape.attach) holder = &collider;
    if (!shape.attach.empty() && holder == nullptr)
        refuse(op, "attach", "the name of a collider", shape.attach);
    const auto segments = static_cast<std::uint32_t>(shape.segments);
    const std::size_t row = static_cast<std::size_t>(segments) + 1, count = row * shape.roots.size();
    require_room(op, state, count);

    const double each = static_cast<double>(shape.length) / segments;
    Draft draft;
    draft.points.reserve(count);
    for (const LockShape::Root& root : shape.roots)
        for (std::uint32_t i = 0; i <= segments; ++i)
            draft.points.push_back(dvec3(root.position) + (each * i) * unit(dvec3(root.direction)));
    draft.mass = std::max(shape.density * each, 1e-9);
    const auto strands = static_cast<std::uint32_t>(shape.roots.size());
    for (std::uint32_t s = 0; s < strands; ++s)
        for (std::uint32_t i = 0; i < segments; ++i) {
            const std::uint32_t a = s * (segments + 1) + i;
            draft.link(a, a + 1, each, Link::Kind::Stretch, 0.0f);
        }
    for (std::uint32_t s = 0; s < strands; ++s)
        for (std::uint32_t i = 0; i + 2 <= segments; ++i) {
            const std::uint32_t a = s * (segments + 1) + i;
            draft.link(a, a + 2, Link::Kind::Bend, shape.bend);
        }
    draft.body.name = std::move(name);
    draft.body.kind = Body::Kind::Lock;
    draft.body.row = row;
    draft.body.radius = shape.radius;
    // The first link of a strand is held whole: so it keeps its direction.
    for (std::size_t at = 0; at < count; at += row) {
        for (const std::size_t particle : {at, at + 1}) {
            draft.pin(particle);
            if (holder == nullptr) continue;
            draft.pins.back().collider = holder->name;
            draft.pins.back().goal -= dvec3(centre(holder->shape));
        }
    }
    append(state, op, std::move(draft));
}

}  // namespace tendril::rope::detail
