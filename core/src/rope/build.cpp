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

/// Adds particles at rest.
std::uint32_t add_particles(State& state, const std::vector<dvec3>& points, double mass) {
    const std::size_t first = state.position.size(), size = first + points.size();
    state.position.insert(state.position.end(), points.begin(), points.end());
    state.moved.resize(size, dvec3(0.0));
    state.before.resize(size, dvec3(0.0));
    state.mass.resize(size, mass);
    return static_cast<std::uint32_t>(first);
}

void add_pin(State& state, std::size_t particle) {
    state.pins.push_back(
        {.particle = particle, .goal = state.position[particle], .seconds = 0.0, .collider = {}});
}

double distance(const State& state, std::uint32_t a, std::uint32_t b) {
    return length(state.position[b] - state.position[a]);
}

/// A link as long as its particles are apart.
void add_link(State& state, std::uint32_t a, std::uint32_t b, Link::Kind kind, float compliance) {
    state.links.push_back({.a = a,
                           .b = b,
                           .rest = static_cast<float>(distance(state, a, b)),
                           .kind = kind,
                           .compliance = compliance});
}

/// Grid coordinates of a sheet's links.
class Grid {
  public:
    Grid(State& state, std::uint32_t first, std::uint32_t columns, std::uint32_t rows)
        : state_(state), first_(first), columns_(columns), rows_(rows) {}

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
        add_link(state_, first_ + r * columns_ + c, first_ + to_r * columns_ + to_c, kind, compliance);
    }

    State& state_;
    std::uint32_t first_, columns_, rows_;
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
    const std::uint32_t first =
        add_particles(state, hang(from, to, whole, segments, down(state.settings)), mass);
    for (std::uint32_t i = 0; i < segments; ++i) {
        state.links.push_back({.a = first + i, .b = first + i + 1, .rest = static_cast<float>(each)});
    }
    state.bodies.push_back({.name = std::move(name),
                            .kind = Body::Kind::Rope,
                            .first = first,
                            .count = segments + 1,
                            .row = segments + 1,
                            .radius = shape.radius});
    if (shape.pin_start) add_pin(state, first);
    if (shape.pin_end) add_pin(state, first + segments);
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

    std::vector<dvec3> points;
    points.reserve(count);
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c)
            points.push_back(dvec3(shape.corner) +
                             (static_cast<double>(c) / (columns - 1)) * dvec3(shape.along) +
                             (static_cast<double>(r) / (rows - 1)) * dvec3(shape.down));
    const double area = length(cross(dvec3(shape.along), dvec3(shape.down)));
    const double mass =
        std::max(static_cast<double>(shape.density) * area / static_cast<double>(count), 1e-9);
    const std::uint32_t first = add_particles(state, points, mass);
    Grid grid(state, first, columns, rows);
    grid.stretch();
    grid.shear(shape.shear);
    grid.bend(shape.bend);
    state.bodies.push_back({.name = std::move(name),
                            .kind = Body::Kind::Sheet,
                            .first = first,
                            .count = count,
                            .row = columns,
                            .radius = shape.radius,
                            .tear = shape.tear});
    for (std::uint32_t c = 0; c < columns; ++c) {
        const bool corner = c == 0 || c + 1 == columns;
        const bool held =
            shape.pins == SheetShape::Pins::Row || (shape.pins == SheetShape::Pins::Corners && corner);
        if (held) add_pin(state, first + c);
    }
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
    std::vector<dvec3> points;
    points.reserve(count);
    for (const LockShape::Root& root : shape.roots)
        for (std::uint32_t i = 0; i <= segments; ++i)
            points.push_back(dvec3(root.position) + (each * i) * unit(dvec3(root.direction)));
    const std::uint32_t first = add_particles(state, points, std::max(shape.density * each, 1e-9));
    const auto strands = static_cast<std::uint32_t>(shape.roots.size());
    for (std::uint32_t s = 0; s < strands; ++s)
        for (std::uint32_t i = 0; i < segments; ++i) {
            const std::uint32_t a = first + s * (segments + 1) + i;
            state.links.push_back({.a = a, .b = a + 1, .rest = static_cast<float>(each)});
        }
    for (std::uint32_t s = 0; s < strands; ++s)
        for (std::uint32_t i = 0; i + 2 <= segments; ++i) {
            const std::uint32_t a = first + s * (segments + 1) + i;
            add_link(state, a, a + 2, Link::Kind::Bend, shape.bend);
        }
    state.bodies.push_back({.name = std::move(name),
                            .kind = Body::Kind::Lock,
                            .first = first,
                            .count = count,
                            .row = row,
                            .radius = shape.radius});
    // The first link of a strand is held whole: so it keeps its direction.
    for (std::size_t at = first; at < first + count; at += row) {
        for (const std::size_t particle : {at, at + 1}) {
            add_pin(state, particle);
            if (holder == nullptr) continue;
            state.pins.back().collider = holder->name;
            state.pins.back().goal -= dvec3(centre(holder->shape));
        }
    }
}

}  // namespace tendril::rope::detail
