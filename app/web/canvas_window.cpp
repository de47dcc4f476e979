// The window of a web page: its element #canvas, with WebGL 2, keyboard, mouse and touch. One finger is the
// left button; two fingers shift the view and zoom, or scroll a panel.
#include "app/window/window.hpp"

#include <emscripten/emscripten.h>
#include <emscripten/html5.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "app/window/gl.hpp"

namespace tendril::app {
namespace {

constexpr const char* canvas = "#canvas";
const char* const whole_page = EMSCRIPTEN_EVENT_TARGET_WINDOW;
constexpr float pixels_per_notch = 100.0f, lines_per_notch = 3.0f;  ///< wheel, as browsers report it
constexpr float zoom_per_notch = 1.15f;   ///< ratio of two fingers' distances for a notch, as in zoomed()
constexpr float pixels_scrolled = 75.0f;  ///< by a notch over a panel: five lines, as Dear ImGui does

// clang-format off
EM_JS(void, show_cursor, (const char* name), { document.getElementById("canvas").style.cursor = UTF8ToString(name); });
EM_JS(void, show_title, (const char* text), { document.title = UTF8ToString(text); });
EM_JS(void, copy_text, (const char* text), {
    if (navigator.clipboard) navigator.clipboard.writeText(UTF8ToString(text)).catch(() => {});
});
EM_JS(void, choose_any_file, (), { tendrilChoose(); });
// clang-format on

/// The key with the browser's name; letters and digits as the layout labels them. Unknown if Tendril has no
/// name for it.
Key named_key(const EmscriptenKeyboardEvent& event) {
    std::string_view name = event.key;
    if (name == " ") return Key::Space;
    if (name == "Control") return Key::Ctrl;
    if (name == "Meta") return Key::Super;
    if (name == "PageUp") return Key::PageUp;
    if (name == "PageDown") return Key::PageDown;
    if (name.starts_with("Arrow")) name.remove_prefix(5);
    if (const auto key = key_from_name(name)) return *key;
    // A symbol over a digit, or a letter of another script: by its place on a US keyboard.
    std::string_view place = event.code;
    for (const std::string_view kind : {"Key", "Digit", "Numpad"})
        if (place.starts_with(kind)) place.remove_prefix(kind.size());
    return key_from_name(place).value_or(Key::Unknown);
}

/// True if the browser handles the key: reload, full screen, tools, tabs, and paste, which arrives as an
/// event with the text.
bool is_for_browser(const EmscriptenKeyboardEvent& event) {
    const std::string_view name = event.key;
    if (name == "F5" || name == "F11" || name == "F12") return true;
    const bool control = event.ctrlKey || event.metaKey;
    if (!control) return false;
    for (const char* const each : {"r", "t", "w", "n", "l", "v", "V", "R", "I", "J"})
        if (name == each) return true;
    return false;
}

class CanvasWindow final : public Window {
  public:
    CanvasWindow();
    ~CanvasWindow() override { emscripten_webgl_destroy_context(context_); }
    CanvasWindow(const CanvasWindow&) = delete;
    CanvasWindow& operator=(const CanvasWindow&) = delete;

    glm::ivec2 size() const override { return size_; }
    glm::ivec2 framebuffer_size() const override { return pixels_; }
    void poll(std::vector<Event>& events, double) override;
    void present() override {}
    void resize(glm::ivec2) override {}  // the page decides
    void set_cursor(Cursor cursor) override {
        constexpr const char* names[] = {"default", "pointer", "grabbing", "text", "col-resize"};
        show_cursor(names[static_cast<std::size_t>(cursor)]);
    }
    void set_title(const std::string& title) override { show_title(title.c_str()); }
    bool choose_file() override {
        choose_any_file();
        return true;
    }
    std::string clipboard() override { return clipboard_; }
    void set_clipboard(const std::string& text) override {
        clipboard_ = text;
        copy_text(text.c_str());
    }

    void drop(std::string path) { pending_.emplace_back(Drop{{std::move(path)}}); }
    void paste(std::string text) {
        clipboard_ = std::move(text);
        // The loop takes Ctrl+V as a request for the clipboard.
        for (const bool down : {true, false}) pending_.emplace_back(KeyChange{Key::V, down});
    }
    static CanvasWindow* open;

