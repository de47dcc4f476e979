// The Rig lab's last ten seconds in the running program: flips of bones, and returning to them.
#include <cmath>

#include "tests/app/support/play.hpp"
#include "tests/says.hpp"

namespace tendril::test {
namespace {

using app::Json;

/// The head looks up; then the control for its up direction crosses its line of sight.
ScriptText tilt_past_the_look(int steps = 40) {
    ScriptText script;
    script.command("lab.open", {{"name", "rig"}})
        .command("rig.preset", {{"name", "aim"}})
        .command("rig.control.set", {{"name", "look"}, {"value", {0, 1}}})
        .wait(2)
        .command("rig.control.set", {{"name", "tilt"}, {"value", {0.303, 0.3145, 0.5}}})
        .wait(3);
    for (int i = 1; i <= steps; ++i)
        script.command("rig.control.set", {{"name", "tilt"}, {"value", {0.303 - 0.015 * i, 0.3145, 0.5}}})
            .wait(1);
    return script;
}

std::vector<Json> rig_flips(const Json& state) {
    std::vector<Json> flips;
    for (const Json& event : state.at("events"))
        if (event.at("kind") == "flip") flips.push_back(event);
    return flips;
}

const Json& element(const Json& state, const std::string& name) {
    for (const Json& each : state.at("elements"))
        if (each.at("name") == name) return each;
    throw std::runtime_error("there is no element " + name);
}

std::size_t number_of(const Json& state, const Json& event) {
    std::size_t number = 0;
    while (state.at("events").at(number) != event) ++number;
    return number;
}

TEST(RigsPast, AFlipIsMarkedAtItsTickWithBoneUnitAndCause) {
    const Json state = state_after(tilt_past_the_look());
    const std::vector<Json> flips = rig_flips(state);
    ASSERT_GE(flips.size(), 1u) << state["events"].dump(2);
    double turned = 0.0;
    for (const Json& flip : flips) {
        EXPECT_EQ(flip["name"], "head");
        EXPECT_EQ(state["elements"].at(flip["joint"].get<std::size_t>())["name"], "head");
        EXPECT_TRUE(test::says(flip["cause"].get<std::string>(), "unit aim second target"));
        turned += flip["degrees"].get<double>();
    }
    EXPECT_GT(turned, 60.0);
    // The poses before and after it differ by as much as it says.
    const std::size_t number = number_of(state, flips[0]);
    const ScriptText there = tilt_past_the_look().command("time.incident", {{"number", number}});
    const Json after = state_after(there);
    const int back = after["time"]["ticks_back"].get<int>();
    EXPECT_EQ(after["time"]["moment"].get<int>(), flips[0]["tick"].get<int>() + 1);
    const Json before = state_after(ScriptText(there).command("time.seek", {{"ticks_back", back + 1}}));
    const Json &a = element(before, "head")["global"]["rotation"],
               &b = element(after, "head")["global"]["rotation"];
    double dot = 0.0;
    for (std::size_t i = 0; i < 4; ++i) dot += a[i].get<double>() * b[i].get<double>();
    EXPECT_NEAR(2.0 * std::acos(std::min(1.0, std::abs(dot))) * 180.0 / 3.14159265,
                flips[0]["degrees"].get<double>(), 0.1);
    EXPECT_EQ(after["events"], state["events"]) << "looking back forgets nothing";
}

TEST(RigsPast, APausedDragIsRememberedAndMarkedToo) {
    ScriptText script;
    script.command("lab.open", {{"name", "rig"}}).command("rig.preset", {{"name", "aim"}});
    script.command("rig.control.set", {{"name", "look"}, {"value", {0, 1}}}).wait(3).command("time.pause");
    for (int i = 0; i <= 40; ++i)
        script.command("rig.control.set", {{"name", "tilt"}, {"value", {0.303 - 0.015 * i, 0.3145, 0.5}}})
            .command("rig.solve")
            .wait(1);
    const std::vector<Json> flips = rig_flips(state_after(script));
    ASSERT_GE(flips.size(), 1u);
    EXPECT_EQ(flips[0]["name"], "head");
}

TEST(RigsPast, WhatIsSelectedDoesNotGoBackInTime) {
    const ScriptText script = tilt_past_the_look(10)
                                  .command("rig.select", {{"element", "nose"}})
                                  .command("time.seek", {{"ticks_back", 8}});
    EXPECT_EQ(state_after(script)["selected"]["element"], "nose");
}

}  // namespace
}  // namespace tendril::test
