// The Signal lab in scene files.
#include <algorithm>

#include "app/fields/fields.hpp"
#include "app/fields/input_json.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/signal/filter_json.hpp"
#include "app/labs/signal/signal_lab.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "app/view/assets.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SignalInput>() noexcept {
    using app::SignalInput;
    static constexpr auto kinds = app::input_kinds.name_array();
    constexpr FieldRange amplitudes{-app::max_amplitude, app::max_amplitude};
    static constexpr Field rows[] = {
        field<&SignalInput::kind>("kind", kinds), field<&SignalInput::amplitude>("amplitude", amplitudes),
        field<&SignalInput::period>("period", {app::min_input_period, app::max_input_period}),
        field<&SignalInput::hand>("hand", amplitudes)};
    return rows;
}
template <>
std::span<const tendril::Field> tendril::fields<tendril::app::SignalStage>() noexcept {
    using app::SignalStage;
    static constexpr Field rows[] = {kinds<&SignalStage::filter>("kind", signal::kind_names),
                                     field<&SignalStage::enabled>("enabled"),
                                     field<&SignalStage::beside>("beside"),
                                     field<&SignalStage::colour>("colour", {0, app::max_stages - 1})};
    return rows;
}

namespace tendril::app {
namespace {

Json save_rows(const InputRows& rows) {
    Json json = Json::array();
    for (const signal::Sample& row : rows) json.push_back(Json::array({row.dt, row.input}));
    return json;
}

InputRows load_rows(const JsonPlace& place, const char* key, std::size_t most) {
    InputRows rows;
    place.for_each(key, most, [&](const JsonPlace& each) {
        each.check_size(2, "numbers, dt and input");
        rows.push_back({each.element(0).real(), each.element(1).real()});
    });
    return rows;
}

Json save_input(const SignalInput& input) {
    Json json = save_fields(input);
    if (input.recording) json["recording"] = save_rows(*input.recording);
    if (!input.file) return json;
    json["path"] = input.path;
    json["rows"] = save_rows(*input.file);
    return json;
}

SignalInput load_input(const JsonPlace& place) {
    const std::vector<std::string_view> others{"recording", "path", "rows"};
    SignalInput input;
    load_known_fields(place, input, others);
    const auto rows = [&](const char* name, std::shared_ptr<const InputRows>& into) {
        if (const auto given = place.optional(name))
            into = std::make_shared<const InputRows>(load_rows(*given, "rows", max_input_rows));
    };
    rows("recording", input.recording), rows("rows", input.file);
    if (input.file) input.path = place["path"].text();
    const bool missing = (input.kind == InputKind::Recorded && length_of(input.recording.get()) <= 0.0) ||
                         (input.kind == InputKind::Csv && length_of(input.file.get()) <= 0.0);
    if (missing) place["kind"].fail("there is nothing to play");
    return input;
}

/// A preset's stage has no state, and by default the colour of its place.
SignalStage load_stage(const JsonPlace& place, std::size_t at, bool preset = false) {
    SignalStage stage;
    load_known_fields(place, stage, {"state"});
    check_filter(place, stage.filter);
    if (!place.has("colour")) stage.colour = static_cast<int>(at);
    if (!preset) stage.state = filter_state_from_json(place["state"]);
    return stage;
}

Json save_stage(const SignalStage& stage) {
    Json json = save_fields(stage);
    json["state"] = filter_state_json(stage.state);
    return json;
}

Json save_fits(const SignalPart& part) {
    Json fits = Json::array();
    for (const Fit& fit : part.fits)
        fits.push_back(
            {{"filter", filter_json(fit.filter)}, {"residual", std::min(fit.residual, max_residual)}});
    Json json{{"input", save_rows(part.fit_input)}, {"wanted", part.wanted}, {"ranking", std::move(fits)}};
    if (const auto& recording = part.recording)
        json["recording"] = {
            {"value", recording->value}, {"rows", recording->rows}, {"begun", recording->begun}};
    if (part.fitting) {
        Json from = Json::array();
        for (const signal::Filter& filter : part.fitting->from) from.push_back(filter_json(filter));
        json["fitting"] = {{"from", std::move(from)}, {"shares", part.fitting->shares}};
    }
    return json;
}

/// A fit in progress.
Fitting load_fitting(const SignalPart& part, const JsonPlace& place) {
    constexpr std::size_t max_shares = 1000;
    if (part.wanted.size() < 2 || part.recording) place.fail("there is no response to fit to");
    if (part.fits.size() >= signal::kinds().size()) place.fail("every kind is fitted already");
    return {filters_from_json(place["from"], max_stages), place["shares"].index(max_shares)};
}

void load_fits(SignalPart& part, const JsonPlace& place) {
    check_members(place, {"input", "wanted", "recording", "ranking", "fitting"});
    part.fit_input = load_rows(place["input"], "rows", max_wanted);
    place["wanted"].for_each("values", max_wanted,
                             [&](const JsonPlace& each) { part.wanted.push_back(each.real()); });
    if (part.wanted.size() != part.fit_input.size()) place.fail("input and wanted have different lengths");
    if (const auto recording = place.optional("recording")) {
        if (part.wanted.size() < 2) recording->fail("there is no input to respond to");
        part.recording = {(*recording)["value"].real(-max_amplitude, max_amplitude),
                          (*recording)["rows"].index(part.wanted.size() - 1), (*recording)["begun"].flag()};
    }
    place["ranking"].for_each("fits", 100, [&](const JsonPlace& each) {
        part.fits.push_back({filter_from_json(each["filter"]), each["residual"].real(0.0, max_residual), 0});
    });
    if (const auto fitting = place.optional("fitting")) part.fitting = load_fitting(part, *fitting);
}

}  // namespace

Json SignalPart::save() const {
    Json list = Json::array();
    for (const SignalStage& stage : stages) list.push_back(save_stage(stage));
    return Json{{"filters", std::move(list)},
                {"input", save_input(input)},
                {"time", time},
                {"past", save_rows(past)},
                {"selected", selected ? Json(*selected) : Json(nullptr)},
                {"plot", signal_plots.name(plot)},
                {"fit", save_fits(*this)}};
}

std::shared_ptr<Part> SignalPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    check_members(place, {"filters", "input", "time", "past", "selected", "plot", "fit"});
    auto part = std::make_shared<SignalPart>();
    place["filters"].for_each("filters", max_stages, [&](const JsonPlace& each) {
        part->stages.push_back(load_stage(each, part->stages.size()));
    });
    part->input = load_input(place["input"]);
    part->time = place["time"].real(0.0, 1e9);
    part->past = load_rows(place["past"], "rows", max_past);
    if (const auto chosen = place.optional("selected")) {
        if (part->stages.empty()) chosen->fail("there is no filter");
        part->selected = chosen->index(part->stages.size() - 1);
    }
    part->plot = place["plot"].choice(signal_plots);
    load_fits(*part, place["fit"]);
    return part;
}

namespace {

SignalPart load_preset(const JsonPlace& place) {
    SignalPart part;
    place["filters"].for_each("filters", max_stages, [&](const JsonPlace& each) {
        part.stages.push_back(load_stage(each, part.stages.size(), true));
    });
    if (place.has("input")) part.input = load_input(place["input"]);
    if (place.has("plot")) part.plot = place["plot"].choice(signal_plots);
    part.selected = 0;
    return part;
}

}  // namespace

const std::vector<SignalPreset>& signal_presets() {
    static const std::vector<SignalPreset> list = [] {
        std::vector<SignalPreset> all;
        for (const Json& each : parse_json(presets_source(signal_lab)))
            all.push_back({each.at("name"), each.at("title"), each.at("point"),
                           load_preset({each, each.at("name").get<std::string>()})});
        return all;
    }();
    return list;
}

}  // namespace tendril::app
