// A script is refused with a std::runtime_error, or all of it can be used: its events are written as they
// were read, its commands run or are refused, and its expectations give an answer.
#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "app/script/recorder.hpp"
#include "app/script/script.hpp"
#include "tests/fuzz/check.hpp"

using namespace tendril::app;
using tendril::fuzz::check;

namespace {

void use(const Event& event, const CommandTable& commands) {
    const Json line = event_line(event);
    check(!line.is_null(), "an event that was read leaves a line");
    const Script again = parse_script(line.dump(), commands);
    check(event_line(std::get<Event>(again.lines.at(0).action)) == line,
          "an event is written as it was read");
}

void use(const RunCommand& command, Workspace& workspace, const CommandTable& commands) {
    if (command.name.starts_with("scene.")) return;  // these touch files
    const Document before = workspace.document;
    try {
        commands.run(workspace, command.name, command.arguments);
    } catch (const Refused&) {
        check(workspace.document == before, "a refused command changes nothing");
    }
}

}  // namespace

FUZZ_TARGET(script) {
    static const Labs labs;
    static const CommandTable commands = make_command_table(labs);
    Script script;
    try {
        script = parse_script(text, commands);
    } catch (const std::runtime_error&) {
        return;
    }
    Workspace workspace = make_blank_workspace(labs);
    for (const ScriptLine& line : script.lines) {
        if (const auto* event = std::get_if<Event>(&line.action)) use(*event, commands);
        if (const auto* command = std::get_if<RunCommand>(&line.action)) use(*command, workspace, commands);
        if (const auto* expect = std::get_if<Expect>(&line.action)) {
            const Lab* lab = labs.find(workspace.lab);
            check(lab != nullptr, "there is always a lab");
            check_expectation(*expect, lab->state(workspace));
        }
    }
}
