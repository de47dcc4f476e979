// Shared by tests of labs in the running program: real events, with picking.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/app/e2e/monkey.hpp"
#include "tests/says.hpp"

namespace tendril::app {

class LabAppTest : public testing::Test {
  protected:
    explicit LabAppTest(const char* lab, bool paused = true, glm::ivec2 size = {1280, 720},
                        Labs labs = Labs())
        : window_(open_offscreen(size)), app_(*window_, false, std::move(labs)) {
        run("lab.open", {{"name", lab}});
        if (paused) run("time.pause");
    }
    void run(const char* command, Json arguments = Json::object()) {
        app_.run({command, std::move(arguments)});
    }
    void send(const Event& event) { app_.tick(&event); }
    void wait(int ticks) {
        for (int i = 0; i < ticks; ++i) app_.tick(nullptr);
    }
    void press(bool down) { send(MousePress{MouseButton::Left, down}); }
    void click(glm::vec2 at, int ticks_after = 0) {
        drag(at, {});
        wait(ticks_after);
    }
    /// Each a key's name, or a text.
    void type(const std::vector<const char*>& keys) {
        for (const char* const each : keys) {
            if (const auto chord = chord_from_name(each))
                send(KeyTap{*chord});
            else
                send(TextInput{each});
            wait(3);
        }
    }
    /// To each of these offsets.
    void drag(glm::vec2 from, const std::vector<glm::vec2>& way, bool drop = true) {
        send(MouseMove{from});
        press(true);
        for (const glm::vec2 by : way) send(MouseMove{from + by});
        if (drop) press(false);
    }
    /// Evenly, in ten moves.
    void drag_by(glm::vec2 from, glm::vec2 by) {
        std::vector<glm::vec2> way;
        for (int i = 1; i <= 10; ++i) way.push_back(0.1f * static_cast<float>(i) * by);
        drag(from, way);
    }
    glm::vec2 at(const std::string& name) { return test::handle(app_.state(), name); }
    std::size_t steps() { return app_.workspace().history.size(); }

    std::unique_ptr<Window> window_;
    App app_;
};

}  // namespace tendril::app
