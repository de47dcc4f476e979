#include "app/io/character/gltf_vrm.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "app/io/text.hpp"
#include "tendril/elementary.hpp"

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

constexpr std::size_t max_vrm_springs = 4096, max_colliders = 256;  // colliders per spring

const Value* part_of(const Value* object, const char* name) {
    return object && object->IsObject() && object->Has(name) ? &object->Get(name) : nullptr;
}
const Value* part_of(const Value* list, std::size_t index) {
    return list && list->IsArray() && index < list->ArrayLen() ? &list->Get(static_cast<int>(index))
                                                               : nullptr;
}
double number_or(const Value* value, double otherwise, double low, double high) {
    if (!value || !value->IsNumber() || !std::isfinite(value->GetNumberAsDouble())) return otherwise;
    return std::clamp(value->GetNumberAsDouble(), low, high);
}
int node_or_none(const Value* value, const tinygltf::Model& model) {
    const int node = value && value->IsInt() ? value->GetNumberAsInt() : -1;
    return node < static_cast<int>(model.nodes.size()) ? node : -1;
}
const Value* extension(const tinygltf::Model& model, const char* name) {
    const auto found = model.extensions.find(name);
    return found == model.extensions.end() ? nullptr : &found->second;
}

constexpr double max_stiffness = 1e3, max_gravity = 1e3, max_radius = 1e3, max_offset = 1e6;

/// An offset of VRM 1.0, [x, y, z], or of VRM 0.x, {x, y, z} with Unity's z.
glm::dvec3 offset_of(const Value* offset) {
    if (offset && offset->IsObject())
        return {number_or(part_of(offset, "x"), 0.0, -max_offset, max_offset),
                number_or(part_of(offset, "y"), 0.0, -max_offset, max_offset),
                -number_or(part_of(offset, "z"), 0.0, -max_offset, max_offset)};
    glm::dvec3 at(0.0);
    for (int k = 0; k < 3; ++k)
        at[k] = number_or(part_of(offset, static_cast<std::size_t>(k)), 0.0, -max_offset, max_offset);
    return at;
}
double radius_of(const Value* object, const char* name) {
    return number_or(part_of(object, name), 0.0, 0.0, max_radius);
}
void add_collider(const tinygltf::Model& model, const Value* node, const Value* shape, VrmSpring& spring) {
    const int at = node_or_none(node, model);
    if (at < 0 || !shape || !shape->IsObject()) return;
    const glm::dvec3 from = offset_of(part_of(shape, "offset"));
    const Value* tail = part_of(shape, "tail");
    spring.colliders.push_back(
        {static_cast<std::size_t>(at), from, tail ? offset_of(tail) : from, radius_of(shape, "radius")});
}
/// The element of the list that `index` names.
const Value* named_by(const Value* list, const Value* index) {
    return index && index->IsInt() && index->GetNumberAsInt() >= 0
               ? part_of(list, static_cast<std::size_t>(index->GetNumberAsInt()))
               : nullptr;
}

/// Calls take(group, collider) for the first `max_colliders` colliders of the groups that a spring names. A
/// file may repeat a group any number of times.
template <class Take>
void each_collider(const Value* named, const Value* groups, Take take) {
    std::size_t visited = 0;
    for (std::size_t k = 0; const Value* index = part_of(named, k); ++k) {
        const Value* group = named_by(groups, index);
        const Value* colliders = part_of(group, "colliders");
        for (std::size_t j = 0; const Value* collider = part_of(colliders, j); ++j) {
            if (visited++ == max_colliders) return;
            take(group, collider);
        }
    }
}

