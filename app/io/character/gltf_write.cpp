#include "app/io/character/gltf_write.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "app/io/character/gltf_bytes.hpp"
#include "app/io/character/gltf_file.hpp"
#include "tendril/elementary.hpp"

namespace tendril::app {
namespace {

using Json = nlohmann::ordered_json;
using humanoid::Channel;
using humanoid::Interpolation;
using humanoid::Track;

const glm::dvec3& part_of(const rig::Transform& local, const Track<glm::dvec3>& track,
                          const Channel& channel) {
    return &track == &channel.scale ? local.scale : local.translation;
}
const glm::dquat& part_of(const rig::Transform& local, const Track<glm::dquat>&, const Channel&) {
    return local.rotation;
}

/// A linear track with additional keys at each frame between its first and its last key.
template <class T>
Track<T> with_keys_at(const humanoid::Frames& frames, const Channel& channel, const Track<T>& track) {
    if (track.interpolation != Interpolation::Linear) return track;
    Track<T> result{track.interpolation, with_frames(track.times, frames), {}};
    for (std::size_t key = 0; const double time : result.times) {
        rig::Transform local;
        sample(channel, time, local);
        const bool is_key = time == track.times[key];
        result.values.push_back(is_key ? track.values[key++] : part_of(local, track, channel));
    }
    return result;
}

void put_on_one_hemisphere(Track<glm::dquat>& track) {
    const bool cubic = track.interpolation == Interpolation::Cubic;
    const std::size_t width = cubic ? 3 : 1, middle = cubic ? 1 : 0;
    for (std::size_t i = 1; i < track.times.size(); ++i)
        if (glm::dot(track.values[(i - 1) * width + middle], track.values[i * width + middle]) < 0.0)
            for (std::size_t k = 0; k < width; ++k) track.values[i * width + k] *= -1.0;
}

void put(std::vector<float>& numbers, const glm::dvec3& value) {
    for (int i = 0; i < 3; ++i) numbers.push_back(static_cast<float>(value[i]));
}
void put(std::vector<float>& numbers, const glm::dquat& value) {
    for (const double each : {value.x, value.y, value.z, value.w})
        numbers.push_back(static_cast<float>(each));
}

void put(std::vector<float>& numbers, const humanoid::Placement& value) {
    for (int i = 0; i < 4; ++i) {
        put(numbers, i < 3 ? value.axes[i] : value.position);
        numbers.push_back(i < 3 ? 0.0f : 1.0f);
    }
}

Json array_of(const glm::dvec3& value) {
    return Json::array({value.x, value.y, value.z});
}

/// A part's colour in linear light, as glTF stores it.
Json linear_colour(const glm::vec4& shown) {
    Json colour = Json::array();
    for (int i = 0; i < 3; ++i)
        colour.push_back(shown[i] <= 0.04045f ? shown[i] / 12.92f
                                              : static_cast<float>(math::exponential(
                                                    2.4 * math::logarithm((shown[i] + 0.055) / 1.055))));
    colour.push_back(shown[3]);
    return colour;
}

/// Returns its index.
std::size_t add_material(const glm::vec4& colour, GltfFile& file) {
    Json& all = file.json["materials"];
    all.push_back(
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", linear_colour(colour)}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.7}}}});
    return all.size() - 1;
}

/// Replaces a node's matrix by translation, rotation and scale, which glTF requires of animated nodes.
void set_transform(Json& node, const rig::Transform& local) {
    node.erase("matrix");
    node["translation"] = array_of(local.translation);
    node["rotation"] = Json::array({local.rotation.x, local.rotation.y, local.rotation.z, local.rotation.w});
    node["scale"] = array_of(local.scale);
}

/// The meshes of worn things; their joints are at rest in the skeleton, which has `unit` metres per unit of
/// the file. `nodes`: each node's index in the file.
void add_worn(const Worn& worn, const humanoid::Skeleton& skeleton, const std::vector<std::size_t>& nodes,
              double unit, GltfFile& file) {
    std::vector<humanoid::Placement> placed(skeleton.size());
    place(skeleton, rest_pose(skeleton), placed);
    for (const WornMesh& mesh : worn.meshes) {
        std::vector<std::size_t> joints;
        std::vector<glm::dvec3> points, normals(mesh.corners.size());
        std::vector<std::uint16_t> joint_of;
        const bool rigid = std::ranges::all_of(mesh.corners, [&](const WornMesh::Corner& each) {
            return each.node == mesh.corners.front().node;
        });
        for (const WornMesh::Corner& each : mesh.corners) {
            const auto known = std::ranges::find(joints, each.node);
            joint_of.insert(joint_of.end(), {static_cast<std::uint16_t>(known - joints.begin()), 0, 0, 0});
            if (known == joints.end()) joints.push_back(each.node);
            points.push_back((rigid ? each.at : placed[each.node].apply(each.at)) / unit);
        }
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const std::uint32_t* const k = &mesh.indices[i];
            const glm::dvec3 across = glm::cross(points[k[1]] - points[k[0]], points[k[2]] - points[k[0]]);
            for (int c = 0; c < 3; ++c) normals[k[c]] += across;
        }
        std::vector<float> at, out, weights, binds;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double size = glm::length(normals[i]);
            put(at, points[i]), put(out, size > 0.0 ? normals[i] / size : glm::dvec3(0.0, 1.0, 0.0));
            weights.insert(weights.end(), {1.0f, 0.0f, 0.0f, 0.0f});
        }
        Json attributes{{"POSITION", file.add_positions(at)}, {"NORMAL", file.add_rows("VEC3", out)}};
        Json skin{{"joints", Json::array()}};
        for (const std::size_t joint : joints) {
            skin["joints"].push_back(nodes[joint]);
            const glm::dmat3 back = glm::inverse(placed[joint].axes);
            put(binds, humanoid::Placement{back, -(back * placed[joint].position) / unit});
        }
        if (!rigid) {
            attributes["JOINTS_0"] = file.add_joints(joint_of);
            attributes["WEIGHTS_0"] = file.add_rows("VEC4", weights);
            skin["inverseBindMatrices"] = file.add_rows("MAT4", binds);
        }
        const std::size_t material = add_material(mesh.colour, file);
        file.json["materials"][material]["doubleSided"] = true;
        Json& meshes = file.json["meshes"];
        meshes.push_back({{"name", mesh.name},
                          {"primitives", Json::array({{{"attributes", attributes},
                                                       {"indices", file.add_indices(mesh.indices)},
                                                       {"material", material}}})}});
        const std::size_t made = meshes.size() - 1;
        if (rigid) {
            file.json["nodes"][nodes[joints.front()]]["mesh"] = made;
            continue;
        }
        Json& skins = file.json["skins"];  // may be new; adding a member moves the others
        Json& all = file.json["nodes"];
        if (file.json.contains("scenes"))
            file.json["scenes"][file.json.value("scene", std::size_t{0})]["nodes"].push_back(all.size());
        all.push_back({{"name", mesh.name + " mesh"}, {"mesh", made}, {"skin", skins.size()}});
        skins.push_back(std::move(skin));
    }
}

class Animation {
  public:
    Animation(GltfFile& file, const humanoid::Clip& clip, double rate)
        : file_(file), frames_(frames_at(clip, rate)), json_{{"name", clip.name}} {
        json_["channels"] = Json::array();
        json_["samplers"] = Json::array();
    }
    /// Adds a node's channel; translations are multiplied by `scale`.
    void add(const Channel& channel, std::size_t node, double scale) {
        add(channel, channel.translation, node, "translation", scale);
        add(channel, channel.rotation, node, "rotation", 1.0);
        add(channel, channel.scale, node, "scale", 1.0);
    }
    /// Adds a channel of another animation of the file, with its sampler.
    void keep(const Json& channel, const Json& sampler) {
        json_["channels"].push_back(channel);
        json_["channels"].back()["sampler"] = json_["samplers"].size();
        json_["samplers"].push_back(sampler);
    }
    bool is_empty() const { return json_["channels"].empty(); }
    const Json& json() const { return json_; }

