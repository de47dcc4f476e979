#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "app/io/json_complete.hpp"
#include "app/io/json_scan.hpp"
#include "tests/app/support/child.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::message_of;

std::string parse_message(std::string_view text) {
    return message_of([&] { parse_json(text); });
}

TEST(Json, ANumberHasTheFewestDecimalsThatReadBack) {
    EXPECT_EQ(number(0.1f).dump(), "0.1");
    EXPECT_EQ(number(1.0f).dump(), "1.0");
    EXPECT_EQ(number(-0.0f).dump(), "-0.0");
    EXPECT_EQ(number(16777216.0f).dump(), "16777216.0");
    EXPECT_EQ(point({0.1f, 0.0f, -2.5f}).dump(), "[0.1,0.0,-2.5]");
}

TEST(Json, EveryFloatComesBackBitForBitThroughText) {
    // The one float whose shortest decimals round to another float if read as a double first.
    EXPECT_EQ(parse_json(number(0x1.5c87fap-84f).dump()).get<float>(), 0x1.5c87fap-84f);
    std::mt19937 random(1);
    for (int i = 0; i < 200'000; ++i) {
        const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
        if (!std::isfinite(value)) continue;
        const float back = parse_json(number(value).dump()).get<float>();
        ASSERT_EQ(std::bit_cast<std::uint32_t>(back), std::bit_cast<std::uint32_t>(value))
            << number(value).dump();
    }
}

TEST(Json, AnAngleIsInDegreesAndComesBackBitForBit) {
    EXPECT_EQ(degrees(static_cast<float>(std::numbers::pi / 2)).dump(), "90.0");
    EXPECT_EQ(json_degrees(Json(180), ""), static_cast<float>(std::numbers::pi));
    std::mt19937 random(2);
    std::uniform_real_distribution<float> any(-10.0f, 10.0f);
    for (int i = 0; i < 100'000; ++i) {
        const float radians = any(random);
        ASSERT_EQ(json_degrees(parse_json(degrees(radians).dump()), ""), radians);
    }
}

TEST(Json, ErrorsNameTheLineAndAShortReason) {
    EXPECT_TRUE(has(parse_message(""), "line 1: unexpected end of input"));
    EXPECT_TRUE(has(parse_message("{\n \"a\": 1,\n \"b\" 2}"), "line 3: unexpected number"));
    EXPECT_TRUE(has(parse_message("[1,\n2,\n"), "line 3: unexpected end of input"));
    EXPECT_TRUE(test::says(parse_message("[1,\n1e999]"), "line 2 number 1e999"));
    EXPECT_TRUE(has(parse_message("[\n\n\"a\xff\"]"), "line 3: a text has bytes that are not UTF-8"));
    EXPECT_TRUE(has(parse_message("[1,\n\"a\nb\"]"), "line 2: a text has a line break"));
    EXPECT_TRUE(has(parse_message("1 2"), "line 1: unexpected number"));
    EXPECT_TRUE(has(parse_message("nul"), "line 1: expected a value, found 'nul'"));
    for (const char* bad :
         {"", "{", "[1,]", "{\"a\":}", "\"\\x\"", "01", "NaN", "Infinity", "// a", "{a:1}", "\x01"}) {
        const std::string message = parse_message(bad);
        EXPECT_TRUE(message.starts_with("line 1: ")) << bad << " gives " << message;
        EXPECT_LT(message.size(), 160u) << bad;
    }
}

/// The messages are ours, not the library's.
TEST(Json, ErrorsDescribeAnyDamage) {
    const std::string good = R"({"a": [1, -2.5e3, true, null, "\u00e4 \n"], "b": {"c": "text"}, "d": false})";
    const std::string alphabet = "\"\\{}[]:,-.0eEntfu/ab\n\t\x01\xff\xc3 ";
    std::mt19937 random(53);
    for (int i = 0; i < 20'000; ++i) {
        std::string bad = good.substr(0, 1 + random() % good.size());
        for (int n = 0; n < 2; ++n) bad[random() % bad.size()] = alphabet[random() % alphabet.size()];
        const std::string message = parse_message(bad);
        for (const char* word :
             {"json.exception", "literal", "last read", "syntax", "invalid", "not JSON", "<"})
            ASSERT_EQ(message.find(word), message.npos) << bad << " gives " << message;
    }
}

