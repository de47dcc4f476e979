// Cards: their files, and the completion of their steps.
#include "app/labs/card.hpp"

#include <gtest/gtest.h>

#include "app/shell/card_watch.hpp"
#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

Json good_step() {
    return {{"text", "Do it."},
            {"place", {{"handle", "target"}}},
            {"by", Json::array({{{"command", "move"}, {"what", "ball"}, {"to", nullptr}}})},
            {"when", Json::array({{{"present", "x"}}})},
            {"script", Json::array({{{"wait", 1}}})}};
}

Json good_card() {
    return {{"title", "One thing to try"}, {"scene", Json::array()}, {"steps", Json::array({good_step()})}};
}

Card only(const Json& card) {
    return read_cards(Json::array({card}).dump()).at(0);
}

std::string refusal(const Json& card) {
    try {
        read_cards(Json::array({card}).dump());
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(CardFile, IsRead) {
    const Card card = only(good_card());
    ASSERT_EQ(card.steps.size(), 1u);
    EXPECT_EQ(card.steps[0].text, "Do it.");
    EXPECT_EQ(card.steps[0].place, CardStep::Place::Handle);
    EXPECT_EQ(card.steps[0].place_name, "target");
    ASSERT_EQ(card.steps[0].when.size(), 1u);
    EXPECT_EQ(card.steps[0].when[0].kind, CardCondition::Kind::Present);
    ASSERT_EQ(card.steps[0].by.size(), 1u);
    EXPECT_EQ(card.steps[0].by[0].command, "move");
}

TEST(CardFile, ABrokenOneIsRefusedWithItsPath) {
    struct Case {
        const char* path;
        Json value;
        const char* message;
    };
    const Case cases[] = {
        {"/title", "", "cards.0.title: expected text"},
        {"/titel", 1, "cards.0: unknown member \"titel\""},
        {"/steps", Json::array(), "cards.0.steps: expected a step, found none"},
        {"/steps/0/text", 5, "cards.0.steps.0.text: expected text, found 5"},
        {"/steps/0/place", {{"button", "x"}}, "cards.0.steps.0.place: unknown member \"button\""},
        {"/steps/0/place", Json::object(), "cards.0.steps.0.place: expected one of"},
        {"/steps/0/by", Json::array(), "cards.0.steps.0.by: expected a command, found none"},
        {"/steps/0/by/0", {{"name", "x"}}, "cards.0.steps.0.by.0"},
        {"/steps/0/when/0", {{"happens", "x"}}, "cards.0.steps.0.when.0: expected one of"},
        {"/steps/0/when/0", {{"expect", "x"}}, "cards.0.steps.0.when.0: expected exactly one of"},
        {"/steps/0/when/0", {{"present", "x"}, {"above", 1}}, "cards.0.steps.0.when.0: unknown member"},
        {"/steps/0/when/0", {{"avoided", "x"}, {"after", "y"}}, "cards.0.steps.0.when.0"},
        {"/steps/0/script", Json::array(), "cards.0.steps.0.script: expected a line, found none"}};
    for (const Case& each : cases) {
        Json card = good_card();
        card[Json::json_pointer(each.path)] = each.value;
        EXPECT_TRUE(refusal(card).starts_with(each.message)) << each.path << ": " << refusal(card);
    }
    EXPECT_EQ(refusal(good_card()), "");
}

class CardWatch : public testing::Test {
  protected:
    void run(const char* command, const Json& arguments, bool changes = true) {
        note_command(progress_, card_, command, arguments, changes, moment_);
    }
    void move_ball() { run("move", {{"what", "ball"}, {"to", {0, 1, 0}}}); }
    void watch(const Json& state) {
        const auto tell = [&] {
            ++asked_;
            return state;
        };
        watch_card(progress_, card_, part_, tell);
    }
    /// Changes the part and waits until it is checked.
    void change(const Json& state) {
        part_ = std::make_shared<test::TestPart>();
        for (int i = 0; i < 60; ++i) watch(state);
    }
    void use_conditions(const Json& conditions) {
        Json card = good_card();
        card["steps"][0]["when"] = conditions;
        card_ = only(card);
    }
    bool done() const { return !progress_.done.empty() && progress_.done.at(0); }

    struct Flip {
        double at;
        int joint = 0;
        const char* cause = "";
    };
    /// Moves the ball along x in steps of 0.25; each flip comes at its place.
    void drag(double from, double to, double aside, const std::vector<Flip>& flips = {}) {
        const double step = from < to ? 0.25 : -0.25;
        for (double x = from; step * (to - x) >= 0.0; x += step) {
            ++moment_;
            run("move", {{"what", "ball"}, {"to", {x, aside, 0}}});
            for (const Flip& flip : flips)
                if (x == flip.at)
                    state_["events"].push_back(
                        {{"kind", "flip"}, {"tick", moment_}, {"joint", flip.joint}, {"cause", flip.cause}});
            part_ = std::make_shared<test::TestPart>();
            for (int i = 0; i < 3; ++i) watch(state_);
        }
    }

    Json state_{{"events", Json::array()}};
    Card card_ = only(good_card());
    CardProgress progress_;
    std::shared_ptr<const Part> part_ = std::make_shared<test::TestPart>();
    std::uint64_t moment_ = 5;
    int asked_ = 0;
};

TEST_F(CardWatch, ACommandMustHaveTheArgumentsThatMatter) {
    use_conditions(Json::array());
    run("move", {{"what", "cube"}, {"to", {0, 1, 0}}});
    run("move", {{"what", "ball"}, {"speed", 1}});
    run("turn", {{"what", "ball"}, {"to", {0, 1, 0}}});
    EXPECT_FALSE(done());
    run("move", {{"what", "ball"}, {"to", {0, 1, 0}}, {"speed", 1}});
    EXPECT_TRUE(done()) << "others are welcome";
    run("undo", Json::object());
    EXPECT_TRUE(done()) << "what has happened has happened";
}

TEST_F(CardWatch, AStateWithoutTheCommandIsNotEnough) {
    watch({{"x", 1}});
    change({{"x", 1}});
    EXPECT_FALSE(done());
    EXPECT_EQ(asked_, 0) << "nobody needs the state yet";
    move_ball();
    change({{"y", 1}});
    EXPECT_FALSE(done());
    change({{"x", 1}});
    EXPECT_TRUE(done()) << "the result may come later";
}

TEST_F(CardWatch, TheResultMustBeTheCommandsOwn) {
    move_ball();
    change({{"y", 1}});
    run("look", Json::object(), false);
    run("preset", Json::object());
    change({{"x", 1}});
    EXPECT_FALSE(done()) << "that came from the preset";
    move_ball();
    run("look", Json::object(), false);
    change({{"x", 1}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, ACommandThatChangesNothingIsCheckedToo) {
    move_ball();
    change({{"y", 1}});
    move_ball();
    for (int i = 0; i < 60; ++i) watch({{"x", 1}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, AnExpectationIsAsInAScript) {
    use_conditions(Json::array({{{"expect", "a.b"}, {"above", 3}}}));
    move_ball();
    change({{"a", {{"b", 3}}}});
    EXPECT_FALSE(done());
    change({{"a", {{"b", 4}}}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, AnEventMustBeOfThatKindAndComeWithTheCommand) {
    use_conditions(Json::array({{{"event", "flip"}}}));
    const auto event = [](const char* kind, int tick) { return Json{{"kind", kind}, {"tick", tick}}; };
    move_ball();
    change({{"events", Json::array({event("flip", 4)})}});
    EXPECT_FALSE(done()) << "that was before";
    change({{"events", Json::array({event("flip", 4), event("limit", 8)})}});
    EXPECT_FALSE(done());
    moment_ = 9;
    move_ball();
    change({{"events", Json::array({event("flip", 4), event("flip", 7), event("limit", 8)})}});
    EXPECT_TRUE(done()) << "of the same drag";
}

TEST_F(CardWatch, ADragRepeatedAfterACureMustLeadPastThePlaceAndCauseNothing) {
    use_conditions(Json::array({{{"avoided", "flip"}, {"after", "cure"}, {"within", 0.5}}}));
    drag(-1, 1, 0);
    run("cure", Json::object());
    drag(1, -1, 0);
    EXPECT_FALSE(done()) << "nothing had happened before the cure";
    drag(-1, 1, 0, {{0}});
    drag(1, -1, 0);
    EXPECT_FALSE(done()) << "no cure came first";
    run("cure", Json::object());
    EXPECT_FALSE(done());
    drag(-1, 0, 0);
    EXPECT_FALSE(done()) << "not yet past it";
    drag(-0.25, -1, 0);
    drag(-1, 1, 0.75);
    EXPECT_FALSE(done()) << "somewhere else";
    drag(1, -1, 0.25, {{0.25}});
    EXPECT_FALSE(done()) << "it flipped again";
    drag(-1, 1, 0.25);
    EXPECT_FALSE(done()) << "which needs another cure";
    run("cure", Json::object());
    drag(1, -1, 0);
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, AnotherFlipAfterTheCureOnlyAsksForAnotherPass) {
    use_conditions(Json::array({{{"avoided", "flip"}, {"after", "cure"}, {"within", 0.5}}}));
    const auto begin = [&] {
        progress_ = {};
        drag(-1, 1, 0, {{0, 1, "passed the pole"}});
        run("cure", Json::object());
    };
    begin();
    drag(1, -1, 0, {{0.75, 3, "another pose"}});
    EXPECT_TRUE(done()) << "before it came to the place";
    begin();
    drag(1, -1, 0, {{0, 3, "another pose"}});
    EXPECT_FALSE(done()) << "where it passed";
    drag(-1, 1, 0);
    EXPECT_TRUE(done()) << "without another cure";
    for (const Flip again : {Flip{0.75, 1, "another pose"}, Flip{0.75, 3, "passed the pole"}}) {
        begin();
        drag(1, -1, 0, {again});
        drag(-1, 1, 0);
        EXPECT_FALSE(done()) << again.joint << ": it came back, which needs another cure";
    }
}

TEST_F(CardWatch, TheStateIsRequestedOnlyAfterChanges) {
    move_ball();
    watch({{"y", 1}});
    EXPECT_EQ(asked_, 1);
    for (int i = 0; i < 100; ++i) watch({{"y", 1}});
    EXPECT_EQ(asked_, 1);
    change({{"y", 1}});
    EXPECT_EQ(asked_, 2);
}

TEST_F(CardWatch, NothingIsRequestedOnceAllIsDone) {
    move_ball();
    change({{"x", 1}});
    ASSERT_TRUE(done());
    const int asked = asked_;
    change({{"x", 3}});
    EXPECT_EQ(asked_, asked);
}

}  // namespace
}  // namespace tendril::app
