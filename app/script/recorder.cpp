#include "app/script/recorder.hpp"

#include <algorithm>
#include <glm/common.hpp>

#include "app/document/refused.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

/// One overload per event type, so that a missing one does not compile.
struct LineOf {
    Json operator()(const MouseMove& e) const { return {{"mouse", "move"}, {"at", pixel(e.at)}}; }
    Json operator()(const MousePress& e) const {
        return {{"mouse", e.down ? "down" : "up"}, {"button", button_name(e.button)}};
    }
    Json operator()(const MouseWheel& e) const {
        Json json{{"mouse", "wheel"}, {"by", number(e.by)}};
        if (e.sideways != 0.0f) json["sideways"] = number(e.sideways);
        return json;
    }
    Json operator()(const KeyChange& e) const {
        if (e.key == Key::Unknown) return nullptr;
        return {{"key", std::string(key_name(e.key))}, {"action", e.down ? "down" : "up"}};
    }
    Json operator()(const KeyTap& e) const {
        if (e.chord.key == Key::Unknown) return nullptr;
        return Json{{"key", chord_name(e.chord)}};
    }
    Json operator()(const TextInput& e) const { return Json{{"text", e.utf8}}; }
    Json operator()(const Resize& e) const { return Json{{"resize", Json::array({e.size.x, e.size.y})}}; }
    Json operator()(const Drop& e) const { return Json{{"drop", Json(e.paths)}}; }
    Json operator()(const Focus& e) const { return Json{{"focus", e.focused}}; }
    Json operator()(const CloseRequest&) const { return nullptr; }
    Json operator()(const VideoEnd&) const { return Json{{"video", "end"}}; }
};

/// File names need not be UTF-8, but JSON is.
std::string one_line(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string wait_lines(int ticks) {
    std::string text;
    for (; ticks > 0; ticks -= max_wait_ticks)
        text += one_line(Json{{"wait", std::min(ticks, max_wait_ticks)}});
    return text;
}

std::string at_line(const ScriptLine& line, const std::string& text) {
    return "line " + std::to_string(line.number) + ": " + text;
}

/// Runs a command; throws ScriptFailure if it is unexpectedly refused or accepted.
void run_command(const ScriptLine& line, const RunCommand& command, Stage& stage) {
    try {
        stage.run(command);
    } catch (const Refused& refusal) {
        if (command.expect_refusal) return;
        throw ScriptFailure(at_line(line, refusal.what()));
    }
    if (command.expect_refusal) {
        throw ScriptFailure(at_line(line, command.name + " was accepted, though a refusal was expected"));
    }
}

/// The handle's pixel in the state, plus the offset.
glm::vec2 pixel_of(const ScriptLine& line, const MoveToHandle& move, const Json& state) {
    if (const Json* handles = find_in_state(state, "handles"); handles && handles->is_array()) {
        for (const Json& each : *handles) {
            if (each.at("name") != move.handle || !each.at("pixel").is_array()) continue;
            const Json& at = each.at("pixel");
            // A handle beside the camera can project beyond the range of a recording.
            constexpr float farthest = 1e6f;
            return glm::clamp(glm::vec2(at[0].get<float>(), at[1].get<float>()) + move.offset, -farthest,
                              farthest);
        }
    }
    throw ScriptFailure(at_line(line, "no handle " + json_summary(Json(move.handle)) + " is in view"));
}

}  // namespace

Json event_line(const Event& event) {
    return std::visit(LineOf(), event);
}

Recorder::Recorder(const RecordingStart& start) {
    Json first{{"recording", recording_version},
               {"version", start.version},
               {"size", Json::array({start.size.x, start.size.y})},
               {"lab", start.lab},
               {"scene", start.scene},
               {"settings", start.settings}};
    if (!start.path.empty()) first["path"] = start.path;
    if (start.modified) first["modified"] = true;
    if (start.scale != 1.0f) first["scale"] = number(start.scale);
    if (start.live) first["live"] = true;
    line(first);
}

void Recorder::event(const Event& event) {
    const Json json = event_line(event);
    // The event still took a tick.
    if (json.is_null()) return idle_tick();
    line(json);
}

void Recorder::idle_tick() {
    ++idle_ticks_;
}

void Recorder::command(const std::string& name, const Json& arguments, bool refused) {
    Json json{{"command", name}};
    for (const auto& [key, value] : arguments.items()) json[key] = value;
    if (refused) json["refused"] = true;
    line(json);
}

std::string Recorder::text() const {
    return text_ + wait_lines(idle_ticks_);
}

void Recorder::flush_wait() {
    text_ += wait_lines(idle_ticks_);
    idle_ticks_ = 0;
}

void Recorder::line(const Json& json) {
    flush_wait();
    text_ += one_line(json);
}

bool Player::play(const ScriptLine& line, Stage& stage) {
    if (const auto* event = std::get_if<Event>(&line.action)) {
        stage.tick(event);
        return true;
    }
    if (const auto* move = std::get_if<MoveToHandle>(&line.action)) {
        const Event event = MouseMove{pixel_of(line, *move, stage.state())};
        stage.tick(&event);
        return true;
    }
    if (const auto* wait = std::get_if<Wait>(&line.action)) {
        ticks_left_ = wait->ticks;
    } else if (const auto* command = std::get_if<RunCommand>(&line.action)) {
        run_command(line, *command, stage);
    } else if (const auto* screenshot = std::get_if<TakeScreenshot>(&line.action)) {
        stage.write_screenshot(screenshot->path);
    } else if (const auto* state = std::get_if<WriteState>(&line.action)) {
        stage.write_state(state->path);
    } else if (const auto* expect = std::get_if<Expect>(&line.action)) {
        const std::string found = check_expectation(*expect, stage.state());
        if (!found.empty()) throw ScriptFailure(at_line(line, found));
    }
    return false;
}

void Player::advance(Stage& stage) {
    try {
        while (!done()) {
            if (ticks_left_ > 0) {
                --ticks_left_;
                stage.tick(nullptr);
                return;
            }
            if (play(script_.lines[next_++], stage)) return;
        }
    } catch (...) {
        end();
        throw;
    }
}

}  // namespace tendril::app
