#include "app/labs/rig/memory_json.hpp"

#include "app/document/json_complete.hpp"
#include "app/labs/kit/ik_state_json.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_bones = 10'000;
constexpr double max_remembered = signal::max_output;

struct ToJson {
    Json operator()(std::monostate) const { return nullptr; }
    Json operator()(const rig::Turned& turned) const { return {{"turned", rotation_json(turned.rotation)}}; }
    Json operator()(const signal::OutputState& state) const {
        return {{"output", {{"value", state.value}, {"started", state.started}}}};
    }
    template <class T>
    Json operator()(const signal::SpringState<T>& state) const {
        return {{"spring",
                 {{"value", value_json(state.value)},
                  {"velocity", value_json(state.velocity)},
                  {"previous_target", value_json(state.previous_target)},
                  {"started", state.started}}}};
    }
    Json operator()(const ik::State& state) const { return {{"ik", save_ik_state(state)}}; }
};

template <class T>
signal::SpringState<T> read_spring(const JsonPlace& place, rig::Type type) {
    using Rate = signal::Rate<T>;
    const rig::Type rate = std::is_same_v<T, double> ? rig::Type::Number : rig::Type::Vector;
    const rig::Value value = read_value(place["value"], type, max_remembered);
    const rig::Value target = read_value(place["previous_target"], type, max_remembered);
    const bool started = place["started"].flag();
    if (started) {  // before that a rotation is none yet
        check_unit(place["value"], value);
        check_unit(place["previous_target"], target);
    }
    return {.value = std::get<T>(value),
            .velocity = std::get<Rate>(read_value(place["velocity"], rate, max_remembered)),
            .previous_target = std::get<T>(target),
            .started = started};
}

rig::UnitMemory read_any_spring(const JsonPlace& place) {
    check_members(place, {"value", "velocity", "previous_target", "started"});
    const rig::Type type = type_of(read_any_value(place["value"], max_remembered));
    switch (type) {
        case rig::Type::Number:
            return {read_spring<double>(place, type)};
        case rig::Type::Vector:
            return {read_spring<glm::dvec3>(place, type)};
        case rig::Type::Rotation:
            return {read_spring<glm::dquat>(place, type)};
        default:
            place["value"].fail("expected a number, a vector or a rotation");
    }
}

ik::State read_chain(const JsonPlace& place) {
    check_members(place, {"rotations", "pole", "limits"});
    return load_ik_state(place, place["rotations"].list_size("rotations", max_bones));
}

}  // namespace

Json memory_json(const rig::UnitMemory& memory) {
    return std::visit(ToJson(), memory.held);
}

rig::UnitMemory read_memory(const JsonPlace& place) {
    if (place.json().is_null()) return {};
    check_members(place, {"turned", "output", "spring", "ik"});
    if (place.json().size() != 1) place.fail("expected one of turned, output, spring, ik");
    if (place.has("turned"))
        return {rig::Turned{std::get<glm::dquat>(read_stored(place["turned"], rig::Type::Rotation))}};
    if (place.has("spring")) return read_any_spring(place["spring"]);
    if (place.has("ik")) return {read_chain(place["ik"])};
    const JsonPlace output = place["output"];
    check_members(output, {"value", "started"});
    const rig::Value value = read_value(output["value"], rig::Type::Number, max_remembered);
    return {signal::OutputState{.value = std::get<double>(value), .started = output["started"].flag()}};
}

}  // namespace tendril::app
