#include "app/labs/rig/input_help.hpp"

namespace tendril::app {
namespace {

struct Help {
    const char* operation;  ///< empty: whatever has an input of that name
    const char* input;      ///< the last name of the path; "primary/axis" where that is not enough
    const char* text;
};

constexpr Help helps[] = {
    {"", "primary/weight", "How far the axis is brought to its target. 1 is all the way."},
    {"", "secondary/weight", "How far the item is rolled towards the second target. 1 is all the way."},
    {"", "primary/axis", "The axis of the item, in its own space, that points at the target."},
    {"", "secondary/axis",
     "The axis of the item that points as nearly at the second target as the first allows."},
    {"", "primary/target", "What the axis points at: a point in the scene, or a direction."},
    {"", "secondary/target",
     "What the item is rolled towards: a point in the scene, or a direction. Often it says "
     "where up is."},
    {"", "secondary",
     "A second axis with its target, which decides the roll about the first. None: it is not rolled."},
    {"", "kind", "Whether the target is a point in the scene or a direction."},
    {"", "max_speed", "How many degrees the item turns in a second at most. 0 is no limit."},
    {"parent_constraint", "parents/weight",
     "How much this parent counts, relative to the others. 0 leaves it out."},
    {"", "weight", "How much the unit does: 0 leaves everything as it is, 1 does all of it."},
    {"", "when", "The unit runs only where this is on."},
    {"parent_constraint", "parents/item", "An element that the item follows."},
    {"", "item", "The element that the unit moves."},
    {"", "child", "The element whose place at rest is taken to another parent."},
    {"", "old_parent", "The element to which the child was fastened at rest."},
    {"", "new_parent", "The element to which the child is fastened now."},
    {"", "maintain_offset",
     "On, only what the parents have moved since they were added passes on. Off, the item goes to its "
     "parents."},
    {"", "filter",
     "Which axes of translation, rotation and scale pass; the others stay as they are. In the space of "
     "the item's parent."},
    {"", "offset", "What is added to the item's transform, in the item's own space."},
    {"", "propagate", "On, all elements below the item go with it. Off, they stay where they are."},
    {"", "space", "Global: in the scene. Local: within the item's parent."},
    {"set_transform", "transform", "The transform that the item gets."},
    {"", "transform", "The transform that the unit works on."},
    {"", "rotation", "The rotation that the item gets."},
    {"", "from", "The direction that is turned. Its length does not matter."},
    {"", "to", "The direction that it is turned to. Its length does not matter."},
    {"", "location", "A point in the transform's own space. The result is that point in the scene."},
    {"", "direction",
     "A direction in the transform's own space. The result is turned with it, and as long as before."},
    {"", "roots", "Where the for-each begins: its units run on each element from here down."},
    {"", "include_parent", "On, the units run on the root itself too. Off, only on what is below it."},
    {"", "recursive", "On, the units run on all that is below the root. Off, on its children alone."},
    {"", "map_range", "First step: maps the in range to the out range, beyond its ends too."},
    {"", "in_range", "The range that is mapped. Only with map range."},
    {"", "out_range", "What the ends of the in range become. Only with map range."},
    {"", "scale", "Second step: the value is multiplied by this, then the bias is added."},
    {"", "bias", "Second step: added after the value is multiplied by scale."},
    {"", "clamp", "Third step: keeps the value between clamp min and clamp max."},
    {"", "clamp_min", "The minimum of the value. Only with clamp."},
    {"", "clamp_max", "The maximum of the value. Only with clamp."},
    {"", "interp", "Last step: eases towards the value instead of jumping."},
    {"", "speed_increasing", "How fast it eases while the value rises. Only with interp."},
    {"", "speed_decreasing", "How fast it eases while the value falls. Only with interp."},
    {"spring_interpolate", "target", "What the spring pulls towards: a number, a vector or a rotation."},
    {"", "strength", "How often a second the spring would swing without damping. More follows faster."},
    {"", "critical_damping",
     "How soon swinging stops: 0 swings for ever, 1 is the fastest that does not overshoot."},
    {"", "force", "A push on what the spring moves: shifts where it comes to rest. None: there is none."},
    {"", "target_velocity_amount",
     "How much of the target's velocity the spring goes by, from 0 to 1: at 1 it follows steady motion "
     "without lag."},
    {"set_curve", "curve", "The named curve that is written: a morph weight, or a value of a material."},
    {"set_curve", "value", "What is written into the curve."},
    {"evaluate_curve", "value", "Where the curve is read."},
    {"", "value", "The number that goes in."},
    {"", "root", "The first bone of the chain."},
    {"", "tip", "The last bone of the chain: it goes to the target."},
    {"", "target", "Where the tip of the chain goes: a point in the scene."},
    {"", "pole_target", "A point that the elbow or knee points at. None: the chain bends as it did."},
};

/// The path without the number of a parent: "/parents/0/weight" has "parents/weight".
bool is_path_of(std::string_view path, std::string_view input) {
    const std::size_t slash = input.find('/');
    if (slash == input.npos) return path.ends_with(input) && path[path.size() - input.size() - 1] == '/';
    const std::string_view group = input.substr(0, slash);
    return path.starts_with('/') && path.substr(1).starts_with(group) && path.ends_with(input.substr(slash));
}

constexpr struct {
    const char* operation;
    const char* text;
} operations[] = {
    {"aim", "Turns an element so that one of its axes points at a target."},
    {"aim_math", "As Aim, on a transform that it is given: hands out the result and moves nothing."},
    {"parent_constraint", "Lets an element follow one or more others, by weight."},
    {"offset_transform", "Moves, turns and scales an element in its own space."},
    {"set_transform", "Gives an element a transform."},
    {"set_rotation", "Gives an element a rotation; its place stays."},
    {"project_to_parent", "Hands out where an element would be, were it fastened to another parent."},
    {"from_two_vectors", "Hands out the shortest rotation from one direction to another."},
    {"transform_location", "Hands out where a point of a transform's own space is in the scene."},
    {"transform_direction", "Hands out a direction of a transform's own space, as it is in the scene."},
    {"for_each", "Runs other units on each element of a chain or a tree."},
    {"alpha_interpolate", "Maps, scales, clamps and eases a number."},
    {"spring_interpolate", "Follows a number, a vector or a rotation with a spring."},
    {"evaluate_curve", "Hands out a number read from a curve."},
    {"set_curve", "Writes a number into a named curve."},
    {"two_bone", "Turns two bones so that the tip reaches a target."},
    {"fabrik", "Turns a chain of bones so that its tip reaches a target."},
};

}  // namespace

const char* input_help(std::string_view operation, std::string_view path) {
    for (const Help& help : helps)
        if (is_path_of(path, help.input) && (*help.operation == '\0' || operation == help.operation))
            return help.text;
    return "";
}

const char* operation_help(std::string_view operation) {
    for (const auto& each : operations)
        if (operation == each.operation) return each.text;
    return "";
}

}  // namespace tendril::app
