#include "app/labs/kit/curve_json.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_keys = 1'000;

struct End {
    const char* name;
    double signal::Curve::*value;
};
constexpr End ends[] = {{"source_min", &signal::Curve::source_min},
                        {"source_max", &signal::Curve::source_max},
                        {"target_min", &signal::Curve::target_min},
                        {"target_max", &signal::Curve::target_max}};

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

Json curve_json(const signal::Curve& curve) {
    Json json{{"keys", curve_keys_json(curve)}};
    for (const End& end : ends) json[end.name] = curve.*end.value;
    return json;
}

void add_curve_members(std::vector<std::string>& names) {
    names.emplace_back("keys");
    for (const End& end : ends) names.emplace_back(end.name);
}

void read_curve_members(const JsonPlace& place, signal::Curve& curve) {
    if (place.has("keys")) curve.keys = read_curve_keys(place["keys"]);
    for (const End& end : ends)
        if (place.has(end.name)) curve.*end.value = place[end.name].real();
}

}  // namespace tendril::app
