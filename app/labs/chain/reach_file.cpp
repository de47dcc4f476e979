// Reach mode in a scene file.
#include <algorithm>

#include "app/document/json_complete.hpp"
#include "app/document/json_place.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {
namespace {

/// One a bone; nothing where there is none, or none of them.
std::optional<JsonPlace> bone_list(const JsonPlace& owner, const char* key, std::size_t bones) {
    std::optional<JsonPlace> list = owner.optional(key);
    if (!list || (list->json().is_array() && list->json().empty())) return std::nullopt;
    list->check_size(bones, "values, one a bone");
    return list;
}

/// A place from the root: two coordinates of at most 1e9 may lie twice as far apart.
glm::vec3 offset(const JsonPlace& place) {
    place.check_size(3, "numbers [x, y, z]");
    glm::vec3 at;
    for (int axis = 0; axis < 3; ++axis)
        at[axis] = static_cast<float>(place.element(static_cast<std::size_t>(axis)).real(-4e9, 4e9));
    return at;
}

/// Its joints are left out where they are the chain's, as they are right after a solve.
Json save_memory(const ik::PoleMemory& memory, const std::vector<glm::vec3>& joints) {
    Json json{{"turn", pole_turns.name(memory.turn)},
              {"pole", point(memory.pole)},
              {"target", point(memory.target)},
              {"twist_deg", degrees(memory.twist)}};
    if (memory.joints != from_root(joints)) {
        for (const glm::vec3& joint : memory.joints) json["joints"].push_back(point(joint));
    }
    return json;
}

ik::PoleMemory load_memory(const JsonPlace& place, const std::vector<glm::vec3>& joints) {
    ik::PoleMemory memory;
    memory.valid = true;
    memory.turn = pole_turns.value(place["turn"].text());
    memory.pole = offset(place["pole"]);
    memory.target = offset(place["target"]);
    memory.twist = place["twist_deg"].degrees();
    const auto list = place.optional("joints");
    if (!list) {
        memory.joints = from_root(joints);
        return memory;
    }
    list->check_size(joints.size(), "places, one a joint");
    for (std::size_t i = 0; i < joints.size(); ++i) memory.joints.push_back(offset(list->element(i)));
    return memory;
}

}  // namespace

void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints) {
    // One of another chain counts for nothing: the next solve begins anew.
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    if (state.bones() == 0 || !ik::check(state, bones)) return;
    Json& saved = json["state"] = Json::object();
    const auto turned = [](const glm::quat& q) { return q != glm::quat(1, 0, 0, 0); };
    if (std::any_of(state.rotations.begin(), state.rotations.end(), turned)) {
        for (const glm::quat& q : state.rotations)
            saved["rotations"].push_back(Json::array({number(q.x), number(q.y), number(q.z), number(q.w)}));
    }
    if (state.limits.valid) {
        saved["limits"] = {{"limited", state.limits.limited},
                           {"target", point(state.limits.target)},
                           {"damping", number(state.limits.damping)}};
    }
    if (state.pole.valid) saved["pole"] = save_memory(state.pole, joints);
}

ik::State load_state(const JsonPlace& owner, const std::vector<glm::vec3>& joints) {
    const auto saved = owner.optional("state");
    if (!saved) return {};
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    ik::State state(bones);
    if (const auto list = bone_list(*saved, "rotations", bones)) {
        for (std::size_t i = 0; i < bones; ++i) state.rotations[i] = list->element(i).rotation();
    }
    if (const auto limits = saved->optional("limits")) {
        state.limits.valid = true;
        state.limits.limited = (*limits)["limited"].flag();
        state.limits.target = offset((*limits)["target"]);
        state.limits.damping = (*limits)["damping"].number();
    }
    if (const auto pole = saved->optional("pole")) state.pole = load_memory(*pole, joints);
    if (const Result bad = ik::check(state, bones); !bad) saved->fail(bad.message());
    return state;
}

Json save_reach(const ReachSettings& settings, const Chain& chain) {
    Json json{{"solver", ik::name(settings.method)}};
    json.update(save_fields(settings));
    json["pole"] = settings.pole ? point(*settings.pole) : Json(nullptr);
    for (const ik::Limit& limit : settings.limits) json["limits"].push_back(limit_json(limit));
    save_state(json, settings.state, positions(chain));
    return json;
}

ReachSettings load_reach(const JsonPlace& place, const Chain& chain) {
    const std::size_t bones = chain.size() < 2 ? 0 : chain.size() - 1;
    ReachSettings settings;
    const JsonPlace solver = place["solver"];
    const auto method = ik::method_named(solver.text());
    if (!method) solver.fail("there is no solver \"" + solver.text() + "\"");
    settings.method = *method;
    load_fields(place, settings);
    if (const auto pole = place.optional("pole")) settings.pole = pole->point();
    if (const auto limits = bone_list(place, "limits", bones)) {
        for (std::size_t i = 0; i < bones; ++i) {
            const JsonPlace each = limits->element(i);
            settings.limits.push_back(limit_from_json(each.json(), each.where()));
            if (const char* why = ik::fault(settings.limits.back(), chain.default_direction()))
                each.fail(why);
        }
    }
    settings.state = load_state(place, positions(chain));
    return settings;
}

}  // namespace tendril::app
