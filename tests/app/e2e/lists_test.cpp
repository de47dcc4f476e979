// Lists that open: typing in them, and the click that closes them.

#include "app/labs/humanoid/humanoid_part.hpp"
#include "app/labs/signal/signal_part.hpp"
#include "tests/app/support/driven_app.hpp"

namespace tendril::test {
namespace {

using namespace app;

class ListsTest : public testing::Test, protected DrivenApp {
  protected:
    ListsTest() : DrivenApp({1280, 1600}) { open("humanoid"); }

    void open(const char* lab) {
        run("lab.open", {{"name", lab}});
        run("time.pause");
        wait(3);
    }
    using DrivenApp::click;
    void click(const DrawnItem& item) { click(item.box.centre()); }
    void type(const char* text) {
        DrivenApp::type(text);
        key("enter");
        app_.tick(nullptr);
    }
    /// The item with this text, or with this text to its left.
    DrawnItem item(DrawnItem::Kind kind, const std::string& text) {
        app_.tick(nullptr);
        const FrameRecord& frame = recorder_.frame();
        for (const DrawnText& each : frame.texts) {
            if (each.text != text) continue;
            for (const DrawnItem& other : frame.items) {
                const float y = each.box.centre().y;
                if (other.kind == kind && other.box.min.y <= y && y < other.box.max.y &&
                    other.box.max.x > each.box.min.x && each.window == other.window)
                    return other;
            }
        }
        ADD_FAILURE() << "nothing says " << text;
        return {};
    }
    DrawnItem ground() { return item(DrawnItem::Kind::Combo, "ground"); }
    bool is_open() const { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup); }
    const HumanoidPart& part() { return humanoid_part(workspace()); }
};

TEST_F(ListsTest, TypingFindsAChoiceAndEnterTakesIt) {
    ASSERT_NE(part().ik.ground.kind, humanoid::GroundKind::Stairs);
    click(ground());
    ASSERT_TRUE(is_open());
    type("tair");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(part().ik.ground.kind, humanoid::GroundKind::Stairs);
    click(ground());
    type("ope");
    EXPECT_EQ(part().ik.ground.kind, humanoid::GroundKind::Slope) << "what was typed before is gone";
    // A greyed choice cannot be taken.
    click(ground());
    type("mesh");
    EXPECT_EQ(part().ik.ground.kind, humanoid::GroundKind::Slope);
}

TEST_F(ListsTest, AClickOutsideClosesTheListAndActsOnTheItemThere) {
    click(ground());
    ASSERT_TRUE(is_open());
    click(handle(app_.state(), "node.Head"));
    EXPECT_FALSE(is_open());
    EXPECT_EQ(app_.state().at("selected"), "Head");
    // From one list into another.
    click(ground());
    click(item(DrawnItem::Kind::Combo, "clip"));
    EXPECT_TRUE(is_open());
    type("rest pose");
    EXPECT_FALSE(part().playback.clip.has_value());
    // And on a button.
    click(ground());
    ASSERT_TRUE(is_open());
    click(item(DrawnItem::Kind::Button, "Rig"));
    EXPECT_FALSE(is_open());
    EXPECT_EQ(app_.workspace().lab, "rig");
}

TEST_F(ListsTest, AClickOnTheFieldOfAnOpenListClosesIt) {
    const DrawnItem field = ground();
    click(field);
    ASSERT_TRUE(is_open());
    click(field);
    EXPECT_FALSE(is_open());
    click(field);
    EXPECT_TRUE(is_open());
}

TEST_F(ListsTest, ItSaysThatNothingMatches) {
    open("rig");
    click(item(DrawnItem::Kind::Button, "Add a unit"));
    ASSERT_TRUE(is_open());
    DrivenApp::type("set");
    EXPECT_FALSE(seen("No matches."));
    DrivenApp::type("yzzy");
    EXPECT_TRUE(seen("No matches."));
    key("enter");
    EXPECT_TRUE(is_open());
}

TEST_F(ListsTest, AListBelowAButtonTakesTypingToo) {
    open("signal");
    const auto filters = [&] { return app_.state().at("filters").size(); };
    const std::size_t before = filters();
    click(item(DrawnItem::Kind::Button, "Add a filter"));
    ASSERT_TRUE(is_open());
    type("euro");
    EXPECT_FALSE(is_open());
    EXPECT_EQ(filters(), before + 1);
}

}  // namespace
}  // namespace tendril::test
