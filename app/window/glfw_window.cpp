#include "app/window/window.hpp"

// Our GL declarations come first, so that GLFW includes none.
#include "app/window/gl.hpp"
// then
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <stdexcept>
#include <utility>

#include "app/system/environment.hpp"
#include "app/window/keys.hpp"
#include "app/window/offscreen_window.hpp"

namespace tendril::app {
namespace {

/// The last error: GLFW reports errors to a callback without user data.
std::string& last_error() {
    static std::string text;
    return text;
}

std::string take_error() {
    std::string text = std::exchange(last_error(), {});
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "GLFW gave no reason" : text;
}

/// GLFW, initialised and terminated with the window.
struct Library {
    Library() {
        glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
#ifdef GLFW_PLATFORM  // GLFW 3.4 prefers Wayland, whose library complains on stderr where this folder is not
                      // set
        if (environment_variable("XDG_RUNTIME_DIR").empty() && glfwPlatformSupported(GLFW_PLATFORM_X11))
            glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (glfwInit() != GLFW_TRUE) throw std::runtime_error("no display: " + take_error());
    }
    ~Library() {
        glfwTerminate();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

/// A window that is not shown yet. Its context is current and its GL loaded.
GLFWwindow* open_hidden(glm::ivec2 size) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_DEPTH_BITS, 24);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "tendril");
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "tendril");
    GLFWwindow* const window = glfwCreateWindow(size.x, size.y, "Tendril", nullptr, nullptr);
    if (window == nullptr) throw std::runtime_error("no window with OpenGL 3.3: " + take_error());
    glfwMakeContextCurrent(window);
    load_gl(glfwGetProcAddress, "GLFW");
    return window;
}

/// A window that is never shown: a context to draw off screen when no other backend provides one.
class HiddenContext {
    Library library_;
    GLFWwindow* window_ = open_hidden({64, 64});  // glfwTerminate() closes it
};

int cursor_shape(Cursor cursor) {
    switch (cursor) {
        case Cursor::Hand:
        case Cursor::Grab:  // GLFW 3.3 has no closed hand
            return GLFW_HAND_CURSOR;
        case Cursor::Text:
            return GLFW_IBEAM_CURSOR;
        case Cursor::ResizeColumn:
            return GLFW_HRESIZE_CURSOR;
        case Cursor::Arrow:
            break;
    }
    return GLFW_ARROW_CURSOR;
}

class GlfwWindow final : public Window {
  public:
    explicit GlfwWindow(glm::ivec2 size);

    glm::ivec2 size() const override {
        glm::ivec2 s{0};
        glfwGetWindowSize(window_, &s.x, &s.y);
        return {std::max(s.x, 1), std::max(s.y, 1)};  // a minimised window is 0 x 0 on some systems
    }
    glm::ivec2 framebuffer_size() const override {
        glm::ivec2 s{0};
        glfwGetFramebufferSize(window_, &s.x, &s.y);
        return {std::max(s.x, 1), std::max(s.y, 1)};
    }
    float content_scale() const override {
        glm::vec2 scale{1.0f};
        glfwGetWindowContentScale(window_, &scale.x, &scale.y);
        // Divide by the scale that window coordinates already include (Wayland).
        const float done = static_cast<float>(framebuffer_size().x) / static_cast<float>(size().x);
        return std::clamp(scale.x / std::max(done, 0.1f), 0.5f, 4.0f);
    }

    void poll(std::vector<Event>& events, double seconds) override;
    void present() override;
    void resize(glm::ivec2 size) override {
        check_window_size(size);
        glfwSetWindowSize(window_, size.x, size.y);
    }
    void fit_screen() override {
        GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
        if (monitor == nullptr) return;
        glm::ivec2 room{0};
        glfwGetMonitorWorkarea(monitor, nullptr, nullptr, &room.x, &room.y);
        const glm::ivec2 now = size(), fitting = glm::min(now, room);
        if (room.x > 0 && room.y > 0 && fitting != now) glfwSetWindowSize(window_, fitting.x, fitting.y);
    }

    void set_cursor(Cursor cursor) override;
    void set_title(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }
    std::string clipboard() override {
        const char* const text = glfwGetClipboardString(window_);
        return text == nullptr ? std::string() : std::string(text);
    }
    void set_clipboard(const std::string& text) override { glfwSetClipboardString(window_, text.c_str()); }

  private:
    static GlfwWindow& of(GLFWwindow* window) {
        return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window));
    }
    void listen();
    void listen_to_input();
    void on_key(int key, int scancode, int action);
    void on_text(unsigned codepoint);
    /// Reports the size even if it is unchanged, to make the program redraw a lost picture.
    void report_size() { pending_.emplace_back(Resize{size()}); }

    Library library_;
    GLFWwindow* window_;
    std::vector<Event> pending_;
    std::array<Key, GLFW_KEY_LAST + 1> held_{};  ///< name of each held key when it was pressed
    std::array<GLFWcursor*, 5> cursors_{};       ///< created on first use; glfwTerminate() frees them
    Cursor cursor_ = Cursor::Arrow;
    bool shown_ = false;
};

