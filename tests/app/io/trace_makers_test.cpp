// Logs in the formats that programs of many makers print.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/io/trace_reading.hpp"

namespace tendril::app {
namespace {

using test::made::MadeTrace, test::made::Plant, test::made::Space, test::made::TraceMaker;

/// How a program prints a frame. # is its number, @ a joint's name, ~ its number and ^ its letter.
struct Maker {
    const char *name, *joint, *between = " ", *before = "", *after = "\n", *header = "";
    int space = 2;                            ///< of test::made::spaces
    const char* engine = "";                  ///< in the text of the conventions
    std::string (*number)(double) = nullptr;  ///< prints each, where the format has %s
    const char* sometimes = "";               ///< before every seventh frame

    std::string print(const std::vector<glm::dvec3>& joints, std::size_t frame) const {
        std::string text = before;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            constexpr const char* names[]{"shoulder", "elbow", "hand"};
            std::string format = replaced(replaced(joint, '@', names[i]), '~', std::to_string(i));
            format = replaced(format, '^', std::string(1, "pru"[i]));
            if (number != nullptr)
                for (const int axis : {0, 1, 2}) {
                    const std::size_t at = format.find("%s");
                    format.replace(at, 2, number(joints[i][axis]));
                }
            text += (i > 0 ? between : "") + printed(joints[i], format.c_str());
        }
        if (frame % 7 == 3) text.insert(0, sometimes);
        return replaced(text + after, '#', std::to_string(frame));
    }

