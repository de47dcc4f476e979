
#include "app/document/json_complete.hpp"
#include "tests/app/script/script_support.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

using test::has;

const Json state = parse_json(R"({
    "lab": "chain", "index": 3, "big": 16777217, "playing": true, "nothing": null, "half": 0.5, "tenth": 0.1,
    "tail": [1.0, 2.0, 0.0], "segments": [{"position": [0, 0, 0], "length": 1.0}, {"position": [1, 0, 0], "length": 0.25}],
    "huge": 1e300, "3": "three", "": "empty"})");

/// The fault that the expectation in this line finds.
std::string found(const std::string& line) {
    const Script script = test::parse(line);
    return check_expectation(std::get<Expect>(script.lines.at(0).action), state);
}

TEST(Expect, FindsValuesByTheirPath) {
    EXPECT_EQ(*find_in_state(state, "lab"), "chain");
    EXPECT_EQ(*find_in_state(state, "segments.1.length"), 0.25);
    EXPECT_EQ(*find_in_state(state, "segments.0.position.2"), 0);
    EXPECT_EQ(*find_in_state(state, "3"), "three");
    EXPECT_EQ(find_in_state(state, ""), &state);
    for (const char* path :
         {"nowhere", "segments.2", "segments.-1", "segments.one", "segments. 1", "segments.1x", "segments.",
          "segments.99999999999999999999", "lab.0", "tail.0.x", "index.0", ".lab", "lab."})
        EXPECT_EQ(find_in_state(state, path), nullptr) << path;
}

TEST(Expect, OneThatHoldsIsSilent) {
    for (const char* line :
         {R"({"expect": "lab", "equals": "chain"})", R"({"expect": "index", "equals": 3})",
          R"({"expect": "index", "equals": 3.0})", R"({"expect": "tenth", "equals": 0.10000000149011612})",
          R"({"expect": "tail", "equals": [1, 2, 0]})",
          R"({"expect": "segments.1", "equals": {"length": 0.25, "position": [1, 0, 0]}})",
          R"({"expect": "nothing", "equals": null})", R"({"expect": "playing", "equals": true})",
          R"({"expect": "huge", "equals": 1e300})",
          R"({"expect": "tail", "near": [1, 2, 0.001], "within": 0.0010001})",
          R"({"expect": "half", "near": 0.50009})", R"({"expect": "half", "near": 0.5, "within": 0})",
          R"({"expect": "half", "below": 0.51})", R"({"expect": "half", "above": 0.49})"})
        EXPECT_EQ(found(line), "") << line;
}

TEST(Expect, OneThatFailsReportsTheActualValue) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"({"expect": "lab", "equals": "rope"})", "expected lab to be \"rope\", found \"chain\""},
        {R"({"expect": "index", "equals": 4})", "expected index to be 4, found 3"},
        {R"({"expect": "index", "equals": "3"})", "expected index to be \"3\", found 3"},
        {R"({"expect": "big", "equals": 16777216})", "expected big to be 16777216, found 16777217"},
        {R"({"expect": "playing", "equals": 1})", "expected playing to be 1, found true"},
        {R"({"expect": "tenth", "equals": 0.1000001})", "expected tenth to be 0.1000001, found 0.1"},
        {R"({"expect": "huge", "equals": 1e301})", "expected huge to be 1e+301, found 1e+300"},
        {R"({"expect": "nothing", "equals": false})", "expected nothing to be false, found null"},
        {R"({"expect": "tail", "equals": [1, 2]})", "expected tail to be [1,2], found [1.0,2.0,0.0]"},
        {R"({"expect": "tail", "equals": [1, 2, 0, 0]})",
         "expected tail to be [1,2,0,0], found [1.0,2.0,0.0]"},
        {R"({"expect": "segments.1", "equals": {"length": 0.25, "position": [1, 0, 0], "x": 1}})", "\"x\":1"},
        {R"({"expect": "tail", "equals": [1, 2, 1]})", "expected tail to be [1,2,1], found [1.0,2.0,0.0]"},
        {R"({"expect": "segments.1", "equals": {"length": 0.25}})",
         "expected segments.1 to be {\"length\":0.25}, found "},
        {R"({"expect": "segments.1", "equals": {"length": 0.25, "other": [1, 0, 0]}})",
         "expected segments.1"},
        {R"({"expect": "tail", "near": [1, 2, 3], "within": 0.5})",
         "expected tail to be [1,2,3] within 0.5, found [1.0,2.0,0.0], off by 3.0"},
        {R"({"expect": "tail", "near": [1.0001, 2.0001, 0]})", "off by 0.000141"},
        {R"({"expect": "tail", "near": [1, 2]})",
         "expected tail to be [1,2] within 0.0001, found [1.0,2.0,0.0]"},
        {R"({"expect": "lab", "near": 1})", "found \"chain\""},
        {R"({"expect": "segments", "near": [1, 2]})", "expected segments to be [1,2] within"},
        {R"({"expect": "half", "below": 0.5})", "expected half to be below 0.5, found 0.5"},
        {R"({"expect": "half", "above": 0.5})", "expected half to be above 0.5, found 0.5"},
        {R"({"expect": "lab", "above": 0})", "expected lab to be above 0, found \"chain\""},
        {R"({"expect": "segments.7.length", "equals": 1})",
         "expected segments.7.length to be 1, but the state has no such value"},
    };
    for (const auto& [line, message] : cases) {
        EXPECT_TRUE(has(found(line), message));
        EXPECT_FALSE(has(found(line), "\n"));
    }
}

}  // namespace
}  // namespace tendril::app
