#include "app/labs/chain/reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <stdexcept>
#include <tendril/ik/solver.hpp>
#include <utility>

#include "app/fields/solver_json.hpp"
#include "app/io/solver_text.hpp"
#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {

bool ReachSettings::operator==(const ReachSettings& other) const {
    const auto same = [&](const Field& field) { return same_field(field, this, &other); };
    return std::ranges::all_of(fields<ReachSettings>(), same) && plane == other.plane &&
           limits == other.limits && state == other.state;
}

std::vector<glm::vec3> positions(const Chain& chain) {
    std::vector<glm::vec3> joints;
    joints.reserve(chain.size());
    for (const Segment& segment : chain.segments()) joints.push_back(segment.position);
    return joints;
}

std::vector<glm::vec3> from_root(const std::vector<glm::vec3>& joints) {
    std::vector<glm::vec3> relative;
    relative.reserve(joints.size());
    for (const glm::vec3& joint : joints) relative.push_back(joint - joints.front());
    return relative;
}

glm::quat least_rotation(glm::vec3 from, glm::vec3 to) {
    const float w = 1.0f + glm::dot(from, to);
    if (w < 1e-6f) {
        const glm::vec3 side = std::abs(from.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        return glm::quat(0.0f, glm::normalize(glm::cross(from, side)));
    }
    return glm::normalize(glm::quat(w, glm::cross(from, to)));
}

std::vector<glm::quat> rotations_at(const std::vector<glm::vec3>& joints, std::vector<glm::quat> rotations,
                                    glm::vec3 rest) {
    rotations.resize(joints.empty() ? 0 : joints.size() - 1, glm::quat(1, 0, 0, 0));
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const glm::vec3 bone = joints[i + 1] - joints[i];
        if (glm::length(bone) < 1e-6f) continue;
        const glm::quat by = least_rotation(glm::normalize(rotations[i] * rest), glm::normalize(bone));
        rotations[i] = glm::normalize(by * rotations[i]);
    }
    return rotations;
}

bool takes(ik::Method method, const Chain& chain) {
    return method != ik::Method::TwoBone || chain.size() == 3;
}

void check_takes(ik::Method method, const Chain& chain) {
    if (!takes(method, chain)) throw std::invalid_argument(why_not_taken(method, chain));
}

float reach_tolerance(const ReachSettings& settings, float reach) {
    return settings.options.tolerance.value_or(1e-3f * reach);
}

ik::Options solver_options(const ReachSettings& settings, float reach) {
    ik::Options options = settings.options;
    options.tolerance = reach_tolerance(settings, reach);
    if (settings.plane)
        options.plane = ik::Plane{settings.plane->normal, settings.plane->bend, settings.plane->limits};
    options.limits = settings.limits;
    return options;
}

ik::State& state_for(ReachSettings& settings, std::size_t bones) {
    if (settings.state.bones() != bones) settings.state = ik::State(bones);
    return settings.state;
}

/// Clears memory that is not valid, so that equal states are bit-identical, also after saving and loading.
static void clear_invalid(ik::State& state) {
    if (!state.limits.valid) state.limits = {};
    if (state.pole.valid) return;
    std::vector<glm::vec3> joints = std::move(state.pole.joints);
    std::fill(joints.begin(), joints.end(), glm::vec3(0.0f));
    state.pole = {};
    state.pole.joints = std::move(joints);
}

std::optional<ReachResult> solve_reach(Chain& chain, ReachSettings& settings, glm::vec3 target,
                                       ChainRuntime& runtime) {
    if (chain.size() < 2) return std::nullopt;
    check_takes(settings.method, chain);
    ik::Solver& solver = runtime.solver(chain);
    ik::State& state = state_for(settings, solver.bones());
    const ik::Options options = solver_options(settings, solver.reach());
    ReachResult result{settings.method, solver.solve(settings.method, chain, state, target, options), {}};
    if (result.report.status == ik::Status::InvalidInput) {
        throw std::invalid_argument("the solver does not take this target, pole or limit");
    }
    clear_invalid(state);
    if (!is_limited(settings)) return result;
    if (result.report.status == ik::Status::Limited)
        result.active_limit = solver.explain(positions(chain), state, target, options);
    return result;
}

std::size_t bytes_of(const ik::State& state) {
    return state.rotations.size() * sizeof(glm::quat) + state.pole.joints.size() * sizeof(glm::vec3);
}

/// Calls `change` with each list of limits that is not empty.
template <class Change>
static void change_limits(ReachSettings& settings, const Change& change) {
    if (!settings.limits.empty()) change(settings.limits);
    if (settings.plane && !settings.plane->limits.empty()) change(settings.plane->limits);
    if (settings.plane && !settings.plane->aside.empty()) change(settings.plane->aside);
}

void bone_inserted(ReachSettings& settings, std::size_t index, std::size_t segments_now) {
    settings.state = {};  // twist is recomputed
    if (segments_now < 2) return;
    change_limits(settings, [&](auto& limits) {
        const auto at = static_cast<std::ptrdiff_t>(std::min(index, limits.size()));
        limits.emplace(limits.begin() + at);
        limits.resize(segments_now - 1);
    });
}

