// The palette's results, offers and messages while a line is typed, without a window.
#include <random>

#include "app/document/command.hpp"
#include "app/io/text.hpp"
#include "app/labs/labs.hpp"
#include "app/shell/command_line.hpp"
#include "app/shell/shell.hpp"
#include "app/shell/shortcuts.hpp"
#include "tests/app/support/program.hpp"

namespace tendril::test {
namespace {

using Strings = std::vector<std::string>;
using namespace app;

class Completion : public testing::Test {
  protected:
    TypedLine read(const std::string& line) const { return read_typed_line(table_, line); }
    std::vector<CompletionRow> rows(const std::string& line) const {
        return completions(read(line), line, workspace_);
    }
    Strings texts(const std::string& line) const {
        Strings list;
        for (const CompletionRow& row : rows(line)) list.push_back(row.text);
        return list;
    }
    std::string tab(const std::string& line, std::size_t chosen = 0) const {
        return completed(read(line), line, rows(line), chosen);
    }
    std::string wrong(const std::string& line) const { return mistake(read(line)); }
    Strings names(const std::string& query, const char* lab = "", const Strings& recent = {}) const {
        Strings list;
        for (const Command* command : search_commands(table_, query, lab, recent))
            list.push_back(command->name);
        return list;
    }

    const Labs labs_;
    const CommandTable table_ = make_command_table(labs_);
    Workspace workspace_ = make_blank_workspace(labs_);
};

bool has(const Strings& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

TEST_F(Completion, FindsByPlainWordsFirst) {
    EXPECT_EQ(names("add joint", "chain").front(), "chain.add");
    EXPECT_EQ(names("ADD JOINT tip", "chain").front(), "chain.add");
    EXPECT_EQ(names("cut", "chain").front(), "rope.cut");
    // Words of the title rank before those of the name, and those before the help's.
    const Strings swings = names("swing", "rope");
    ASSERT_TRUE(has(swings, "rope.collider.swing"));
    EXPECT_EQ(swings.front(), "rope.collider.swing");
    // All words must match, in any order.
    EXPECT_TRUE(names("joint xyzzy").empty());
    EXPECT_EQ(names("tip at joint a add", "chain").front(), "chain.add");
}

TEST_F(Completion, FindsExactNamesAndThenTheOpenLabsOwn) {
    EXPECT_EQ(names("rope.clear", "chain").front(), "rope.clear");
    EXPECT_EQ(names("chain.remove", "rope").front(), "chain.remove");
    EXPECT_EQ(names("chain.add length=3").front(), "chain.add");
    for (const auto& lab : labs_.all()) {
        const std::string own = lab->name();
        if (table_.find(own + ".reset") != nullptr) {
            EXPECT_EQ(names("reset lab", own.c_str()).front(), own + ".reset");
        }
        const Strings all = names("", own.c_str());
        ASSERT_EQ(all.size(), table_.all().size());
        EXPECT_EQ(table_.find(all.front())->lab, own);
        EXPECT_FALSE(table_.find(all.back())->lab.empty());
        EXPECT_NE(table_.find(all.back())->lab, own);
    }
}

/// People usually mean adding a thing rather than changing it, and changing it rather than removing it.
TEST_F(Completion, RanksAddingBeforeChangingBeforeRemoving) {
    struct Query {
        const char *lab, *text;
        Strings first;
    };
    const Query queries[] = {
        {"chain", "joint", {"chain.add", "chain.insert"}},
        {"chain", "remove", {"chain.remove", "chain.clear"}},
        {"chain", "remove joint", {"chain.remove", "chain.clear"}},
        {"chain", "bone", {"chain.set_length"}},
        {"chain", "target", {"chain.target", "chain.motion"}},
        {"chain", "preset", {"chain.preset", "view.mouse"}},
        {"chain", "pole", {"chain.pole"}},
        {"chain", "seed", {"chain.preset"}},
        {"chain", "compare solvers", {"race.open"}},
        {"chain", "five things", {"view.card"}},
        {"rope", "rope", {"rope.add"}},
        {"rope", "cloth", {"rope.cloth.add"}},
        {"rope", "collider", {"rope.collider.add", "rope.collider.set"}},
        {"rope", "remove", {"rope.remove"}},
        {"rope", "friction", {"rope.settings"}},
        {"signal", "filter", {"signal.filter.add", "signal.filter.set"}},
        {"signal", "remove", {"signal.filter.remove"}},
        {"signal", "response", {"signal.fit"}},
        {"signal", "amplitude", {"signal.input"}},
        {"rig", "bone", {"rig.element.add"}},
        {"rig", "unit", {"rig.unit.add"}},
        {"rig", "control", {"rig.element.add", "rig.control.set"}},
        {"rig", "curve", {"rig.curve.add"}},
        {"humanoid", "character", {"humanoid.load"}},
        {"humanoid", "rope", {"humanoid.attach"}},
        {"humanoid", "bone map", {"humanoid.map", "humanoid.map.save"}},
        {"humanoid", "view_deg", {"humanoid.hand_ik", "humanoid.look_at"}},
    };
    for (const Query& query : queries) {
        Strings found = names(query.text, query.lab);
        found.resize(std::min(found.size(), query.first.size()));
        EXPECT_EQ(found, query.first) << query.text << " in " << query.lab;
    }
}

TEST_F(Completion, RanksMatchesInTheHelpAloneAfterOtherLabs) {
    const Strings pins = names("pin", "chain");  // "pinch" is in the help of view.scroll
    EXPECT_LT(std::ranges::find(pins, "rope.pin"), std::ranges::find(pins, "view.scroll"));
    EXPECT_TRUE(has(pins, "view.scroll"));
}

TEST_F(Completion, FindsByArgumentsAfterTitleAndHelp) {
    for (const auto& lab : labs_.all())
        for (const char* word : {"radius", "weight", "length", "speed"}) {
            bool by_argument = false;
            for (const Command* command : search_commands(table_, word, lab->name())) {
                if (command->lab != lab->name()) continue;
                const std::string told = lower_case(command->title + command->name + command->help);
                const bool says_it = told.find(word) != std::string::npos;
                EXPECT_TRUE(!says_it || !by_argument) << word << ": " << command->name;
                by_argument = by_argument || !says_it;
            }
            const Strings all = names(word, lab->name().c_str());
            for (const Command& command : table_.all()) {
                if (find_argument(command, word) == nullptr) continue;
                EXPECT_TRUE(has(all, command.name)) << command.name;
            }
        }
    EXPECT_TRUE(has(names("add radius", "rope"), "rope.cloth.add"));
}

TEST_F(Completion, BeginsWithTheLastRunCommands) {
    const Strings recent{"rope.cut", "undo"};
    const Strings all = names("", "chain", recent);
    EXPECT_EQ((Strings{all[0], all[1]}), recent);
    EXPECT_EQ(all.size(), table_.all().size());
    EXPECT_NE(names("chain", "chain", recent).front(), "undo") << "only where nothing is typed";
}

TEST_F(Completion, CompletionBeginsAfterACommandsName) {
    EXPECT_TRUE(rows("chain.mode").empty()) << "it may become another's";
    EXPECT_TRUE(rows("add a ").empty());
    EXPECT_EQ(texts("chain.add "), (Strings{"length=", "position="})) << "required ones first";
    EXPECT_EQ(texts("chain.insert position=[0,1,0] "), (Strings{"index=", "length=", "position=[0,1,0]"}));
    EXPECT_TRUE(rows("chain.insert position=[0,1,0] ").back().given);
    EXPECT_EQ(texts("chain.mode i"), (Strings{"index=", "iterations="}));
    EXPECT_EQ(texts("chain.mode er"), (Strings{"iterations=", "tolerance="})) << "in the middle too";
    EXPECT_EQ(rows("chain.add ").front().detail, "a number, at least 0")
        << "its type and range, as it is checked";
}

TEST_F(Completion, OffersTheValuesOfAnArgument) {
    EXPECT_EQ(texts("chain.mode mode=f"), (Strings{"forward", "fixed"}));
    EXPECT_EQ(texts("chain.mode mode=ward"), (Strings{"forward", "backward"}));
    EXPECT_EQ(texts("race.solver on="), (Strings{"true", "false"}));
    EXPECT_EQ(rows("chain.mode mode=re").front().line, "chain.mode mode=reach ");
    table_.run(workspace_, "rope.add", {{"from", {0, 1, 0}}, {"to", {1, 1, 0}}, {"name", "rope \"9\""}});
    EXPECT_TRUE(has(texts("rope.remove name="), "rope \"9\""));
    const std::string line = rows("rope.remove name=\"rope").back().line;
    EXPECT_EQ(read_typed_command(line).arguments->at("name"), "rope \"9\"") << line;
    for (const CompletionRow& row : rows("view.theme name="))
        EXPECT_EQ(row.detail, row.text == "dark" ? "now" : "");
    EXPECT_EQ(texts("time.speed factor="), (Strings{"1.0"})) << "what it is now";
    table_.run(workspace_, "chain.preset", {{"name", "coil"}, {"count", 5000}});
    EXPECT_EQ(rows("chain.select index=").size(), max_rows);
    EXPECT_TRUE(has(texts("chain.select index=4999"), "4999"));
}

TEST_F(Completion, QuotesTextThatWouldBeReadDifferently) {
    for (const char* name :
         {"arm", "my rope", "12", "true", "[1]", "a\"b", "", "\xC3\xA4 \xE2\x82\xAC", "a=b", "\\"}) {
        const auto typed = read_typed_command("rope.remove name=" + quoted(name) + " ");
        EXPECT_EQ(typed.arguments->at("name"), name) << quoted(name);
    }
    EXPECT_EQ(quoted("arm"), "arm");
}

TEST_F(Completion, TabTakesTheCommonPrefixAndThenTheChosenRow) {
    EXPECT_EQ(tab("chain.limit l"), "chain.limit left_deg=");
    EXPECT_EQ(tab("chain.limit t"), "chain.limit twist_m");
    EXPECT_EQ(tab("chain.limit twist_m", 1), "chain.limit twist_max_deg=");
    EXPECT_EQ(tab("chain.add "), "chain.add length=");
    EXPECT_EQ(tab("chain.mode mode=re"), "chain.mode mode=reach ");
    EXPECT_EQ(tab("chain.preset name=s"), "chain.preset name=start ") << "nothing more in common: the row";
    EXPECT_EQ(tab("chain.mode xyz"), "chain.mode mode=") << "nothing has that: the row that is chosen";
    EXPECT_EQ(common_prefix({"a\xC3\xA4", "a\xC3\xB6"}), "a") << "not half a character";
    EXPECT_EQ(common_prefix({}), "");
}

TEST_F(Completion, NamesWithABlankKeepTheirQuote) {
    workspace_.open_lab("rope");
    for (const char* name : {"blue line", "blue rope"})
        table_.run(workspace_, "rope.add",
                   {{"name", name}, {"from", {0, 2, 0}}, {"to", {1, 2, 0}}, {"segments", 4}});
    const std::string begun = tab("rope.remove name=blu");
    EXPECT_EQ(begun, "rope.remove name=\"blue ");
    EXPECT_EQ(texts(begun), (Strings{"blue line", "blue rope"}));
    EXPECT_EQ(tab(begun + "r"), "rope.remove name=\"blue rope\" ");
    EXPECT_EQ(wrong(tab(begun + "r")), "");
}

TEST_F(Completion, OffersAListsElementsOneByOne) {
    table_.run(workspace_, "chain.preset", {{"name", "coil"}, {"count", 12}});
    EXPECT_EQ(rows("chain.select joints=").front().line, "chain.select joints=[0");
    EXPECT_EQ(texts("chain.select joints=[1"), (Strings{"]", ",", "1", "10", "11"}));
    EXPECT_EQ(tab("chain.select joints=[1"), "chain.select joints=[1] ");
    EXPECT_EQ(texts("chain.select joints=[10,1"), (Strings{"]", ",", "1", "11"})) << "what is not in it yet";
    EXPECT_EQ(tab("chain.select joints=[3, 1", 1), "chain.select joints=[3, 1,");
    EXPECT_TRUE(rows("chain.select joints=[1]").front().given) << "nothing more to say of it";
    EXPECT_EQ(tab("humanoid.limits bones=[\"LeftUpp"), "humanoid.limits bones=[\"LeftUpper");
    EXPECT_EQ(texts("humanoid.limits bones=[\"LeftUpper"), (Strings{"LeftUpperArm", "LeftUpperLeg"}));
    EXPECT_EQ(tab("humanoid.limits bones=[\"LeftUpper"), "humanoid.limits bones=[\"LeftUpperArm\"");
    EXPECT_EQ(tab("humanoid.limits bones=[\"LeftUpperArm\""), "humanoid.limits bones=[\"LeftUpperArm\"] ");
    EXPECT_FALSE(has(texts("humanoid.limits bones=[\"LeftUpperArm\","), "LeftUpperArm"));
    EXPECT_EQ(wrong("humanoid.limits bones=[\"LeftUpp"), "");
    EXPECT_NE(wrong("humanoid.limits bones=LeftUpperArm"), "") << "is no list and becomes none";
}

/// Names with characters that end an element or a list; offers for them must still be valid.
TEST_F(Completion, ListsOfNamesThatLookLikeLists) {
    for (const char* name : {"a, b", "c]", "d \"e\"", "\\", "[f"})
        table_.run(workspace_, "rig.element.add", {{"name", name}, {"kind", "bone"}});
    std::string line = "rig.read names=[";
    for (int i = 0; i < 5; ++i) {
        const Strings offered = texts(line);
        ASSERT_FALSE(offered.empty());
        line = rows(line).front().line;
        EXPECT_EQ(wrong(line), "") << line;
        ASSERT_EQ(texts(line).front(), "]") << line;
        if (i < 4) line += ",";
    }
    line = tab(line);
    const Json names = *read_typed_command(line).arguments;
    EXPECT_EQ(names.at("names").size(), 5u) << line;
    EXPECT_EQ(texts("rig.read names=[\"c]"), (Strings{"c]"}));
    std::mt19937 random(5);
    for (int i = 0; i < 2000; ++i) {
        std::string hostile = "rig.read names=";
        for (std::size_t k = random() % 12; k > 0; --k) hostile += "[]\",\\ acd"[random() % 9];
        for (const CompletionRow& row : rows(hostile)) EXPECT_GE(row.line.size(), 1u);
        tab(hostile, random() % 3);
    }
}

TEST_F(Completion, ReportsMistakesWhileTyping) {
    EXPECT_EQ(wrong("chain.add length=1"), "");
    EXPECT_EQ(wrong("chain.add len"), "");
    EXPECT_EQ(wrong("chain.add length="), "");
    EXPECT_EQ(wrong("chain.add length=-"), "");
    EXPECT_EQ(wrong("chain.add length=1 position=[0, 1"), "");
    EXPECT_EQ(wrong("chain.mode mode=re"), "") << "it may become reach";
    EXPECT_EQ(wrong("race.solver on=tr"), "");
    EXPECT_TRUE(test::has(wrong("chain.add lenght=1"), "no argument \"lenght\""));
    EXPECT_TRUE(test::has(wrong("chain.add xyz"), "no argument \"xyz\""));
    EXPECT_TRUE(test::has(wrong("chain.add 1.5 "), "write name=value"));
    EXPECT_TRUE(test::has(wrong("chain.add length=abc"), "length must be a number"));
    EXPECT_TRUE(test::has(wrong("chain.add length=-1"), "length must be"));
    EXPECT_TRUE(test::has(wrong("chain.mode mode=re "), "mode must be one of forward"));
    EXPECT_TRUE(test::has(wrong("chain.mode mode=flying"), "mode must be one of forward"));
    EXPECT_TRUE(test::has(wrong("time.speed factor=3"), "factor must be 0.05 to 2, got 3"));
    EXPECT_TRUE(test::has(missing(read("chain.insert index=1 ")), "length is missing (a number"));
    EXPECT_TRUE(test::has(missing(read("chain.insert index=1 length=")), "length is missing"));
    EXPECT_EQ(missing(read("chain.insert index=1 length=2")), "");
    EXPECT_EQ(missing(read("undo ")), "");
}

// The messages are the same as when it runs: everything refused then is reported early.
TEST_F(Completion, FindsEveryMistakeThatTheTableWouldRefuse) {
    for (const char* line : {"chain.add length=abc ", "chain.add length=[1] ", "chain.target to=[1,2] ",
                             "race.solver on=1 ", "chain.mode mode=x ", "chain.select index=1.5 ",
                             "chain.add nothing=1 ", "humanoid.target rotation=[1,1,1,1] "}) {
        const std::string told = wrong(line);
        EXPECT_FALSE(told.empty()) << line;
        const TypedCommand typed = read_typed_command(line);
        EXPECT_THROW(table_.run(workspace_, typed.name, typed.arguments), Refused) << line;
    }
}

// Any input, stopped anywhere, gets an answer and lines that parse again.
TEST_F(Completion, TenThousandHostileLinesAreAnswered) {
    std::mt19937 random(11);
    const auto below = [&](std::size_t end) { return random() % end; };
    Strings bits{" ", "\t", "\n"};
    std::istringstream words(
        "= \" [ ] { } \\ , : 1e999 - nan true null \x01 \xC3\xA4 \xFF \xF0\x9F\x8E\xA8 .. name mode= to= "
        "index= "
        "length= position=[ 999999999999999999999 %s%n");
    for (std::string word; words >> word;) bits.push_back(word);
    for (int i = 0; i < rounds(10'000); ++i) {
        std::string line = below(3) == 0 ? "" : table_.all()[below(table_.all().size())].name;
        for (std::size_t n = below(12); n > 0; --n) {
            line += below(3) == 0 ? " " : "";
            line += bits[below(bits.size())];
        }
        if (below(100) == 0) line += std::string(5000, "[ \"=x"[below(5)]);
        const TypedLine typed = read(line);
        (void)mistake(typed);
        (void)missing(typed);
        (void)search_commands(table_, line, "chain");
        const auto offered = completions(typed, line, workspace_);
        EXPECT_LE(offered.size(), max_rows);
        if (typed.command == nullptr) {
            EXPECT_TRUE(offered.empty());
        }
        for (std::size_t row = 0; row < std::min<std::size_t>(offered.size(), 3); ++row)
            EXPECT_EQ(read(completed(typed, line, offered, row)).command, typed.command) << line;
        try {
            const TypedCommand whole = read_typed_command(line);
            if (const Command* command = table_.find(whole.name)) check_arguments(*command, whole.arguments);
        } catch (const std::runtime_error&) {
        }
    }
}

// Titles of commands: each has one, in words that a user would search for.

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

// Menu, help and the README's list use the palette's titles; only a shortcut with arguments ("Save as...")
// has a title of its own.
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
