#include "app/document/history.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

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
