#include "app/labs/rig/presets.hpp"

#include "app/document/scene_file.hpp"
#include "app/io/json_complete.hpp"
#include "app/io/names.hpp"
#include "app/labs/rig/definition_json.hpp"
#include "app/view/assets.hpp"

namespace tendril::app {

const std::vector<RigPreset>& rig_presets() {
    static const std::vector<RigPreset> list = [] {
        std::vector<RigPreset> read;
        const Json json = parse_json(presets_source("rig"));
        JsonPlace(json, "presets").for_each("presets", 100, [&](const JsonPlace& each) {
            read.push_back({each["name"].text(), each["title"].text(), each["help"].text(),
                            read_definition(each), load_camera(each["view"].json(), "view")});
        });
        return read;
    }();
    return list;
}

const RigPreset& rig_preset(std::string_view name) {
    return named(
        rig_presets(), [](const RigPreset& each) { return each.name; }, name, "preset");
}

std::vector<CommandCall> rig_script(const char* name) {
    const Json all = parse_json(presets_source("rig"));
    std::vector<CommandCall> calls;
    for (const Json& line : all.front().at(name)) {
        calls.push_back({line.at("command"), {}});
        for (const auto& [key, value] : line.items())
            if (key != "command") calls.back().arguments.push_back({key, SharedJson(value)});
    }
    return calls;
}

}  // namespace tendril::app
