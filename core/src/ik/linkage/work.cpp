#include "ik/linkage/work.hpp"

#include <algorithm>
#include <cmath>

#include "math/random.hpp"
#include "tendril/elementary.hpp"
#include "tendril/magnitude.hpp"

namespace tendril::ik::detail {
namespace {

constexpr glm::dvec3 world_axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};

glm::dquat turn_by_vector(const glm::dvec3& vector) noexcept {
    const double angle = length(vector);
    return angle > 0.0 ? rotation_about(times(vector, 1.0 / angle), angle) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}
/// The rotation vector of the shorter way round.
glm::dvec3 vector_of_turn(const glm::dquat& turn) noexcept {
    const glm::dvec3 sine{turn.x, turn.y, turn.z};
    const double size = length(sine), sign = turn.w < 0.0 ? -1.0 : 1.0;
    if (size < 1e-150) return glm::dvec3(0.0);
    return times(sine, sign * 2.0 * math::arctangent(size, std::abs(turn.w)) / size);
}

}  // namespace

void RowBasis::reserve(std::size_t columns) {
    columns_ = columns;
    rows_.resize(columns * columns);
    triangle_.resize(columns * columns);
    windows_.resize(columns);
}

void RowBasis::subtract_from(double* row, Window& window, double* parts) const noexcept {
    for (std::size_t k = 0; k < count_; ++k) {
        const Window& other = windows_[k];
        const std::size_t from = std::max(window.first, other.first), to = std::min(window.last, other.last);
        if (from >= to) continue;
        const double* unit = rows_.data() + k * columns_;
        double part = 0.0;
        for (std::size_t i = from; i < to; ++i) part += unit[i] * row[i];
        if (part == 0.0) continue;
        if (parts) parts[k] += part;
        for (std::size_t i = other.first; i < other.last; ++i) row[i] -= part * unit[i];
        window = {std::min(window.first, other.first), std::max(window.last, other.last)};
    }
}

double RowBasis::add(std::span<double> row, double scale) noexcept {
    Window window{columns_, 0};
    double before = 0.0;
    for (std::size_t i = 0; i < columns_; ++i) {
        if (row[i] == 0.0) continue;
        window = {std::min(window.first, i), i + 1};
        before += row[i] * row[i];
    }
    if (!(before > 0.0) || count_ == columns_) return 0.0;
    double square = before;
    double* parts = triangle_.data() + count_ * columns_;
    std::fill(parts, parts + count_, 0.0);
    for (int pass = 0; pass < 2; ++pass) {
        const double start = square;
        subtract_from(row.data(), window, parts);
        square = 0.0;
        for (std::size_t i = window.first; i < window.last; ++i) square += row[i] * row[i];
        if (square > 0.25 * start) break;
    }
    const double size = std::sqrt(square);
    if (!(size > 1e-9 * scale)) return 0.0;
    parts[count_] = size;
    const double inverse = 1.0 / size;
    double* unit = rows_.data() + count_ * columns_;
    std::fill(unit, unit + columns_, 0.0);
    for (std::size_t i = window.first; i < window.last; ++i) unit[i] = row[i] *= inverse;
    windows_[count_++] = window;
    return size;
}

void RowBasis::remove_from(std::span<double> row) const noexcept {
    for (int pass = 0; pass < 2; ++pass) {
        Window all{0, columns_};
        subtract_from(row.data(), all);
    }
}

void RowBasis::multipliers(std::span<const double> sum, std::span<double> found) const noexcept {
    for (std::size_t k = count_; k-- > 0;) {
        double part = 0.0;
        for (std::size_t i = windows_[k].first; i < windows_[k].last; ++i)
            part += rows_[k * columns_ + i] * sum[i];
        for (std::size_t i = k + 1; i < count_; ++i) part -= found[i] * triangle_[i * columns_ + k];
        found[k] = part / triangle_[k * columns_ + k];
    }
}