TEST(Json, AnErrorInALongOrStrangeTokenIsOneShortPrintableLine) {
    const std::string message = parse_message('"' + std::string(1 << 20, 'a') + "\xff\n\x1b[31m\"");
    EXPECT_LT(message.size(), 160u);
    for (const char c : message) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(Json, NestingOf64IsReadAndOf65Refused) {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_EQ(parse_message(nested(64)), "");
    EXPECT_TRUE(test::says(parse_message(nested(65)), "line 1 nested 64"));
    std::string objects;
    for (int i = 0; i < 65; ++i) objects += "{\"a\":\n";
    EXPECT_TRUE(test::says(parse_message(objects), "line 65 nested 64"));
}

TEST(Json, BracketsInStringsAreNotNesting) {
    const std::string brackets(100, '[');
    EXPECT_EQ(parse_json("\"" + brackets + "\"").get<std::string>(), brackets);
    EXPECT_EQ(parse_json("\"\\\"" + brackets + "\"").get<std::string>(), '"' + brackets);
    EXPECT_EQ(parse_json("[\"\\\\\", \"" + brackets + "\"]")[1].get<std::string>(), brackets);
    EXPECT_TRUE(test::says(parse_message("[\"\\\\\"" + brackets), "line 1 nested 64"));
}

TEST(Json, TheLastOfRepeatedMembersWins) {
    EXPECT_EQ(parse_json(R"({"a": 1, "b": 2, "a": 3, "a": {"a": 4}})").dump(), R"({"b":2,"a":{"a":4}})");
    EXPECT_EQ(parse_json(R"([{}, {"": 1}, [[], null, true, -1, 1.5, "x"]])").dump(),
              R"([{},{"":1},[[],null,true,-1,1.5,"x"]])");
}

TEST(Json, AFileOfOnlyKeysParsesQuickly) {
    std::string text = "{\"k\":0";
    for (int i = 0; i < 300'000; ++i) text += ",\"k" + std::to_string(i % 200'000) + "\":1";
    EXPECT_EQ(parse_json(text + '}').size(), 200'001u);  // hours if each key were compared with all before it
}

TEST(Json, FormattedTextReadsBackTheSame) {
    const Json json =
        parse_json(R"({"a": {}, "b": [], "long": [[1, 2, 3.5], "very long text that goes on and on and on",
        {"key \"quoted\"": null, "another": "very long text that goes on and on and on", "empty": ""}], "last": true})");
    const std::string text = json_to_text(json);
    EXPECT_EQ(parse_json(text), json);
    EXPECT_TRUE(has(text, "\n  [1,2,3.5],\n"));
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(json_to_text(Json("\xff")), "\"\xEF\xBF\xBD\"\n");
}

TEST(Json, ALineIsFoundByItsPath) {
    const std::string_view text =
        "{\n"
        " \"a\": {\"x\": 1,\n"
        "   \"y\": [\"],\\\"{\",\n"
        "      {\"z\" : 5}]\n"
        " },\n"
        " \"b\"\n:\n {}\n"
        "}\n";
    using Path = std::pair<const char*, int>;
    for (const auto& [path, line] : {Path{"a", 2}, Path{"a.x", 2}, Path{"a.y", 3}, Path{"a.y.1", 4},
                                     Path{"a.y.1.z", 4}, Path{"a.y.7", 3},  // the last part that is there
                                     Path{"a.x.nothing", 2}, Path{"b", 8}, Path{"c", 0}, Path{"", 0}})
        EXPECT_EQ(json_line(text, path), line) << path;
    EXPECT_EQ(json_line("", "a"), 0);
}

TEST(Json, TypedReadsReportPathAndReason) {
    const Json json =
        parse_json(R"({"n": 1.5, "i": 3, "w": 4.0, "t": "text", "b": true, "p": [1, 2, 3], "big": 1.1e9})");
    EXPECT_EQ(json_number(json["n"], "n"), 1.5f);
    EXPECT_EQ(json_integer(json["i"], "i", 0, 3), 3);
    EXPECT_EQ(json_integer(json["w"], "w", 0, 9), 4);
    EXPECT_EQ(json_text(json["t"], "t"), "text");
    EXPECT_TRUE(json_bool(json["b"], "b"));
    EXPECT_EQ(json_point(json["p"], "p"), glm::vec3(1, 2, 3));

    const auto message = [](auto action) { return message_of(action); };
    const auto says = [](auto action, const char* words) {
        EXPECT_TRUE(test::says(message_of(action), words));
    };
    EXPECT_EQ(message([&] { json_member(json, "x", "labs.a"); }), "labs.a: \"x\" is missing");
    EXPECT_EQ(message([&] { json_member(json, "x", ""); }), "\"x\" is missing");
    says([&] { json_member(json["n"], "x", "n"); }, "n object 1.5");
    says([&] { json_number(json["t"], "t"); }, "t number text");
    says([&] { json_number(json["big"], "big"); }, "big number 1e9 1100000000.0");
    says([&] { json_number(json["n"], "n", 2.0f, 3.0f); }, "n number 2 3 1.5");
    EXPECT_EQ(json_real(json["big"], "big", 0.0, 1e12), 1.1e9) << "its ends say how large it may be";
    says([&] { json_real(json["big"], "big"); }, "big number 1e9 1100000000.0");
    says([&] { json_real(json["big"], "big", 0.0, 1e9); }, "big number 0 1000000000 1100000000.0");
    says([&] { json_integer(json["n"], "n", 0, 9); }, "n whole number 0 9 1.5");
    says([&] { json_integer(json["i"], "i", 0, 2); }, "i whole number 0 2 3");
    says([&] { json_integer(Json(1e300), "i", 0, 2); }, "i whole number 0 2 1e+300");
    says([&] { json_bool(json["i"], "i"); }, "i true false 3");
    says([&] { json_text(json["b"], "b"); }, "b text true");
    says([&] { json_point(Json::array({1, 2}), "p"); }, "p point [1,2]");
    says([&] { json_point(Json::array({1, 2, "3"}), "p"); }, "p number 3");
    says([&] { json_text(Json(std::vector<int>(1000)), "t"); }, "t text list 1000");
    says([&] { json_number(Json(std::string(1000, 'x')), "t"); }, "t number long string");
    says([&] { json_number(Json(std::nan("")), "t"); }, "t number 1e9 null");
}

