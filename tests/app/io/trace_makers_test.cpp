// Logs as programs of many makers print them.
#include <gtest/gtest.h>

#include "tests/app/io/trace_reading.hpp"

namespace tendril::app {
namespace {

using test::made::MadeTrace;
using test::made::Plant;
using test::made::Space;
using test::made::TraceMaker;

/// How a program prints a frame of shoulder, elbow and hand, and what it can be known to have.
struct Maker {
    const char* name;
    std::string (*print)(const std::vector<glm::dvec3>& joints, std::size_t frame);
    int space = 2;            ///< of test::made::spaces
    const char* header = "";  ///< before the first frame
    const char* engine = "";  ///< in the text of the conventions
};

template <std::size_t N>
std::string each_joint(const std::vector<glm::dvec3>& joints, const char (&format)[N],
                       const char* between = " ") {
    std::string text;
    for (const glm::dvec3& joint : joints) text += (text.empty() ? "" : between) + printed(joint, format);
    return text;
}
std::string labelled(const std::vector<glm::dvec3>& joints, const char* format) {
    return "shoulder" + printed(joints[0], format) + "elbow" + printed(joints[1], format) + "hand" +
           printed(joints[2], format);
}

using Joints = std::vector<glm::dvec3>;
const Maker makers[]{
    {"NumPy",
     [](const Joints& j, std::size_t) { return "[" + each_joint(j, "[%.4f %.4f %.4f]", "\n ") + "]\n"; }},
    {"NumPy repr",
     [](const Joints& j, std::size_t) {
         return "arm = array([" + each_joint(j, "[ %.4f,  %.4f,  %.4f]", ",\n       ") + "])\n";
     }},
    {"NumPy scalars",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "(np.float64(%.4f), np.float64(%.4f), np.float64(%.4f))") + "\n";
     }},
    {"System.Numerics",
     [](const Joints& j, std::size_t) { return each_joint(j, "<%.4f, %.4f, %.4f>") + "\n"; }},
    {"XNA", [](const Joints& j, std::size_t) { return each_joint(j, "{X:%.4f Y:%.4f Z:%.4f}") + "\n"; }, 2,
     "", "XNA"},
    {"Babylon",
     [](const Joints& j, std::size_t) { return each_joint(j, "{X: %.4f Y: %.4f Z: %.4f}") + "\n"; }, 1, "",
     "Babylon"},
    {"C# record",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "Vector3 { X = %.4f, Y = %.4f, Z = %.4f }") + "\n";
     }},
    {"Unreal",
     [](const Joints& j, std::size_t) {
         return "LogTemp: " + each_joint(j, "X=%.3f Y=%.3f Z=%.3f") + " Rotation: X=0.0 Y=0.0 Z=0.0 W=1.0\n";
     },
     0, "", "Unreal"},
    {"Godot", [](const Joints& j, std::size_t) { return each_joint(j, "(%.4f, %.4f, %.4f)") + "\n"; }},
    {"three.js", [](const Joints& j,
                    std::size_t) { return each_joint(j, "Vector3 {x: %.4f, y: %.4f, z: %.4f}") + "\n"; }},
    {"glm",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "vec3(%f, %f, %f)") + " rot quat(1.000000, {0.000000, 0.000000, 0.000000})\n";
     }},
    {"Eigen column", [](const Joints& j, std::size_t) { return labelled(j, ":\n%.4f\n%.4f\n%.4f\n"); }},
    {"Eigen row", [](const Joints& j, std::size_t) { return labelled(j, ": %.4f %.4f  %.4f\n"); }},
    {"ROS",
     [](const Joints& j, std::size_t) {
         return "poses:\n" +
                each_joint(j,
                           "- position:\n    x: %.4f\n    y: %.4f\n    z: %.4f\n  orientation:\n    x: 0.0\n"
                           "    y: 0.0\n    z: 0.0\n    w: 1.0\n",
                           "") +
                "---\n";
     },
     3, "", "ROS"},
    {"Maya",
     [](const Joints& j, std::size_t) { return "[" + each_joint(j, "[%.4f, %.4f, %.4f]", ", ") + "]\n"; }},
    {"Maya points",
     [](const Joints& j, std::size_t) { return each_joint(j, "(%.4f, %.4f, %.4f, 1)") + "\n"; }},
    {"Maya selection", [](const Joints& j, std::size_t) { return labelled(j, " = %.4f %.4f %.4f //\n"); }},
    {"Houdini",
     [](const Joints& j, std::size_t) { return each_joint(j, "<hou.Vector3 [%.4f, %.4f, %.4f]>") + "\n"; }, 2,
     "", "Houdini"},
    {"Blender",
     [](const Joints& j, std::size_t) { return each_joint(j, "<Vector (%.4f, %.4f, %.4f)>") + "\n"; }, 3, "",
     "Blender"},
    {"Blender matrices",
     [](const Joints& j, std::size_t) {
         std::string text;
         for (std::size_t i = 0; i < 3; ++i)
             text += "joint " + std::to_string(i) +
                     printed(j[i],
                             ": <Matrix 4x4 (0.6, -0.8, 0.0, %.4f)\n            (0.8, 0.6, 0.0, %.4f)\n"
                             "            (0.0, 0.0, 1.0, %.4f)\n            (0.0, 0.0, 0.0, 1.0)>\n");
         return text;
     },
     3},
    {"MATLAB",
     [](const Joints& j, std::size_t) { return "p = [" + each_joint(j, "%.4f %.4f %.4f", "; ") + "]\n"; }},
    {"JOML", [](const Joints& j, std::size_t) { return each_joint(j, "( %.4E  %.4E  %.4E)") + "\n"; }},
    {"Python",
     [](const Joints& j, std::size_t) { return each_joint(j, "{'x': %.4f, 'y': %.4f, 'z': %.4f}") + "\n"; }},
    {"JSON objects",
     [](const Joints& j, std::size_t) { return each_joint(j, "{\"x\":%.4f,\"y\":%.4f,\"z\":%.4f}") + "\n"; }},
    {"with rotations",
     [](const Joints& j, std::size_t) {
         return labelled(j, " position (%.4f, %.4f, %.4f) rotation (0.00, 90.00, 0.00) scale (1, 1, 1)\n");
     }},
    {"quaternions, w first",
     [](const Joints& j, std::size_t) {
         return labelled(j, " (%.4f, %.4f, %.4f) <Quaternion (w=0.9888, x=0.0338, y=0.0846, z=0.1184)> ") +
                "\n";
     }},
    {"named quaternions",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "{pos: {x: %.4f, y: %.4f, z: %.4f}, rot: {w: 1.0, x: 0.0, y: 0.0, z: 0.0}}") +
                "\n";
     }},
    {"t r s",
     [](const Joints& j, std::size_t) {
         return labelled(j, " t=[%.4f, %.4f, %.4f] r=[10.0, 20.0, 30.0] s=[1.0, 1.0, 1.0] ") + "\n";
     }},
    {"p w v",
     [](const Joints& j, std::size_t) {
         return labelled(j, ": p=(%.4f, %.4f, %.4f) w=(0.0, 0.0, 0.3) v=(0.1, 0.2, 0.3) ") + "\n";
     }},
    {"forward, up",
     [](const Joints& j, std::size_t) {
         return labelled(j, " pos (%.4f, %.4f, %.4f) fwd (0.0, 0.0, 1.0) up (0.0, 1.0, 0.0)\n");
     }},
    {"axis, angle",
     [](const Joints& j, std::size_t) {
         return labelled(j, " (%.4f, %.4f, %.4f) axis=(0.0, 1.0, 0.0) angle=10.0 ") + "\n";
     }},
    {"world, local",
     [](const Joints& j, std::size_t) {
         return labelled(j, " world (%.4f, %.4f, %.4f) local (0.3, 0.0, 0.0) ") + "\n";
     }},
    {"velocities",
     [](const Joints& j, std::size_t) {
         return labelled(j, ": position (%.4f, %.4f, %.4f) velocity (0.1, 0.0, 0.3) ") + "\n";
     }},
    {"a label that each has",
     [](const Joints& j, std::size_t) {
         return labelled(j, " (%.4f, %.4f, %.4f) bulge (0.1, 0.2, 0.3) ") + "\n";
     }},
    {"labels in turn",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "here (%.4f, %.4f, %.4f) bulge (0.1, 0.2, 0.3)") + "\n";
     }},
    {"poses of seven",
     [](const Joints& j, std::size_t) {
         return labelled(j, " [%.4f, %.4f, %.4f, 0.0338, 0.0846, 0.1184, 0.9888] ") + "\n";
     }},
    {"Universal Robots",
     [](const Joints& j, std::size_t) { return each_joint(j, "p[%.4f, %.4f, %.4f, 0.1, 0.2, 0.3]") + "\n"; }},
    {"hand.R",
     [](const Joints& j, std::size_t) {
         return "arm.R" + printed(j[0]) + "\nfore.R" + printed(j[1]) + "\nhand.R" + printed(j[2]) + "\n";
     }},
    {"with matrices",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "(%.4f, %.4f, %.4f)") + " [[0.6 -0.8 0.0] [0.8 0.6 0.0] [0.0 0.0 1.0]]\n";
     }},
    {"indexed",
     [](const Joints& j, std::size_t) {
         std::string text;
         for (std::size_t i = 0; i < 3; ++i)
             text += "joint[" + std::to_string(i) + "] = " + printed(j[i]) + "\n";
         return text;
     }},
    {"name.x=",
     [](const Joints& j, std::size_t) {
         return printed(j[0], "0.5 a.x=%.4f a.y=%.4f a.z=%.4f ") +
                printed(j[1], "b_x=%.4f b_y=%.4f b_z=%.4f ") +
                printed(j[2], "arm.c.x=%.4f, arm.c.y=%.4f, arm.c.z=%.4f\n");
     }},
    {"pipes", [](const Joints& j, std::size_t) { return each_joint(j, "%.4f %.4f %.4f", " | ") + "\n"; }},
    {"arrays of float32",
     [](const Joints& j, std::size_t i) {
         return "frame " + std::to_string(i) + " [" +
                each_joint(
                    j, "[array(%.4f, dtype=float32), array(%.4f, dtype=float32), array(%.4f, dtype=float32)]",
                    ", ") +
                "]\n";
     }},
    {"letters",
     [](const Joints& j, std::size_t) {
         return printed(j[0], "p=(%.4f, %.4f, %.4f) ") + printed(j[1], "r=(%.4f, %.4f, %.4f) ") +
                printed(j[2], "u=(%.4f, %.4f, %.4f)\n");
     }},
    {"lines that end with CR",
     [](const Joints& j, std::size_t) { return each_joint(j, "(%.4f, %.4f, %.4f)") + "\r"; }},
    {"CSV |", [](const Joints& j, std::size_t) { return each_joint(j, "%.4f|%.4f|%.4f", "|") + "\n"; }, 2,
     "ax|ay|az|bx|by|bz|cx|cy|cz\n"},
    {"blank lines",
     [](const Joints& j, std::size_t) { return each_joint(j, "(%.4f, %.4f, %.4f)", "\n") + "\n\n"; }},
    {"CSV .x",
     [](const Joints& j, std::size_t) { return each_joint(j, "%.4f,%.4f,%.4f,0,0,0,1", ",") + "\n"; }, 2,
     "a.pos.x,a.pos.y,a.pos.z,a.rot.x,a.rot.y,a.rot.z,a.rot.w,b.pos.x,b.pos.y,b.pos.z,b.rot.x,b.rot.y,b.rot."
     "z,"
     "b.rot.w,c.pos.x,c.pos.y,c.pos.z,c.rot.x,c.rot.y,c.rot.z,c.rot.w\n"},
    {"CSV [0]", [](const Joints& j, std::size_t) { return each_joint(j, "%.4f,%.4f,%.4f", ",") + "\n"; }, 2,
     "a[0],a[1],a[2],b[0],b[1],b[2],c[0],c[1],c[2]\n"},
    {"CSV prefix", [](const Joints& j, std::size_t) { return each_joint(j, "%.4f,%.4f,%.4f", ",") + "\n"; },
     2, "x1,y1,z1,x2,y2,z2,x3,y3,z3\n"},
    {"CSV unit", [](const Joints& j, std::size_t) { return each_joint(j, "%.4f,%.4f,%.4f", ",") + "\n"; }, 2,
     "a_x [m],a_y [m],a_z [m],b_x [m],b_y [m],b_z [m],c_x [m],c_y [m],c_z [m]\n"},
    {"CSV, not axes",
     [](const Joints& j, std::size_t) { return "7,8," + each_joint(j, "%.4f,%.4f,%.4f,1", ",") + "\n"; }, 2,
     "z-score,x label,a_x,a_y,a_z,a_w,b_x,b_y,b_z,b_w,c_x,c_y,c_z,c_w\n"}};

