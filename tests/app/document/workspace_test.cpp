#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "app/document/command.hpp"
#include "app/document/history.hpp"
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

using test::make_part;
using test::TestPart;

/// A document whose "arm" has this title.
Document document_of(const std::string& title, std::size_t floats = 0) {
    Document document;
    document.set("arm", make_part(title, std::vector<float>(floats)));
    return document;
}

std::string title_of(const Document& document) {
    return document.get<TestPart>("arm").title;
}

TEST(History, GoesBackAndForwardWithTheLabelsOfTheCommands) {
    History history;
    EXPECT_FALSE(history.can_undo() || history.can_redo());
    EXPECT_EQ(history.undo_label() + history.redo_label(), "");
    history.push(document_of("0"), "chain.add", 0);
    history.push(document_of("1"), "chain.mode", 0);
    EXPECT_EQ(history.undo_label(), "chain.mode");

    auto now = history.undo(document_of("2"));
    EXPECT_EQ(title_of(*now), "1");
    EXPECT_EQ(history.undo_label(), "chain.add");
    EXPECT_EQ(history.redo_label(), "chain.mode");
    now = history.undo(*now);
    EXPECT_EQ(title_of(*now), "0");
    EXPECT_FALSE(history.undo(*now));
    EXPECT_EQ(history.redo_label(), "chain.add");
    now = history.redo(*now);
    now = history.redo(*now);
    EXPECT_EQ(title_of(*now), "2");
    EXPECT_FALSE(history.redo(*now));
    EXPECT_EQ(history.size(), 2u);
}

/// Two labs: one changes by itself while the other is edited and undone.
TEST(History, RestoresOnlyWhatTheCommandChanged) {
    History history;
    Document now = document_of("before");
    now.set("rope", make_part("at rest"));
    const Document before = now;
    now.edit<TestPart>("arm").title = "after";
    history.push(before.without(now), "arm.title", 0);
    now.edit<TestPart>("rope").title = "swinging";

    now = *history.undo(now);
    EXPECT_EQ(title_of(now), "before");
    EXPECT_EQ(now.get<TestPart>("rope").title, "swinging");
    now.edit<TestPart>("rope").title = "swinging on";
    now = *history.redo(now);
    EXPECT_EQ(title_of(now), "after");
    EXPECT_EQ(now.get<TestPart>("rope").title, "swinging on");
}

TEST(History, RemembersWhereAChangeIsVisible) {
    const CameraPose near{.distance = 2.0f}, far{.distance = 20.0f}, other{.distance = 7.0f};
    History history;
    history.push(document_of("0"), "rope.preset", 0, {"rope", "a.json", near}, {"rope", "a.json", far});

    Place place{"chain", "a.json", other};  // meanwhile the user opens another lab
    const Document back = *history.undo(document_of("1"), &place);
    EXPECT_EQ(place.lab, "rope");
    EXPECT_EQ(place.camera, near);
    EXPECT_EQ(place.path, std::nullopt) << "it moved no file";
    place = {"chain", "b.json", other};
    history.redo(back, &place);
    EXPECT_EQ(place.lab, "rope");
    EXPECT_EQ(place.camera, far) << "and not what was seen in the other lab";

    place = {"rope", "b.json", other};  // the camera moved since: redo restores that
    const Document again = *history.undo(document_of("1"), &place);
    EXPECT_EQ(place.camera, near);
    history.redo(again, &place);
    EXPECT_EQ(place.camera, other);
}

TEST(History, AChangeOfSceneIncludesItsFile) {
    History history;
    history.push(document_of("0"), "scene.open", 0, {"rope", "a.json", CameraPose{}},
                 {"chain", "b.json", CameraPose{}});
    Place place{"chain", "renamed.json", CameraPose{}};
    const Document back = *history.undo(document_of("1"), &place);
    EXPECT_EQ(place.lab, "rope");
    EXPECT_EQ(place.path, "a.json");
    EXPECT_TRUE(place.camera) << "of another lab, though it is the same pose";
    history.redo(back, &place);
    EXPECT_EQ(place.path, "renamed.json") << "as it was saved meanwhile";
}

TEST(History, HoldsOneEntryForAGesture) {
    History history;
    history.push(document_of("0"), "chain.target", 7);
    history.push(document_of("1"), "chain.target", 7);
    history.push(document_of("2"), "chain.target", 7);
    EXPECT_EQ(history.size(), 1u);
    history.push(document_of("3"), "chain.target", 8);
    EXPECT_EQ(history.size(), 2u);
    history.push(document_of("4"), "chain.target", 7);
    EXPECT_EQ(history.size(), 3u) << "another gesture came between";
    history.push(document_of("5"), "chain.add", 0);
    history.push(document_of("6"), "chain.add", 0);
    EXPECT_EQ(history.size(), 5u) << "0 is a gesture of its own";
    EXPECT_EQ(title_of(*history.undo(document_of("7"))), "6");
}

TEST(History, AnUndoDuringAGestureEndsItsEntry) {
    History history;
    history.push(document_of("0"), "drag", 7);
    auto now = history.undo(document_of("1"));
    history.push(*now, "drag", 7);
    EXPECT_EQ(history.size(), 1u);
    EXPECT_FALSE(history.can_redo());

    history.push(document_of("2"), "drag", 8);
    now = history.undo(document_of("3"));
    now = history.redo(*now);
    history.push(*now, "drag", 8);
    EXPECT_EQ(history.size(), 3u);
}