int RowBasis::orientation(std::span<const std::uint8_t> held, std::span<double> scratch) const noexcept {
    std::size_t free = 0;
    for (std::size_t col = 0; col < columns_; ++col) {
        if (held[col]) continue;
        for (std::size_t r = 0; r < count_; ++r) scratch[free * count_ + r] = rows_[r * columns_ + col];
        ++free;
    }
    return sign_of_determinant(scratch, count_);
}

int sign_of_determinant(std::span<double> matrix, std::size_t size) noexcept {
    int sign = 1;
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k + 1; i < size; ++i)
            if (std::abs(matrix[i * size + k]) > std::abs(matrix[pivot * size + k])) pivot = i;
        if (matrix[pivot * size + k] == 0.0) return 0;
        if (pivot != k) {
            sign = -sign;
            for (std::size_t j = k; j < size; ++j) std::swap(matrix[pivot * size + j], matrix[k * size + j]);
        }
        if (matrix[k * size + k] < 0.0) sign = -sign;
        for (std::size_t i = k + 1; i < size; ++i) {
            const double by = matrix[i * size + k] / matrix[k * size + k];
            if (by == 0.0) continue;
            for (std::size_t j = k + 1; j < size; ++j) matrix[i * size + j] -= by * matrix[k * size + j];
        }
    }
    return sign;
}

LinkageWork::LinkageWork(const Linkage& from) : linkage(from) {
    const std::size_t count = linkage.links.size();
    column.resize(count);
    places.resize(count);
    origins.resize(count);
    axes.resize(count);
    joints.resize(count);
    planar = true;
    bool has_normal = false;
    glm::dvec3 low(1e300), high(-1e300);
    const auto extend = [&](const glm::dvec3& at) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], at[axis]);
            high[axis] = std::max(high[axis], at[axis]);
        }
    };
    for (std::size_t i = 0; i < count; ++i) {
        const Link& link = linkage.links[i];
        const bool ball = link.joint == LinkJoint::Ball;
        column[i] = columns;
        columns += ball ? 3 : 1;
        drawn_axes.push_back(ball ? glm::dvec3(0.0) : times(link.axis, 1.0 / length(link.axis)));
        joints[i].value = ball ? 0.0 : link.rest;
        extend(link.at);
        if (ball) planar = false;
        if (link.joint != LinkJoint::Hinge) continue;
        if (!has_normal) normal = drawn_axes[i];
        has_normal = true;
        if (length(cross(normal, drawn_axes[i])) > 1e-9) planar = false;
    }
    for (std::size_t i = 0; i < count; ++i)
        if (linkage.links[i].joint == LinkJoint::Slider && std::abs(dot(normal, drawn_axes[i])) > 1e-9)
            planar = false;
    for (const LinkPoint& each : linkage.points) extend(each.at);
    for (const Closure& each : linkage.closures) {
        extend(each.first_at);
        extend(each.second_at);
    }
    const glm::dvec3 extent = minus(high, low);
    size = count > 0 ? std::max({extent.x, extent.y, extent.z}) : 0.0;
    if (!(size >= 1e-9)) size = travel_size();
    rounding = 1e-14 * std::max({largest_coordinate(low), largest_coordinate(high), size});
    driven.resize(columns);
    held.resize(columns);
    blocked.resize(count);
    step.resize(columns);
    block_rows.resize(6 * columns);
    moved.resize(columns);
    before_step = saved = nearest = joints;
    straight.resize(columns);
    for (std::size_t i = 0; i < count; ++i) straight[column[i]] = linkage.links[i].joint == LinkJoint::Slider;
    for (const Closure& each : linkage.closures)
        for (std::size_t link : {each.first, each.second})
            for (; link != ground_link; link = linkage.links[link].parent) straight[column[link]] = 0;
    basis.reserve(columns);
    mode_at.reserve(count);
    mode_held.reserve(columns);
    square.resize(columns * columns);
    curvature.resize(columns * columns);
    factor.resize(columns * columns);
    for (std::vector<double>* const each : {&gradient, &force, &multiplier, &solution}) each->resize(columns);
    row_origin.resize(columns);
    target_starts.resize(linkage.points.size());
    exact_positions.resize(linkage.points.size());
    driver_starts.resize(count);
    residuals.reserve(linkage.points.size());
    active.reserve(count);
    open.reserve(linkage.closures.size());
    move_links();
}

