// The Rig lab in a scene file: the definition, named as in commands, plus the state, the take and the clip.
#include "app/labs/rig/rig_file.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tendril/rig/control.hpp>
#include <utility>

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/json_place.hpp"
#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/labs/rig/rig_edit.hpp"
#include "app/labs/rig/rig_part.hpp"
#include "app/labs/rig/state_json.hpp"
#include "app/labs/rig/take.hpp"
#include "app/labs/rig/values.hpp"

template <>
std::span<const tendril::Field> tendril::fields<tendril::app::RateDifference>() noexcept {
    using Rates = app::RateDifference;
    constexpr FieldRange reached{0.0, app::max_reached}, times{0.0, 1e9}, frames{0.0, app::max_rate_frames};
    static constexpr Field rows[] = {
        field<&Rates::mm>("mm", reached),       field<&Rates::degrees>("degrees", {0.0, 360.0}),
        field<&Rates::scale>("scale", reached), field<&Rates::bone>("bone"),
        field<&Rates::between>("between"),      field<&Rates::seconds>("seconds", times),
        field<&Rates::ticks>("ticks", times),   field<&Rates::frames>("frames", frames),
        field<&Rates::done>("done", frames),    field<&Rates::running>("running")};
    return rows;
}

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

/// "element" is the active one; "elements" lists all if several are selected.
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
        place["element"].fail("is not one of the selected elements");
    if (active) selection.take({*active}, true);
    return selection;
}

}  // namespace

Json RigPart::save() const {
    Json json = save_fields(rig.definition());
    Json& saved = json["state"] = rig_state_json(rig, state);
    saved["moving"] = moving;
    saved["backward"] = save_backward(*this);
    saved["selected"] = {{"element", selected_element()}, {"unit", selected.unit}};
    if (selected.elements.several()) saved["selected"]["elements"] = names_of(*this, selected.elements.all());
    if (selected.unit_last) saved["selected"]["unit_last"] = true;
    if (flips != FlipRule()) saved["flips"] = save_fields(flips);
    save_time(*this, saved);
    return json;
}

