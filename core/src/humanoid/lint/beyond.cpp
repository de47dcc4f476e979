// Joints turned beyond their limits.
#include <algorithm>

#include "humanoid/lint/lint.hpp"

namespace tendril::humanoid::lint_detail {
namespace {

/// Degrees by which decent clips exceed the default limits: captured heads that are mapped to the end of the
/// neck, forearms turned instead of the upper arm. Knees exceed them the least.
double tolerance(Bone bone) noexcept {
    switch (bone) {
        case Bone::LeftLowerLeg:
        case Bone::RightLowerLeg:
            return 20.0;
        case Bone::Head:
        case Bone::LeftLowerArm:
        case Bone::RightLowerArm:
            return 65.0;
        default:
            return 45.0;
    }
}

/// Since when a joint is beyond its limit, and the worst frame.
struct Stay {
    bool is_beyond = false;
    std::size_t first = 0, worst = 0;
    double most = 0.0;  // degrees
};

/// Default limits must be exceeded for longer than this: a hinge's angle jumps when it is turned about
/// another axis.
constexpr double shortest = 0.1;  // seconds

void tell(Check& check, Bone bone, const Stay& stay, std::size_t last) {
    const double seconds = static_cast<double>(last - stay.first) / check.report.rate;
    if (!check.settings.limits && seconds < shortest) return;
    check.add(Fault::Limit, check.map[bone].node, stay.worst, stay.first, last, stay.most, "deg",
              "is turned " + shown(stay.most) + " degrees beyond its limit");
}

}  // namespace

void check_limits(Check& check) {
    if (!check.map.is_usable()) return;
    const BodyLimits* const given = check.settings.limits;
    const Expected<BodyJoints> joints = BodyJoints::make(
        check.skeleton, check.map, given ? *given : default_limits(check.skeleton, check.map));
    if (!joints) return;
    std::array<Stay, bone_count> stays{};
    std::vector<rig::Transform> pose(check.skeleton.size());
    std::vector<Placement> placed(check.skeleton.size());
    for (std::size_t frame = 0; frame < check.report.frames; ++frame) {
        sample(check.clip, check.skeleton, check.time_of(frame), pose);
        place(check.skeleton, pose, placed);
        for (std::size_t i = 0; i < bone_count; ++i) {
            const auto bone = static_cast<Bone>(i);
            const double excess = static_cast<double>(joints->excess(bone, placed)) * degrees;
            Stay& stay = stays[i];
            const bool is_beyond = excess > (given ? check.settings.beyond : tolerance(bone));
            if (stay.is_beyond && !is_beyond) tell(check, bone, stay, frame - 1);
            if (is_beyond && (!stay.is_beyond || excess > stay.most)) {
                if (!stay.is_beyond) stay.first = frame;
                stay.worst = frame;
                stay.most = excess;
            }
            stay.is_beyond = is_beyond;
        }
    }
    for (std::size_t i = 0; i < bone_count; ++i)
        if (stays[i].is_beyond) tell(check, static_cast<Bone>(i), stays[i], check.report.frames - 1);
}

}  // namespace tendril::humanoid::lint_detail
