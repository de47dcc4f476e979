// The parameters of the selected filter, from the library's table; a curve also has its editor, a spring its
// other two descriptions.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/document/json_complete.hpp"
#include "app/fields/field_rows.hpp"
#include "app/labs/signal/filter_fields.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/panels.hpp"
#include "app/labs/signal/scene.hpp"
#include "app/widgets/curve_editor.hpp"
#include "app/widgets/fields.hpp"

namespace tendril::app {
namespace {

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
    FieldRows(filter_fields(filter), filter_texts(signal::kind_of(filter)), "signal.filter.set", emit,
              {{"at", at}})
        .all();
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
