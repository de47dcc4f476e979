#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "app/io/character/gltf.hpp"
#include "app/io/character/gltf_bytes.hpp"
#include "app/io/character/gltf_keys.hpp"
#include "app/io/character/gltf_skin.hpp"
#include "app/io/character/gltf_vrm.hpp"
#include "app/io/character/unique_names.hpp"
#include "app/io/text.hpp"

namespace tendril::app {
namespace {

using humanoid::Channel;
using humanoid::Clip;
using humanoid::Interpolation;
using humanoid::Node;

/// Limit for all clips together: clips can share keys, so even a small file can claim any number.
constexpr std::size_t max_clip_keys = 20'000'000;

/// Replaces a scale of 0, which has no inverse: 2 m below it become 2 µm.
constexpr double tiny_scale = 1e-6;

/// Nodes changed so that they can be read.
struct MendedNodes {
    std::size_t count = 0;
    std::string first{};
    void add(const std::string& name) {
        if (count++ == 0) first = name;
    }
};

/// "Keys dropped: 3 before 0 s, 1 rotation of length 0 (first in clip bend, j1)."
std::string dropped_text(const DroppedKeys& keys) {
    std::string list;
    const auto add = [&](std::size_t count, const std::string& what) {
        if (count > 0) list += (list.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
    };
    add(keys.early, "before 0 s");
    add(keys.doubled, "with another at the same time");
    add(keys.zero, std::string(keys.zero == 1 ? "rotation" : "rotations") + " of length 0");
    return "Keys dropped: " + list + " (first in " + keys.first + ").";
}

/// Translation, rotation and scale of a column-major matrix, as in glTF; shear is lost.
rig::Transform decomposed(const std::vector<double>& m) {
    humanoid::Placement placement;
    rig::Transform result;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) placement.axes[c][r] = m[static_cast<std::size_t>(4 * c + r)];
        result.scale[c] = glm::length(placement.axes[c]);
    }
    if (glm::determinant(placement.axes) < 0.0) {
        placement.axes[2] = -placement.axes[2];
        result.scale[2] = -result.scale[2];
    }
    result.rotation = placement.rotation();
    result.translation = {m[12], m[13], m[14]};
    return result;
}

rig::Transform local_of(const tinygltf::Node& node, std::size_t index) {
    rig::Transform local;
    const auto has = [&](const std::vector<double>& list, std::size_t wanted, const char* what) {
        if (list.empty() || list.size() == wanted) return !list.empty();
        throw std::runtime_error("nodes[" + std::to_string(index) + "]." + what + ": expected " +
                                 std::to_string(wanted) + " numbers, found " + std::to_string(list.size()));
    };
    for (const std::vector<double>* list : {&node.matrix, &node.translation, &node.rotation, &node.scale})
        for (const double each : *list)
            if (!std::isfinite(each))
                throw std::runtime_error("nodes[" + std::to_string(index) +
                                         "] has a number that is not finite");
    if (has(node.matrix, 16, "matrix")) return decomposed(node.matrix);
    if (has(node.translation, 3, "translation"))
        local.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (has(node.rotation, 4, "rotation"))
        local.rotation = {node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]};
    if (has(node.scale, 3, "scale")) local.scale = {node.scale[0], node.scale[1], node.scale[2]};
    return local;
}

class GltfReader {
  public:
    explicit GltfReader(const tinygltf::Model& model, LoadProgress* progress = nullptr)
        : model_(model), progress_(progress), parents_(model_.nodes.size(), -1) {}

