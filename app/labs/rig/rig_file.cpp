// The Rig lab in a scene file: the definition, in the words of the commands, and beside it the state, the
// take that it is in, and the clip.
#include <stdexcept>
#include <utility>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/state_json.hpp"
#include "app/labs/rig/time_json.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

Json save_backward(const RigPart& part) {
    if (!part.backward) return nullptr;
    Json elements = Json::object();
    for (std::size_t i = 0; i < part.backward->elements.size(); ++i) {
        const rig::Element& element = part.rig.definition().elements[i];
        const rig::Residual& left = part.backward->elements[i];
        if (element.kind == rig::ElementKind::Bone)
            elements[element.name] = Json::array({left.metres, left.radians, left.scale});
    }
    return Json{
        {"bone", part.backward->bone}, {"left", std::move(elements)}, {"stopped", part.backward->stopped}};
}

BackwardLeft load_backward(const JsonPlace& place, const rig::Definition& definition) {
    check_members(place, {"bone", "left", "stopped"});
    BackwardLeft left{place["bone"].text(), {}};
    if (const auto stopped = place.optional("stopped")) left.stopped = stopped->flag();
    left.elements.resize(definition.elements.size());
    for (std::size_t i = 0; i < left.elements.size(); ++i) {
        if (definition.elements[i].kind != rig::ElementKind::Bone) continue;
        const JsonPlace numbers = place["left"][definition.elements[i].name.c_str()];
        numbers.check_size(3, "numbers: metres, radians, scale");
        const auto left_of = [&](std::size_t part) { return numbers.element(part).real(0.0, max_reached); };
        left.elements[i] = {left_of(0), left_of(1), left_of(2)};
    }
    return left;
}

/// "element" is the active one; "elements" are all, where there are several.
Selection load_elements(const JsonPlace& place, const rig::Rig& rig) {
    const auto active = rig.element(place["element"].text());
    const auto several = place.optional("elements");
    std::vector<std::size_t> all;
    if (several)
        several->for_each("elements", rig.definition().elements.size(), [&](const JsonPlace& each) {
            const auto at = rig.element(each.text());
            if (!at) each.fail("there is no element " + json_summary(each.json()));
            all.push_back(*at);
        });
    Selection selection;
    selection.take(all, false);
    if (several && !(active && selection.has(*active)))
        place["element"].fail("is not among those that are selected");
    if (active) selection.take({*active}, true);
    return selection;
}

}  // namespace

Json RigPart::save() const {
    Json json = definition_json(rig.definition());
    Json& saved = json["state"] = rig_state_json(rig, state);
    saved["moving"] = moving;
    saved["backward"] = save_backward(*this);
    saved["selected"] = {{"element", selected_element()}, {"unit", selected.unit}};
    if (selected.elements.several()) saved["selected"]["elements"] = names_of(*this, selected.elements.all());
    if (selected.unit_last) saved["selected"]["unit_last"] = true;
    if (flips != FlipRule()) saved["flips"] = save_flip_rule(flips);
    save_time(*this, saved);
    return json;
}

std::shared_ptr<Part> RigPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    check_members(place, {"elements", "curves", "units", "state"});
    auto part = std::make_shared<RigPart>();
    try {
        *part = RigPart(read_definition(place));
    } catch (const std::logic_error& error) {  // the library's own words, told where in the file
        place.fail(error.what());
    }
    const auto state_place = place.optional("state");
    if (!state_place) return part;  // a rig that was written by hand begins at rest
    check_members(*state_place, {"moving", "controls", "curves", "poses", "units", "backward", "selected",
                                 "motions", "take", "rates", "clip", "flips"});
    part->moving = (*state_place)["moving"].flag();
    part->state = read_rig_state(*state_place, part->rig);
    part->edited = true;  // how it was last solved, the file does not say
    load_time(*state_place, *part);
    if (const auto rule = state_place->optional("flips")) part->flips = load_flip_rule(*rule);
    if (const auto backward_place = state_place->optional("backward"))
        part->backward = load_backward(*backward_place, part->rig.definition());
    if (const auto selection = state_place->optional("selected")) {
        check_members(*selection, {"element", "elements", "unit", "unit_last"});
        part->selected = {load_elements(*selection, part->rig), (*selection)["unit"].text(),
                          selection->has("unit_last") && (*selection)["unit_last"].flag()};
        forget_missing_unit(*part);
    }
    return part;
}

}  // namespace tendril::app
