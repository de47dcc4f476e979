// Numbers typed into a panel: those out of range are refused with their value and the range.
#include "tests/app/support/panel_places.hpp"
#include "tests/app/support/play.hpp"

namespace tendril::test {
namespace {

constexpr glm::vec2 iterations_field = chain_panel::iterations;
const app::Json unfolded = chain_panel::unfolded();

/// Clicks every row of the Chain lab's solver options, from iterations to soft zone, and types.
ScriptText typed_into_every_row(const char* text) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "reach"}}).command("view.fold", unfolded);
    for (float y = iterations_field.y - 8.0f; y < chain_panel::soft_zone.y + 8.0f; y += 8.0f)
        script.click({iterations_field.x, y}).wait(2).text(text).key("enter").wait(30);
    return script;
}

TEST(TypedNumbers, OutOfRangeAreRefusedWithValueAndRange) {
    const Played played = play_refused(typed_into_every_row("99999"));
    for (const char* reason : {"chain.solver: iterations must be 1 to 10000, got 99999",
                               "chain.solver: snap_back must be 0 to 1, got 99999.0",
                               "chain.solver: soft_zone must be 0 to 1, got 99999.0"})
        EXPECT_TRUE(has(played.outcome.err, reason));
    const app::Json& solve = played.state.at("solve");
    EXPECT_EQ(solve.at("iterations"), 100);
    EXPECT_EQ(solve.at("snap_back"), 0.0);
    EXPECT_EQ(solve.at("soft_zone"), 0.0);
}

/// Types into the Chain lab's iterations field key by key; the script then goes on.
ScriptText typed_iterations(const std::string& text) {
    ScriptText script;
    script.command("chain.mode", {{"mode", "reach"}}).command("view.fold", unfolded);
    script.click(iterations_field).wait(2);
    for (const char key : text) script.text(std::string(1, key).c_str());
    return script;
}

