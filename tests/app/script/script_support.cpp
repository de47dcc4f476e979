#include "tests/app/script/script_support.hpp"

#include "app/document/command.hpp"

namespace tendril::test {
namespace {

app::CommandTable make_commands() {
    app::CommandTable table;
    for (const char* name : {"chain.add", "chain.mode", "undo"}) {
        app::Command command;
        command.name = name;
        command.apply = [](app::Workspace&, const app::Arguments&) {};
        table.add(std::move(command));
    }
    return table;
}

}  // namespace

app::Script parse(std::string_view text) {
    return app::parse_script(text, make_commands());
}

}  // namespace tendril::test
