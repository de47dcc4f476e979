// A list read value by value: equivalent to parsing it whole, with the same texts refused.
#include "app/document/list_reader.hpp"

#include <gtest/gtest.h>

#include <random>

#include "app/document/json_complete.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::message_of;

Json read_all(const std::string& text) {
    ListReader list(text, "cases");
    Json all = Json::array(), value;
    while (list.next(value)) {
        EXPECT_EQ(list.index(), all.size());
        all.push_back(value);
    }
    EXPECT_FALSE(list.next(value));
    EXPECT_EQ(list.progress(), 1.0);
    return all;
}

TEST(ListReader, ReadsWhatTheParserReads) {
    for (const char* text :
         {"[]", " [ ] ", "[1]", "[1,2]", "\xef\xbb\xbf[1]", "[\"a]\",\"b\\\"]\",[],{}]",
          "[ {\"a\":[1,{\"b\":\"}\"}]} ,\n\t[[[]]], null,true , -1.5e3 ]\n", "[\"\\\\\", 1]"}) {
        EXPECT_EQ(read_all(text), parse_json(text)) << text;
    }
}

TEST(ListReader, RefusesOtherTextAndReportsTheLine) {
    const auto refusal = [](const std::string& text) { return message_of([&] { read_all(text); }); };
    EXPECT_TRUE(test::says(refusal("[1,\n2,\n]"), "line 3 value"));
    EXPECT_TRUE(test::says(refusal("[1\n,2,\n"), "line 3 text list"));
    EXPECT_TRUE(test::says(refusal("[\n1,\n\nnan]"), "line 4 na"));
    EXPECT_EQ(refusal("[\n{}}]"), "line 2: unexpected '}'");
    EXPECT_TRUE(test::says(refusal("[]\n1"), "line 2 after list"));
    EXPECT_TRUE(test::says(refusal("{\"a\": 1}"), "cases list {\"a\":1}"));
    EXPECT_TRUE(test::has(refusal("[1, " + std::string(99, '[') + std::string(99, ']') + "]"),
                          "nested deeper than 64"));
}

// For texts truncated and modified at random, reads or refuses exactly what the parser does.
TEST(ListReader, RefusesWhateverTheParserRefuses) {
    const std::string sound = R"([{"name":"a","lengths":[1,2.5],"x":"]}\"["},[],"t",null, {"b":{}}, -3])";
    std::mt19937 random(11);
    int taken = 0;
    for (int i = 0; i < 30'000; ++i) {
        std::string text = sound;
        for (int changes = 1 + static_cast<int>(random() % 3); changes > 0; --changes) {
            const std::size_t at = random() % text.size();
            if (random() % 2 == 0)
                text.erase(at, 1 + random() % 3);
            else
                text[at] = "[]{},:\"\\ 1tn\n"[random() % 13];
            if (text.empty()) text.push_back('[');
        }
        Json whole, parts;
        const bool sane = message_of([&] { whole = parse_json(text); }).empty() && whole.is_array();
        const bool read = message_of([&] { parts = read_all(text); }).empty();
        ASSERT_EQ(read, sane) << text;
        if (sane) {
            ASSERT_EQ(parts, whole) << text;
        }
        taken += sane;
    }
    EXPECT_GT(taken, 100);
}

TEST(ListReader, ReportsTheLineOfAValue) {
    const std::string text = "[\n{},\n{\"lengths\":\n [1,\n 2]}]";
    ListReader list(text, "cases");
    Json value;
    list.next(value);
    list.next(value);
    EXPECT_EQ(list.place(), "cases.1");
    EXPECT_EQ(list.line_of("cases.1"), 3);
    EXPECT_EQ(list.line_of("cases.1.lengths.1"), 5);
    EXPECT_EQ(list.line_of("cases.1.missing"), 3);
}

}  // namespace
}  // namespace tendril::app
