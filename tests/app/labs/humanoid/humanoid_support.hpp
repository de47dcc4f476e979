// Shared by tests of the Humanoid lab.
#pragma once

#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/view/palette.hpp"
#include "tests/app/labs/lab_support.hpp"

namespace tendril::app {

/// Hair on the hips that hangs into a capsule below them.
inline constexpr const char* vrm_with_hair =
    R"({"asset":{"version":"2.0"},"nodes":[{"name":"hips","children":[1]},)"
    R"({"name":"hair","translation":[0.05,1,0],"children":[2]},{"name":"tip","translation":[0,-0.2,0]}],)"
    R"("skins":[{"joints":[0]}],"extensions":{"VRMC_springBone":{)"
    R"("colliders":[{"node":0,"shape":{"capsule":{"offset":[0,0.8,0],"tail":[0,0.6,0],"radius":0.1}}}],)"
    R"("colliderGroups":[{"colliders":[0]}],"springs":[)"
    R"({"joints":[{"node":1,"hitRadius":0.02,"stiffness":1},{"node":2}],"colliderGroups":[0]}]}}})";

class HumanoidTest : public LabTest {
  protected:
    HumanoidTest() : LabTest(humanoid_lab) {}

    const HumanoidPart& part() const { return humanoid_part(workspace); }

    Json bones() const { return state().at("character").at("bones"); }
    glm::dvec3 bone(const std::string& name) const { return vector(bones().at(name).at("position")); }
    glm::dvec3 node(const std::string& name) const {
        const Json nodes = state().at("character").at("nodes");
        for (const Json& each : nodes)
            if (each.at("name") == name) return vector(each.at("position"));
        ADD_FAILURE() << "there is no node " << name;
        return {};
    }

    /// The lab's drawing, 1000 by 700 pixels.
    DrawList drawn(const CameraPose& pose = {.target = {0.0f, 0.9f, 0.0f}}) const {
        const Camera camera(pose, {{0.0f, 0.0f}, {1000.0f, 700.0f}});
        DrawList list;
        lab().draw({.workspace = workspace, .camera = camera, .palette = palette(Theme::Dark)}, list);
        return list;
    }

    /// Saved and loaded, the lab must be bit-identical, at once and after `ticks`.
    void expect_goes_on_the_same(int ticks = 30) {
        Workspace other = reopened();
        EXPECT_EQ(save_scene(other), save_scene(workspace));
        EXPECT_EQ(lab().state(other), state());
        for (int i = 0; i < ticks; ++i) lab().step(other), lab().step(workspace);
        EXPECT_EQ(lab().state(other), state());
    }
};

/// A figure with A-pose arms as a BVH in centimetres: two frames in which it moves 50 cm towards +Z.
/// `without`: a joint to omit with all its children.
std::string bvh_figure(const std::string& without = "");

/// Writes the stick figure as a glTF file whose nodes are "Node_0", "Node_1" ...; returns its path.
std::string numbered_figure(const std::filesystem::path& folder);
/// The same with its own names and a walk in place: the hips stay above one spot.
std::string treadmill_figure(const std::filesystem::path& folder);

}  // namespace tendril::app
