// Titles of commands: each has one, in words that a user would search for.
#include "app/document/command.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/shell.hpp"
#include "app/shell/shortcuts.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using namespace app;

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

class CommandTitles : public testing::Test {
  protected:
    const Labs labs_;
    const CommandTable table_ = make_command_table(labs_);
};

TEST_F(CommandTitles, AreShortPhrasesThatSayMoreThanTheName) {
    ASSERT_GT(table_.all().size(), 150u);
    for (const Command& command : table_.all()) {
        const std::string& title = command.title;
        ASSERT_FALSE(title.empty()) << command.name;
        EXPECT_LE(title.size(), 40u) << title;
        EXPECT_NE(std::isupper(static_cast<unsigned char>(title.front())), 0) << title;
        EXPECT_NE(title.back(), '.') << title;
        std::istringstream words(title);
        const auto count = std::distance(std::istream_iterator<std::string>(words), {});
        EXPECT_TRUE(count >= 2 || command.name == "undo" || command.name == "redo" || command.name == "paste")
            << title;
        EXPECT_LE(count, 6) << title;
        if (count > 1) {
            EXPECT_NE(lower(title), command.name);
        }
        EXPECT_EQ(title.find_first_of("._[]"), title.npos) << title << " is syntax";
        EXPECT_NE(title, command.help) << command.name;
    }
}

// Two rows of a lab's and the program's commands must be distinguishable.
TEST_F(CommandTitles, AreUniqueInALabAndTheProgram) {
    for (const auto& lab : labs_.all()) {
        std::map<std::string, std::string> seen;
        for (const Command& command : table_.all()) {
            if (!command.lab.empty() && command.lab != lab->name()) continue;
            const auto [other, first] = seen.emplace(lower(command.title), command.name);
            EXPECT_TRUE(first) << command.name << " and " << other->second << ": " << command.title;
        }
    }
}

TEST_F(CommandTitles, AreGroupedByLab) {
    const auto lab_of = [&](const char* name) { return table_.find(name)->lab; };
    EXPECT_EQ(lab_of("undo"), "");
    EXPECT_EQ(lab_of("view.scroll"), "");
    EXPECT_EQ(lab_of("study.step"), "chain");
    EXPECT_EQ(lab_of("view.segments"), "chain");
    EXPECT_EQ(lab_of("rope.cut"), "rope");
    EXPECT_EQ(lab_of("view.character_bones"), "humanoid");
}

TEST_F(CommandTitles, NameTheChangeThatUndoReverts) {
    Workspace workspace = make_blank_workspace(labs_);
    workspace.lab = "chain";
    EXPECT_EQ(undo_title(table_, workspace.history), "Undo");
    table_.run(workspace, "chain.add", {{"length", 1}});
    EXPECT_EQ(undo_title(table_, workspace.history), "Undo: add a joint at the tip");
    table_.run(workspace, "undo", Json::object());
    EXPECT_EQ(undo_title(table_, workspace.history), "Undo");
    EXPECT_EQ(redo_title(table_, workspace.history), "Redo: add a joint at the tip");
}

// Menu, help and the README's list use the palette's titles, except shortcuts with arguments ("Save as...").
TEST_F(CommandTitles, AreTheMenusTitles) {
    const Shortcuts shortcuts(labs_, table_);
    std::set<std::string> plain;
    for (const Shortcut& row : shortcuts.all()) {
        ASSERT_FALSE(row.title.empty()) << row.command;
        if (row.arguments.empty()) {
            EXPECT_EQ(row.title, table_.find(row.command)->title);
            plain.insert(row.command);
        }
    }
    EXPECT_GT(plain.size(), 12u);
}

TEST_F(CommandTitles, AreListed) {
    const std::string list = run_program({"--list-commands"}).out;
    EXPECT_NE(list.find("\nchain.add length [position]\n    Add a joint at the tip\n    "), list.npos);
}

// Offers of the palette are valid: a choice of the command, or a name in the document.
TEST_F(CommandTitles, TheirArgumentsAcceptEveryOffer) {
    Workspace workspace = make_blank_workspace(labs_);
    table_.run(workspace, "rope.add", {{"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"name", "my rope"}});
    const auto known = [&](const char* command, const char* name) {
        const auto& arguments = table_.find(command)->arguments;
        const auto found = std::find_if(arguments.begin(), arguments.end(),
                                        [&](const Argument& each) { return each.name == name; });
        EXPECT_NE(found, arguments.end()) << command;
        EXPECT_TRUE(found->known) << command << " " << name;
        return found->known ? found->known(workspace) : std::vector<std::string>();
    };
    const auto has = [](const std::vector<std::string>& list, const std::string& name) {
        return std::find(list.begin(), list.end(), name) != list.end();
    };
    EXPECT_TRUE(has(known("rope.remove", "name"), "my rope"));
    EXPECT_TRUE(has(known("rope.cut", "rope"), "my rope"));
    EXPECT_EQ(known("lab.open", "name").size(), labs_.all().size());
    const auto nodes = known("humanoid.select", "node");
    ASSERT_FALSE(nodes.empty());
    table_.run(workspace, "humanoid.select", {{"node", nodes.back()}});
    table_.run(workspace, "signal.preset", {{"name", "spring"}});
    for (const std::string& place : known("signal.select", "at"))
        table_.run(workspace, "signal.select", {{"at", std::stoi(place)}});
    for (const std::string& place : known("chain.select", "index"))
        table_.run(workspace, "chain.select", {{"index", std::stoi(place)}});
    for (const std::string& name : known("rig.select", "element"))
        table_.run(workspace, "rig.select", {{"element", name}});
    for (const std::string& name : known("rig.select", "unit"))
        table_.run(workspace, "rig.select", {{"unit", name}});
    for (const std::string& name : known("rig.control.reset", "name"))
        table_.run(workspace, "rig.control.reset", {{"name", name}});
    for (const std::string& name : known("lab.open", "name"))
        table_.run(workspace, "lab.open", {{"name", name}});
}

// An argument's present value is one that it accepts.
TEST_F(CommandTitles, TheirArgumentsAcceptTheirPresentValue) {
    Workspace workspace = make_blank_workspace(labs_);
    int count = 0;
    for (const Command& command : table_.all())
        for (const Argument& argument : command.arguments) {
            if (!argument.present) continue;
            ++count;
            const std::string now = argument.present(workspace);
            const Json value =
                argument.type == ArgumentType::Text ? Json(now) : Json::parse(now, nullptr, false);
            Json given = Json::object();
            given[argument.name] = value;
            EXPECT_NO_THROW(table_.run(workspace, command.name, given)) << command.name << " " << now;
            EXPECT_EQ(argument.present(workspace), now) << command.name;
        }
    EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace tendril::test
