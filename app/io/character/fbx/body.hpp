// The nodes of an FBX file that form the skeleton, and their transforms in it.
//
// The skeleton: the nodes that skins are bound to (without a skin: limbs and animated nodes), their
// ancestors, and their descendants. Cameras, lights, their targets and nodes that only hold meshes are
// omitted.
//
// A skeleton's nodes inherit all of their parent's scale. A node with another InheritType has its scale
// divided by the parent's. If that would need shear, because the parent's scale is not uniform, the parent
// becomes two nodes: itself without its scale, for such children, and "Hips scale" below it, for its skin and
// all other children.
#pragma once

#include "app/io/character/fbx/animation.hpp"

namespace tendril::app::fbx {

/// A node of the skeleton.
struct Bone {
    std::size_t node = 0;  ///< the file's node
    std::int32_t parent = -1;
    bool is_scale = false;  ///< the second of two nodes
};

struct Body {
    std::vector<Node> nodes{};            ///< the file's nodes
    std::vector<Bone> bones{};            ///< parents first
    std::vector<std::int32_t> bone_of{};  ///< for each node, the bone with its full transform; -1: none
    std::vector<bool> is_split{};         ///< for each node, whether it is two bones

    /// The bone's transform below its parent; `local` gives the local transform of a node of the file.
    template <class Local>
    rig::Transform transform(std::size_t bone, const Local& local) const;
    /// The nodes whose scales make up the scale of `node`: itself, and its ancestors up to where scale is no
    /// longer inherited separately.
    std::vector<std::size_t> scale_chain(std::size_t node) const;

  private:
    template <class Local>
    glm::dvec3 inherited(std::size_t node, const Local& local) const;
    template <class Local>
    glm::dvec3 whole_scale(std::size_t node, const Local& local) const;
};

/// True if `node` inherits only part of its parent's scale.
bool is_apart(const Node& node);

/// Throws std::runtime_error if there is no skeleton.
Body choose_body(const Objects& objects, std::vector<Node> nodes, const std::vector<Stack>& stacks);

template <class Local>
glm::dvec3 Body::inherited(std::size_t node, const Local& local) const {
    glm::dvec3 scale(1.0);
    while (is_apart(nodes[node])) {
        const auto parent = static_cast<std::size_t>(nodes[node].parent);
        if (nodes[node].inherit == Inherit::ByComponent) scale *= local(parent).scale;
        node = parent;
    }
    return scale;
}
template <class Local>
glm::dvec3 Body::whole_scale(std::size_t node, const Local& local) const {
    return inherited(node, local) * local(node).scale;
}

template <class Local>
rig::Transform Body::transform(std::size_t index, const Local& local) const {
    const Bone& bone = bones[index];
    const Node& node = nodes[bone.node];
    rig::Transform result;
    if (bone.is_scale) {
        result.scale = whole_scale(bone.node, local);
        return result;
    }
    result = local(bone.node);
    const bool split = is_split[bone.node];
    if (!is_apart(node)) {
        if (split) result.scale = glm::dvec3(1.0);
        return result;
    }
    const auto parent = static_cast<std::size_t>(node.parent);
    const glm::dvec3 above = whole_scale(parent, local);
    result.scale = split ? glm::dvec3(1.0) : whole_scale(bone.node, local);
    if (is_split[parent])
        result.translation *= above;
    else
        result.scale /= above;
    return result;
}

}  // namespace tendril::app::fbx
