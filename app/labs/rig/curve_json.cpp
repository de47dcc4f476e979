#include "app/labs/rig/curve_json.hpp"

#include "app/document/json_complete.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t most_keys = 1'000;

struct End {
    const char* name;
    double signal::Curve::*value;
};
constexpr End ends[] = {{"source_min", &signal::Curve::source_min},
                        {"source_max", &signal::Curve::source_max},
                        {"target_min", &signal::Curve::target_min},
                        {"target_max", &signal::Curve::target_max}};

signal::CurveKey read_key(const JsonPlace& place) {
    check_members(place, {"time", "value", "arrive", "leave", "piece"});
    signal::CurveKey key;
    key.time = place["time"].real();
    key.value = place["value"].real();
    if (place.has("arrive")) key.arrive = place["arrive"].real();
    if (place.has("leave")) key.leave = place["leave"].real();
    if (place.has("piece"))
        key.piece = static_cast<signal::Piece>(read_name(place["piece"], {"constant", "linear", "cubic"}));
    return key;
}

}  // namespace

Json curve_json(const signal::Curve& curve) {
    Json keys = Json::array();
    for (const signal::CurveKey& key : curve.keys)
        keys.push_back({{"time", key.time},
                        {"value", key.value},
                        {"arrive", key.arrive},
                        {"leave", key.leave},
                        {"piece", signal::name(key.piece)}});
    Json json{{"keys", std::move(keys)}};
    for (const End& end : ends) json[end.name] = curve.*end.value;
    return json;
}

signal::Curve read_curve(const JsonPlace& place) {
    std::vector<std::string> known;
    add_curve_members(known);
    check_members(place, known);
    signal::Curve curve;
    read_curve_members(place, curve);
    return curve;
}

void add_curve_members(std::vector<std::string>& names) {
    names.emplace_back("keys");
    for (const End& end : ends) names.emplace_back(end.name);
}

void read_curve_members(const JsonPlace& place, signal::Curve& curve) {
    if (place.has("keys")) {
        curve.keys.clear();
        place["keys"].for_each("keys", most_keys,
                               [&](const JsonPlace& each) { curve.keys.push_back(read_key(each)); });
    }
    for (const End& end : ends)
        if (place.has(end.name)) curve.*end.value = place[end.name].real();
}

}  // namespace tendril::app
