// The parameters of the selected filter, from the library's table; a curve also has its editor, a spring its
// other two descriptions.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/document/json_complete.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/parameter_help.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/widgets/curve_editor.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

/// "critical_damping" as "critical damping".
std::string words(std::string_view name) {
    std::string text(name);
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

std::string format_of(const signal::Parameter& parameter) {
    const std::string unit(parameter.unit);
    if (unit.empty()) return "%.3f";
    return "%.3f " + (unit == "1/s^2" ? std::string("/s\xc2\xb2") : unit == "1/s" ? std::string("/s") : unit);
}

void number_row(const signal::Filter& filter, const signal::Parameter& parameter, std::size_t at,
                Emit& emit) {
    std::string title = words(parameter.name);
    if (parameter.element >= 0) title += parameter.element == 0 ? " low" : " high";
    float value = static_cast<float>(parameter.get(filter));
    const float low = static_cast<float>(parameter.low), high = static_cast<float>(parameter.high);
    const float speed =
        parameter.logarithmic ? std::max(0.01f * std::abs(value), 1e-4f) : 0.005f * (high - low);
    // What is beyond the useful range can be typed.
    const bool changed = number_field(title.c_str(), value, speed, std::min(low, value),
                                      std::max(high, value), format_of(parameter).c_str());
    explain(parameter_help(signal::kind(filter), parameter.name));
    if (!changed) return;
    ArgumentValue argument(value);
    if (parameter.element >= 0) {
        Json pair = parameters_json(filter).at(std::string(parameter.name));
        pair[static_cast<std::size_t>(parameter.element)] = value;
        argument = ArgumentValue(SharedJson(std::move(pair)));
    }
    emit.continuously("signal.filter.set", {{"at", at}, {std::string(parameter.name), std::move(argument)}});
}

/// The same spring by half-life, and by duration and bounce: all three at once, any of them set.
void spring_rows(const signal::Spring<>& spring, std::size_t at, Emit& emit) {
    const signal::SpringFeel feel = signal::feel_of(spring.strength, spring.critical_damping);
    const auto set = [&](const Expected<signal::SpringShape>& shape) {
        if (!shape) return;
        emit.continuously(
            "signal.filter.set",
            {{"at", at}, {"strength", shape->strength}, {"critical_damping", shape->critical_damping}});
    };
    if (std::isfinite(feel.half_life)) {
        float half_life = static_cast<float>(feel.half_life);
        if (number_field("half-life", half_life, 0.002f, 0.001f, 10.0f, "%.3f s"))
            set(signal::of_half_life(static_cast<double>(half_life), spring.critical_damping));
        explain("The same spring by the time until half of the way is left. Sets strength; damping stays.");
    }
    if (std::isfinite(feel.duration)) {
        float duration = static_cast<float>(feel.duration), bounce = static_cast<float>(feel.bounce);
        bool changed = number_field("duration", duration, 0.005f, 0.01f, 10.0f, "%.3f s");
        explain("The same spring by the time of one swing without damping. Sets strength.");
        changed |= number_field("bounce", bounce, 0.005f, -0.9f, 1.0f, "%.3f");
        explain(
            "How much the spring overshoots: 0 does not, 1 swings for ever, less than 0 is sluggish. Sets "
            "the "
            "damping.");
        if (changed) set(signal::of_duration(static_cast<double>(duration), static_cast<double>(bounce)));
    }
}

}  // namespace

void parameter_rows(const SignalPart& part, const Palette& palette, Emit& emit) {
    if (!part.selected || *part.selected >= part.stages.size()) return;
    const std::size_t at = *part.selected;
    const signal::Filter& filter = part.stages[at].filter;
    section(kind_title(filter).c_str());
    ImGui::PushID(static_cast<int>(at));
    for (const signal::Parameter& parameter : signal::kind_of(filter).parameters) {
        if (parameter.type == signal::ParameterType::Number) {
            number_row(filter, parameter, at, emit);
            continue;
        }
        bool on = parameter.get(filter) != 0.0;
        if (ImGui::Checkbox(words(parameter.name).c_str(), &on))
            emit("signal.filter.set", {{"at", at}, {std::string(parameter.name), on}});
        explain(parameter_help(signal::kind(filter), parameter.name));
    }
    if (const auto* spring = std::get_if<signal::Spring<>>(&filter)) spring_rows(*spring, at, emit);
    if (const auto* curve = std::get_if<signal::Curve>(&filter)) {
        signal::Curve edited = *curve;
        const double before = at > 0 ? output_of(part, at - 1) : input_of(part);
        const double range = curve->source_max - curve->source_min;
        const double input = range != 0.0 ? (before - curve->source_min) / range : 0.0;
        if (curve_editor("curve", edited, stage_colour(palette, part, at), 11.0f, input))
            emit.continuously("signal.filter.set",
                              {{"at", at}, {"keys", SharedJson(parameters_json(edited).at("keys"))}});
        note("Drag a key. Double-click adds one, right-click removes it.");
    }
    ImGui::PopID();
}

}  // namespace tendril::app
