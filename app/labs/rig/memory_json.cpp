#include "app/labs/rig/memory_json.hpp"

#include <tendril/ik/state.hpp>

#include "app/document/json_complete.hpp"
#include "app/labs/rig/value_json.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t most_bones = 10'000;

constexpr double most_remembered = signal::max_output;

Json quat_json(const glm::quat& q) {
    return Json::array({number(q.x), number(q.y), number(q.z), number(q.w)});
}

/// A place from the root: two coordinates of at most 1e9 may lie twice as far apart.
glm::vec3 read_offset(const JsonPlace& place) {
    place.check_size(3, "numbers [x, y, z]");
    glm::vec3 offset;
    for (std::size_t axis = 0; axis < 3; ++axis)
        offset[static_cast<int>(axis)] =
            static_cast<float>(std::get<double>(read_value(place.element(axis), rig::Type::Number, 4e9)));
    return offset;
}

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
    Json operator()(const ik::State& state) const {
        Json chain{{"rotations", Json::array()}};
        for (const glm::quat& each : state.rotations) chain["rotations"].push_back(quat_json(each));
        if (state.pole.valid) {
            Json joints = Json::array();
            for (const glm::vec3& each : state.pole.joints) joints.push_back(point(each));
            chain["pole"] = {{"each_joint", state.pole.turn == ik::PoleTurn::EachJoint},
                             {"pole", point(state.pole.pole)},
                             {"target", point(state.pole.target)},
                             {"twist", number(state.pole.twist)},
                             {"joints", std::move(joints)}};
        }
        if (state.limits.valid) {
            chain["limits"] = {{"limited", state.limits.limited},
                               {"target", point(state.limits.target)},
                               {"damping", number(state.limits.damping)}};
        }
        return {{"ik", std::move(chain)}};
    }
};

template <class T>
signal::SpringState<T> read_spring(const JsonPlace& place, rig::Type type) {
    using Rate = signal::Rate<T>;
    const rig::Type rate = std::is_same_v<T, double> ? rig::Type::Number : rig::Type::Vector;
    const rig::Value value = read_value(place["value"], type, most_remembered);
    const rig::Value target = read_value(place["previous_target"], type, most_remembered);
    const bool started = place["started"].flag();
    if (started) {  // before that a rotation is none yet
        check_unit(place["value"], value);
        check_unit(place["previous_target"], target);
    }
    return {.value = std::get<T>(value),
            .velocity = std::get<Rate>(read_value(place["velocity"], rate, most_remembered)),
            .previous_target = std::get<T>(target),
            .started = started};
}

rig::UnitMemory read_any_spring(const JsonPlace& place) {
    check_members(place, {"value", "velocity", "previous_target", "started"});
    const rig::Type type = type_of(read_any_value(place["value"], most_remembered));
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
    ik::State state;
    place["rotations"].for_each("rotations", most_bones,
                                [&](const JsonPlace& each) { state.rotations.push_back(each.rotation()); });
    if (const auto pole = place.optional("pole")) {
        state.pole.valid = true;
        state.pole.turn = (*pole)["each_joint"].flag() ? ik::PoleTurn::EachJoint : ik::PoleTurn::WholeChain;
        state.pole.pole = read_offset((*pole)["pole"]);
        state.pole.target = read_offset((*pole)["target"]);
        state.pole.twist = (*pole)["twist"].number();
        (*pole)["joints"].for_each("joints", most_bones + 1, [&](const JsonPlace& each) {
            state.pole.joints.push_back(read_offset(each));
        });
    } else {
        state.pole.joints.resize(state.bones() + 1);  // as a state that was made for so many bones
    }
    if (const auto limits = place.optional("limits")) {
        state.limits.valid = true;
        state.limits.limited = (*limits)["limited"].flag();
        state.limits.target = read_offset((*limits)["target"]);
        state.limits.damping = (*limits)["damping"].number();
    }
    if (const Result bad = ik::check(state, state.bones()); !bad) place.fail(bad.message());
    return state;
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
    const rig::Value value = read_value(output["value"], rig::Type::Number, most_remembered);
    return {signal::OutputState{.value = std::get<double>(value), .started = output["started"].flag()}};
}

}  // namespace tendril::app
