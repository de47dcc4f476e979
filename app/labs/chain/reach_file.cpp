// Reach mode in a scene file.
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

}  // namespace

void save_rotations(Json& json, const std::vector<glm::quat>& rotations) {
    for (const glm::quat& q : rotations) {
        json["rotations"].push_back(Json::array({number(q.x), number(q.y), number(q.z), number(q.w)}));
    }
}

std::vector<glm::quat> load_rotations(const Json& json, const std::string& where, std::size_t bones) {
    std::vector<glm::quat> rotations;
    if (const Json* list = bone_list(json, "rotations", where, bones)) {
        for (const Json& each : *list) {
            const std::string here = where + ".rotations." + std::to_string(rotations.size());
            rotations.push_back(json_quaternion(each, here));
        }
    }
    return rotations;
}

Json save_reach(const ReachSettings& settings) {
    Json json{{"solver", ik::name(settings.method)}, {"iterations", settings.iterations}};
    json["tolerance"] = settings.tolerance ? number(*settings.tolerance) : Json(nullptr);
    json["snap_back"] = number(settings.snap_back);
    json["soft_zone"] = number(settings.soft_zone);
    json["damping"] = number(settings.damping);
    json["twist_deg"] = number(settings.twist_deg);
    json["pole"] = settings.pole ? point(*settings.pole) : Json(nullptr);
    json["pole_turn"] = pole_turn_name(settings.pole_turn);
    if (settings.limits.empty()) return json;
    for (const ik::Limit& limit : settings.limits) json["limits"].push_back(limit_json(limit));
    save_rotations(json, settings.rotations);
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
    settings.damping = value("damping", least_damping, most_damping);
    settings.twist_deg = value("twist_deg", -180.0f, 180.0f);
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
    settings.rotations = load_rotations(json, where, bones);
    return settings;
}

}  // namespace tendril::app
