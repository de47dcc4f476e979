#include "tests/app/support/full_scenes.hpp"

#include <tendril/signal/filter.hpp>

#include "app/io/json_complete.hpp"
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

/// The names of the lab's presets.
std::vector<std::string> presets_of(const Lab& lab) {
    CommandTable table;
    lab.add_commands(table);
    if (const Command* preset = table.find(lab.name() + ".preset"))
        for (const Argument& argument : preset->arguments)
            if (argument.name == "name") return argument.choices;
    return {};
}
CommandCall preset_call(const Lab& lab, const std::string& name) {
    return {lab.name() + ".preset", {{"name", name}}};
}

/// Paths of files begin with "tests/", at the top of the project.
void add_commands_of(const Json& scene, std::vector<CommandCall>& commands) {
    for (const Json& line : scene.at("commands")) {
        if (line.contains("rows")) {  // one command for each row of a file
            for (const Json& row : read_json_file(source_path(line.at("rows")))) {
                CommandCall& made = commands.emplace_back(CommandCall{line.at("command")});
                for (const auto& [name, value] : row.items())
                    made.arguments.push_back({name, SharedJson(value)});
            }
            continue;
        }
        CommandCall& made = commands.emplace_back(CommandCall{line.at("command")});
        for (const auto& [name, value] : line.items())
            if (value.is_string() && value.get_ref<const std::string&>().starts_with("tests/"))
                made.arguments.push_back({name, source_path(value)});
            else if (name != "command")
                made.arguments.push_back({name, SharedJson(value)});
    }
}

/// The lab's scenes: its opening, its test scenes, and every preset.
std::vector<Shown> scenes_of(const Lab& lab) {
    std::vector<Shown> all{{"as it opens", lab.opening()}};
    for (const TestScene& scene : test_scenes(lab)) all.push_back({scene.name, scene.commands});
    for (const std::string& name : presets_of(lab))
        all.push_back({"preset " + name, {preset_call(lab, name)}});
    return all;
}

/// A scene for every kind of object of a lab that can be selected.
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
        add_commands_of(scene, shown.commands);
        all.push_back(std::move(shown));
    }
    return all;
}

}  // namespace

std::vector<TestScene> test_scenes(const Lab& lab) {
    std::vector<TestScene> all;
    const Json file = read_json_file(source_path("tests/app/data/test_scenes.json"));
    if (!file.contains(lab.name())) return all;
    const std::vector<std::string> words = file[lab.name()].at("words");
    for (const Json& scene : file[lab.name()].at("scenes"))
        if (scene.contains("presets"))
            for (const std::string& name : presets_of(lab))
                all.push_back({name, {preset_call(lab, name)}, words});
        else
            add_commands_of(scene, all.emplace_back(TestScene{scene.at("name"), {}, words}).commands);
    return all;
}

std::vector<Shown> all_scenes(const Lab& lab) {
    std::vector<Shown> all = scenes_of(lab);
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