/// VRM 0.x: groups of roots with the same settings. Its directions have Unity's z.
void add_groups(const tinygltf::Model& model, std::vector<VrmSpring>& springs) {
    const Value* all = part_of(extension(model, "VRM"), "secondaryAnimation");
    const Value *groups = part_of(all, "boneGroups"), *shapes = part_of(all, "colliderGroups");
    for (std::size_t i = 0; const Value* group = part_of(groups, i); ++i) {
        if (springs.size() == max_vrm_springs) return;
        VrmSpring spring;
        spring.stiffness = number_or(part_of(group, "stiffiness"), 1.0, 0.0, max_stiffness);  // sic
        spring.drag = number_or(part_of(group, "dragForce"), 0.4, 0.0, 1.0);
        const double power = number_or(part_of(group, "gravityPower"), 0.0, -max_gravity, max_gravity);
        const Value* direction = part_of(group, "gravityDir");
        const auto along = [&](const char* axis, double otherwise) {
            return number_or(part_of(direction, axis), otherwise, -1.0, 1.0);
        };
        spring.gravity = power * glm::dvec3(along("x", 0.0), along("y", -1.0), -along("z", 0.0));
        spring.hit_radius = radius_of(group, "hitRadius");
        each_collider(part_of(group, "colliderGroups"), shapes, [&](const Value* bone, const Value* sphere) {
            add_collider(model, part_of(bone, "node"), sphere, spring);
        });
        const Value* roots = part_of(group, "bones");
        for (std::size_t k = 0; const Value* root = part_of(roots, k); ++k) {
            spring.node = node_or_none(root, model);
            if (spring.node >= 0 && springs.size() < max_vrm_springs) springs.push_back(spring);
        }
    }
}

/// VRMC_springBone_extended_collider-1.0 by the VRM Consortium. A collider's own shape is the fallback for
/// readers without the extension; this reader uses it for planes and for colliders that hold springs inside.
const Value* extended(const Value* collider) {
    return part_of(part_of(collider, "extensions"), "VRMC_springBone_extended_collider");
}
bool is_beyond_capsules(const Value* shape) {
    if (part_of(shape, "plane")) return true;
    for (const char* kind : {"sphere", "capsule"})
        if (const Value* inside = part_of(part_of(shape, kind), "inside");
            inside && inside->IsBool() && inside->Get<bool>())
            return true;
    return false;
}

/// VRM 1.0: springs are lists of joints. The first joint's settings are used for all.
void add_chains(const tinygltf::Model& model, std::vector<VrmSpring>& springs) {
    const Value* all = extension(model, "VRMC_springBone");
    const Value *chains = part_of(all, "springs"), *groups = part_of(all, "colliderGroups"),
                *shapes = part_of(all, "colliders");
    for (std::size_t i = 0; const Value* chain = part_of(chains, i); ++i) {
        if (springs.size() == max_vrm_springs) return;
        const Value* first = part_of(part_of(chain, "joints"), std::size_t{0});
        VrmSpring spring;
        spring.node = node_or_none(part_of(first, "node"), model);
        spring.stiffness = number_or(part_of(first, "stiffness"), 1.0, 0.0, max_stiffness);
        spring.drag = number_or(part_of(first, "dragForce"), 0.5, 0.0, 1.0);
        const double power = number_or(part_of(first, "gravityPower"), 0.0, -max_gravity, max_gravity);
        const Value* direction = part_of(first, "gravityDir");
        for (int k = 0; k < 3; ++k)
            spring.gravity[k] = power * number_or(part_of(direction, static_cast<std::size_t>(k)),
                                                  k == 1 ? -1.0 : 0.0, -1.0, 1.0);
        spring.hit_radius = radius_of(first, "hitRadius");
        each_collider(part_of(chain, "colliderGroups"), groups, [&](const Value*, const Value* member) {
            const Value* collider = named_by(shapes, member);
            const Value* shape = part_of(extended(collider), "shape");
            if (!shape || is_beyond_capsules(shape)) shape = part_of(collider, "shape");
            const Value* capsule = part_of(shape, "capsule");
            add_collider(model, part_of(collider, "node"), capsule ? capsule : part_of(shape, "sphere"),
                         spring);
        });
        if (spring.node >= 0) springs.push_back(spring);
    }
}

