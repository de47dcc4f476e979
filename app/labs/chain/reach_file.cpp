// Reach mode in a scene file.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "app/document/json_complete.hpp"
#include "app/io/solver_json.hpp"
#include "app/labs/chain/chain_part.hpp"

namespace tendril::app {
namespace {

glm::quat json_quaternion(const Json& json, const std::string& where) {
    if (!json.is_array() || json.size() != 4) throw std::runtime_error(where + " must be [x, y, z, w]");
    float c[4];
    for (std::size_t i = 0; i < 4; ++i) c[i] = json_number(json[i], where + "." + std::to_string(i));
    const glm::quat q(c[3], c[0], c[1], c[2]);
    if (!(std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0f) <= 1e-3f)) {
        throw std::runtime_error(where + " must be a unit quaternion, got " + json_summary(json));
    }
    return q;
}

const Json* optional_member(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found == json.end() || found->is_null() ? nullptr : &*found;
}

/// One a bone, or null for none.
const Json* bone_list(const Json& json, const char* key, const std::string& where, std::size_t bones) {
    const Json* list = optional_member(json, key);
    if (list == nullptr || (list->is_array() && list->empty())) return nullptr;
    if (!list->is_array() || list->size() != bones) {
        throw std::runtime_error(where + "." + key + " must be a list of " + std::to_string(bones) +
                                 ", one a bone");
    }
    return list;
}

/// Where the joints are from the root, as the solver counts it.
std::vector<glm::vec3> from_root(const std::vector<glm::vec3>& joints) {
    std::vector<glm::vec3> relative;
    relative.reserve(joints.size());
    for (const glm::vec3& joint : joints) relative.push_back(joint - joints.front());
    return relative;
}

/// A place from the root: two coordinates of at most 1e9 may lie twice as far apart.
glm::vec3 json_offset(const Json& json, const std::string& where) {
    if (!json.is_array() || json.size() != 3) throw std::runtime_error(where + " must be [x, y, z]");
    glm::vec3 offset;
    for (int axis = 0; axis < 3; ++axis) {
        offset[axis] = static_cast<float>(
            json_real(json[static_cast<std::size_t>(axis)], where + "." + std::to_string(axis), -4e9, 4e9));
    }
    return offset;
}

/// Its joints are left out where they are the chain's, as they are right after a solve.
Json save_memory(const ik::PoleMemory& memory, const std::vector<glm::vec3>& joints) {
    Json json{{"turn", pole_turn_name(memory.turn)},
              {"pole", point(memory.pole)},
              {"target", point(memory.target)},
              {"twist_deg", degrees(memory.twist)}};
    if (memory.joints != from_root(joints)) {
        for (const glm::vec3& joint : memory.joints) json["joints"].push_back(point(joint));
    }
    return json;
}

ik::PoleMemory load_memory(const Json& json, const std::string& where, const std::vector<glm::vec3>& joints) {
    ik::PoleMemory memory;
    memory.valid = true;
    memory.turn = pole_turn_from_name(json_text(json_member(json, "turn", where), where + ".turn"));
    memory.pole = json_offset(json_member(json, "pole", where), where + ".pole");
    memory.target = json_offset(json_member(json, "target", where), where + ".target");
    memory.twist = json_degrees(json_member(json, "twist_deg", where), where + ".twist_deg");
    const Json* list = optional_member(json, "joints");
    if (list == nullptr) {
        memory.joints = from_root(joints);
        return memory;
    }
    if (!list->is_array() || list->size() != joints.size()) {
        throw std::runtime_error(where + ".joints must be a list of " + std::to_string(joints.size()) +
                                 " places, one a joint");
    }
    for (const Json& each : *list) {
        memory.joints.push_back(json_offset(each, where + ".joints." + std::to_string(memory.joints.size())));
    }
    return memory;
}

}  // namespace

