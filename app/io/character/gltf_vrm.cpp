#include "app/io/character/gltf_vrm.hpp"
#include "app/document/text.hpp"

#include <algorithm>
#include <stdexcept>

namespace tendril::app {
namespace {

using tinygltf::Value;

const Value* member(const Value& object, const char* name) {
    return object.IsObject() && object.Has(name) ? &object.Get(name) : nullptr;
}

class VrmReader {
  public:
    VrmReader(const char* extension, std::size_t count) : count_(count) {
        bones_.extension = extension;
        bones_.nodes.fill(-1);
    }

    /// VRM's names begin in lower case: "leftUpperArm".
    void add(std::string name, const Value* node) {
        const std::string what = std::string(bones_.extension) + ".humanoid.humanBones " + name;
        const auto bone = humanoid::bone_named(capitalised(name));
        if (!bone) return;
        if (!node || !node->IsInt()) throw std::runtime_error(what + ": expected a node number");
        const int index = node->GetNumberAsInt();
        if (index < 0 || static_cast<std::size_t>(index) >= count_)
            throw std::runtime_error(what + ": there is no node " + std::to_string(index) +
                                     ", the file has " + std::to_string(count_));
        if (std::ranges::find(bones_.nodes, index) != bones_.nodes.end())
            throw std::runtime_error(what + ": node " + std::to_string(index) + " is already another bone");
        bones_.nodes[static_cast<std::size_t>(*bone)] = index;
    }
    const VrmBones& bones() const { return bones_; }

  private:
    VrmBones bones_{};
    std::size_t count_;
};

}  // namespace

std::optional<VrmBones> vrm_bones(const tinygltf::Model& model) {
    for (const char* name : {"VRMC_vrm", "VRM", "VRMC_vrm_animation"}) {
        const auto found = model.extensions.find(name);
        if (found == model.extensions.end()) continue;
        const Value* human = member(found->second, "humanoid");
        const Value* bones = human ? member(*human, "humanBones") : nullptr;
        if (!bones) continue;
        VrmReader reader(name, model.nodes.size());
        if (bones->IsObject()) {  // 1.0: by name
            for (const std::string& key : bones->Keys()) reader.add(key, member(bones->Get(key), "node"));
        } else if (bones->IsArray()) {  // 0.x: a list
            for (std::size_t i = 0; i < bones->ArrayLen(); ++i) {
                const Value& each = bones->Get(static_cast<int>(i));
                const Value* bone = member(each, "bone");
                if (bone && bone->IsString()) reader.add(bone->Get<std::string>(), member(each, "node"));
            }
        }
        return reader.bones();
    }
    return std::nullopt;
}

}  // namespace tendril::app
