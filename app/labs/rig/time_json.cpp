#include "app/labs/rig/time_json.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tendril/rig/control.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/clip_json.hpp"
#include "app/labs/rig/rates.hpp"
#include "app/labs/rig/state_json.hpp"
#include "app/labs/rig/value_json.hpp"
#include "app/labs/rig/walk.hpp"

namespace tendril::app {
namespace {

constexpr std::uint64_t max_recording_tick = 1'000'000'000'000;  ///< ticks

/// [tick, name, value], or [tick] where the rig was solved.
Json keys_json(const RigPart& part) {
    Json keys = Json::array();
    for (const TakeKey& key : *part.take.keys) {
        if (key.element == TakeKey::solve) {
            keys.push_back(Json::array({key.tick}));
            continue;
        }
        const rig::Element& element = part.rig.definition().elements[key.element];
        keys.push_back({key.tick, element.name, control_value_json(element.control->kind, key.value)});
    }
    return keys;
}

TakeKey read_key(const JsonPlace& place, const RigPart& part) {
    if (place.json().is_array() && place.json().size() == 1)
        return {static_cast<std::uint32_t>(place.element(0).count(max_take_ticks)), TakeKey::solve};
    place.check_size(3, "values: tick, control, value");
    const auto at = part.rig.element(place.element(1).text());
    if (!at || !part.rig.definition().elements[*at].control)
        place.element(1).fail("there is no control " + json_summary(place.element(1).json()));
    const rig::Control& control = *part.rig.definition().elements[*at].control;
    const rig::Value value =
        read_control_value(place.element(2), control.kind, part.state.controls[*at], max_reached);
    check_unit(place.element(2), value);
    return {static_cast<std::uint32_t>(place.element(0).count(max_take_ticks)),
            static_cast<std::uint32_t>(*at), rig::clamped(control, value)};
}

Json take_json(const RigPart& part) {
    const RigTake& take = part.take;
    Json json{{"began", take.began}};
    if (!take.start) return json;
    json["tick"] = take.tick;
    json["last"] = take.last;
    json["start"] = rig_state_json(part.rig, *take.start);
    if (take.keys) json["keys"] = keys_json(part);
    return json;
}

RigTake read_take(const JsonPlace& place, const RigPart& part) {
    check_members(place, {"began", "tick", "last", "start", "keys"});
    RigTake take{.start = nullptr,
                 .keys = nullptr,
                 .tick = 0,
                 .last = 0,
                 .began = place["began"].count(max_recording_tick)};
    if (!place.has("start")) return take;
    check_members(place["start"], {"controls", "curves", "poses", "units"});
    take.start = std::make_shared<const rig::State>(read_rig_state(place["start"], part.rig));
    take.last = static_cast<std::uint32_t>(place["last"].count(max_take_ticks));
    take.tick = static_cast<std::uint32_t>(place["tick"].count(take.last));
    if (const auto stored = place.optional("keys")) {
        std::vector<TakeKey> keys;
        stored->for_each("keys", max_take_keys,
                         [&](const JsonPlace& each) { keys.push_back(read_key(each, part)); });
        if (!std::ranges::is_sorted(keys, {}, &TakeKey::tick))
            stored->fail("expected the keys in the order of their ticks");
        take.keys = std::make_shared<const std::vector<TakeKey>>(std::move(keys));
    }
    return take;
}

RigWalk read_walk(const JsonPlace& place, const std::string& control, const RigPart& part) {
    check_members(place, {"path", "centre", "radius", "period", "ticks", "turn"});
    const auto at = part.rig.element(control);
    const rig::Element* element = at ? &part.rig.definition().elements[*at] : nullptr;
    if (!element || !element->control || !can_walk(element->control->kind))
        place.fail("there is no transform or position control of that name");
    const RigWalk walk{control, load_motion(place), place["turn"].flag()};
    if (walk.motion.path == Motion::Path::Still)
        place["path"].fail("a control that stands still has no motion");
    try {
        check_path(walk.motion.centre, glm::vec3(walk.motion.radius), "the control's path");
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
    return walk;
}

RateDifference read_rates(const JsonPlace& place) {
    check_members(place, {"mm", "degrees", "scale", "bone", "between", "seconds", "ticks", "frames", "done",
                          "running"});
    const auto scale = place.optional("scale");
    const std::size_t frames = place.has("frames") ? place["frames"].index(max_rate_frames) : 0;
    return {.mm = place["mm"].real(0.0, max_reached),
            .degrees = place["degrees"].real(0.0, 360.0),
            .scale = scale ? scale->real(0.0, max_reached) : 0.0,
            .bone = place["bone"].text(),
            .between = place["between"].text(),
            .seconds = place["seconds"].real(0.0, 1e9),
            .ticks = place["ticks"].real(0.0, 1e9),
            .frames = frames,
            .done = place.has("done") ? place["done"].index(frames) : 0,
            .running = place.has("running") && place["running"].flag()};
}

/// One that goes on can only be of so many frames as there are in its time.
RateDifference read_rates(const JsonPlace& place, const RigPart& part) {
    RateDifference rates = read_rates(place);
    if (!rates.running) return rates;
    RigPart begun = part;
    const double max_ticks = max_rate_seconds / tick_seconds;
    if (!(rates.ticks >= 1.0 && rates.ticks <= max_ticks && rates.ticks == std::floor(rates.ticks)))
        place["ticks"].fail("expected 1 to " + std::to_string(std::lround(max_ticks)) + ", whole");
    try {
        start_rates(begun, static_cast<std::uint32_t>(rates.ticks));
    } catch (const std::invalid_argument& refusal) {
        place.fail(refusal.what());
    }
    if (rates.frames != begun.rates->frames || rates.done >= rates.frames)
        place["frames"].fail("that is not how far such a comparison comes");
    return rates;
}

}  // namespace

Json walks_json(const RigPart& part) {
    Json walks = Json::object();
    for (const RigWalk& walk : part.walks) {
        walks[walk.control] = save_motion(walk.motion);
        walks[walk.control]["turn"] = walk.turn;
    }
    return walks;
}

Json rates_json(const RigPart& part) {
    if (!part.rates) return nullptr;
    const RateDifference& most = *part.rates;
    return {{"mm", most.mm},          {"degrees", most.degrees}, {"scale", most.scale},
            {"bone", most.bone},      {"between", most.between}, {"seconds", most.seconds},
            {"ticks", most.ticks},    {"frames", most.frames},   {"done", most.done},
            {"running", most.running}};
}

void save_time(const RigPart& part, Json& state) {
    state["take"] = take_json(part);
    if (!part.walks.empty()) state["motions"] = walks_json(part);
    if (part.rates) state["rates"] = rates_json(part);
    if (part.clip) state["clip"] = clip_json(part);
}

void load_time(const JsonPlace& state, RigPart& part) {
    if (const auto take = state.optional("take")) part.take = read_take(*take, part);
    if (const auto walks = state.optional("motions")) {
        if (!walks->json().is_object())
            walks->fail("expected an object, found " + json_summary(walks->json()));
        for (const auto& [name, stored] : walks->json().items())
            part.walks.push_back(read_walk((*walks)[name.c_str()], name, part));
    }
    if (const auto rates = state.optional("rates")) part.rates = read_rates(*rates, part);
    if (const auto clip = state.optional("clip")) load_clip(*clip, part);
}

}  // namespace tendril::app