GlfwWindow::GlfwWindow(glm::ivec2 size) : window_(open_hidden(size)) {
    glfwSwapInterval(1);
    listen();
    listen_to_input();
}

void GlfwWindow::listen() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetWindowSizeCallback(window_, [](GLFWwindow* w, int width, int height) {
        if (width > 0 && height > 0) of(w).report_size();
    });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { of(w).report_size(); });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* w, float, float) { of(w).report_size(); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
        of(w).pending_.emplace_back(Focus{focused == GLFW_TRUE});
    });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);  // the program decides
        of(w).pending_.emplace_back(CloseRequest{});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        of(w).pending_.emplace_back(Drop{std::vector<std::string>(paths, paths + count)});
    });
}

void GlfwWindow::listen_to_input() {
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        of(w).pending_.emplace_back(MouseMove{glm::vec2(x, y)});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
        if (x != 0.0 || y != 0.0)
            of(w).pending_.emplace_back(MouseWheel{static_cast<float>(y), static_cast<float>(x)});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int) {
        const MouseButton name = button == GLFW_MOUSE_BUTTON_RIGHT    ? MouseButton::Right
                                 : button == GLFW_MOUSE_BUTTON_MIDDLE ? MouseButton::Middle
                                                                      : MouseButton::Left;
        if (button <= GLFW_MOUSE_BUTTON_MIDDLE) {
            of(w).pending_.emplace_back(MousePress{name, action == GLFW_PRESS});
        }
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int) {
        of(w).on_key(key, scancode, action);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned codepoint) { of(w).on_text(codepoint); });
}

void GlfwWindow::on_key(int key, int scancode, int action) {
    if (key < 0 || key > GLFW_KEY_LAST) return;
    Key& held = held_[static_cast<std::size_t>(key)];
    // Release a key by the name of its press, even if the layout has changed in between.
    const Key name = action == GLFW_PRESS ? translated_key(key, scancode) : held;
    if (name == Key::Unknown) return;
    const bool down = action != GLFW_RELEASE;
    // Left and right modifiers are one key: down with the first, up with the last.
    const auto others = std::count(held_.begin(), held_.end(), name) - (held == name ? 1 : 0);
    held = down ? name : Key::Unknown;
    const bool modifier = name == Key::Shift || name == Key::Ctrl || name == Key::Alt || name == Key::Super;
    if (modifier && (others > 0 || action == GLFW_REPEAT)) return;
    pending_.emplace_back(KeyChange{name, down});
}

void GlfwWindow::on_text(unsigned codepoint) {
    pending_.emplace_back(TextInput{utf8(codepoint)});
    // The question mark's position and modifiers depend on the layout, so take it from the text.
    if (codepoint == U'?') {
        pending_.emplace_back(KeyChange{Key::Question, true});
        pending_.emplace_back(KeyChange{Key::Question, false});
    }
}

/// Appends an event, merging consecutive moves, resizes and wheel turns.
void append(std::vector<Event>& events, Event&& event) {
    if (!events.empty()) {
        Event& last = events.back();
        const bool move = std::holds_alternative<MouseMove>(event) && std::holds_alternative<MouseMove>(last);
        const bool resize = std::holds_alternative<Resize>(event) && std::holds_alternative<Resize>(last);
        if (move || resize) {
            last = std::move(event);
            return;
        }
        auto* const wheel = std::get_if<MouseWheel>(&event);
        auto* const before = std::get_if<MouseWheel>(&last);
        if (wheel != nullptr && before != nullptr) {
            before->by += wheel->by;
            before->sideways += wheel->sideways;
            return;
        }
    }
    events.push_back(std::move(event));
}

void GlfwWindow::poll(std::vector<Event>& events, double seconds) {
    // Events that arrived while a frame was shown must not wait.
    if (pending_.empty() && seconds > 0.0) {
        glfwWaitEventsTimeout(seconds);
    } else {
        glfwPollEvents();
    }
    for (Event& event : pending_) append(events, std::move(event));
    pending_.clear();
}

void GlfwWindow::present() {
    glfwSwapBuffers(window_);
    if (!shown_) {
        glfwShowWindow(window_);
        shown_ = true;
        report_size();  // the picture drawn while hidden may not be on the screen
    }
}

void GlfwWindow::set_cursor(Cursor cursor) {
    if (cursor == cursor_) return;
    cursor_ = cursor;
    GLFWcursor*& shape = cursors_.at(static_cast<std::size_t>(cursor));
    if (shape == nullptr) shape = glfwCreateStandardCursor(cursor_shape(cursor));
    glfwSetCursor(window_, shape);  // null is the arrow
}

}  // namespace

std::unique_ptr<Window> open_glfw_window(glm::ivec2 size) {
    return std::make_unique<GlfwWindow>(size);
}

std::unique_ptr<Window> open_hidden_window(glm::ivec2 size) {
    return std::make_unique<OffscreenWindow<HiddenContext>>(size);
}

}  // namespace tendril::app
