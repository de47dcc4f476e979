#include "app/labs/kit/library_json.hpp"

#include "app/fields/fields.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

constexpr std::size_t max_bones = 10'000;

ik::PoleMemory load_pole(const JsonPlace& place, std::size_t joint_count,
                         const std::vector<glm::vec3>& joints) {
    if (const auto list = place.optional("joints"))
        list->check_size(joint_count, "positions, one for each joint");
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
    if (const auto pole = place.optional("pole")) state.pole = load_pole(*pole, bones + 1, joints);
    if (const Result bad = ik::check(state, bones); !bad) place.fail(bad.message());
    return state;
}

}  // namespace tendril::app