TEST(History, CountsSharedDataOnceEvenWithoutTheOldestEntries) {
    for (const std::size_t max_entries : {std::size_t{10}, std::size_t{1000}}) {
        History history(max_entries);
        Document document = document_of("arm");
        document.set("rope", make_part("rope", std::vector<float>(1'000'000)));
        for (int i = 0; i < 100; ++i) {
            history.push(document, "edit", 0);
            document.edit<TestPart>("arm").title = std::to_string(i);
        }
        EXPECT_GT(history.bytes(), 4'000'000u);
        EXPECT_LT(history.bytes(), 4'100'000u);
        history.clear();
        EXPECT_EQ(history.bytes(), 0u);
    }
}

TEST(History, ALargeUnchangedPartCostsNoUndoSteps) {
    History history(1000, 6'000'000);
    Document now = document_of("arm");
    now.set("rope", make_part("rope", std::vector<float>(1'000'000)));
    for (int i = 0; i < 20; ++i) {
        history.push(now, "edit", 0);
        now.edit<TestPart>("arm").title = std::to_string(i);
    }
    for (int i = 0; i < 10; ++i) now = *history.undo(now);
    EXPECT_EQ(history.size(), 10u);
    for (int i = 0; i < 10; ++i) now = *history.redo(now);
    EXPECT_EQ(title_of(now), "19");
    EXPECT_EQ(history.size(), 20u);
}

TEST(History, DropsTheFarthestRedoStepsIfTooLarge) {
    History history(1000, 1'000'000);
    history.push(document_of("0", 50'000), "a", 0);
    history.push(document_of("1", 50'000), "b", 0);
    auto now = history.undo(document_of("huge", 1'000'000));
    EXPECT_EQ(history.redo_label(), "b") << "one step forward stays";
    now = history.undo(*now);
    EXPECT_EQ(title_of(*now), "0");
    EXPECT_LE(history.bytes(), 1'000'000u);
    now = history.redo(*now);
    EXPECT_EQ(title_of(*now), "1");
    EXPECT_FALSE(history.can_redo());
}

TEST(History, StaysWithinItsBytesButKeepsOneStep) {
    History history(1000, 1'000'000);
    for (int i = 0; i < 100; ++i) history.push(document_of(std::to_string(i), 25'000), "edit", 0);
    EXPECT_LE(history.bytes(), 1'000'000u);
    EXPECT_GE(history.size(), 8u);
    EXPECT_EQ(title_of(*history.undo(document_of("100", 25'000))), "99");

    history.clear();
    history.push(document_of("huge", 1'000'000), "edit", 0);
    EXPECT_EQ(history.size(), 1u) << "the last step can be taken back, however large it is";
    history.push(document_of("huger", 1'000'000), "edit", 0);
    EXPECT_EQ(history.size(), 1u);
    EXPECT_EQ(title_of(*history.undo(document_of("now"))), "huger");
}

/// Compares the history with its model: a list of titles and a position in it.
TEST(History, BehavesLikeAListWithAPosition) {
    std::mt19937 random(4);
    History history;
    std::vector<Document> states{document_of("start")};
    std::size_t place = 0;
    for (int i = 0; i < 20'000; ++i) {
        switch (random() % 3) {
            case 0:
                history.push(states[place], "edit", 0);
                states.resize(++place);
                states.push_back(document_of(std::to_string(i), random() % 100));
                if (place > 900) history.clear(), states = {states[place]}, place = 0;
                break;
            case 1: {
                const auto back = history.undo(states[place]);
                ASSERT_EQ(back.has_value(), place > 0);
                if (back) {
                    ASSERT_TRUE(*back == states[--place]);
                }
                break;
            }
            default: {
                const auto forward = history.redo(states[place]);
                ASSERT_EQ(forward.has_value(), place + 1 < states.size());
                if (forward) {
                    ASSERT_TRUE(*forward == states[++place]);
                }
            }
        }
        ASSERT_EQ(history.size(), place);
    }
    history.clear();
    EXPECT_EQ(history.bytes(), 0u);
}

TEST(History, NeverExceedsItsBounds) {
    std::mt19937 random(5);
    constexpr std::size_t bound = 100'000;
    History history(20, bound);
    Document now = document_of("start");
    now.set("rope", make_part("rope"));
    for (int i = 0; i < 20'000; ++i) {
        const auto before = now;
        switch (random() % 4) {
            case 0:
                if (const auto back = history.undo(now)) now = *back;
                break;
            case 1:
                if (const auto forward = history.redo(now)) now = *forward;
                break;
            default:
                history.push(before, "edit", random() % 3);
                now.edit<TestPart>(random() % 2 ? "arm" : "rope").values.resize(random() % 3000);
        }
        // One undo and one redo step may remain although they are too large; each part is at most 12 kB here.
        ASSERT_LE(history.bytes(), bound + 4 * 13'000);
        ASSERT_LE(history.size(), 20u);
    }
    history.clear();
    EXPECT_EQ(history.bytes(), 0u);
}

}  // namespace
}  // namespace tendril::app