/// Size of a linkage whose joints and points coincide: its longest slider travel, metres.
double LinkageWork::travel_size() const noexcept {
    double travel = 0.0;
    for (const Link& each : linkage.links)
        if (each.joint == LinkJoint::Slider && std::isfinite(each.maximum - each.minimum))
            travel = std::max(travel, each.maximum - each.minimum);
    return travel >= 1e-9 ? travel : 1.0;
}

double LinkageWork::max_turn() const noexcept {
    double max_turn = 0.0;
    for (std::size_t i = 0; i < columns; ++i)
        if (!straight[i]) max_turn = std::max(max_turn, std::abs(step[i]));
    return max_turn;
}

bool LinkageWork::ranged(std::size_t link) const noexcept {
    const Link& each = linkage.links[link];
    if (each.joint == LinkJoint::Ball) return each.maximum < math::pi;
    return each.minimum > -std::numeric_limits<double>::infinity() ||
           each.maximum < std::numeric_limits<double>::infinity();
}

void LinkageWork::move_links() noexcept {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Link& link = linkage.links[i];
        const bool free = link.parent != ground_link;
        const LinkPlace parent = free ? places[link.parent] : LinkPlace{};
        LinkPlace& place = places[i];
        glm::dvec3 origin = free ? parent.point(link.at) : link.at;
        axes[i] = free ? rotated(parent.rotation, drawn_axes[i]) : drawn_axes[i];
        place.rotation = parent.rotation;
        switch (link.joint) {
            case LinkJoint::Hinge:
                place.rotation =
                    compose(parent.rotation, rotation_about(drawn_axes[i], joints[i].value - link.rest));
                break;
            case LinkJoint::Slider:
                origin = plus(origin, times(axes[i], joints[i].value - link.rest));
                break;
            case LinkJoint::Ball:
                place.rotation = compose(parent.rotation, joints[i].turn);
        }
        origins[i] = origin;
        place.shift = minus(origin, rotated(place.rotation, link.at));
    }
}

void LinkageWork::randomize_step(std::uint64_t& random, double range) noexcept {
    for (std::size_t i = 0; i < columns; ++i) {
        const auto bits = static_cast<std::int64_t>(math::random_bits(random));
        const double part = static_cast<double>(bits >> 11) * 0x1p-52;
        step[i] = driven[i] ? 0.0 : range * part;
    }
}

void LinkageWork::release() noexcept {
    held = driven;
    std::ranges::fill(blocked, std::uint8_t{0});
}

void LinkageWork::clamp_to_ranges() noexcept {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Link& link = linkage.links[i];
        glm::dquat& turn = joints[i].turn;
        if (link.joint != LinkJoint::Ball) {
            // Two sliders that are nearly parallel may go far apart, but a state's values are within
            // max_magnitude.
            constexpr double furthest = static_cast<double>(max_magnitude);
            joints[i].value = std::clamp(joints[i].value, std::max(link.minimum, -furthest),
                                         std::min(link.maximum, furthest));
            continue;
        }
        turn = unit_quaternion(turn.w, turn.x, turn.y, turn.z);
        if (!ranged(i)) continue;
        const glm::dvec3 whole = vector_of_turn(turn);
        const double angle = length(whole);
        if (angle > link.maximum) turn = turn_by_vector(times(whole, link.maximum / angle));
    }
}

glm::dvec3 LinkageWork::outward_of(std::size_t link) const noexcept {
    const glm::dvec3 whole = vector_of_turn(joints[link].turn);
    const double angle = length(whole);
    if (!(angle > 0.0)) return glm::dvec3(0.0);
    const std::size_t parent = linkage.links[link].parent;
    const glm::dvec3 axis = times(whole, 1.0 / angle);
    return parent == ground_link ? axis : rotated(places[parent].rotation, axis);
}