/// Typing ends by a key, or by a click elsewhere.
constexpr const char* ends[]{"enter", "tab", ""};
ScriptText ended(ScriptText script, const std::string& end) {
    return (end.empty() ? script.click({700.0f, 400.0f}) : script.key(end.c_str())).wait(30);
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// They are not refused at every key on the way to the number.
TEST(TypedNumbers, AreRefusedOnceWhenTypingEnds) {
    for (const std::string end : ends) {
        const std::string told = play_refused(ended(typed_iterations("99999999"), end)).outcome.err;
        EXPECT_TRUE(end.empty() || has(told, "iterations must be 1 to 10000, got 99999999")) << end;
        EXPECT_EQ(lines(told), 1u) << end << ": " << told;
    }
}

/// "0" is out of range, and on the way to "042".
TEST(TypedNumbers, ThatBeginOutOfRangeAreTaken) {
    for (const char* end : ends)
        EXPECT_EQ(state_after(ended(typed_iterations("042"), end)).at("solve").at("iterations"), 42) << end;
}

/// 100 is the field's present value: 1 and 10 on the way must not be applied, nor must deleted text.
TEST(TypedNumbers, PresentValueOrEmptyTextChangesNothing) {
    for (const bool deleted : {false, true}) {
        ScriptText script = typed_iterations(deleted ? "42" : "100");
        if (deleted) script.key("backspace").key("backspace");
        for (const char* end : ends)
            EXPECT_EQ(state_after(ended(script, end)).at("solve").at("iterations"), 100) << end << deleted;
    }
}

/// Nothing changes on the way either: the chain is bitwise unchanged while the user types.
TEST(TypedNumbers, ChangeNothingBeforeEnter) {
    const app::Json before = state_after(typed_iterations(""));
    const app::Json typing = state_after(typed_iterations("3").wait(30));
    EXPECT_EQ(typing.at("segments"), before.at("segments"));
    EXPECT_EQ(typing.at("solve"), before.at("solve"));
    const app::Json left = state_after(typed_iterations("3").key("escape").wait(30));
    EXPECT_EQ(left.at("segments"), before.at("segments"));
    EXPECT_EQ(left.at("solve"), before.at("solve"));
    EXPECT_EQ(left.at("camera"), before.at("camera"));
}

/// A row may move between two clicks: a number typed beside a field must not turn the view, nor delete.
TEST(TypedNumbers, TypedBesideAFieldAreNoShortcuts) {
    ScriptText script = typed_iterations("");
    script.key("escape")
        .command("chain.select", {{"index", 2}})
        .command("view.fold", {{"section", "chain"}, {"folded", true}});
    const app::Json before = state_after(script.wait(3));
    const app::Json beside =
        state_after(ScriptText(script).click({130.0f, 640.0f}).key("7").key("delete").key("."));
    EXPECT_EQ(beside.at("camera"), before.at("camera"));
    EXPECT_EQ(beside.at("segments"), before.at("segments"));
    EXPECT_EQ(beside.at("time").at("playing"), before.at("time").at("playing"));
    ScriptText then = ScriptText(script).click({130.0f, 640.0f}).click({700.0f, 60.0f}).key("7");
    EXPECT_NE(state_after(then).at("camera"), before.at("camera")) << "after a click in the view";
}

TEST(TypedNumbers, AreEvaluatedWithTheirUnits) {
    for (const auto& [text, iterations] : {std::pair("7*6", 42), {"1e2/4", 25}, {"(1+2)^2", 9}}) {
        const Played played = play(typed_iterations(text).key("enter").wait(30));
        EXPECT_EQ(played.state.at("solve").at("iterations"), iterations) << text;
    }
    ScriptText thirds = typed_into_every_row("1/3");
    EXPECT_EQ(play_refused(thirds).state.at("solve").at("snap_back").get<float>(), 1.0f / 3.0f);
}

/// After Enter the field stays open; a click elsewhere restores the value and gives the reason.
TEST(TypedNumbers, InvalidTextIsRefusedWithAReason) {
    const Played elsewhere =
        play_refused(typed_iterations("many").key("enter").click({700.0f, 400.0f}).wait(30));
    EXPECT_TRUE(has(elsewhere.outcome.err, "\"many\" is not a number"));
    EXPECT_EQ(lines(elsewhere.outcome.err), 1u);
    EXPECT_EQ(elsewhere.state.at("solve").at("iterations"), 100);
    const Played mended = play(typed_iterations("4x")
                                   .key("enter")
                                   .key("backspace")
                                   .key("backspace")
                                   .text("17")
                                   .key("enter")
                                   .wait(30));
    EXPECT_EQ(mended.outcome.err, "");
    EXPECT_EQ(mended.state.at("solve").at("iterations"), 17);
    const Played part = play_refused(typed_iterations("2.5").key("tab").wait(30));
    EXPECT_TRUE(has(part.outcome.err, "\"2.5\" is not a whole number"));
    const Played unit = play_refused(typed_iterations("3 m").key("tab").wait(30));
    EXPECT_TRUE(has(unit.outcome.err, "\"3 m\": this number has no unit"));
}

/// Neither the click into the field nor the typed keys turn the view.
TEST(TypedNumbers, NeverReachTheCamera) {
    const app::Json before = state_after(
        ScriptText().command("chain.mode", {{"mode", "reach"}}).command("view.fold", unfolded).wait(30));
    ScriptText script = typed_iterations("");
    for (const char* digit : {"1", "3", "7", "5"}) script.hold(digit).text(digit).release(digit);
    const app::Json after = state_after(script.key("escape").wait(30));
    EXPECT_EQ(after.at("camera"), before.at("camera"));
    EXPECT_EQ(after.at("solve"), before.at("solve"));
}

TEST(TypedNumbers, TabGoesToTheNextField) {
    const ScriptText typed = typed_iterations("42").key("tab").wait(2).text("0.25").key("enter").wait(30);
    const app::Json both = play(typed).state.at("solve");
    EXPECT_EQ(both.at("iterations"), 42);
    EXPECT_EQ(both.at("tolerance"), 0.25);
    // Each is an undo step of its own.
    const app::Json one = play(ScriptText(typed).key("ctrl+z").wait(5)).state.at("solve");
    EXPECT_EQ(one.at("iterations"), 42);
    EXPECT_NE(one.at("tolerance"), 0.25);
    const app::Json none = play(ScriptText(typed).key("ctrl+z").key("ctrl+z").wait(5)).state.at("solve");
    EXPECT_EQ(none.at("iterations"), 100);
}

/// Only the direct solver bends ropes: with another, Tab goes from stretch to the strain of a tear.
TEST(TypedNumbers, TabSkipsTheBendingThatTheSolverIgnores) {
    const auto typed = [](const char* solver) {
        return scene_after(ScriptText()
                               .command("lab.open", {{"name", "rope"}})
                               .command("time.pause")
                               .command("rope.select", {{"rope", "rope"}, {"particle", 3}})
                               .command("rope.settings", {{"solver", solver}})
                               .wait(2)
                               .click({1186.0f, 674.0f})  // stretch
                               .wait(2)
                               .key("tab")
                               .wait(2)
                               .text("5")
                               .key("enter")
                               .wait(10))["labs"]["rope"]["world"]["bodies"][0];
    };
    const app::Json bent = typed("direct"), torn = typed("xpbd");
    EXPECT_EQ(bent["bending"].get<float>(), 5.0f);
    EXPECT_FALSE(bent.contains("tear"));
    EXPECT_EQ(torn["tear"].get<float>(), 0.05f);
    EXPECT_FALSE(torn.contains("bending"));
}

TEST(TypedNumbers, ShiftDragsThemFiner) {
    const auto scrubbed = [](bool shift) {
        ScriptText script;
        script.command("chain.mode", {{"mode", "reach"}}).command("view.fold", unfolded);
        if (shift) script.hold("shift");
        script.drag({iterations_field, iterations_field + glm::vec2(20.0f, 0.0f),
                     iterations_field + glm::vec2(60.0f, 0.0f)});
        if (shift) script.release("shift");
        return state_after(script.wait(30)).at("solve").at("iterations").get<int>() - 100;
    };
    const int coarse = scrubbed(false), fine = scrubbed(true);
    EXPECT_GE(coarse, 4);
    EXPECT_LE(fine, coarse / 4);
}

/// 2^32 + 7 would be 7 in a parser that keeps the last 32 bits.
TEST(TypedNumbers, IntegersOutOfRangeAndInfinityAreRefused) {
    const char* const whole = "chain.solver: iterations must be 1 to 10000, got";
    const char* const endless = "tolerance must be";
    for (const auto& [text, told] : {std::pair("4294967303", whole),
                                     {"-4294967289", whole},
                                     {"99999999999999999999", whole},
                                     {"1e30", endless},
                                     {"-1e30", endless},
                                     {"1e999", endless}}) {
        const Played played = play_refused(typed_into_every_row(text));
        EXPECT_TRUE(has(played.outcome.err, told)) << text;
        EXPECT_TRUE(told == whole || played.state.at("solve").at("snap_back") == 0.0) << text;
    }
}

}  // namespace
}  // namespace tendril::test
