// Export: the linkage as a C++ program that uses the library.
#include <cmath>

#include "app/labs/kit/code_text.hpp"
#include "app/labs/linkage/linkage_commands.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/linkage/measures.hpp"

namespace tendril::app {
namespace {

/// A preset as a call: "ik::four_bar({.ground = 3.0, ...})".
std::string call_text(const Mechanism& mechanism) {
    const bool walker = std::holds_alternative<JansenWalker>(mechanism);
    return "ik::" + std::string(walker ? "jansen" : kind_of(mechanism)->name) + "({" +
           comma_list(member_texts(mechanism_fields(mechanism))) + "})";
}

/// Code that sets the ranges set by hand, before the solver is made.
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

/// Declares `what` as an Expected and checks it.
std::string expected_text(const std::string& type, const std::string& what, const std::string& from) {
    return "    Expected<ik::" + type + "> " + what + " = " + from + ";\n    if (!" + what +
           ") return std::puts(" + what + ".message()), 1;\n";
}

}  // namespace

/// A complete program: builds the linkage with the library, runs its motors for a second and prints its
/// points.
std::string LinkageLab::code(const Workspace& workspace) const {
    const LinkagePart& part = linkage_part(workspace);
    std::string text =
        "// A linkage, exported from Tendril.\n//\n"
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
    if (drawn)
        text += "    const ik::LinkageSketch sketch" + struct_text(part.shape->sketch, "        ") + ";\n";
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
    text += "    state = " + struct_text(part.state, "        ") + ";\n";
    if (!part.copies.empty())
        text +=
            "    // One of the twelve legs. The others are the same linkage, each with a state of its own, "
            "its\n"
            "    // motor a sixth of a turn further from pair to pair; half of them are mirrored.\n";
    text +=
        "\n    for (int frame = 0; frame <= 60; ++frame) {\n"
        "        std::vector<ik::LinkDriver> drivers;\n";
    LinkageRuntime runtime;
    const bool moves = part.targets.empty() && part.result.freedom.actual == 1;  // so does a motor at rest
    if (moves && !part.drives.empty() && std::ranges::none_of(part.drives, is_running))
        text += "        // The motor is at rest in the lab; here it runs.\n";
    for (const LinkageDrive& each : moves ? moving_drives(part, runtime) : part.drives) {
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
