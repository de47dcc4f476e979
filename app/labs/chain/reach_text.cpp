// Reach mode in words.
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "app/labs/chain/reach.hpp"

namespace tendril::app {
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

/// Whole degrees, or tenths where limit and need would look the same.
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
        "Forward and backward reaching, and a step that takes the bend out near full reach.",
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

const char* status_help(ik::Status status) {
    static constexpr const char* texts[] = {
        "The tip is on the target.",
        "The target is out of reach: the chain lies straight towards it.",
        "The target is nearer than the longest bone lets the tip fold.",
        "The joint limits keep the tip away.",
        "More iterations would change nothing.",
        "Still on its way when the iterations were used up.",
        "Nothing was moved: a number is not valid.",
    };
    return texts[static_cast<std::size_t>(status)];
}

const char* kind_title(ik::JointKind kind) {
    static constexpr const char* titles[] = {"free",   "suture", "hinge",          "gliding",
                                             "saddle", "pivot",  "ball and socket"};
    return titles[static_cast<std::size_t>(kind)];
}

std::string needed_degrees(const ik::ActiveLimit& limit) {
    return degrees_text(limit, limit.needed);
}

std::string active_limit_text(const ik::ActiveLimit& limit) {
    std::string text = "joint " + std::to_string(limit.joint) + " (" + kind_title(limit.kind) + ") ";
    text += std::string(bound_phrase(limit.bound)) + " " + degrees_text(limit, limit.limit) + " degrees";
    text += "; the target needs " + needed_degrees(limit);
    if (!limit.enough) text += " and more of the others";
    return text;
}

}  // namespace tendril::app
