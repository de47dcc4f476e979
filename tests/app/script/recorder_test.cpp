#include "app/script/recorder.hpp"
#include "app/io/json_complete.hpp"

#include "tests/app/script/script_support.hpp"
#include "tests/app/support/temp_folder.hpp"

namespace tendril::app {
namespace {

using test::parse;

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