  private:
    template <class T>
    void add(const Channel& channel, const Track<T>& from, std::size_t node, const char* path, double scale) {
        if (from.times.empty()) return;
        Track<T> track = with_keys_at(frames_, channel, from);
        if constexpr (T::length() == 4) put_on_one_hemisphere(track);
        const std::size_t width = track.interpolation == Interpolation::Cubic ? 3 : 1;
        std::vector<float> times, numbers;
        for (std::size_t i = 0; i < track.times.size(); ++i) {
            auto time = static_cast<float>(track.times[i]);
            // Round a step's time down: rounded up, it would come too late for a reader at the exact time.
            if (track.interpolation == Interpolation::Step && static_cast<double>(time) > track.times[i])
                time = std::nextafter(time, 0.0f);
            if (!times.empty() && !(time > times.back())) continue;  // identical when rounded to float
            times.push_back(time);
            for (std::size_t k = 0; k < width; ++k) put(numbers, track.values[i * width + k] * scale);
        }
        constexpr const char* names[]{"STEP", "LINEAR", "CUBICSPLINE"};
        // A cubic needs two keys; a single key is a constant in any interpolation.
        if (times.size() == 1 && width == 3) {
            const auto row = static_cast<std::ptrdiff_t>(numbers.size() / 3);
            numbers = std::vector<float>(numbers.begin() + row, numbers.begin() + 2 * row);
            track.interpolation = Interpolation::Step;
        }
        json_["channels"].push_back(
            {{"sampler", json_["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        json_["samplers"].push_back(
            {{"input", file_.add_times(times)},
             {"interpolation", names[static_cast<std::size_t>(track.interpolation)]},
             {"output", file_.add_rows(T::length() == 4 ? "VEC4" : "VEC3", numbers)}});
    }

    GltfFile& file_;
    humanoid::Frames frames_;
    Json json_;
};

/// Keeps channels that do not move nodes, such as morph weights, from the file's animation that the clip came
/// from.
void keep_weights(const Json& animations, std::size_t index, Animation& into) {
    if (index >= animations.size()) return;
    const Json& from = animations[index];
    for (const Json& channel : from.value("channels", Json::array())) {
        const Json target = channel.value("target", Json::object());
        const std::string path = target.value("path", std::string());
        if (path == "translation" || path == "rotation" || path == "scale") continue;
        const auto sampler = channel.value("sampler", std::size_t{0});
        if (sampler < from.at("samplers").size()) into.keep(channel, from.at("samplers")[sampler]);
    }
}

/// Keys a node that does not move.
void add_rest(const Character& character, std::size_t place, std::size_t node, Animation& into) {
    Channel rest{.node = place};
    rest.rotation = {Interpolation::Linear, {0.0}, {character.skeleton[place].rest.rotation}};
    into.add(rest, node, 1.0);
}

/// Nodes are in the skeleton because they are joints or animated. A node that only other animations moved
/// gets a key at its rest pose, so that it stays in the skeleton.
void keep_animated(const Json& animations, const Character& character, const std::vector<std::size_t>& nodes,
                   std::set<std::size_t> animated, Animation& into) {
    for (const Json& animation : animations) {
        for (const Json& channel : animation.value("channels", Json::array())) {
            const Json target = channel.value("target", Json::object());
            if (!target.contains("node") || target.value("path", std::string()) == "weights") continue;
            const auto node = target["node"].get<std::size_t>();
            const auto place = std::find(nodes.begin(), nodes.end(), node);
            if (place == nodes.end() || !animated.insert(node).second) continue;
            add_rest(character, static_cast<std::size_t>(place - nodes.begin()), node, into);
        }
    }
}

std::string with_origin(const Character& shown, const humanoid::Clip& shown_clip, double rate,
                        const GltfOrigin& origin, bool binary, const Worn& worn) {
    // The up axis may have been corrected; the file keeps its own.
    Character character = shown;
    character.clips.push_back(shown_clip);
    read_as(character, character.scale, {});
    const humanoid::Clip clip = std::move(character.clips.back());
    character.clips.pop_back();
    const tinygltf::Model model = gltf_model(origin.bytes, origin.folder);
    std::vector<std::size_t> nodes = gltf_nodes(model);
    if (nodes.size() + worn.nodes.size() != character.skeleton.size())
        throw std::runtime_error("its nodes have changed since it was loaded");
    GltfFile file(gltf_json(origin.bytes), model);
    for (std::size_t i = nodes.size(); i < character.skeleton.size(); ++i) {
        const humanoid::Node& each = character.skeleton[i];
        Json& all = file.json["nodes"];
        nodes.push_back(all.size());
        all[nodes[static_cast<std::size_t>(each.parent)]]["children"].push_back(all.size());
        rig::Transform rest = each.rest;
        rest.translation /= character.scale;
        all.push_back({{"name", each.name}});
        set_transform(all.back(), rest);
    }
    // In a file without skins, readers take whole trees; in one with a skin, only joints and animated nodes.
    const std::size_t keyed = file.json.contains("skins") ? nodes.size() - worn.nodes.size() : 0;
    add_worn(worn, character.skeleton, nodes, character.scale, file);
    const Json animations = file.json.value("animations", Json::array());
    file.json.erase("animations");
    file.normalise_weights();

    Animation animation(file, clip, rate);
    std::set<std::size_t> animated;
    for (const Channel& channel : clip.channels) {
        const std::size_t node = nodes[channel.node];
        animation.add(channel, node, 1.0 / character.scale);
        animated.insert(node);
        Json& json = file.json["nodes"][node];
        if (json.contains("matrix")) {
            rig::Transform rest = character.skeleton[channel.node].rest;
            rest.translation /= character.scale;
            set_transform(json, rest);
        }
    }
    for (std::size_t i = worn.nodes.empty() ? nodes.size() : keyed; i < nodes.size(); ++i)
        if (animated.insert(nodes[i]).second) add_rest(character, i, nodes[i], animation);
    keep_animated(animations, character, nodes, animated, animation);
    const auto same = std::find_if(character.clips.begin(), character.clips.end(),
                                   [&](const humanoid::Clip& each) { return each.name == clip.name; });
    keep_weights(animations, static_cast<std::size_t>(same - character.clips.begin()), animation);
    if (!animation.is_empty()) file.json["animations"] = Json::array({animation.json()});
    return file.bytes(binary);
}

/// Adds a skin for each tree, since a skin's joints must have a common root.
void add_skins(const humanoid::Skeleton& skeleton, GltfFile& file) {
    std::vector<std::size_t> skin_of(skeleton.size());
    Json skins = Json::array();
    for (const std::int32_t each : skeleton.order()) {
        const auto node = static_cast<std::size_t>(each);
        const std::int32_t parent = skeleton[node].parent;
        if (parent < 0) skins.push_back({{"joints", Json::array()}});
        skin_of[node] = parent < 0 ? skins.size() - 1 : skin_of[static_cast<std::size_t>(parent)];
        skins[skin_of[node]]["joints"].push_back(node);
    }
    if (!skins.empty()) file.json["skins"] = std::move(skins);
}

/// True if the file can hold the whole mesh: one tree, a joint for each node, plain colours.
bool is_written(const Character& character) {
    const SkinnedMesh* const mesh = character.skin.mesh.get();
    if (mesh == nullptr || !mesh->pictures.empty() || !mesh->morphs.empty() || !mesh->tints.empty())
        return false;
    std::set<std::size_t> nodes;
    for (const SkinJoint& each : character.skin.joints) nodes.insert(each.node);
    const auto& all = character.skeleton.nodes();
    return nodes.size() == character.skin.joints.size() &&
           std::ranges::count_if(all, [](const humanoid::Node& node) { return node.parent < 0; }) == 1;
}

/// The mesh, bound to the file's first skin, whose joints are all nodes.
void add_mesh(const Character& character, GltfFile& file) {
    const SkinnedMesh& mesh = *character.skin.mesh;
    Json& skin = file.json["skins"][0];
    std::vector<std::uint16_t> joint_of(character.skeleton.size());
    for (std::size_t i = 0; i < skin["joints"].size(); ++i)
        joint_of[skin["joints"][i].get<std::size_t>()] = static_cast<std::uint16_t>(i);
    std::vector<humanoid::Placement> from_bind(joint_of.size());
    for (const SkinJoint& each : character.skin.joints) from_bind[joint_of[each.node]] = each.from_bind;
    std::vector<float> binds, positions, normals, weights;
    for (const humanoid::Placement& each : from_bind) put(binds, each);
    std::vector<std::uint16_t> joints;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        put(positions, glm::dvec3(mesh.positions[i])), put(normals, glm::dvec3(mesh.normals[i]));
        for (std::size_t k = 0; k < 4; ++k) {
            const JointWeights& by = mesh.weights[i];
            joints.push_back(by.weights[k] > 0.0f ? joint_of[character.skin.joints[by.joints[k]].node]
                                                  : std::uint16_t{0});
            weights.push_back(by.weights[k]);
        }
    }
    skin["inverseBindMatrices"] = file.add_rows("MAT4", binds);
    const Json attributes{{"POSITION", file.add_positions(positions)},
                          {"NORMAL", file.add_rows("VEC3", normals)},
                          {"JOINTS_0", file.add_joints(joints)},
                          {"WEIGHTS_0", file.add_rows("VEC4", weights)}};
    Json primitives = Json::array();
    for (const SkinPart& part : mesh.parts) {
        const auto first = mesh.indices.begin() + static_cast<std::ptrdiff_t>(part.first);
        primitives.push_back(
            {{"attributes", attributes},
             {"indices", file.add_indices({first, first + static_cast<std::ptrdiff_t>(part.count)})},
             {"material", add_material(part.colour, file)}});
    }
    file.json["meshes"] = Json::array({{{"name", "body"}, {"primitives", std::move(primitives)}}});
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"name", "body"}, {"mesh", 0}, {"skin", 0}});
}

