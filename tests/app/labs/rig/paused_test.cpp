// Drags while the simulation is paused are part of the take, like those while it runs.
#include <map>
#include <random>

#include "app/labs/rig/clip.hpp"
#include "app/labs/rig/rig_runtime.hpp"
#include "app/labs/rig/take.hpp"
#include "rig_support.hpp"

namespace tendril::app {
namespace {

class RigPaused : public RigTest {
  protected:
    void play(int ticks) {
        for (int i = 0; i < ticks; ++i) {
            lab().step(workspace);
            shown_[part().take.now()] = part().state;
        }
    }
    void go(std::uint64_t tick) { run("rig.time", {{"tick", tick}}); }
    /// Emits what a drag emits, repeatedly.
    void drag(const char* name, const Json& value) {
        set(name, value);
        solve();
        see();
    }
    void forget_what_comes() { shown_.erase(shown_.upper_bound(part().take.now()), shown_.end()); }
    void see() {
        forget_what_comes();
        shown_[part().take.now()] = part().state;
    }
    void head_at(double x, double z = 0.0) { drag("head", {{"translation", {x, 1.0, z}}}); }
    void expect_scrubs(int times, unsigned seed, bool forgetful = false) {
        ASSERT_FALSE(shown_.empty());
        std::mt19937 random(seed);
        for (int i = 0; i < times; ++i) {
            auto tick = shown_.begin();
            std::advance(tick, static_cast<int>(random() % shown_.size()));
            if (forgetful) workspace.runtimes.clear();
            go(tick->first);
            ASSERT_EQ(part().state, tick->second) << tick->first;
        }
    }
    /// An arm that reaches for one control, with its elbow towards another, and a bone that trails on a
    /// spring; and a head that, once a switch is on, turns from its direction at that time.
    void arm() {
        element("shoulder");
        element("elbow", "shoulder", transform(0, 1, 0));
        element("wrist", "elbow", transform(0, 1, 0.1));
        element("tip", "wrist", transform(0, 0.5, 0));
        element("tail");
        control("target", "position", {{"local", transform(0.5, 1.5, 0)}});
        control("pole", "position", {{"local", transform(0, 1, 2)}});
        control("dial", "float");
        control("on", "bool");
        unit(R"({"unit": "fabrik", "name": "reach", "root": "shoulder", "tip": "tip", )"
             R"("target": "target", "pole_target": "pole"})");
        unit({{"unit", "spring_interpolate"}, {"name", "trail"}, {"target", "tip"}, {"strength", 1.5}});
        unit(R"({"unit": "aim", "item": "tail", "primary": {"axis": [0, 1, 0], )"
             R"("target": {"unit": "trail"}}, "max_speed": 90})");
        element("head");
        unit(R"({"unit": "aim", "name": "late", "item": "head", "primary": {"target": "target"}, )"
             R"("max_speed": 45, "when": "on"})");
    }

    std::map<std::uint64_t, rig::State> shown_;  ///< by tick
};

/// The intermediate values of a drag must not reach anything with memory.
TEST_F(RigPaused, ADragEndsAsIfAllHadBeenSetAtOnce) {
    arm();
    play(30);
    const Workspace before = workspace;
    drag("dial", 0.5);
    drag("on", true);
    for (int i = 0; i < 30; ++i) drag("target", {std::cos(0.3 * i), std::sin(0.5 * i), 0.2 * i});
    drag("pole", {1.0, 1.0, -1.0});
    drag("target", {1.0, 0.5, 0.3});
    const RigPart dragged = part();
    workspace = before;
    workspace.runtimes.clear();
    set("dial", 0.5);
    set("on", true);
    set("target", {1.0, 0.5, 0.3});
    set("pole", {1.0, 1.0, -1.0});
    solve();
    EXPECT_EQ(part().state, dragged.state);
    EXPECT_EQ(part().take.keys->size(), dragged.take.keys->size());
    EXPECT_EQ(part().moving, dragged.moving);
}

TEST_F(RigPaused, AnyTickIsAsItWasShown) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        SCOPED_TRACE(seed);
        run("rig.clear");
        arm();
        shown_.clear();
        play(5);
        std::mt19937 random(seed);
        const auto any = [&] { return 4.0 * static_cast<double>(random() >> 8) / (1u << 24) - 2.0; };
        const std::uint64_t began = part().take.began;
        for (int i = 0; i < 120; ++i) {
            const auto what = random() % 9;
            const char* const name = random() % 3 == 0 ? "pole" : "target";
            const double x = any(), y = any(), z = any();
            if (what < 3) play(1 + static_cast<int>(random() % 7));
            if (what == 3 || what == 4) drag(name, {x, y, z});
            if (what == 5) set(name, {x, y, z}), forget_what_comes();  // units see it one tick later
            if (what == 6) solve(), see();
            if (what == 8) drag("on", random() % 2 == 0);
            if (what == 7) {
                go(began + random() % (part().take.tick + 1));
                if (part().take.tick == 0) go(began + 1);
            }
        }
        ASSERT_EQ(part().take.began, began);
        shown_.erase(shown_.begin(), shown_.lower_bound(began));
        expect_scrubs(60, seed);
        expect_scrubs(20, seed, true);
        workspace = reopened();
        expect_scrubs(30, seed);
    }
}

TEST_F(RigPaused, PausedPosesAreBakedAsTheyPlay) {
    arm();
    play(10);
    for (int i = 0; i < 6; ++i) {
        drag("target", {0.3 * i, 1.0, 0.5 - 0.2 * i});
        play(4);
    }
    run("rig.clip.record");
    const RigClip clip = *part().clip;
    const auto shoulder =
        static_cast<std::size_t>(std::ranges::find(clip.bones, "shoulder") - clip.bones.begin());
    for (std::size_t frame = 0; frame < clip.frames(); ++frame) {
        go(clip.began + frame);
        const glm::quat turned(rotation("shoulder"));
        EXPECT_EQ(clip.poses[frame * clip.bones.size() + shoulder].rotation, turned) << frame;
    }
}

/// An edit of the rig starts a take, and so does a backward solve.
TEST_F(RigPaused, AnEditStartsATake) {
    arm();
    play(30);
    run("rig.unit.set", {{"name", "trail"}, {"strength", 3}});
    solve();
    EXPECT_EQ(part().take.last, 0u);
    play(10);
    const std::uint64_t now = part().take.now();
    drag("target", {1.0, 0.5, 0.3});
    EXPECT_NE(part().take.began, now);
    solve("backward");
    EXPECT_EQ(part().take.began, now);
}

TEST_F(RigPaused, InvalidKeysInAFile) {
    arm();
    play(10);
    drag("target", {1.0, 0.5, 0.3});
    Json scene = save_scene(workspace);
    Json& keys = scene["labs"]["rig"]["state"]["take"]["keys"];
    EXPECT_EQ(keys.back(), (Json{10}));
    for (const Json& key : {Json::array(), Json{-1}, Json{"solve"}, Json{10, "target"}, Json(10)}) {
        keys.back() = key;
        EXPECT_THROW(load_scene(workspace, scene), std::runtime_error) << key;
    }
}

}  // namespace
}  // namespace tendril::app