/// The shape of a chain at rest; metres.
struct ChainShape {
    double first = 0.0, whole = 0.0;  // length of its first bone; length from its root to its farthest tip
    glm::dvec3 direction{0.0, -1.0, 0.0};
};

ChainShape shape_of(const humanoid::Skeleton& skeleton, const std::vector<humanoid::Placement>& rest,
                    std::size_t root) {
    ChainShape shape;
    const auto at = [&](std::int32_t node) { return rest[static_cast<std::size_t>(node)].position; };
    glm::dvec3 tip(0.0);
    const auto children = skeleton.children(root);
    for (const std::int32_t each : children) tip += at(each) / static_cast<double>(children.size());
    const glm::dvec3 own = rest[root].position;
    // A node without children is as long as its distance from its parent, as in SpringChain.
    const glm::dvec3 way = !children.empty()            ? tip - own
                           : skeleton[root].parent >= 0 ? own - at(skeleton[root].parent)
                                                        : glm::dvec3(0.0);
    shape.first = glm::length(way);
    if (shape.first > 0.0) shape.direction = way / shape.first;
    shape.whole = shape.first;
    struct Open {
        std::int32_t node;
        double length, last;  // from the root to the node, and from its parent
    };
    std::vector<Open> open{{static_cast<std::int32_t>(root), 0.0, shape.first}};
    while (!open.empty()) {
        const Open each = open.back();
        open.pop_back();
        const auto below = skeleton.children(static_cast<std::size_t>(each.node));
        if (below.empty()) shape.whole = std::max(shape.whole, each.length + each.last);
        for (const std::int32_t child : below) {
            const double apart = glm::distance(at(each.node), at(child));
            open.push_back({child, each.length + apart, apart});
        }
    }
    return shape;
}

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

std::vector<VrmSpring> vrm_springs(const tinygltf::Model& model) {
    std::vector<VrmSpring> springs;
    add_groups(model, springs);
    add_chains(model, springs);
    return springs;
}

