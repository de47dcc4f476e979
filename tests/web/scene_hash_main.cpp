// Prints the hash of every scene's state after ten seconds, one a line. Every system must print the same
// lines: .ci/nightly compares the browser's with this machine's. With the name of a scene, prints that state.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <string>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "tests/app/support/full_scenes.hpp"

namespace tendril::test {
namespace {

using namespace app;

constexpr int ticks = 600;

/// What the lab saves and what it tells.
std::string state_after(const Labs& labs, const CommandTable& table, const Lab& lab, const Shown& scene) {
    Workspace workspace = make_blank_workspace(labs);
    const auto run = [&](const std::string& name, const Json& arguments) {
        table.run(workspace, name, arguments);
        if (const auto& finish = table.find(name)->finish) finish(workspace);
    };
    run("lab.open", {{"name", lab.name()}});
    for (const CommandCall& each : scene.commands) run(each.name, to_json(each.arguments));
    for (int i = 0; i < ticks; ++i) {
        if (lab.moving(workspace)) lab.step(workspace);
        ++workspace.clock.tick;
        if (lab.working(workspace)) lab.work(workspace);
    }
    return workspace.document.parts().at(lab.name())->save().dump(1) + '\n' + lab.state(workspace).dump(1) +
           '\n';
}

/// FNV-1a (Fowler, Noll, Vo 1991).
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char each : text) hash = (hash ^ static_cast<unsigned char>(each)) * 0x100000001b3u;
    return hash;
}

void print(const std::string& wanted) {
    const Labs labs;
    const CommandTable table = make_command_table(labs);
    for (const auto& lab : labs.all())
        for (const Shown& scene : all_scenes(*lab)) {
            const std::string name = lab->name() + ": " + scene.name;
            if (!wanted.empty() && name != wanted) continue;
            const std::string state = state_after(labs, table, *lab, scene);
            if (wanted.empty())
                std::printf("%016" PRIx64 " %s\n", hash_of(state), name.c_str());
            else
                std::fputs(state.c_str(), stdout);
            std::fflush(stdout);
        }
}

}  // namespace
}  // namespace tendril::test

int main(int count, char** arguments) {
    tendril::test::print(count > 1 ? arguments[1] : "");
}
