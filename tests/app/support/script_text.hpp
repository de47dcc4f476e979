// Writes scripts line by line.
#pragma once

#include <vector>

#include "app/document/json_complete.hpp"

namespace tendril::test {

class ScriptText {
  public:
    using Json = app::Json;

    ScriptText& line(const Json& json) {
        text_ += json.dump() + "\n";
        return *this;
    }
    ScriptText& lines(const ScriptText& other) {
        text_ += other.text_;
        return *this;
    }
    ScriptText& command(const std::string& name, Json arguments = Json::object(), bool refused = false) {
        arguments["command"] = name;
        if (refused) arguments["refused"] = true;
        return line(arguments);
    }
    ScriptText& move(glm::vec2 at) { return line({{"mouse", "move"}, {"at", app::pixel(at)}}); }
    ScriptText& down(const char* button = "left") { return line({{"mouse", "down"}, {"button", button}}); }
    ScriptText& up(const char* button = "left") { return line({{"mouse", "up"}, {"button", button}}); }
    ScriptText& wheel(float by) { return line({{"mouse", "wheel"}, {"by", app::number(by)}}); }
    ScriptText& key(const char* name) { return line({{"key", name}}); }
    ScriptText& hold(const char* name) { return line({{"key", name}, {"action", "down"}}); }
    ScriptText& release(const char* name) { return line({{"key", name}, {"action", "up"}}); }
    ScriptText& text(const char* utf8) { return line({{"text", utf8}}); }
    ScriptText& wait(int ticks) { return line({{"wait", ticks}}); }
    ScriptText& click(glm::vec2 at) { return move(at).down().up(); }
    /// Button down at the first point, moved through the others, and up at the last.
    ScriptText& drag(const std::vector<glm::vec2>& points, const char* button = "left") {
        move(points.front()).down(button);
        for (std::size_t i = 1; i < points.size(); ++i) move(points[i]);
        return up(button);
    }

    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

}  // namespace tendril::test
