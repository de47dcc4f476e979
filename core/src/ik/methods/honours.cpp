// The table in method.hpp: which method honours which option.
#include <cstdint>

#include "math/checks.hpp"
#include "tendril/ik/method.hpp"

namespace tendril::ik {
namespace {

enum class When : std::uint8_t { Never, Without, Within, Both };

When honoured(Method method, Option option) noexcept {
    const bool two_bone = method == Method::TwoBone;
    switch (option) {
        case Option::Tolerance:
        case Option::Plane:
        case Option::Pole:
        case Option::TipOrientation:
        case Option::SoftZone:
        case Option::Weight:
        case Option::Residuals:
        case Option::Limits:
            return When::Both;
        case Option::MaxIterations:
        case Option::EveryIteration:
        case Option::SnapBack:
            return two_bone ? When::Within : When::Both;
        case Option::PoleTurn:
            return two_bone ? When::Never : When::Without;
        case Option::Damping:
            if (method == Method::Dls || method == Method::SvdDls) return When::Both;
            return two_bone ? When::Within : When::Never;
        case Option::Stretch:
            return two_bone ? When::Without : When::Never;
        case Option::Twist:
            return two_bone ? When::Both : When::Never;
        case Option::Restarts:
            return method == Method::Fabrik ? When::Within : When::Never;
        case Option::Rotations:
            return When::Without;
    }
    return When::Never;
}

}  // namespace

bool honours(Method method, Option option, bool within_limits) noexcept {
    const When when = honoured(method, option);
    return when == When::Both || when == (within_limits ? When::Within : When::Without);
}

Result check_takes(Method method, std::size_t bones) noexcept {
    using namespace tendril::detail;
    if (method > Method::TwoBone)
        return refused("solve", "method", "one of all_methods", static_cast<int>(method));
    if (method != Method::TwoBone || bones == 2) return {};
    return {ErrorCode::InvalidArgument, "Two-bone needs exactly two bones"};
}

}  // namespace tendril::ik
