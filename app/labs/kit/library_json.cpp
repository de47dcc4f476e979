#include "app/labs/kit/library_json.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_keys = 1'000;

signal::Piece read_piece(const JsonPlace& place) {
    const std::string found = place.text();
    for (const auto piece : {signal::Piece::Constant, signal::Piece::Linear, signal::Piece::Cubic})
        if (found == signal::name(piece)) return piece;
    place.fail("expected constant, linear or cubic, found " + json_summary(place.json()));
}

signal::CurveKey read_key(const JsonPlace& place) {
    constexpr std::string_view known[] = {"time", "value", "arrive", "leave", "piece"};
    signal::CurveKey key;
    key.time = place["time"].real();
    key.value = place["value"].real();
    if (place.has("arrive")) key.arrive = place["arrive"].real();
    if (place.has("leave")) key.leave = place["leave"].real();
    if (place.has("piece")) key.piece = read_piece(place["piece"]);
    for (const auto& [name, value] : place.json().items())
        if (std::find(std::begin(known), std::end(known), name) == std::end(known))
            place[name.c_str()].fail("a key has only time, value, arrive, leave and piece");
    return key;
}

}  // namespace

Json curve_keys_json(const signal::Curve& curve) {
    Json keys = Json::array();
    for (const signal::CurveKey& key : curve.keys) {
        Json json{{"time", key.time}, {"value", key.value}, {"piece", signal::name(key.piece)}};
        if (key.arrive != 0.0) json["arrive"] = key.arrive;
        if (key.leave != 0.0) json["leave"] = key.leave;
        keys.push_back(std::move(json));
    }
    return keys;
}

std::vector<signal::CurveKey> read_curve_keys(const JsonPlace& place) {
    if (!place.json().is_array() || place.json().empty()) {
        place.fail("expected a list of 1 to " + std::to_string(max_keys) + " keys, found " +
                   json_summary(place.json()));
    }
    std::vector<signal::CurveKey> keys;
    place.for_each("keys", max_keys, [&](const JsonPlace& each) { keys.push_back(read_key(each)); });
    return keys;
}

}  // namespace tendril::app

namespace tendril::app {
namespace {

constexpr std::size_t max_bones = 10'000;

ik::PoleMemory load_pole(const JsonPlace& place, const std::vector<glm::vec3>& joints) {
    ik::PoleMemory memory{.valid = true, .joints = joints};
    load_all_fields(place, memory, std::array<std::string_view, 2>{"joints", "turn"});
    // Older rigs have each_joint.
    if (place.has("each_joint") && place["each_joint"].flag()) memory.turn = ik::PoleTurn::EachJoint;
    return memory;
}

}  // namespace

Json save_ik_state(const ik::State& state) {
    Json json{{"rotations", Json::array()}};
    for (const glm::quat& q : state.rotations) json["rotations"].push_back(quaternion(q));
    if (state.limits.valid) json["limits"] = save_fields(state.limits);
    if (state.side != ik::Side::Free) json["side"] = ik::name(state.side);
    if (state.pole.valid) json["pole"] = save_fields(state.pole);
    return json;
}

ik::State load_ik_state(const JsonPlace& place, std::size_t bones, const std::vector<glm::vec3>& joints) {
    ik::State state(bones);
    if (const auto list = place.optional("rotations"); list && list->list_size("rotations", max_bones) > 0) {
        list->check_size(bones, "values, one for each bone");
        for (std::size_t i = 0; i < bones; ++i) state.rotations[i] = list->element(i).rotation();
    }
    if (const auto limits = place.optional("limits")) {
        load_all_fields(*limits, state.limits);
        state.limits.valid = true;
    }
    if (const auto side = place.optional("side")) state.side = side->choice(bend_sides);
    if (const auto pole = place.optional("pole")) state.pole = load_pole(*pole, joints);
    if (const Result bad = ik::check(state, bones); !bad) place.fail(bad.message());
    return state;
}

}  // namespace tendril::app
