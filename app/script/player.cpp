#include "app/script/player.hpp"

#include "app/document/json_complete.hpp"
#include "app/document/refused.hpp"

namespace tendril::app {
namespace {

std::string at_line(const ScriptLine& line, const std::string& text) {
    return "line " + std::to_string(line.number) + ": " + text;
}

/// Runs a command that is to be accepted, or one that is to be refused.
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

}  // namespace

bool Player::play(const ScriptLine& line, Stage& stage) {
    if (const auto* event = std::get_if<Event>(&line.action)) {
        stage.tick(event);
        return true;
    }
    if (const auto* wait = std::get_if<Wait>(&line.action)) {
        waiting_ = wait->ticks;
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
            if (waiting_ > 0) {
                --waiting_;
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
