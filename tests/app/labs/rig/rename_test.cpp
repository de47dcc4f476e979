// Renaming elements, units and curves: everything that refers to them follows, and no bit of the pose
// changes.
#include <iterator>
#include <string>
#include <vector>

#include "app/document/command.hpp"
#include "app/shell/command_line.hpp"
#include "tests/app/labs/rig/rig_support.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

class RigRename : public RigTest {
  protected:
    /// Every element, unit and curve of the rig.
    struct Thing {
        std::string kind, name;
    };
    std::vector<Thing> things() const {
        const rig::Definition& definition = part().rig.definition();
        std::vector<Thing> all;
        for (const rig::Element& each : definition.elements) all.push_back({"element", each.name});
        for (const std::string& each : part().rig.unit_names()) all.push_back({"unit", each});
        for (const rig::NamedCurve& each : definition.curves) all.push_back({"curve", each.name});
        return all;
    }
    void rename(const Thing& thing, const std::string& to) {
        run(("rig." + thing.kind + ".rename").c_str(), {{"name", thing.name}, {"to", to}});
    }
    /// Moves everything that a number can move, so that units with memory move too.
    static void stir(Workspace& in, const CommandTable& commands) {
        const RigPart& rig = rig_part(in);
        for (const rig::Element& each : rig.rig.definition().elements) {
            if (!each.control || each.control->kind != rig::ControlKind::Float) continue;
            commands.run(in, "rig.control.set", {{"name", each.name}, {"value", 0.7}});
        }
    }
    void ticks_in(Workspace& in, int count) const {
        for (int i = 0; i < count; ++i)
            if (lab().moving(in)) lab().step(in);
    }
    std::vector<std::string> preset_names() const {
        return find_argument(*table.find("rig.preset"), "name")->choices;
    }
};

std::string odd_name(std::size_t i) {
    static const char* const odd[] = {
        "\xC3\xA9t\xC3\xA9 ", "\"quoted\" ", "back\\slash ", "{\"item\": \"each\"} ",
        "  spaces  ",         "?/ */ ",      "each ",        "\xE2\x98\x83\xF0\x9F\xA6\xB4 "};
    return odd[i % std::size(odd)] + std::to_string(i);
}

TEST_F(RigRename, RenamingEverythingInEveryPresetKeepsEveryBit) {
    for (const std::string& preset : preset_names()) {
        run("rig.preset", {{"name", preset}});
        stir(workspace, table);
        tick(20);
        Workspace other = workspace;  // keeps the old names
        const std::vector<Thing> before = things();
        ASSERT_FALSE(before.empty()) << preset;
        for (std::size_t i = 0; i < before.size(); ++i) rename(before[i], odd_name(i));
        const std::vector<Thing> after = things();
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(after[i].name, odd_name(i)) << preset;
        EXPECT_TRUE(part().state == rig_part(other).state) << preset << ": the names alone move nothing";
        EXPECT_TRUE(part().take == rig_part(other).take) << preset << ": the take goes on";

        Workspace opened = reopened();
        EXPECT_TRUE(rig_part(opened).rig.definition() == part().rig.definition()) << preset;
        for (Workspace* const each : {&workspace, &other, &opened}) {
            stir(*each, table);
            ticks_in(*each, 40);
        }
        EXPECT_TRUE(part().state == rig_part(other).state) << preset;
        EXPECT_TRUE(rig_part(opened).state == rig_part(other).state) << preset << ": saved and opened";

        const std::string code = lab().code(workspace), old = lab().code(other);
        for (const Thing& each : before) {
            if (each.kind != "element") continue;
            const std::string text = '"' + each.name + '"';
            EXPECT_NE(old.find(text), std::string::npos) << preset << " " << text;
            EXPECT_EQ(code.find(text), std::string::npos) << preset << " " << text;
        }
    }
}

TEST_F(RigRename, SelectionWalkAndClipFollow) {
    control("guide", "position");
    element("arm");
    unit({{"unit", "set_transform"}, {"name", "follow"}, {"item", "arm"}});
    run("rig.motion", {{"name", "guide"}, {"path", "circle"}});
    tick(30);
    run("rig.clip.record");
    ASSERT_TRUE(part().clip);
    run("rig.select", {{"element", "guide"}, {"unit", "follow"}});
    run("rig.element.rename", {{"name", "guide"}, {"to", "leader"}});
    run("rig.element.rename", {{"name", "arm"}, {"to", "limb"}});
    run("rig.unit.rename", {{"name", "follow"}, {"to", "goes after"}});
    EXPECT_EQ(part().selected_element(), "leader");
    EXPECT_EQ(part().selected.unit, "goes after");
    ASSERT_EQ(part().walks.size(), 1u);
    EXPECT_EQ(part().walks[0].control, "leader");
    EXPECT_EQ(part().clip->bones, std::vector<std::string>{"limb"});
    const glm::dvec3 there = translation("leader");
    tick(10);
    EXPECT_NE(translation("leader"), there) << "it walks on";
}

TEST_F(RigRename, GivesNoClipTheSameBoneTwice) {
    element("a");
    element("b");
    tick(3);
    run("rig.clip.record", {{"seconds", 0.05}});
    run("rig.element.remove", {{"name", "a"}});
    EXPECT_TRUE(test::says(refused("rig.element.rename", {{"name", "b"}, {"to", "a"}}),
                           "clip removed bone a record"));
    EXPECT_EQ(part().clip->bones, (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(part().rig.element("b"));
    run("rig.clip.record", {{"seconds", 0.05}});
    run("rig.element.rename", {{"name", "b"}, {"to", "a"}});
    EXPECT_EQ(part().clip->bones, std::vector<std::string>{"a"});
}

TEST_F(RigRename, RefusesNamesThatAreEmptyTakenOrUnprintable) {
    element("a");
    element("b", "a");
    run("rig.curve.add", {{"name", "c"}});
    unit({{"unit", "set_transform"}, {"name", "u"}, {"item", "a"}});
    unit({{"unit", "set_transform"}, {"name", "v"}, {"item", "b"}});
    struct Case {
        const char* command;
        Json arguments;
        const char* told;
    };
    const std::vector<Case> cases{
        {"rig.element.rename", {{"name", "a"}, {"to", ""}}, "to empty"},
        {"rig.element.rename", {{"name", "a"}, {"to", "b"}}, "to already element b"},
        {"rig.element.rename", {{"name", "x"}, {"to", "y"}}, "no element x"},
        {"rig.element.rename", {{"name", "a"}, {"to", "a\nb"}}, "unprintable"},
        {"rig.element.rename", {{"name", "a"}, {"to", std::string(101, 'a')}}, "101 100"},
        {"rig.unit.rename", {{"name", "u"}, {"to", "v"}}, "to already unit v"},
        {"rig.unit.rename", {{"name", "u"}, {"to", ""}}, "to empty"},
        {"rig.unit.rename", {{"name", "a"}, {"to", "w"}}, "no unit a"},
        {"rig.curve.rename", {{"name", "c"}, {"to", ""}}, "to empty"},
        {"rig.curve.rename", {{"name", "d"}, {"to", "e"}}, "no curve d"}};
    for (const Case& each : cases) EXPECT_TRUE(test::says(refused(each.command, each.arguments), each.told));
    run("rig.element.rename", {{"name", "a"}, {"to", "u"}});
    EXPECT_EQ(named("elements", "b").at("parent"), "u") << "an element and a unit may share a name";
    run("rig.element.rename", {{"name", "u"}, {"to", "u"}});
    EXPECT_EQ(things().size(), 5u);
}

}  // namespace
}  // namespace tendril::app
