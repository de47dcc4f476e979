#include "app/labs/kit/setting.hpp"

#include <algorithm>

#include "app/document/command.hpp"

namespace tendril::app {

std::size_t LabSetting::chosen(const Settings& settings) const {
    const auto kept = settings.choices.find(key);
    if (kept == settings.choices.end()) return 0;
    const auto choice = std::find_if(choices.begin(), choices.end(),
                                     [&](const Choice& each) { return each.name == kept->second; });
    return choice == choices.end() ? 0 : static_cast<std::size_t>(choice - choices.begin());
}

Command setting_command(const LabSetting& setting) {
    std::vector<std::string> names;
    for (const LabSetting::Choice& choice : setting.choices) names.push_back(choice.name);
    const char* const otherwise =
        names.size() == 2 ? "if omitted, the other one" : "if omitted, the next one";
    return {.name = setting.command,
            .title = setting.title,
            .arguments = {{.name = setting.argument,
                           .type = ArgumentType::Text,
                           .required = false,
                           .help = otherwise,
                           .choices = names,
                           .present =
                               [setting](const Workspace& w) {
                                   return setting.choices[setting.chosen(w.settings)].name;
                               }}},
            .help = setting.help,
            .effect = Effect::Look,
            .apply = [setting](Workspace& w, const Arguments& given) {
                const std::size_t next = (setting.chosen(w.settings) + 1) % setting.choices.size();
                w.settings.choices[setting.key] = given.has(setting.argument.c_str())
                                                      ? given.text(setting.argument.c_str())
                                                      : setting.choices[next].name;
            }};
}

}  // namespace tendril::app
