// The arguments of every command of every lab.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/io/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

/// Values of other types, and beyond each end of the range.
std::vector<app::Json> wrong_values(const app::Argument& argument) {
    using app::Json;
    using enum app::ArgumentType;
    const double nan = std::nan(""), inf = HUGE_VAL;
    const std::vector<Json> points{Json::array({1, 2}), Json::array({1, 2, "3"}), Json::array({nan, 0, 0}),
                                   Json::array({0, 2e9, 0}), Json::array({0, nullptr, 0})};
    std::vector<Json> numbers{nan, inf, -inf, 1e300, true, "1"};
    if (argument.low > -1e9) numbers.emplace_back(argument.low - 1.0);
    if (argument.high < 1e9) numbers.emplace_back(argument.high + 1.0);
    std::vector<Json> all{nullptr, Json::object()};
    const auto add = [&](const std::vector<Json>& more) { all.insert(all.end(), more.begin(), more.end()); };
    switch (argument.type) {
        case Integer:
            add({1.5, Json::array()});
            [[fallthrough]];
        case Number:
            add(numbers);
            break;
        case NumberOrPoint:
            add(numbers);
            add(points);
            break;
        case Point:
            add(points);
            add({3, "up"});
            break;
        case Rotation:
            add({Json::array({0, 0, 0, 0}), Json::array({1}), "up"});
            break;
        case Boolean:
            add({1, "yes"});
            break;
        case Text:
            add({1, Json::array()});
            if (argument.name != "path") all.emplace_back("\xFF");
            if (!argument.choices.empty()) all.emplace_back("no such choice");
            break;
        case List:
            add({1, "x"});
            break;
        case ListOrText:
            add({1, true});
            break;
        case Any:
            return {};
    }
    return all;
}

TEST(EveryArgument, OfAnotherTypeOrOutOfRangeIsRefusedByName) {
    const app::Labs labs;
    const app::CommandTable table = make_command_table(labs);
    for (const app::Command& command : table.all())
        for (const app::Argument& argument : command.arguments)
            for (const app::Json& value : wrong_values(argument)) {
                try {
                    check_arguments(command, {{argument.name, value}});
                    ADD_FAILURE() << command.name << " took " << argument.name << " " << value;
                } catch (const app::Refused& refusal) {
                    EXPECT_TRUE(says(refusal.what(), command.name + " " + argument.name)) << value;
                }
            }
}

}  // namespace
}  // namespace tendril::test
