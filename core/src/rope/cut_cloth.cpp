#include <algorithm>
#include <cstdio>
#include <glm/vec2.hpp>
#include <numeric>

#include "math/checks.hpp"
#include "rope/body_data.hpp"
#include "rope/slots.hpp"
#include "tendril/rope/edit.hpp"

namespace tendril::rope {
namespace {

using glm::dvec2;
using tendril::detail::Argument;
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

Result check_line(const char* op, const Body& cloth, const ClothLine& line, std::size_t number) {
    char name[32], rule[64];
    std::snprintf(name, sizeof name, "lines[%zu]", number);
    if (line.size() < 2) return refused(op, name, "2 points or more", line.size());
    const float limits[] = {static_cast<float>(cloth.row), static_cast<float>(cloth.rows())};
    for (std::size_t i = 0; i < line.size(); ++i)
        for (int axis = 0; axis < 2; ++axis) {
            const float each = line[i][axis], end = limits[axis];
            if (each >= -1.0f && each <= end) continue;
            std::snprintf(rule, sizeof rule, "-1 to %g", static_cast<double>(end));
            return refused(op, Argument(name, i, axis == 0 ? "column" : "row"), rule, each);
        }
    return {};
}

/// A piece of a body.
struct BodyPiece {
    std::vector<std::size_t> particles{};  ///< numbered in the body, ascending
    std::size_t pins = 0;
};

/// The pieces of a body, in the order of their first particles.
std::vector<BodyPiece> pieces_of(const State& state, const Body& body, std::vector<std::size_t>& piece_of) {
    std::vector<std::size_t> parent(body.count);  // union-find; the root of a set is its first particle
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto first_of = [&](std::size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Link& link : state.links) {
        if (!detail::is_within(body, link)) continue;
        const std::size_t a = first_of(link.a - body.first), b = first_of(link.b - body.first);
        parent[std::max(a, b)] = std::min(a, b);
    }
    std::vector<BodyPiece> pieces;
    piece_of.assign(body.count, 0);
    for (std::size_t i = 0; i < body.count; ++i) {
        const std::size_t first = first_of(i);
        if (first == i) piece_of[i] = pieces.size(), pieces.emplace_back();
        piece_of[i] = piece_of[first];
        pieces[piece_of[i]].particles.push_back(i);
    }
    for (const Pin& pin : state.pins)
        if (pin.particle - body.first < body.count) ++pieces[piece_of[pin.particle - body.first]].pins;
    return pieces;
}

/// The body with its particles in the order of the pieces.
detail::BodyData sorted_by_piece(const State& state, const Body& body, const std::vector<BodyPiece>& pieces,
                                 const std::vector<std::size_t>& piece_of,
                                 std::vector<std::size_t>& becomes) {
    detail::BodyData data{.row = body.row};
    becomes.resize(body.count);
    for (const BodyPiece& piece : pieces)
        for (const std::size_t i : piece.particles) {
            becomes[i] = data.position.size();
            data.position.push_back(state.position[body.first + i]);
            data.displacement.push_back(state.displacement[body.first + i]);
            data.mass.push_back(state.mass[body.first + i]);
        }
    std::vector<std::vector<Link>> links(pieces.size());
    for (Link link : state.links) {
        if (!detail::is_within(body, link)) continue;
        std::vector<Link>& its = links[piece_of[link.a - body.first]];
        link.a = static_cast<std::uint32_t>(becomes[link.a - body.first]);
        link.b = static_cast<std::uint32_t>(becomes[link.b - body.first]);
        its.push_back(link);
    }
    for (const std::vector<Link>& its : links) data.links.insert(data.links.end(), its.begin(), its.end());
    for (Pin pin : state.pins) {
        if (pin.particle - body.first >= body.count) continue;
        pin.particle = becomes[pin.particle - body.first];
        data.pins.push_back(pin);
    }
    return data;
}

Edited split_pieces(State state, BodyId id) {
    const Body whole = *detail::find_in(state.bodies, id);
    std::vector<std::size_t> piece_of;
    std::vector<BodyPiece> pieces = pieces_of(state, whole, piece_of);
    const auto largest =
        std::max_element(pieces.begin(), pieces.end(), [](const BodyPiece& a, const BodyPiece& b) {
            return a.pins != b.pins ? a.pins < b.pins : a.particles.size() < b.particles.size();
        });
    const auto number = static_cast<std::size_t>(largest - pieces.begin());
    std::rotate(pieces.begin(), largest, largest + 1);
    for (std::size_t& each : piece_of) each = each == number ? 0 : each < number ? each + 1 : each;
    Edited edited;
    const detail::BodyData data = sorted_by_piece(state, whole, pieces, piece_of, edited.becomes);
    detail::replace_body(state, id, data, edited.becomes);

    auto at = detail::find_in(state.bodies, id) - state.bodies.data();
    std::size_t first = whole.first;
    for (const BodyPiece& piece : pieces) {
        Body body = whole;
        body.first = first, body.count = piece.particles.size();
        first += body.count;
        body.cells.clear();
        if (whole.kind == Body::Kind::Rope)
            body.row = body.count;
        else
            for (const std::size_t i : piece.particles)
                body.cells.push_back(static_cast<std::uint32_t>(whole.cell(i)));
        detail::crop(body);
        if (&piece == &pieces.front()) {
            state.bodies[static_cast<std::size_t>(at)] = std::move(body);
        } else {
            body.id = detail::take_slot(state.body_slots, state.bodies);
            edited.pieces.push_back(body.id);
            state.bodies.insert(state.bodies.begin() + ++at, std::move(body));
            detail::copy_collisions(state, id, edited.pieces.back());
        }
        detail::measure_stretch(state, state.bodies[static_cast<std::size_t>(at)]);
    }
    edited.world = *World::from_state(std::move(state));
    return edited;
}

}  // namespace

Expected<Edited> part_body(const World& world, BodyId id) {
    const Body* const body = world.find(id);
    if (body == nullptr) return detail::missing("part_body", "body", id, world.state());
    if (body->kind == Body::Kind::Hair)
        return Result(ErrorCode::InvalidArgument, "only ropes and cloth come apart, not hair");
    std::vector<std::size_t> piece_of;
    if (pieces_of(world.state(), *body, piece_of).size() > 1) return split_pieces(world.state(), id);
    Edited whole{world, std::vector<std::size_t>(body->count)};
    std::iota(whole.becomes.begin(), whole.becomes.end(), std::size_t{0});
    return whole;
}

Expected<Edited> cut_cloth(const World& world, BodyId cloth, std::span<const ClothLine> lines) {
    const char* const op = "cut_cloth";
    const Body* const found = world.find(cloth);
    if (found == nullptr) return detail::missing(op, "cloth", cloth, world.state());
    if (found->kind != Body::Kind::Cloth)
        return Result(ErrorCode::InvalidArgument, "only cloth is cut along a line, not a rope or hair");
    const Body& body = *found;
    for (std::size_t i = 0; i < lines.size(); ++i)
        if (const Result bad = check_line(op, body, lines[i], i); !bad) return bad;
    State state = world.state();
    const auto crossed = [&](const Link& link) {
        if (!detail::is_within(body, link)) return false;
        const auto at = [&](std::size_t particle) {
            const std::size_t cell = body.cell(particle - body.first);
            return dvec2(cell % body.row, cell / body.row);
        };
        for (const ClothLine& line : lines)
            for (std::size_t i = 0; i + 1 < line.size(); ++i)
                if (crosses(dvec2(line[i]), dvec2(line[i + 1]), at(link.a), at(link.b))) return true;
        return false;
    };
    if (std::erase_if(state.links, crossed) == 0)
        return refused(op, "lines", "across links of the cloth", "none that crosses one");
    return split_pieces(std::move(state), cloth);
}

}  // namespace tendril::rope
