// The program in a web page. The browser calls pass() for each frame.
#include <emscripten/emscripten.h>

#include <atomic>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "app/app.hpp"
#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/live_loop.hpp"
#include "app/script/recorder.hpp"
#include "app/session.hpp"
#include "app/system/environment.hpp"
#include "app/window/window.hpp"

namespace tendril::app {
namespace {

std::atomic<bool> ending{false};

struct Page {
    std::unique_ptr<Window> window = open_window(Backend::Glfw, {1, 1});  // the page decides the size
    App app{*window};
    LiveLoop live{app, *window, {.config = true, .ending = ending}};
    Player player{Script{}};
};
std::unique_ptr<Page> page;

// clang-format off
EM_JS(void, show_failure, (const char* text), { tendrilFailed(UTF8ToString(text)); });
EM_JS(void, show_page, (), { tendrilReady(); });
EM_JS(void, show_address, (const char* scene), { tendrilAddress(UTF8ToString(scene)); });
// clang-format on

/// Stops the program and shows the reason on the page.
void fail(const std::exception& error) {
    emscripten_cancel_main_loop();
    show_failure(error.what());
}

/// The open lab's scene as JSON, for the page's address.
std::string linked_scene() {
    const Workspace& workspace = page->app.workspace();
    Json scene = save_scene(workspace);
    scene["labs"] = {{workspace.lab, scene["labs"][workspace.lab]}};
    return scene.dump();
}

/// Updates the address after a change.
void update_address() {
    static std::uint64_t edition = page->app.workspace().edition;
    const std::uint64_t now = page->app.workspace().edition;
    if (now == edition || page->app.busy()) return;
    edition = now;
    show_address(linked_scene().c_str());
}

void pass() {
    static bool shown = false;
    try {
        page->live.pass(page->player, std::nullopt);
        if (!std::exchange(shown, true)) show_page();
        update_address();
    } catch (const std::exception& error) {
        fail(error);
    }
}

void start(const std::string& scene, const std::string& lab) {
    page = std::make_unique<Page>();
    SessionOptions options;
    options.scene = scene;
    page->app.workspace().config = config_folder();
    constexpr int narrow = 600;  // a phone held upright: the scene alone
    if (page->window->size().x < narrow) {
        Settings& settings = page->app.workspace().settings;
        settings.left_open = settings.right_open = false;
    }
    offer_cards(page->app);
    if (!lab.empty()) page->app.run({"lab.open", Json{{"name", lab}}});
    open_scene(page->app, options);
    page->live.begin();
    emscripten_set_main_loop(pass, 0, false);
}

/// Valid until the next call.
const char* handed_out(std::string text) {
    static std::string kept;
    kept = std::move(text);
    return kept.c_str();
}

}  // namespace
}  // namespace tendril::app

// For scripts on the page. Texts are UTF-8.

/// The state that --state writes, as JSON: the open lab's numbers, and handles with their pixels.
extern "C" EMSCRIPTEN_KEEPALIVE const char* tendril_state() {
    using namespace tendril::app;
    return handed_out(page ? page->app.state().dump() : "null");
}

/// Runs a command with a JSON object of arguments. Returns why it is refused, otherwise an empty text.
extern "C" EMSCRIPTEN_KEEPALIVE const char* tendril_run(const char* command, const char* arguments) {
    using namespace tendril::app;
    if (!page) return "the program has not started";
    try {
        page->app.run({command, Json::parse(arguments)});
        return "";
    } catch (const std::exception& refused) {
        return handed_out(refused.what());
    }
}

/// Writes unsaved work to the program's folder: the page is about to be hidden or closed.
extern "C" EMSCRIPTEN_KEEPALIVE void tendril_keep() {
    using namespace tendril::app;
    if (!page) return;
    ending = true;
    page->live.end();
    ending = false;
    page->live.begin();
}

/// `arguments`: a file to open and a lab, or empty texts.
int main(int, char** arguments) {
    try {
        tendril::app::start(arguments[1], arguments[2]);
    } catch (const std::exception& error) {
        tendril::app::fail(error);
    }
}
