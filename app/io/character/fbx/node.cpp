#include "app/io/character/fbx/node.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "tendril/elementary.hpp"

namespace tendril::app::fbx {
namespace {

constexpr std::size_t max_models = 65'536;
constexpr std::array<std::array<int, 3>, 6> axis_orders{
    {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};

glm::dmat3 diagonal(const glm::dvec3& scale) {
    glm::dmat3 matrix(0.0);
    for (int i = 0; i < 3; ++i) matrix[i][i] = scale[i];
    return matrix;
}

bool is_mesh(const Objects& objects, std::size_t object) {
    if (objects[object].record->child("PolygonVertexIndex")) return true;  // version 6
    return std::ranges::any_of(objects.children(object), [&](const Connection& each) {
        return objects[each.object].kind == "Geometry" &&
               objects[each.object].record->child("PolygonVertexIndex");
    });
}

/// True if a minimum or maximum is switched on for any axis of translation, rotation or scale.
bool has_limits(const Objects& objects, std::size_t object) {
    for (const std::string property : {"Translation", "Rotation", "Scaling"}) {
        if (objects.integer(object, property + "Active", 0) == 0) continue;
        for (const char* end : {"MinX", "MinY", "MinZ", "MaxX", "MaxY", "MaxZ"})
            if (objects.integer(object, property + end, 0) != 0) return true;
    }
    return false;
}

Node read_node(const Objects& objects, std::size_t object, std::vector<std::string>& notes) {
    const auto vector = [&](std::string_view name, double otherwise = 0.0) {
        return objects.vector(object, name, glm::dvec3(otherwise));
    };
    Node node;
    node.object = object;
    node.name = objects[object].name;
    node.subtype = objects[object].subtype;
    node.has_mesh = is_mesh(objects, object);
    node.translation = vector("Lcl Translation");
    node.euler = vector("Lcl Rotation");
    node.scale = vector("Lcl Scaling", 1.0);
    // Order, pre- and post-rotation need RotationActive, and may apply only to limits.
    if (objects.integer(object, "RotationActive", 0) != 0 &&
        objects.integer(object, "RotationSpaceForLimitOnly", 0) == 0) {
        const std::int64_t order = objects.integer(object, "RotationOrder", 0);
        if (order >= 0 && order < static_cast<std::int64_t>(axis_orders.size()))
            node.order = static_cast<int>(order);
        else
            notes.push_back("Node " + node.name + " has a spheric rotation order, which is read as XYZ.");
        node.pre = from_euler(vector("PreRotation"), 0);
        node.post = from_euler(vector("PostRotation"), 0);
    }
    const std::int64_t inherit = objects.integer(object, "InheritType", 0);
    node.inherit = inherit == 1 ? Inherit::Normal : inherit == 2 ? Inherit::NoScale : Inherit::ByComponent;
    node.rotation_offset = vector("RotationOffset");
    node.rotation_pivot = vector("RotationPivot");
    node.scaling_offset = vector("ScalingOffset");
    node.scaling_pivot = vector("ScalingPivot");
    node.geometry =
        humanoid::placement({vector("GeometricTranslation"), from_euler(vector("GeometricRotation"), 0),
                             vector("GeometricScaling", 1.0)});
    return node;
}

}  // namespace

bool Node::has_pivots() const {
    const glm::dvec3 none(0.0);
    return rotation_pivot != none || scaling_offset != none || scaling_pivot != none;
}

Values Node::rest() const {
    return {translation, from_euler(euler, order), scale};
}

std::vector<Node> read_nodes(const Objects& objects, std::vector<std::string>& notes) {
    std::vector<Node> nodes;
    std::vector<std::int32_t> node_of(objects.size(), -1);
    bool limited = false;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        if (objects[i].kind != "Model") continue;
        if (nodes.size() >= max_models)
            throw std::runtime_error("has more than " + std::to_string(max_models) + " models");
        node_of[i] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(read_node(objects, i, notes));
        limited = limited || has_limits(objects, i);
    }
    if (limited) notes.push_back("The limits of the file's nodes are not evaluated.");
    for (Node& node : nodes) {
        for (const Connection& each : objects.parents(node.object)) {
            const std::int32_t parent = node_of[each.object];
            if (parent < 0 || !each.property.empty() || parent == node.parent) continue;
            if (node.parent >= 0) {
                notes.push_back("Node " + node.name + " has several parents; only the first is used.");
                break;
            }
            node.parent = parent;
        }
    }
    static_cast<void>(parents_first(nodes));  // refuses cycles
    return nodes;
}

std::vector<std::size_t> parents_first(const std::vector<Node>& nodes) {
    std::vector<std::vector<std::size_t>> below(nodes.size());
    std::vector<std::size_t> order, roots;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent < 0)
            order.push_back(i);
        else
            below[static_cast<std::size_t>(nodes[i].parent)].push_back(i);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::vector<std::size_t>& next = below[order[i]];
        order.insert(order.end(), next.begin(), next.end());
    }
    if (order.size() == nodes.size()) return order;
    std::vector<bool> seen(nodes.size());
    for (const std::size_t i : order) seen[i] = true;
    std::size_t node = static_cast<std::size_t>(std::ranges::find(seen, false) - seen.begin());
    for (std::size_t i = 0; i < nodes.size(); ++i) node = static_cast<std::size_t>(nodes[node].parent);
    throw std::runtime_error("model " + nodes[node].name + " is below itself");
}

glm::dquat from_euler(const glm::dvec3& degrees, int order) {
    glm::dquat result(1.0, 0.0, 0.0, 0.0);
    for (const int axis : axis_orders[static_cast<std::size_t>(order)]) {
        glm::dvec3 along(0.0);
        along[axis] = 1.0;
        result = math::rotation_about(along, glm::radians(degrees[axis])) * result;
    }
    return result;
}

rig::Transform local_of(const Node& node, const Values& values) {
    rig::Transform local;
    local.rotation = rig::normalised(node.pre * values.rotation * glm::conjugate(node.post));
    local.scale = values.scale;
    local.translation = values.translation + node.rotation_offset + node.rotation_pivot +
                        local.rotation * (node.scaling_offset + node.scaling_pivot - node.rotation_pivot -
                                          values.scale * node.scaling_pivot);
    return local;
}

humanoid::Placement Place::placement() const {
    return {unscaled * diagonal(scale), position};
}

Place place_below(const Place& parent, Inherit inherit, const rig::Transform& local) {
    Place place;
    const glm::dmat3 rotation = glm::mat3_cast(local.rotation);
    place.position = parent.position + parent.unscaled * (parent.scale * local.translation);
    if (inherit == Inherit::Normal) {
        place.unscaled = parent.unscaled * diagonal(parent.scale) * rotation;
        place.scale = local.scale;
        return place;
    }
    place.unscaled = parent.unscaled * rotation;
    place.inherited = inherit == Inherit::NoScale ? parent.inherited : parent.scale;
    place.scale = place.inherited * local.scale;
    return place;
}

std::vector<Place> places(const std::vector<Node>& nodes, std::span<const rig::Transform> locals) {
    std::vector<Place> result(nodes.size());
    for (const std::size_t i : parents_first(nodes)) {
        const Place parent =
            nodes[i].parent < 0 ? Place() : result[static_cast<std::size_t>(nodes[i].parent)];
        result[i] = place_below(parent, nodes[i].inherit, locals[i]);
    }
    return result;
}

}  // namespace tendril::app::fbx