TEST(Trace, LogsOfManyMakersAreRead) {
    for (const Maker& maker : makers)
        for (unsigned seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE(maker.name);
            const MadeTrace made = TraceMaker(seed).make(seed < 3 ? Plant::Length : Plant::None);
            const Space& space = test::made::spaces[maker.space];
            std::string text = maker.header;
            for (std::size_t i = 0; i < made.frames.size(); ++i) {
                Joints joints;
                for (const glm::dvec3& joint : made.frames[i].joints) joints.push_back(space.of(joint));
                text += maker.print(joints, i);
            }
            ASSERT_EQ(trace_refusal(text), "read") << maker.name << '\n' << text.substr(0, 400);
            const ReadTrace found = read_trace(text);
            EXPECT_EQ(found.findings.chains[0].frames, made.frames.size()) << maker.name << '\n'
                                                                           << text.substr(0, 400);
            const Conventions& said = found.conventions;
            EXPECT_NE(said.text().find(maker.engine), std::string::npos) << maker.name << ": " << said.text();
            EXPECT_TRUE(!said.up.sure || trace_ups.name(said.up.value) == std::string(space.up))
                << maker.name;
            EXPECT_TRUE(!said.handed.sure || trace_hands.name(said.handed.value) == std::string(space.handed))
                << maker.name << ": " << said.text();
            EXPECT_TRUE(!said.unit.sure || trace_units.name(said.unit.value) == std::string(space.unit))
                << maker.name << ": " << said.text();
            ASSERT_EQ(found.incidents().size(), made.kind.empty() ? 0u : 1u) << maker.name << '\n'
                                                                             << found.text();
            if (made.kind.empty()) continue;
            EXPECT_EQ(found.incidents()[0].frame, made.frame) << maker.name;
            EXPECT_EQ(found.incidents()[0].joint, static_cast<std::size_t>(made.joint)) << maker.name;
            EXPECT_NEAR(found.incidents()[0].amount, made.amount, 5e-3) << maker.name;
        }
}

}  // namespace
}  // namespace tendril::app