void note_unfollowed(const tinygltf::Model& model, std::vector<std::string>& notes) {
    std::size_t colliders = 0;
    const Value* list = part_of(extension(model, "VRMC_springBone"), "colliders");
    for (std::size_t i = 0; const Value* each = part_of(list, i); ++i)
        colliders += is_beyond_capsules(part_of(extended(each), "shape"));
    if (colliders > 0)
        notes.push_back(
            std::to_string(colliders) +
            (colliders == 1 ? " spring collider is a plane or holds springs"
                            : " spring colliders are planes or hold springs") +
            " inside, which is not followed; the plain shape that the file gives instead is used.");
    std::string kinds;
    for (const char* kind : {"roll", "aim", "rotation"}) {
        const auto count = std::ranges::count_if(model.nodes, [&](const tinygltf::Node& node) {
            const auto found = node.extensions.find("VRMC_node_constraint");
            return found != node.extensions.end() && part_of(part_of(&found->second, "constraint"), kind);
        });
        if (count > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(count) + ' ' + kind;
    }
    if (!kinds.empty())
        notes.push_back("The file's node constraints are not followed (" + kinds +
                        "): those nodes keep their own rotation.");
}

/// VRM moves a bone's tip by Verlet's method, 60 times a second: with the tip y from its rest, drag d, length
/// L, stiffness k and gravity g along the bone,
///
///     y' = (1 - q) (y + (1 - d) (y - y_before)),   q = s / (L + s),   s = (k + g) / 60
///
/// where q comes from adding s along the bone and then restoring its length. So y is a sum of powers of the
/// roots z of z^2 - (1 - q) (2 - d) z + (1 - q) (1 - d) = 0. A damped spring has the same decay and frequency
/// if its two rates, w (zeta +- sqrt(zeta^2 - 1)), are -60 ln z: w^2 is their product, and zeta their mean
/// over w.
SpringRate spring_rate(const VrmSpring& spring, double length, const glm::dvec3& direction) {
    constexpr double steps = 60.0, smallest = 1e-4, two_pi = 6.283185307179586;
    const double pull = std::max(0.0, spring.stiffness + glm::dot(spring.gravity, direction)) / steps;
    const double kept = std::max(1.0 - pull / (std::max(length, 1e-3) + pull), smallest);
    const double half_sum = 0.5 * kept * (2.0 - spring.drag), product = kept * (1.0 - spring.drag);
    const double inside = half_sum * half_sum - product;
    double squared = 0.0, mean = 0.0;
    if (inside < 0.0) {
        const double decay = -0.5 * math::logarithm(std::max(product, smallest));
        const double turn = math::arccosine(half_sum / std::sqrt(product));
        squared = decay * decay + turn * turn;
        mean = decay;
    } else {
        const double slow = -math::logarithm(std::clamp(half_sum + std::sqrt(inside), smallest, 1.0)),
                     fast = -math::logarithm(std::clamp(half_sum - std::sqrt(inside), smallest, 1.0));
        squared = slow * fast;
        mean = 0.5 * (slow + fast);
    }
    const double rate = std::sqrt(squared);
    return {std::clamp(steps * rate / two_pi, 0.01, 100.0), rate > 0.0 ? std::min(mean / rate, 10.0) : 10.0};
}

std::vector<NamedSpring> named_springs(const std::vector<VrmSpring>& springs, const Character& character,
                                       const std::vector<std::int32_t>& place,
                                       std::vector<std::string>& notes) {
    if (springs.empty()) return {};
    const humanoid::Skeleton& skeleton = character.skeleton;
    std::vector<humanoid::Placement> rest(skeleton.size());
    humanoid::place(skeleton, humanoid::rest_pose(skeleton), rest);
    std::vector<NamedSpring> result;
    const auto is_free = [&](std::size_t node) {
        if (skeleton[node].parent < 0) return false;
        for (std::size_t i = 0; character.bones && i < character.bones->nodes.size(); ++i)
            if (const std::int32_t bone = character.bones->nodes[i];
                bone >= 0 && skeleton.is_below(static_cast<std::size_t>(bone), node))
                return false;
        return std::ranges::none_of(result, [&](const NamedSpring& each) {
            return skeleton.is_below(node, each.node) || skeleton.is_below(each.node, node);
        });
    };
    std::size_t left_out = 0;
    for (const VrmSpring& each : springs) {
        const std::int32_t found = place[static_cast<std::size_t>(each.node)];
        const auto node = static_cast<std::size_t>(std::max(found, 0));
        const ChainShape shape = found < 0 ? ChainShape() : shape_of(skeleton, rest, node);
        if (found < 0 || !is_free(node) || !(shape.whole > 0.0)) {
            ++left_out;
            continue;
        }
        const SpringRate rate = spring_rate(each, shape.first, shape.direction);
        // SpringChain's strength is the tip's; its first bone, a fraction s of the chain long, is stiffer by
        // 1 / sqrt(s^2 (6 - 4 s + s^2) / 3). That bone swings as in VRM.
        const double s = std::clamp(shape.first / shape.whole, 0.01, 1.0);
        result.push_back(
            {node, std::clamp(rate.strength * s * std::sqrt((6.0 - 4.0 * s + s * s) / 3.0), 0.01, 100.0),
             rate.critical_damping, each.hit_radius, each.colliders});
        for (SpringCollider& collider : result.back().colliders)
            collider.node = static_cast<std::size_t>(place[collider.node]);
    }
    notes.push_back("Gravity only changes the strength of the file's springs.");
    if (left_out > 0)
        notes.push_back(std::to_string(left_out) + (left_out == 1 ? " spring is" : " springs are") +
                        " left out: on bones of the body, or on one another.");
    return result;
}

}  // namespace tendril::app
