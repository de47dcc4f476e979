#include "app/io/character/fbx_skin.hpp"

#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/texture.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace tendril::app {
namespace {

using humanoid::Placement;

glm::vec3 vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}
std::vector<glm::vec3> vectors_of(const aiVector3D* from, unsigned count) {
    std::vector<glm::vec3> result;
    for (unsigned i = 0; from && i < count; ++i) result.push_back(vector_of(from[i]));
    return result;
}

class FbxSkinReader {
  public:
    FbxSkinReader(const aiScene& scene, const std::vector<FbxJoint>& joints, double scale,
                  std::vector<std::string>& notes)
        : scene_(scene), scale_(scale), notes_(notes) {
        for (std::size_t i = 0; i < joints.size(); ++i) {
            nodes_[joints[i].chain.back()] = i;
            names_.emplace(name_of(*joints[i].chain.back()), i);
        }
    }

    Skin read() {
        add_below(*scene_.mRootNode);
        if (picture_outside_)
            notes_.push_back("Its textures are not in the file, so it is drawn in plain colours.");
        return builder_.finish();
    }

  private:
    void add_below(const aiNode& node) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            if (node.mMeshes[i] < scene_.mNumMeshes) add_mesh(*scene_.mMeshes[node.mMeshes[i]], node);
        for (unsigned i = 0; i < node.mNumChildren; ++i) add_below(*node.mChildren[i]);
    }
    /// Scales the bind transform, so that skinning converts the file's unit to metres.
    std::size_t add_joint(std::size_t node, Placement from_bind) {
        from_bind.axes *= scale_;
        from_bind.position *= scale_;
        return builder_.add_joint(node, from_bind);
    }
    bool rigid_joint(const aiNode& mesh_node, std::size_t& joint) {
        Placement from_bind;
        const aiNode* node = &mesh_node;
        while (!nodes_.count(node)) {
            from_bind = placement_of(node->mTransformation) * from_bind;
            node = node->mParent;
            if (!node) return false;
        }
        joint = add_joint(nodes_[node], from_bind);
        return true;
    }

    void add_mesh(const aiMesh& mesh, const aiNode& node) {
        const std::string what = "mesh " + std::string(mesh.mName.C_Str());
        SkinBuilder::Corners corners;
        corners.positions = vectors_of(mesh.mVertices, mesh.mNumVertices);
        corners.normals = vectors_of(mesh.mNormals, mesh.mNumVertices);
        if (mesh.mNumBones > 0 ? !read_influences(mesh, what, corners)
                               : !rigid_joint(node, corners.only_joint))
            return;
        std::vector<std::uint32_t> indices;
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned i = 2; i < mesh.mFaces[f].mNumIndices; ++i)
                indices.insert(indices.end(), {mesh.mFaces[f].mIndices[0], mesh.mFaces[f].mIndices[i - 1],
                                               mesh.mFaces[f].mIndices[i]});
        if (indices.empty()) return;
        const SkinPart part = material(mesh, corners);
        builder_.add_part(what, std::move(corners), std::move(indices), part);
        add_morphs(mesh, what);
    }
    /// Returns whether any bone is a joint.
    bool read_influences(const aiMesh& mesh, const std::string& what, SkinBuilder::Corners& corners) {
        corners.influences.resize(mesh.mNumVertices);
        bool any = false;
        for (unsigned i = 0; i < mesh.mNumBones; ++i) {
            const aiBone& bone = *mesh.mBones[i];
            const auto node = names_.find(bone.mName.C_Str());
            if (node == names_.end()) continue;
            const std::size_t joint = add_joint(node->second, placement_of(bone.mOffsetMatrix));
            if (!any) corners.only_joint = joint;
            any = true;
            for (unsigned k = 0; k < bone.mNumWeights; ++k) {
                const aiVertexWeight& weight = bone.mWeights[k];
                if (weight.mVertexId >= mesh.mNumVertices)
                    throw std::runtime_error(what + ": there is no vertex " +
                                             std::to_string(weight.mVertexId));
                if (weight.mWeight > 0.0f && weight.mWeight <= 1e6f)
                    corners.influences[weight.mVertexId].push_back(
                        {joint, static_cast<double>(weight.mWeight)});
            }
        }
        return any;
    }

    SkinPart material(const aiMesh& mesh, SkinBuilder::Corners& corners) {
        SkinPart part;
        if (mesh.mMaterialIndex >= scene_.mNumMaterials) return part;
        const aiMaterial& material = *scene_.mMaterials[mesh.mMaterialIndex];
        aiColor3D colour;
        if (material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) {
            const glm::vec3 shown(colour.r, colour.g, colour.b);
            if (shown.x >= 0.0f && shown.y >= 0.0f && shown.z >= 0.0f)
                part.colour = glm::vec4(glm::min(shown, glm::vec3(1.0f)), 1.0f);
        }
        aiString name;
        if (material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS) return part;
        part.picture = picture(name.C_Str());
        if (part.picture < 0 || !mesh.mTextureCoords[0]) {
            part.picture = -1;
            return part;
        }
        part.colour = glm::vec4(1.0f);
        for (unsigned i = 0; i < mesh.mNumVertices; ++i)  // FBX counts v from the bottom
            corners.uvs.push_back({mesh.mTextureCoords[0][i].x, 1.0f - mesh.mTextureCoords[0][i].y});
        return part;
    }
    std::int32_t picture(const std::string& name) {
        const auto [known, is_new] = pictures_.emplace(name, -1);
        if (!is_new) return known->second;
        const aiTexture* texture = scene_.GetEmbeddedTexture(name.c_str());
        if (texture && texture->mHeight == 0)
            known->second = builder_.add_picture(reinterpret_cast<const unsigned char*>(texture->pcData),
                                                 texture->mWidth);
        picture_outside_ = picture_outside_ || known->second < 0;
        return known->second;
    }

    void add_morphs(const aiMesh& mesh, const std::string& what) {
        for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
            const aiAnimMesh& target = *mesh.mAnimMeshes[i];
            if (target.mNumVertices != mesh.mNumVertices) continue;
            std::vector<glm::vec3> positions = vectors_of(target.mVertices, target.mNumVertices);
            std::vector<glm::vec3> normals =
                mesh.mNormals ? vectors_of(target.mNormals, target.mNumVertices) : std::vector<glm::vec3>();
            for (unsigned k = 0; k < positions.size(); ++k) positions[k] -= vector_of(mesh.mVertices[k]);
            for (unsigned k = 0; k < normals.size(); ++k) normals[k] -= vector_of(mesh.mNormals[k]);
            morph_corners_ += mesh.mNumVertices;
            if (morph_corners_ > 20 * SkinBuilder::max_corners)
                throw std::runtime_error(what + ": too many morphs");
            const auto weight = static_cast<double>(target.mWeight);
            builder_.add_morph(what, target.mName.C_Str(), std::abs(weight) <= 1e3 ? weight : 0.0,
                               std::move(positions), std::move(normals));
        }
    }

    const aiScene& scene_;
    double scale_;
    std::vector<std::string>& notes_;
    SkinBuilder builder_{};
    std::map<const aiNode*, std::size_t> nodes_{};
    std::map<std::string, std::size_t> names_{};
    std::map<std::string, std::int32_t> pictures_{};
    std::size_t morph_corners_ = 0;
    bool picture_outside_ = false;
};

}  // namespace

Skin fbx_skin(const aiScene& scene, const std::vector<FbxJoint>& joints, double scale,
              std::vector<std::string>& notes) {
    return FbxSkinReader(scene, joints, scale, notes).read();
}

}  // namespace tendril::app
