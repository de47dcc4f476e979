// What counts as a flip: a bone that turned far in a tick while what it follows hardly moved.
#pragma once

#include <vector>

#include "app/document/argument.hpp"
#include "app/document/json_place.hpp"
#include "app/widgets/emit.hpp"

namespace tendril::app {

inline constexpr float min_flip_degrees = 1.0f, max_flip_degrees = 180.0f;

/// A bone turned by more than `degrees`, while the target (of a rig: each control that was moved), as the
/// bone's root sees it, turned by less than a share of that, or moved by less than a share of the reach.
struct FlipRule {
    float degrees = 30.0f;      ///< min_flip_degrees to max_flip_degrees
    float angle_share = 0.2f;   ///< 0 to 1
    float reach_share = 0.02f;  ///< 0 to 1

    bool operator==(const FlipRule&) const = default;
};

Json save_flip_rule(const FlipRule& rule);
FlipRule load_flip_rule(const JsonPlace& place);

/// What the rule is about, in the words of a lab.
struct FlipWords {
    const char* command;  ///< that sets the rule
    const char* mover;    ///< "target": what a bone follows
    const char* seen;     ///< "the target, as the root sees it,"
    const char* size;     ///< "reach"
    const char* whole;    ///< "the chain's reach"
};
/// Each of them may be left out.
std::vector<Argument> flip_arguments(const FlipWords& words);
void set_flip_rule(FlipRule& rule, const Arguments& given);
/// Fields that set it.
void flip_rows(const FlipRule& rule, const FlipWords& words, Emit& emit);

}  // namespace tendril::app
