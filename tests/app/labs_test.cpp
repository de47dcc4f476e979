// A lab is one folder and one line in the table: nothing outside the folder may know its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/document/json_complete.hpp"
#include "app/labs/labs.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

namespace fs = std::filesystem;

/// The string literals of a source, and its includes.
std::vector<std::string> literals_in(const std::string& source) {
    static const std::regex comment("//[^\n]*"), literal("\"((?:[^\"\\\\\n]|\\\\.)*)\"");
    const std::string code = std::regex_replace(source, comment, "");
    std::vector<std::string> found;
    for (std::sregex_iterator each(code.begin(), code.end(), literal), end; each != end; ++each)
        found.push_back((*each)[1]);
    return found;
}

struct LabNames {
    std::string lab;
    std::set<std::string> commands;
};

std::vector<LabNames> names_of_labs() {
    std::vector<LabNames> all;
    const app::Labs labs;
    for (const auto& lab : labs.all()) {
        app::CommandTable table;
        lab->add_commands(table);
        LabNames names{lab->name(), {}};
        for (const app::Command& command : table.all()) names.commands.insert(command.name);
        for (const app::LabSetting& setting : lab->all_settings()) names.commands.insert(setting.command);
        all.push_back(std::move(names));
    }
    return all;
}

/// Whether a literal is the lab's name, one of its commands, or a file in its folder.
bool names(const std::string& literal, const LabNames& lab) {
    return literal == lab.lab || literal.starts_with(lab.lab + ".") || lab.commands.contains(literal) ||
           literal.starts_with("app/labs/" + lab.lab + "/");
}

/// "rope" is also a kind of body in a rope world, and "rig" a step in a character's tick.
bool is_word_of_its_own(const std::string& path, const std::string& literal) {
    const bool hangs = path.starts_with("app/labs/kit/") || path.starts_with("app/labs/humanoid/");
    return (literal == "rope" && hangs) || (literal == "rig" && path == "app/labs/humanoid/state.cpp");
}

/// Exceptions: the table itself; the subcommands of the solvers, which belong to no lab; and the readers of
/// VRM files and of traces, which have a member with a lab's name.
bool may_name(const std::string& path, const std::string& lab) {
    return path == "app/labs/labs.cpp" || path.starts_with("app/labs/" + lab + "/") ||
           path.starts_with("app/batch/") || path == "app/io/character/gltf_vrm.cpp" ||
           path.starts_with("app/io/trace/");
}

TEST(LabsAreFolders, NothingOutsideALabNamesIt) {
    const std::vector<LabNames> labs = names_of_labs();
    const fs::path top = source_path("");
    int looked_at = 0, in_own_folder = 0;
    for (const auto& entry : fs::recursive_directory_iterator(top / "app")) {
        if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
        const std::string path = entry.path().lexically_relative(top).generic_string();
        for (const std::string& literal : literals_in(read(entry.path()))) {
            ++looked_at;
            for (const LabNames& lab : labs) {
                if (!names(literal, lab) || is_word_of_its_own(path, literal)) continue;
                if (path.starts_with("app/labs/" + lab.lab + "/")) ++in_own_folder;
                EXPECT_TRUE(may_name(path, lab.lab)) << path << " has \"" << literal << '"';
            }
        }
    }
    EXPECT_GT(looked_at, 1000);
    EXPECT_GT(in_own_folder, 100) << "names are found where they may stand";
}

TEST(LabsAreFolders, TheTableHasOneLinePerLab) {
    const fs::path top = source_path("");
    const std::string table = read(top / "app/labs/labs.cpp");
    const app::Labs labs;
    for (const auto& lab : labs.all()) {
        const std::regex line("add\\(std::make_unique<" + lab->title() + "Lab>\\(\\)\\);");
        EXPECT_EQ(
            std::distance(std::sregex_iterator(table.begin(), table.end(), line), std::sregex_iterator()), 1)
            << lab->name();
        EXPECT_TRUE(fs::is_directory(top / "app/labs" / lab->name()));
    }
}

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