void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints) {
    if (state.bones() == 0) return;
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

ik::State load_state(const Json& json, const std::string& where, const std::vector<glm::vec3>& joints) {
    const Json* saved = optional_member(json, "state");
    if (saved == nullptr) return {};
    const std::string here = where + ".state";
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    ik::State state(bones);
    if (const Json* list = bone_list(*saved, "rotations", here, bones)) {
        for (std::size_t i = 0; i < bones; ++i)
            state.rotations[i] = json_quaternion((*list)[i], here + ".rotations." + std::to_string(i));
    }
    if (const Json* limits = optional_member(*saved, "limits")) {
        const std::string at = here + ".limits";
        state.limits.valid = true;
        state.limits.limited = json_bool(json_member(*limits, "limited", at), at + ".limited");
        state.limits.target = json_offset(json_member(*limits, "target", at), at + ".target");
        state.limits.damping = json_number(json_member(*limits, "damping", at), at + ".damping");
    }
    if (const Json* pole = optional_member(*saved, "pole"))
        state.pole = load_memory(*pole, here + ".pole", joints);
    if (const Result bad = ik::check(state, bones); !bad)
        throw std::runtime_error(here + ": " + bad.message());
    return state;
}

Json save_reach(const ReachSettings& settings, const Chain& chain) {
    Json json{{"solver", ik::name(settings.method)}, {"iterations", settings.iterations}};
    json["tolerance"] = settings.tolerance ? number(*settings.tolerance) : Json(nullptr);
    json["snap_back"] = number(settings.snap_back);
    json["soft_zone"] = number(settings.soft_zone);
    json["damping"] = number(settings.damping);
    json["twist_deg"] = number(settings.twist_deg);
    json["restarts"] = settings.restarts ? Json(*settings.restarts) : Json(nullptr);
    json["pole"] = settings.pole ? point(*settings.pole) : Json(nullptr);
    json["pole_turn"] = pole_turn_name(settings.pole_turn);
    for (const ik::Limit& limit : settings.limits) json["limits"].push_back(limit_json(limit));
    save_state(json, settings.state, positions(chain));
    return json;
}

ReachSettings load_reach(const Json& json, const std::string& where, const Chain& chain) {
    const std::size_t bones = chain.size() < 2 ? 0 : chain.size() - 1;
    ReachSettings settings;
    const auto at = [&](const char* key) { return where + "." + key; };
    const auto value = [&](const char* key, float low, float high) {
        return json_number(json_member(json, key, where), at(key), low, high);
    };
    const std::string name = json_text(json_member(json, "solver", where), at("solver"));
    const auto method = ik::method_named(name);
    if (!method) throw std::runtime_error(at("solver") + ": there is no solver \"" + name + "\"");
    settings.method = *method;
    settings.iterations =
        json_integer(json_member(json, "iterations", where), at("iterations"), 1, max_iterations);
    if (const Json* tolerance = optional_member(json, "tolerance")) {
        settings.tolerance = json_number(*tolerance, at("tolerance"), 0.0f, max_magnitude);
    }
    settings.snap_back = value("snap_back", 0.0f, 1.0f);
    settings.soft_zone = value("soft_zone", 0.0f, 1.0f);
    settings.damping = value("damping", min_damping, max_damping);
    settings.twist_deg = value("twist_deg", -180.0f, 180.0f);
    if (const Json* restarts = optional_member(json, "restarts"))  // version 1 had no such option
        settings.restarts = json_integer(*restarts, at("restarts"), 0, max_restarts);
    if (const Json* pole = optional_member(json, "pole")) settings.pole = json_point(*pole, at("pole"));
    settings.pole_turn =
        pole_turn_from_name(json_text(json_member(json, "pole_turn", where), at("pole_turn")));
    if (const Json* limits = bone_list(json, "limits", where, bones)) {
        for (std::size_t i = 0; i < bones; ++i) {
            const std::string here = at("limits") + "." + std::to_string(i);
            settings.limits.push_back(limit_from_json((*limits)[i], here));
            if (const char* why = ik::fault(settings.limits.back(), chain.default_direction())) {
                throw std::runtime_error(here + ": " + why);
            }
        }
    }
    settings.state = load_state(json, where, positions(chain));
    return settings;
}

}  // namespace tendril::app