void bone_removed(ReachSettings& settings, std::size_t index, std::size_t segments_now) {
    settings.state = {};
    change_limits(settings, [&](auto& limits) {
        limits.erase(limits.begin() + static_cast<std::ptrdiff_t>(std::min(index, limits.size() - 1)));
        limits.resize(segments_now < 2 ? 0 : segments_now - 1);
    });
}

void bones_removed(ReachSettings& settings, const std::vector<std::size_t>& joints,
                   std::size_t segments_now) {
    settings.state = {};
    change_limits(settings, [&](auto& limits) {
        std::size_t left = 0;
        for (std::size_t i = 0; i < limits.size(); ++i)
            if (!std::binary_search(joints.begin(), joints.end(), i)) limits[left++] = limits[i];
        limits.resize(left);
        limits.resize(segments_now < 2 ? 0 : segments_now - 1);  // no bone starts at the new tail
    });
}

void forget_limits(ReachSettings& settings) {
    settings.limits.clear();
    if (settings.plane) settings.plane->limits.clear(), settings.plane->aside.clear();
    settings.state.rotations.assign(settings.state.bones(), glm::quat(1, 0, 0, 0));
    settings.state.limits = {};
}

bool is_limited(const ReachSettings& settings) {
    return !settings.limits.empty() || (settings.plane && !settings.plane->limits.empty());
}

ik::AngleLimit angle_limit_of(const ChainPlane& plane, std::size_t joint) {
    return joint < plane.limits.size() ? plane.limits[joint] : ik::AngleLimit{};
}

/// Signed height in metres; in double, for planes far from the origin.
static double height_over(const Chain& chain, const ChainPlane& plane, glm::vec3 point) {
    const glm::dvec3 normal = glm::normalize(glm::dvec3(plane.normal));
    return glm::dot(glm::dvec3(point) - glm::dvec3(chain.position(0)), normal);
}

glm::vec3 in_plane(const Chain& chain, const ReachSettings& settings, glm::vec3 point) {
    if (!settings.plane || chain.empty()) return point;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(settings.plane->normal));
    return glm::vec3(glm::dvec3(point) - height_over(chain, *settings.plane, point) * normal);
}

float off_plane(const Chain& chain, const ReachSettings& settings, glm::vec3 point) {
    if (!settings.plane || chain.empty()) return 0.0f;
    return static_cast<float>(std::abs(height_over(chain, *settings.plane, point)));
}

void keep_in_plane(Chain& chain, const ReachSettings& settings, ChainRuntime& runtime) {
    if (!settings.plane || chain.size() < 2) return;
    float off = 0.0f;
    for (const Segment& segment : chain.segments())
        off = std::max(off, off_plane(chain, settings, segment.position));
    if (off <= 1e-6f * chain.reach()) return;
    // A solve with weight 0 projects the joints onto the plane and restores the lengths there.
    ik::Solver& solver = runtime.solver(chain);
    ik::State state = solver.initial_state();
    ik::Options options;
    options.plane = ik::Plane{.normal = settings.plane->normal};
    options.weight = 0.0f;
    const glm::vec3 tip = chain.position(chain.size() - 1);
    if (solver.solve(ik::Method::Fabrik, chain, state, tip, options).status == ik::Status::InvalidInput)
        throw std::invalid_argument("the chain does not fit into this plane");
}

ik::Limit limit_of(const ReachSettings& settings, std::size_t joint) {
    return joint < settings.limits.size() ? settings.limits[joint] : ik::Limit{};
}

namespace {

/// A bone's world rotation from rest: the last solve's, followed by the shortest arc to the bone's present
/// direction.
glm::quat bone_rotation(const ReachSettings& settings, const Chain& chain, std::size_t bone) {
    const glm::quat before = settings.state.rotations.size() + 1 == chain.size()
                                 ? settings.state.rotations[bone]
                                 : glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    const glm::vec3 from = before * chain.default_direction(),
                    along = chain.position(bone + 1) - chain.position(bone);
    if (!(glm::length(along) > 0.0f)) return before;
    return glm::quat(from, glm::normalize(along)) * before;
}

/// Scales two half-axes of a cone until a swing is on the rim of their elliptic quadrant.
void widen(float& up, float& left, float by_up, float by_left) {
    constexpr float min_half_axis = 1e-2f;  // a half-axis of 0 cannot be scaled
    const float wide_up = std::max(up, min_half_axis), wide_left = std::max(left, min_half_axis);
    const float outside = glm::length(glm::vec2(by_up / wide_up, by_left / wide_left));
    if (outside <= 1.0f) return;
    constexpr float rounding = 1.0001f, half_turn = glm::pi<float>();
    up = std::min(rounding * outside * wide_up, half_turn);
    left = std::min(rounding * outside * wide_left, half_turn);
    // If one half-axis cannot grow further, the other compensates.
    const auto beside = [&](float by, float other) {
        const float share = other / half_turn, rest = 1.0f - share * share;
        return rest > 0.0f ? std::min(rounding * by / std::sqrt(rest), half_turn) : half_turn;
    };
    if (up == half_turn) left = std::max(left, beside(by_left, by_up));
    if (left == half_turn) up = std::max(up, beside(by_up, by_left));
}

}  // namespace

