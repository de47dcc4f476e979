#include "rope/check_state.hpp"

#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "chain/checks.hpp"

namespace tendril::rope::detail {
namespace {

const char* const op = "World";

[[noreturn]] void refuse(const std::string& what) {
    throw std::invalid_argument(std::string(op) + ": " + what);
}
std::string at(const char* list, std::size_t index) {
    return std::string(list) + " " + std::to_string(index);
}

bool is_within(const glm::dvec3& p, double most) {
    return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
}
bool is_point(const glm::dvec3& p) {
    return is_within(p, max_magnitude);
}
/// Between two points.
bool is_offset(const glm::dvec3& p) {
    return is_within(p, max_displacement);
}
bool is_amount(double value) {
    return value >= 0.0 && value <= max_magnitude;
}

void check_particles(const State& state) {
    const std::size_t size = state.position.size();
    if (size > max_particles) {
        refuse(std::to_string(size) + " particles; the most is " + std::to_string(max_particles));
    }
    if (state.moved.size() != size || state.before.size() != size || state.mass.size() != size) {
        refuse("position, moved, before and mass must have as many values each");
    }
    for (std::size_t i = 0; i < size; ++i) {
        if (!is_point(state.position[i])) refuse(at("position", i) + " is not finite or too far out");
        if (!is_offset(state.moved[i])) refuse(at("moved", i) + " is not finite or too large");
        if (!is_offset(state.before[i])) refuse(at("before", i) + " is not finite or too large");
        // 1e9 kg/m on 1e9 m, or a square of that, is allowed.
        if (!(state.mass[i] > 0.0 && state.mass[i] <= 1e30))
            refuse(at("mass", i) + " must be over 0 and finite");
    }
}

void check_bodies(const State& state) {
    std::set<std::string> names;
    std::size_t next = 0;
    for (const Body& body : state.bodies) {
        if (body.name.empty()) refuse("a body has no name");
        if (!names.insert(body.name).second) refuse("there are two bodies named \"" + body.name + "\"");
        if (body.first != next || body.count == 0 || body.count > state.position.size() - next) {
            refuse("the particles of body \"" + body.name + "\" do not follow those of the one before");
        }
        if (body.row == 0 || body.count % body.row != 0) {
            refuse("the particles of body \"" + body.name + "\" are no whole rows");
        }
        if (static_cast<int>(body.kind) > static_cast<int>(Body::Kind::Lock)) {
            refuse("body \"" + body.name + "\" is of no known kind");
        }
        tendril::detail::require_length(op, "radius of a body", body.radius);
        tendril::detail::require_length(op, "tear of a body", body.tear);
        tendril::detail::require_length(op, "stretch of a body", body.stretch);
        next += body.count;
    }
    if (next != state.position.size()) refuse("some particles belong to no body");
}

void check_links(const State& state) {
    for (std::size_t i = 0; i < state.links.size(); ++i) {
        const Link& link = state.links[i];
        if (link.a >= state.position.size() || link.b >= state.position.size() || link.a == link.b) {
            refuse(at("link", i) + " joins particles that are not there, or one to itself");
        }
        if (static_cast<int>(link.kind) > static_cast<int>(Link::Kind::Bend)) {
            refuse(at("link", i) + " is of no known kind");
        }
        tendril::detail::require_length(op, "rest of a link", link.rest);
        tendril::detail::require_length(op, "compliance of a link", link.compliance);
        if (!std::isfinite(link.tension)) refuse("the tension of " + at("link", i) + " is not finite");
    }
}

void check_pins(const State& state) {
    std::size_t next = 0;
    for (const Pin& pin : state.pins) {
        if (pin.particle < next || pin.particle >= state.position.size()) {
            refuse("pins must be of particles that there are, in their order, one each; got " +
                   std::to_string(pin.particle));
        }
        if (!(pin.collider.empty() ? is_point(pin.goal) : is_offset(pin.goal)))
            refuse("the goal of the pin of " + at("particle", pin.particle) + " is not finite");
        if (!is_amount(pin.seconds))
            refuse("the time of the pin of " + at("particle", pin.particle) + " is not");
        bool known = pin.collider.empty();
        for (const Collider& collider : state.colliders) known = known || collider.name == pin.collider;
        if (!known) refuse("a pin moves with \"" + pin.collider + "\", which is no collider");
        next = pin.particle + 1;
    }
}

void check_colliders(const State& state) {
    std::set<std::string> names;
    for (const Collider& collider : state.colliders) {
        if (collider.name.empty()) refuse("a collider has no name");
        if (!names.insert(collider.name).second)
            refuse("there are two colliders named \"" + collider.name + "\"");
        require(op, collider.shape);
        if (!is_point(collider.goal)) refuse("the goal of collider \"" + collider.name + "\" is not finite");
        if (!is_amount(collider.seconds)) refuse("the time of collider \"" + collider.name + "\" is not one");
    }
}

}  // namespace

void check(const State& state) {
    require(op, state.settings);
    check_particles(state);
    check_bodies(state);
    check_links(state);
    check_colliders(state);
    check_pins(state);
    if (!is_amount(state.remainder) || state.remainder > max_substep)
        refuse("remainder must be 0 to a substep");
    if (!is_amount(state.moved_in) || state.moved_in > max_substep) refuse("moved_in must be 0 to a substep");
}

}  // namespace tendril::rope::detail
