#include "app/script/script.hpp"

#include <array>
#include <initializer_list>
#include <stdexcept>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"

namespace tendril::app {
namespace {

[[noreturn]] void fail(const std::string& reason) {
    throw std::runtime_error(reason);
}

std::string nonempty_text(const Json& line, const char* key) {
    std::string text = json_text(json_member(line, key, ""), key);
    if (text.empty()) fail(std::string(key) + ": expected text, found \"\"");
    return text;
}

glm::ivec2 window_size(const Json& json, const std::string& where) {
    if (!json.is_array() || json.size() != 2)
        fail(where + ": expected [width, height], found " + json_summary(json));
    return {json_integer(json[0], where, 1, max_window_side),
            json_integer(json[1], where, 1, max_window_side)};
}

Action command_line(Json line, const CommandTable& commands) {
    RunCommand run{nonempty_text(line, "command"), Json::object(), false};
    if (!commands.find(run.name)) fail("unknown command " + json_summary(line["command"]));
    if (line.contains("refused")) run.expect_refusal = json_bool(line["refused"], "refused");
    line.erase("command");
    line.erase("refused");
    run.arguments = std::move(line);
    return run;
}

MouseButton mouse_button(const Json& line) {
    const Json& name = json_member(line, "button", "");
    for (const MouseButton each : {MouseButton::Left, MouseButton::Right, MouseButton::Middle})
        if (name == button_name(each)) return each;
    fail("button: expected \"left\", \"right\" or \"middle\", found " + json_summary(name));
}

glm::vec2 pixels(const Json& json, const std::string& where) {
    if (!json.is_array() || json.size() != 2) fail(where + ": expected [x, y], found " + json_summary(json));
    return {json_number(json[0], where), json_number(json[1], where)};
}

Action mouse_line(const Json& line) {
    const std::string what = json_text(line["mouse"], "mouse");
    if (what == "move" && line.contains("to")) {
        check_members(line, {"mouse", "to", "offset"});
        MoveToHandle move{nonempty_text(line, "to")};
        if (line.contains("offset")) move.offset = pixels(line["offset"], "offset");
        return move;
    }
    if (what == "move") {
        check_members(line, {"mouse", "at"});
        return Event(MouseMove{pixels(json_member(line, "at", ""), "at")});
    }
    if (what == "down" || what == "up") {
        check_members(line, {"mouse", "button"});
        return Event(MousePress{mouse_button(line), what == "down"});
    }
    if (what == "wheel") {
        check_members(line, {"mouse", "by", "sideways"});
        const float sideways = line.contains("sideways") ? json_number(line["sideways"], "sideways") : 0.0f;
        return Event(MouseWheel{json_number(json_member(line, "by", ""), "by"), sideways});
    }
    fail("mouse: expected \"move\", \"down\", \"up\" or \"wheel\", found " + json_summary(line["mouse"]));
}

Action key_line(const Json& line) {
    check_members(line, {"key", "action"});
    const std::string name = json_text(line["key"], "key");
    if (!line.contains("action")) {
        const auto chord = chord_from_name(name);
        if (!chord) fail("unknown key " + json_summary(line["key"]));
        return Event(KeyTap{*chord});
    }
    const Json& action = line["action"];
    if (action != "down" && action != "up")
        fail("action: expected \"down\" or \"up\", found " + json_summary(action));
    const auto key = key_from_name(name);
    if (!key) fail("unknown key " + json_summary(line["key"]));
    return Event(KeyChange{*key, action == "down"});
}

Action text_line(const Json& line) {
    check_members(line, {"text"});
    return Event(TextInput{json_text(line["text"], "text")});
}

Action resize_line(const Json& line) {
    check_members(line, {"resize"});
    return Event(Resize{window_size(line["resize"], "resize")});
}

Action drop_line(const Json& line) {
    check_members(line, {"drop"});
    const Json& paths = line["drop"];
    if (!paths.is_array() || paths.empty())
        fail("drop: expected a list of paths, found " + json_summary(paths));
    Drop drop;
    for (const Json& path : paths) drop.paths.push_back(json_text(path, "drop"));
    return Event(std::move(drop));
}

Action focus_line(const Json& line) {
    check_members(line, {"focus"});
    return Event(Focus{json_bool(line["focus"], "focus")});
}

Action video_line(const Json& line) {
    check_members(line, {"video"});
    if (line["video"] != "end") fail("video: expected \"end\", found " + json_summary(line["video"]));
    return Event(VideoEnd{});
}

Action wait_line(const Json& line) {
    check_members(line, {"wait"});
    return Wait{json_integer(line["wait"], "wait", 0, max_wait_ticks)};
}

Action screenshot_line(const Json& line) {
    check_members(line, {"screenshot"});
    return TakeScreenshot{nonempty_text(line, "screenshot")};
}

Action state_line(const Json& line) {
    check_members(line, {"state"});
    return WriteState{nonempty_text(line, "state")};
}

Action expect_line(const Json& line) {
    return read_expectation(line);
}

RecordingStart recording_start(const Json& line) {
    const Json& version = line["recording"];
    if (version.is_number() && version.get<double>() > recording_version)
        fail("recording: version " + version.dump() + " is newer than this program, which reads " +
             std::to_string(recording_version));
    json_integer(version, "recording", 1, recording_version);
    check_members(line, {"recording", "version", "size", "lab", "scene", "settings", "path", "modified",
                         "scale", "live"});
    RecordingStart start{.version = json_text(json_member(line, "version", ""), "version"),
                         .size = window_size(json_member(line, "size", ""), "size"),
                         .lab = json_text(json_member(line, "lab", ""), "lab"),
                         .scene = json_member(line, "scene", ""),
                         .settings = json_member(line, "settings", "")};
    if (!start.scene->is_object()) fail("scene: expected an object, found " + json_summary(start.scene));
    if (!start.settings->is_object())
        fail("settings: expected an object, found " + json_summary(start.settings));
    if (line.contains("path")) start.path = json_text(line["path"], "path");
    if (line.contains("modified")) start.modified = json_bool(line["modified"], "modified");
    if (line.contains("scale")) start.scale = json_number(line["scale"], "scale", 0.25f, 8.0f);
    if (line.contains("live")) start.live = json_bool(line["live"], "live");
    return start;
}

struct Form {
    const char* member;  ///< identifies the line's form
    Action (*parse)(const Json& line);
};
constexpr std::array<Form, 11> forms{{{"expect", expect_line},
                                      {"mouse", mouse_line},
                                      {"key", key_line},
                                      {"text", text_line},
                                      {"resize", resize_line},
                                      {"drop", drop_line},
                                      {"focus", focus_line},
                                      {"video", video_line},
                                      {"wait", wait_line},
                                      {"screenshot", screenshot_line},
                                      {"state", state_line}}};

Action parse_action(const Json& line, const CommandTable& commands) {
    // Check this first, because a command's arguments may have any name.
    if (line.contains("command")) return command_line(line, commands);
    for (const Form& form : forms)
        if (line.contains(form.member)) return form.parse(line);
    if (line.contains("recording")) fail("a recording's start must be the first line");
    std::string known = "\"command\"";
    for (const Form& form : forms) known += std::string(", \"") + form.member + '"';
    fail("expected one of the members " + known);
}

void parse_line(std::string_view text, int line_number, const CommandTable& commands, Script& script) {
    const Json line = parse_json(text);
    if (!line.is_object()) fail("expected an object, found " + json_summary(line));
    const bool first = !script.start && script.lines.empty();
    if (first && line.contains("recording") && !line.contains("command"))
        (script.start = recording_start(line))->line = line_number;
    else
        script.lines.push_back({line_number, parse_action(line, commands)});
}

}  // namespace

Script parse_script(std::string_view text, const CommandTable& commands) {
    Script script;
    for (int line_number = 1; !text.empty(); ++line_number) {
        const auto end = text.find('\n');
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        if (line.find_first_not_of(" \t\r") == line.npos) continue;
        try {
            parse_line(line, line_number, commands, script);
        } catch (const ParseError& error) {
            throw ParseError(line_number, error.reason);
        } catch (const std::runtime_error& error) {
            throw ParseError(line_number, error.what());
        }
    }
    return script;
}

}  // namespace tendril::app
