// Logs as programs of many makers print them.
#include <gtest/gtest.h>

#include <algorithm>

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
glm::dvec3 seconds(std::size_t frame) {
    return glm::dvec3(static_cast<double>(frame) / 60.0);
}
constexpr const char* blocks = "\n  x: %.4f\n  y: %.4f\n  z: %.4f\n}\n";
const Maker makers[]{
    {"OpenSim .trc",
     [](const Joints& j, std::size_t i) {
         return std::to_string(i + 1) + printed(seconds(i), "\t%.5f\t") +
                each_joint(j, "%.4f\t%.4f\t%.4f", "\t") + "\t\n";
     },
     2,
     "PathFileType\t4\t(X/Y/"
     "Z)\tarm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n60\t60\t120\t3\tm\n"
     "Frame#\tTime\tshoulder\t\t\telbow\t\t\thand\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n\n"},
    {"Motive",
     [](const Joints& j, std::size_t i) {
         return std::to_string(i) + printed(seconds(i), ",%.5f,") + each_joint(j, "%.4f,%.4f,%.4f", ",") +
                "\n";
     },
     2,
     "Format Version,1.23,Take Name,Take "
     "1\n\n,,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker\n"
     ",,shoulder,shoulder,shoulder,elbow,elbow,elbow,hand,hand,hand\n,,7,7,7,8,8,8,9,9,9\n"
     "Frame,Time (Seconds),X,Y,Z,X,Y,Z,X,Y,Z\n,,m,m,m,m,m,m,m,m,m\n"},
    {"MATLAB disp",
     [](const Joints& j, std::size_t) { return each_joint(j, "%10.4f%10.4f%10.4f\n", "") + "\n"; }},
    {"MATLAB disp, close together",
     [](const Joints& j, std::size_t) { return each_joint(j, "%10.4f%10.4f%10.4f\n", ""); }},
    {"MATLAB scale",
     [](const Joints& j, std::size_t) {
         return "\np =\n\n   1.0e+03 *\n\n" +
                each_joint({j[0] / 1e3, j[1] / 1e3, j[2] / 1e3}, "%12.7f%12.7f%12.7f\n", "");
     }},
    {"JSON, a key for each joint",
     [](const Joints& j, std::size_t i) {
         return "{\"t\":" + std::to_string(seconds(i).x) + ",\"shoulder\":[" +
                printed(j[0], "%.4f,%.4f,%.4f],") + "\"elbow\":[" + printed(j[1], "%.4f,%.4f,%.4f],") +
                "\"hand\":[" + printed(j[2], "%.4f,%.4f,%.4f]}\n");
     }},
    {"JSON columns",
     [](const Joints& j, std::size_t) {
         return printed({j[0].x, j[1].x, j[2].x}, "{\"x\":[%.4f,%.4f,%.4f],") +
                printed({j[0].y, j[1].y, j[2].y}, "\"y\":[%.4f,%.4f,%.4f],") +
                printed({j[0].z, j[1].z, j[2].z}, "\"z\":[%.4f,%.4f,%.4f]}\n");
     }},
    {"JSON in one line",
     [](const Joints& j, std::size_t) {
         return "{\"pose\":[" + each_joint(j, "[%.4f,%.4f,%.4f]", ",") + "]},";
     },
     2, "{\"fps\":60,\"frames\":["},
    {"Haskell",
     [](const Joints& j, std::size_t) {
         std::string text;
         for (const glm::dvec3& joint : j)
             for (const int axis : {0, 1, 2})
                 text += (axis > 0       ? ","
                          : text.empty() ? "[("
                                         : "),(") +
                         printed(glm::dvec3(joint[axis] - 1.2), joint[axis] < 1.2 ? "(%.4f)" : "%.4f");
         return text + ")]\n";
     }},
    {"np.float64 over lines",
     [](const Joints& j, std::size_t) {
         return "[" +
                each_joint(j, "array([np.float64(%.4f), np.float64(%.4f),\n       np.float64(%.4f)])",
                           ",\n ") +
                "]\n";
     }},
    {"Rust {:#?}",
     [](const Joints& j, std::size_t) {
         return "Arm {\n    joints: [\n" +
                each_joint(j,
                           "        Vec3 {\n            x: %.4f,\n            y: %.4f,\n            z: "
                           "%.4f,\n        },\n",
                           "") +
                "    ],\n}\n";
     }},
    {"YAML lists",
     [](const Joints& j, std::size_t) {
         return "- joints:\n" + each_joint(j, "  - - %.4f\n    - %.4f\n    - %.4f\n", "");
     }},
    {"XML elements",
     [](const Joints& j, std::size_t) {
         return "<frame>\n" +
                each_joint(j, "  <joint>\n    <x>%.4f</x>\n    <y>%.4f</y>\n    <z>%.4f</z>\n  </joint>\n",
                           "") +
                "</frame>\n";
     }},
    {"R list",
     [](const Joints& j, std::size_t) {
         return "$shoulder\n[1] " + printed(j[0], "%.4f %.4f %.4f\n\n") + "$elbow\n[1] " +
                printed(j[1], "%.4f %.4f %.4f\n\n") + "$hand\n[1] " + printed(j[2], "%.4f %.4f %.4f\n\n");
     }},
    {"tidy CSV",
     [](const Joints& j, std::size_t i) {
         const std::string row = std::to_string(i) + ',';
         return row + "shoulder" + printed(j[0], ",%.4f,%.4f,%.4f\n") + row + "elbow" +
                printed(j[1], ",%.4f,%.4f,%.4f\n") + row + "hand" + printed(j[2], ",%.4f,%.4f,%.4f\n");
     },
     2, "frame,joint,x,y,z\n"},
    {"hex floats", [](const Joints& j, std::size_t) { return each_joint(j, "(%a, %a, %a)") + "\n"; }},
    {"decimal commas",
     [](const Joints& j, std::size_t) {
         std::string text = each_joint(j, "<%.4f; %.4f; %.4f>") + "\n";
         std::ranges::replace(text, '.', ',');
         return text;
     }},
    {"Fortran",
     [](const Joints& j, std::size_t i) {
         std::string text =
             std::to_string(i) + printed(seconds(i), " %.4f ") + each_joint(j, "%.6E %.6E %.6E") + "\n";
         std::ranges::replace(text, 'E', 'D');
         return text;
     }},
    {"Godot transforms",
     [](const Joints& j, std::size_t) {
         return each_joint(
                    j,
                    "[X: (0.6, 0.8, 0.0), Y: (-0.8, 0.6, 0.0), Z: (0.0, 0.0, 1.0), O: (%.4f, %.4f, %.4f)]") +
                "\n";
     }},
    {"Markdown",
     [](const Joints& j, std::size_t i) {
         return "|" + std::to_string(i) + "|" + each_joint(j, "%.4f|%.4f|%.4f|", "") + "\n";
     },
     2,
     "| frame | ax | ay | az | bx | by | bz | cx | cy | cz |\n|---|---|---|---|---|---|---|---|---|---|\n"},
    {"NumPy",
     [](const Joints& j, std::size_t) { return "[" + each_joint(j, "[%.4f %.4f %.4f]", "\n ") + "]\n"; }},
    {"NumPy repr",
     [](const Joints& j, std::size_t) {
         return "arm = array([" + each_joint(j, "[ %.4f,  %.4f,  %.4f]", ",\n       ") + "])\n";
     }},
    {"Unreal",
     [](const Joints& j, std::size_t) {
         return "LogTemp: " + each_joint(j, "X=%.3f Y=%.3f Z=%.3f") + " Rotation: X=0.0 Y=0.0 Z=0.0 W=1.0\n";
     },
     0, "", "Unreal"},
    {"glm",
     [](const Joints& j, std::size_t) {
         return each_joint(j, "vec3(%f, %f, %f)") + " rot quat(1.000000, {0.000000, 0.000000, 0.000000})\n";
     }},
    {"Eigen column", [](const Joints& j, std::size_t) { return labelled(j, ":\n%.4f\n%.4f\n%.4f\n"); }},
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
    {"Maya selection", [](const Joints& j, std::size_t) { return labelled(j, " = %.4f %.4f %.4f //\n"); }},
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
    {"Protobuf text",
     [](const Joints& j, std::size_t) {
         return "shoulder {" + printed(j[0], blocks) + "elbow {" + printed(j[1], blocks) + "hand {" +
                printed(j[2], blocks);
     }},
    {"Rust dbg!",
     [](const Joints& j, std::size_t) {
         return each_joint(j,
                           "[src/arm.rs:12:5] joint = Vec3 {\n    x: %.4f,\n    y: %.4f,\n    z: %.4f,\n}\n",
                           "") +
                "[src/arm.rs:15:5] solved = true\n";
     }},
    {"nested JSON",
     [](const Joints& j, std::size_t) {
         return each_joint(
                    j, "{\n  \"position\": {\n    \"x\": %.4f,\n    \"y\": %.4f,\n    \"z\": %.4f\n  }\n}\n",
                    "") +
                "\n";
     }},
    {"letters, one a line",
     [](const Joints& j, std::size_t) {
         return "p " + printed(j[0]) + "\nq " + printed(j[1]) + "\nr " + printed(j[2]) + "\n";
     }},
    {"other lines between",
     [](const Joints& j, std::size_t i) {
         return (i % 7 == 3 ? "camera (1.0, 2.0, 3.0)\n" : "") + labelled(j, " (%.4f, %.4f, %.4f) ") + "\n";
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

/// How a program prints one vector: of shoulder, elbow, hand, target and pole target.
struct VectorFormat {
    const char* format;
    int space = 2;            ///< of test::made::spaces
    const char* engine = "";  ///< in the text of the conventions
};
const VectorFormat vector_formats[]{
    {"(%.4f, %.4f, %.4f)"},
    {"Vec3 { x: %.4f, y: %.4f, z: %.4f }"},
    {"Vec3(%.4f, %.4f, %.4f)"},
    {"vec3(%f, %f, %f)"},
    {"SIMD3<Float>(%.4f, %.4f, %.4f)"},
    {"{%.4f %.4f %.4f}"},
    {"{X:%.4f Y:%.4f Z:%.4f}", 2, "XNA"},
    {"{X: %.4f Y: %.4f Z: %.4f}", 1, "Babylon"},
    {"X:%.4f Y:%.4f Z:%.4f"},
    {"Vector3 { X = %.4f, Y = %.4f, Z = %.4f }"},
    {"Float3(x=%.4f, y=%.4f, z=%.4f)"},
    {"Vector3 {x: %.4f, y: %.4f, z: %.4f}"},
    {"Vector3 { isVector3: true, x: %.4f, y: %.4f, z: %.4f }"},
    {"Object { x: %.4f, y: %.4f, z: %.4f }"},
    {"Point3 { coords: [[%.4f, %.4f, %.4f]] }"},
    {"[[%.4f, %.4f, %.4f]]"},
    {"{'x': %.4f, 'y': %.4f, 'z': %.4f}"},
    {"{\"x\":%.4f,\"y\":%.4f,\"z\":%.4f}"},
    {"{.x=%.4f, .y=%.4f, .z=%.4f}"},
    {"LPoint3f(%.4f, %.4f, %.4f)"},
    {"X=%.3f Y=%.3f Z=%.3f", 0, "Unreal"},
    {"V(X=%.2f, Y=%.2f, Z=%.2f)", 0, "Unreal"},
    {"<%.4f, %.4f, %.4f>"},
    {"<hou.Vector3 [%.4f, %.4f, %.4f]>", 2, "Houdini"},
    {"<Vector (%.4f, %.4f, %.4f)>", 3, "Blender"},
    {"new Vector3(%.4ff, %.4ff, %.4ff)", 1, "Unity"},
    {"Vector3(%.4f, %.4f, %.4f)", 2, "Godot"},
    {"QVector3D(%.4f, %.4f, %.4f)"},
    {"vmath.vector3(%.4f, %.4f, %.4f)"},
    {"XMFLOAT3(%.4f, %.4f, %.4f)"},
    {"float4(%.4f, %.4f, %.4f, 1.0)"},
    {"Vector3<f32>(%.4f, %.4f, %.4f)"},
    {"Vector3 [%.4f, %.4f, %.4f]"},
    {"Float32[%.4f, %.4f, %.4f]"},
    {"SVector{3, Float64}(%.4f, %.4f, %.4f)"},
    {"Float32Array(3) [ %.4f, %.4f, %.4f ]"},
    {"c(%.4f, %.4f, %.4f)"},
    {"( %.4E  %.4E  %.4E)"},
    {"tensor([%.4f, %.4f, %.4f], device='cuda:0')"},
    {"Array([%.4f, %.4f, %.4f], dtype=float32)"},
    {"(np.float64(%.4f), np.float64(%.4f), np.float64(%.4f))"},
    {"(%.4f m, %.4f m, %.4f m)"},
    {"%.4f, %.4f, %.4f |"},
    {"%.4f  %.4f  %.4f"},
    {"DenseVector 3-Double %.4f  %.4f  %.4f"},
    {"%.6f,%.6f,%.6f|10.100000,20.000000,30.000000|1.000000,1.000000,1.000000", 8},
    {"(%.4g, %.4g, %.4g)"},
    {"(%.2e, %.2e, %.2e)"},
    {"(%.3E %.3E %.3E)", 9},
    {"(%.1f, %.1f, %.1f)", 4}};

TEST(Trace, WordsBeforeEveryVectorAreItsType) {
    const auto prefix = [](std::size_t i) {
        return "[2026.11.29-02.44.02:016][" + std::to_string(i) + "]Arm: ";
    };
    for (const VectorFormat& each : vector_formats)
        for (const int layout : {0, 1, 2, 3, 4})
            for (const unsigned seed : {0u, 1u}) {
                const bool listed = std::string_view("({[<").find(each.format[0]) != std::string_view::npos;
                if (layout > 2 && !listed) continue;
                const MadeTrace made = TraceMaker(seed).make(Plant::None);
                const Space& space = test::made::spaces[each.space];
                std::string text;
                for (std::size_t i = 0; i < made.frames.size(); ++i) {
                    const auto& frame = made.frames[i];
                    const auto v = [&](const glm::dvec3& point) {
                        return printed(space.of(point), each.format) + ' ';
                    };
                    const std::string a = v(frame.joints[0]), b = v(frame.joints[1]), c = v(frame.joints[2]),
                                      target = v(frame.target),
                                      pole = v(frame.pole.value_or(glm::dvec3(0, 9, 0)));
                    if (layout == 0)
                        text += prefix(i) + "shoulder: " + a + "elbow: " + b + "wrist: " + c +
                                "target: " + target + "pole: " + pole + '\n';
                    if (layout == 1)
                        text += "shoulder: " + a + "\nelbow: " + b + "\nwrist: " + c + "\ntarget: " + target +
                                "\npole: " + pole + '\n';
                    if (layout == 2)
                        for (const std::string side : {"left_", "right_"})
                            text += side + "shoulder: " + a + side + "elbow: " + b + side + "hand: " + c +
                                    side + "target: " + target + (side == "right_" ? "\n" : "");
                    if (layout == 3)
                        text += "Solving IK toward " + target + "\n -> chain " + a + b + c + '\n';
                    if (layout == 4)
                        for (const char* leg : {"leg 0: ", "leg 1: "})
                            text += leg + a + b + c + "target " + target + '\n';
                }
                SCOPED_TRACE(text.substr(0, 500));
                ASSERT_EQ(trace_refusal(text), "read");
                const ReadTrace found = read_trace(text);
                const std::size_t chains = layout == 2 || layout == 4 ? 2 : 1;
                ASSERT_EQ(found.findings.chains.size(), chains);
                for (const auto& chain : found.findings.chains) EXPECT_EQ(chain.frames, made.frames.size());
                EXPECT_EQ(found.findings.count(), 0u) << found.text();
                EXPECT_TRUE(found.notes.empty()) << found.notes[0];
                EXPECT_NE(found.conventions.text().find(each.engine), std::string::npos)
                    << found.conventions.text();
                std::istringstream in(text);
                TraceReader reader(
                    in, {.up = space.up, .handed = space.handed, .unit = space.unit, .rotations = ""});
                TracedFrame frame;
                for (std::size_t i = 0; i < 10 * chains; ++i) {
                    const auto& expected = made.frames[i / chains];
                    ASSERT_TRUE(reader.next(frame));
                    ASSERT_EQ(frame.joints.size(), 3u);
                    ASSERT_TRUE(frame.target.has_value());
                    constexpr float rounded = 9e-3f;  // metres, %.2e
                    EXPECT_LT(glm::distance(*frame.target, glm::vec3(expected.target)), rounded);
                    EXPECT_LT(glm::distance(frame.joints[1], glm::vec3(expected.joints[1])), rounded);
                    EXPECT_EQ(frame.pole.has_value(), layout < 2);
                }
            }
}

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
