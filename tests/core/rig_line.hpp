// A small tree, shared by tests of the hierarchy.
#pragma once

#include <string>

#include "rig_support.hpp"

namespace tendril::test {

/// Three elements in a line, 1 m apart along Y, and a fourth beside the last; all have been read once.
struct RigLine {
    rig::Hierarchy tree;
    rig::ElementId root = *tree.add(rig::ElementKind::Bone, {}, moved(0, 1, 0));
    rig::ElementId middle = *tree.add(rig::ElementKind::Bone, root, moved(0, 1, 0));
    rig::ElementId tip = *tree.add(rig::ElementKind::Bone, middle, moved(0, 1, 0));
    rig::ElementId other = *tree.add(rig::ElementKind::Bone, middle, moved(1, 0, 0));
    RigLine() { tree.resolve_all(); }

    std::string flags() const {
        std::string text;
        for (const rig::ElementId each : {root, middle, tip, other}) text += rig::name(tree.pending(each))[0];
        return text;
    }
    void expect_set(rig::ElementId element, rig::Space space, const rig::Transform& value,
                    rig::Propagate propagate) {
        const Result result = tree.set(element, space, value, propagate);
        EXPECT_TRUE(result.ok()) << result.message();
    }
    glm::dvec3 at(rig::ElementId element, rig::Space space = rig::Space::Global) {
        return tree.get(element, space).translation;
    }
};

}  // namespace tendril::test
