// Cards: their files, and when their steps count as done.
#include "app/labs/card.hpp"

#include <gtest/gtest.h>

#include "app/document/json_complete.hpp"
#include "app/shell/card_watch.hpp"
#include "tests/app/support/test_part.hpp"

namespace tendril::app {
namespace {

Json good_step() {
    return {{"text", "Do it."},
            {"place", {{"handle", "target"}}},
            {"when", Json::array({{{"changed", "x"}}})},
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

TEST(CardFile, is_read) {
    const Card card = only(good_card());
    ASSERT_EQ(card.steps.size(), 1u);
    EXPECT_EQ(card.steps[0].text, "Do it.");
    EXPECT_EQ(card.steps[0].place, CardStep::Place::Handle);
    EXPECT_EQ(card.steps[0].place_name, "target");
    ASSERT_EQ(card.steps[0].when.size(), 1u);
    EXPECT_EQ(card.steps[0].when[0].kind, CardCondition::Kind::Changed);
}

TEST(CardFile, that_is_broken_is_refused_with_its_place) {
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
        {"/steps/0/when", Json::array(), "cards.0.steps.0.when: expected a condition, found none"},
        {"/steps/0/when/0", {{"happens", "x"}}, "cards.0.steps.0.when.0: expected one of"},
        {"/steps/0/when/0", {{"expect", "x"}}, "cards.0.steps.0.when.0: expected exactly one of"},
        {"/steps/0/when/0", {{"changed", "x"}, {"above", 1}}, "cards.0.steps.0.when.0: unknown member"},
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
    void use_condition(const Json& condition) {
        Json card = good_card();
        card["steps"][0]["when"] = Json::array({condition});
        card_ = only(card);
    }
    bool done() const { return progress_.done.at(0); }

    Card card_ = only(good_card());
    CardProgress progress_;
    std::shared_ptr<const Part> part_ = std::make_shared<test::TestPart>();
    int asked_ = 0;
};

TEST_F(CardWatch, a_value_must_differ_from_what_it_was_when_the_card_was_shown) {
    watch({{"x", 1}});
    EXPECT_FALSE(done());
    change({{"x", 1}});
    EXPECT_FALSE(done());
    change({{"x", 2}});
    EXPECT_TRUE(done());
    change({{"x", 1}});
    EXPECT_TRUE(done()) << "what has happened has happened";
}

TEST_F(CardWatch, an_expectation_is_one_of_a_script) {
    use_condition({{"expect", "a.b"}, {"above", 3}});
    watch({{"a", {{"b", 3}}}});
    EXPECT_FALSE(done());
    change({{"a", {{"b", 4}}}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, an_event_must_be_of_that_kind_and_new) {
    use_condition({{"event", "flip"}});
    const auto event = [](const char* kind, int tick) { return Json{{"kind", kind}, {"tick", tick}}; };
    watch({{"time", {{"moment", 5}}}, {"events", Json::array({event("flip", 4)})}});
    EXPECT_FALSE(done()) << "that was before the card was shown";
    change({{"time", {{"moment", 9}}}, {"events", Json::array({event("flip", 4), event("limit", 8)})}});
    EXPECT_FALSE(done());
    change({{"time", {{"moment", 9}}}, {"events", Json::array({event("limit", 8), event("flip", 9)})}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, an_event_is_new_where_time_began_anew) {
    use_condition({{"event", "flip"}});
    watch({{"time", {{"moment", 500}}}, {"events", Json::array({{{"kind", "flip"}, {"tick", 490}}})}});
    change({{"time", {{"moment", 3}}}, {"events", Json::array({{{"kind", "flip"}, {"tick", 2}}})}});
    EXPECT_TRUE(done());
}

TEST_F(CardWatch, the_state_is_asked_for_only_when_the_part_is_another) {
    watch({{"x", 1}});
    EXPECT_EQ(asked_, 1);
    for (int i = 0; i < 100; ++i) watch({{"x", 1}});
    EXPECT_EQ(asked_, 1);
    change({{"x", 1}});
    EXPECT_EQ(asked_, 2);
}

TEST_F(CardWatch, nothing_is_asked_once_all_is_done) {
    watch({{"x", 1}});
    change({{"x", 2}});
    ASSERT_TRUE(done());
    const int asked = asked_;
    change({{"x", 3}});
    EXPECT_EQ(asked_, asked);
}

}  // namespace
}  // namespace tendril::app