bool LinkageWork::pushes_outward(std::size_t link) const noexcept {
    if (length(vector_of_turn(joints[link].turn)) < linkage.links[link].maximum - bound_width) return false;
    const double* by = step.data() + column[link];
    return dot(outward_of(link), glm::dvec3(by[0], by[1], by[2])) > 0.0;
}

void LinkageWork::take_step(double part) noexcept {
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const Link& link = linkage.links[i];
        const double* by = step.data() + column[i];
        JointPlace& joint = joints[i];
        if (link.joint != LinkJoint::Ball) {
            joint.value += part * *by * unit_of(i);
            continue;
        }
        const glm::dquat parent =
            link.parent == ground_link ? glm::dquat(1.0, 0.0, 0.0, 0.0) : places[link.parent].rotation;
        const glm::dvec3 vector = rotated(conjugate(parent), times(glm::dvec3(by[0], by[1], by[2]), part));
        const glm::dquat turn = compose(turn_by_vector(vector), joint.turn);
        joint.turn = turn;
    }
    clamp_to_ranges();
}

void LinkageWork::add_point(std::size_t link, const glm::dvec3& at, double sign) noexcept {
    for (std::size_t k = link; k != ground_link; k = linkage.links[k].parent) {
        const std::size_t col = column[k];
        const LinkJoint kind = linkage.links[k].joint;
        const glm::dvec3 arm = minus(at, origins[k]);
        if (kind == LinkJoint::Ball) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const glm::dvec3 along = cross(world_axes[axis], arm);
                for (int r = 0; r < 3; ++r) row(static_cast<std::size_t>(r))[col + axis] += sign * along[r];
            }
            continue;
        }
        const glm::dvec3 along = kind == LinkJoint::Hinge ? cross(axes[k], arm) : times(axes[k], size);
        for (int r = 0; r < 3; ++r) row(static_cast<std::size_t>(r))[col] += sign * along[r];
    }
}

void LinkageWork::add_turn(std::size_t link, double sign) noexcept {
    for (std::size_t k = link; k != ground_link; k = linkage.links[k].parent) {
        const LinkJoint kind = linkage.links[k].joint;
        for (std::size_t r = 0; r < 3; ++r) {
            const std::span<double> to = row(3 + r);
            if (kind == LinkJoint::Ball) to[column[k] + r] += sign * size;
            if (kind == LinkJoint::Hinge) to[column[k]] += sign * size * axes[k][static_cast<int>(r)];
        }
    }
}

/// Second derivatives: an earlier joint of the chain rotates the motion caused by a later one.
void LinkageWork::add_curvature(std::size_t link, const glm::dvec3& at, const glm::dvec3& along) noexcept {
    const auto add = [&](std::size_t i, std::size_t k, double by) {
        curvature[i * columns + k] += by;
        if (i != k) curvature[k * columns + i] += by;
    };
    for (std::size_t inner = link; inner != ground_link; inner = linkage.links[inner].parent) {
        const LinkJoint kind = linkage.links[inner].joint;
        const bool ball = kind == LinkJoint::Ball;
        const glm::dvec3 arm = minus(at, origins[inner]);
        for (std::size_t a = 0; a < (ball ? 3u : 1u); ++a) {
            const glm::dvec3 axis = ball ? world_axes[a] : axes[inner];
            const glm::dvec3 moves = kind == LinkJoint::Slider ? times(axis, size) : cross(axis, arm);
            // A ball's rotation has no order of axes: take half about one axis first, half about the other.
            if (kind == LinkJoint::Hinge) add(column[inner], column[inner], dot(along, cross(axis, moves)));
            for (std::size_t b = 0; ball && b <= a; ++b) {
                const glm::dvec3 other = cross(world_axes[b], arm);
                add(column[inner] + a, column[inner] + b,
                    0.5 * (dot(along, cross(axis, other)) + dot(along, cross(world_axes[b], moves))));
            }
            for (std::size_t k = linkage.links[inner].parent; k != ground_link; k = linkage.links[k].parent) {
                if (linkage.links[k].joint == LinkJoint::Slider) continue;
                const glm::dvec3 by = cross(moves, along);  // along . (axis x moves) = axis . (moves x along)
                if (linkage.links[k].joint == LinkJoint::Hinge)
                    add(column[inner] + a, column[k], dot(axes[k], by));
                for (std::size_t b = 0; linkage.links[k].joint == LinkJoint::Ball && b < 3; ++b)
                    add(column[inner] + a, column[k] + b, by[static_cast<int>(b)]);
            }
        }
    }
}

