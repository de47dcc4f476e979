// The selected unit: what it reads, with a field for whatever is a literal, and what it hands out.
#include <imgui.h>

#include <algorithm>
#include <limits>

#include "app/document/json_complete.hpp"
#include "app/document/units.hpp"
#include "app/labs/kit/curve_json.hpp"
#include "app/labs/rig/input_help.hpp"
#include "app/labs/rig/input_offers.hpp"
#include "app/labs/rig/panels.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/value_text.hpp"
#include "app/widgets/curve_editor.hpp"
#include "app/widgets/fields.hpp"
#include "app/widgets/text.hpp"

namespace tendril::app {
namespace {

constexpr float max_literal = 1e9f;

bool is_weight(const UnitInput& input) {
    // Weights among the parents of a constraint are relative, and may be over 1.
    return input.path.ends_with("weight") && !input.path.starts_with("/parents");
}

class Fields {
  public:
    Fields(const RigPanel& panel, const UnitRow& row) : panel_(panel), row_(row) {}

    void row(const UnitInput& input) {
        input_ = &input;
        if (!input.literal()) return source_row();
        if (input.takes == UnitInput::Takes::Value) {
            chooser(input.title, nullptr);
            ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
        }
        std::visit([&](const auto& value) { field(value); }, input.value);
    }

  private:
    void set(Json value) const {
        const Json arguments = with_input(*row_.unit, input_->path, std::move(value));
        ArgumentList list;
        for (const auto& [key, each] : arguments.items()) list.push_back({key, SharedJson(each)});
        panel_.edit("rig.unit.set", list);
    }

    std::string help() const {
        return input_help(rig::operation_name(row_.unit->operation.index()), input_->path);
    }

    /// Where it comes from, and what it is now below that.
    void source_row() const {
        chooser(input_->title, &input_->from);
        if (const auto* value = std::get_if<rig::Value>(&input_->value))
            text_flush_right(elided(input_text(*input_, *value), ImGui::GetContentRegionAvail().x), true);
    }

    /// What else it may be, in a field that shows what it is, or behind a button.
    void chooser(const std::string& title, const std::string* shown, std::size_t index = 0) const {
        SearchText& typed = panel_.runtime.panel.choice;
        const bool open = begin_search(title.c_str(), shown, typed);
        if (!open && ImGui::IsItemHovered()) {
            if (shown != nullptr)
                ImGui::SetTooltip("%s: %s. Click for what else it may be\n%s", title.c_str(), shown->c_str(),
                                  help().c_str());
            else
                ImGui::SetTooltip("%s: takes it from an element or a unit", title.c_str());
        }
        if (!open) return;
        const std::vector<InputOffer> offers = input_offers(panel_.part, row_, *input_, index);
        if (offers.empty()) note("Nothing in this rig gives that.");
        for (const InputOffer& offer : offers)
            if (search_row(offer.title, offer.now, typed) && !offer.now) set(*offer.value);
        end_search();
    }

    void field(std::monostate) const {}
    void field(const rig::Value& value) {
        std::visit([&](const auto& literal) { literal_field(literal); }, value);
    }
    void field(const InputChoice& choice) const {
        int chosen = static_cast<int>(choice.chosen);
        if (choice_field(input_->title.c_str(), chosen, choice.names.data(),
                         static_cast<int>(choice.names.size())))
            set(choice.names[static_cast<std::size_t>(chosen)]);
        explain(help().c_str());
    }
    /// A box for each axis.
    void field(const InputFilter& filter) const {
        rig::TransformFilter passes = filter.passes;
        bool changed = false;
        ImGui::TextDisabled("%s", "passes on each axis");
        const auto axes = [&](const char* name, std::array<bool, 3>& on) {
            ImGui::AlignTextToFramePadding();
            ImGui::TextDisabled("%s", name);
            for (int i = 0; i < 3; ++i) {
                ImGui::SameLine(ImGui::GetWindowContentRegionMin().x +
                                (5.5f + 3.2f * static_cast<float>(i)) * ImGui::GetFontSize());
                const std::string label = std::string(1, "xyz"[i]) + "##" + name;
                changed |= ImGui::Checkbox(label.c_str(), &on[static_cast<std::size_t>(i)]);
                explain(help().c_str());
            }
        };
        axes("translation", passes.translation);
        axes("rotation", passes.rotation);
        axes("scale", passes.scale);
        if (changed)
            set({{"translation", passes.translation},
                 {"rotation", passes.rotation},
                 {"scale", passes.scale}});
    }
    void field(const InputRange& range) const {
        float low = static_cast<float>(range.low), high = static_cast<float>(range.high);
        const bool first =
            number_field((input_->title + " low").c_str(), low, 0.01f, -max_literal, max_literal, "%.3f");
        explain(help().c_str());
        const bool second =
            number_field((input_->title + " high").c_str(), high, 0.01f, -max_literal, max_literal, "%.3f");
        explain(help().c_str());
        if (first) set({number(low), range.high});
        if (second) set({range.low, number(high)});
    }
    void field(const InputNames& names) const {
        const std::string& title = input_->title;
        if (input_->takes != UnitInput::Takes::Roots) return chooser(title, &names.names.front());
        for (std::size_t i = 0; i < names.names.size(); ++i)
            chooser(names.names.size() > 1 ? "root " + std::to_string(i + 1) : "root", &names.names[i], i);
        const std::string another = "another";
        chooser("add a root", &another, names.names.size());
    }
    void field(const InputCurve& curve) const {
        signal::Curve edited = curve.curve;
        const auto& evaluate = std::get<rig::EvaluateCurve>(row_.unit->operation);
        const double width = edited.source_max - edited.source_min;
        double at = -1.0;  // shown nowhere
        if (const double* literal = evaluate.value.literal()) at = *literal;
        for (const UnitInput& each : unit_inputs(panel_.part, panel_.now, *row_.unit))
            if (const auto* value = std::get_if<rig::Value>(&each.value); value && each.path == "/value")
                if (const auto* number = std::get_if<double>(value)) at = *number;
        at = width != 0.0 ? (at - edited.source_min) / width : 0.0;
        if (curve_editor("curve", edited, panel_.colours.accent, 11.0f, at)) set(curve_json(edited));
        note("Drag a key. Double-click adds one, right-click removes it.");
        const auto end = [&](const char* name, double& value, const char* what) {
            float shown = static_cast<float>(value);
            const bool changed = number_field(name, shown, 0.01f, -max_literal, max_literal, "%.3f");
            explain(what);
            if (!changed) return;
            value = static_cast<double>(shown);
            set(curve_json(edited));
        };
        end("from low", edited.source_min, "The value that is at the left end of the curve.");
        end("from high", edited.source_max, "The value that is at the right end of the curve.");
        end("to low", edited.target_min, "The result where the curve is at 0.");
        end("to high", edited.target_max, "The result where the curve is at 1.");
    }

