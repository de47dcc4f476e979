#include "app/io/character/fbx_scene.hpp"

namespace tendril::app {
namespace {

constexpr const char* pivot_mark = "_$AssimpFbx$_";

}  // namespace

using humanoid::Placement;

std::string name_of(const aiNode& node) {
    return node.mName.C_Str();
}

Placement placement_of(const aiMatrix4x4& m) {
    Placement result;
    result.axes = {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}};
    result.position = {m.a4, m.b4, m.c4};
    return result;
}

rig::Transform transform_of(Placement placement) {
    rig::Transform result;
    for (int i = 0; i < 3; ++i) result.scale[i] = glm::length(placement.axes[i]);
    if (glm::determinant(placement.axes) < 0.0) {
        placement.axes[2] = -placement.axes[2];
        result.scale[2] = -result.scale[2];
    }
    result.rotation = placement.rotation();
    result.translation = placement.position;
    return result;
}

bool is_pivot(const aiNode& node) {
    return name_of(node).find(pivot_mark) != std::string::npos;
}

std::string plain_name(std::string name) {
    if (const std::size_t mark = name.find(pivot_mark); mark != name.npos) name.resize(mark);
    return name;
}

}  // namespace tendril::app
