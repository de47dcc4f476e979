#include <assimp/config.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/ProgressHandler.hpp>
#include <cmath>
#include <set>
#include <stdexcept>

#include "app/document/json.hpp"
#include "app/io/character/fbx.hpp"
#include "app/io/character/fbx_scene.hpp"
#include "app/io/character/fbx_skin.hpp"
#include "app/io/character/fbx_structure.hpp"
#include "app/io/character/unique_names.hpp"

// Debian builds Assimp with assertions, so a bad file could abort the program. This replaces the library's
// handler, which cannot be set from outside, and throws instead.
namespace Assimp {
void aiAssertViolation(const char* expression, const char*, int);
void aiAssertViolation(const char* expression, const char*, int) {
    throw std::runtime_error(std::string("an assumption of Assimp does not hold: ") + expression);
}
}  // namespace Assimp

namespace tendril::app {
namespace {

using humanoid::Clip;
using humanoid::Node;
using humanoid::Placement;

/// Makes Assimp stop once `progress` is cancelled.
class AssimpProgress final : public Assimp::ProgressHandler {
  public:
    explicit AssimpProgress(LoadProgress* progress) : progress_(progress) {}
    bool Update(float) override { return !progress_ || !progress_->cancelled(); }

  private:
    LoadProgress* progress_;
};

class FbxReader {
  public:
    FbxReader(const aiScene& scene, const FbxObjects& objects) : scene_(scene), objects_(objects) {}

    Character read() {
        find_what_is_no_body();
        find_wanted(*scene_.mRootNode);
        leave_out_small_trees();
        if (wanted_.empty())
            throw std::runtime_error(
                "has no skeleton: no mesh has bones, no node is a joint, and none is animated");
        collect(*scene_.mRootNode, -1, {});
        std::vector<Node> nodes = read_nodes();
        std::vector<Clip> clips;
        for (unsigned i = 0; i < scene_.mNumAnimations; ++i)
            clips.push_back(fbx_clip(*scene_.mAnimations[i], i, joints_));

        Character character;
        read_units(character);
        normalise(nodes, clips, character.up, character.scale);
        character.skeleton = skeleton_of(std::move(nodes));
        for (Clip& clip : clips) {
            if (const Result bad = check(clip, character.skeleton); !bad)
                throw std::runtime_error(bad.message());
            if (!clip.channels.empty()) character.clips.push_back(std::move(clip));
        }
        character.skin = fbx_skin(scene_, joints_, character.scale, character.notes);
        return character;
    }

