// The models of an FBX file as nodes, and the transforms that their properties make.
//
// A node's local matrix is T Roff Rp Rpre R Rpost^-1 Rp^-1 Soff Sp S Sp^-1 (Autodesk, "FBX SDK: Computing
// transformation matrices"): always a translation, a rotation and a scale. A child's InheritType decides how
// much of its parent's scale it inherits, so transforms are composed in two parts: `unscaled`, all but the
// node's own scale, and `scale`.
#pragma once

#include <span>
#include <string>
#include <tendril/humanoid/skeleton.hpp>
#include <vector>

#include "app/io/character/fbx/record.hpp"

namespace tendril::app::fbx {

/// How a node combines with its parent's rotation R and scale S.
enum class Inherit : std::uint8_t {
    ByComponent,  ///< "RrSs": the scales multiply by component after both rotations
    Normal,       ///< "RSrs": matrices multiply
    NoScale       ///< "Rrs": the parent's own scale is ignored; Maya's segment scale compensation
};

/// The animated values; the rotation includes all but pre- and post-rotation.
struct Values {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
};

struct Node {
    std::size_t object = 0;
    std::string name{};
    std::int32_t parent = -1;
    std::string_view subtype{};  ///< "LimbNode", "Mesh", "Camera"
    bool has_mesh = false;

    glm::dvec3 translation{0.0}, euler{0.0}, scale{1.0};  ///< at rest; degrees
    int order = 0;                                        ///< rotation order: XYZ, XZY, YZX, YXZ, ZXY, ZYX
    Inherit inherit = Inherit::ByComponent;
    glm::dquat pre{1.0, 0.0, 0.0, 0.0}, post{1.0, 0.0, 0.0, 0.0};  ///< `post` is applied inverted
    glm::dvec3 rotation_offset{0.0}, rotation_pivot{0.0}, scaling_offset{0.0}, scaling_pivot{0.0};
    humanoid::Placement geometry{};  ///< the transform of its mesh alone

    /// True if the translation depends on rotation and scale.
    bool has_pivots() const;
    Values rest() const;
};

/// The models; a parent may come later in the list. Appends sentences to `notes`. Throws std::runtime_error
/// for nodes below themselves and for more than Skeleton::max_nodes * 16.
std::vector<Node> read_nodes(const Objects& objects, std::vector<std::string>& notes);
/// The nodes' indices, parents first.
std::vector<std::size_t> parents_first(const std::vector<Node>& nodes);

/// Rotates about the axis of the first letter of `order` first. Degrees.
glm::dquat from_euler(const glm::dvec3& degrees, int order);
/// Translation, rotation and scale of the node's local matrix.
rig::Transform local_of(const Node& node, const Values& values);

/// A node's place in the file's space: the point p is at unscaled * (scale * p) + position.
struct Place {
    glm::dmat3 unscaled{1.0};
    glm::dvec3 scale{1.0};
    glm::dvec3 inherited{1.0};  ///< the part of `scale` that comes from ancestors
    glm::dvec3 position{0.0};
    humanoid::Placement placement() const;
};
Place place_below(const Place& parent, Inherit inherit, const rig::Transform& local);
/// Every node's place by its local transform.
std::vector<Place> places(const std::vector<Node>& nodes, std::span<const rig::Transform> locals);

}  // namespace tendril::app::fbx
