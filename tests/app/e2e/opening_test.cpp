// The scene that a window opens with by default.
#include "app/opening.hpp"

#include "app/labs/chain/chain_lab.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

TEST(Opening, IsOnlyForAWindowWithoutOtherInstructions) {
    const auto opens = [](auto ask) {
        SessionOptions options;
        ask(options);
        return opens_alive(options);
    };
    EXPECT_TRUE(opens([](SessionOptions&) {}));
    EXPECT_TRUE(opens([](SessionOptions& o) { o.config = false, o.record = "r.jsonl", o.frames = 5; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.scene = "arm.json"; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.lab = "chain"; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.headless = true; }));
    EXPECT_FALSE(opens([](SessionOptions& o) { o.script = "s.jsonl"; }));
}

class OpenScene : public testing::Test, protected DrivenApp {
  protected:
    OpenScene() : DrivenApp({1280, 720}) {}
};

TEST_F(OpenScene, IsAnArmWithItsHandOnTheTarget) {
    open_alive(app_);
    app_.settle();
    const Json state = app_.state();
    EXPECT_EQ(state["mode"], "reach");
    EXPECT_EQ(state["solve"]["report"]["status"], "Converged");
    EXPECT_LT(glm::distance(point_of(state["tail"]), point_of(state["target"])), 0.005f);
    EXPECT_EQ(state["solve"]["limits"][1]["kind"], "hinge");
    EXPECT_TRUE(state["solve"]["pole"].is_array());
    for (const char* name : {"target", "pole", "segment.0", "segment.1", "segment.2"}) handle(state, name);
}

TEST_F(OpenScene, KeepsSettingsThatTheUserChose) {
    workspace().settings.choices["segments"] = "spheres";
    open_alive(app_);
    EXPECT_EQ(workspace().settings.choices["segments"], "spheres");
    EXPECT_EQ(workspace().settings.choices["reach sphere"], "on") << "that was not chosen yet";
}

TEST_F(OpenScene, CardsAreOfferedOnce) {
    offer_cards(app_);
    EXPECT_TRUE(card_shown(workspace().settings, chain_lab));
    app_.run({"view.card", Json{{"open", false}}});
    offer_cards(app_);
    EXPECT_FALSE(card_shown(workspace().settings, chain_lab));
}

/// The circle appears on request, in mode Reach only.
TEST_F(OpenScene, ItsReachSphereIsASetting) {
    const auto strokes = [&] {
        const Camera camera(workspace().camera, {{0.0f, 0.0f}, {800.0f, 600.0f}});
        DrawList list;
        app_.labs().find(chain_lab)->draw({workspace(), camera, palette(Theme::Dark)}, list);
        return list.strokes.size();
    };
    open_alive(app_);
    const std::size_t with = strokes();
    app_.run({"view.reach_sphere", Json{{"show", "off"}}});
    EXPECT_LT(strokes() + 100, with);
    app_.run({"chain.mode", Json{{"mode", "backward"}}});
    const std::size_t trailing = strokes();
    app_.run({"view.reach_sphere", Json{{"show", "on"}}});
    EXPECT_EQ(strokes(), trailing);
}

}  // namespace
}  // namespace tendril::test
