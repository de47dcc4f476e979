#include "app/labs/signal/presets.hpp"

namespace tendril::app {
namespace {

SignalPart part_with(std::vector<SignalStage> stages, InputKind input, double period, SignalPlot plot) {
    SignalPart part;
    part.stages = std::move(stages);
    part.input.kind = input;
    part.input.period = period;
    part.plot = plot;
    part.selected = 0;
    return part;
}

SignalPart engine_against_exact() {
    return part_with({{signal::InterpTo{.speed = 10.0}}, {signal::InterpToExact{.speed = 10.0}, false}},
                     InputKind::Square, 2.0, SignalPlot::Rates);
}

/// Barely unstable at 60 Hz; at 30 Hz it diverges within a tenth of a second.
SignalPart spring_that_explodes() {
    return part_with({{signal::SpringSemiImplicit{.strength = 8.0, .critical_damping = 1.0}},
                      {signal::Spring<>{.strength = 8.0, .critical_damping = 1.0}, false}},
                     InputKind::Square, 2.0, SignalPlot::Rates);
}

SignalPart lag_is_what_you_pay() {
    return part_with({{signal::OneEuro{.min_cutoff = 1.0, .beta = 0.5, .derivative_cutoff = 1.0}}},
                     InputKind::Noise, 4.0, SignalPlot::Shelf);
}

SignalPart faster_but_no_bouncier() {
    return part_with({{signal::Spring<>{.strength = 1.5, .critical_damping = 0.5}},
                      {signal::Spring<>{.strength = 4.0, .critical_damping = 0.5}, false}},
                     InputKind::Square, 4.0, SignalPlot::Rates);
}

SignalPart four_filters() {
    signal::ScaleBiasClamp clamp;
    clamp.clamp = true;
    clamp.clamp_min = -0.8;
    clamp.clamp_max = 0.8;
    return part_with({{signal::OneEuro{.min_cutoff = 1.5, .beta = 0.6}},
                      {signal::DeadZone{.width = 0.12}},
                      {clamp},
                      {signal::Spring<>{.strength = 2.5, .critical_damping = 0.4}}},
                     InputKind::Noise, 4.0, SignalPlot::Rates);
}

}  // namespace

const std::vector<SignalPreset>& signal_presets() {
    static const std::vector<SignalPreset> list{
        {"spring", "A spring", "A spring follows a jump: turn its strength and its damping.", first_signal},
        {"engine_against_exact", "Engine against exact",
         "An engine's interp_to comes out differently at every frame rate. Switch it off and the exact one "
         "on: the curves close up.",
         engine_against_exact},
        {"spring_that_explodes", "The spring that explodes",
         "The spring that most games use needs more than 60.7 frames a second at 8 Hz. Switch it off and the "
         "exact one on: it copes with any frame rate.",
         spring_that_explodes},
        {"lag_is_what_you_pay", "Lag is what you pay",
         "Less jitter costs more lag. Change a parameter and watch its point move.", lag_is_what_you_pay},
        {"faster_but_no_bouncier", "Faster but no bouncier",
         "Strength alone makes a spring faster: its overshoot is set by the damping.",
         faster_but_no_bouncier},
        {"four_filters", "Four filters", "Smooth, ignore what is small, clamp, and swing.", four_filters}};
    return list;
}

}  // namespace tendril::app