  private:
    static std::string replaced(std::string text, char what, const std::string& by) {
        for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
            text.replace(at, 1, by);
        return text;
    }
};

std::string in_haskell(double x) {
    char text[40];
    std::snprintf(text, sizeof text, x < 0.0 ? "(%.4f)" : "%.4f", x);
    return text;
}
std::string with_comma(double x) {
    std::string text = test::made::number_text(x, 4);
    std::ranges::replace(text, '.', ',');
    return text;
}
std::string in_fortran(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6E", x);
    std::string all = text;
    std::ranges::replace(all, 'E', 'D');
    return all;
}
std::string in_thousands(double x) {
    return test::made::number_text(x / 1e3, 7);
}

constexpr const char *xyz = "%.4f,%.4f,%.4f", *square = "[%.4f, %.4f, %.4f]",
                     *brackets = "(%.4f, %.4f, %.4f)";
const Maker makers[]{
    {"NumPy", "[%.4f %.4f %.4f]", "\n ", "[", "]\n"},
    {"NumPy repr", "[ %.4f,  %.4f,  %.4f]", ",\n       ", "arm = array([", "])\n"},
    {"Unreal", "X=%.3f Y=%.3f Z=%.3f", " ", "LogTemp: ", " Rotation: X=0.0 Y=0.0 Z=0.0 W=1.0\n", "", 0,
     "Unreal"},
    {"glm", "vec3(%f, %f, %f)", " ", "", " rot quat(1.000000, {0.000000, 0.000000, 0.000000})\n"},
    {"Eigen column", "@:\n%.4f\n%.4f\n%.4f\n", "", "", ""},
    {"ROS",
     "- position:\n    x: %.4f\n    y: %.4f\n    z: %.4f\n  orientation:\n    x: 0.0\n    y: 0.0\n    z: "
     "0.0\n"
     "    w: 1.0\n",
     "", "poses:\n", "---\n", "", 3, "ROS"},
    {"Maya", square, ", ", "[", "]\n"},
    {"Maya selection", "@ = %.4f %.4f %.4f //\n", "", "", ""},
    {"Blender matrices",
     "joint ~: <Matrix 4x4 (0.6, -0.8, 0.0, %.4f)\n            (0.8, 0.6, 0.0, %.4f)\n"
     "            (0.0, 0.0, 1.0, %.4f)\n            (0.0, 0.0, 0.0, 1.0)>\n",
     "", "", "", "", 3},
    {"MATLAB", "%.4f %.4f %.4f", "; ", "p = [", "]\n"},
    {"with rotations", "@ position (%.4f, %.4f, %.4f) rotation (0.00, 90.00, 0.00) scale (1, 1, 1)\n", "", "",
     ""},
    {"quaternions, w first", "@ (%.4f, %.4f, %.4f) <Quaternion (w=0.9888, x=0.0338, y=0.0846, z=0.1184)>"},
    {"named quaternions", "{pos: {x: %.4f, y: %.4f, z: %.4f}, rot: {w: 1.0, x: 0.0, y: 0.0, z: 0.0}}"},
    {"t r s", "@ t=[%.4f, %.4f, %.4f] r=[10.0, 20.0, 30.0] s=[1.0, 1.0, 1.0]"},
    {"p w v", "@: p=(%.4f, %.4f, %.4f) w=(0.0, 0.0, 0.3) v=(0.1, 0.2, 0.3)"},
    {"forward, up", "@ pos (%.4f, %.4f, %.4f) fwd (0.0, 0.0, 1.0) up (0.0, 1.0, 0.0)\n", "", "", ""},
    {"axis, angle", "@ (%.4f, %.4f, %.4f) axis=(0.0, 1.0, 0.0) angle=10.0"},
    {"world, local", "@ world (%.4f, %.4f, %.4f) local (0.3, 0.0, 0.0)"},
    {"velocities", "@: position (%.4f, %.4f, %.4f) velocity (0.1, 0.0, 0.3)"},
    {"a label that each has", "@ (%.4f, %.4f, %.4f) bulge (0.1, 0.2, 0.3)"},
    {"labels in turn", "here (%.4f, %.4f, %.4f) bulge (0.1, 0.2, 0.3)"},
    {"poses of seven", "@ [%.4f, %.4f, %.4f, 0.0338, 0.0846, 0.1184, 0.9888]"},
    {"Universal Robots", "p[%.4f, %.4f, %.4f, 0.1, 0.2, 0.3]"},
    {"hand.R", "@.R(%.4f, %.4f, %.4f)\n", "", "", ""},
    {"with matrices", brackets, " ", "", " [[0.6 -0.8 0.0] [0.8 0.6 0.0] [0.0 0.0 1.0]]\n"},
    {"Protobuf text", "@ {\n  x: %.4f\n  y: %.4f\n  z: %.4f\n}\n", "", "", ""},
    {"Rust dbg!", "[src/arm.rs:12:5] joint = Vec3 {\n    x: %.4f,\n    y: %.4f,\n    z: %.4f,\n}\n", "", "",
     "[src/arm.rs:15:5] solved = true\n"},
    {"nested JSON", "{\n  \"position\": {\n    \"x\": %.4f,\n    \"y\": %.4f,\n    \"z\": %.4f\n  }\n}\n",
     ""},
    {"other lines between", "@ (%.4f, %.4f, %.4f)", " ", "", "\n", "", 2, "", nullptr,
     "camera (1.0, 2.0, 3.0)\n"},
    {"letters", "^=(%.4f, %.4f, %.4f)"},
    {"letters, one a line", "^ (%.4f, %.4f, %.4f)\n", "", "", ""},
    {"indexed", "joint[~] = (%.4f, %.4f, %.4f)\n", "", "", ""},
    {"name.x=", "arm.@.x=%.4f, arm.@.y=%.4f, arm.@.z=%.4f", " ", "0.5 "},
    {"name_x=", "@_x=%.4f @_y=%.4f @_z=%.4f"},
    {"pipes", "%.4f %.4f %.4f", " | "},
    {"arrays of float32",
     "[array(%.4f, dtype=float32), array(%.4f, dtype=float32), array(%.4f, dtype=float32)]", ", ",
     "frame # [", "]\n"},
    {"lines that end with CR", brackets, " ", "", "\r"},
    {"blank lines", brackets, "\n", "", "\n\n"},
    {"CSV |", "%.4f|%.4f|%.4f", "|", "", "\n", "ax|ay|az|bx|by|bz|cx|cy|cz\n"},
    {"CSV .x", "%.4f,%.4f,%.4f,0,0,0,1", ",", "", "\n",
     "a.pos.x,a.pos.y,a.pos.z,a.rot.x,a.rot.y,a.rot.z,a.rot.w,b.pos.x,b.pos.y,b.pos.z,b.rot.x,b.rot.y,"
     "b.rot.z,b.rot.w,c.pos.x,c.pos.y,c.pos.z,c.rot.x,c.rot.y,c.rot.z,c.rot.w\n"},
    {"CSV [0]", xyz, ",", "", "\n", "a[0],a[1],a[2],b[0],b[1],b[2],c[0],c[1],c[2]\n"},
    {"CSV prefix", xyz, ",", "", "\n", "x1,y1,z1,x2,y2,z2,x3,y3,z3\n"},
    {"CSV unit", xyz, ",", "", "\n",
     "a_x [m],a_y [m],a_z [m],b_x [m],b_y [m],b_z [m],c_x [m],c_y [m],c_z [m]\n"},
    {"CSV, not axes", "%.4f,%.4f,%.4f,1", ",", "7,8,", "\n",
     "z-score,x label,a_x,a_y,a_z,a_w,b_x,b_y,b_z,b_w,c_x,c_y,c_z,c_w\n"},
    {"CSV, tidy", "#,@,%.4f,%.4f,%.4f\n", "", "", "", "frame,joint,x,y,z\n"},
    {"Markdown", "%.4f|%.4f|%.4f|", "", "|#|", "\n",
     "| frame | ax | ay | az | bx | by | bz | cx | cy | cz |\n|---|---|---|---|---|---|---|---|---|---|\n"},
    {"OpenSim .trc", "%.4f\t%.4f\t%.4f\t", "", "#\t#\t", "\n",
     "PathFileType\t4\t(X/Y/Z)\t"
     "arm.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n60\t60\t120\t3\tm\n"
     "Frame_\tTime\tshoulder\t\t\telbow\t\t\thand\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n\n"},
    {"Motive", xyz, ",", "#,#,", "\n",
     "Format Version,1.23,Take Name,Take 1\n"
     "\n,,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker,Marker\n"
     ",,shoulder,shoulder,shoulder,elbow,elbow,elbow,hand,hand,hand\n,,7,7,7,8,8,8,9,9,9\n"
     "Frame,Time (Seconds),X,Y,Z,X,Y,Z,X,Y,Z\n,,m,m,m,m,m,m,m,m,m\n"},
    {"MATLAB disp", "%10.4f%10.4f%10.4f\n", ""},
    {"MATLAB disp, close together", "%10.4f%10.4f%10.4f\n", "", "", ""},
    {"MATLAB scale", "   %s   %s   %s\n", "", "\np =\n\n   1.0e+03 *\n\n", "", "", 2, "", in_thousands},
    {"JSON, a key for each joint", "\"@\":[%.4f,%.4f,%.4f]", ",", "{\"t\":#,", "}\n"},
    {"JSON in one line", "[%.4f,%.4f,%.4f]", ",", "{\"pose\":[", "]},", "{\"fps\":60,\"frames\":["},
    {"Haskell", "(%s,%s,%s)", ",", "[", "]\n", "", 2, "", in_haskell},
    {"np.float64 over lines", "array([np.float64(%.4f), np.float64(%.4f),\n       np.float64(%.4f)])", ",\n ",
     "[", "]\n"},
    {"Rust {:?}",
     "        Vec3 {\n            x: %.4f,\n            y: %.4f,\n            z: %.4f,\n        },\n", "",
     "Arm {\n    joints: [\n", "    ],\n}\n"},
    {"YAML lists", "  - - %.4f\n    - %.4f\n    - %.4f\n", "", "- joints:\n", ""},
    {"XML elements", "  <joint>\n    <x>%.4f</x>\n    <y>%.4f</y>\n    <z>%.4f</z>\n  </joint>\n", "",
     "<frame>\n", "</frame>\n"},
    {"R list", "$@\n[1] %.4f %.4f %.4f\n\n", "", "", ""},
    {"hex floats", "(%a, %a, %a)"},
    {"decimal commas", "<%s; %s; %s>", " ", "", "\n", "", 2, "", with_comma},
    {"Fortran", "%s %s %s", " ", "# # ", "\n", "", 2, "", in_fortran},
    {"Godot transforms",
     "[X: (0.6, 0.8, 0.0), Y: (-0.8, 0.6, 0.0), Z: (0.0, 0.0, 1.0), O: (%.4f, %.4f, %.4f)]"}};

/// A program's format for one vector, used for shoulder, elbow, hand, target and pole target.
struct VectorFormat {
    const char* format;
    int space = 2;            ///< index into test::made::spaces
    const char* engine = "";  ///< expected in the text of the conventions
};
const VectorFormat vector_formats[]{
    {"(%.4f, %.4f, %.4f)", 5},
    {"Vec3 { x: %.4f, y: %.4f, z: %.4f }"},
    {"SIMD3<Float>(%.4f, %.4f, %.4f)"},
    {"{%.4f %.4f %.4f}", 7},
    {"{X:%.4f Y:%.4f Z:%.4f}", 2, "XNA"},
    {"{X: %.4f Y: %.4f Z: %.4f}", 1, "Babylon"},
    {"X:%.4f Y:%.4f Z:%.4f"},
    {"Vector3 { X = %.4f, Y = %.4f, Z = %.4f }"},
    {"Vector3 { isVector3: true, x: %.4f, y: %.4f, z: %.4f }"},
    {"Point3 { coords: [[%.4f, %.4f, %.4f]] }"},
    {"[[%.4f, %.4f, %.4f]]", 6},
    {"{\"x\":%.4f,\"y\":%.4f,\"z\":%.4f}"},
    {"{.x=%.4f, .y=%.4f, .z=%.4f}"},
    {"X=%.3f Y=%.3f Z=%.3f", 0, "Unreal"},
    {"V(X=%.2f, Y=%.2f, Z=%.2f)", 0, "Unreal"},
    {"<%.4f, %.4f, %.4f>"},
    {"<hou.Vector3 [%.4f, %.4f, %.4f]>", 2, "Houdini"},
    {"<Vector (%.4f, %.4f, %.4f)>", 3, "Blender"},
    {"new Vector3(%.4ff, %.4ff, %.4ff)", 1, "Unity"},
    {"Vector3(%.4f, %.4f, %.4f)", 2, "Godot"},
    {"vmath.vector3(%.4f, %.4f, %.4f)"},
    {"float4(%.4f, %.4f, %.4f, 1.0)"},
    {"Vector3<f32>(%.4f, %.4f, %.4f)"},
    {"Vector3 [%.4f, %.4f, %.4f]"},
    {"SVector{3, Float64}(%.4f, %.4f, %.4f)"},
    {"Float32Array(3) [ %.4f, %.4f, %.4f ]"},
    {"( %.4E  %.4E  %.4E)"},
    {"tensor([%.4f, %.4f, %.4f], device='cuda:0')"},
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
                    if (frame.pole && expected.pole) {
                        EXPECT_LT(glm::distance(*frame.pole, glm::vec3(*expected.pole)), rounded);
                    }
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
                std::vector<glm::dvec3> joints;
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
