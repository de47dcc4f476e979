#include "tests/app/e2e/monkey.hpp"

namespace tendril::test {

std::vector<std::string> lab_commands(const App& app) {
    CommandTable table;
    for (const auto& lab : app.labs().all()) lab->add_commands(table);
    std::vector<std::string> names;
    for (const Command& command : table.all()) names.push_back(command.name);
    return names;
}

void Monkey::command() {
    const std::string& name = one_of(names_);
    if (name.ends_with(".clear") && below(6) != 0) return;
    Json arguments = Json::object();
    for (const Argument& argument : app_.commands().find(name)->arguments) {
        if (!argument.required && coin()) continue;
        if (!careful_ && below(20) == 0) continue;
        switch (argument.type) {
            case ArgumentType::Number:
                arguments[argument.name] = careful_ ? Json(number_in(argument)) : any_number();
                break;
            case ArgumentType::Integer:
                arguments[argument.name] = careful_ ? Json(std::lround(number_in(argument))) : any_index();
                break;
            case ArgumentType::Boolean:
                arguments[argument.name] = coin();
                break;
            case ArgumentType::NumberOrPoint:
                arguments[argument.name] = coin() ? any_number() : any_point();
                break;
            case ArgumentType::Rotation:
            case ArgumentType::Point:
                arguments[argument.name] = any_point();
                break;
            case ArgumentType::List:
            case ArgumentType::ListOrText:
                arguments[argument.name] = any_list();
                break;
            case ArgumentType::Any:
                arguments[argument.name] = any_json();
                break;
            case ArgumentType::Text:
                arguments[argument.name] =
                    careful_ ? name_for(argument)
                             : one_of(argument.choices.empty() || below(8) == 0 ? words_ : argument.choices);
                break;
        }
    }
    try {
        app_.run({name, arguments});
    } catch (const Refused& refusal) {
        EXPECT_STRNE(refusal.what(), "");
    }
}

}  // namespace tendril::test