std::string on_its_own(const Character& character, const humanoid::Clip& clip, double rate, bool binary,
                       const Worn& worn) {
    const humanoid::Skeleton& skeleton = character.skeleton;
    GltfFile file;
    Json nodes = Json::array(), roots = Json::array();
    for (std::size_t i = 0; i < skeleton.size(); ++i) {
        Json node{{"name", skeleton[i].name}};
        if (!skeleton.children(i).empty()) node["children"] = skeleton.children(i);
        set_transform(node, skeleton[i].rest);
        nodes.push_back(std::move(node));
        if (skeleton[i].parent < 0) roots.push_back(i);
    }
    file.json["scene"] = 0;
    file.json["scenes"] = Json::array({{{"nodes", roots}}});
    file.json["nodes"] = std::move(nodes);
    add_skins(skeleton, file);
    if (is_written(character)) add_mesh(character, file);
    std::vector<std::size_t> indices(skeleton.size());
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    add_worn(worn, skeleton, indices, 1.0, file);
    Animation animation(file, clip, rate);
    for (const Channel& channel : clip.channels) animation.add(channel, channel.node, 1.0);
    if (!animation.is_empty()) file.json["animations"] = Json::array({animation.json()});
    return file.bytes(binary);
}

}  // namespace

std::string gltf_bytes(const Character& character, const humanoid::Clip& clip, double rate,
                       const GltfOrigin& origin, bool binary, const Worn& worn) {
    return origin.bytes.empty() ? on_its_own(character, clip, rate, binary, worn)
                                : with_origin(character, clip, rate, origin, binary, worn);
}

}  // namespace tendril::app
