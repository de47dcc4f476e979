#include "app/labs/humanoid/attachments/attachment_shape.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tendril/humanoid/t_pose.hpp>

namespace tendril::app {
namespace {

using glm::dvec3;
using humanoid::Bone;

constexpr double clearance = 0.002;  ///< metres between a body at rest and what is held on it

/// How far a point is from the body at rest, metres; negative inside.
double distance_to_body(const Wearer& wearer, const dvec3& point) {
    double nearest = 1e9;
    for (const humanoid::BodyCapsule& each : wearer.capsules) {
        const humanoid::PlacedCapsule at = humanoid::place(each, wearer.map, wearer.loaded.rest);
        nearest = std::min(nearest, humanoid::gap(at, {point, point, 0.0}));
    }
    return nearest;
}

/// How far one goes along `way`, of length 1, until a ball of that radius is off the body.
double way_off(const Wearer& wearer, const dvec3& from, const dvec3& way, double radius) {
    constexpr int max_steps = 200;
    double far = 0.0;
    for (int i = 0; i < max_steps; ++i) {
        const double inside = radius + clearance - distance_to_body(wearer, from + far * way);
        if (inside <= 0.0) break;
        far += std::max(inside, 0.5 * clearance);
    }
    return far;
}

bool on_trunk(std::optional<Bone> bone) {
    return bone && *bone >= Bone::Hips && *bone <= Bone::Head;
}

std::optional<Bone> bone_of(const Wearer& wearer, std::size_t node) {
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (wearer.map.bones[i].node == static_cast<std::int32_t>(node)) return static_cast<Bone>(i);
    return std::nullopt;
}

const dvec3* joint(const Wearer& wearer, Bone bone) {
    const std::int32_t node = wearer.map[bone].node;
    return node < 0 ? nullptr : &wearer.loaded.rest[static_cast<std::size_t>(node)].position;
}

double height_of(const Wearer& wearer) {
    const double height = wearer.loaded.height();
    return height > 1e-3 && height < 1e3 ? height : 1.8;
}

int columns_of(const AttachmentShape& shape) {
    const double cells = (1.0 + 0.5 * flare) * shape.width * shape.segments / shape.length;
    return 1 + static_cast<int>(std::clamp(std::round(cells), 1.0, double{max_attached_segments}));
}

/// So many points of a curve, from end to end, at equal ways along it.
std::vector<dvec3> evenly_along(const std::vector<dvec3>& curve, int count) {
    std::vector<double> way{0.0};
    for (std::size_t i = 1; i < curve.size(); ++i)
        way.push_back(way.back() + glm::distance(curve[i], curve[i - 1]));
    std::vector<dvec3> points;
    std::size_t at = 1;
    for (int i = 0; i < count; ++i) {
        const double wanted = way.back() * i / (count - 1);
        while (at + 1 < curve.size() && way[at] < wanted) ++at;
        const double step = way[at] - way[at - 1];
        const double part = step > 0.0 ? std::clamp((wanted - way[at - 1]) / step, 0.0, 1.0) : 0.0;
        points.push_back(curve[at - 1] + part * (curve[at] - curve[at - 1]));
    }
    return points;
}

}  // namespace

std::size_t particles_of(AttachmentKind kind, const AttachmentShape& shape) {
    const auto row = static_cast<std::size_t>(shape.segments) + 1;
    if (kind == AttachmentKind::Rope) return row;
    if (kind == AttachmentKind::Hair)
        return std::max(row, std::size_t{3}) * static_cast<std::size_t>(shape.strands);
    return row * static_cast<std::size_t>(columns_of(shape));
}

bool is_in_body(const Wearer& wearer, const dvec3& point, double radius) {
    return distance_to_body(wearer, point) < radius + clearance;
}

std::vector<dvec3> cloth_row(const Wearer& wearer, const AttachmentShape& shape, const dvec3& middle) {
    const humanoid::Facing facing = humanoid::facing(wearer.loaded.skeleton(), wearer.map);
    const dvec3 back = -facing.forward, half = 0.5 * shape.width * facing.left;
    const double radius = 0.5 * shape.thickness;
    const auto off = [&](const dvec3& from) { return way_off(wearer, from, back, radius); };
    const double deep = off(middle), side = std::max(off(middle - half), off(middle + half));
    // Half an ellipse round the back.
    constexpr int fine = 256;
    std::vector<dvec3> curve;
    for (int i = 0; i <= fine; ++i) {
        const double s = 1.0 - 2.0 * i / fine;
        const double far = side + (deep - side) * std::sqrt(std::max(0.0, 1.0 - s * s));
        const dvec3 at = middle + s * half + far * back;
        curve.push_back(at + off(at) * back);
    }
    return evenly_along(curve, columns_of(shape));
}

namespace {

AttachmentShape fitting_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node) {
    const humanoid::Facing facing = humanoid::facing(wearer.loaded.skeleton(), wearer.map);
    const double height = height_of(wearer), unit = height / 1.8;
    const dvec3 rest = wearer.loaded.rest[node].position, back = -facing.forward;
    const std::optional<Bone> bone = bone_of(wearer, node);
    const dvec3* const left = joint(wearer, Bone::LeftUpperArm);
    const dvec3* const right = joint(wearer, Bone::RightUpperArm);
    const bool trunk = on_trunk(bone);
    AttachmentShape shape;
    shape.direction = -facing.up;
    if (kind == AttachmentKind::Cloth) {
        shape = {.length = 0.5 * height,
                 .width = 0.22 * height,
                 .thickness = 0.012 * unit,
                 .segments = 18,
                 .direction = -facing.up};
        if (!trunk || left == nullptr || right == nullptr) return shape;
        shape.width = std::clamp(0.7 * glm::distance(*left, *right), 0.05 * height, height);
        shape.offset = 0.5 * (*left + *right) - rest;
        return shape;
    }
    if (kind == AttachmentKind::Rope) {
        shape.length = (bone == Bone::Hips ? 0.45 : 0.3) * height;
        shape.thickness = 0.03 * unit;
        shape.segments = 20;
        if (trunk) shape.direction = glm::normalize(0.9 * back - 0.45 * facing.up);
        return shape;
    }
    shape.length = 0.2 * height;
    shape.width = 0.03 * unit;
    shape.thickness = 0.006 * unit;
    shape.segments = 10;
    shape.strands = 24;
    if (trunk) shape.direction = glm::normalize(0.8 * back - 0.6 * facing.up);
    const dvec3 from = bone == Bone::Head ? 0.09 * unit * facing.up : dvec3(0.0);
    const dvec3 way = trunk ? back : shape.direction;
    shape.offset = from + way_off(wearer, rest + from, way, 0.5 * (shape.width + shape.thickness)) * way;
    return shape;
}

}  // namespace

void scale_lengths(AttachmentShape& shape, double by) {
    for (double* length : {&shape.length, &shape.width, &shape.thickness})
        *length = std::clamp(*length * by, min_attachment, max_attachment);
}

AttachmentShape default_shape(const Wearer& wearer, AttachmentKind kind, std::size_t node) {
    AttachmentShape shape = fitting_shape(wearer, kind, node);
    scale_lengths(shape, 1.0);
    return shape;
}

}  // namespace tendril::app
