#include "app/labs/kit/library_json.hpp"

#include "app/document/json_complete.hpp"
#include "app/fields/fields.hpp"

namespace {

/// Range of an offset from the root: two coordinates of at most 1e9 can be 2e9 apart.
constexpr tendril::FieldRange offsets{-4e9, 4e9};

}  // namespace

template <>
std::span<const tendril::Field> tendril::fields<tendril::ik::LimitMemory>() noexcept {
    using ik::LimitMemory;
    static constexpr Field rows[] = {field<&LimitMemory::limited>("limited"),
                                     field<&LimitMemory::target>("target", offsets, "m"),
                                     field<&LimitMemory::damping>("damping", {0.0, 100.0})};
    return rows;
}

namespace tendril::app {
namespace {

constexpr std::size_t max_bones = 10'000;

glm::vec3 offset_at(const JsonPlace& place) {
    place.check_size(3, "numbers [x, y, z]");
    glm::vec3 at;
    for (int axis = 0; axis < 3; ++axis)
        at[axis] =
            static_cast<float>(place.element(static_cast<std::size_t>(axis)).real(offsets.low, offsets.high));
    return at;
}

ik::PoleMemory load_pole(const JsonPlace& place, std::size_t joint_count,
                         const std::vector<glm::vec3>& joints) {
    ik::PoleMemory memory;
    memory.valid = true;
    // Older rigs have each_joint, and twist in radians.
    if (place.has("each_joint"))
        memory.turn = place["each_joint"].flag() ? ik::PoleTurn::EachJoint : ik::PoleTurn::WholeChain;
    else
        memory.turn = place["turn"].choice(pole_turns);
    memory.pole = offset_at(place["pole"]);
    memory.target = offset_at(place["target"]);
    memory.twist = place.has("twist") ? place["twist"].number() : place["twist_deg"].degrees();
    const auto list = place.optional("joints");
    if (!list) {
        memory.joints = joints;
        return memory;
    }
    list->check_size(joint_count, "positions, one for each joint");
    for (std::size_t i = 0; i < joint_count; ++i) memory.joints.push_back(offset_at(list->element(i)));
    return memory;
}

}  // namespace

Json save_ik_state(const ik::State& state) {
    Json json{{"rotations", Json::array()}};
    for (const glm::quat& q : state.rotations) json["rotations"].push_back(quaternion(q));
    if (state.limits.valid) json["limits"] = save_fields(state.limits);
    if (state.side != ik::Side::Free) json["side"] = ik::name(state.side);
    if (state.pole.valid) {
        Json& pole = json["pole"] = {{"turn", pole_turns.name(state.pole.turn)},
                                     {"pole", point(state.pole.pole)},
                                     {"target", point(state.pole.target)},
                                     {"twist_deg", degrees(state.pole.twist)},
                                     {"joints", Json::array()}};
        for (const glm::vec3& joint : state.pole.joints) pole["joints"].push_back(point(joint));
    }
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
    if (const auto pole = place.optional("pole")) state.pole = load_pole(*pole, bones + 1, joints);
    if (const Result bad = ik::check(state, bones); !bad) place.fail(bad.message());
    return state;
}

}  // namespace tendril::app
