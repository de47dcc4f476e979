#include "app/labs/signal/filter_fields.hpp"

#include <array>

namespace tendril::app {
namespace {

constexpr FieldText text(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .decimals = 3};
}
constexpr FieldText rare(const char* name, const char* label, const char* help) {
    return {.name = name, .label = label, .help = help, .decimals = 3, .more = true};
}

constexpr FieldText interp_to[]{
    text("speed", "speed",
         "How fast the output follows: a frame covers this times its seconds of the distance left, so the "
         "result depends on the frame rate. At 0 or less the output jumps to the input.")};
constexpr FieldText interp_to_exact[]{
    text("speed", "speed",
         "How fast the distance to the input shrinks: higher follows faster, the same at any frame rate. At "
         "0 or less the output jumps to the input.")};
constexpr FieldText scale_bias_clamp[]{
    text("map_range", "map range", "First step: maps the in range to the out range, beyond its ends too."),
    text("in_range", "in range", "The range that is mapped. Only with map range."),
    text("out_range", "out range", "What the ends of the in range become. Only with map range."),
    text("scale", "scale", "Second step: the value is multiplied by this, then the bias is added."),
    text("bias", "bias", "Second step: added after the value is multiplied by scale."),
    text("clamp", "clamp", "Third step: keeps the value between clamp min and clamp max."),
    text("clamp_min", "clamp min", "The minimum of the value. Only with clamp; not above clamp max."),
    text("clamp_max", "clamp max", "The maximum of the value. Only with clamp; not below clamp min."),
    text("interp", "interp", "Last step: eases towards the value, as the filter Interp to does."),
    text("speed_increasing", "speed increasing",
         "How fast it eases while the value rises. Only with interp."),
    text("speed_decreasing", "speed decreasing",
         "How fast it eases while the value falls. Only with interp.")};
constexpr FieldText critical_damping = text("critical_damping", "damping",
                                            "How soon swinging stops: 0 swings for ever, 1 is the fastest "
                                            "that does not overshoot, more is sluggish.");
constexpr FieldText spring[]{
    text("strength", "strength",
         "How many times a second the spring would swing without damping. Higher follows faster. At 0 there "
         "is no spring."),
    critical_damping,
    rare("force", "force", "A constant acceleration of the output: shifts where it comes to rest."),
    rare("target_velocity_amount", "target velocity",
         "How much of the input's velocity the spring takes into account: at 1 it follows steady motion "
         "without lag, and jumps overshoot.")};
constexpr FieldText exponential_decay[]{text(
    "halflife", "halflife",
    "How long it takes until half of the distance to the input is left. More is smoother and lags more.")};
constexpr FieldText rate_limit[]{text("rise", "rise", "How fast the output may rise."),
                                 text("fall", "fall", "How fast the output may fall.")};
constexpr FieldText smooth_damp[]{
    text("smooth_time", "smooth time",
         "How smooth the output is: about the time by which it lags. More is smoother."),
    text("max_speed", "max speed",
         "Limits how fast the output moves: the distance to the input counts only up to this times smooth "
         "time.")};
constexpr FieldText spring_semi_implicit[]{
    text("strength", "strength",
         "How many times a second the spring would swing without damping. Higher follows faster; too high "
         "for the frame rate and the output swings ever wider."),
    critical_damping};
constexpr FieldText one_euro[]{
    text("min_cutoff", "min cutoff",
         "The cutoff of the low pass while the input rests. Lower it until a still hand no longer trembles."),
    text("beta", "beta",
         "By how much the cutoff rises with the input's speed. Raise it until fast motion no longer lags."),
    rare("derivative_cutoff", "derivative cutoff",
         "The cutoff of the low pass on the speed itself. Lower it where noise is taken for speed."),
    {.name = "reset_jump",
     .label = "reset jump",
     .help = "Restarts the filter at the input if the two are farther apart than this, as when a tracked "
             "hand is lost and found. 0: never.",
     .decimals = 3,
     .at_zero = "never",
     .more = true}};
constexpr FieldText moving_average[]{
    text("window", "window",
         "The output is the mean of the input over this time. More is smoother and lags more.")};
constexpr FieldText dead_zone[]{
    text("width", "width", "Inputs within this of 0 give 0; others are moved towards 0 by it.")};
constexpr FieldText hysteresis[]{
    text("low", "low", "At this input and below, the output becomes 0. Not above high."),
    text("high", "high",
         "At this input and above, the output becomes 1. Between the two it stays as it was.")};
constexpr FieldText inertialize[]{
    text("halflife", "halflife", "How long it takes until half of a jump is left."),
    text("threshold", "threshold",
         "A change of the input by more than this in one step counts as a jump, which is smoothed; all else "
         "passes.")};
constexpr FieldText curve[]{
    text("source_min", "source min", "The input that is at the left end of the curve."),
    text("source_max", "source max", "The input that is at the right end of the curve."),
    text("target_min", "target min", "The output where the curve is at 0."),
    text("target_max", "target max", "The output where the curve is at 1.")};

/// In the order of signal::Filter's alternatives.
constexpr std::array<std::span<const FieldText>, std::variant_size_v<signal::Filter>> all{
    interp_to,  interp_to_exact, scale_bias_clamp,     spring,   exponential_decay,
    rate_limit, smooth_damp,     spring_semi_implicit, one_euro, moving_average,
    dead_zone,  hysteresis,      inertialize,          curve};

}  // namespace

std::span<const FieldText> filter_texts(const signal::Kind& kind) {
    return all[static_cast<std::size_t>(&kind - signal::kinds().data())];
}

}  // namespace tendril::app
