#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/runtime.hpp"
#include "app/document/workspace.hpp"
#include "tests/app/support/test_part.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

TEST(Workspace, KnowsWhetherItDiffersFromTheSavedScene) {
    Workspace workspace = test::make_workspace();
    EXPECT_FALSE(workspace.modified());
    workspace.document.edit<test::TestPart>("arm").title = "other";
    EXPECT_TRUE(workspace.modified());
    workspace.document = workspace.saved;
    EXPECT_FALSE(workspace.modified());
}

TEST(Workspace, AnEditDoesNotChangeDocumentsThatShareThePart) {
    const Workspace before = test::make_workspace();
    Workspace after = before;
    after.document.edit<test::TestPart>("arm").title = "other";
    EXPECT_EQ(before.document.get<test::TestPart>("arm").title, "blank arm");
    EXPECT_EQ(before.document.parts().at("rope"), after.document.parts().at("rope"));
}

TEST(Workspace, ShowsTheLastFewToastsAndRefusalsLonger) {
    Workspace workspace;
    workspace.toast("saved");
    workspace.toast("no", ToastKind::Refusal);
    ASSERT_EQ(workspace.ui.toasts.size(), 2u);
    EXPECT_EQ(workspace.ui.toasts[0].ticks_left, 4 * 60);
    EXPECT_EQ(workspace.ui.toasts[1].ticks_left, 7 * 60);
    EXPECT_EQ(workspace.ui.toasts[1].kind, ToastKind::Refusal);
    for (int i = 0; i < 10; ++i) workspace.toast(std::to_string(i));
    ASSERT_EQ(workspace.ui.toasts.size(), 4u);
    EXPECT_EQ(workspace.ui.toasts.back().text, "9");
}

TEST(Workspace, ARepeatedToastRestartsAndIsShownOnce) {
    Workspace workspace;
    workspace.toast("limit", ToastKind::Refusal);
    workspace.ui.toasts[0].ticks_left = 3;
    workspace.toast("other");
    workspace.toast("limit", ToastKind::Refusal);
    ASSERT_EQ(workspace.ui.toasts.size(), 2u);
    EXPECT_EQ(workspace.ui.toasts[1].text, "limit");
    EXPECT_EQ(workspace.ui.toasts[1].ticks_left, 7 * 60);
}

TEST(Workspace, ThePastsOfClosedLabsKeepWithinOneBound) {
    constexpr std::size_t bound = 64u << 20;
    Workspace workspace = test::make_workspace();
    for (int i = 0; i < 6; ++i) {
        const std::string lab = "lab " + std::to_string(i);
        workspace.document.set(lab, test::make_part(lab, std::vector<float>(1'000'000)));
        workspace.open_lab(lab);
        for (int tick = 0; tick < 10; ++tick, ++workspace.moment) workspace.remember_moment();
    }
    std::size_t bytes = 0;
    for (const auto& [lab, past] : workspace.pasts) bytes += past.rewind.bytes();
    EXPECT_LE(bytes, bound);
    EXPECT_GT(bytes, 0u);
    EXPECT_EQ(workspace.rewind.size(), 10u) << "the open lab keeps its own";
}

struct Counter final : Runtime {
    int count = 0;
};
struct Other final : Runtime {};

TEST(Runtimes, AreMadeWhenFirstAskedForAndKept) {
    const Runtimes runtimes;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0);
    ++runtimes.of<Counter>("chain").count;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 1);
    EXPECT_EQ(runtimes.of<Counter>("rope").count, 0) << "each lab has its own";
    EXPECT_THROW(runtimes.of<Other>("chain"), std::bad_cast);
    runtimes.clear();
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0);
}

TEST(Runtimes, AreNotSharedWithACopy) {
    Runtimes runtimes;
    runtimes.of<Counter>("chain").count = 3;
    const Runtimes copy = runtimes;
    EXPECT_EQ(copy.of<Counter>("chain").count, 0);
    runtimes = copy;
    EXPECT_EQ(runtimes.of<Counter>("chain").count, 0) << "what belonged to another document is gone";
    runtimes.of<Counter>("chain").count = 3;
    const Runtimes moved = std::move(runtimes);
    EXPECT_EQ(moved.of<Counter>("chain").count, 3);
}

// Arguments that accept more than one form.

struct CommandArguments : testing::Test {
    Workspace workspace = test::make_workspace();
    CommandTable table;
    bool was_point = false;
    glm::vec3 pull{0.0f};
    glm::quat turn{1.0f, 0.0f, 0.0f, 0.0f};