ik::Limit limit_around_pose(ik::JointKind kind, const ReachSettings& settings, const Chain& chain,
                            std::size_t joint, std::optional<glm::vec3> axis) {
    ik::Limit limit = ik::Limit::of(kind);
    if (kind == ik::JointKind::Free) return limit;
    const glm::vec3 rest = chain.default_direction();
    glm::quat turn = bone_rotation(settings, chain, joint);
    if (joint > 0) turn = glm::conjugate(bone_rotation(settings, chain, joint - 1)) * turn;
    if (axis) {
        limit.axis = *axis;
    } else if (kind == ik::JointKind::Hinge) {
        const glm::vec3 bend = glm::cross(rest, turn * rest);
        constexpr float straight = 0.05f, along_usual_axis = 0.9999f;
        if (const float size = glm::length(bend);
            size > straight && std::abs(glm::dot(bend, limit.axis)) < along_usual_axis * size)
            limit.axis = bend / size;
    }
    if (ik::fault(limit, rest) != nullptr) return limit;
    const ik::JointAngles at = ik::measure(limit, rest, turn);
    if (kind == ik::JointKind::Hinge) {
        if (at.up < -0.05f) limit.min = -std::exchange(limit.max, 0.0f - limit.min);
        limit.min = std::min(limit.min, at.up);
        limit.max = std::max(limit.max, at.up);
        return limit;
    }
    widen(at.up > 0.0f ? limit.up : limit.down, at.left > 0.0f ? limit.left : limit.right, std::abs(at.up),
          std::abs(at.left));
    limit.twist_min = std::min(limit.twist_min, at.twist);
    limit.twist_max = std::max(limit.twist_max, at.twist);
    return limit;
}

void set_limits(ReachSettings& settings, const std::vector<std::pair<std::size_t, ik::Limit>>& limits,
                const Chain& chain) {
    for (const auto& [joint, limit] : limits)
        if (const char* why = ik::fault(limit, chain.default_direction()))
            throw std::invalid_argument(fault_text(why, limit));
    if (settings.limits.empty()) settings.limits.resize(chain.size() - 1);
    for (const auto& [joint, limit] : limits) settings.limits[joint] = limit;
    const bool all_free = std::all_of(settings.limits.begin(), settings.limits.end(),
                                      [](const auto& each) { return each == ik::Limit{}; });
    if (all_free) forget_limits(settings);
}

// Texts of mode Reach.

namespace {

const char* bound_phrase(ik::Bound bound) {
    static constexpr const char* phrases[] = {"stops at",
                                              "stops at",
                                              "stops upwards at",
                                              "stops downwards at",
                                              "stops to the left at",
                                              "stops to the right at",
                                              "stops twisting at",
                                              "stops twisting at"};
    return phrases[static_cast<std::size_t>(bound)];
}

/// Whole degrees; tenths if the limit and the needed angle would otherwise read the same.
std::string degrees_text(const ik::ActiveLimit& limit, float angle) {
    const auto whole = [](float radians) { return std::lround(glm::degrees(radians)); };
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", whole(limit.limit) == whole(limit.needed) ? 1 : 0,
                  glm::degrees(static_cast<double>(angle)) + 0.0);
    return text;
}

}  // namespace

const char* solver_help(ik::Method method) {
    static constexpr const char* texts[] = {
        "Forward and backward reaching, and a step that straightens the chain near full reach.",
        "As published in 2011. Crawls near full reach and stalls at a collinear singularity.",
        "Rotates one joint after another so that the tip points at the target.",
        "Rotates all joints along the gradient, by the best step.",
        "Rotates all joints by the damped inverse of the Jacobian.",
        "The same, damped only where a singular value is small.",
        "The law of cosines. For chains of two bones.",
    };
    return texts[static_cast<std::size_t>(method)];
}

std::string why_not_taken(ik::Method method, const Chain& chain) {
    const std::size_t bones = chain.empty() ? 0 : chain.size() - 1;
    return std::string(solver_title(method)) + " " + needs_two_bones + "; this chain has " +
           std::to_string(bones);
}

std::string needed_degrees(const ik::ActiveLimit& limit) {
    return degrees_text(limit, limit.needed);
}

std::string active_limit_text(const ik::ActiveLimit& limit) {
    std::string text = "joint " + std::to_string(limit.joint) + " (" + joint_kinds.title(limit.kind) + ") ";
    text += std::string(bound_phrase(limit.bound)) + " " + degrees_text(limit, limit.limit) + " degrees";
    text += "; the target needs " + needed_degrees(limit);
    if (!limit.enough) text += " and more from the others";
    return text;
}

}  // namespace tendril::app
