#include "app/script/player.hpp"

#include <glm/common.hpp>

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"

namespace tendril::app {
namespace {

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
