#include "app/labs/labs.hpp"

#include <algorithm>
#include <fstream>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/names.hpp"
#include "app/io/text.hpp"
#include "app/labs/card.hpp"
#include "app/labs/chain/chain_lab.hpp"
#include "app/labs/humanoid/humanoid_lab.hpp"
#include "app/labs/kit/past.hpp"
#include "app/labs/lab.hpp"
#include "app/labs/linkage/linkage_lab.hpp"
#include "app/labs/rig/rig_lab.hpp"
#include "app/labs/rope/rope_lab.hpp"
#include "app/labs/signal/signal_lab.hpp"

namespace tendril::app {

Labs::Labs() {
    add(std::make_unique<ChainLab>());
    add(std::make_unique<RopeLab>());
    add(std::make_unique<SignalLab>());
    add(std::make_unique<RigLab>());
    add(std::make_unique<HumanoidLab>());
    add(std::make_unique<LinkageLab>());
}

void Labs::add(std::unique_ptr<Lab> lab) {
    if (find(lab->name()) != nullptr) throw std::logic_error("lab added twice: " + lab->name());
    labs_.push_back(std::move(lab));
}

const Lab* Labs::find(std::string_view name) const {
    const auto found =
        std::find_if(labs_.begin(), labs_.end(), [&](const auto& lab) { return lab->name() == name; });
    return found == labs_.end() ? nullptr : found->get();
}

Workspace make_blank_workspace(const Labs& labs) {
    Workspace workspace;
    for (const auto& lab : labs.all()) workspace.document.set(lab->name(), lab->blank());
    workspace.blank = workspace.saved = workspace.document;
    workspace.lab = labs.all().front()->name();
    for (const auto& lab : labs.all()) workspace.first_views[lab->name()] = lab->first_view();
    workspace.camera = workspace.first_view = labs.all().front()->first_view();
    return workspace;
}

CommandTable make_command_table(const Labs& labs) {
    CommandTable table;
    add_workspace_commands(table);
    add_camera_commands(table, labs);
    add_card_commands(table);
    add_video_commands(table, labs);
    add_file_command(table, labs);
    add_closing_command(table, labs);
    for (const auto& lab : labs.all()) {
        table.begin_lab(lab->name());
        lab->add_commands(table);
        for (const LabSetting& setting : lab->all_settings()) table.add(setting_command(setting));
    }
    return table;
}

Bounds bounds_of(glm::vec3 low, glm::vec3 high, float smallest) {
    return {0.5f * (low + high), std::max(0.5f * glm::distance(low, high), smallest)};
}

void frame_unless_seen(Workspace& workspace, const Bounds& bounds) {
    constexpr float smallest = 0.25f;  // fraction of the view
    const Rect view{{0.0f, 0.0f}, workspace.ui.view_size};
    const Camera camera(workspace.camera, view);
    const auto at = camera.project(bounds.centre);
    const float pixels = 2.0f * bounds.radius / camera.metres_per_pixel(bounds.centre);
    if (at && view.contains(*at) && pixels >= smallest * std::min(view.size().x, view.size().y)) return;
    workspace.camera = framed(workspace.camera, view, bounds.centre, bounds.radius);
}

std::optional<Handle> Lab::handle(const Workspace& workspace, PickId pick) const {
    const std::vector<Handle> all = handles(workspace);
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Handle& handle) { return handle.pick == pick; });
    return found == all.end() ? std::nullopt : std::optional(*found);
}

Bounds Lab::bounds(const Workspace& workspace, bool) const {
    const std::vector<Handle> all = handles(workspace);
    if (all.empty()) return {};
    glm::vec3 low = all.front().frame.position, high = low;
    for (const Handle& handle : all) {
        low = glm::min(low, handle.frame.position);
        high = glm::max(high, handle.frame.position);
    }
    return bounds_of(low, high);
}

std::vector<Incident> Lab::review(const Workspace& workspace, const Part& before, const Part& after) const {
    const Past* const table = past();
    return table && table->incidents ? table->incidents(workspace, before, after) : std::vector<Incident>();
}

bool Lab::same_joints(const Part& before, const Part& after) const {
    const Past* const table = past();
    return !table || !table->incidents || table->same_joints(before, after);
}

float Lab::timeline_height(const Workspace& workspace) const {
    return past() ? strip_height + past_plot_height(workspace.settings, *past()) : 0.0f;
}

void Lab::timeline(const Workspace& workspace, Emit& emit) const {
    if (past()) past_plot(workspace, *past(), past_strip(workspace, emit), emit);
}

std::vector<LabSetting> Lab::all_settings() const {
    std::vector<LabSetting> all = settings();
    if (const Past* const table = past()) all.insert(all.end(), {table->plot(), table->ghosts()});
    return all;
}

Json Lab::state(const Workspace& workspace) const {
    Json state{{"lab", name()}};
    state.update(workspace.document.parts().at(name())->save());
    return state;
}

