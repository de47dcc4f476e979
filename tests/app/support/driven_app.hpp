// The program in an offscreen window, driven as a user drives it: the base of fixtures.
#pragma once

#include "tests/app/support/frame_record.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {

inline std::vector<std::string> names_of_labs() {
    std::vector<std::string> names;
    const app::Labs labs;
    for (const auto& lab : labs.all()) names.push_back(lab->name());
    return names;
}

class DrivenApp {
  protected:
    /// Pixels of the window.
    explicit DrivenApp(glm::ivec2 size) : window_(app::open_offscreen(size)) {}

    void run(const std::string& command, app::Json arguments = app::Json::object()) {
        app_.run({command, std::move(arguments)});
    }
    void take(const app::Event& event) { app_.tick(&event); }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) app_.tick(nullptr);
    }
    void key(const char* name) { take(app::KeyTap{*app::chord_from_name(name)}); }
    void type(const std::string& text) { take(app::TextInput{text}); }
    void click(glm::vec2 at) {
        take(app::MouseMove{at});
        take(app::MousePress{app::MouseButton::Left, true});
        take(app::MousePress{app::MouseButton::Left, false});
        wait(3);
    }
    /// The middle of a text on the screen, unless it is scrolled out of view.
    std::optional<glm::vec2> seen(const std::string& text) {
        wait(4);
        for (const DrawnText& each : recorder_.frame().texts)
            if (each.text == text && each.clip.contains(each.box.centre())) return each.box.centre();
        return std::nullopt;
    }
    /// The same; fails the test if there is none.
    glm::vec2 at(const std::string& text) {
        const auto found = seen(text);
        EXPECT_TRUE(found) << "nothing says " << text;
        return found.value_or(glm::vec2(0.0f));
    }
    app::Workspace& workspace() { return app_.workspace(); }

    std::unique_ptr<app::Window> window_;
    app::App app_{*window_};
    FrameRecorder recorder_;
};

}  // namespace tendril::test
