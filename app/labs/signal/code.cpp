#include "app/labs/signal/signal_lab.hpp"

#include "app/labs/kit/code_text.hpp"

namespace tendril::app {
namespace {

std::string initialiser(const signal::Filter& filter) {
    const signal::Kind& kind = signal::kind_of(filter);
    return library_name(kind.in_code) +
           struct_text({kind.table(), signal::fields_in(filter)}, "                        ");
}

}  // namespace

/// A complete program: the enabled filters, stepped frame by frame through one second after a jump.
std::string SignalLab::code(const Workspace& workspace) const {
    std::string text =
        "// Filters, exported from Tendril.\n"
        "//\n"
        "// CMake: find_package(tendril REQUIRED)\n"
        "//        target_link_libraries(your_program PRIVATE tendril::core)\n"
        "#include <cstdio>\n"
        "#include <tendril/signal/run.hpp>\n"
        "#include <vector>\n\n"
        "using namespace tendril;\n\n"
        "int main() {\n"
        "    // Applied in this order.\n"
        "    const std::vector<signal::Filter> filters{";
    const std::vector<signal::Filter> filters = enabled_filters(signal_part(workspace));
    for (const signal::Filter& filter : filters) text += "\n        " + initialiser(filter) + ",";
    text += filters.empty() ? "};\n" : "\n    };\n";
    text +=
        "    // What they remember: copy it to save it, start from a fresh one to reset them.\n"
        "    std::vector<signal::FilterState> states(filters.size());\n\n"
        "    const double dt = 1.0 / 60.0;\n"
        "    for (int frame = 0; frame <= 60; ++frame) {\n"
        "        const double input = frame == 0 ? 0.0 : 1.0;  // a jump\n"
        "        const double output = signal::step(filters, states, input, dt);\n"
        "        std::printf(\"%.4f %.6f\\n\", frame * dt, output);\n"
        "    }\n"
        "}\n";
    return text;
}

}  // namespace tendril::app