std::shared_ptr<Part> RigPart::load(const Json& json, const std::string& where) const {
    const JsonPlace place(json, where);
    check_members(place, {"elements", "curves", "units", "state"});
    auto part = std::make_shared<RigPart>();
    try {
        *part = RigPart(read_definition(place));
    } catch (const std::logic_error& error) {  // the library's message, with the JSON path
        place.fail(error.what());
    }
    const auto state_place = place.optional("state");
    if (!state_place) return part;  // a hand-written rig starts at rest
    check_members(*state_place, {"moving", "controls", "curves", "poses", "units", "backward", "selected",
                                 "motions", "take", "rates", "clip", "flips"});
    part->moving = (*state_place)["moving"].flag();
    part->state = read_rig_state(*state_place, part->rig);
    part->edited = true;  // the file does not store the last solved state
    load_time(*state_place, *part);
    if (const auto rule = state_place->optional("flips")) load_fields(*rule, part->flips);
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

namespace {

constexpr std::uint64_t max_recording_tick = 1'000'000'000'000;  ///< ticks

/// [tick, name, value], or [tick] for a solve.
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
    return {static_cast<std::uint32_t>(place.element(0).count(max_take_ticks)),
            static_cast<std::uint32_t>(*at),
            read_reached(place.element(2), control, part.state->controls[*at])};
}

Json take_json(const RigPart& part) {
    const RigTake& take = part.take;
    Json json{{"began", take.began}};
    if (take.recording) json["recording"] = true;
    if (!take.start) return json;
    json["tick"] = take.tick;
    json["last"] = take.last;
    json["start"] = rig_state_json(part.rig, *take.start);
    if (take.keys) json["keys"] = keys_json(part);
    return json;
}

RigTake read_take(const JsonPlace& place, const RigPart& part) {
    check_members(place, {"began", "recording", "tick", "last", "start", "keys"});
    RigTake take{.start = nullptr,
                 .keys = nullptr,
                 .tick = 0,
                 .last = 0,
                 .began = place["began"].count(max_recording_tick),
                 .recording = place.has("recording") && place["recording"].flag()};
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
            stored->fail("expected the keys in tick order");
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
    if (walk.motion.path == Motion::Path::Still) place["path"].fail("a control without a path has no motion");
    try {
        check_path(walk.motion.centre, glm::vec3(walk.motion.radius), "the control's path");
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
    return walk;
}

/// A running comparison must have as many frames as its ticks imply.
RateDifference read_rates(const JsonPlace& place, const RigPart& part) {
    RateDifference rates;
    load_known_fields(place,
                      {{rates, MissingField::Refused, {"scale", "frames", "done", "running"}}});  // newer
    if (rates.done > rates.frames) place["done"].fail("there are only " + std::to_string(rates.frames));
    if (!rates.running) return rates;
    RigPart begun = part;
    const double max_ticks = max_rate_seconds / tick_seconds;
    if (!(rates.ticks >= 1.0 && rates.ticks <= max_ticks && rates.ticks == std::floor(rates.ticks)))
        place["ticks"].fail("expected 1 to " + std::to_string(std::lround(max_ticks)) + " whole ticks");
    try {
        start_rates(begun, static_cast<std::uint32_t>(rates.ticks));
    } catch (const std::invalid_argument& refusal) {
        place.fail(refusal.what());
    }
    if (rates.frames != begun.rates->frames || rates.done >= rates.frames)
        place["frames"].fail("does not fit a running comparison of that length");
    return rates;
}

}  // namespace

Json walks_json(const RigPart& part) {
    Json walks = Json::object();
    for (const RigWalk& walk : part.walks) {
        walks[walk.control] = save_fields(walk.motion);
        walks[walk.control]["turn"] = walk.turn;
    }
    return walks;
}

void save_time(const RigPart& part, Json& state) {
    state["take"] = take_json(part);
    if (!part.walks.empty()) state["motions"] = walks_json(part);
    if (part.rates) state["rates"] = save_fields(*part.rates);
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

namespace {

using Numbers = std::vector<float>;

/// One component of a bone's pose over all frames, in one list.
template <class Of>
Numbers track(const RigClip& clip, std::size_t bone, Of of) {
    Numbers numbers;
    for (std::size_t frame = 0; frame < clip.frames(); ++frame)
        of(clip.poses[frame * clip.bones.size() + bone], numbers);
    return numbers;
}
void translation_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.translation.x, pose.translation.y, pose.translation.z});
}
void rotation_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w});
}
void scale_of(const ClipPose& pose, Numbers& to) {
    to.insert(to.end(), {pose.scale.x, pose.scale.y, pose.scale.z});
}

Json track_json(const Numbers& numbers, std::size_t size) {
    bool still = true;
    for (std::size_t i = size; i < numbers.size() && still; ++i) still = numbers[i] == numbers[i - size];
    Json json = Json::array();
    for (std::size_t i = 0; i < (still ? size : numbers.size()); ++i) json.push_back(number(numbers[i]));
    return json;
}

/// Reads `size` numbers per frame. A single row holds for all frames.
Numbers read_track(const JsonPlace& place, std::size_t size, std::size_t frames) {
    Numbers numbers;
    place.for_each("numbers", size * frames,
                   [&](const JsonPlace& each) { numbers.push_back(each.number()); });
    if (numbers.size() == size)
        for (std::size_t i = 0; i < size * (frames - 1); ++i) numbers.push_back(numbers[i]);
    if (numbers.size() != size * frames)
        place.fail("expected " + std::to_string(size) + " numbers, or that many per frame");
    return numbers;
}

void read_bone(const JsonPlace& place, RigClip& clip, std::size_t bone, std::size_t frames) {
    check_members(place, {"translation", "rotation", "scale"});
    const Numbers move = read_track(place["translation"], 3, frames);
    const Numbers turn = read_track(place["rotation"], 4, frames);
    const auto stored = place.optional("scale");
    const Numbers grow = stored ? read_track(*stored, 3, frames) : Numbers(3 * frames, 1.0f);
    for (std::size_t i = 0; i < frames; ++i) {
        const glm::quat rotation(turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]);
        if (!(std::abs(glm::length(rotation) - 1.0f) < 1e-3f))
            place["rotation"].fail("expected rotations of unit length");
        clip.poses[i * clip.bones.size() + bone] = {{move[3 * i], move[3 * i + 1], move[3 * i + 2]},
                                                    rotation,
                                                    {grow[3 * i], grow[3 * i + 1], grow[3 * i + 2]}};
    }
}