    void literal_field(bool on) const {
        if (ImGui::Checkbox(input_->title.c_str(), &on)) set(on);
        explain(help().c_str());
    }
    void literal_field(double value) const {
        float shown = static_cast<float>(value);
        const bool weight = is_weight(*input_);
        const std::string unit = input_->unit;
        const std::string format = is_speed_limit(*input_) ? "%.1f" + unit + (value > 0.0 ? "" : ", no limit")
                                   : unit.empty()          ? "%.3f"
                                                           : "%.3f " + unit;
        if (number_field(input_->title.c_str(), shown, weight ? 0.005f : 0.01f,
                         weight || *input_->unit != '\0' ? 0.0f : -max_literal, weight ? 1.0f : max_literal,
                         format.c_str()))
            set(number(shown));
        explain(help().c_str());
    }
    void literal_field(const glm::dvec3& value) const {
        const glm::vec3 shown(value);
        glm::vec3 edited = shown;
        if (vector_field(input_->title.c_str(), edited, 0.01f, glm::vec3(-max_literal),
                         glm::vec3(max_literal), "%.3f"))
            set(dpoint(edited_vector(value, shown, edited)));
        explain((help() + (*input_->unit != '\0' ? std::string(" In ") + input_->unit + '.' : "")).c_str());
    }
    void literal_field(const glm::dquat& value) const {
        glm::dquat rotation = value;
        if (rotation_field(panel_, (input_->title + ", degrees").c_str(), rotation))
            set(rotation_json(rotation));
    }
    void literal_field(const rig::Transform& value) const {
        ImGui::TextDisabled("%s", input_->title.c_str());
        if (const auto changed =
                transform_fields(panel_, value, glm::vec3(-max_literal), glm::vec3(max_literal))) {
            Json whole = transform_json(value);
            whole.update(**changed);
            set(whole);
        }
    }

    const RigPanel& panel_;
    const UnitRow& row_;
    const UnitInput* input_ = nullptr;
};

}  // namespace

void unit_inspector(const RigPanel& panel) {
    const auto row = unit_row(panel.part, panel.part.selected.unit);
    if (!row) return;
    section(elided("Unit: " + row->unit->name, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PushID("unit");
    std::string operation = rig::operation_name(row->unit->operation.index());
    std::replace(operation.begin(), operation.end(), '_', ' ');
    note(operation + (row->inner ? ", run on each element of its for-each" : "") +
         (row->unit->enabled ? "" : ", switched off"));
    if (row->unit->enabled) warning_line(panel, panel.part.state.units[row->at].warning);
    Fields fields(panel, *row);
    for (const UnitInput& input : unit_inputs(panel.part, panel.now, *row->unit)) {
        if (input.path == "/when" && row->unit->when == rig::Unit().when) continue;  // the switch does that
        ImGui::PushID(input.path.c_str());
        fields.row(input);
        ImGui::PopID();
    }
    const std::vector<rig::Output> outputs = rig::outputs(row->unit->operation);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        reading((std::string("gives ") + outputs[i].name).c_str(), "%s",
                output_text(row->unit->operation, panel.part.state.units[row->at].outputs[i]).c_str());
    if (row->inner) note("What it gives is of the last element of the for-each.");
    if (row_button("Close", 2, true, "Selects no unit")) select_unit(panel, "");
    end_row();
    ImGui::PopID();
}

}  // namespace tendril::app
