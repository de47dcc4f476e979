#include "app/document/rewind.hpp"

#include <gtest/gtest.h>

#include "app/document/command.hpp"
#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

using test::make_part;
using test::TestPart;

std::string title_at(const Rewind& rewind, std::uint64_t ticks_back) {
    return dynamic_cast<const TestPart&>(*rewind.at(ticks_back).part).title;
}

void remember(Rewind& rewind, std::uint64_t from, std::uint64_t to, std::size_t floats = 0) {
    for (std::uint64_t tick = from; tick <= to; ++tick)
        rewind.remember(tick, 0, make_part(std::to_string(tick), std::vector<float>(floats)));
}

TEST(Rewind, KeepsTheLastTenSeconds) {
    Rewind rewind;
    EXPECT_TRUE(rewind.empty());
    remember(rewind, 0, 1000);
    EXPECT_EQ(rewind.newest(), 1000u);
    EXPECT_EQ(rewind.oldest(), 400u);
    EXPECT_EQ(rewind.size(), 601u);
    EXPECT_EQ(title_at(rewind, 0), "1000");
    EXPECT_EQ(title_at(rewind, 123), "877");
    EXPECT_EQ(title_at(rewind, 9999), "400");
    rewind.clear();
    EXPECT_TRUE(rewind.empty());
    EXPECT_EQ(rewind.bytes(), 0u);
}

TEST(Rewind, DropsLaterMomentsWhenTimeContinuesFromAnEarlierOne) {
    Rewind rewind;
    remember(rewind, 0, 100);
    rewind.remember(40, 0, make_part("again"));
    EXPECT_EQ(rewind.newest(), 40u);
    EXPECT_EQ(title_at(rewind, 0), "again");
    EXPECT_EQ(title_at(rewind, 1), "39");
    rewind.forget_from(10);
    EXPECT_EQ(rewind.newest(), 9u);
    rewind.forget_from(0);
    EXPECT_TRUE(rewind.empty());
}

TEST(Rewind, StaysWithinItsBoundAndThinsEvenly) {
    constexpr std::size_t bound = 1 << 20;
    Rewind rewind(bound);
    for (std::uint64_t tick = 0; tick <= 2000; ++tick) {
        remember(rewind, tick, tick, 2000);  // 8 kB each: 130 fit
        ASSERT_LE(rewind.bytes(), bound);
        ASSERT_EQ(rewind.newest(), tick);
    }
    EXPECT_LE(rewind.newest() - rewind.oldest(), 600u);
    EXPECT_GE(rewind.newest() - rewind.oldest(), 590u) << "ten seconds all the same";
    EXPECT_GT(rewind.size(), 50u);
    EXPECT_EQ(title_at(rewind, 0), "2000");
    for (std::uint64_t back = 10; back < 590; ++back)
        EXPECT_NEAR(std::stod(title_at(rewind, back)), 2000.0 - static_cast<double>(back), 8.0);

    remember(rewind, 2001, 3200, 0);  // small again: every tick is kept again
    EXPECT_EQ(rewind.size(), 601u);
}

TEST(Rewind, KeepsTheNewestHoweverLarge) {
    Rewind rewind(100);
    remember(rewind, 0, 5, 1000);
    EXPECT_EQ(rewind.size(), 1u);
    EXPECT_EQ(title_at(rewind, 3), "5");
}

/// A workspace whose lab has run for a while in the program.
struct Seek : testing::Test {
    Workspace workspace = test::make_workspace();
    CommandTable table;
    Seek() {
        add_workspace_commands(table);
        table.add({.name = "arm.title",
                   .arguments = {{.name = "title", .type = ArgumentType::Text}},
                   .help = {},
                   .apply = [](Workspace& w, const Arguments& a) {
                       w.document.edit<TestPart>("arm").title = a.text("title");
                   }});
    }
    void play(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            workspace.remember_moment();
            ++workspace.clock.tick;
            ++workspace.moment;
            workspace.document.edit<TestPart>("arm").title = std::to_string(workspace.clock.tick);
        }
    }
    void run(const char* command, const Json& arguments = Json::object(), Gesture gesture = 0) {
        table.run(workspace, command, arguments, gesture);
    }
    void edit(const char* title, Gesture gesture = 0) { run("arm.title", {{"title", title}}, gesture); }
    void undo() { run("undo"); }
    std::string seek(int ticks_back, Gesture gesture = 0) {
        run("time.seek", {{"ticks_back", ticks_back}}, gesture);
        return title();
    }
    std::string title() { return workspace.document.get<TestPart>("arm").title; }
};

