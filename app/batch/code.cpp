#include "app/batch/subcommands.hpp"

#include "app/batch/output.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

void print_code(const std::string& scene) {
    const Labs labs;
    Workspace workspace = make_blank_workspace(labs);
    for (const LabNote& each : load_scene_file(workspace, scene))
        if (each.lab == workspace.lab && !each.whole) throw std::runtime_error(scene + ": " + each.text);
    const std::string code = labs.find(workspace.lab)->code(workspace);
    if (code.empty())
        throw std::runtime_error(scene + ": the lab " + workspace.lab + " has no code to print");
    Progress progress;
    Output out(progress);
    out.write(code);
    out.finish();
}

}  // namespace tendril::app
