#include "fnv.hpp"
#include "random.hpp"
#include "session.hpp"
#include "tendril/rig/aim.hpp"
#include "tendril/rig/euler.hpp"
#include "tendril/rig/hierarchy.hpp"
#include "tendril/rig/parent_constraint.hpp"
#include "tendril/rig/transform_units.hpp"

namespace tendril::test {
namespace {

using namespace rig;

/// A multiple of 2^-16, exact.
double some_number(Random& random) {
    return (static_cast<double>(random.below(1u << 18)) - 131072.0) / 65536.0;
}
glm::dvec3 some_vector(Random& random) {
    const double x = some_number(random), y = some_number(random), z = some_number(random);
    return {x, y, z};
}
Transform some_transform(Random& random) {
    Transform made{.translation = some_vector(random)};
    const double w = some_number(random) + 3.0;
    const glm::dvec3 xyz = some_vector(random);
    made.rotation = normalised({w, xyz.x, xyz.y, xyz.z});
    if (random.chance(3)) {
        const glm::dvec3 more = some_vector(random);
        made.scale = {2.5 + more.x, 2.5 + more.y, -2.5 + more.z};
    }
    return made;
}

void add(Fnv& hash, const glm::dquat& rotation) {
    for (const double part : {rotation.x, rotation.y, rotation.z, rotation.w}) hash.add(part);
}
void add(Fnv& hash, const Transform& transform) {
    for (int axis = 0; axis < 3; ++axis) hash.add(transform.translation[axis]);
    add(hash, transform.rotation);
    for (int axis = 0; axis < 3; ++axis) hash.add(transform.scale[axis]);
}

Transform constrained(Hierarchy& tree, ElementId child, ElementId one, ElementId other, Random& random) {
    std::vector<ConstraintParent> parents;
    for (const ElementId each : {one, other}) {
        const double weight = std::abs(some_number(random));
        parents.push_back(
            {tree.get(each, Space::Global), tree.get(each, Space::Global, Pose::Initial), weight});
    }
    ParentConstraintOptions options{.maintain_offset = random.chance(2)};
    const std::size_t turned = random.below(3), moved = random.below(3);
    options.filter.rotation[turned] = random.chance(2);
    options.filter.translation[moved] = random.chance(2);
    const ElementId above = tree.parent(child);
    return parent_constraint({tree.get(child, Space::Global), tree.get(child, Space::Global, Pose::Initial),
                              above ? tree.get(above, Space::Global) : Transform{}},
                             parents, options);
}

/// A global transform, moved by a random unit.
Transform moved_by_a_unit(Hierarchy& tree, const std::vector<ElementId>& elements, ElementId item,
                          Random& random) {
    const Transform now = tree.get(item, Space::Global);
    const double weight = static_cast<double>(random.below(17)) / 16.0;
    const ElementId one = elements[random.below(elements.size())],
                    other = elements[random.below(elements.size())];
    switch (random.below(5)) {
        case 0: {
            AimOptions options{.weight = weight};
            options.primary.target = some_vector(random);
            options.secondary.axis = some_vector(random);
            options.secondary.target = some_vector(random);
            options.secondary.weight = 1.0;
            if (random.chance(3)) options.max_speed = 0.5;
            return aim(now, options, 0.125).transform;
        }
        case 1:
            return constrained(tree, item, one, other, random);
        case 2:
            return offset_transform(now, some_transform(random), weight);
        case 3:
            return set_transform(now, some_transform(random), weight);
        default:
            return project_to_parent(now, tree.get(one, Space::Global),
                                     tree.get(other, Space::Global, Pose::Initial),
                                     tree.get(other, Space::Global), weight);
    }
}

}  // namespace

std::uint64_t rig_hash() {
    Random random(20260104);
    Fnv hash;
    for (int i = 0; i < 20; ++i) {
        Hierarchy tree;
        std::vector<ElementId> elements;
        for (int j = 0; j < 30; ++j) {
            const ElementId parent = j < 2 ? ElementId{} : elements[random.below(elements.size())];
            elements.push_back(*tree.add(ElementKind::Bone, parent, some_transform(random)));
        }
        for (int turn = 0; turn < 100; ++turn) {
            const ElementId item = elements[random.below(elements.size())];
            const Transform there =
                random.chance(4) ? some_transform(random) : moved_by_a_unit(tree, elements, item, random);
            const Space space = random.chance(3) ? Space::Local : Space::Global;
            tree.put(item, space, there, random.chance(2) ? Propagate::Yes : Propagate::No);
            const ElementId read = elements[random.below(elements.size())];
            add(hash, tree.get(read, Space::Global));
            add(hash, tree.get(read, Space::Local));
            const glm::dvec3 angles = to_euler(there.rotation);
            for (int axis = 0; axis < 3; ++axis) hash.add(angles[axis]);
            add(hash, from_euler(angles));
        }
    }
    return hash.value();
}

}  // namespace tendril::test
