#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

#include "math/checks.hpp"
#include "rope/rest_grid.hpp"
#include "rope/slots.hpp"
#include "tendril/rope/edit.hpp"

namespace tendril::rope {
namespace {

using glm::dvec2;
using tendril::detail::refused;

/// Positive to the left of the line through a and b, seen with columns to the right and rows upwards.
double side(dvec2 a, dvec2 b, dvec2 p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// Whether the step from a to b crosses a link between p and q. A particle on the line is to its left.
bool crosses(dvec2 a, dvec2 b, dvec2 p, dvec2 q) {
    constexpr double near = 1e-6;
    const double of_p = side(a, b, p), of_q = side(a, b, q);
    if ((of_p > -near) == (of_q > -near)) return false;
    const double part = std::clamp(of_p / (of_p - of_q), 0.0, 1.0);
    const dvec2 along = b - a, at = p + part * (q - p) - a;
    const double square = along.x * along.x + along.y * along.y;
    const double reached = (at.x * along.x + at.y * along.y) / square;
    return reached >= -near && reached <= 1.0 + near;
}

}  // namespace

Expected<World> cut_cloth(const World& world, BodyId cloth, std::span<const glm::vec2> line) {
    const char* const op = "cut_cloth";
    const Body* const body = world.find(cloth);
    if (body == nullptr) return detail::missing(op, "cloth", "body", cloth.index);
    if (body->kind != Body::Kind::Cloth)
        return Result(ErrorCode::InvalidArgument, "only cloth is cut along a line, not a rope or hair");
    if (line.size() < 2) return refused(op, "line", "2 points or more", line.size());
    for (std::size_t i = 0; i < line.size(); ++i)
        for (const float each : {line[i].x, line[i].y})
            if (!(std::abs(each) <= static_cast<float>(max_particles)))
                return refused(op, tendril::detail::Argument("line", i), "finite", each);
    State state = world.state();
    const auto crossed = [&](const Link& link) {
        if (!detail::owns(*body, link)) return false;
        const auto at = [&](std::size_t particle) {
            const std::size_t i = particle - body->first;
            return dvec2(i % body->row, i / body->row);
        };
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            if (crosses(dvec2(line[i]), dvec2(line[i + 1]), at(link.a), at(link.b))) return true;
        return false;
    };
    if (std::erase_if(state.links, crossed) == 0)
        return refused(op, "line", "across links of the cloth", "one that crosses none");
    return World::from_state(std::move(state));
}

}  // namespace tendril::rope