Json solve_json(const RigPart& part) {
    const ClipSolve& solve = *part.clip_left;
    Json left = Json::array();
    for (const FrameLeft& each : solve.left)
        left.push_back({number(each.mm), number(each.degrees), each.bone, number(each.scale), each.stopped});
    return {{"running", solve.running},
            {"left", std::move(left)},
            {"controls", solve.running ? controls_json(part.rig, solve.controls) : Json::object()}};
}

ClipSolve read_solve(const JsonPlace& place, const RigPart& part) {
    check_members(place, {"running", "left", "controls"});
    ClipSolve solve{.running = place["running"].flag(), .left = {}, .controls = {}};
    place["left"].for_each("frames", part.clip->frames(), [&](const JsonPlace& each) {
        const bool older = each.json().is_array() && each.json().size() == 3;  // older rows end there
        if (!older) each.check_size(5, "values: millimetres, degrees, bone, scale, stopped");
        FrameLeft left{each.element(0).number(0.0f, 1e9f), each.element(1).number(0.0f, 360.0f),
                       static_cast<std::uint32_t>(each.element(2).index(part.clip->bones.size() - 1))};
        if (!older) {
            left.scale = each.element(3).number(0.0f, 1e9f);
            left.stopped = each.element(4).flag();
        }
        solve.left.push_back(left);
    });
    if (!solve.running) return solve;
    try {
        check_clip_solve(part);
    } catch (const std::invalid_argument& error) {
        place.fail(error.what());
    }
    if (solve.done() == part.clip->frames()) place["running"].fail("all frames are solved");
    solve.controls = part.state->controls;
    load_controls(place["controls"], part.rig, solve.controls);
    return solve;
}

}  // namespace

Json clip_json(const RigPart& part) {
    const RigClip& clip = *part.clip;
    Json bones = Json::object();
    for (std::size_t i = 0; i < clip.bones.size(); ++i) {
        Json& bone = bones[clip.bones[i]] = {{"translation", track_json(track(clip, i, translation_of), 3)},
                                             {"rotation", track_json(track(clip, i, rotation_of), 4)}};
        const Numbers scale = track(clip, i, scale_of);
        if (std::ranges::any_of(scale, [](float each) { return each != 1.0f; }))
            bone["scale"] = track_json(scale, 3);
    }
    Json json{{"began", clip.began}, {"frames", clip.frames()}, {"bones", std::move(bones)}};
    if (part.clip_left) json["solve"] = solve_json(part);
    return json;
}

void load_clip(const JsonPlace& place, RigPart& part) {
    check_members(place, {"began", "frames", "bones", "solve"});
    RigClip clip{.bones = {}, .poses = {}, .began = place["began"].count(max_recording_tick)};
    const std::size_t frames = place["frames"].index(max_clip_frames + 1);
    const JsonPlace bones = place["bones"];
    if (!bones.json().is_object() || bones.json().empty()) bones.fail("expected an object of bones");
    if (frames == 0) place["frames"].fail("expected at least one frame");
    for (const auto& [name, stored] : bones.json().items()) clip.bones.push_back(name);
    if (frames * clip.bones.size() > max_clip_poses)
        place.fail("the clip has more poses than the maximum of " + std::to_string(max_clip_poses));
    clip.poses.resize(frames * clip.bones.size());
    for (std::size_t i = 0; i < clip.bones.size(); ++i)
        read_bone(bones[clip.bones[i].c_str()], clip, i, frames);
    part.clip = std::make_shared<const RigClip>(std::move(clip));
    if (const auto solve = place.optional("solve"))
        part.clip_left = std::make_shared<const ClipSolve>(read_solve(*solve, part));
}

}  // namespace tendril::app
