#include "app/document/picture_arguments.hpp"

#include <string>
#include <utility>

#include "app/document/atomic_file.hpp"
#include "app/document/refused.hpp"
#include "app/document/workspace.hpp"

namespace tendril::app {

std::vector<Argument> picture_arguments(std::vector<Argument> first) {
    for (const char* side : {"width", "height"})
        first.push_back(integer_argument(side, "pixels; default: the view's, or in its proportions",
                                         min_picture, max_picture));
    first.push_back(switch_argument("transparent", "with a transparent background"));
    first.push_back(switch_argument("paper", "dark on white, for print, or dark on nothing if transparent"));
    first.push_back(switch_argument("handles", "shows handles and marks the selection"));
    first.push_back(
        switch_argument("labels", "draws labels, titles and the legend; default: only while a race is open"));
    return first;
}

void set_look(const Arguments& given, PictureLook& look) {
    if (given.has("width")) look.size.x = given.integer("width");
    if (given.has("height")) look.size.y = given.integer("height");
    for (const auto& [name, on] :
         {std::pair("transparent", &look.transparent), {"paper", &look.paper}, {"handles", &look.handles}})
        *on = given.has(name) && given.boolean(name);
    if (given.has("labels")) look.labels = given.boolean("labels");
}

std::filesystem::path new_file(const Workspace& workspace, const std::string& what, const char* extension) {
    if (!workspace.names_pictures) throw Refused("path is missing");
    std::string stem = workspace.path.empty() ? "tendril" : workspace.path.stem().string();
    if (!what.empty()) stem += "-" + what;
    return numbered_file(workspace.path.parent_path() / stem, extension);
}

}  // namespace tendril::app
