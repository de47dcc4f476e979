#include "app/labs/signal/parameter_help.hpp"

namespace tendril::app {
namespace {

struct Help {
    const char* kind;  ///< empty: whatever has a parameter of that name
    const char* parameter;
    const char* text;
};

constexpr Help helps[] = {
    {"interp_to", "speed",
     "How fast the output follows: a frame goes this times its seconds of the way that is left, so the "
     "result "
     "depends on the frame rate. At 0 or less the output jumps to the input."},
    {"interp_to_exact", "speed",
     "How fast the distance to the input shrinks: more follows faster, at any frame rate alike. At 0 or less "
     "the "
     "output jumps to the input."},
    {"scale_bias_clamp", "map_range", "First step: maps the in range to the out range, beyond its ends too."},
    {"scale_bias_clamp", "in_range", "An end of the range that is mapped. Only with map range."},
    {"scale_bias_clamp", "out_range", "What that end becomes. Only with map range."},
    {"scale_bias_clamp", "scale", "Second step: the value is multiplied by this, then the bias is added."},
    {"scale_bias_clamp", "bias", "Second step: added after the value is multiplied by scale."},
    {"scale_bias_clamp", "clamp", "Third step: keeps the value between clamp min and clamp max."},
    {"scale_bias_clamp", "clamp_min", "The minimum of the value. Only with clamp; not over clamp max."},
    {"scale_bias_clamp", "clamp_max", "The maximum of the value. Only with clamp; not under clamp min."},
    {"scale_bias_clamp", "interp", "Last step: eases towards the value, as the filter Interp to does."},
    {"scale_bias_clamp", "speed_increasing", "How fast it eases while the value rises. Only with interp."},
    {"scale_bias_clamp", "speed_decreasing", "How fast it eases while the value falls. Only with interp."},
    {"spring_semi_implicit", "strength",
     "How often a second the spring would swing without damping. More follows faster; too much for the frame "
     "rate "
     "and the output swings ever wider."},
    {"", "strength",
     "How often a second the spring would swing without damping. More follows faster. At 0 there is no "
     "spring."},
    {"", "critical_damping",
     "How soon swinging stops: 0 swings for ever, 1 is the fastest that does not overshoot, more is "
     "sluggish."},
    {"", "force", "A constant acceleration of the output: shifts where it comes to rest."},
    {"", "target_velocity_amount",
     "How much of the input's velocity the spring goes by: at 1 it follows steady motion without lag, and "
     "jumps "
     "overshoot."},
    {"exponential_decay", "halflife",
     "How long it takes until half of the distance to the input is left. More is smoother and lags more."},
    {"rate_limit", "rise", "How fast the output may rise."},
    {"rate_limit", "fall", "How fast the output may fall."},
    {"smooth_damp", "smooth_time",
     "How smooth the output is: about the time by which it lags. More is smoother."},
    {"smooth_damp", "max_speed",
     "Limits how fast the output moves: the distance to the input counts up to this times smooth time."},
    {"one_euro", "min_cutoff",
     "The cutoff of the low pass while the input rests. Lower it until a still hand no longer trembles."},
    {"one_euro", "beta",
     "By how much the cutoff rises with the input's speed. Raise it until fast motion no longer lags."},
    {"one_euro", "derivative_cutoff",
     "The cutoff of the low pass on the speed itself. Lower it where noise is taken for speed."},
    {"moving_average", "window",
     "The output is the mean of the input over this time. More is smoother and lags more."},
    {"dead_zone", "width", "Inputs as near to 0 as this give 0; others are brought nearer to 0 by it."},
    {"hysteresis", "low", "At this input and below the output turns to 0. Not over high."},
    {"hysteresis", "high", "From this input on the output turns to 1. Between both it stays as it was."},
    {"inertialize", "halflife", "How long it takes until half of a jump is left."},
    {"inertialize", "threshold",
     "A change of the input by more than this in one step counts as a jump, which is smoothed; all else "
     "passes."},
    {"curve", "source_min", "The input that is at the left end of the curve."},
    {"curve", "source_max", "The input that is at the right end of the curve."},
    {"curve", "target_min", "The output where the curve is at 0."},
    {"curve", "target_max", "The output where the curve is at 1."},
};

}  // namespace

const char* parameter_help(std::string_view kind, std::string_view parameter) {
    for (const Help& help : helps)
        if (parameter == help.parameter && (*help.kind == '\0' || kind == help.kind)) return help.text;
    return "";
}

}  // namespace tendril::app