TEST_F(Seek, GoesBackAndForwardAndPauses) {
    EXPECT_THROW(seek(1), Refused);
    play(100);
    EXPECT_EQ(seek(0), "100");
    EXPECT_EQ(seek(30), "70");
    EXPECT_FALSE(workspace.clock.playing);
    EXPECT_EQ(workspace.clock.tick, 70u);
    EXPECT_EQ(seek(10), "90") << "counted from the last moment, wherever one is";
    EXPECT_EQ(seek(0), "100");
    EXPECT_EQ(workspace.history.size(), 0u);
}

TEST_F(Seek, PausesOnlyTheLabWhosePastIsShown) {
    const auto playing_in = [&](const char* lab) {
        workspace.open_lab(lab);
        return workspace.clock.playing;
    };
    play(100);
    seek(30);
    EXPECT_TRUE(playing_in("rope"));
    EXPECT_FALSE(playing_in("arm"));
    run("time.play");
    EXPECT_TRUE(playing_in("rope"));
    run("time.pause");
    EXPECT_FALSE(playing_in("arm")) << "paused by hand, everything is";
    EXPECT_FALSE(playing_in("rope"));
    run("time.play");
    EXPECT_TRUE(playing_in("arm"));
    seek(20);
    EXPECT_TRUE(playing_in("rope"));
    run("time.pause");
    EXPECT_FALSE(playing_in("arm")) << "looking back";
    EXPECT_FALSE(playing_in("rope")) << "still paused by hand";
}

TEST_F(Seek, PlayingOnDropsLaterMoments) {
    play(100);
    seek(60);
    play(1);
    EXPECT_EQ(title(), "41");
    EXPECT_EQ(seek(0), "41");
    EXPECT_EQ(seek(1), "40");
    EXPECT_EQ(seek(600), "blank arm");
}

TEST_F(Seek, GoingBackOverAnEditCanBeUndone) {
    play(50);
    edit("edited");
    play(50);
    EXPECT_EQ(seek(10), "90");
    EXPECT_EQ(workspace.history.size(), 1u) << "nothing was changed between 90 and 100";
    EXPECT_EQ(seek(60), "40");
    EXPECT_EQ(workspace.history.size(), 2u);
    EXPECT_EQ(workspace.history.undo_label(), "time.seek");
    EXPECT_EQ(seek(70), "30");
    EXPECT_EQ(workspace.history.size(), 2u) << "already before it";
    play(1);  // forgets everything later; undo does not
    undo();
    EXPECT_EQ(title(), "100") << "where one came from";
    undo();
    EXPECT_EQ(title(), "50") << "as it was before the edit";
}

TEST_F(Seek, ADragOverAnEditIsOneStep) {
    play(50);
    edit("edited");
    play(50);
    for (const int back : {40, 60, 45, 70}) seek(back, 7);
    EXPECT_EQ(workspace.history.size(), 2u);
    EXPECT_EQ(title(), "30");
    undo();
    EXPECT_EQ(title(), "100");
    EXPECT_EQ(workspace.clock.tick, 100u);
    EXPECT_EQ(seek(40), "60") << "and all of it is still remembered";
}

TEST_F(Seek, AnEditDropsLaterMoments) {
    play(100);
    seek(60);
    edit("edited");
    EXPECT_EQ(seek(0), "edited");
    EXPECT_EQ(seek(5), "35");
    EXPECT_EQ(seek(0), "edited");
    EXPECT_EQ(workspace.history.size(), 1u) << "the edit; back over it and on again is nothing";
    undo();
    EXPECT_EQ(title(), "40");
    play(3);
    for (const char* command : {"scene.new", "lab.open"}) {
        play(3);
        EXPECT_FALSE(workspace.rewind.empty());
        run(command, command[0] == 'l' ? Json{{"name", "rope"}} : Json::object());
        EXPECT_TRUE(workspace.rewind.empty()) << command;
    }
}

TEST_F(Seek, UndoOfAnEditRestoresLaterMoments) {
    play(100);
    seek(60);
    EXPECT_EQ(workspace.later_ticks(), 60u);
    edit("edited", 5);
    edit("edited more", 5);  // the same drag
    play(3);
    EXPECT_EQ(workspace.later_ticks(), 0u);
    undo();
    EXPECT_EQ(title(), "40");
    EXPECT_EQ(workspace.later_ticks(), 60u);
    EXPECT_EQ(seek(20), "80");
    EXPECT_EQ(seek(60), "40");
    run("redo", Json::object());
    EXPECT_EQ(title(), "43") << "with what followed it";
    EXPECT_EQ(workspace.later_ticks(), 0u);
    undo();
    EXPECT_EQ(seek(0), "100") << "also after redo";
}

