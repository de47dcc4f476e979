#include "humanoid_support.hpp"

#include <utility>

#include "app/io/character/character.hpp"
#include "app/io/character/export.hpp"
#include "app/io/character/stick_figure.hpp"

namespace tendril::app {
namespace {

struct Joint {
    const char* name;
    const char* parent;
    const char* offset;
};
constexpr Joint joints[]{
    {"Hips", "", "0 95 0"},
    {"Spine", "Hips", "0 10 0"},
    {"Chest", "Spine", "0 20 0"},
    {"Neck", "Chest", "0 25 0"},
    {"Head", "Neck", "0 10 0"},
    {"LeftArm", "Chest", "15 20 0"},
    {"LeftForeArm", "LeftArm", "20 -20 0"},
    {"LeftHand", "LeftForeArm", "18 -18 0"},
    {"RightArm", "Chest", "-15 20 0"},
    {"RightForeArm", "RightArm", "-20 -20 0"},
    {"RightHand", "RightForeArm", "-18 -18 0"},
    {"LeftUpLeg", "Hips", "10 -5 0"},
    {"LeftLeg", "LeftUpLeg", "0 -42 0"},
    {"LeftFoot", "LeftLeg", "0 -40 0"},
    {"RightUpLeg", "Hips", "-10 -5 0"},
    {"RightLeg", "RightUpLeg", "0 -42 0"},
    {"RightFoot", "RightLeg", "0 -40 0"},
};

std::string joint_text(const std::string& name, const std::string& without, int& channels) {
    std::string text;
    bool has_children = false;
    for (const Joint& each : joints) {
        if (each.name == name) {
            const bool root = *each.parent == '\0';
            text += (root ? "ROOT " : "JOINT ") + name + "\n{\nOFFSET " + each.offset + "\n";
            text += root ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
                         : "CHANNELS 3 Zrotation Xrotation Yrotation\n";
            channels += root ? 6 : 3;
        }
    }
    for (const Joint& each : joints) {
        if (each.parent != name || each.name == without) continue;
        text += joint_text(each.name, without, channels);
        has_children = true;
    }
    if (!has_children) text += "End Site\n{\nOFFSET 0 12 0\n}\n";
    return text + "}\n";
}

}  // namespace

std::string bvh_figure(const std::string& without) {
    int channels = 0;
    std::string text = "HIERARCHY\n";
    text += joint_text("Hips", without, channels);
    text += "MOTION\nFrames: 2\nFrame Time: 0.5\n";
    for (const char* z : {"0", "50"}) {
        text += std::string("0 0 ") + z;
        for (int i = 3; i < channels; ++i) text += " 0";
        text += "\n";
    }
    return text;
}

std::string numbered_figure(const std::filesystem::path& folder) {
    Character figure = stick_figure();
    std::vector<humanoid::Node> nodes = figure.skeleton.nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].name = "Node_" + std::to_string(i);
    figure.skeleton = skeleton_of(std::move(nodes));
    const humanoid::Clip walk = figure.clips[0];
    const std::filesystem::path path = folder / "numbered.glb";
    export_clip({figure, {}, walk, walk, 60.0}, path);
    return path.string();
}

std::string treadmill_figure(const std::filesystem::path& folder) {
    const Character figure = stick_figure();
    humanoid::Clip walk = figure.clips[0];
    for (humanoid::Channel& channel : walk.channels)
        if (figure.skeleton[channel.node].name == "Hips")
            for (glm::dvec3& at : channel.translation.values) at.z = 0.0;
    const std::filesystem::path path = folder / "treadmill.glb";
    export_clip({figure, {}, walk, walk, 60.0}, path);
    return path.string();
}

}  // namespace tendril::app