  private:
    void listen();
    void fit_page();
    void move_to(long x, long y) { pending_.emplace_back(MouseMove{glm::vec2(x, y)}); }
    void on_key(const EmscriptenKeyboardEvent& event, bool down);
    void on_touch(int kind, const EmscriptenTouchEvent& event);

    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context_ = 0;
    glm::ivec2 size_{1}, pixels_{1};
    std::vector<Event> pending_;
    std::string clipboard_;
    /// Fingers on the canvas.
    enum class Fingers { None, One, Two };
    Fingers fingers_ = Fingers::None;
    float apart_ = 1.0f;   ///< distance of two fingers at the last wheel event, pixels
    float height_ = 0.0f;  ///< of their middle, then
};

CanvasWindow* CanvasWindow::open = nullptr;

CanvasWindow::CanvasWindow() {
    EmscriptenWebGLContextAttributes wanted;
    emscripten_webgl_init_context_attributes(&wanted);
    wanted.majorVersion = 2;
    wanted.antialias = false;  // the shaders smooth edges
    wanted.alpha = false;
    wanted.preserveDrawingBuffer = true;  // unchanged frames are not redrawn
    context_ = emscripten_webgl_create_context(canvas, &wanted);
    if (context_ <= 0 || emscripten_webgl_make_context_current(context_) != EMSCRIPTEN_RESULT_SUCCESS)
        throw std::runtime_error("this browser has no WebGL 2");
    fit_page();
    listen();
    open = this;
}

void CanvasWindow::fit_page() {
    double width = 0.0, height = 0.0;
    emscripten_get_element_css_size(canvas, &width, &height);
    const double ratio = std::clamp(emscripten_get_device_pixel_ratio(), 0.5, 4.0);
    const glm::ivec2 now(std::max(1.0, width), std::max(1.0, height));
    const glm::ivec2 pixels(std::max(1.0, std::round(width * ratio)),
                            std::max(1.0, std::round(height * ratio)));
    if (now == size_ && pixels == pixels_) return;
    size_ = now;
    pixels_ = pixels;
    emscripten_set_canvas_element_size(canvas, pixels.x, pixels.y);
    pending_.emplace_back(Resize{size_});
}

void CanvasWindow::poll(std::vector<Event>& events, double) {
    fit_page();
    events.insert(events.end(), std::move_iterator(pending_.begin()), std::move_iterator(pending_.end()));
    pending_.clear();
}

void CanvasWindow::listen() {
    const auto on_button = [](int kind, const EmscriptenMouseEvent* event, void* self) -> EM_BOOL {
        const bool down = kind == EMSCRIPTEN_EVENT_MOUSEDOWN;
        const MouseButton button = event->button == 2   ? MouseButton::Right
                                   : event->button == 1 ? MouseButton::Middle
                                                        : MouseButton::Left;
        static_cast<CanvasWindow*>(self)->pending_.emplace_back(MousePress{button, down});
        return down ? EM_FALSE : EM_TRUE;  // a press must still give the page the keyboard
    };
    emscripten_set_mousedown_callback(canvas, this, EM_FALSE, on_button);
    emscripten_set_mouseup_callback(whole_page, this, EM_FALSE, on_button);
    emscripten_set_mousemove_callback(
        whole_page, this, EM_FALSE, [](int, const EmscriptenMouseEvent* event, void* self) -> EM_BOOL {
            static_cast<CanvasWindow*>(self)->move_to(event->clientX, event->clientY);
            return EM_FALSE;
        });
    emscripten_set_wheel_callback(
        canvas, this, EM_FALSE, [](int, const EmscriptenWheelEvent* event, void* self) -> EM_BOOL {
            const float notch = event->deltaMode == DOM_DELTA_PIXEL ? pixels_per_notch : lines_per_notch;
            static_cast<CanvasWindow*>(self)->pending_.emplace_back(MouseWheel{
                static_cast<float>(-event->deltaY) / notch, static_cast<float>(-event->deltaX) / notch});
            return EM_TRUE;
        });
    const auto on_key = [](int kind, const EmscriptenKeyboardEvent* event, void* self) -> EM_BOOL {
        if (is_for_browser(*event)) return EM_FALSE;
        static_cast<CanvasWindow*>(self)->on_key(*event, kind == EMSCRIPTEN_EVENT_KEYDOWN);
        return EM_TRUE;
    };
    emscripten_set_keydown_callback(whole_page, this, EM_FALSE, on_key);
    emscripten_set_keyup_callback(whole_page, this, EM_FALSE, on_key);
    const auto on_focus = [](int kind, const EmscriptenFocusEvent*, void* self) -> EM_BOOL {
        static_cast<CanvasWindow*>(self)->pending_.emplace_back(Focus{kind == EMSCRIPTEN_EVENT_FOCUS});
        return EM_FALSE;
    };
    emscripten_set_focus_callback(whole_page, this, EM_FALSE, on_focus);
    emscripten_set_blur_callback(whole_page, this, EM_FALSE, on_focus);
    const auto on_touch = [](int kind, const EmscriptenTouchEvent* event, void* self) -> EM_BOOL {
        static_cast<CanvasWindow*>(self)->on_touch(kind, *event);
        return EM_TRUE;  // otherwise the browser also sends mouse events
    };
    emscripten_set_touchstart_callback(canvas, this, EM_FALSE, on_touch);
    emscripten_set_touchmove_callback(canvas, this, EM_FALSE, on_touch);
    emscripten_set_touchend_callback(canvas, this, EM_FALSE, on_touch);
    emscripten_set_touchcancel_callback(canvas, this, EM_FALSE, on_touch);
}

void CanvasWindow::on_key(const EmscriptenKeyboardEvent& event, bool down) {
    const Key key = named_key(event);
    if (key != Key::Unknown && !(down && event.repeat && key >= Key::Shift))
        pending_.emplace_back(KeyChange{key, down});
    if (!down || event.ctrlKey || event.metaKey) return;
    // A typing key's name is its text: one character. Other names are ASCII words.
    const std::string_view name = event.key;
    const bool one = !name.empty() && (name.size() == 1 || static_cast<unsigned char>(name[0]) >= 0x80);
    if (!one) return;
    pending_.emplace_back(TextInput{std::string(name)});
    if (name == "?")
        for (const bool each : {true, false}) pending_.emplace_back(KeyChange{Key::Question, each});
}

void CanvasWindow::on_touch(int kind, const EmscriptenTouchEvent& event) {
    std::vector<glm::vec2> down;
    glm::vec2 lifted(0.0f);
    const bool ends = kind == EMSCRIPTEN_EVENT_TOUCHEND || kind == EMSCRIPTEN_EVENT_TOUCHCANCEL;
    for (int i = 0; i < event.numTouches; ++i) {
        const EmscriptenTouchPoint& each = event.touches[i];
        const glm::vec2 at(each.targetX, each.targetY);
        if (ends && each.isChanged)
            lifted = at;
        else
            down.push_back(at);
    }
    const Fingers now = down.empty() ? Fingers::None : down.size() == 1 ? Fingers::One : Fingers::Two;
    const auto press = [this](MouseButton button, bool pressed) {
        pending_.emplace_back(MousePress{button, pressed, true});
    };
    const glm::vec2 at = now == Fingers::None  ? lifted
                         : now == Fingers::One ? down[0]
                                               : 0.5f * (down[0] + down[1]);
    if (now != fingers_) {
        if (fingers_ == Fingers::One) press(MouseButton::Left, false);
        if (fingers_ == Fingers::Two) press(MouseButton::Middle, false);
        // The finger that remains after two is not a new press.
        const bool presses = now == Fingers::Two || (now == Fingers::One && fingers_ == Fingers::None);
        move_to(static_cast<long>(at.x), static_cast<long>(at.y));
        if (presses) press(now == Fingers::One ? MouseButton::Left : MouseButton::Middle, true);
        if (now == Fingers::None) move_to(-1, -1);  // nothing stays lit under a finger that has gone
        if (now == Fingers::Two) apart_ = std::max(1.0f, glm::length(down[1] - down[0])), height_ = at.y;
        fingers_ = presses || now == Fingers::None ? now : Fingers::None;
        return;
    }
    if (now == Fingers::None) return;
    const bool scrolls = now == Fingers::Two && ImGui::GetIO().WantCaptureMouse;
    if (!scrolls) move_to(static_cast<long>(at.x), static_cast<long>(at.y));
    if (now != Fingers::Two) return;
    const float apart = std::max(1.0f, glm::length(down[1] - down[0]));
    const float by =
        scrolls ? (at.y - height_) / pixels_scrolled : std::log(apart / apart_) / std::log(zoom_per_notch);
    pending_.emplace_back(MouseWheel{by, 0.0f});
    apart_ = apart;
    height_ = at.y;
}

}  // namespace

// In place of GLFW's; the page decides the size.
std::unique_ptr<Window> open_glfw_window(glm::ivec2) {
    return std::make_unique<CanvasWindow>();
}

std::unique_ptr<Window> open_hidden_window(glm::ivec2) {
    throw std::runtime_error("a page has no hidden window");
}

}  // namespace tendril::app

/// Called by the page once it has stored a dropped file at `path`.
extern "C" EMSCRIPTEN_KEEPALIVE void tendril_drop(const char* path) {
    if (auto* const window = tendril::app::CanvasWindow::open) window->drop(path);
}

/// Called by the page when the user pastes.
extern "C" EMSCRIPTEN_KEEPALIVE void tendril_paste(const char* text) {
    if (auto* const window = tendril::app::CanvasWindow::open) window->paste(text);
}
