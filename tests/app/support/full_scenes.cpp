#include "tests/app/support/full_scenes.hpp"

#include <tendril/signal/filter.hpp>

#include "app/document/json_complete.hpp"
#include "tests/places.hpp"

namespace tendril::test {

using namespace app;

CommandCall call(const char* name, ArgumentList arguments) {
    return {name, std::move(arguments)};
}

std::vector<CommandCall> bones_and_a_control() {
    const SharedJson above(Json{{"translation", {0.0, 0.3, 0.0}}});
    return {call("rig.clear"), call("rig.element.add", {{"name", "a"}}),
            call("rig.element.add", {{"name", "b"}, {"parent", "a"}, {"local", above}}),
            call("rig.element.add", {{"name", "c"}, {"parent", "b"}, {"local", above}}),
            call("rig.element.add", {{"name", "look"}, {"kind", "control"}, {"control", "position"}})};
}

namespace {

/// The lab's scenes: its opening, its test scenes, and every preset.
std::vector<Shown> scenes_of(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all{{"as it opens", lab.opening()}};
    for (const TestScene& scene : lab.test_scenes()) all.push_back({scene.name, scene.commands});
    if (const Command* preset = table.find(lab.name() + ".preset"))
        for (const Argument& argument : preset->arguments)
            if (argument.name == "name")
                for (const std::string& name : argument.choices)
                    all.push_back({"preset " + name, {call(preset->name.c_str(), {{"name", name}})}});
    return all;
}

/// A scene for every kind of object of a lab that can be selected; paths begin at the top of the project.
std::vector<Shown> full_scenes(const std::string& lab) {
    std::vector<Shown> all;
    if (lab == "signal")
        for (const signal::Kind& kind : signal::kinds())
            all.push_back({kind.name,
                           {call("signal.clear"), call("signal.filter.add", {{"kind", kind.name}}),
                            call("signal.select", {{"at", 0}})}});
    const Json file = read_json_file(source_path("tests/app/data/full_scenes.json"));
    for (const Json& scene : file.value(lab, Json::array())) {
        Shown shown{scene.at("name"), {}, scene.value("ticks", Shown().ticks)};
        if (lab == "rig") shown.commands = bones_and_a_control();
        for (const Json& line : scene.at("commands")) {
            CommandCall& made = shown.commands.emplace_back(CommandCall{line.at("command")});
            for (const auto& [name, value] : line.items())
                if (name == "path")
                    made.arguments.push_back({name, source_path(value)});
                else if (name != "command")
                    made.arguments.push_back({name, SharedJson(value)});
        }
        all.push_back(std::move(shown));
    }
    return all;
}

}  // namespace

std::vector<Shown> all_scenes(const Lab& lab, const CommandTable& table) {
    std::vector<Shown> all = scenes_of(lab, table);
    for (Shown& each : full_scenes(lab.name())) all.push_back(std::move(each));
    std::set<std::string> seen;
    std::erase_if(all, [&](const Shown& shown) {
        Json json = shown.ticks;
        for (const CommandCall& each : shown.commands) json = {json, each.name, to_json(each.arguments)};
        return !seen.insert(json.dump()).second;
    });
    return all;
}

}  // namespace tendril::test
