#include "app/io/character/map_file.hpp"

#include <cstdint>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "app/io/json_complete.hpp"
#include "app/system/atomic_file.hpp"

namespace tendril::app {
namespace {

using humanoid::Bone;
using humanoid::Skeleton;

constexpr const char* kind = "bone map";
constexpr int newest_version = 1;
constexpr std::size_t max_name_size = 10'000;

std::string name_of(std::size_t bone) {
    return humanoid::name(static_cast<Bone>(bone));
}

std::string node_name(const Json& json, const std::string& where) {
    const std::string name = json_text(json, where);
    if (name.size() > max_name_size) throw std::runtime_error(where + ": longer than 10000 bytes");
    return name;
}

void read_bones(const Json& json, SavedMap& map) {
    if (!json.is_object()) throw std::runtime_error("bones: expected an object, found " + json_summary(json));
    std::map<std::string, std::string> taken;
    for (const auto& [key, value] : json.items()) {
        const std::string where = "bones." + key.substr(0, 100);
        const auto bone = humanoid::bone_named(key);
        if (!bone) throw std::runtime_error(where + ": there is no such bone");
        const std::string node = node_name(value, where);
        if (node.empty()) continue;
        if (const auto [other, is_new] = taken.emplace(node, key); !is_new)
            throw std::runtime_error(where + ": its node already belongs to " + other->second);
        map.bones[static_cast<std::size_t>(*bone)] = node;
    }
}

SavedMap read(const Json& json) {
    if (!json.is_object() || !json.contains("tendril") || json["tendril"] != kind)
        throw std::runtime_error("tendril: expected \"bone map\": the file is not a bone map");
    json_integer(json_member(json, "version", ""), "version", 1, newest_version);
    SavedMap map;
    read_bones(json_member(json, "bones", ""), map);
    if (!json.contains("nodes")) return map;
    const Json& nodes = json["nodes"];
    if (!nodes.is_array() || nodes.size() > Skeleton::max_nodes)
        throw std::runtime_error("nodes: expected a list of at most 4096 names");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::string where = "nodes.";
        where += std::to_string(i);
        map.nodes.push_back(node_name(nodes[i], where));
    }
    return map;
}

std::vector<std::string> names_of(const Skeleton& skeleton) {
    std::vector<std::string> names;
    for (const humanoid::Node& node : skeleton.nodes()) names.push_back(node.name);
    return names;
}

}  // namespace

SavedMap saved_map(const humanoid::BoneMap& map, const Skeleton& skeleton) {
    SavedMap saved{.bones = {}, .nodes = names_of(skeleton)};
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (map.bones[i].node >= 0)
            saved.bones[i] = skeleton[static_cast<std::size_t>(map.bones[i].node)].name;
    return saved;
}

humanoid::BoneMap applied(const SavedMap& saved, const Skeleton& skeleton) {
    humanoid::BoneMap map;
    for (std::size_t i = 0; i < humanoid::bone_count; ++i) {
        if (saved.bones[i].empty()) continue;
        const auto node = skeleton.find(saved.bones[i]);
        if (!node)
            throw std::runtime_error(name_of(i) + " is node \"" + saved.bones[i] +
                                     "\", which the character does not have");
        map.bones[i] = {static_cast<std::int32_t>(*node), 1.0, "from a saved map"};
    }
    if (const Result bad = humanoid::check(map, skeleton); !bad) throw std::runtime_error(bad.message());
    humanoid::review(map, skeleton);
    return map;
}

std::string map_text(const SavedMap& map) {
    Json bones = Json::object();
    for (std::size_t i = 0; i < humanoid::bone_count; ++i)
        if (!map.bones[i].empty()) bones[name_of(i)] = map.bones[i];
    return json_to_text(
        {{"tendril", kind}, {"version", newest_version}, {"bones", bones}, {"nodes", map.nodes}});
}

SavedMap parse_map(std::string_view text, const std::string& name) {
    try {
        return read(parse_json(text));
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

bool begins_map(std::string_view text) {
    return text.find("\"tendril\"") != text.npos && text.find("\"bone map\"") != text.npos;
}

SavedMap read_map(const std::filesystem::path& path) {
    return parse_map(read_text_file(path), path.filename().string());
}

std::filesystem::path kept_map(const std::filesystem::path& folder, const Skeleton& skeleton) {
    // FNV-1a, 64 bits. It only names the file; find_kept_map() compares the node names in it.
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto take = [&](unsigned char byte) { hash = (hash ^ byte) * 0x100000001b3u; };
    for (const humanoid::Node& node : skeleton.nodes()) {
        for (const char c : node.name) take(static_cast<unsigned char>(c));
        take(0);
    }
    char name[40];
    std::snprintf(name, sizeof name, "%016llx.json", static_cast<unsigned long long>(hash));
    return folder / "maps" / name;
}

std::optional<SavedMap> find_kept_map(const std::filesystem::path& folder, const Skeleton& skeleton) {
    const std::filesystem::path path = kept_map(folder, skeleton);
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return std::nullopt;
    const std::string name = path.filename().string();
    // Reading from a pipe might never end.
    if (!std::filesystem::is_regular_file(path, error)) throw std::runtime_error(name + ": is not a file");
    SavedMap map = read_map(path);
    if (map.nodes != names_of(skeleton))
        throw std::runtime_error(name + ": nodes: they are not this character's nodes");
    try {
        applied(map, skeleton);
    } catch (const std::runtime_error& why) {
        throw std::runtime_error(name + ": bones: " + why.what());
    }
    return map;
}

void keep_map(const std::filesystem::path& folder, const SavedMap& map, const Skeleton& skeleton) {
    const std::filesystem::path path = kept_map(folder, skeleton);
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) throw std::runtime_error("cannot write " + path.string() + ": " + error.message());
    write_file_atomically(path, map_text(map));
}

bool forget_kept_map(const std::filesystem::path& folder, const Skeleton& skeleton) {
    const std::filesystem::path path = kept_map(folder, skeleton);
    std::error_code error;
    const bool was_there = std::filesystem::remove(path, error);
    if (error) throw std::runtime_error("cannot remove " + path.string() + ": " + error.message());
    return was_there;
}

}  // namespace tendril::app