TEST_F(Seek, AnEditOfTheLatestMomentDiscardsNothing) {
    play(100);
    edit("edited");
    EXPECT_FALSE(workspace.discarded);
    seek(60);
    edit("again");
    EXPECT_TRUE(workspace.discarded);
    run("lab.open", {{"name", "rope"}});
    EXPECT_FALSE(workspace.discarded) << "of the open lab only";
}

TEST_F(Seek, EachLabKeepsItsOwnLastSeconds) {
    play(50);
    const std::string lab = workspace.lab;
    run("lab.open", {{"name", "rope"}});
    EXPECT_TRUE(workspace.rewind.empty());
    run("lab.open", {{"name", lab}});
    EXPECT_EQ(seek(10), "40");
    play(1);
    EXPECT_EQ(seek(1), "40") << "time goes on from there";
}

TEST_F(Seek, ALabChangedWhileAnotherIsOpenHasNoPast) {
    play(50);
    const std::string lab = workspace.lab;
    run("lab.open", {{"name", "rope"}});
    edit("edited");
    run("lab.open", {{"name", lab}});
    EXPECT_TRUE(workspace.rewind.empty());
    EXPECT_EQ(title(), "edited");
}

TEST_F(Seek, UndoFindsNoMomentOfAnotherTimeline) {
    play(50);
    edit("edited");
    play(50);
    EXPECT_EQ(seek(60), "40");
    edit("again");
    play(100);
    seek(20);
    edit("once more");  // undo brings back the moments that this drops
    for (int i = 0; i < 3; ++i) undo();
    EXPECT_EQ(title(), "100");
    EXPECT_EQ(workspace.moment, workspace.rewind.newest() + 1)
        << "it is now, and not tick 100 of this course";
}

TEST_F(Seek, RedoGoesBackInTimeAgain) {
    play(50);
    edit("edited");
    play(50);
    EXPECT_EQ(seek(60), "40");
    const auto there = workspace.moment;
    for (const char* command : {"undo", "undo", "redo", "redo"}) run(command);
    EXPECT_EQ(title(), "40");
    EXPECT_EQ(workspace.moment, there);
    EXPECT_LT(workspace.moment, workspace.rewind.newest()) << "what came after it is still remembered";
}

TEST(Rewind, IncidentsStayWithTheirMoments) {
    Rewind rewind;
    remember(rewind, 0, 10);
    rewind.note({.tick = 11, .cause = "first"});
    rewind.forget_from(11);  // another change in the same tick
    rewind.note({.tick = 11, .cause = "second"});
    remember(rewind, 11, 30);
    ASSERT_EQ(rewind.incidents().size(), 2u);
    EXPECT_EQ(rewind.incidents()[0].cause, "first");
    remember(rewind, 12, 12);  // from here on the past differs
    EXPECT_EQ(rewind.incidents().size(), 2u);
    remember(rewind, 11, 11);
    EXPECT_TRUE(rewind.incidents().empty());
    rewind.note({.tick = 11, .cause = "third"});
    remember(rewind, 12, 611);
    EXPECT_EQ(rewind.incidents().size(), 1u);
    remember(rewind, 612, 612);
    EXPECT_TRUE(rewind.incidents().empty()) << "ten seconds have passed";
    for (int i = 0; i < 1000; ++i) rewind.note({.tick = 612, .cause = std::to_string(i)});
    EXPECT_EQ(rewind.incidents().size(), Rewind::max_incidents);
    EXPECT_EQ(rewind.incidents().back().cause, "999");
    rewind.clear();
    EXPECT_TRUE(rewind.incidents().empty());
}

TEST(Rewind, AManualChangeIsRememberedFromItsStart) {
    Rewind rewind;
    rewind.remember_change(0);
    EXPECT_TRUE(rewind.empty()) << "nothing was changed";
    rewind.begin_change(3, make_part("before"));
    rewind.begin_change(4, make_part("between"));
    ASSERT_TRUE(rewind.changed());
    rewind.remember_change(7);
    EXPECT_FALSE(rewind.changed());
    EXPECT_EQ(title_at(rewind, 0), "before");
    EXPECT_EQ(rewind.at(0).edition, 3u);
    EXPECT_EQ(rewind.newest(), 7u);
    rewind.begin_change(5, make_part("again"));
    rewind.remember(8, 6, make_part("as it is"));
    EXPECT_FALSE(rewind.changed()) << "the moment has it already";
}

}  // namespace
}  // namespace tendril::app