    CommandArguments() {
        table.add({.name = "test.pull",
                   .arguments = {{.name = "by", .type = ArgumentType::NumberOrPoint, .low = -5, .high = 5}},
                   .help = {},
                   .apply = [this](Workspace&, const Arguments& a) {
                       was_point = a.is_point("by");
                       pull = was_point ? a.point("by") : glm::vec3(a.number("by"));
                   }});
        table.add({.name = "test.turn",
                   .arguments = {{.name = "to", .type = ArgumentType::Rotation}},
                   .help = {},
                   .apply = [this](Workspace&, const Arguments& a) { turn = a.rotation("to"); }});
    }
    std::string refused(const char* name, const Json& arguments) {
        try {
            table.run(workspace, name, arguments);
        } catch (const Refused& refusal) {
            return refusal.what();
        }
        ADD_FAILURE() << arguments << " was accepted";
        return {};
    }
    void turned(const Json& to, glm::vec3 from, glm::vec3 wanted) {
        table.run(workspace, "test.turn", {{"to", to}});
        EXPECT_LT(glm::length(turn * from - wanted), 1e-6f) << to;
    }
};

TEST_F(CommandArguments, ANumberOrAPoint) {
    table.run(workspace, "test.pull", {{"by", 3}});
    EXPECT_FALSE(was_point);
    EXPECT_EQ(pull, glm::vec3(3));
    table.run(workspace, "test.pull", {{"by", {1, 2, 9}}});
    EXPECT_TRUE(was_point);
    EXPECT_EQ(pull, glm::vec3(1, 2, 9));
    const std::string rule = "test.pull: by must be a number or a point [x, y, z], got ";
    EXPECT_EQ(refused("test.pull", {{"by", "3"}}), rule + "\"3\"");
    EXPECT_EQ(refused("test.pull", {{"by", {1, 2}}}), rule + "[1,2]");
    EXPECT_TRUE(test::says(refused("test.pull", {{"by", 6}}), "test.pull by -5 5 6"));
    EXPECT_TRUE(
        test::says(refused("test.pull", {{"by", {1, 2, "z"}}}), "test.pull by three finite 1e9 [1,2,\"z\"]"));
    refused("test.pull", {{"by", std::nan("")}});
    refused("test.pull", {{"by", {0, HUGE_VAL, 0}}});
    EXPECT_TRUE(test::says(refused("test.pull", Json::object()), "test.pull by missing number point"));
}

TEST_F(CommandArguments, ARefusedCommandLeavesNothingOfItsChange) {
    table.add({.name = "test.half", .arguments = {}, .help = {}, .apply = [](Workspace& w, const Arguments&) {
                   w.document.edit<test::TestPart>("arm").title = "half";
                   throw std::invalid_argument("no more");
               }});
    EXPECT_EQ(refused("test.half", Json::object()), "test.half: no more");
    EXPECT_EQ(workspace.document, workspace.blank);
}

/// Text that a scene file could not store is refused; a path may hold any bytes.
TEST_F(CommandArguments, ATextIsUtf8) {
    std::string taken;
    for (const char* const name : {"name", "path"})
        table.add({.name = std::string("test.") + name,
                   .arguments = {{.name = name, .type = ArgumentType::Text}},
                   .help = {},
                   .apply = [&taken, name](Workspace&, const Arguments& a) { taken = a.text(name); }});
    for (const char* const good : {"", "rope", "\xC3\xA4", "\xF0\x9F\x8E\xA8"}) {
        table.run(workspace, "test.name", {{"name", good}});
        EXPECT_EQ(taken, good);
    }
    for (const char* const bad : {"\xFF", "a\xC3", "\xED\xA0\x80", "\xC0\xAF", "\xEF\xBF\xBD"}) {
        EXPECT_TRUE(test::says(refused("test.name", {{"name", bad}}), "test.name name UTF-8"));
        table.run(workspace, "test.path", {{"path", bad}});
        EXPECT_EQ(taken, bad);
    }
}

TEST_F(CommandArguments, ARotation) {
    const float half = std::sqrt(0.5f);
    turned({0, 0, 90}, {1, 0, 0}, {0, 1, 0});
    turned({90, 0, 90}, {0, 1, 0}, {0, 0, 1});  // about X first, then about Z
    turned({half, 0, 0, half}, {0, 1, 0}, {0, 0, 1});
    table.run(workspace, "test.turn", {{"to", {0.7071, 0, 0, 0.7071}}});
    EXPECT_NEAR(glm::length(turn), 1.0f, 1e-6f)
        << "written with few digits, it is of unit length all the same";
    EXPECT_TRUE(test::says(refused("test.turn", {{"to", {0, 0, 0, 0}}}),
                           "test.turn to quaternion length 1 [0,0,0,0]"));
    EXPECT_TRUE(test::says(refused("test.turn", {{"to", 90}}), "test.turn to unit quaternion 90"));
    refused("test.turn", {{"to", {0, 0}}});
    refused("test.turn", {{"to", {0, std::nan(""), 0}}});
    refused("test.turn", {{"to", {0, 0, 0, HUGE_VAL}}});
}

}  // namespace
}  // namespace tendril::app
