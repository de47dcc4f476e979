#include "app/batch/code.hpp"

#include "app/batch/output.hpp"
#include "app/document/scene_file.hpp"
#include "app/labs/labs.hpp"

namespace tendril::app {

void print_code(const std::string& scene) {
    const Labs labs;
    Workspace workspace = make_blank_workspace(labs);
    load_scene_file(workspace, scene);
    if (workspace.document.parts().at(workspace.lab)->unread)
        throw std::runtime_error(scene + ": " + workspace.ui.toasts.back().text);
    const std::string code = labs.find(workspace.lab)->code(workspace);
    if (code.empty())
        throw std::runtime_error(scene + ": the lab " + workspace.lab + " has no code to print");
    Progress progress;
    Output out(progress);
    out.write(code);
    out.finish();
}

}  // namespace tendril::app