    Character read() {
        find_parents();
        choose();
        std::vector<Node> nodes = read_nodes();
        std::vector<Clip> clips;
        for (std::size_t i = 0; i < model_.animations.size(); ++i) {
            report(progress_,
                   0.5 + 0.3 * static_cast<double>(i) / static_cast<double>(model_.animations.size()));
            clips.push_back(read_clip(i));
        }
        report(progress_, 0.8);
        Character character;
        character.skeleton = skeleton_of(std::move(nodes));
        if (flat_.count > 0)
            character.notes.push_back(
                "A scale of 0 is taken as 0.000001: " + flat_.first +
                (flat_.count > 1 ? " and " + std::to_string(flat_.count - 1) + " more" : "") + '.');
        for (const Clip& clip : clips)
            if (const Result bad = check(clip, character.skeleton); !bad)
                throw std::runtime_error(bad.message());
        character.clips = std::move(clips);
        if (vrm_) {
            character.bones.emplace();
            character.bones->source = vrm_->extension;
            for (std::size_t i = 0; i < vrm_->nodes.size(); ++i)
                character.bones->nodes[i] =
                    vrm_->nodes[i] < 0 ? -1 : place_[static_cast<std::size_t>(vrm_->nodes[i])];
        }
        character.springs = named_springs(springs_, character, place_, character.notes);
        note_unfollowed(model_, character.notes);
        std::vector<humanoid::Placement> local;
        for (std::size_t i = 0; i < model_.nodes.size(); ++i)
            local.push_back(humanoid::placement(local_of(model_.nodes[i], i)));
        character.skin = gltf_skin(model_, {parents_, place_}, local, dropped_, character.notes);
        if (dropped_.any()) character.notes.push_back(dropped_text(dropped_));
        note_pointers(character.notes);
        return character;
    }

    /// The file's node for each of the skeleton's nodes.
    std::vector<std::size_t> nodes() {
        find_parents();
        choose();
        return std::move(chosen_);
    }

