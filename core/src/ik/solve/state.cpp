#include "tendril/ik/state.hpp"

#include <algorithm>
#include <cmath>

#include "ik/math.hpp"
#include "ik/solve/validate.hpp"
#include "math/checks.hpp"

namespace tendril::ik {

using namespace tendril::detail;

namespace {

constexpr const char* operation = "ik::State";
constexpr glm::quat unturned{1.0f, 0.0f, 0.0f, 0.0f};
/// Offsets from the root: the difference of two coordinates of up to 1e9 m, and a chain's reach beyond.
constexpr FieldRange offsets{-4e9, 4e9};

Result check_finite(const Argument& argument, const glm::vec3& p) noexcept {
    for (const float coordinate : {p.x, p.y, p.z}) {
        if (!std::isfinite(coordinate)) return refused(operation, argument, "finite", coordinate);
    }
    return {};
}

Result check(const PoleMemory& pole, std::size_t bones) noexcept {
    if (const Result bad = check_count(operation, "pole.joints", pole.joints.size(), bones + 1); !bad)
        return bad;
    if (pole.turn > PoleTurn::EachJoint)
        return refused(operation, "pole.turn", "0 or 1", static_cast<int>(pole.turn));
    if (!std::isfinite(pole.twist)) return refused(operation, "pole.twist", "finite", pole.twist);
    if (const Result bad = check_finite("pole.pole", pole.pole); !bad) return bad;
    if (const Result bad = check_finite("pole.target", pole.target); !bad) return bad;
    for (std::size_t i = 0; i < pole.joints.size(); ++i) {
        if (const Result bad = check_finite({"pole.joints", i}, pole.joints[i]); !bad) return bad;
    }
    return {};
}

}  // namespace

State::State(std::size_t bones) : rotations(bones, unturned) {
    pole.joints.resize(bones + 1);
}

void State::reset() noexcept {
    std::fill(rotations.begin(), rotations.end(), unturned);
    pole.valid = false;
    limits = {};
    side = Side::Free;
}

Result check(const State& state, std::size_t bones) noexcept {
    if (const Result bad = check_count(operation, "rotations", state.rotations.size(), bones); !bad)
        return bad;
    for (std::size_t i = 0; i < bones; ++i) {
        const glm::quat& q = state.rotations[i];
        if (detail::is_unit(q)) continue;
        const float size = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
        return refused(operation, {"rotations", i}, "of length 1", size);
    }
    if (const Result bad = check_finite("limits.target", state.limits.target); !bad) return bad;
    if (!(state.limits.damping >= 0.0f && state.limits.damping <= 100.0f))
        return refused(operation, "limits.damping", "from 0 to 100", state.limits.damping);
    if (state.side > Side::Right) return refused(operation, "side", "0 to 2", static_cast<int>(state.side));
    return check(state.pole, bones);
}

Result local_rotations(const State& state, std::span<glm::quat> out) noexcept {
    if (const Result bad = check_count("local_rotations", "out", out.size(), state.bones()); !bad) return bad;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const glm::quat parent = i == 0 ? unturned : state.rotations[i - 1];
        out[i] = math::compose(math::conjugate(parent), state.rotations[i]);
    }
    return {};
}

}  // namespace tendril::ik

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::PoleMemory>() noexcept {
    using ik::PoleMemory;
    static constexpr Field rows[] = {
        field<&PoleMemory::turn>("turn", ik::detail::turn_names),
        field<&PoleMemory::pole>("pole", ik::offsets, "m"),
        field<&PoleMemory::target>("target", ik::offsets, "m"),
        field<&PoleMemory::twist>("twist", {-max_magnitude, max_magnitude}, "rad"),
        list<&PoleMemory::joints>("joints", ik::offsets, "m").up_to(1'000'001)};
    return rows;
}

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LimitMemory>() noexcept {
    using ik::LimitMemory;
    static constexpr Field rows[] = {field<&LimitMemory::limited>("limited"),
                                     field<&LimitMemory::target>("target", ik::offsets, "m"),
                                     field<&LimitMemory::damping>("damping", {0.0, 100.0})};
    return rows;
}
