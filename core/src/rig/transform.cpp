#include "tendril/rig/transform.hpp"

#include <cmath>

#include "rig/checks.hpp"
#include "rig/math.hpp"

namespace tendril::rig {
namespace {

using namespace detail;
using tendril::detail::no_index;

/// Products of two numbers within this bound, and sums of a few such products, are finite: nothing here can
/// become infinite or NaN.
constexpr double largest = 1e100;

double bounded(double value) noexcept {
    return std::clamp(value, -largest, largest);
}
glm::dvec3 bounded(const glm::dvec3& value) noexcept {
    return {bounded(value.x), bounded(value.y), bounded(value.z)};
}
double inverse(double scale) noexcept {
    return std::abs(scale) > 1.0 / largest ? 1.0 / scale : 0.0;
}
glm::dvec3 inverse(const glm::dvec3& scale) noexcept {
    return {inverse(scale.x), inverse(scale.y), inverse(scale.z)};
}

constexpr std::string_view translation_names[]{"translation.x", "translation.y", "translation.z"};
constexpr std::string_view rotation_names[]{"rotation.x", "rotation.y", "rotation.z", "rotation.w"};
constexpr std::string_view scale_names[]{"scale.x", "scale.y", "scale.z"};

Result check(const Transform& input, std::string_view operation, std::string_view argument) noexcept {
    const glm::dvec3 &t = input.translation, &s = input.scale;
    const glm::dquat& r = input.rotation;
    const double translation[]{t.x, t.y, t.z}, rotation[]{r.x, r.y, r.z, r.w}, scale[]{s.x, s.y, s.z};
    const auto at = [&](std::string_view member) { return Argument(argument, no_index, member); };
    for (std::size_t i = 0; i < 3; ++i)
        if (const Result bad = check_number(operation, at(translation_names[i]), translation[i]); !bad)
            return bad;
    for (std::size_t i = 0; i < 4; ++i)
        if (const Result bad = check_number(operation, at(rotation_names[i]), rotation[i]); !bad) return bad;
    if (const double size = std::sqrt(detail::dot(r, r)); !(size >= 1e-6))
        return refused(operation, at("rotation"), "of length 1e-6 or more", size);
    for (std::size_t i = 0; i < 3; ++i) {
        if (const Result bad = check_number(operation, at(scale_names[i]), scale[i]); !bad) return bad;
        if (scale[i] == 0.0) return refused(operation, at(scale_names[i]), "non-zero", scale[i]);
    }
    return {};
}

}  // namespace

bool operator==(const Transform& a, const Transform& b) noexcept {
    return a.translation.x == b.translation.x && a.translation.y == b.translation.y &&
           a.translation.z == b.translation.z && a.rotation.x == b.rotation.x &&
           a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z && a.rotation.w == b.rotation.w &&
           a.scale.x == b.scale.x && a.scale.y == b.scale.y && a.scale.z == b.scale.z;
}

glm::dquat normalised(const glm::dquat& rotation) noexcept {
    const double squared = detail::dot(rotation, rotation);
    if (std::abs(squared - 1.0) <= 4e-15) return rotation;  // as close to 1 as dividing by the length gets
    if (!(squared > 0.0)) return {1.0, 0.0, 0.0, 0.0};
    return unit_quaternion(rotation.w, rotation.x, rotation.y, rotation.z);
}

Expected<Transform> checked(const Transform& input, std::string_view operation,
                            std::string_view argument) noexcept {
    if (const Result bad = check(input, operation, argument); !bad) return bad;
    Transform fit = input;
    fit.rotation = normalised(fit.rotation);
    return fit;
}

Transform compose(const Transform& parent, const Transform& child) noexcept {
    return {
        bounded(plus(parent.translation, rotated(parent.rotation, product(parent.scale, child.translation)))),
        normalised(math::compose(parent.rotation, child.rotation)),
        bounded(product(parent.scale, child.scale))};
}

Transform relative(const Transform& parent, const Transform& global) noexcept {
    const glm::dquat back = conjugate(parent.rotation);
    const glm::dvec3 shrink = inverse(parent.scale);
    return {bounded(product(shrink, rotated(back, minus(global.translation, parent.translation)))),
            normalised(math::compose(back, global.rotation)), bounded(product(shrink, global.scale))};
}

glm::dquat blend(const glm::dquat& a, const glm::dquat& b, double part) noexcept {
    const double t = weight(part);
    if (t == 0.0) return a;
    return t == 1.0 ? b : slerp(a, b, t);
}

Transform blend(const Transform& a, const Transform& b, double part) noexcept {
    const double t = weight(part);
    if (t == 0.0) return a;
    if (t == 1.0) return b;
    return {mix(a.translation, b.translation, t), slerp(a.rotation, b.rotation, t), mix(a.scale, b.scale, t)};
}

}  // namespace tendril::rig
