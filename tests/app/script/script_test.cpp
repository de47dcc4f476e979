
#include "app/io/json_complete.hpp"
#include "app/script/recorder.hpp"
#include "tests/app/script/script_support.hpp"
#include "tests/app/support/temp_folder.hpp"
#include "tests/labels.hpp"
#include "tests/places.hpp"
#include "tests/says.hpp"

namespace tendril::app {
namespace {

using test::has;
using test::message_of;
using test::parse;

template <class T>
T only(std::string_view line) {
    const Script script = parse(line);
    EXPECT_EQ(script.lines.size(), 1u);
    return std::get<T>(script.lines.at(0).action);
}

template <class T>
T only_event(std::string_view line) {
    return std::get<T>(only<Event>(line));
}

std::string refusal(std::string_view text) {
    return message_of([&] { parse(text); });
}

TEST(Script, HasLinesForCommands) {
    const auto run = only<RunCommand>(R"({"command": "chain.mode", "mode": "with_index", "index": 3})");
    EXPECT_EQ(run.name, "chain.mode");
    EXPECT_EQ(run.arguments->dump(), R"({"mode":"with_index","index":3})");
    EXPECT_FALSE(run.expect_refusal);
    const auto refused = only<RunCommand>(R"({"refused": true, "command": "undo", "index": 1})");
    EXPECT_TRUE(refused.expect_refusal);
    EXPECT_EQ(refused.arguments->dump(), R"({"index":1})");
    EXPECT_FALSE(only<RunCommand>(R"({"command": "undo", "refused": false})").expect_refusal);
    EXPECT_EQ(only<RunCommand>(R"({"command": "undo"})").arguments->dump(), "{}");
    // An argument may have the name of another kind of line.
    EXPECT_EQ(
        only<RunCommand>(R"({"key": 1, "command": "undo", "wait": 2, "recording": 3})").arguments->size(),
        3u);
}

TEST(Script, HasLinesForTheMouse) {
    EXPECT_EQ(only_event<MouseMove>(R"({"mouse": "move", "at": [640, 360.25]})").at,
              glm::vec2(640.0f, 360.25f));
    const auto down = only_event<MousePress>(R"({"mouse": "down", "button": "left"})");
    EXPECT_TRUE(down.down && down.button == MouseButton::Left);
    const auto up = only_event<MousePress>(R"({"mouse": "up", "button": "right"})");
    EXPECT_TRUE(!up.down && up.button == MouseButton::Right);
    EXPECT_EQ(only_event<MousePress>(R"({"mouse": "up", "button": "middle"})").button, MouseButton::Middle);
    EXPECT_EQ(only_event<MouseWheel>(R"({"mouse": "wheel", "by": -2})").by, -2.0f);
    EXPECT_EQ(only_event<MouseWheel>(R"({"mouse": "wheel", "by": -2})").sideways, 0.0f) << "an old recording";
    EXPECT_EQ(only_event<MouseWheel>(R"({"mouse": "wheel", "by": 0, "sideways": 1.5})").sideways, 1.5f);
}

TEST(Script, HasLinesForKeysAndText) {
    EXPECT_TRUE(only_event<KeyTap>(R"({"key": "ctrl+z"})").chord == (Chord{.key = Key::Z, .ctrl = true}));
    EXPECT_TRUE(only_event<KeyTap>(R"({"key": "Shift+Ctrl+Z"})").chord ==
                (Chord{.key = Key::Z, .ctrl = true, .shift = true}));
    const auto down = only_event<KeyChange>(R"({"key": "x", "action": "down"})");
    EXPECT_TRUE(down.down && down.key == Key::X);
    const auto up = only_event<KeyChange>(R"({"key": "shift", "action": "up"})");
    EXPECT_TRUE(!up.down && up.key == Key::Shift);
    EXPECT_EQ(only_event<TextInput>(R"({"text": "0.5"})").utf8, "0.5");
}

TEST(Script, HasLinesForTheWindow) {
    EXPECT_EQ(only_event<Resize>(R"({"resize": [800, 600]})").size, glm::ivec2(800, 600));
    EXPECT_EQ(only_event<Resize>(R"({"resize": [1, 16384]})").size, glm::ivec2(1, 16384));
    EXPECT_EQ(only_event<Drop>(R"({"drop": ["a.json", "b"]})").paths,
              (std::vector<std::string>{"a.json", "b"}));
    EXPECT_FALSE(only_event<Focus>(R"({"focus": false})").focused);
}

TEST(Script, HasLinesForTimePicturesAndStates) {
    EXPECT_EQ(only<Wait>(R"({"wait": 30})").ticks, 30);
    EXPECT_EQ(only<Wait>(R"({"wait": 0})").ticks, 0);
    EXPECT_EQ(only<TakeScreenshot>(R"({"screenshot": "after.png"})").path, "after.png");
    EXPECT_EQ(only<WriteState>(R"({"state": "after.json"})").path, "after.json");
}

TEST(Script, HasLinesForExpectations) {
    using Measure = Expect::Measure;
    const auto near = only<Expect>(R"({"expect": "tail", "near": [1, 2, 0], "within": 0.001})");
    EXPECT_TRUE(near.measure == Measure::Near && near.path == "tail" && near.within == 0.001);
    EXPECT_EQ(*near.value, Json::array({1, 2, 0}));
    EXPECT_EQ(only<Expect>(R"({"expect": "x", "near": 1})").within, 1e-4);
    EXPECT_TRUE(only<Expect>(R"({"expect": "segments.3.length", "equals": 0.5})").measure == Measure::Equals);
    EXPECT_EQ(*only<Expect>(R"({"expect": "mode", "equals": {"a": [null]}})").value,
              Json({{"a", {nullptr}}}));
    EXPECT_TRUE(only<Expect>(R"({"expect": "x", "below": 1})").measure == Measure::Below);
    EXPECT_TRUE(only<Expect>(R"({"expect": "x", "above": -1.5})").measure == Measure::Above);
}

TEST(Script, NumbersItsLinesAsInTheFile) {
    const Script script = parse("\n{\"wait\": 1}\r\n  \t\n\n{\"wait\": 2}");
    ASSERT_EQ(script.lines.size(), 2u);
    EXPECT_EQ(script.lines[0].number, 2);
    EXPECT_EQ(script.lines[1].number, 5);
    EXPECT_FALSE(script.start);
    EXPECT_TRUE(parse("").lines.empty());
    EXPECT_TRUE(refusal("{\"wait\": 1}\n\n{\"wait\": }\n").starts_with("line 3: unexpected '}'"));
    EXPECT_TRUE(test::says(refusal("{\"wait\": 1}\n{\"wait\": -1}\nnonsense"),
                           "line 2 wait whole number 0 1000000 -1"));
}

constexpr const char* recording =
    R"({"recording": 1, "version": "0.1.0", "size": [640, 480], "lab": "chain", "scene": {"a": 1}, "settings": {"b": 2}})";

TEST(Script, OtherRecordingsAreRefused) {
    EXPECT_TRUE(test::says(refusal(R"({"recording": 2, "news": 1})"), "line 1 recording version 2 1"));
    EXPECT_TRUE(has(refusal(std::string(recording) + '\n' + recording),
                    "line 2: a recording's start must be the first line"));
    EXPECT_TRUE(has(refusal(std::string("{\"wait\": 1}\n") + recording),
                    "line 2: a recording's start must be the first"));
    const Json whole = parse_json(recording);
    for (const auto& [key, value] : whole.items()) {
        Json without = whole;
        without.erase(key);
        EXPECT_NE(refusal(without.dump()), "") << key;
        for (const Json& wrong : {Json(nullptr), Json(-1.5), Json::array(), Json::array({0, 1})}) {
            Json changed = whole;
            changed[key] = wrong;
            EXPECT_TRUE(has(refusal(changed.dump()), "line 1: " + key + ": ")) << changed;
        }
    }
    Json extra = whole;
    extra["more"] = 1;
    EXPECT_TRUE(test::says(refusal(extra.dump()), "line 1 unknown more"));
}

TEST(Script, AnInvalidLineIsRefusedWithTheReason) {
    std::ifstream file(test::source_path("tests/app/data/invalid_lines.txt"));  // its reason is below each
    std::size_t lines = 0;
    for (std::string line, reason; std::getline(file, line) && std::getline(file >> std::ws, reason); ++lines)
        EXPECT_TRUE(has(refusal("{\"wait\": 1}\n" + line), "line 2: " + reason)) << line;
    EXPECT_GT(lines, 40u);
}

TEST(Script, AnUnknownMemberIsRefused) {
    for (const char* line :
         {R"({"mouse": "move", "at": [1, 2]})", R"({"mouse": "down", "button": "left"})",
          R"({"mouse": "wheel", "by": 1})", R"({"key": "x"})", R"({"key": "x", "action": "up"})",
          R"({"text": "a"})", R"({"resize": [8, 6]})", R"({"drop": ["a"]})", R"({"focus": true})",
          R"({"video": "end"})", R"({"wait": 1})", R"({"screenshot": "a"})", R"({"state": "a"})",
          R"({"expect": "a", "equals": 1})"}) {
        EXPECT_EQ(refusal(line), "");
        Json more = parse_json(line);
        more["more"] = 1;
        EXPECT_TRUE(test::says(refusal(more.dump()), "line 1 unknown more")) << line;
    }
}

/// It is refused before any line runs.
TEST(Script, CutOffAnywhereWithinALineIsRefused) {
    const std::string line = R"({"expect": "tail", "near": [1, 2, 0], "within": 0.001})";
    for (std::size_t size = 1; size < line.size(); ++size)
        EXPECT_TRUE(refusal("{\"wait\": 1}\n" + line.substr(0, size)).starts_with("line 2: ")) << size;
}

TEST(Script, WithAnyByteChangedIsRefusedOrRead) {
    const std::string text =
        std::string(recording) +
        "\n{\"command\": \"chain.add\", \"length\": 1}\n{\"mouse\": \"move\", \"at\": [1, 2.5]}\n"
        "{\"key\": \"ctrl+z\"}\n{\"expect\": \"a.0.b\", \"near\": [1], \"within\": 1e-3}\n{\"drop\": "
        "[\"a\"]}\n";
    std::mt19937 random(9);
    int refused = 0;
    for (int i = 0; i < test::rounds(20'000); ++i) {
        std::string changed = text;
        changed[random() % changed.size()] = static_cast<char>(random() % 256);
        const std::string message = refusal(changed);
        refused += !message.empty();
        ASSERT_TRUE(message.empty() || message.starts_with("line ")) << message;
        ASSERT_FALSE(has(message, "json.exception"));
    }
    EXPECT_GT(refused, test::rounds(1000));
}

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

const RecordingStart start{.version = "0.1.0",
                           .size = {1280, 720},
                           .lab = "chain",
                           .scene = Json{{"tendril_scene", 1}},
                           .settings = Json{{"theme", "dark"}}};

constexpr const char* first_line =
    R"({"recording":1,"version":"0.1.0","size":[1280,720],"lab":"chain","scene":{"tendril_scene":1},"settings":{"theme":"dark"}})"
    "\n";

TEST(Recorder, BeginsWithItsInitialState) {
    const Recorder recorder(start);
    EXPECT_EQ(recorder.text(), first_line);
    const Script script = parse(recorder.text());
    ASSERT_TRUE(script.start);
    EXPECT_EQ(script.start->size, start.size);
    EXPECT_EQ(script.start->version, start.version);
    EXPECT_EQ(script.start->lab, start.lab);
    EXPECT_EQ(*script.start->scene, *start.scene);
    EXPECT_EQ(*script.start->settings, *start.settings);
}

TEST(Recorder, RecordsTheInitialFileAndScaleIfAny) {
    RecordingStart beginning{.version = "0.1.0",
                             .size = {800, 600},
                             .lab = "chain",
                             .scene = Json::object(),
                             .settings = Json::object(),
                             .path = "walk.json",
                             .modified = true,
                             .scale = 2.0f,
                             .live = true};
    const Script script = parse(Recorder(beginning).text());
    ASSERT_TRUE(script.start);
    EXPECT_EQ(script.start->path, "walk.json");
    EXPECT_TRUE(script.start->modified);
    EXPECT_EQ(script.start->scale, 2.0f);
    EXPECT_TRUE(script.start->live);
}

TEST(Recorder, WritesEventsCommandsAndTheTicksBetween) {
    Recorder recorder(start);
    recorder.idle_tick();
    recorder.idle_tick();
    recorder.event(MouseMove{{0.1f, 2.0f}});
    recorder.event(MousePress{MouseButton::Right, false});
    recorder.command("chain.add", Json{{"length", 1}}, false);
    recorder.idle_tick();
    recorder.command("undo", Json(), true);
    recorder.event(KeyChange{Key::X, true});
    recorder.event(KeyTap{{.key = Key::Z, .ctrl = true, .shift = true}});
    recorder.idle_tick();
    const std::string lines =
        "{\"wait\":2}\n"
        "{\"mouse\":\"move\",\"at\":[0.1,2.0]}\n"
        "{\"mouse\":\"up\",\"button\":\"right\"}\n"
        "{\"command\":\"chain.add\",\"length\":1}\n"
        "{\"wait\":1}\n"
        "{\"command\":\"undo\",\"refused\":true}\n"
        "{\"key\":\"x\",\"action\":\"down\"}\n"
        "{\"key\":\"ctrl+shift+z\"}\n";
    EXPECT_EQ(recorder.text(), first_line + lines + "{\"wait\":1}\n");
    recorder.idle_tick();
    EXPECT_EQ(recorder.text(), first_line + lines + "{\"wait\":2}\n")
        << "reading the text must not end the wait";
}

TEST(Recorder, KeepsTheTickOfAnUnrecordedEvent) {
    Recorder recorder(start);
    recorder.event(KeyChange{Key::Unknown, true});
    recorder.event(KeyTap{});
    recorder.event(Focus{true});
    recorder.event(CloseRequest{});
    EXPECT_EQ(recorder.text(), first_line + std::string("{\"wait\":2}\n{\"focus\":true}\n{\"wait\":1}\n"));
}

TEST(Recorder, SplitsAWaitTooLongForALine) {
    Recorder recorder(start);
    for (int i = 0; i < 2'500'000; ++i) recorder.idle_tick();
    const Script script = parse(recorder.text());
    int ticks = 0;
    for (const auto& line : script.lines) ticks += std::get<Wait>(line.action).ticks;
    EXPECT_EQ(ticks, 2'500'000);
    EXPECT_EQ(script.lines.size(), 3u);
}

/// File names need not be UTF-8, but a recording must stay readable.
TEST(Recorder, WritesANameThatIsNotUtf8AsWellAsPossible) {
    Recorder recorder(start);
    recorder.event(Drop{{"a\xff.json"}});
    EXPECT_EQ(parse(recorder.text()).lines.size(), 1u);
}

/// Numbers are written with as many digits as their bits need, so that equal lines are equal events.
TEST(Recorder, ReadsBackAsTheSameEventsAtTheSameTicks) {
    std::mt19937 random(10);
    for (int round = 0; round < 200; ++round) {
        Recorder recorder(start);
        std::vector<std::pair<int, Event>> made;
        int tick = 0;
        for (int i = 0; i < 100; ++i, ++tick) {
            if (random() % 3 == 0) {
                recorder.idle_tick();
                continue;
            }
            const Event event = test::random_event(random);
            recorder.event(event);
            made.emplace_back(tick, event);
        }
        std::size_t next = 0;
        tick = 0;
        for (const ScriptLine& line : parse(recorder.text()).lines) {
            if (const auto* wait = std::get_if<Wait>(&line.action)) {
                tick += wait->ticks;
                continue;
            }
            ASSERT_LT(next, made.size());
            ASSERT_EQ(tick, made[next].first);
            ASSERT_EQ(event_line(std::get<Event>(line.action)), event_line(made[next].second));
            ++next, ++tick;
        }
        ASSERT_EQ(next, made.size());
        ASSERT_EQ(tick, 100);
    }
}

}  // namespace
}  // namespace tendril::app
