// Changes of a body's material while it hangs.
#include <algorithm>
#include <cmath>

#include "math/checks.hpp"
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
    if (changed == nullptr) return missing("set_radius", "body", "body", body.index);
    const Result result = check_length("set_radius", "metres", metres);
    if (result) changed->radius = metres;
    return result;
}

Result World::set_tear(BodyId body, float tear) noexcept {
    Body* const changed = found(body);
    if (changed == nullptr) return missing("set_tear", "body", "body", body.index);
    const Result result = check_length("set_tear", "tear", tear);
    if (result) changed->tear = tear;
    return result;
}

double World::mass(const Body& body) const noexcept {
    double sum = 0.0;
    for (std::size_t i = body.first; i < body.first + body.count; ++i) sum += state_.mass[i];
    return sum;
}

Result World::set_mass(BodyId body, double kilograms) noexcept {
    const Body* const changed = find(body);
    if (changed == nullptr) return missing("set_mass", "body", "body", body.index);
    if (!(kilograms > 0.0 && kilograms <= 1e18))
        return refused("set_mass", "kilograms", "over 0 and at most 1e18", kilograms);
    const double factor = kilograms / mass(*changed);
    for (std::size_t i = changed->first; i < changed->first + changed->count; ++i)
        state_.mass[i] = std::clamp(factor * state_.mass[i], 1e-30, 1e30);
    return {};
}

Result World::set_compliance(BodyId body, Link::Kind kind, float compliance) noexcept {
    const Body* const changed = find(body);
    if (changed == nullptr) return missing("set_compliance", "body", "body", body.index);
    if (const Result bad = check_length("set_compliance", "compliance", compliance); !bad) return bad;
    for (Link& link : state_.links)
        if (link.kind == kind && detail::owns(*changed, link)) link.compliance = compliance;
    return {};
}

Result World::set_length(BodyId body, float metres) noexcept {
    Body* const changed = found(body);
    if (changed == nullptr) return missing("set_length", "body", "body", body.index);
    if (const Result bad = check_length("set_length", "metres", metres); !bad) return bad;
    const double now = length(*changed);
    if (!(now > 0.0)) return refused("set_length", "body", "longer than 0", now);
    const double factor = metres / now;
    for (const Link& link : state_.links) {
        if (detail::owns(*changed, link) && !(factor * link.rest <= static_cast<double>(max_magnitude)))
            return refused("set_length", "metres", "such that no link is longer than 1e9 m", metres);
    }
    for (Link& link : state_.links)
        if (detail::owns(*changed, link)) link.rest = static_cast<float>(factor * link.rest);
    take_stretch(*changed);
    return {};
}

}  // namespace tendril::rope
