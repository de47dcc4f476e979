#include "app/io/character/fbx/record.hpp"


namespace tendril::app::fbx {

std::string_view plain_name(std::string_view name) {
    if (const std::size_t end = name.find('\0'); end != name.npos) return name.substr(0, end);
    const std::size_t kind = name.find("::");
    return kind == name.npos ? name : name.substr(kind + 2);
}

Objects::Table Objects::table(const Record& owner) {
    Table table;
    for (const Record& list : owner.children) {
        const std::size_t first = list.name == "Properties70" ? 4 : list.name == "Properties60" ? 3 : 0;
        if (first == 0) continue;
        for (const Record& each : list.children)
            if (each.name == "P" || each.name == "Property") table[each.text(0)] = {&each, first};
    }
    return table;
}

Objects::Objects(const File& file) {
    const bool is_named = file.version < 7000;
    if (const Record* definitions = file.root.child("Definitions"))
        for (const Record& type : definitions->children)
            if (const Record* shared = type.child("PropertyTemplate"))
                templates_.emplace(type.text(0), table(*shared));
    if (const Record* settings = file.root.child("GlobalSettings")) settings_ = table(*settings);
    if (const Record* all = file.root.child("Objects")) {
        for (const Record& each : all->children) {
            if (each.name == "GlobalSettings") {
                settings_ = table(each);
                continue;
            }
            const std::string_view full = each.text(is_named ? 0 : 1);
            if (is_named)
                names_.emplace(full, objects_.size());
            else
                ids_.emplace(each.integer(0), objects_.size());
            objects_.push_back({&each, each.name, plain_name(full), each.text(is_named ? 1 : 2)});
            tables_.push_back(table(each));
        }
    }
    children_.resize(objects_.size());
    parents_.resize(objects_.size());
    const Record* connections = file.root.child("Connections");
    if (!connections) return;
    const auto index_of = [&](const Record& record, std::size_t at) -> std::int64_t {
        if (is_named) return find(record.text(at));
        const auto found = ids_.find(record.integer(at));
        return found == ids_.end() ? -1 : static_cast<std::int64_t>(found->second);
    };
    for (const Record& each : connections->children) {
        if (each.name != "C" && each.name != "Connect") continue;
        const std::int64_t child = index_of(each, 1), parent = index_of(each, 2);
        if (child < 0 || parent < 0) continue;
        const std::string_view property =
            each.text(0) == "OP" || each.text(0) == "PO" ? each.text(3) : std::string_view();
        const auto at = [](std::int64_t index) { return static_cast<std::size_t>(index); };
        children_[at(parent)].push_back({at(child), property});
        parents_[at(child)].push_back({at(parent), property});
    }
}

std::int64_t Objects::find(std::string_view full_name) const {
    const auto found = names_.find(full_name);
    return found == names_.end() ? -1 : static_cast<std::int64_t>(found->second);
}

Objects::Values Objects::property(std::size_t index, std::string_view name) const {
    if (const auto own = tables_[index].find(name); own != tables_[index].end()) return own->second;
    const auto shared = templates_.find(objects_[index].kind);
    if (shared == templates_.end()) return {};
    const auto found = shared->second.find(name);
    return found == shared->second.end() ? Values() : found->second;
}
double Objects::number(std::size_t index, std::string_view name, double otherwise) const {
    const Values found = property(index, name);
    return found ? found.record->number(found.first, otherwise) : otherwise;
}
std::int64_t Objects::integer(std::size_t index, std::string_view name, std::int64_t otherwise) const {
    const Values found = property(index, name);
    return found ? found.record->integer(found.first, otherwise) : otherwise;
}
glm::dvec3 Objects::vector(std::size_t index, std::string_view name, const glm::dvec3& otherwise) const {
    const Values found = property(index, name);
    if (!found) return otherwise;
    const auto at = [&](int axis) {
        return found.record->number(found.first + static_cast<std::size_t>(axis), otherwise[axis]);
    };
    return {at(0), at(1), at(2)};
}

Objects::Values Objects::setting(std::string_view name) const {
    const auto found = settings_.find(name);
    return found == settings_.end() ? Values() : found->second;
}

}  // namespace tendril::app::fbx