// Reading files that are missing, endless, too large or too deep, and the memory that this takes.

using test::TempFolder;

struct JsonFile : testing::Test {
    const TempFolder folder;
};

std::string read_message(const std::filesystem::path& path) {
    return message_of([&] { read_text_file(path); });
}

TEST_F(JsonFile, IsReadWithItsPathAndLineInErrors) {
    test::write(folder / "good.json", "{\"a\": 1}\n");
    EXPECT_EQ(read_json_file(folder / "good.json")["a"], 1);
    test::write(folder / "bad.json", "{\n\"a\": ]}\n");
    EXPECT_TRUE(
        has(message_of([&] { read_json_file(folder / "bad.json"); }), "bad.json: line 2: unexpected ']'"));
}

TEST_F(JsonFile, RefusesPathsThatAreNotFiles) {
    EXPECT_TRUE(has(read_message(folder / "missing"), "missing: No such file or directory"));
    EXPECT_TRUE(has(read_message(folder.path()), ": is a folder"));
    EXPECT_TRUE(has(read_message(folder / "a" / "b"), ": No such file or directory"));
    EXPECT_TRUE(has(read_message(""), "No such file or directory"));
    EXPECT_TRUE(has(read_message(std::string("a\0b", 3)), "not a file name"));
    EXPECT_EQ(read_text_file("/dev/null"), "");
}

TEST_F(JsonFile, Of64MegabytesIsReadAndOneByteMoreRefused) {
    const auto path = folder / "large";
    test::write(path, "");
    std::filesystem::resize_file(path, max_file_bytes);
    EXPECT_EQ(read_text_file(path).size(), max_file_bytes);
    std::filesystem::resize_file(path, max_file_bytes + 1);
    EXPECT_TRUE(has(read_message(path), "large: larger than 64 MB"));
}

TEST_F(JsonFile, WithoutAnEndIsRefused) {
    EXPECT_TRUE(test::says(read_message("/dev/zero"), "/dev/zero larger 64 MB"));
}

TEST_F(JsonFile, MayBeAPipe) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::thread writer([&] { test::write(pipe, "{\"a\": [" + std::string(200'000, ' ') + "7]}"); });
    const Json json = read_json_file(pipe);
    writer.join();
    EXPECT_EQ(json["a"][0], 7);
}

TEST_F(JsonFile, DoesNotWaitForeverForAPipeWithoutWriter) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_TRUE(test::says(read_message(pipe), "pipe nothing came through this pipe for 5 s"));
}

TEST_F(JsonFile, Of100MegabytesOfBracketsIsRefusedInNoMemory) {
    const auto path = folder / "brackets.json";
    const std::string block(1 << 20, '[');
    for (int i = 0; i < 100; ++i) std::ofstream(path, std::ios::app | std::ios::binary) << block;
    const int result = test::in_child([&] {
        const long before = test::peak_megabytes();
        const std::string message = message_of([&] { read_json_file(path); });
        if (message.find("larger than 64 MB") == message.npos) return 100;
        return static_cast<int>(std::min(99L, test::peak_megabytes() - before));
    });
    EXPECT_LT(result, 8 * test::sanitizer_factor) << "megabytes, or 100 and more for the wrong answer";
    EXPECT_GE(result, 0);
}

TEST_F(JsonFile, Of60MegabytesOfBracketsIsRefusedInTheMemoryOfItsText) {
    const std::string brackets(60 << 20, '[');
    const int result = test::in_child([&] {
        const long before = test::peak_megabytes();
        if (message_of([&] { parse_json(brackets); }) != "line 1: nested deeper than 64") return 100;
        return static_cast<int>(std::min(99L, test::peak_megabytes() - before));
    });
    EXPECT_LT(result, 8 * test::sanitizer_factor);
    EXPECT_GE(result, 0);
}

// A list read value by value: equivalent to parsing it whole, with the same texts refused.

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
    for (int i = 0; i < test::rounds(30'000); ++i) {
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
    EXPECT_GT(taken, test::rounds(100));
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
