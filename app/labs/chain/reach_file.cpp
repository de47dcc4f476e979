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

}  // namespace

void save_state(Json& json, const ik::State& state, const std::vector<glm::vec3>& joints) {
    // One of another chain counts for nothing: the next solve begins anew.
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    if (state.bones() == 0 || !ik::check(state, bones)) return;
    Json& saved = json["state"] = save_ik_state(state);
    const auto turned = [](const glm::quat& q) { return q != glm::quat(1, 0, 0, 0); };
    if (std::none_of(state.rotations.begin(), state.rotations.end(), turned)) saved.erase("rotations");
    if (state.pole.valid && state.pole.joints == from_root(joints)) saved["pole"].erase("joints");
}

ik::State load_state(const JsonPlace& owner, const std::vector<glm::vec3>& joints) {
    const auto saved = owner.optional("state");
    const std::size_t bones = joints.empty() ? 0 : joints.size() - 1;
    return saved ? load_ik_state(*saved, bones, from_root(joints)) : ik::State();
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