  private:
    void find_what_is_no_body() {
        for (unsigned i = 0; i < scene_.mNumCameras; ++i) {
            no_body_.insert(scene_.mCameras[i]->mName.C_Str());
            no_body_.insert(std::string(scene_.mCameras[i]->mName.C_Str()) + ".Target");
        }
        for (unsigned i = 0; i < scene_.mNumLights; ++i) {
            no_body_.insert(scene_.mLights[i]->mName.C_Str());
            no_body_.insert(std::string(scene_.mLights[i]->mName.C_Str()) + ".Target");
        }
        for (unsigned i = 0; i < scene_.mNumMeshes; ++i)
            for (unsigned k = 0; k < scene_.mMeshes[i]->mNumBones; ++k)
                bones_.insert(plain_name(scene_.mMeshes[i]->mBones[k]->mName.C_Str()));
        for (unsigned i = 0; i < scene_.mNumAnimations; ++i)
            for (unsigned k = 0; k < scene_.mAnimations[i]->mNumChannels; ++k)
                animated_.insert(plain_name(scene_.mAnimations[i]->mChannels[k]->mNodeName.C_Str()));
    }
    /// Marks as wanted every node that is a bone or has one below it. If no mesh has bones, limbs and
    /// animated nodes count as bones.
    bool find_wanted(const aiNode& node) {
        const std::string name = plain_name(name_of(node));
        if (no_body_.count(name)) return false;
        const bool is_limb = objects_.limbs().count(name) && node.mNumMeshes == 0;
        bool is_wanted = bones_.count(name) ||
                         (bones_.empty() && (is_limb || (animated_.count(name) && node.mNumMeshes == 0)));
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            if (find_wanted(*node.mChildren[i])) is_wanted = true;
        if (is_wanted) wanted_.insert(&node);
        return is_wanted;
    }
    std::size_t count_wanted(const aiNode& node) const {
        std::size_t count = wanted_.count(&node);
        for (unsigned i = 0; i < node.mNumChildren; ++i) count += count_wanted(*node.mChildren[i]);
        return count;
    }
    /// A rotating sky dome is no skeleton: drops top-level trees with less than a tenth of the largest one's
    /// nodes.
    void leave_out_small_trees() {
        const aiNode& root = *scene_.mRootNode;
        std::vector<std::size_t> counts;
        for (unsigned i = 0; i < root.mNumChildren; ++i) counts.push_back(count_wanted(*root.mChildren[i]));
        if (counts.empty()) return;
        const std::size_t most = *std::max_element(counts.begin(), counts.end());
        for (unsigned i = 0; i < root.mNumChildren; ++i)
            if (10 * counts[i] < most) wanted_.erase(root.mChildren[i]);
    }
    /// Collects wanted nodes and their descendants without meshes. Skips the root that Assimp adds.
    void collect(const aiNode& node, std::int32_t parent, std::vector<const aiNode*> chain) {
        const bool hangs_on_body =
            parent >= 0 && node.mNumMeshes == 0 && !no_body_.count(plain_name(name_of(node)));
        const bool is_root = &node == scene_.mRootNode;
        if (!is_root && !wanted_.count(&node) && !hangs_on_body) return;
        if (is_root && node.mTransformation.IsIdentity()) {
            for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], parent, {});
            return;
        }
        chain.push_back(&node);
        if (is_pivot(node) && node.mNumChildren == 1)
            return collect(*node.mChildren[0], parent, std::move(chain));
        if (joints_.size() >= humanoid::Skeleton::max_nodes)
            throw std::runtime_error("has more than " + std::to_string(humanoid::Skeleton::max_nodes) +
                                     " nodes");
        const auto place = static_cast<std::int32_t>(joints_.size());
        joints_.push_back({std::move(chain), parent});
        for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], place, {});
    }
    std::vector<Node> read_nodes() const {
        std::vector<Node> nodes;
        UniqueNames names;
        for (const FbxJoint& joint : joints_) {
            const std::string name = names.add(plain_name(name_of(*joint.chain.back())), nodes.size());
            Placement rest;
            for (const aiNode* part : joint.chain) rest = rest * placement_of(part->mTransformation);
            nodes.push_back({name, joint.parent, transform_of(rest)});
        }
        return nodes;
    }

    void read_units(Character& character) const {
        character.scale = 0.01;
        if (!scene_.mMetaData) return;
        double centimetres = 1.0;
        float single = 1.0f;
        if (scene_.mMetaData->Get("UnitScaleFactor", centimetres) && std::isfinite(centimetres) &&
            centimetres > 0.0)
            character.scale = 0.01 * centimetres;
        else if (scene_.mMetaData->Get("UnitScaleFactor", single) && std::isfinite(single) && single > 0.0f)
            character.scale = 0.01 * static_cast<double>(single);
        int axis = 1;
        if (scene_.mMetaData->Get("UpAxis", axis)) character.up = axis == 0 ? 'x' : axis == 2 ? 'z' : 'y';
    }

    const aiScene& scene_;
    const FbxObjects& objects_;
    std::set<std::string> no_body_{}, bones_{}, animated_{};
    std::set<const aiNode*> wanted_{};
    std::vector<FbxJoint> joints_{};
};

}  // namespace

Character parse_fbx(std::string_view bytes, const std::string& name, LoadProgress* progress) {
    try {
        if (bytes.empty()) throw std::runtime_error("is empty");
        const FbxObjects objects = fbx_objects(bytes);
        Assimp::Importer importer;
        importer.SetProgressHandler(new AssimpProgress(progress));  // the importer deletes it
        importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
        const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx");
        if (!scene || !scene->mRootNode) throw std::runtime_error(importer.GetErrorString());
        report(progress, 0.7);
        return FbxReader(*scene, objects).read();
    } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
    }
}

}  // namespace tendril::app
