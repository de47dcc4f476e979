#include "app/labs/humanoid/node_selection.hpp"

#include <algorithm>

#include "app/document/json_complete.hpp"

namespace tendril::app {
namespace {

/// The last name is the active one's, where it is there.
Selection selection_of(const std::vector<std::string>& names, const humanoid::Skeleton& skeleton) {
    std::vector<std::size_t> nodes;
    for (const std::string& name : names)
        if (const auto node = skeleton.find(name)) nodes.push_back(*node);
    Selection selection;
    selection.take(nodes, false);
    return selection;
}

}  // namespace

std::vector<std::string> names_of(const Selection& selection, const humanoid::Skeleton& skeleton) {
    std::vector<std::string> names;
    for (const std::size_t node : selection.all()) names.push_back(skeleton[node].name);
    return names;
}

std::string active_name(const Selection& selection, const humanoid::Skeleton& skeleton) {
    return selection.active() ? skeleton[*selection.active()].name : std::string();
}

Selection selection_in(const humanoid::Skeleton& skeleton, const Selection& selection,
                       const humanoid::Skeleton& before) {
    if (&skeleton == &before || selection.empty()) return selection;
    std::vector<std::string> names = names_of(selection, before);
    names.push_back(active_name(selection, before));
    return selection_of(names, skeleton);
}

Json save_selection(const Selection& selection, const humanoid::Skeleton& skeleton) {
    if (!selection.several()) return active_name(selection, skeleton);
    return {{"active", active_name(selection, skeleton)}, {"all", names_of(selection, skeleton)}};
}

Selection load_selection(const JsonPlace& place, const humanoid::Skeleton& skeleton) {
    if (!place.json().is_object()) return selection_of({place.text()}, skeleton);
    std::vector<std::string> names;
    place["all"].for_each("selected", humanoid::Skeleton::max_nodes,
                          [&](const JsonPlace& each) { names.push_back(each.text()); });
    const std::string active = place["active"].text();
    if (std::find(names.begin(), names.end(), active) == names.end())
        place["active"].fail("is not among those that are selected");
    names.push_back(active);
    return selection_of(names, skeleton);
}

}  // namespace tendril::app