void LinkageWork::add_closure_curvature(std::size_t index, const glm::dvec3& along) noexcept {
    const Closure& closure = linkage.closures[index];
    add_curvature(closure.first, point_of(closure.first, closure.first_at), along);
    add_curvature(closure.second, point_of(closure.second, closure.second_at), times(along, -1.0));
}

void LinkageWork::add_point_curvature(std::size_t point, const glm::dvec3& along) noexcept {
    const LinkPoint& of = linkage.points[point];
    add_curvature(of.link, point_of(of.link, of.at), along);
}

glm::dvec3 LinkageWork::turn_between(const Closure& closure) const noexcept {
    const glm::dquat still(1.0, 0.0, 0.0, 0.0);
    const glm::dquat first = closure.first == ground_link ? still : places[closure.first].rotation;
    const glm::dquat second = closure.second == ground_link ? still : places[closure.second].rotation;
    return times(vector_of_turn(compose(second, conjugate(first))), size);
}

LinkageWork::Block LinkageWork::closure_block(std::size_t index) noexcept {
    const Closure& closure = linkage.closures[index];
    const glm::dvec3 first = point_of(closure.first, closure.first_at),
                     second = point_of(closure.second, closure.second_at), gap = minus(second, first);
    const bool frame = closure.kind == ClosureKind::Frame;
    Block block{frame ? 6u : 3u, {gap.x, gap.y, gap.z}};
    std::fill_n(block_rows.begin(), block.count * columns, 0.0);
    add_point(closure.first, first, 1.0);
    add_point(closure.second, second, -1.0);
    if (!frame) return block;
    add_turn(closure.first, 1.0);
    add_turn(closure.second, -1.0);
    const glm::dvec3 turn = turn_between(closure);
    for (int r = 0; r < 3; ++r) block.errors[static_cast<std::size_t>(3 + r)] = turn[r];
    return block;
}

LinkageWork::Block LinkageWork::target_block(const LinkTarget& target) noexcept {
    const LinkPoint& point = linkage.points[target.point];
    const glm::dvec3 at = point_of(point.link, point.at), gap = target_gap(target);
    std::fill_n(block_rows.begin(), 3 * columns, 0.0);
    add_point(point.link, at, 1.0);
    return {3, {gap.x, gap.y, gap.z}};
}

glm::dvec3 LinkageWork::target_gap(const LinkTarget& target) const noexcept {
    const glm::dvec3 gap = minus(target.to, position_of(target));
    return planar ? across(gap, normal) : gap;
}

double LinkageWork::driver_error(const LinkDriver& driver) const noexcept {
    const Link& link = linkage.links[driver.link];
    return (std::clamp(driver.value, link.minimum, link.maximum) - joints[driver.link].value) /
           unit_of(driver.link);
}

double LinkageWork::squared_gap(const Closure& closure) const noexcept {
    const glm::dvec3 gap =
        minus(point_of(closure.second, closure.second_at), point_of(closure.first, closure.first_at));
    if (closure.kind == ClosureKind::Point) return dot(gap, gap);
    const glm::dvec3 turn = turn_between(closure);
    return dot(gap, gap) + dot(turn, turn);
}

double LinkageWork::gap_of(const Closure& closure) const noexcept {
    const double apart =
        length(minus(point_of(closure.second, closure.second_at), point_of(closure.first, closure.first_at)));
    return closure.kind == ClosureKind::Frame ? std::max(apart, length(turn_between(closure))) : apart;
}

double LinkageWork::largest_gap() const noexcept {
    double largest = 0.0;
    for (const Closure& each : linkage.closures) largest = std::max(largest, gap_of(each));
    return largest;
}

}  // namespace tendril::ik::detail