  private:
    static std::string indexed(const char* list, std::size_t index) {
        return std::string(list) + '[' + std::to_string(index) + ']';
    }
    std::size_t node_at(int index, const std::string& what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
            throw std::runtime_error(what + ": there is no node " + std::to_string(index) +
                                     ", the file has " + std::to_string(model_.nodes.size()));
        return static_cast<std::size_t>(index);
    }
    void find_parents() {
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            for (const int each : model_.nodes[i].children) {
                const std::size_t child = node_at(each, indexed("nodes", i) + ".children");
                if (parents_[child] >= 0)
                    throw std::runtime_error(indexed("nodes", child) + " is a child of two nodes, " +
                                             std::to_string(parents_[child]) + " and " + std::to_string(i));
                parents_[child] = static_cast<std::int32_t>(i);
            }
        }
    }
    /// Chooses joints, VRM bones, animated nodes and their ancestors.
    void choose() {
        std::vector<bool> wanted(model_.nodes.size());
        bool any = false;
        for (std::size_t i = 0; i < model_.skins.size(); ++i)
            for (const int joint : model_.skins[i].joints)
                wanted[node_at(joint, indexed("skins", i) + ".joints")] = any = true;
        for (std::size_t i = 0; i < model_.animations.size(); ++i)
            for (const auto& channel : model_.animations[i].channels)
                if (channel.target_node >= 0 && channel.target_path != "weights")
                    wanted[node_at(channel.target_node, indexed("animations", i) + ".channels")] = any = true;
        vrm_ = vrm_bones(model_);
        if (vrm_)
            for (const int node : vrm_->nodes)
                if (node >= 0) wanted[static_cast<std::size_t>(node)] = any = true;
        if (!any)
            throw std::runtime_error("has no skeleton: no node is a joint of a skin, and none is animated" +
                                     compressed_text());
        springs_ = vrm_springs(model_);
        for (const VrmSpring& each : springs_) {
            choose_below(static_cast<std::size_t>(each.node), wanted);
            for (const SpringCollider& collider : each.colliders) wanted[collider.node] = true;
        }
        if (model_.skins.empty()) choose_whole_trees(wanted);
        place_.assign(model_.nodes.size(), -1);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            if (!wanted[i]) continue;
            std::size_t steps = 0;
            for (std::int32_t above = parents_[i]; above >= 0 && !wanted[static_cast<std::size_t>(above)];
                 above = parents_[static_cast<std::size_t>(above)]) {
                wanted[static_cast<std::size_t>(above)] = true;
                if (++steps > wanted.size()) break;  // a cycle: Skeleton::make reports it
            }
        }
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (wanted[i]) place_[i] = static_cast<std::int32_t>(chosen_.size()), chosen_.push_back(i);
        if (chosen_.size() > humanoid::Skeleton::max_nodes)
            throw std::runtime_error("its skeleton has " + std::to_string(chosen_.size()) +
                                     " nodes, more than " + std::to_string(humanoid::Skeleton::max_nodes));
    }
    /// Chooses a spring's nodes; the last ones are often not joints.
    void choose_below(std::size_t root, std::vector<bool>& wanted) const {
        std::vector<std::size_t> open{root};
        for (std::size_t steps = 0; !open.empty() && steps < wanted.size(); ++steps) {
            const std::size_t node = open.back();
            open.pop_back();
            wanted[node] = true;
            for (const int child : model_.nodes[node].children)
                open.push_back(static_cast<std::size_t>(child));
        }
    }
    /// Chooses whole trees: without a skin nothing says which nodes are joints.
    void choose_whole_trees(std::vector<bool>& wanted) const {
        const auto root_of = [&](std::size_t node) {
            for (std::size_t steps = 0; parents_[node] >= 0 && steps < wanted.size(); ++steps)
                node = static_cast<std::size_t>(parents_[node]);
            return node;
        };
        std::set<std::size_t> roots;
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (wanted[i]) roots.insert(root_of(i));
        for (std::size_t i = 0; i < wanted.size(); ++i) wanted[i] = roots.contains(root_of(i));
    }
    std::string compressed_text() const {
        for (const std::string& each : model_.extensionsRequired)
            if (each == "KHR_draco_mesh_compression" || each.ends_with("_meshopt_compression"))
                return "; its meshes are compressed with " + each + ", which cannot be read";
        return {};
    }
    std::vector<Node> read_nodes() {
        std::vector<Node> nodes;
        UniqueNames names;
        for (const std::size_t i : chosen_) {
            const std::int32_t parent = parents_[i] < 0 ? -1 : place_[static_cast<std::size_t>(parents_[i])];
            Node node{names.add(model_.nodes[i].name, i), parent, local_of(model_.nodes[i], i)};
            bool flat = false;
            for (int k = 0; k < 3; ++k) {
                if (node.rest.scale[k] != 0.0) continue;
                node.rest.scale[k] = tiny_scale;
                flat = true;
            }
            if (flat) flat_.add(node.name);
            nodes.push_back(std::move(node));
        }
        return nodes;
    }

    static Interpolation interpolation_of(const std::string& text, const std::string& what) {
        if (text.empty() || text == "LINEAR") return Interpolation::Linear;
        if (text == "STEP") return Interpolation::Step;
        if (text == "CUBICSPLINE") return Interpolation::Cubic;
        throw std::runtime_error(what + ": unknown interpolation \"" + text + '"');
    }
    static void put(glm::dvec3& value, const double* row) { value = {row[0], row[1], row[2]}; }
    static void put(glm::dquat& value, const double* row) { value = {row[3], row[0], row[1], row[2]}; }

    template <class T>
    humanoid::Track<T> read_track(const tinygltf::AnimationSampler& sampler, const std::string& what,
                                  const std::string& where) {
        humanoid::Track<T> track;
        keys_ += accessor_count(model_, sampler.input, what + ".input") +
                 accessor_count(model_, sampler.output, what + ".output");
        if (keys_ > max_clip_keys)
            throw std::runtime_error(what + ": more than " + std::to_string(max_clip_keys) +
                                     " keys in total");
        track.interpolation = interpolation_of(sampler.interpolation, what);
        track.times = accessor_rows(model_, sampler.input, 1, what + ".input");
        const std::vector<double> rows = accessor_rows(model_, sampler.output, T::length(), what + ".output");
        const std::size_t width = static_cast<std::size_t>(T::length());
        const bool cubic = track.interpolation == Interpolation::Cubic;
        if (rows.size() != track.times.size() * width * (cubic ? 3 : 1))
            throw std::runtime_error(what + ": " + std::to_string(track.times.size()) + " times and " +
                                     std::to_string(rows.size() / width) + " values");
        track.values.resize(rows.size() / width);
        for (std::size_t i = 0; i < track.values.size(); ++i) put(track.values[i], &rows[i * width]);
        const std::size_t middle = cubic ? 1 : 0;
        const bool any = dropped_.any();
        drop_bad_keys(
            track.times, track.values, track.interpolation,
            [&](std::size_t first) {
                if constexpr (T::length() == 4)
                    return glm::dot(track.values[first + middle], track.values[first + middle]) < 1e-12;
                else
                    return false;
            },
            dropped_);
        if (!any) dropped_.first = where;
        if constexpr (T::length() == 4)
            for (std::size_t i = middle; i < track.values.size(); i += cubic ? 3 : 1)
                track.values[i] = unit(track.values[i], what + ".output", i);
        return track;
    }
    /// Normalises: keys rounded to bytes are slightly off.
    static glm::dquat unit(const glm::dquat& value, const std::string& what, std::size_t row) {
        const double size = std::sqrt(glm::dot(value, value));
        if (!(size > 0.5 && size < 2.0))
            throw std::runtime_error(what + ", row " + std::to_string(row) +
                                     ": expected a unit quaternion, found one of length " +
                                     std::to_string(size));
        return rig::normalised(value);
    }

    /// Counts the omitted pointers, which animate no node (gltf_parse.cpp).
    void note_pointers(std::vector<std::string>& notes) const {
        std::size_t count = 0;
        std::string first;
        for (const tinygltf::Animation& animation : model_.animations)
            for (const tinygltf::AnimationChannel& channel : animation.channels) {
                if (channel.target_node >= 0) continue;
                const auto found = channel.target_extensions.find("KHR_animation_pointer");
                if (found == channel.target_extensions.end()) continue;
                if (count++ == 0 && found->second.Has("pointer") && found->second.Get("pointer").IsString())
                    first = printable(found->second.Get("pointer").Get<std::string>());
            }
        if (count > 0)
            notes.push_back("Animations of " + std::to_string(count) +
                            (count == 1 ? " property" : " properties") + " are left out (" +
                            (first.empty() ? "no pointer" : "the first is " + first) +
                            "): only translations, rotations, scales and weights of nodes are played.");
    }

    Clip read_clip(std::size_t index) {
        const tinygltf::Animation& animation = model_.animations[index];
        Clip clip;
        clip.name = animation.name.empty() ? "clip_" + std::to_string(index) : animation.name;
        std::map<std::size_t, Channel> channels;
        for (std::size_t i = 0; i < animation.channels.size(); ++i) {
            const tinygltf::AnimationChannel& from = animation.channels[i];
            if (from.target_node < 0 || from.target_path == "weights") continue;
            const std::string what = indexed("animations", index) + '.' + indexed("channels", i);
            if (from.sampler < 0 || static_cast<std::size_t>(from.sampler) >= animation.samplers.size())
                throw std::runtime_error(what + ": there is no sampler " + std::to_string(from.sampler));
            const auto& sampler = animation.samplers[static_cast<std::size_t>(from.sampler)];
            const std::size_t node = node_at(from.target_node, what + ".target");
            const std::string where =
                "clip " + printable(clip.name) + ", " +
                printable(model_.nodes[node].name.empty() ? indexed("nodes", node) : model_.nodes[node].name);
            Channel& to = channels[static_cast<std::size_t>(place_[node])];
            if (from.target_path == "translation")
                to.translation = read_track<glm::dvec3>(sampler, what, where);
            else if (from.target_path == "rotation")
                to.rotation = read_track<glm::dquat>(sampler, what, where);
            else if (from.target_path == "scale")
                to.scale = read_track<glm::dvec3>(sampler, what, where);
            else
                throw std::runtime_error(what + ": unknown path \"" + from.target_path + '"');
        }
        for (auto& [node, channel] : channels) {
            channel.node = node;
            bool any = false;
            for (const std::vector<double>* times :
                 {&channel.translation.times, &channel.rotation.times, &channel.scale.times}) {
                if (times->empty()) continue;
                any = true;
                clip.duration = std::max(clip.duration, times->back());
            }
            if (any) clip.channels.push_back(std::move(channel));
        }
        return clip;
    }

    const tinygltf::Model& model_;
    LoadProgress* progress_;
    std::vector<std::int32_t> parents_;
    std::vector<std::int32_t> place_{};  // index in the skeleton of each of the file's nodes; -1: omitted
    std::vector<std::size_t> chosen_{};  // the inverse of place_
    std::optional<VrmBones> vrm_{};
    std::vector<VrmSpring> springs_{};
    std::size_t keys_ = 0;
    DroppedKeys dropped_{};
    MendedNodes flat_{};
};

}  // namespace

std::vector<std::size_t> gltf_nodes(const tinygltf::Model& model) {
    return GltfReader(model).nodes();
}

Character parse_gltf(std::string_view bytes, const std::string& name, const std::filesystem::path& folder,
                     LoadProgress* progress) {
    try {
        const tinygltf::Model model = gltf_model(bytes, folder);
        report(progress, 0.5);
        return GltfReader(model, progress).read();
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

}  // namespace tendril::app