namespace {

namespace fs = std::filesystem;

/// The part of a file that FileKind::begins() sees. Empty if it cannot be read.
std::string beginning_of(const fs::path& file) {
    constexpr std::streamsize enough = 1 << 16;
    std::ifstream in(file, std::ios::binary);
    std::string text(static_cast<std::size_t>(enough), '\0');
    in.read(text.data(), enough);
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

bool begins_scene(std::string_view text) {
    return text.find("\"tendril_scene\"") != text.npos;
}

std::string all_kinds(const std::vector<FileRoute>& routes) {
    std::string text;
    for (std::size_t i = 0; i < routes.size(); ++i)
        text += (i == 0 ? "" : i + 1 == routes.size() ? " and " : ", ") + kind_text(routes[i].kind);
    return text;
}

/// The command that opens such files, complete enough to run without the program's table.
Command opener(const FileRoute& route) {
    CommandTable own;
    route.lab != nullptr ? route.lab->add_commands(own) : add_scene_commands(own);
    return *own.find(route.kind.command);
}

/// The lab of a command that reads a file.
FileRoute route_of(const Labs& labs, const std::string& command) {
    for (const auto& lab : labs.all()) {
        CommandTable own;
        lab->add_commands(own);
        const Command* const found = own.find(command);
        if (found != nullptr && found->effect == Effect::Edit &&
            std::ranges::find(found->arguments, "path", &Argument::name) != found->arguments.end())
            return {lab.get(), {{}, {}, command}};
    }
    throw Refused("by: no command \"" + command + "\" opens a file");
}

/// Opens the lab last, so that a refusal leaves the present one open.
void open(const Labs& labs, Workspace& workspace, const Arguments& given) {
    const std::string path = given.text("path"), by = given.has("by") ? given.text("by") : "";
    const FileRoute route = by.empty() ? file_route(labs, path) : route_of(labs, by);
    if (route.lab != nullptr && given.has("ask") && given.boolean("ask") &&
        (by.empty() || std::ranges::any_of(route.lab->files(), [&](const FileKind& kind) {
             return kind.command == by && has_ending(kind, path);
         })))
        if (std::vector<FileWay> ways = route.lab->file_ways(workspace, path); !ways.empty()) {
            workspace.close_file_dialog();
            workspace.ui.file_question = {path, std::move(ways)};
            return;
        }
    Json arguments = to_json(route.kind.arguments);
    arguments["path"] = path;
    opener(route).apply(workspace, Arguments(arguments));
    if (route.lab != nullptr) workspace.open_lab(route.lab->name());
    workspace.close_file_dialog();
}

}  // namespace

std::vector<FileRoute> file_routes(const Labs& labs) {
    std::vector<FileRoute> routes{{nullptr, {"scenes", {".json"}, "scene.open", {}, begins_scene}}};
    for (const auto& lab : labs.all())
        for (FileKind& kind : lab->files()) routes.push_back({lab.get(), std::move(kind)});
    return routes;
}

bool has_ending(const FileKind& kind, const fs::path& file) {
    const std::string ending = lower_case(file.extension().string());
    return std::find(kind.endings.begin(), kind.endings.end(), ending) != kind.endings.end();
}

std::string kind_text(const FileKind& kind) {
    const auto endings = names(kind.endings, [](const std::string& each) { return each.substr(1); });
    return kind.plural + " (" + comma_list(endings) + ")";
}

FileRoute file_route(const Labs& labs, const fs::path& file) {
    const std::vector<FileRoute> routes = file_routes(labs);
    std::vector<FileRoute> fitting;
    std::copy_if(routes.begin(), routes.end(), std::back_inserter(fitting),
                 [&](const FileRoute& route) { return has_ending(route.kind, file); });
    if (fitting.size() == 1) return fitting.front();
    // A pipe can be read only once, so assume a scene.
    std::error_code none;
    if (const fs::file_status status = fs::status(file, none);
        fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
        return routes.front();
    const std::string text = beginning_of(file);
    const std::vector<FileRoute>& among = fitting.empty() ? routes : fitting;
    for (const FileRoute& route : among)
        if (route.kind.begins != nullptr && route.kind.begins(text)) return route;
    // Prefer a kind that takes any text with its ending to one that would check and refuse the text.
    for (const FileRoute& route : fitting)
        if (route.kind.begins == nullptr) return route;
    if (!fitting.empty()) return fitting.front();
    std::error_code unknown;
    const std::string name = file.string();
    if (fs::is_directory(file, unknown)) throw Refused(name + " is a folder");
    if (!fs::exists(file, unknown)) throw Refused(name + ": there is no such file");
    throw Refused(name + ": Tendril does not read this kind of file. It reads " + all_kinds(routes));
}

void add_file_command(CommandTable& table, const Labs& labs) {
    table.add({.name = "file.open",
               .title = "Open a file in its lab",
               .arguments = {text_argument("path", true, all_kinds(file_routes(labs))),
                             text_argument("by", false,
                                           "the command that opens it, such as humanoid.motion.load; "
                                           "default: the usual one for its kind"),
                             switch_argument("ask", "shows a choice if there are several ways to open it")},
               .help = "Opens a file of any kind, and the lab that reads it; undo restores what was before",
               .effect = Effect::Edit,
               .apply = [&labs](Workspace& w, const Arguments& a) { open(labs, w, a); },
               .finish =
                   [&labs](Workspace& w) {
                       for (const FileRoute& route : file_routes(labs))
                           if (const auto finish = opener(route).finish) finish(w);
                   }});
}

}  // namespace tendril::app
