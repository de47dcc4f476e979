// Export: the linkage as a C++ program that uses the library.
#include <cmath>

#include "app/labs/kit/code_text.hpp"
#include "app/labs/linkage/linkage_commands.hpp"

namespace tendril::app {
namespace {

std::string braced_pair(const glm::dvec2& value) {
    return "{" + double_text(value.x) + ", " + double_text(value.y) + "}";
}

std::string indices_text(const std::vector<std::size_t>& indices) {
    std::vector<std::string> texts;
    for (const std::size_t each : indices) texts.push_back(std::to_string(each));
    return "{" + joined(texts) + "}";
}

std::string sketch_text(const ik::LinkageSketch& sketch) {
    std::string text = "    ik::LinkageSketch sketch;\n    sketch.points = {";
    for (const ik::SketchPoint& each : sketch.points) {
        text += "\n        {" + string_text(each.name) + ", " + braced_pair(each.at);
        if (each.hold == ik::SketchHold::Pinned) text += ", ik::SketchHold::Pinned";
        if (each.hold == ik::SketchHold::Guided)
            text += ", ik::SketchHold::Guided, " + double_text(each.guide);
        text += "},";
    }
    text += "};\n    sketch.bars = {";
    for (const ik::SketchBar& each : sketch.bars)
        text += "\n        {" + string_text(each.name) + ", " + indices_text(each.points) + "},";
    text += "};\n";
    if (sketch.motors.empty()) return text;
    text += "    sketch.motors = {";
    for (const ik::SketchMotor& each : sketch.motors)
        text += "\n        {" + string_text(each.name) + ", " + std::to_string(each.point) + ", " +
                std::to_string(each.bar) +
                (each.against != ik::ground_link ? ", " + std::to_string(each.against) : "") + "},";
    return text + "};\n";
}

/// "ik::four_bar({.ground = 3.0, ...})"
std::string call_text(const Mechanism& mechanism) {
    const bool walker = std::holds_alternative<JansenWalker>(mechanism);
    return "ik::" + std::string(walker ? "jansen" : kind_of(mechanism)->name) + "({" +
           joined(member_texts(mechanism_fields(mechanism))) + "})";
}

/// Pose and assembly mode: each joint's place.
std::string state_text(const LinkagePart& part) {
    std::string text;
    for (std::size_t i = 0; i < part.state.joints.size(); ++i) {
        const ik::JointPlace& each = part.state.joints[i];
        const glm::dquat& turn = each.turn;
        text += "    state.joints[" + std::to_string(i) + "] = {" + double_text(each.value) +
                ", glm::dquat(" +
                joined({double_text(turn.w), double_text(turn.x), double_text(turn.y), double_text(turn.z)}) +
                "), " + double_text(each.last) + "};\n";
    }
    return text;
}

/// The ranges set by hand, before the solver is made.
std::string ranges_text(const LinkagePart& part) {
    std::string text;
    for (const LinkageRange& each : part.shape->ranges) {
        const std::size_t link = *part.linkage().find_link(each.joint);
        const std::string at = "    linkage->links[" + std::to_string(link) + "].";
        if (std::isfinite(each.minimum)) text += at + "minimum = " + double_text(each.minimum) + ";\n";
        if (std::isfinite(each.maximum)) text += at + "maximum = " + double_text(each.maximum) + ";\n";
        text += at + "rest = " + double_text(part.linkage().links[link].rest) + ";\n";
    }
    return text;
}

/// A declaration of `what`, which may have been refused.
std::string expected_text(const std::string& type, const std::string& what, const std::string& from) {
    return "    Expected<ik::" + type + "> " + what + " = " + from + ";\n    if (!" + what +
           ") return std::puts(" + what + ".message()), 1;\n";
}

}  // namespace

std::string linkage_code(const LinkagePart& part) {
    std::string text =
        "// A linkage, exported from Tendril.\n"
        "//\n"
        "// CMake: find_package(tendril REQUIRED)\n"
        "//        target_link_libraries(your_program PRIVATE tendril::core)\n"
        "#include <cstdio>\n"
        "#include <tendril/ik/linkage.hpp>\n"
        "#include <tendril/ik/mechanisms.hpp>\n"
        "#include <vector>\n\n"
        "using namespace tendril;\n\n"
        "int main() {\n";
    const Mechanism& mechanism = part.shape->mechanism;
    const bool drawn = kind_of(mechanism) == nullptr, plane = part.shape->in_plane();
    if (drawn) text += sketch_text(part.shape->sketch);
    if (!drawn && plane) text += expected_text("LinkageSketch", "sketch", call_text(mechanism));
    const std::string sketch = drawn ? "ik::linkage_from(sketch)" : "ik::linkage_from(*sketch)";
    text += expected_text("Linkage", "linkage", plane ? sketch : call_text(mechanism));
    text += ranges_text(part);
    text +=
        "    Expected<ik::LinkageSolver> made = ik::LinkageSolver::make(*linkage);\n"
        "    if (!made) return std::puts(made.message()), 1;\n"
        "    ik::LinkageSolver& solver = *made;\n"
        "    // All that it remembers: copy it to save it.\n"
        "    ik::LinkageState state = solver.initial_state();\n";
    text += state_text(part);
    if (!part.copies.empty())
        text +=
            "    // One of the twelve legs. The others are the same linkage, each with a state of its own, "
            "its\n"
            "    // motor a sixth of a turn further from pair to pair; half of them are mirrored.\n";
    text +=
        "\n"
        "    for (int frame = 0; frame <= 60; ++frame) {\n"
        "        std::vector<ik::LinkDriver> drivers;\n";
    for (const LinkageDrive& each : part.drives) {
        if (!each.held) continue;
        text += "        drivers.push_back({*linkage->find_link(" + string_text(each.joint) + "), " +
                double_text(each.value);
        if (each.rate != 0.0) text += " + frame / 60.0 * " + double_text(each.rate);
        text += "});\n";
    }
    text += "        std::vector<ik::LinkTarget> targets;\n";
    for (const LinkageTarget& each : part.targets)
        text += "        targets.push_back({*linkage->find_point(" + string_text(each.point) + "), " +
                braced(each.to) + ", " + double_text(each.weight) + (each.exact ? ", true" : "") + "});\n";
    text +=
        "        const ik::LinkageReport report = solver.solve(state, {drivers, targets});\n"
        "        std::printf(\"%d %s\", frame, ik::name(report.status));\n"
        "        for (std::size_t i = 0; i < linkage->points.size(); ++i) {\n"
        "            const glm::dvec3 at = solver.point(i);\n"
        "            std::printf(\" %s %.6f %.6f %.6f\", linkage->points[i].name.c_str(), at.x, at.y, "
        "at.z);\n"
        "        }\n"
        "        std::puts(\"\");\n"
        "    }\n"
        "}\n";
    return text;
}

}  // namespace tendril::app
